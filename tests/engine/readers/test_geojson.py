"""GeoJSON: what is taken, what is counted, and what every kind of bad input is told."""

from __future__ import annotations

import gzip
import json
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from symboslam.engine.landmarks import LandmarkMap
from symboslam.errors import GeometryError, LandmarkError

Read = Callable[..., LandmarkMap]
Write = Callable[[str, Any], Any]


def point(x: Any = 1.0, y: Any = 2.0, **properties: Any) -> dict[str, Any]:
    """A feature; ``properties`` default to a House."""
    return {
        "type": "Feature",
        "geometry": {"type": "Point", "coordinates": [x, y]},
        "properties": properties or {"class": "House"},
    }


def metres(*features: Any, **members: Any) -> dict[str, Any]:
    """A collection in metres with an area of 10 m x 10 m."""
    base = {"type": "FeatureCollection", "crs_units": "m", "bbox": [0, 0, 10, 10]}
    return {**base, "features": list(features), **members}


def degrees(*features: Any, **members: Any) -> dict[str, Any]:
    return {"type": "FeatureCollection", "features": list(features), **members}


# What is taken


@pytest.mark.parametrize(
    ("members", "line"),
    [
        ({}, ""),
        ({"attribution": "(c) A", "license": "B"}, "(c) A"),
        ({"attribution": " ", "copyright": "© A"}, "© A"),
        ({"license": "CC0"}, "CC0"),
        ({"attribution": ["A"], "license": {"name": "B"}, "copyright": 3}, ""),
        ({"attribution": " A\n\x00B\u202e C\ud800\t"}, "A B C"),
        ({"attribution": "x" * 301}, "x" * 300),
    ],
)
def test_attribution(read: Read, members: dict[str, Any], line: str) -> None:
    assert read(metres(point(), **members)).report.attribution == line


def test_columns_of_a_metric_file(read: Read, names: Callable[[LandmarkMap], list[str]]) -> None:
    landmarks = read(
        metres(
            point(1, 2, **{"class": "House", "confidence": 0.5, "id": "a", "agent": "robot 1"}),
            point(3.5, 4, tags={"natural": "tree"}, time="2022-01-31T12:00:00Z"),
            point(5, 6, **{"class": "car"}),
        )
    )
    assert names(landmarks) == ["House", "Tree", "Car"]
    assert landmarks.x.tolist() == [1, 3.5, 5]
    assert landmarks.y.tolist() == [2, 4, 6]
    assert landmarks.confidence.tolist() == [0.5, 1, 1]
    assert landmarks.static.tolist() == [True, True, False]
    assert landmarks.id.tolist() == ["a", "1", "2"]
    assert landmarks.agent is not None
    assert landmarks.agent.tolist() == ["robot 1", None, None]
    assert landmarks.time is not None
    assert landmarks.time.tolist() == [None, "2022-01-31T12:00:00+00:00", None]
    assert landmarks.bbox == (0, 0, 10, 10)
    assert landmarks.surveyed is None
    assert not landmarks.frame.geographic
    assert (landmarks.report.read, landmarks.report.notes) == (3, ())
    assert landmarks.feature.dtype == np.int32


def test_columns_that_nobody_gives_are_none(read: Read) -> None:
    landmarks = read(metres(point()))
    assert landmarks.time is None
    assert landmarks.agent is None


@pytest.mark.parametrize(
    "where", [{"id": "n7"}, {"properties": {"class": "House", "id": "n7"}},
              {"properties": {"building": "house", "@id": "n7"}}],
)  # fmt: skip
def test_ids_may_stand_on_the_feature_or_in_its_properties(
    read: Read, where: dict[str, Any]
) -> None:
    assert read(metres({**point(), **where})).id.tolist() == ["n7"]


def test_missing_ids_never_collide_with_given_ones(read: Read) -> None:
    features = [{**point(1), "id": "2"}, {**point(2), "id": 7}, point(3), {**point(4), "id": "#2"}]
    assert read(metres(*features)).id.tolist() == ["2", "7", "##2", "#2"]


def test_flat_tags_of_common_osm_exports(
    read: Read, names: Callable[[LandmarkMap], list[str]]
) -> None:
    landmarks = read(
        metres(
            point(1, building="house", name="Rose Cottage", osm_id=5, shop=None),
            point(2, natural="tree", shop=""),
            point(3, name="a place with a name only"),
            point(4, amenity="fountain"),
        )
    )
    assert names(landmarks) == ["House", "Tree"]
    assert landmarks.report.unknown == {"(no tag of any feature)": 1, "amenity=fountain": 1}


def test_a_class_beats_tags_but_an_unknown_class_does_not(
    read: Read, names: Callable[[LandmarkMap], list[str]]
) -> None:
    tags = {"natural": "tree"}
    landmarks = read(
        metres(
            point(1, **{"class": "Bench", "tags": tags}), point(2, **{"class": "?", "tags": tags})
        )
    )
    assert names(landmarks) == ["Bench", "Tree"]


def test_tag_values_that_are_not_text(
    read: Read, names: Callable[[LandmarkMap], list[str]]
) -> None:
    landmarks = read(metres(point(tags={"building": True}), point(2, tags={"building": 3})))
    assert names(landmarks) == ["Building", "Building"]


def test_altitudes_are_ignored(read: Read) -> None:
    feature = point()
    feature["geometry"]["coordinates"] = [1, 2, 600]
    assert read(metres(feature)).xy.tolist() == [[1, 2]]


def test_a_null_confidence_is_one(read: Read) -> None:
    landmarks = read(metres(point(**{"class": "House", "confidence": None})))
    assert landmarks.confidence.tolist() == [1]


def test_each_set_of_tags_is_matched_once(read: Read, knowledge: Any) -> None:
    before = knowledge.matched
    trees = [point(i / 100, tags={"natural": "tree", "name": f"tree {i}"}) for i in range(500)]
    assert len(read(metres(*trees))) == 500
    assert knowledge.matched - before == 1


def test_times_without_a_zone_are_read_as_utc_and_said_so(read: Read) -> None:
    landmarks = read(metres(point(**{"class": "House", "time": "2022-01-31T12:00:00"})))
    assert landmarks.time is not None
    assert landmarks.time.tolist() == ["2022-01-31T12:00:00+00:00"]
    assert landmarks.report.notes == ("1 times have no zone and were read as UTC",)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_encodings(read: Read, write: Write, encoding: str) -> None:
    text = json.dumps(metres(point(**{"class": "House", "id": "Küche"})), ensure_ascii=False)
    assert read(write("map.geojson", text.encode(encoding))).id.tolist() == ["Küche"]


def test_gzip(read: Read, write: Write) -> None:
    packed = gzip.compress(json.dumps(metres(point())).encode())
    assert len(read(write("map.geojson.gz", packed))) == 1


# What is counted


def test_unknown_classes_and_tags_are_counted_and_listed(read: Read) -> None:
    landmarks = read(
        metres(
            point(1),
            point(2, **{"class": "Dragon"}),
            point(3, **{"class": "Dragon"}),
            point(4, tags={"amenity": "fountain", "name": "x"}),
            point(5, tags={"highway": "crossing", "amenity": "fountain"}),
            point(6, tags={"waterway": "stream"}),
        )
    )
    assert landmarks.report.unknown == {
        "Dragon": 2,
        "amenity=fountain": 1,
        "amenity=fountain, highway=crossing": 1,
        "waterway=stream": 1,
    }
    assert landmarks.report.read == len(landmarks) == 1


def test_nothing_known_is_a_valid_map_with_a_note(read: Read) -> None:
    landmarks = read(metres(point(**{"class": "Dragon"})))
    assert len(landmarks) == 0
    assert "no landmark has a class or tags" in landmarks.report.notes[0]


def test_exact_duplicates_are_left_out_and_counted(read: Read) -> None:
    feature = {**point(), "id": "a"}
    landmarks = read(metres(feature, {**point(5), "id": "b"}, feature))
    assert landmarks.id.tolist() == ["a", "b"]
    assert landmarks.report.duplicates == 1


def test_equal_landmarks_without_ids_are_two(read: Read) -> None:
    assert len(read(metres(point(), point()))) == 2


@pytest.mark.parametrize(
    "other",
    [point(2), point(**{"class": "Tree"}), point(**{"class": "House", "confidence": 0.5}),
     point(**{"class": "House", "agent": "b"})],
)  # fmt: skip
def test_one_id_for_two_different_landmarks_is_refused(read: Read, other: dict[str, Any]) -> None:
    with pytest.raises(LandmarkError, match=r"feature 2 .*'a'.*different.*feature 0") as caught:
        read(metres({**point(), "id": "a"}, point(5), {**other, "id": "a"}))
    assert caught.value.where == "feature 2 (counted from 0)"


# Bad files


@pytest.mark.parametrize("content", [b"", b"  \n", b"\n\n"])
def test_empty_file(read: Read, write: Write, content: bytes) -> None:
    path = write("map.geojson", content)
    with pytest.raises(LandmarkError, match="is empty") as caught:
        read(path)
    assert caught.value.source == str(path)


def test_truncated_json_names_the_place(read: Read, write: Write) -> None:
    text = json.dumps(metres(point(), point()), indent=1)
    cut = text[: text.rindex('"type"')]
    path = write("map.geojson", cut)
    with pytest.raises(LandmarkError, match="cut short") as caught:
        read(path)
    last = cut.splitlines()[-1]
    assert caught.value.where == f"line {cut.count(chr(10)) + 1} column {len(last) + 1}"
    assert str(path) in str(caught.value)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('{"type": FeatureCollection}', "line 1 column 10: this is not valid JSON"),
        ('{"type": "Feat', "cut short"),
        ('{"type": "Feature"}\n{"type": "Feature"}', "line 2 column 1.*one FeatureCollection"),
        ("[" * 100_000, "nested too deeply"),
        ("[" + "1" * 5000 + "]", "a number has thousands of digits$"),
        ("[]", "this is a JSON array; a GeoJSON FeatureCollection"),
        ("3", "this is a JSON number"),
        ("{}", "JSON object without a type"),
        ('{"type": "Topology", "objects": {}}', "this is a Topology"),
        (json.dumps(point()), "this is a Feature on its own"),
        ('{"type": "FeatureCollection"}', "without a list of features"),
        ('{"type": "FeatureCollection", "features": {}}', "without a list of features"),
    ],
)
def test_no_feature_collection(read: Read, write: Write, text: str, message: str) -> None:
    with pytest.raises(LandmarkError, match=message):
        read(write("map.json", text))


def test_bytes_that_are_no_text(read: Read, write: Write) -> None:
    with pytest.raises(LandmarkError, match=r"not valid JSON: it is not UTF-8 text$"):
        read(write("map.json", b'{"type": "\xff\xff"}'))


# Bad features


def without(member: str) -> dict[str, Any]:
    return {key: value for key, value in point().items() if key != member}


def geometry(value: Any) -> dict[str, Any]:
    return {**point(), "geometry": value}


@pytest.mark.parametrize(
    ("feature", "message"),
    [
        (None, "is a JSON null, not a feature"),
        ([1, 2], "is a JSON array, not a feature"),
        (geometry(None), "has no geometry"),
        (without("geometry"), "has no geometry"),
        (geometry([1, 2]), "geometry is a JSON array"),
        (geometry({"type": "Polygon", "coordinates": []}), "a Polygon; .*centroid"),
        (geometry({"type": "MultiPolygon", "coordinates": []}), "a MultiPolygon; .*centroid"),
        (geometry({"type": "LineString", "coordinates": []}), "a LineString; .*points"),
        (geometry({"type": "MultiPoint", "coordinates": [[1, 2]]}), "a MultiPoint"),
        (geometry({"type": "GeometryCollection", "geometries": []}), "a GeometryCollection"),
        (geometry({"coordinates": [1, 2]}), "without a type"),
        (geometry({"type": "Point"}), "coordinates are null, not"),
        (geometry({"type": "Point", "coordinates": [1]}), r"coordinates are \[1\], not \[x, y\]"),
        (geometry({"type": "Point", "coordinates": 5}), "coordinates are 5"),
        (point("1", 2), 'coordinate is "1", not a number'),
        (point(1, None), "coordinate is null, not a number"),
        (point(True, 2), "coordinate is true, not a number"),
        (point(float("nan"), 2), r"\(nan, 2.0\) are not finite"),
        (point(1, float("-inf")), "not finite"),
        (point(10**400, 2), "not finite"),
        (point(1e10, 2), "farther than"),
        (without("properties"), "neither a class nor tags"),
        (point(name="x"), "neither a class nor tags"),
        (point(**{"class": None}), "neither a class nor tags"),
        (point(tags={}), "neither a class nor tags"),
        (point(**{"class": 5}), "class or tags are not text"),
        (point(**{"class": ["House"]}), "its class is a JSON array, not text"),
        (point(tags="building=house"), "its tags are a JSON text"),
        (point(tags={"building": ["house"]}), "class or tags are not text"),
        ({**point(), "properties": [1]}, "properties are a JSON array"),
        (point(**{"class": "House", "confidence": "high"}), 'confidence is "high", not a number'),
        (point(**{"class": "House", "confidence": True}), "confidence is true, not a number"),
        (point(**{"class": "House", "confidence": float("nan")}), "confidence nan is not above 0"),
        (point(**{"class": "House", "confidence": 0}), "confidence 0.0 is not above 0"),
        (point(**{"class": "House", "confidence": -0.1}), "confidence -0.1 is not above 0"),
        (point(**{"class": "House", "confidence": 1.01}), "confidence 1.01 is not .* at most 1"),
        (point(**{"class": "House", "time": "yesterday"}), "'yesterday' is not ISO 8601"),
        (point(**{"class": "House", "time": ["x"]}), "time is .* not text"),
        (point(**{"class": "House", "agent": {}}), "agent is {}, not text"),
        (point(**{"class": "House", "agent": "a\0"}), "characters that are no text"),
        ({**point(), "id": [1]}, r"id is \[1\], not text"),
        ({**point(), "id": "a\0"}, "is no text"),
        ({**point(), "id": "a" * 257}, "longer than 256"),
    ],
)
def test_a_bad_feature_is_named(read: Read, feature: Any, message: str) -> None:
    with pytest.raises(LandmarkError, match=message) as caught:
        read(metres(point(3, 4, **{"class": "Tree"}), feature))
    assert caught.value.where == "feature 1 (counted from 0)"
    assert caught.value.source == "GeoJSON"


def test_a_collection_with_a_name_is_called_by_it(read: Read) -> None:
    """The member ``name``, as GDAL writes it; what is no text is passed over."""
    bad = metres(point(3, 4, **{"class": "Tree", "time": ["x"]}))
    for name, told in (("Demo", "Demo"), ("", "GeoJSON"), (["x"], "GeoJSON")):
        with pytest.raises(LandmarkError) as caught:
            read({**bad, "name": name})
        assert caught.value.source == told


@pytest.mark.parametrize("others", [[], [point(1, building="house"), point(2)]])
def test_nothing_said_is_refused_unless_all_others_have_flat_tags(
    read: Read, others: list[Any]
) -> None:
    with pytest.raises(LandmarkError, match=f"feature {len(others)} .*neither a class nor tags"):
        read(metres(*others, point(name="x")))


def test_a_surrogate_in_an_unknown_class_can_be_printed(read: Read) -> None:
    unknown = read(metres(point(**{"class": "a\ud800"}))).report.unknown
    assert list(unknown) == ["a\ufffd"]


def test_a_long_unknown_class_is_shortened(read: Read) -> None:
    (shown,) = read(metres(point(**{"class": "x" * 1000}))).report.unknown
    assert len(shown) == 80


# Degrees, and systems of coordinates


@pytest.mark.parametrize(
    ("x", "y", "message"),
    [
        (-35.3, 149.1, "look swapped"),
        (47.1, 91.0, "look swapped"),
        (181.0, 12.0, "out of range for longitude and latitude in degrees$"),
        (699_000.0, 6_090_000.0, 'look like metres: add "crs_units": "m"'),
    ],
)
def test_out_of_range(read: Read, x: float, y: float, message: str) -> None:
    with pytest.raises(LandmarkError, match=message) as caught:
        read(degrees(point(9.5, 47.1), point(x, y)))
    assert caught.value.where == "feature 1 (counted from 0)"


def crs(name: Any) -> dict[str, Any]:
    return {"type": "name", "properties": {"name": name}}


@pytest.mark.parametrize(
    "name", ["urn:ogc:def:crs:OGC:1.3:CRS84", "EPSG:4326", "urn:ogc:def:crs:EPSG::4326"]
)
def test_the_old_crs_member_for_degrees(read: Read, name: str) -> None:
    plain = read(degrees(point(9.5, 47.1), point(9.51, 47.11)))
    named = read(degrees(point(9.5, 47.1), point(9.51, 47.11), crs=crs(name)))
    assert named.frame == plain.frame
    assert named.xy.tolist() == plain.xy.tolist()


def test_the_old_crs_member_for_another_system_is_converted(read: Read) -> None:
    """EPSG:3857 of 9.5 E, 47.1 N: x = a * lon, y = a * ln tan(45 deg + lat / 2)."""
    x = 6378137 * np.radians(9.5)
    y = 6378137 * np.log(np.tan(np.radians(45 + 47.1 / 2)))
    landmarks = read(degrees(point(x, y), point(x + 100, y), crs=crs("urn:ogc:def:crs:EPSG::3857")))
    assert landmarks.frame.geographic
    longitude, latitude = landmarks.frame.from_metres(landmarks.x, landmarks.y)
    assert longitude[0] == pytest.approx(9.5, abs=1e-9)
    assert latitude[0] == pytest.approx(47.1, abs=1e-9)
    # On the ground 100 m of Mercator are 100 cos(lat) m times N / a, 1.0018 here.
    assert landmarks.x[1] - landmarks.x[0] == pytest.approx(100 * 0.6807209 * 1.0018017, abs=1e-3)


@pytest.mark.parametrize(
    ("members", "message"),
    [
        ({"crs": crs("EPSG:999999")}, "unknown coordinate system 'EPSG:999999'"),
        ({"crs": crs(5)}, "does not name a coordinate system"),
        ({"crs": {"type": "link", "properties": {"href": "x"}}}, "does not name"),
        ({"crs": "EPSG:4326"}, "does not name"),
        ({"crs": crs("EPSG:5773")}, "not one of maps"),
        ({"crs": crs("EPSG:3857"), "crs_units": "m"}, "both crs_units and crs"),
        ({"crs_units": "km"}, 'crs_units is "km"; "m"'),
    ],
)
def test_unclear_systems_are_refused(read: Read, members: dict[str, Any], message: str) -> None:
    with pytest.raises(GeometryError, match=message):
        read(degrees(point(), **members))


@pytest.mark.parametrize("member", ["feature", "geometry"])
def test_mixed_systems_are_refused(read: Read, member: str) -> None:
    feature = point(5)
    (feature if member == "feature" else feature["geometry"])["crs"] = crs("EPSG:3857")
    with pytest.raises(GeometryError, match=r"GeoJSON: feature 1 .*one system"):
        read(degrees(point(), feature))


def test_the_option_overrides_the_file_and_says_so(read: Read) -> None:
    landmarks = read(metres(point(), bbox=None), crs="EPSG:4326")
    assert landmarks.frame.origin == (1, 2)
    assert landmarks.report.notes[0] == "coordinates were read as EPSG:4326; the file itself says m"


def test_the_option_is_no_surprise_where_the_file_says_nothing(read: Read) -> None:
    landmarks = read(degrees(point(1, 2), point(30, 40)), crs="m")
    assert landmarks.bbox == (1, 2, 30, 40)
    assert landmarks.report.notes == ()


@pytest.mark.parametrize("third", [7.5, None, "high", [1], {}])
def test_a_third_coordinate_is_ignored(read: Read, third: Any) -> None:
    feature = point(3, 4)
    feature["geometry"]["coordinates"].append(third)
    assert read(metres(feature)).xy.tolist() == [[3.0, 4.0]]


@pytest.mark.parametrize("key", ["id", "time", "agent", "class", "tags", "confidence"])
def test_huge_numbers_in_memory(read: Read, key: str) -> None:
    """Python refuses to write them out; files with such numbers are refused before."""
    huge = {"building": 10**5000} if key == "tags" else 10**5000
    with pytest.raises(LandmarkError) as caught:
        read(metres(point(**{"class": "House", key: huge})))
    assert "sys." not in str(caught.value)


@pytest.mark.parametrize("key", ["crs_units", "bbox", "surveyed"])
def test_huge_numbers_in_members(read: Read, key: str) -> None:
    with pytest.raises(GeometryError) as caught:
        read(metres(point(), **{key: 10**5000}))
    assert "sys." not in str(caught.value)


@pytest.mark.parametrize(
    ("label", "expected"), [("House", "House"), ("Unheard", "Tree"), ("", "Tree")]
)
def test_of_class_and_tags_the_class_wins_if_known(
    read: Read, names: Callable[[LandmarkMap], list[str]], label: str, expected: str
) -> None:
    feature = point(**{"class": label, "tags": {"natural": "tree"}})
    assert names(read(metres(feature))) == [expected]
