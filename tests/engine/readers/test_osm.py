"""OpenStreetMap: which elements are landmarks, where, and what damaged files are told."""

from __future__ import annotations

import bz2
import gzip
import io
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import osmium
import pytest

from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.readers import osm
from symboslam.errors import GeometryError, LandmarkError, SymboSlamError

Read = Callable[..., LandmarkMap]
Write = Callable[[str, Any], Any]
Names = Callable[[LandmarkMap], list[str]]

# A square of about 111 m x 76 m with its corners 1 .. 4, a smaller one 5 .. 8 inside it.
CORNERS = {
    1: (9.000, 47.000), 2: (9.001, 47.000), 3: (9.001, 47.001), 4: (9.000, 47.001),
    5: (9.0002, 47.0002), 6: (9.0004, 47.0002), 7: (9.0004, 47.0004), 8: (9.0002, 47.0004),
}  # fmt: skip
SQUARE, HOLE = (1, 2, 3, 4, 1), (5, 6, 7, 8, 5)


def tags(values: dict[str, str]) -> str:
    return "".join(f'<tag k="{key}" v="{value}"/>' for key, value in values.items())


def node(number: int, longitude: float, latitude: float, **values: str) -> str:
    position = f'id="{number}" version="1" lon="{longitude}" lat="{latitude}"'
    return f"<node {position}>{tags(values)}</node>"


def way(number: int, refs: tuple[int, ...], **values: str) -> str:
    nodes = "".join(f'<nd ref="{ref}"/>' for ref in refs)
    return f'<way id="{number}" version="1">{nodes}{tags(values)}</way>'


def multipolygon(number: int, outer: int, inner: int, **values: str) -> str:
    members = f'<member type="way" ref="{outer}" role="outer"/>'
    members += f'<member type="way" ref="{inner}" role="inner"/>'
    values = {"type": "multipolygon", **values}
    return f'<relation id="{number}" version="1">{members}{tags(values)}</relation>'


def xml(*elements: str, bounds: str = "", tagged: dict[int, dict[str, str]] | None = None) -> str:
    """A file with the corner nodes, of which some are ``tagged``, and other elements."""
    own = tagged or {}
    corners = [node(i, x, y, **own.get(i, {})) for i, (x, y) in CORNERS.items()]
    ranks = ("<node", "<way", "<relation")
    ordered = sorted([*corners, *elements], key=lambda e: next(
        rank for rank, start in enumerate(ranks) if e.startswith(start)
    ))  # fmt: skip
    return f'<?xml version="1.0"?><osm version="0.6">{bounds}{"".join(ordered)}</osm>'


BOX = (9.0, 47.0, 9.001, 47.001)


def test_nodes_and_areas(read: Read, write: Write, names: Names) -> None:
    text = xml(
        node(11, 9.0005, 47.0006, natural="tree", name="Old Oak"),
        node(12, 9.0006, 47.0006, name="no key of a feature"),
        way(21, SQUARE, building="house"),
        way(22, HOLE, building="yes"),
    )
    landmarks = read(write("map.osm", text), bbox=BOX)
    assert landmarks.report.attribution == "© OpenStreetMap contributors, ODbL 1.0"
    assert dict(zip(landmarks.id.tolist(), names(landmarks), strict=True)) == {
        "n11": "Tree", "w21": "House", "w22": "Building",
    }  # fmt: skip
    longitude, latitude = landmarks.frame.from_metres(landmarks.x, landmarks.y)
    at = {name: (x, y) for name, x, y in zip(landmarks.id, longitude, latitude, strict=True)}
    assert at["n11"] == pytest.approx((9.0005, 47.0006), abs=1e-9)
    assert at["w21"] == pytest.approx((9.0005, 47.0005), abs=1e-9)
    assert at["w22"] == pytest.approx((9.0003, 47.0003), abs=1e-9)


def test_a_multipolygon_is_one_landmark_outside_its_hole(
    read: Read, write: Write, names: Names
) -> None:
    text = xml(way(21, SQUARE), way(22, HOLE), multipolygon(31, 21, 22, building="yes"))
    landmarks = read(write("map.osm", text), bbox=BOX)
    assert (landmarks.id.tolist(), names(landmarks)) == (["r31"], ["Building"])
    ((longitude,), (latitude,)) = landmarks.frame.from_metres(landmarks.x, landmarks.y)
    assert 9.0 < longitude < 9.001
    assert 47.0 < latitude < 47.001
    assert not (9.0002 <= longitude <= 9.0004 and 47.0002 <= latitude <= 47.0004)


@pytest.mark.parametrize(
    ("refs", "values", "taken"),
    [
        (SQUARE, {"building": "yes"}, True),
        (SQUARE, {"building": "yes", "landuse": "forest"}, True),
        (SQUARE, {"landuse": "forest"}, False),
        ((1, 2, 3, 4), {"building": "yes"}, False),
        ((1, 2, 3), {"barrier": "fence"}, False),
        (SQUARE, {"barrier": "fence"}, False),
        (SQUARE, {"barrier": "fence", "area": "yes"}, True),
        (SQUARE, {"barrier": "fence", "building": "house"}, True),
        (SQUARE, {"highway": "residential"}, False),
        (SQUARE, {"building": "yes", "area": "no"}, False),
        (SQUARE, {"name": "x"}, False),
    ],
)
def test_lines_and_land_use_are_no_landmarks(
    read: Read, write: Write, refs: tuple[int, ...], values: dict[str, str], taken: bool
) -> None:
    landmarks = read(write("map.osm", xml(way(21, refs, **values))), bbox=BOX)
    assert landmarks.id.tolist() == (["w21"] if taken else [])
    assert landmarks.report.unknown == {}


def test_tree_rows_and_platforms(read: Read, write: Write) -> None:
    """A closed row of trees is a line and not counted; a platform is an area and unknown here."""
    text = xml(way(21, SQUARE, natural="tree_row"), way(22, HOLE, highway="platform"))
    assert read(write("map.osm", text), bbox=BOX).report.unknown == {"highway=platform": 1}


def test_land_use_on_a_node_is_taken_as_it_is_said(read: Read, write: Write, names: Names) -> None:
    text = xml(node(11, 9.0005, 47.0006, landuse="forest"))
    assert names(read(write("map.osm", text), bbox=BOX)) == ["Forest"]


def test_unknown_tags_of_known_keys_are_counted(read: Read, write: Write) -> None:
    text = xml(
        node(11, 9.0005, 47.0006, natural="spring", note="cold"),
        node(12, 9.0006, 47.0006, natural="spring", tourism="viewpoint"),
        way(21, SQUARE, natural="water"),
    )
    report = read(write("map.osm", text), bbox=BOX).report
    assert report.unknown == {"natural=spring": 2, "natural=water": 1}
    assert report.read == 0


def test_a_corner_that_repeats_its_building_is_left_out(read: Read, write: Write) -> None:
    text = xml(
        node(11, 9.0005, 47.0005, building="house"),
        way(21, SQUARE, building="house", name="x"),
        tagged={1: {"building": "house"}, 2: {"natural": "tree"}, 3: {"building": "yes"}},
    )
    landmarks = read(write("map.osm", text), bbox=BOX)
    assert landmarks.id.tolist() == ["n2", "n3", "n11", "w21"]
    assert landmarks.report.notes[0].startswith("1 nodes repeat the tags of the area")


def test_batches_make_no_difference(
    read: Read, write: Write, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write("map.osm", xml(*(way(20 + i, SQUARE, building="yes") for i in range(5))))
    whole = read(path, bbox=BOX)
    monkeypatch.setattr(osm, "_BATCH", 2)
    pieces = read(path, bbox=BOX)
    assert pieces.id.tolist() == whole.id.tolist() == [f"w{20 + i}" for i in range(5)]
    assert pieces.xy.tolist() == whole.xy.tolist()


# The area


def bounds(west: float, south: float, east: float, north: float) -> str:
    return f'<bounds minlon="{west}" minlat="{south}" maxlon="{east}" maxlat="{north}"/>'


TREES = [node(100 + i, 9 + i / 1e4, 47 + (7 * i % 10) / 1e4, natural="tree") for i in range(10)]


@pytest.mark.parametrize(
    ("box", "used"),
    [
        ((8.9995, 46.9995, 9.002, 47.002), True),
        ((8.9999, 46.9999, 9.0008, 47.002), True),
        ((9.0, 47.0, 9.00045, 47.001), True),
        ((9.0, 47.0, 9.00035, 47.001), False),
        ((8.99, 46.99, 9.01, 47.01), False),
        ((-180, -90, 180, 90), False),
        ((20, 20, 21, 21), False),
        ((9.002, 47.0, 9.001, 47.0), False),
    ],
)
def test_the_files_own_box(read: Read, write: Write, box: Any, used: bool) -> None:
    landmarks = read(write("map.osm", xml(*TREES, bounds=bounds(*box))))
    expected = box if used else (9.0, 47.0, 9.0009, 47.0009)
    centre = (expected[0] + expected[2]) / 2, (expected[1] + expected[3]) / 2
    assert landmarks.frame.origin == pytest.approx(centre, abs=1e-9)


def test_without_a_box_the_extent_counts(read: Read, write: Write) -> None:
    landmarks = read(write("map.osm", xml(*TREES)))
    assert landmarks.frame.origin == pytest.approx((9.00045, 47.00045), abs=1e-9)
    assert len(landmarks) == 10


def test_the_option_beats_the_files_box(read: Read, write: Write) -> None:
    path = write("map.osm", xml(*TREES, bounds=bounds(8.999, 46.999, 9.002, 47.002)))
    landmarks = read(path, bbox=(9.0, 47.0, 9.00045, 47.001))
    assert (len(landmarks), landmarks.report.outside) == (5, 5)


def test_nothing_of_interest(read: Read, write: Write) -> None:
    with pytest.raises(GeometryError, match="no landmarks and no area"):
        read(write("map.osm", xml()))
    assert len(read(write("map.osm", xml(bounds=bounds(*BOX))))) == 0


def test_another_system_is_refused(read: Read, write: Write) -> None:
    path = write("map.osm", xml(*TREES))
    assert len(read(path, crs="EPSG:4326")) == 10
    with pytest.raises(GeometryError, match="always in OGC:CRS84, it cannot be EPSG:3857"):
        read(path, crs="EPSG:3857")


# Formats and damage


@pytest.fixture
def packed(write: Write, tmp_path: Path) -> dict[str, Path]:
    """The same map in every format."""
    text = xml(*TREES, way(21, SQUARE, building="yes"))
    plain = write("map.osm", text)
    binary = tmp_path / "map.osm.pbf"
    with osmium.SimpleWriter(str(binary)) as writer:
        for element in osmium.FileProcessor(str(plain)):
            writer.add(element)
    return {
        "xml": plain,
        "gz": write("map.osm.gz", gzip.compress(text.encode())),
        "bz2": write("map.osm.bz2", bz2.compress(text.encode())),
        "pbf": binary,
    }


@pytest.mark.parametrize("name", ["xml", "gz", "bz2", "pbf"])
def test_formats(read: Read, packed: dict[str, Path], name: str) -> None:
    expected = read(packed["xml"])
    for source in (packed[name], io.BytesIO(packed[name].read_bytes())):
        landmarks = read(source)
        assert landmarks.id.tolist() == expected.id.tolist()
        assert landmarks.xy == pytest.approx(expected.xy)
    other = packed[name].rename(packed[name].with_name("map.dat"))
    assert len(read(other, format="osm")) == 11


@pytest.mark.parametrize("name", ["xml", "gz", "bz2", "pbf"])
def test_cut_files(read: Read, packed: dict[str, Path], name: str) -> None:
    path = packed[name]
    path.write_bytes(path.read_bytes()[:-60])
    with pytest.raises(LandmarkError, match=f"{path.name}: this is not readable OpenStreetMap"):
        read(path)


@pytest.mark.parametrize("content", [b"<html></html>", b"class,x,y\n", b"\0\0\0\r\n\tOSMHeader"])
def test_other_content(read: Read, write: Write, content: bytes) -> None:
    with pytest.raises(LandmarkError, match="this is not readable OpenStreetMap data"):
        read(write("map.osm.pbf", content))


def test_empty_file(read: Read, write: Write) -> None:
    with pytest.raises(LandmarkError, match="the file is empty"):
        read(write("map.osm.pbf", b""))


def test_without_pyosmium(read: Read, write: Write, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "osmium", None)
    with pytest.raises(SymboSlamError, match=r"map\.osm: the package osmium, .* cannot be loaded"):
        read(write("map.osm", xml(*TREES)))


# Elements without a place

LOST = "could not be placed: their nodes are missing or out of range"


def test_elements_without_a_place_are_counted(read: Read, write: Write) -> None:
    text = xml(
        node(11, 9.0005, 47.0006, natural="tree"),
        node(12, 9.0005, 147.0, natural="tree"),
        node(13, 9.0005, 147.0, name="no key of a feature"),
        way(21, (1, 2, 99, 4, 1), building="yes"),
        way(22, (1, 2, 99, 4, 1), landuse="forest"),
        way(23, (1, 2, 99, 4, 1), building="yes", area="no"),
        way(24, (1, 2, 99, 4), building="yes"),
        way(25, (1, 2, 99, 4, 1), name="no key of a feature"),
        way(26, SQUARE, building="yes"),
        multipolygon(31, 26, 98, building="house"),
    )
    landmarks = read(write("map.osm", text), bbox=BOX)
    assert landmarks.id.tolist() == ["n11", "w26"]
    assert landmarks.report.notes[0] == f"3 elements {LOST}"  # n12, w21, r31


def test_an_outline_that_crosses_itself_is_counted_once(read: Read, write: Write) -> None:
    text = xml(*TREES, way(21, (1, 3, 2, 4, 1), building="yes"))
    notes = read(write("map.osm", text), bbox=BOX).report.notes
    assert notes[0] == "1 areas have no usable outline: left out"
    assert not any(LOST in note for note in notes)


def test_elements_with_a_place_are_not_remarked_on(read: Read, write: Write) -> None:
    text = xml(way(21, SQUARE), way(22, HOLE), multipolygon(31, 21, 22, building="yes"), *TREES)
    assert not any(LOST in note for note in read(write("map.osm", text), bbox=BOX).report.notes)


def swapped(*elements: str) -> str:
    """Corners near Melbourne with latitude and longitude swapped, and other elements."""
    corners = [node(i, -37 + y - 47, 144 + x - 9) for i, (x, y) in CORNERS.items()]
    return f'<?xml version="1.0"?><osm version="0.6">{"".join([*corners, *elements])}</osm>'


@pytest.mark.parametrize(
    "elements",
    [
        [node(11, -37, 144, natural="tree")],
        [way(21, SQUARE, building="yes")],
        [way(21, SQUARE, name="no key of a feature")],
        [node(11, -37, 144, natural="tree"), way(21, SQUARE, building="yes")],
    ],
)
def test_swapped_coordinates_are_refused(read: Read, write: Write, elements: list[str]) -> None:
    path = write("map.osm", swapped(*elements))
    for options in ({}, {"bbox": BOX}):
        with pytest.raises(LandmarkError, match=r"all \d+ nodes are out of range.* look swapped"):
            read(path, **options)


def test_a_lone_building_without_its_nodes_is_no_swap(read: Read, write: Write) -> None:
    landmarks = read(write("map.osm", xml(way(21, (1, 2, 99, 4, 1), building="yes"))), bbox=BOX)
    assert len(landmarks) == 0
    assert landmarks.report.notes[0] == f"1 elements {LOST}"


def test_coordinates_that_are_no_numbers(read: Read, write: Write) -> None:
    text = xml(*TREES).replace('lat="47.0007"', 'lat="250"', 1)
    with pytest.raises(LandmarkError, match=r"not readable OpenStreetMap data.*'250'"):
        read(write("map.osm", text))
