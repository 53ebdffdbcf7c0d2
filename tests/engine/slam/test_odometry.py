"""Arcs, chains, poses at any time, and the map by odometry alone."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symboslam.engine.slam.log import ROBOT, Measurements, Mission, Odometry, RobotLog
from symboslam.engine.slam.odometry import arcs, chain, dead_reckoned, pose_at
from symboslam.engine.slam.planar import between, compose

HALF = np.pi / 2
number = st.floats(-5, 5, allow_nan=False)


def test_arcs_by_hand() -> None:
    """Straight on; a quarter circle of radius 1 to the left and the right; a turn on the spot."""
    steps = arcs(
        np.array([2.0, HALF, HALF, 0.0]),
        np.array([0.0, HALF, -HALF, 3.0]),
        np.array([0.5, 1, 1, 1]),
    )
    assert steps == pytest.approx(np.array([[1, 0, 0], [1, 1, HALF], [1, -1, -HALF], [0, 0, 3]]))


def test_a_full_circle_ends_where_it_began() -> None:
    steps = arcs(np.full(8, 0.4), np.full(8, np.pi / 4), np.ones(8))
    assert chain((3, 4, 1), steps)[-1] == pytest.approx([3, 4, 1])


@given(st.lists(st.tuples(number, number, number), min_size=1, max_size=8))
def test_chain_is_composition(steps: list[tuple[float, float, float]]) -> None:
    found = chain((1, 2, 3), np.array(steps))
    pose = np.array([1.0, 2, 3])
    for i, step in enumerate(steps):
        pose = compose(pose, step)
        assert np.abs(between(pose, found[i + 1])) == pytest.approx(np.zeros(3), abs=1e-9)


def test_pose_between_two_goes_the_short_way_round() -> None:
    time, pose = np.array([0.0, 2]), np.array([[0, 0, 3.0], [2, 4, -3.0]])
    assert pose_at(time, pose, 1.0)[:2] == pytest.approx([1, 2])
    assert abs(pose_at(time, pose, 1.0)[2]) == pytest.approx(np.pi)
    assert pose_at(time, pose, [-1, 5]) == pytest.approx(pose)


def mission(start: tuple[float, float, float] | None) -> Mission:
    """Drives 2 m ahead, turns left; sees "a" 1 m ahead twice, a thing of no name, and a robot."""
    seen = Measurements(
        time=np.array([0.0, 2, 2, 2]),
        range=np.array([3.0, 1, 1, 1]),
        bearing=np.array([0.0, -HALF, 0, 0]),
        feature=np.array([0, 0, 1, ROBOT]),
        confidence=np.array([0.5, 0.7, 1, 1]),
        key=np.array(["a", "a", "", "R2"], object),
    )
    pose = np.array([[1.0, 1, 0], [2, 1, 0], [3, 1, HALF]])
    log = RobotLog("R1", Odometry(np.array([0.0, 1, 2]), pose), seen, start)
    return Mission((log,), ("Tree", "Car"), np.array([False, True]), np.eye(2))


def test_dead_reckoning_by_hand() -> None:
    found = dead_reckoned(mission((10.0, 0.0, HALF)))
    path = found.trajectories["R1"].pose
    assert path[:, :2] == pytest.approx(np.array([[10, 0], [10, 1], [10, 2]]))
    assert np.abs(path[:, 2]) == pytest.approx(np.array([HALF, HALF, np.pi]))
    marks = found.landmarks
    assert marks.id.tolist() == marks.key.tolist() == ["a"]
    assert marks.xy == pytest.approx(np.array([[10, 3]]))
    assert (marks.sightings[0], marks.confidence[0], marks.dynamic[0]) == (2, 0.7, False)
    assert found.landmark_of["R1"].tolist() == [0, 0, -1, -1]
    assert found.doubts


def test_without_a_start_it_begins_at_the_origin() -> None:
    found = dead_reckoned(mission(None), every=1.5)
    path = found.trajectories["R1"]
    assert path.time.tolist() == [0, 2]
    assert path.pose == pytest.approx(np.array([[0, 0, 0], [2, 0, HALF]]))
    assert any("no start is known of R1" in note for note in found.notes)
