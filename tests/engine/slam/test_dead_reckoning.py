"""The map by odometry alone."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from symboslam.engine.slam.dead_reckoning import dead_reckoned
from symboslam.engine.slam.log import ROBOT, Measurements, Mission, Odometry, RobotLog
from symboslam.errors import InputError

HALF = np.pi / 2


def mission(start: tuple[float, float, float] | None) -> Mission:
    """Drives 2 m ahead, turns left; sees "a" twice, a thing without a key, a robot, a bearing."""
    seen = Measurements(
        time=np.array([0.0, 2, 2, 2, 2]),
        range=np.array([3.0, 1, 1, 1, np.nan]),
        bearing=np.array([0.0, -HALF, 0, 0, 0]),
        feature=np.array([0, 0, 1, ROBOT, 1]),
        confidence=np.array([0.5, 0.7, 1, 1, 1]),
        key=np.array(["a", "a", "", "R2", ""], object),
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
    assert marks.id.tolist() == ["a", "R1-2"]
    assert marks.key.tolist() == ["a", ""]
    assert marks.xy == pytest.approx(np.array([[10, 3], [9, 2]]))
    assert marks.sightings.tolist() == [2, 1]
    assert marks.confidence.tolist() == [0.7, 1]
    assert marks.dynamic.tolist() == [False, True]
    assert found.landmark_of["R1"].tolist() == [0, 0, 1, -1, -1]
    assert found.doubts
    assert found.notes[1:] == (
        "sightings without a key, each a landmark of its own: 1",
        "sightings with a range or a bearing alone, which place nothing: 1",
    )


def test_without_a_start_it_begins_at_the_origin() -> None:
    found = dead_reckoned(mission(None), every=1.5)
    path = found.trajectories["R1"]
    assert path.time.tolist() == [0, 2]
    assert path.pose == pytest.approx(np.array([[0, 0, 0], [2, 0, HALF]]))
    assert any("no start is known of R1" in note for note in found.notes)


def test_by_identity_the_truth_says_what_is_one() -> None:
    """Rows 0 and 2 are of one thing; of row 1 it is not known."""
    known = replace(mission((10.0, 0.0, HALF)), identity={"R1": np.array(["x", "", "x", "", "x"])})
    found = dead_reckoned(known, by="identity")
    assert found.landmarks.id.tolist() == ["x"]
    assert found.landmarks.key.tolist() == [""]
    assert found.landmarks.xy == pytest.approx(np.array([[9.5, 2.5]]))
    assert found.landmark_of["R1"].tolist() == [0, -1, 0, -1, -1]
    with pytest.raises(InputError, match="dead reckoning by identity"):
        dead_reckoned(mission(None), by="identity")


def test_lost_robots_are_left_out_if_so_asked() -> None:
    lost, known = mission(None).robots[0], replace(mission((0, 0, 0)).robots[0], name="R2")
    one = dead_reckoned(replace(mission(None), robots=(lost, known)), lost="left out")
    assert list(one.trajectories) == ["R2"]
    assert one.landmark_of["R1"].tolist() == [-1] * 5
    assert one.notes[-1] == "robot R1: left out, as it is not known where it began"
    assert list(dead_reckoned(mission(None), lost="left out").trajectories) == ["R1"]


def test_without_odometry_there_is_nothing() -> None:
    log = mission(None).robots[0]
    empty = replace(log, odometry=Odometry(np.zeros(0), np.zeros((0, 3))))
    found = dead_reckoned(replace(mission(None), robots=(empty,)), every=1)
    assert len(found.landmarks) == len(found.trajectories["R1"].time) == 0
