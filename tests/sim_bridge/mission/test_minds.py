"""Driving, targets, trouble and coverage, by hand; no physics needed."""

from __future__ import annotations

import math

import numpy as np
import pytest

from symboslam.sim_bridge.bridge.lidar import Scan
from symboslam.sim_bridge.mission.driver import BRAKE, ahead, command, heading_for
from symboslam.sim_bridge.mission.mission import formula
from symboslam.sim_bridge.mission.targets import Targets
from symboslam.sim_bridge.mission.trouble import STILL, TRIES, Watch
from symboslam.sim_bridge.search.area import Area


def scan(**ranges: float) -> Scan:
    """A scan of 91 rays; ``d30=5`` is 5 m at 30 degrees to the left, ``m`` stands for minus."""
    bearing = np.radians(np.linspace(-90, 90, 91))
    found = np.full(91, math.inf)
    for name, value in ranges.items():
        degrees = -int(name[2:]) if name[1] == "m" else int(name[1:])
        found[(degrees + 90) // 2] = value
    return Scan(bearing, found)


def test_free_ground_is_driven_straight_at_top_speed() -> None:
    assert command(None, 0.0, 100.0, 10.0, 0.7) == (10.0, 0.0)
    assert command(scan(), 0.0, 100.0, 10.0, 0.7) == (10.0, 0.0)


def test_a_robot_that_looks_elsewhere_turns_on_the_spot() -> None:
    speed, turn = command(None, math.pi * 0.75, 100.0, 10.0, 0.7)
    assert speed == 0
    assert turn > 1.5


def test_it_passes_a_post_on_the_side_of_the_goal() -> None:
    post = scan(d2=5)
    bearing, free = heading_for(post, 0.0, 0.7, 20.0)
    assert free
    assert -0.4 < bearing < -math.asin(1.3 / 5) + math.radians(3)
    assert heading_for(post, 0.0, 0.7, 4.0) == (0.0, True)  # too far to matter


def test_it_brakes_in_time() -> None:
    assert ahead(scan(d0=9), 0.0, 0.7) == pytest.approx(8.3)
    assert ahead(scan(d30=3), 0.0, 0.7) == math.inf
    speed, _ = command(None, 0.0, 2.0, 10.0, 0.7)
    assert speed == pytest.approx(math.sqrt(2 * BRAKE * 2))
    assert command(None, 0.3, -1.0, 10.0, 0.7)[0] == 0


def test_in_a_narrow_place_it_goes_where_most_room_is() -> None:
    walls = Scan(np.radians(np.linspace(-90, 90, 91)), np.full(91, 1.0))
    walls.range[70] = 8.0
    bearing, free = heading_for(walls, 0.0, 0.7, 20.0)
    assert free
    assert bearing == pytest.approx(math.radians(50))


def test_targets_are_things_seen_twice_and_not_yet_ranged_twice() -> None:
    targets = Targets()
    house = targets.see("House", 50, 0, 50, False)
    assert targets.nearest((0, 0), 60, []) is None  # one picture may err
    assert targets.see("House", 53, 2, 48, False) is house
    assert targets.nearest((0, 0), 60, []) is house
    assert targets.nearest((0, 0), 40, []) is None
    assert targets.nearest((0, 0), 60, [(55, 5)]) is None  # another robot's
    assert targets.see("Factory", 51, 1, 40, True) is house  # a wrong class is no new thing
    assert (house.x, house.y) == (51, 1)
    targets.see("House", 51, 1, 40, True)
    assert house.mapped
    assert targets.nearest((0, 0), 60, []) is None


def test_targets_are_given_up_and_the_nearest_comes_first() -> None:
    targets = Targets()
    for n in range(100):
        for _ in range(2):
            targets.see("Tree", 100.0 * n, 0, 10, False)
    near = targets.nearest((210, 0), 500, [])
    assert near is not None
    assert near.x == 200
    near.spent = 99
    again = targets.nearest((210, 0), 500, [])
    assert again is not None
    assert again.x == 300


def test_a_robot_that_stands_still_is_stuck_and_in_the_end_given_up() -> None:
    watch = Watch()
    found = [watch.check(n / 2, (0.0, 0.0), True, False) for n in range(200)]
    told = [f for f in found if f is not None]
    assert found.index(told[0]) / 2 == STILL
    assert [f.kind for f in told] == ["stuck"] * TRIES + ["given up"]
    assert watch.given_up


def test_a_robot_that_waits_or_gets_on_is_not_stuck() -> None:
    watch = Watch()
    assert all(watch.check(n, (0.0, 0.0), False, False) is None for n in range(100))
    watch = Watch()
    assert all(watch.check(n, (0.5 * n, 0.0), True, False) is None for n in range(100))


def test_trouble_in_another_place_counts_anew() -> None:
    watch = Watch()
    for n in range(20):
        finding = watch.check(n, (10.0 * n, 0.0), True, True)
        assert finding is not None
        assert finding.kind == "tipped"


def test_the_paper_s_formula_for_coverage() -> None:
    area = Area((0, 0, 400, 400), ((1, 1, 0), (2, 2, 0)), 10.0, 60.0, math.pi / 2)
    width = 2 * 60 * math.sin(math.pi / 4)
    assert formula(area, 10) == pytest.approx(2 * 10 * width * 10 / 160_000)
    assert formula(area, 1e6) == 1
