"""The surveyed area of OpenStreetMap extracts: where there are objects, somebody looked."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest
import shapely

from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.readers.osm_ground import _Mask
from symboslam.errors import LandmarkError

Read = Callable[..., LandmarkMap]
Write = Callable[[str, Any], Path]
Places = Sequence[tuple[float, float]]

LATITUDE, LONGITUDE = 47.0, 9.0
NORTH, EAST = 1 / 111_195, 1 / 75_834
"""Degrees in a metre at 47 degrees north: 111.195 km, and 111.195 km times cos(47 degrees)."""


class Extract:
    """A small extract; places are in metres from its south-west corner."""

    def __init__(self, width: float, height: float) -> None:
        self.size = width, height
        self.nodes: list[str] = []
        self.ways: list[str] = []
        self.relations: list[str] = []

    def node(self, x: float, y: float, **tags: str) -> int:
        """Add a node; returns its id."""
        longitude, latitude = LONGITUDE + x * EAST, LATITUDE + y * NORTH
        number = len(self.nodes) + 1
        place = f'lon="{longitude:.7f}" lat="{latitude:.7f}"'
        self.nodes.append(f'<node id="{number}" version="1" {place}>{_tags(tags)}</node>')
        return number

    def way(self, places: Places, *missing: int, **tags: str) -> int:
        """Add a way with its nodes, and with nodes that the extract lacks; returns its id."""
        refs = [self.node(x, y) for x, y in places] + list(missing)
        if places[0] == places[-1] and not missing:
            refs[-1] = refs[0]
        number = len(self.ways) + 1
        members = "".join(f'<nd ref="{ref}"/>' for ref in refs)
        self.ways.append(f'<way id="{number}" version="1">{members}{_tags(tags)}</way>')
        return number

    def relation(self, way: int, **tags: str) -> None:
        """Add a relation of one way."""
        member = f'<member type="way" ref="{way}" role="outer"/>'
        number = len(self.relations) + 1
        text = f'<relation id="{number}" version="1">{member}{_tags(tags)}</relation>'
        self.relations.append(text)

    def text(self, bounds: bool = True) -> str:
        """The file."""
        width, height = self.size
        box = f'minlon="{LONGITUDE}" minlat="{LATITUDE}" maxlon="{LONGITUDE + width * EAST:.7f}"'
        box += f' maxlat="{LATITUDE + height * NORTH:.7f}"'
        content = "".join([*self.nodes, *self.ways, *self.relations])
        head = f"<bounds {box}/>" if bounds else ""
        return f'<?xml version="1.0"?><osm version="0.6">{head}{content}</osm>'


def _tags(values: dict[str, str]) -> str:
    return "".join(f'<tag k="{k.replace("__", ":")}" v="{v}"/>' for k, v in values.items())


def rectangle(west: float, south: float, east: float, north: float) -> Places:
    return [(west, south), (east, south), (east, north), (west, north), (west, south)]


def town(width: float = 6000, height: float = 6000) -> Extract:
    """Trees over the western 1000 m of the area, 200 m apart."""
    extract = Extract(width, height)
    for x in range(100, 1000, 200):
        for y in range(100, int(height), 200):
            extract.node(x, y, natural="tree")
    return extract


def seen(landmarks: LandmarkMap, x: float, y: float) -> bool:
    """Whether a place (metres from the south-west corner) counts as looked at."""
    if landmarks.surveyed is None:
        return True
    place = landmarks.frame.to_metres(LONGITUDE + x * EAST, LATITUDE + y * NORTH)
    return bool(shapely.contains_xy(landmarks.surveyed, *place))


@pytest.fixture
def survey(read: Read, write: Write) -> Callable[..., LandmarkMap]:
    def call(extract: Extract, **options: Any) -> LandmarkMap:
        return read(write("map.osm", extract.text()), **options)

    return call


Survey = Callable[..., LandmarkMap]


def test_open_sea_is_unknown(survey: Survey) -> None:
    landmarks = survey(town())
    assert landmarks.surveyed is not None
    assert shapely.is_valid(landmarks.surveyed)
    assert seen(landmarks, 500, 3000)
    assert seen(landmarks, 900 + 120, 3000)  # one cell of 125 m beyond that of the last tree
    assert not seen(landmarks, 900 + 255, 3000)
    assert not seen(landmarks, 5000, 3000)
    west, south, east, north = landmarks.bbox
    # The last trees stand at 900 m, in a cell that ends up to 125 m farther east: the share seen
    # is (1025 to 1150) / 6000, 17 to 19 %.
    share = landmarks.surveyed.area / ((east - west) * (north - south))
    assert 0.17 < share < 0.193
    (note,) = landmarks.report.notes
    assert (
        note
        == f"{100 * (1 - share):.0f} % of the area holds no object of the file and stays unknown"
    )


def test_an_area_full_of_objects_is_surveyed(survey: Survey) -> None:
    landmarks = survey(town(1000, 6000))
    assert landmarks.surveyed is None
    assert landmarks.report.notes == ()


def test_lines_count_over_all_their_length(survey: Survey) -> None:
    extract = town()
    extract.way([(1000, 3000), (5900, 3000)], highway="track")
    landmarks = survey(extract)
    assert seen(landmarks, 3500, 3100)
    assert not seen(landmarks, 3500, 3500)


@pytest.mark.parametrize(
    ("tags", "counted"),
    [
        ({"highway": "track"}, True),
        ({"natural": "coastline"}, True),
        ({"boundary": "administrative", "waterway": "river"}, True),
        ({"boundary": "administrative", "admin_level": "2"}, False),
        ({"boundary": "maritime"}, False),
        ({"route": "ferry"}, False),
        ({"power": "cable", "location": "underwater"}, False),
        ({"natural": "bay"}, False),
        ({"source": "survey"}, False),
        ({}, False),
    ],
)
def test_what_is_an_object(survey: Survey, tags: dict[str, str], counted: bool) -> None:
    extract = town()
    extract.way([(1000, 3000), (5900, 3000)], **tags)
    assert seen(survey(extract), 4000, 3050) is counted


@pytest.mark.parametrize(
    ("tags", "counted"),
    [
        ({"amenity": "bench"}, True),
        ({"place": "sea"}, False),
        ({"created_by": "an editor"}, False),
        ({}, False),
    ],
)
def test_nodes(survey: Survey, tags: dict[str, str], counted: bool) -> None:
    extract = town()
    extract.node(4000, 3000, **tags)
    assert seen(survey(extract), 4050, 3050) is counted


@pytest.mark.parametrize(
    ("tags", "counted"),
    [
        ({"type": "multipolygon", "landuse": "farmland"}, True),
        ({"type": "multipolygon"}, True),
        ({"type": "multipolygon", "natural": "bay"}, False),
        ({"type": "boundary", "boundary": "administrative"}, False),
    ],
)
def test_outlines_without_tags(survey: Survey, tags: dict[str, str], counted: bool) -> None:
    extract = town()
    extract.relation(extract.way(rectangle(3000, 3000, 3400, 3400)), **tags)
    assert seen(survey(extract), 3200, 3050) is counted


def test_large_fields_are_filled(survey: Survey) -> None:
    """A field of 3 km x 3 km has corners and nothing else."""
    extract = town()
    extract.way(rectangle(2500, 2500, 5500, 5500), landuse="farmland")
    landmarks = survey(extract)
    assert seen(landmarks, 4000, 4000)
    assert not seen(landmarks, 4000, 1500)


def test_a_field_that_the_edge_cuts_is_filled(survey: Survey) -> None:
    extract = town()
    extract.way(rectangle(4000, 2500, 7500, 5500), landuse="farmland")
    assert seen(survey(extract), 5900, 4000)


def test_a_bay_is_not_filled(survey: Survey) -> None:
    """Three sides of a square are open to the east."""
    extract = town()
    bay = [(5900, 2500), (2500, 2500), (2500, 5500), (5900, 5500)]
    extract.way(bay, natural="coastline")
    assert not seen(survey(extract), 4500, 4000)


def test_ways_with_missing_nodes(survey: Survey) -> None:
    """The nodes that are there count; none is as good as no way."""
    extract = town()
    extract.way([(3000, 3000), (3100, 3000)], 99_999, highway="track")
    extract.ways.append(
        '<way id="77" version="1"><nd ref="99998"/><tag k="highway" v="track"/></way>'
    )
    landmarks = survey(extract)
    assert seen(landmarks, 3050, 3100)
    assert not seen(landmarks, 4500, 3000)


def test_the_option_cuts_the_surveyed_area(survey: Survey) -> None:
    box = LONGITUDE, LATITUDE, LONGITUDE + 3000 * EAST, LATITUDE + 3000 * NORTH
    landmarks = survey(town(), bbox=box)
    assert landmarks.surveyed is not None
    assert landmarks.report.outside > 0
    (note,) = landmarks.report.notes
    assert 61 <= int(note.split()[0]) <= 66  # 1 - (1025 to 1150) / 3000
    assert shapely.box(*landmarks.bbox).buffer(5).covers(landmarks.surveyed)
    inside = LONGITUDE, LATITUDE, LONGITUDE + 900 * EAST, LATITUDE + 3000 * NORTH
    assert survey(town(), bbox=inside).surveyed is None


def test_every_landmark_lies_on_surveyed_ground(survey: Survey) -> None:
    landmarks = survey(town())
    assert landmarks.surveyed is not None
    assert len(landmarks) == 5 * 30
    assert shapely.contains_xy(landmarks.surveyed, landmarks.x, landmarks.y).all()


def test_an_extract_without_objects_is_all_unknown(survey: Survey) -> None:
    landmarks = survey(Extract(1000, 1000))
    assert len(landmarks) == 0
    assert landmarks.surveyed is not None
    assert landmarks.surveyed.is_empty
    assert landmarks.report.notes[0].startswith("100 % of the area")


def test_a_single_tree(read: Read, write: Write) -> None:
    """Without a box, the area is 100 m around it, all of it seen."""
    extract = Extract(1000, 1000)
    extract.node(500, 500, natural="tree")
    assert read(write("map.osm", extract.text(bounds=False))).surveyed is None


def test_a_file_that_is_gone_in_between(
    read: Read, write: Write, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write("map.osm", town().text())
    clear = _Mask.__init__

    def remove(self: _Mask, *arguments: Any) -> None:
        path.unlink()
        clear(self, *arguments)

    monkeypatch.setattr(_Mask, "__init__", remove)
    with pytest.raises(LandmarkError, match=r"map\.osm: this is not readable OpenStreetMap data"):
        read(path)


@pytest.mark.parametrize(
    "box", [(-180, -90, 180, 90), (0, 40, 30, 60), (9, 47, 9.0001, 60), (0, 89.99, 180, 90)]
)
def test_the_mask_stays_small(box: tuple[float, float, float, float]) -> None:
    mask = _Mask(box)
    assert mask.seen.size <= 4100**2
    mask.add([(box[0], box[1]), (box[2], box[3])], [])
    ground = mask.ground()
    assert shapely.contains_xy(ground, box[0], box[1])
    assert shapely.contains_xy(ground, box[2], box[3])


def test_monaco(shared: Path, read: Read) -> None:
    """The Mediterranean is unknown, the town is not."""
    landmarks = read(shared / "data" / "osm" / "monaco.osm.pbf")
    assert landmarks.surveyed is not None
    places = {"open sea": (7.445, 43.728), "Casino": (7.428, 43.739), "harbour": (7.424, 43.735)}
    found = {
        name: shapely.contains_xy(landmarks.surveyed, *landmarks.frame.to_metres(*place))
        for name, place in places.items()
    }
    assert found == {"open sea": False, "Casino": True, "harbour": True}
    assert len(shapely.get_rings(landmarks.surveyed)) == 1


def test_helsinki_is_surveyed_throughout(shared: Path, read: Read) -> None:
    assert read(shared / "data" / "osm" / "helsinki.osm.pbf").surveyed is None


def test_the_strip_around_the_last_objects_is_narrow(survey: Survey) -> None:
    """One cell beyond the object's own: at least 125 m, at most 250 m."""
    extract = town()
    extract.way([(1000, 3000), (5900, 3000)], natural="coastline")
    landmarks = survey(extract)
    assert seen(landmarks, 3500, 3120)
    assert not seen(landmarks, 3500, 3255)


def test_gaps_in_a_town_are_closed(survey: Survey) -> None:
    """Between streets 240 m apart, and in a block of 1 km that streets enclose."""
    extract = town()
    for y in (1000, 1240, 2240):
        extract.way([(1000, y), (5000, y)], highway="residential")
    for x in (1000, 5000):
        extract.way([(x, 1000), (x, 2240)], highway="residential")
    landmarks = survey(extract)
    assert seen(landmarks, 3000, 1120)
    assert seen(landmarks, 3000, 1740)
