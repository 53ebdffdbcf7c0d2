"""simulate: what a world says is what a mission has."""

from dataclasses import replace

import numpy as np
import pytest

from symboslam.engine.slam.log import ROBOT
from symboslam.engine.slam.planar import between
from symboslam.engine.slam.simulate import World, simulate

TINY = World(robots=2, poses=80, side=200.0, landmarks=40, classes=5, reach=60.0, known_starts=1)
EXACT = replace(
    TINY, sigma_range=0.0, sigma_bearing=0.0, way_noise=0.0, turn_noise=0.0, way_bias=0.0,
    turn_bias=0.0, misclassified=0.0,
)  # fmt: skip


def test_a_seed_gives_one_mission() -> None:
    one, again, other = simulate(TINY, 3), simulate(TINY, 3), simulate(TINY, 4)
    assert one.robots[0].seen.range.tolist() == again.robots[0].seen.range.tolist()
    assert one.robots[0].odometry.pose.tolist() == again.robots[0].odometry.pose.tolist()
    assert one.robots[0].odometry.pose.tolist() != other.robots[0].odometry.pose.tolist()


@pytest.mark.parametrize("wander", [False, True])
def test_without_noise_all_is_as_it_is(wander: bool) -> None:
    mission = simulate(replace(EXACT, wander=wander), 3)
    assert mission.truth is not None
    for log in mission.robots:
        path = mission.truth.trajectories[log.name][:, 1:]
        steps = between(path[:-1], path[1:])
        assert np.hypot(steps[:, 0], steps[:, 1]) == pytest.approx(5)
        driven = between(log.odometry.pose[:-1], log.odometry.pose[1:])
        assert driven == pytest.approx(steps, abs=1e-9)
        names = mission.identity[log.name]
        marks = np.array([mission.truth.landmarks[name] for name in names])
        at = path[log.seen.time.astype(int)]
        away = between(at, np.column_stack([marks, np.zeros(len(marks))]))
        assert log.seen.range == pytest.approx(np.hypot(away[:, 0], away[:, 1]))
        assert log.seen.bearing == pytest.approx(np.arctan2(away[:, 1], away[:, 0]), abs=1e-9)
        assert log.seen.range.max() < 60
        assert [mission.classes[f] for f in log.seen.feature] == [
            mission.truth.features[name] for name in names
        ]


def test_only_some_know_where_they_begin() -> None:
    one, other = simulate(TINY, 3).robots
    assert one.start is not None
    assert other.start is None


def test_robots_see_each_other_without_names() -> None:
    mission = simulate(replace(TINY, side=80.0, meetings=True), 3)
    seen = mission.robots[0].seen.feature == ROBOT
    assert seen.any()
    assert set(mission.identity["robot 1"][seen]) == {"robot 2"}
    assert set(mission.robots[0].seen.key) == {""}
    assert not (simulate(TINY, 3).robots[0].seen.feature == ROBOT).any()


def test_some_sightings_have_another_class() -> None:
    mission = simulate(replace(TINY, misclassified=0.3), 3)
    assert mission.truth is not None
    wrong = [
        mission.classes[f] != mission.truth.features[name]
        for log in mission.robots
        for f, name in zip(log.seen.feature, mission.identity[log.name], strict=True)
    ]
    assert 0.2 < np.mean(wrong) < 0.4


def test_in_a_world_of_one_class_nothing_is_mistaken() -> None:
    mission = simulate(replace(TINY, classes=1, misclassified=0.5), 3)
    assert mission.classes == ("class 1",)
    assert all((log.seen.feature == 0).all() for log in mission.robots)
    assert sum(len(log.seen) for log in mission.robots) > 50


def test_a_world_without_landmarks_has_no_sightings() -> None:
    mission = simulate(replace(TINY, landmarks=0), 3)
    assert [len(log.seen) for log in mission.robots] == [0, 0]
    assert [len(names) for names in mission.identity.values()] == [0, 0]


def test_names_are_read_where_landmarks_bear_them() -> None:
    plain, named = (
        simulate(replace(TINY, meetings=True, named=named), 3) for named in (False, True)
    )
    for log, other in zip(named.robots, plain.robots, strict=True):
        robots = log.seen.feature == ROBOT
        assert robots.any()
        assert log.seen.key[~robots].tolist() == named.identity[log.name][~robots].tolist()
        assert set(log.seen.key[robots]) == {""}
        assert set(other.seen.key) == {""}
        assert other.seen.range.tolist() == log.seen.range.tolist()
