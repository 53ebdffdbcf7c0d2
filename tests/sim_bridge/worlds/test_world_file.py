"""World files: round trips, and every way in which one can be wrong."""

import json
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symboslam.errors import OutputError, WorldError
from symboslam.sim_bridge.worlds.generator import world_by_name
from symboslam.sim_bridge.worlds.sizes import CLASSES
from symboslam.sim_bridge.worlds.world import (
    Extent,
    Ground,
    Road,
    Start,
    Wall,
    World,
    WorldObject,
    Zone,
)
from symboslam.sim_bridge.worlds.world_file import document_of, read_world, world_of, write_world

BOW = [[0, 0], [9, 9], [9, 0], [0, 9], [0, 0]]
SQUARE = [[0, 0], [50, 0], [50, 50], [0, 50], [0, 0]]


def document(**members: Any) -> dict[str, Any]:
    """A small sound world, with some members replaced."""
    return {
        "format": "symboslam-world",
        "version": 1,
        "name": "small",
        "extent": [0, 0, 100, 100],
        "zones": [{"environment": "Residential", "polygon": [SQUARE]}],
        "objects": [
            {"id": "a", "class": "House", "x": 20, "y": 20},
            {"id": "b", "class": "Tree", "x": 60, "y": 60, "heading": 1.5, "scale": 0.8},
        ],
        **members,
    }


def one(**members: Any) -> dict[str, Any]:
    """A document with a single object, with some members replaced."""
    return document(objects=[{"id": "a", "class": "House", "x": 20, "y": 20, **members}])


@pytest.mark.parametrize("name", ["demo", "city"])
def test_generated_world_round_trip(name: str, tmp_path: Path) -> None:
    world = world_by_name(name)
    write_world(world, tmp_path / "w.json")
    assert read_world(tmp_path / "w.json") == (world, ())


number = st.floats(-1e5, 1e5, allow_nan=False)
point = st.tuples(number, number)
name = st.text(min_size=1).filter(lambda text: text.strip() != "" and _whole(text))


def _whole(text: str) -> bool:
    try:
        return bool(text.encode())
    except UnicodeEncodeError:
        return False


objects = st.lists(
    st.builds(
        WorldObject, id=name, kind=st.sampled_from(CLASSES), x=number, y=number, z=number,
        heading=number, scale=st.floats(1e-3, 100), model=st.none() | name, name=st.none() | name,
    ),
    max_size=5, unique_by=lambda o: o.id,
)  # fmt: skip
lines = st.lists(point, min_size=2, max_size=4).map(tuple)
worlds = st.builds(
    World,
    name=name,
    extent=st.builds(
        lambda x, y, w, h: Extent(x, y, x + w, y + h),
        number, number, st.floats(1, 1e5), st.floats(1, 1e5),
    ),
    objects=objects.map(tuple),
    zones=st.lists(
        st.builds(
            lambda e, x, y, s: Zone(e, (((x, y), (x + s, y), (x, y + s), (x, y)),)),
            name, number, number, st.floats(1, 1e4),
        ),
        max_size=3,
    ).map(tuple),
    roads=st.lists(st.builds(Road, lines, st.floats(0.1, 50)), max_size=3).map(tuple),
    walls=st.lists(st.builds(Wall, lines, st.floats(0.1, 50)), max_size=2).map(tuple),
    ground=st.builds(Ground, name, st.from_regex(r"#[0-9a-f]{6}", fullmatch=True)),
    attribution=st.just("") | name,
)  # fmt: skip


@settings(max_examples=60)
@given(worlds)
def test_any_world_round_trip(world: World) -> None:
    text = json.dumps(document_of(world), allow_nan=False)
    assert world_of(json.loads(text))[0] == world


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (b"", "the file is empty"),
        (b"  \n", "the file is empty"),
        (b'{"format": "symboslam-world", "version"', "line 1, column 40: no JSON"),
        (b"\xff\xfe{}", "not UTF-8 at byte 0"),
        (b"[" * 100_000, "no JSON that can be a world"),
        (b"[]", 'does not say "format"'),
        (b'{"type": "FeatureCollection"}', 'does not say "format"'),
    ],
)
def test_files_that_are_no_worlds(text: bytes, message: str, tmp_path: Path) -> None:
    path = tmp_path / "w.json"
    path.write_bytes(text)
    with pytest.raises(WorldError, match=message) as caught:
        read_world(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_files_that_cannot_be_read_or_written(tmp_path: Path) -> None:
    with pytest.raises(WorldError, match="No such file"):
        read_world(tmp_path / "none.json")
    with pytest.raises(WorldError, match="Is a directory"):
        read_world(tmp_path)
    with pytest.raises(OutputError):
        write_world(world_by_name("demo"), tmp_path / "none" / "w.json")


@pytest.mark.parametrize(
    ("given_document", "message"),
    [
        (document(version=2), r"version: 2: only version 1"),
        (document(version=True), r"version: True: only version 1"),
        (document(name=""), r"name: '' is no text"),
        (document(colour="red"), r"colour: there is no such member"),
        (document(extent=[0, 0, 0, 100]), r"extent: 0 m x 100 m is no area"),
        (document(extent=[0, 0, -5, 100]), r"extent: -5 m x 100 m is no area"),
        (document(extent=[0, 0, 100]), r"extent: .*give finite numbers \[min_x"),
        (document(extent=[0, 0, 1, float("nan")]), r"extent: .*give finite numbers"),
        (document(extent=[0, 0, 1, 1e300]), r"extent: .*not within 1e\+08 m"),
        (document(extent=None), r"extent: nothing"),
        (document(ground={"colour": "green"}), r"ground\.colour: 'green' is no colour"),
        (document(objects={}), r"objects: \{\} is no list"),
        (document(objects=[1]), r"objects\[0\]: 1 is no JSON object"),
        (one(x=float("nan")), r"objects\[0\]\.x: nan is no finite number"),
        (one(y=float("inf")), r"objects\[0\]\.y: inf is no finite number"),
        (one(x=10**400), r"objects\[0\]\.x: 1000.* is no finite number"),
        (one(x="12"), r"objects\[0\]\.x: '12' is no finite number"),
        (one(x=True), r"objects\[0\]\.x: True is no finite number"),
        (one(x=None), r"objects\[0\]\.x: nothing"),
        (one(x=1e9), r"objects\[0\]\.x: 1e\+09 is not between"),
        (one(scale=0), r"objects\[0\]\.scale: 0 is not between"),
        (one(id=""), r"objects\[0\]\.id: '' is no text"),
        (one(kind="House"), r"objects\[0\]\.kind: there is no such member; there are: id, class"),
        (document(objects=[{"id": "a", "class": "Car", "x": 1, "y": 1}] * 2),
         r"objects\[1\]\.id: 'a' is also the id of objects\[0\]"),
        (document(zones=[{"environment": "Residential", "polygon": []}]),
         r"zones\[0\]\.polygon: give a list of rings"),
        (document(zones=[{"environment": "Residential", "polygon": [SQUARE[:4]]}]),
         r"zones\[0\]\.polygon\[0\]: the ring is not closed"),
        (document(zones=[{"environment": "R", "polygon": [BOW]}]),
         r"zones\[0\]\.polygon: no valid polygon: Self-intersection"),
        (document(zones=[{"environment": "R", "polygon": [[[0, 0], [9, 0], [5, 0], [0, 0]]]}]),
         r"zones\[0\]\.polygon: no valid polygon"),
        (document(zones=[{"environment": "R", "polygon": [[[0, 0], [9], [9, 9], [0, 0]]]}]),
         r"zones\[0\]\.polygon\[0\]\[1\]: \[9\] is no point"),
        (document(zones=[{"polygon": [SQUARE]}]), r"zones\[0\]\.environment: nothing"),
        (document(roads=[{"points": [[0, 0]]}]), r"roads\[0\]\.points: give a list of at least 2"),
        (document(roads=[{"points": [[0, 0], [1, 1]], "width": -1}]), r"roads\[0\]\.width: -1"),
        (document(starts=[{"x": 0}]), r"starts\[0\]\.y: nothing"),
    ],
)  # fmt: skip
def test_parts_that_are_wrong(given_document: dict[str, Any], message: str) -> None:
    with pytest.raises(WorldError, match=message) as caught:
        world_of(given_document, "w.json")
    assert str(caught.value).startswith("w.json: ")


def test_unknown_classes_are_told_at_once() -> None:
    kinds = ["Hose", "House", "Spaceship", "Hose"]
    given_objects = [
        {"id": str(i), "class": kind, "x": 10 * i, "y": 9} for i, kind in enumerate(kinds)
    ]
    with pytest.raises(WorldError) as caught:
        world_of(document(objects=given_objects))
    assert "'Hose' (2 objects, did you mean House or Horse?)" in str(caught.value)
    assert "'Spaceship' (1 object)" in str(caught.value)


def test_names_of_classes_are_forgiving() -> None:
    world, _ = world_of(one(**{"class": "UnspecifiedBuilding"}))
    assert world.objects[0].kind == "Building"
    world, _ = world_of(one(**{"class": "busstop"}))
    assert world.objects[0].kind == "BusStop"


def test_odd_things_are_noted() -> None:
    places = [(20, 20), (22, 20), (80, 80), (200, 20)]
    given_objects = [
        {"id": str(i), "class": "House", "x": x, "y": y} for i, (x, y) in enumerate(places)
    ]
    zones = [
        {"environment": "Residential", "polygon": [SQUARE]},
        {"environment": "Commercial", "polygon": [[[40, 40], [120, 40], [120, 90], [40, 40]]]},
    ]
    world, notes = world_of(document(objects=given_objects, zones=zones))
    assert len(world.objects) == 4
    assert notes == (
        "1 object outside the extent, such as '3'",
        "1 pair of objects overlap, such as '0' (House) and '1' (House)",
        "1 pair of zones overlap: the smaller zone counts there",
        "1 zone beyond the extent",
    )


def test_objects_above_each_other_do_not_overlap() -> None:
    given_objects = [
        {"id": "a", "class": "House", "x": 20, "y": 20},
        {"id": "b", "class": "Helicopter", "x": 20, "y": 20, "z": 30},
    ]
    assert world_of(document(objects=given_objects))[1] == ()


def test_starts_inside_objects_are_moved_out() -> None:
    starts = [{"x": 20, "y": 20, "heading": 1.0}, {"x": 90, "y": 10}, {"x": -7, "y": 50}]
    world, notes = world_of(document(starts=starts))
    assert world == world_of(document(starts=starts))[0]
    assert world.starts[0].heading == 1.0
    house = world.objects[0]
    assert abs(world.starts[0].y - house.y) > 6.0 or abs(world.starts[0].x - house.x) > 5.0
    assert world.starts[1] == Start(90, 10)
    assert world.extent.has(world.starts[2].x, world.starts[2].y)
    assert [note.split(" was")[0] for note in notes] == ["start 0", "start 2"]


def test_starts_without_any_free_place_are_refused() -> None:
    given_document = document(
        extent=[0, 0, 8, 8],
        zones=[],
        objects=[{"id": "a", "class": "Factory", "x": 4, "y": 4}],
        starts=[{"x": 4, "y": 4}],
    )
    with pytest.raises(WorldError, match=r"starts\[0\]: no free place"):
        world_of(given_document)


def test_robots_do_not_start_in_each_other() -> None:
    world, notes = world_of(document(starts=[{"x": 90, "y": 10}] * 3))
    assert len({(s.x, s.y) for s in world.starts}) == 3
    assert len(notes) == 2


def test_large_files_are_read(tmp_path: Path) -> None:
    count = 30_000
    given_objects = tuple(
        WorldObject(str(i), "Person", float(i % 300) * 3, float(i // 300) * 3) for i in range(count)
    )
    write_world(World("large", Extent(0, 0, 1000, 1000), given_objects), tmp_path / "w.json")
    world, notes = read_world(tmp_path / "w.json")
    assert len(world.objects) == count
    assert notes == ()


def test_environments_that_are_none_of_ours_are_noted() -> None:
    zones = [{"environment": name, "polygon": [SQUARE]} for name in ("Moon", "Military")]
    _, notes = world_of(document(objects=[], zones=zones[:1]))
    assert [note for note in notes if "'Moon'" in note and "Residential" in note]
    _, notes = world_of(document(objects=[], zones=zones[1:]))
    assert not [note for note in notes if "none of ours" in note]
