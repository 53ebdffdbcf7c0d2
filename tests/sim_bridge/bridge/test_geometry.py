"""Geometry of sensors, by hand: boxes, bearings, ranges, footprints, tiles; no physics needed."""

from __future__ import annotations

import math

import numpy as np
import pytest

from symboslam.errors import InputError
from symboslam.sim_bridge.bridge.camera import Picture
from symboslam.sim_bridge.bridge.detections import Detection, SegDetector, boxes_of, get_detector
from symboslam.sim_bridge.bridge.footprints import Footprint, Footprints
from symboslam.sim_bridge.bridge.lidar import Scan
from symboslam.sim_bridge.bridge.odometry import Gps, WheelOdometry, noise_of
from symboslam.sim_bridge.bridge.ranging import bearing_of, foot_of, half_depth, measure, whole
from symboslam.sim_bridge.bridge.scene import in_view
from symboslam.sim_bridge.bridge.settings import CameraSpec, DetectorSpec, GpsSpec, OdometrySpec
from symboslam.sim_bridge.bridge.stock import Stock, model_of, scale_of
from symboslam.sim_bridge.worlds.world import Extent, World, WorldObject

SPEC = CameraSpec()


class FakeLidar:
    """Gives the ranges that it was told, whatever is asked."""

    def __init__(self, *ranges: float) -> None:
        self.ranges = ranges
        self.asked: tuple[float, float] = (0, 0)

    def between(self, pose: object, low: float, high: float) -> Scan:
        self.asked = low, high
        return Scan(np.zeros(len(self.ranges)), np.array(self.ranges, float))


def test_a_right_angle_of_view_makes_the_focal_length_half_the_width() -> None:
    assert SPEC.focal == pytest.approx(160)
    assert SPEC.intrinsics[0][2] == 160
    assert SPEC.intrinsics[1][2] == 120


def test_bearings_are_positive_to_the_left() -> None:
    assert bearing_of(160, SPEC) == 0
    assert bearing_of(0, SPEC) == pytest.approx(math.pi / 4)
    assert bearing_of(320, SPEC) == pytest.approx(-math.pi / 4)


def test_a_house_ahead_is_its_front_and_half_its_depth_away() -> None:
    # 7.5 m high at 30 m: 40 points; its foot is 1.5 * 160 / 30 = 8 points below the middle.
    house = Detection((140, 88, 180, 128), "House", 0.9)
    lidar = FakeLidar(30.0, 30.2, 30.4, 79.0, 12.0)  # a lamp post before it, a wall behind it
    found = measure(house, lidar, (0, 0, 0), SPEC)  # type: ignore[arg-type]
    assert found is not None
    assert found.bearing == 0
    # 7.55 m wide: narrower than the narrowest house, whose side of 10 m is 6 m from its middle
    depth, _ = half_depth("House", 7.55)
    assert 5.0 < depth <= 6.0
    assert found.range == pytest.approx(30.2 + depth)
    assert lidar.asked == pytest.approx((bearing_of(168, SPEC), bearing_of(152, SPEC)))


def test_how_wide_a_train_looks_tells_how_it_is_turned() -> None:
    """20 m x 2.9 m: from its end the middle is 10 m away, from its side 1.45 m."""
    end, side = half_depth("Train", 2.9), half_depth("Train", 20.0)
    assert end[0] == pytest.approx(10.0, abs=0.1)
    assert side[0] == pytest.approx(1.5, abs=0.1)
    between, spread = half_depth("Train", 9.0)
    assert side[0] < between < end[0]
    assert spread > max(end[1], side[1])


def test_round_things_look_the_same_from_all_sides() -> None:
    """A Tree is 5.5 m across: the nearest quarter of its rays is its front."""
    assert half_depth("Tree", 3.0) == half_depth("Tree", 8.0) == (2.75, 0.0)
    tree = Detection((150, 80, 170, 128), "Tree", 0.9)  # 9 m at 30 m: 48 points
    lidar = FakeLidar(28.0, 28.1, 30.0, 30.1, 30.2)
    found = measure(tree, lidar, (0, 0, 0), SPEC)  # type: ignore[arg-type]
    assert found is not None
    assert found.range == pytest.approx(28.1 + 2.75)


def test_what_stands_before_a_thing_takes_its_rays() -> None:
    """A bench stands lower in the picture, in the columns of the house's rays."""
    house = Detection((140, 88, 180, 128), "House", 0.9)
    bench = Detection((150, 120, 170, 132), "Bench", 0.9)
    aside = Detection((200, 120, 220, 132), "Bench", 0.9)
    free = measure(house, FakeLidar(24.0), (0, 0, 0), SPEC, [house, aside])  # type: ignore[arg-type]
    taken = measure(house, FakeLidar(24.0), (0, 0, 0), SPEC, [house, bench])  # type: ignore[arg-type]
    assert free is not None
    assert taken is not None
    assert math.isfinite(free.range)
    assert math.isnan(taken.range)


def test_deviations_grow_with_the_thing_and_its_angle() -> None:
    """A House is 10 m x 12 m: a tenth of 11 m is 1.1 m, and 1.1 / 35.7 of a radian."""
    house = Detection((140, 88, 180, 128), "House", 0.9)
    found = measure(house, FakeLidar(30.0), (0, 0, 0), SPEC)  # type: ignore[arg-type]
    assert found is not None
    depth, spread = half_depth("House", 7.5)
    assert found.range == pytest.approx(30 + depth)
    assert found.sigma == pytest.approx(
        (math.hypot(0.7, 1.1, spread), math.hypot(0.01, 1.1 / (30 + depth)))
    )


def test_what_has_no_range_has_no_deviation() -> None:
    house = Detection((140, 88, 180, 128), "House", 0.9)
    found = measure(house, FakeLidar(), (0, 0, 0), SPEC)  # type: ignore[arg-type]
    assert found is not None
    assert all(math.isnan(value) for value in (found.range, *found.sigma))


def test_one_turn_of_the_mount_sees_all_around() -> None:
    assert SPEC.field == pytest.approx(math.tau)
    assert CameraSpec(pan=(0.0,)).field == pytest.approx(math.pi / 2)
    assert CameraSpec(pan=(0.0, 0.5, -0.4)).field == pytest.approx(math.pi / 2 + 1)


def test_without_a_ray_the_foot_gives_the_range_of_what_is_near() -> None:
    near, far = foot_of(Detection((150, 110, 170, 144), "Bench", 0.9), SPEC)
    assert (near, far) == pytest.approx((240 / 25, 240 / 23))
    bench = Detection((150, 130, 170, 144), "Bench", 0.9)  # 0.9 m at 10 m: 14 points
    found = measure(bench, FakeLidar(math.inf), (0, 0, 0), SPEC)  # type: ignore[arg-type]
    assert found is not None
    assert found.range == pytest.approx(10.0 + half_depth("Bench", 1.25)[0], abs=0.05)
    far_away = Detection((150, 116, 170, 124), "Bus", 0.9)  # 60 m
    found = measure(far_away, FakeLidar(math.inf), (0, 0, 0), SPEC)  # type: ignore[arg-type]
    assert found is not None
    assert math.isnan(found.range)


def test_what_is_cut_at_the_sides_or_below_is_not_used() -> None:
    for box in ((0, 100, 30, 130), (290, 100, 320, 130), (100, 100, 130, 240)):
        assert not whole(box, SPEC)
        assert measure(Detection(box, "House", 0.9), FakeLidar(9.0), (0, 0, 0), SPEC) is None  # type: ignore[arg-type]
    assert whole((100, 0, 130, 130), SPEC)  # a tower does not fit


def test_boxes_are_read_off_the_segmentation() -> None:
    mask = np.full((20, 30), -1, np.int32)
    mask[5:9, 3:8] = 7
    mask[15, 20] = 4
    mask[0:2, 0:2] = 0  # the ground is no object
    assert boxes_of(mask, {7: "House", 4: "Cat"}) == [
        (4, (20, 15, 21, 16), 1),
        (7, (3, 5, 8, 9), 20),
    ]
    assert boxes_of(np.full((4, 4), -1, np.int32), {}) == []


def picture() -> Picture:
    mask = np.full((240, 320), -1, np.int32)
    for n in range(10):
        mask[100:130, 10 + 30 * n : 30 + 30 * n] = n + 1
    return Picture(np.zeros((240, 320, 3), np.uint8), mask, (1, 2, 3))


def test_the_oracle_errs_as_often_as_it_is_told() -> None:
    spec = DetectorSpec(misses=0.2, false_positives=0.5, confusion=0.1)
    detector = SegDetector(spec, ("House", "Tree", "Car"), np.random.default_rng(1))
    kinds = {n + 1: "House" for n in range(10)}
    found = [d for _ in range(400) for d in detector.detect(picture(), kinds)]
    real = [d for d in found if d.body is not None]
    assert len(real) / 4000 == pytest.approx(0.8, abs=0.03)
    assert np.mean([d.kind != "House" for d in real]) == pytest.approx(0.1, abs=0.02)
    assert (len(found) - len(real)) / 400 == pytest.approx(0.5, abs=0.12)
    assert all(0 < d.confidence <= 1 for d in found)


def test_the_oracle_sees_nothing_too_small_or_hidden() -> None:
    spec = DetectorSpec(misses=0, false_positives=0, confusion=0)
    detector = SegDetector(spec, ("House",), np.random.default_rng(1))
    mask = np.full((240, 320), -1, np.int32)
    mask[100:104, 10:60] = 1  # 4 points high
    mask[100:160, 100] = 2  # two posts of one fence, far apart: most of it is hidden
    mask[100:160, 150] = 2
    mask[100:160, 200:220] = 3
    seen = Picture(np.zeros((240, 320, 3), np.uint8), mask, (0, 0, 0))
    assert [d.body for d in detector.detect(seen, {1: "House", 2: "House", 3: "House"})] == [3]


def test_detectors_that_cannot_be_used_are_told() -> None:
    rng = np.random.default_rng(0)
    with pytest.raises(InputError, match="no model is installed"):
        get_detector("onnx", DetectorSpec(), (), rng)
    with pytest.raises(InputError, match="there are: seg, onnx"):
        get_detector("yolo", DetectorSpec(), (), rng)


def test_the_ground_is_painted_below_the_horizon() -> None:
    rgb = picture().rgb
    assert rgb[0, 0].tolist() == [0, 0, 0]
    assert rgb[239, 0].tolist() == [1, 2, 3]
    assert rgb[125, 20].tolist() == [0, 0, 0]


def test_circles_touch_boxes_and_circles() -> None:
    prints = Footprints()
    prints.add(3, Footprint(10, 0, math.pi / 2, 4, 1))  # 2 m along x, 8 m along y
    prints.add(5, Footprint(0, 10, 0, 2, 2, circle=True))
    assert prints.gaps(0, 0).tolist() == pytest.approx([9, 8])
    assert prints.gaps(10, 7).tolist()[0] == pytest.approx(3)
    assert prints.gaps(14, 8).tolist()[0] == pytest.approx(5)
    assert prints.touched(8.5, 0, 0.7) == 3
    assert prints.touched(8.5, 0, 0.4) is None
    assert prints.clearance(0, 11) == 0
    prints.remove(3)
    prints.remove(5)
    assert prints.touched(0, 0, 5) is None
    assert prints.clearance(0, 0) == math.inf


def world(*objects: WorldObject) -> World:
    return World("test", Extent(0, 0, 400, 400), objects)


def test_tiles_near_a_place_reckon_with_what_hangs_over() -> None:
    stock = Stock(world(WorldObject("a", "C17", 39, 20), WorldObject("b", "Cat", 350, 350)))
    assert stock.tiles == {(0, 0): [0], (8, 8): [1]}
    assert stock.tiles_near(95, 20, 20) == {(0, 0)}  # 55 m to the tile, 37 m of wings
    assert stock.tiles_near(110, 20, 20) == set()


def test_scales_and_models_are_few_and_the_same_each_time() -> None:
    thing = WorldObject("a", "House", 0, 0, scale=1.16)
    assert scale_of(thing) == pytest.approx(1.21)
    assert model_of(thing) == model_of(WorldObject("a", "House", 5, 5))
    assert model_of(WorldObject("a", "House", 0, 0, model="12")) == "12"
    assert int(model_of(WorldObject("a", "House", 0, 0, model="pretty"))) < 8


def test_in_view_is_a_cone_with_a_far_end_and_a_least_height() -> None:
    stock = Stock(world(WorldObject("h", "House", 200, 200), WorldObject("c", "Cat", 20, 200)))
    look = {"fov": math.pi / 2, "far": 80.0, "least": 5 / 160}
    assert in_view(stock, (150, 200, 0), **look)
    assert not in_view(stock, (150, 200, math.pi), **look)
    assert not in_view(stock, (100, 200, 0), **look)
    assert in_view(stock, (10, 200, 0), **look)
    assert not in_view(stock, (0, 200, 0), **look)  # the cat has 3 points at 20 m
    assert not in_view(Stock(world()), (0, 0, 0), **look)


def test_odometry_errs_as_in_the_simulated_missions() -> None:
    ends = []
    for seed in range(300):
        odometry = WheelOdometry((5, 5, 1), OdometrySpec(), np.random.default_rng(seed))
        for n in range(1, 41):  # 20 m in steps of half a metre, without a turn
            odometry.move((5 + n / 2 * math.cos(1), 5 + n / 2 * math.sin(1), 1))
        ends.append(odometry.pose)
    x, _, heading = np.array(ends).T
    assert x.mean() == pytest.approx(20, abs=0.1)
    assert x.std() == pytest.approx(math.hypot(20 * 0.01, 2 * 5 * 0.03), rel=0.2)
    drift = math.hypot(4 * math.radians(0.03), 2 * math.radians(0.6))
    assert heading.std() == pytest.approx(drift, rel=0.2)
    assert noise_of(OdometrySpec()).drift * 5 == pytest.approx(
        math.hypot(math.radians(0.6), math.radians(0.03))
    )


def test_a_robot_that_stands_has_no_odometry() -> None:
    odometry = WheelOdometry((5, 5, 1), OdometrySpec(), np.random.default_rng(0))
    assert odometry.move((5, 5, 1)) == (0, 0, 0)


def test_gps_has_a_rate_and_a_sigma() -> None:
    gps = Gps(GpsSpec(rate=1.0, sigma=3.0), np.random.default_rng(0))
    fixes = [gps.fix(n / 2, (10, 20, 0)) for n in range(2000)]
    given = np.array([fix for fix in fixes if fix is not None])
    assert len(given) == 1000
    assert given.std(0) == pytest.approx([3, 3], rel=0.1)
    assert given.mean(0) == pytest.approx([10, 20], abs=0.4)
