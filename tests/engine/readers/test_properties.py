"""Properties that hold for every input: nothing lost, order free, and never a bare exception."""

from __future__ import annotations

import copy
import io
import json
from typing import Any

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.readers import FeatureIndex, read_landmarks
from symboslam.errors import SymboSlamError

# The first example pays for imports, so that no example has a time limit.
relaxed = settings(deadline=None)

KNOWN = ["House", "Tree", "Bench", "Car"]
metre = st.floats(-1e6, 1e6)
confidence = st.floats(0, 1, exclude_min=True)
landmark = st.tuples(st.sampled_from([*KNOWN, "Dragon"]), metre, metre, confidence)
several = st.lists(landmark, min_size=1, max_size=20)


def feature(row: tuple[str, float, float, float]) -> dict[str, Any]:
    name, x, y, sure = row
    return {
        "type": "Feature",
        "geometry": {"type": "Point", "coordinates": [x, y]},
        "properties": {"class": name, "confidence": sure},
    }


def collection(rows: list[Any], **members: Any) -> dict[str, Any]:
    return {"type": "FeatureCollection", "features": [feature(row) for row in rows], **members}


def as_bytes(document: object) -> io.BytesIO:
    return io.BytesIO(json.dumps(document).encode())


def rows_of(landmarks: LandmarkMap, knowledge: FeatureIndex) -> list[tuple[Any, ...]]:
    names = [knowledge.features[i].name for i in landmarks.feature]
    return list(zip(names, landmarks.x, landmarks.y, landmarks.confidence, strict=True))


@relaxed
@given(several)
def test_metres_come_back_exactly(
    knowledge: FeatureIndex, rows: list[tuple[str, float, float, float]]
) -> None:
    landmarks = read_landmarks(as_bytes(collection(rows, crs_units="m")), knowledge)
    assert rows_of(landmarks, knowledge) == [row for row in rows if row[0] in KNOWN]


@relaxed
@given(several)
def test_csv_and_geojson_agree(
    knowledge: FeatureIndex, rows: list[tuple[str, float, float, float]]
) -> None:
    text = "class,x,y,confidence\n" + "".join(",".join(map(str, row)) + "\n" for row in rows)
    a = read_landmarks(as_bytes(collection(rows, crs_units="m")), knowledge)
    b = read_landmarks(io.StringIO(text), knowledge)
    assert rows_of(a, knowledge) == rows_of(b, knowledge)
    assert (a.bbox, a.id.tolist(), a.report.unknown) == (b.bbox, b.id.tolist(), b.report.unknown)


degree = st.tuples(st.sampled_from(KNOWN), st.floats(148, 149), st.floats(-36, -35), st.just(1.0))


@relaxed
@given(st.lists(degree, min_size=1, max_size=20))
def test_degrees_come_back(
    knowledge: FeatureIndex, rows: list[tuple[str, float, float, float]]
) -> None:
    landmarks = read_landmarks(collection(rows), knowledge)
    longitude, latitude = landmarks.frame.from_metres(landmarks.x, landmarks.y)
    assert np.allclose(longitude, [row[1] for row in rows], rtol=0, atol=1e-9)
    assert np.allclose(latitude, [row[2] for row in rows], rtol=0, atol=1e-9)
    west, south, east, north = landmarks.bbox
    assert ((landmarks.x >= west) & (landmarks.x <= east)).all()
    assert ((landmarks.y >= south) & (landmarks.y <= north)).all()


@relaxed
@given(st.lists(degree, min_size=1, max_size=15), st.randoms())
def test_the_order_of_the_features_does_not_matter(
    knowledge: FeatureIndex, rows: list[tuple[str, float, float, float]], random: Any
) -> None:
    mixed = list(rows)
    random.shuffle(mixed)
    a, b = read_landmarks(collection(rows), knowledge), read_landmarks(collection(mixed), knowledge)
    assert (a.frame, a.bbox) == (b.frame, b.bbox)
    assert sorted(rows_of(a, knowledge)) == sorted(rows_of(b, knowledge))


@relaxed
@given(several, st.lists(st.integers(0, 19)), st.floats(1, 1e6), st.floats(1, 1e6))
def test_every_landmark_is_accounted_for(
    knowledge: FeatureIndex,
    rows: list[tuple[str, float, float, float]],
    again: list[int],
    east: float,
    north: float,
) -> None:
    """read + unknown + outside + duplicates = features in the file."""
    document = collection(
        rows, crs_units="m", bbox=[rows[0][1], rows[0][2], east + 1e6, north + 1e6]
    )
    for index, item in enumerate(document["features"]):
        item["id"] = index
    document["features"] += [document["features"][i] for i in again if i < len(rows)]
    report = read_landmarks(document, knowledge).report
    assert report.duplicates == sum(i < len(rows) for i in again)
    counted = report.read + report.unknown.total() + report.outside + report.duplicates
    assert counted == len(document["features"])


WHOLE = {
    "type": "FeatureCollection",
    "bbox": [9.0, 47.0, 9.1, 47.1],
    "surveyed": {"type": "Polygon", "coordinates": [[[9, 47], [9.1, 47], [9, 47.1], [9, 47]]]},
    "crs": {"type": "name", "properties": {"name": "EPSG:4326"}},
    "features": [
        {
            "type": "Feature",
            "id": "a",
            "geometry": {"type": "Point", "coordinates": [9.05, 47.05]},
            "properties": {
                "class": "House",
                "tags": {"building": "house", "name": "x"},
                "confidence": 0.5,
                "time": "2022-01-31T12:00:00Z",
                "agent": "r",
            },
        },
        {
            "type": "Feature",
            "geometry": {"type": "Point", "coordinates": [9.01, 47.01]},
            "properties": {"tags": {"natural": "tree"}},
        },
    ],
}


def places(value: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """The paths of all values inside a document."""
    found = [path] if path else []
    if isinstance(value, dict | list):
        items = value.items() if isinstance(value, dict) else enumerate(value)
        for key, item in items:
            found += places(item, (*path, key))
    return found


scalar = st.one_of(
    st.none(), st.booleans(), st.integers(), st.floats(), st.text(), st.just("EPSG:3857")
)
anything = st.recursive(
    scalar,
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(), inner, max_size=3),
    max_leaves=5,
)


def try_to_read(source: Any, knowledge: FeatureIndex, **options: Any) -> None:
    """Either a sound map or an error of ours whose message can be printed."""
    try:
        landmarks = read_landmarks(source, knowledge, **options)
    except SymboSlamError as error:
        str(error).encode()
        return
    assert len(set(landmarks.id.tolist())) == len(landmarks)
    assert np.isfinite([*landmarks.bbox]).all()
    assert np.isfinite(landmarks.xy).all()
    assert ((landmarks.confidence > 0) & (landmarks.confidence <= 1)).all()
    "".join([*landmarks.id, *landmarks.report.unknown]).encode()


@relaxed
@given(st.sampled_from(places(WHOLE)), anything)
def test_whatever_replaces_a_value_is_read_or_refused(
    knowledge: FeatureIndex, path: tuple[Any, ...], value: Any
) -> None:
    document: Any = copy.deepcopy(WHOLE)
    parent = document
    for key in path[:-1]:
        parent = parent[key]
    parent[path[-1]] = value
    try_to_read(document, knowledge)
    try_to_read(as_bytes(document), knowledge)


@relaxed
@given(st.data())
def test_a_file_cut_anywhere_is_refused(knowledge: FeatureIndex, data: st.DataObject) -> None:
    text = json.dumps(WHOLE)
    end = data.draw(st.integers(0, len(text) - 1))
    try:
        read_landmarks(io.BytesIO(text[:end].encode()), knowledge, format="geojson")
    except SymboSlamError:
        return
    raise AssertionError("half a file was read")


fields = st.text(alphabet='ab1.,;\n\r" \0é', max_size=6)
line = st.lists(st.one_of(fields, st.sampled_from(["House", "1", "2.5", "0.5"])), max_size=5)


@relaxed
@given(st.lists(line, max_size=6), st.sampled_from([",", ";"]))
def test_any_table_is_read_or_refused(
    knowledge: FeatureIndex, lines: list[list[str]], delimiter: str
) -> None:
    head = ["class", "x", "y", "confidence", "id"]
    text = "\n".join(delimiter.join(row) for row in [head, *lines])
    try_to_read(io.StringIO(text), knowledge, format="csv")


@relaxed
@given(st.binary(max_size=200), st.sampled_from(["csv", "geojson", "osm", None]))
def test_any_bytes_are_read_or_refused(
    knowledge: FeatureIndex, content: bytes, name: str | None
) -> None:
    try_to_read(io.BytesIO(content), knowledge, format=name)
