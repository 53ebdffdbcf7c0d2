"""The scene, the camera, the lidar and the robots in pybullet."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
import pytest

from symboslam.errors import InputError
from symboslam.sim_bridge.bridge.camera import Camera
from symboslam.sim_bridge.bridge.detections import boxes_of
from symboslam.sim_bridge.bridge.lidar import Lidar
from symboslam.sim_bridge.bridge.robots import Husky, KinematicCar, get_robot
from symboslam.sim_bridge.bridge.scene import KEEP, LOAD, Others, Scene
from symboslam.sim_bridge.bridge.settings import BridgeSettings, CameraSpec, LidarSpec
from symboslam.sim_bridge.bridge.stock import Stock
from symboslam.sim_bridge.objects import catalogue
from symboslam.sim_bridge.worlds.world import Extent, Wall, World, WorldObject

pytest.importorskip("pybullet", reason="pybullet is not installed: pip install 'symboslam[sim]'")

OBJECTS = (
    WorldObject("house", "House", 40, 20, model="0"),
    WorldObject("tree", "Tree", 20, 60, model="0"),
    WorldObject("court", "BasketballCourt", 60, 60, model="0"),
    WorldObject("far", "House", 600, 20, model="0"),
)
WORLD = World("test", Extent(0, 0, 800, 100), OBJECTS, walls=(Wall(((0, 90), (80, 90)), 2.0),))
BRIDGE = BridgeSettings()


@pytest.fixture
def scene() -> Iterator[Scene]:
    made = Scene(Stock(WORLD))
    made.follow([(10, 20)])
    yield made
    made.close()


def ids(scene: Scene) -> set[str]:
    return {scene.stock.objects[n].id for n in scene.object_of.values()}


def test_objects_come_and_go_with_the_robots(scene: Scene) -> None:
    assert ids(scene) == {"house", "tree", "court"}
    edge = 80 + 17 + LOAD  # the tile that ends at 80 m, and what hangs over
    assert KEEP > LOAD + 20
    scene.follow([(edge + 20, 20)])
    assert "house" in ids(scene)
    scene.follow([(600, 20)])
    assert ids(scene) == {"far"}
    scene.follow([(10, 20), (600, 20)])
    assert ids(scene) == {"house", "tree", "court", "far"}
    bodies = scene.bullet.getNumBodies(physicsClientId=scene.client)
    assert bodies == 2 + 4  # the plane and the wall


def test_a_mesh_that_fails_becomes_a_box_and_a_note(monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(model: object, draw: object) -> None:
        raise ValueError("no roof")

    monkeypatch.setitem(catalogue.BUILDERS, "House", fail)
    catalogue.shape.cache_clear()
    made = Scene(Stock(WORLD))
    made.follow([(10, 20)])
    made.follow([(600, 20)])
    made.follow([(10, 20)])
    assert ids(made) == {"house", "tree", "court"}
    assert len(made.notes) == 2
    assert made.notes[0].startswith("object 'house': a box stands for it: the model of House")
    assert made.solid.touched(40, 20, 0.5) is not None
    made.close()
    catalogue.shape.cache_clear()


def test_the_camera_sees_the_house_where_it_is(scene: Scene) -> None:
    camera = Camera(scene, CameraSpec())
    seen = camera.look((10, 20, 0))
    assert seen is not None
    body = next(b for b, n in scene.object_of.items() if n == 0)
    boxes = boxes_of(seen.segmentation, {body: "House"})
    (_, (left, _, right, bottom), _) = boxes[0]
    front = scene.stock.xy[0, 0] - 10 - 5  # about 5 m of half depth
    assert (left + right) / 2 == pytest.approx(160, abs=4)
    assert bottom - 120 == pytest.approx(1.5 * 160 / front, abs=2)
    assert camera.look((10, 20, math.pi)) is None
    assert (camera.drawn, camera.skipped) == (1, 1)


def test_the_lidar_hits_what_it_should(scene: Scene) -> None:
    lidar = Lidar(scene, LidarSpec(), np.random.default_rng(0), noise=0.0)
    scan = lidar.scan((10, 20, math.pi / 2))
    assert len(scan.bearing) == 361
    ahead = scan.range[180]
    assert ahead == pytest.approx(70 - 0.15, abs=0.05)  # the wall, over the court's edge
    house = lidar.between((10, 20, 0), -0.001, 0.001).range
    gap = scene.solid.gaps(10, 20)[scene.solid._numbers.index(_body(scene, 0))]
    assert house[0] == pytest.approx(gap, abs=0.05)
    assert math.isinf(lidar.between((60, 20, 0), -0.001, 0.001).range[0])
    assert len(lidar.scan((10, 20, 0), every=4).bearing) == 91


def _body(scene: Scene, number: int) -> int:
    return next(b for b, n in scene.object_of.items() if n == number)


def test_the_car_stops_at_a_house_and_can_leave(scene: Scene) -> None:
    car = KinematicCar("a", scene, (30, 20, 0), BRIDGE)
    for _ in range(20):
        car.drive(10, 0, 0.1)
    assert car.bumped
    assert scene.solid.clearance(*car.pose[:2]) >= BRIDGE.radius
    x = car.pose[0]
    car.drive(-5, 0, 0.1)
    assert not car.bumped
    assert car.pose[0] == pytest.approx(x - 0.5)
    car.drive(0, 99, 0.1)
    assert car.pose[2] == pytest.approx(BRIDGE.turn * 0.1)
    court = KinematicCar("b", scene, (60, 60, 0), BRIDGE)
    court.drive(10, 0, 0.1)
    assert not court.bumped  # it has only a floor
    assert not court.tipped


def test_other_robots_are_in_the_way(scene: Scene) -> None:
    others = Others(scene)
    others.show({"b": (13.0, 20.0, 0.0)})
    car = KinematicCar("a", scene, (10, 20, 0), BRIDGE)
    for _ in range(5):
        car.drive(10, 0, 0.1)
    assert car.bumped
    others.show({"b": (10.0, 50.0, 0.0)})
    car.drive(10, 0, 0.1)
    assert not car.bumped


def test_a_husky_drives_turns_tips_and_is_set_upright(scene: Scene) -> None:
    husky = Husky("h", scene, (10, 20, 0), BRIDGE)
    for _ in range(30):
        husky.drive(1.0, 0.0, 0.1)
    assert 1.5 < husky.pose[0] - 10 < 3.5
    assert abs(husky.pose[1] - 20) < 0.3
    for _ in range(10):
        husky.drive(0.0, 0.8, 0.1)
    assert 0.3 < husky.pose[2] < 1.3
    assert not husky.tipped
    assert not husky.bumped
    turned = scene.bullet.getQuaternionFromEuler((math.pi, 0, 0))
    scene.bullet.resetBasePositionAndOrientation(
        husky._body, (10, 20, 0.6), turned, physicsClientId=scene.client
    )
    husky.drive(0, 0, 0.3)
    assert husky.tipped
    husky.upright()
    husky.drive(0, 0, 0.3)
    assert not husky.tipped
    with pytest.raises(InputError, match="kinematic, husky"):
        get_robot("spot", "s", scene, (0, 0, 0), BRIDGE)


def test_a_husky_feels_a_wall(scene: Scene) -> None:
    husky = Husky("h", scene, (10, 88.6, math.pi / 2), BRIDGE)
    felt = False
    for _ in range(20):
        husky.drive(1.0, 0.0, 0.1)
        felt = felt or husky.bumped
    assert felt
    assert husky.pose[1] < 90
