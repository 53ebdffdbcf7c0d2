"""Steering: straight and curved drives, ways around obstacles, robots that are stuck."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symboslam.errors import InputError
from symboslam.sim_bridge.search.area import Circle, Floats
from symboslam.sim_bridge.search.steering import Drive, Pose, Stuck, advance, steer
from symboslam.sim_bridge.search.swarm import Goal

NOTHING: Floats = np.empty((0, 2))
CAR = Drive(10.0, turn_rate=0.8, clearance=2.0, look=25.0)


def drive(
    goal: Goal, points: Floats, ticks: int, tick: float = 0.2, car: Drive = CAR
) -> list[Pose]:
    pose: Pose = (0.0, 0.0, 0.0)
    poses = [pose]
    for _ in range(ticks):
        pose = advance(pose, *steer(pose, goal, CAR, points, tick), tick)
        poses.append(pose)
    return poses


def test_straight_ahead() -> None:
    assert steer((0, 0, 0), Goal(100, 0), CAR, NOTHING, 1.0) == (10.0, 0.0)
    assert steer((0, 0, 0), Goal(3, 0), CAR, NOTHING, 1.0) == (3.0, 0.0)
    assert steer((0, 0, 0), Goal(0, 0), CAR, NOTHING, 1.0) == (0.0, 0.0)


def test_turns_the_shorter_way() -> None:
    assert steer((0, 0, 3.0), Goal.along(-3.0), CAR, NOTHING, 0.1)[1] == pytest.approx(0.8)
    assert steer((0, 0, 0), Goal(0, -50), CAR, NOTHING, 0.1)[1] == pytest.approx(-0.8)


def test_an_arc() -> None:
    x, y, heading = advance((0, 0, 0), 10.0, math.pi / 2, 1.0)
    radius = 10 / (math.pi / 2)
    assert (x, y, heading) == pytest.approx((radius, radius, math.pi / 2))
    assert advance((0, 0, 0), -2.0, 0.0, 1.0)[0] == pytest.approx(-2)


@given(st.floats(-200, 200), st.floats(-200, 200), st.floats(-math.pi, math.pi))
def test_reaches_its_goal_and_keeps_its_limits(x: float, y: float, heading: float) -> None:
    pose: Pose = (0.0, 0.0, heading)
    for _ in range(400):
        speed, turn = steer(pose, Goal(x, y), CAR, NOTHING, 0.2)
        assert 0 <= speed <= 10
        assert abs(turn) <= 0.8
        pose = advance(pose, speed, turn, 0.2)
    assert math.dist(pose[:2], (x, y)) < 0.5


def test_a_car_does_not_turn_on_the_spot() -> None:
    car = Drive(10.0, turn_radius=8.0)
    speed, turn = steer((0, 0, 0), Goal(-50, 0), car, NOTHING, 0.2)
    assert speed > 0
    assert abs(turn) <= speed / 8 + 1e-12


def test_drives_around_an_obstacle() -> None:
    wall = Circle(40, 0, 8).outline(0.5)
    poses = drive(Goal(80, 0), wall, 100)
    gaps = [np.hypot(*(wall - pose[:2]).T).min() for pose in poses]
    assert min(gaps) > 0.9 * CAR.clearance
    assert math.dist(poses[-1][:2], (80, 0)) < 1


def test_walled_in_it_stays() -> None:
    ring = Circle(0, 0, 3).outline(0.3)
    poses = drive(Goal(80, 0), ring, 50)
    assert max(math.hypot(*pose[:2]) for pose in poses) < 2.0


def test_a_stuck_robot_recovers_then_gives_up() -> None:
    watcher = Stuck(progress=1.0, patience=5.0, back=2.0, turn=2.0, tries=2)
    advice = [watcher.watch(float(t), (0, 0, 0), Goal(50, 0)) for t in range(40)]
    assert advice[:6] == ["go"] * 6
    assert advice[6:10] == ["back", "back", "turn", "turn"]
    assert advice.count("give up") >= 1
    assert advice.index("give up") < 30


def test_a_robot_that_gets_on_is_left_alone() -> None:
    watcher = Stuck(progress=1.0, patience=5.0)
    assert {watcher.watch(t, (2.0 * t, 0, 0), Goal(500, 0)) for t in range(100)} == {"go"}
    assert watcher.watch(100, (0, 0, 0), None) == "go"


def test_a_goal_that_is_circled_around_is_given_up() -> None:
    watcher = Stuck(progress=1.0, patience=5.0)
    advice = [
        watcher.watch(t, (20 * math.cos(t / 3), 20 * math.sin(t / 3), 0), Goal(0, 0))
        for t in range(60)
    ]
    assert "give up" in advice


def test_bad_input() -> None:
    with pytest.raises(InputError, match="speed"):
        Drive(0)
    with pytest.raises(InputError, match="turn_radius"):
        Drive(1, turn_radius=-1)
    with pytest.raises(InputError, match="not finite"):
        steer((math.nan, 0, 0), Goal(1, 1), CAR, NOTHING, 1.0)
    with pytest.raises(InputError, match="patience"):
        Stuck(1.0, patience=0)
