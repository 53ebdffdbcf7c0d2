"""EyeSim files: scenes, worlds and oracle files, sound and broken."""

import math
from pathlib import Path

import pytest

from symboslam.errors import InputError, WorldError
from symboslam.sim_bridge.worlds.eyesim import read_eyesim
from symboslam.sim_bridge.worlds.eyesim_names import class_of, group_of
from symboslam.sim_bridge.worlds.formats import read_any
from symboslam.sim_bridge.worlds.world import Wall

WLD = """width 20000
height 10000

floor_texture ../texture/town.png

#side walls
0 0 0 10000
0 10000 20000 10000
#5000 3000 3000 3000
"""
SIM = """# a test town
world ../worlds/town.wld
#settings VIS TRACE
settings VIS

object ../objects/house/house.esObj
######---- Environment Objects

# Objects - parks
Tree-A 2000 2000 90
Tree-B 2500 2400 0
swings 3000 2000 180
# Objects - parks

# Objects - buildings
bldg_01 9000 5000 45

# Objects - residential
House_V1 15000 2000 90
House_V12 17000 2000 90   # the last one
fence 16000 3000 0

# Robot placement
Labbot  700 300 90 ../agent/main.py 3
#LabBot 1500 7500 0 x
"""


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    (tmp_path / "worlds").mkdir()
    (tmp_path / "sims").mkdir()
    (tmp_path / "worlds" / "town.wld").write_text(WLD)
    path = tmp_path / "sims" / "town.sim"
    path.write_text(SIM)
    return path


def test_scene(scene: Path) -> None:
    world, notes = read_eyesim(scene)
    assert (world.extent.width, world.extent.height) == (20.0, 10.0)
    kinds = [o.kind for o in world.objects]
    assert kinds == ["Tree", "Tree", "Swingset", "OfficeBuilding", "House", "House"]
    house = world.objects[4]
    assert (house.x, house.y, house.model) == (15.0, 2.0, "House_V1")
    assert house.heading == pytest.approx(math.pi / 2)
    assert world.ground.name == "town"
    assert world.walls[0] == Wall(((0.0, 0.0), (0.0, 10.0)))
    assert len(world.walls) == 2
    assert {z.environment for z in world.zones} == {"ParksAndRecreation", "Residential"}
    assert "left out, no class of ours: fence (1)" in notes
    assert "zones are the ground nearest to 5 grouped objects" in notes


def test_scene_scaled_to_an_area(scene: Path) -> None:
    world, _ = read_eyesim(scene, area_km2=2.0)
    assert world.extent.area_km2 == pytest.approx(2.0)
    assert world.objects[0].x == pytest.approx(200)
    assert [v for s in world.starts for v in (s.x, s.y)] == pytest.approx([70, 30])


def test_zones_hold_the_objects_of_their_groups(scene: Path) -> None:
    world, _ = read_eyesim(scene, area_km2=2.0)
    found = world.environments_at(world.positions)
    assert found[0] == found[2] == "ParksAndRecreation"
    assert found[4] == found[5] == "Residential"


def test_missing_world_file_is_noted(scene: Path) -> None:
    (scene.parents[1] / "worlds" / "town.wld").unlink()
    world, notes = read_eyesim(scene)
    assert world.extent.width == 25.0
    assert any("town.wld is missing" in note for note in notes)


def test_world_file_alone(scene: Path) -> None:
    world, _ = read_any(scene.parents[1] / "worlds" / "town.wld")
    assert world.objects == ()
    assert len(world.starts) == 10


def test_oracle_file(tmp_path: Path) -> None:
    path = tmp_path / "oracle.txt"
    path.write_text("16 House 1698 8429 90\n57 Swwingset 100 200 0\n2 Tree 0 25000 90\n")
    world, _ = read_any(path, area_km2=6.6667)
    assert [o.kind for o in world.objects] == ["House", "Swingset", "Tree"]
    assert world.extent.area_km2 == pytest.approx(6.6667)
    assert world.objects[2].y == pytest.approx(world.extent.max_y, abs=0.001)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.sim", "", "the file is empty"),
        ("a.sim", "# nothing\n", "it places no object"),
        ("a.sim", "spaceship 1 2 3\n", r"it places no object: spaceship \(1\) is no class"),
        ("a.sim", "House 1 2\n", "line 1: expected x, y and degrees"),
        ("a.sim", "Tree 1 2 3\nHouse one 2 3\n", "line 2: 'one' is no number"),
        ("a.sim", "House nan 2 3\n", "line 1: 'nan' is no finite number"),
        ("a.txt", "1 House\n", "line 1: an oracle line is"),
        ("a.txt", "1 House x 2 3\n", "line 1: 'x' is no number"),
        ("a.wld", "width 0\n", "line 1: width 0 is no size"),
        ("a.wld", "width\n", "line 1: '' is no number"),
        ("a.wld", "0 0 1 1\n", "it places no object"),
    ],
)
def test_broken_files(name: str, text: str, message: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(WorldError, match=message):
        read_any(tmp_path / name)


def test_wrong_areas(scene: Path) -> None:
    with pytest.raises(WorldError, match="give one above 0"):
        read_eyesim(scene, area_km2=-1)
    with pytest.raises(InputError, match="an area is for EyeSim"):
        read_any("x.json", area_km2=1)
    with pytest.raises(InputError, match="what is it"):
        read_any("x.doc")


@pytest.mark.parametrize(
    ("name", "kind"),
    [
        ("House_V10", "House"), ("Tree-A", "Tree"), ("cat_v2", "Cat"), ("bus", "Bus"),
        ("bus_stop", "BusStop"), ("traffic_light_v2", "TrafficLight"),
        ("gas_station", "GasStation"),
        ("C17", "C17"), ("F15", "FighterJet"), ("Helo_V1", "Helicopter"), ("factory_v1", "Factory"),
        ("soldier_v2", "Person"), ("substation_v2", "PowerSubstation"), ("House0", "House"),
        ("OfficeBuilding", "OfficeBuilding"), ("missile_launcher", "MissileLauncher"),
        ("Store", "ConvenienceStore"), ("fence", None), ("", None),
    ],
)  # fmt: skip
def test_models(name: str, kind: str | None) -> None:
    assert class_of(name) == kind


def test_groups() -> None:
    assert group_of("# Objects - parks") == "ParksAndRecreation"
    assert group_of("#objects commercial ##") == "Commercial"
    assert group_of("# Objects - houses") is None
    assert group_of("# Robot placement") is None
