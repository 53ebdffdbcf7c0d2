"""Placing: resection is exact; robots are placed by names, by constellations, or not at all."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from symboslam.engine.slam.control import CollectiveMap
from symboslam.engine.slam.log import Floats, Measurements, Odometry, Pose, RobotLog
from symboslam.engine.slam.placing import resection
from symboslam.engine.slam.planar import between, wrap

MARKS = np.array([[0.0, 0], [10, 0], [3, 8]])
PLACE = st.floats(-20, 20)


def seen_from(pose: tuple[float, float, float], marks: Floats) -> tuple[Floats, Floats]:
    away = between(pose, np.column_stack([marks, np.zeros(len(marks))]))
    return np.arctan2(away[:, 1], away[:, 0]), np.hypot(away[:, 0], away[:, 1])


def assert_same(found: Floats, pose: tuple[float, float, float]) -> None:
    assert found[:2] == pytest.approx(pose[:2], abs=1e-4)
    assert float(wrap(found[2] - pose[2])) == pytest.approx(0, abs=1e-4)


def log_of(name: str, path: Floats, start: Pose | None, *, ranges: bool) -> RobotLog:
    """A robot that sees the marks all the time, and reads their signs."""
    rows = [
        (float(t), float(d) if ranges else math.nan, float(b), f"sign {n}")
        for t, pose in enumerate(path)
        for n, (b, d) in enumerate(zip(*seen_from(tuple(pose), MARKS), strict=True))
    ]
    time, reach, bearing, key = (np.array(column) for column in zip(*rows, strict=True))
    seen = Measurements(
        time, reach, bearing, np.zeros(len(rows), np.int64), np.full(len(rows), 0.9),
        key.astype(object), 0.1, 0.01,
    )  # fmt: skip
    odometry = Odometry(np.arange(len(path), dtype=float), between(path[0], path))
    return RobotLog(name, odometry, seen, start)


def test_a_lost_robot_is_placed_by_bearings_of_three_signs() -> None:
    path = np.array([(-6.0 + n, -4.0, 0.3) for n in range(8)])
    other = np.array([(12.0 - n, 12.0, -2.0) for n in range(8)])
    one = log_of("one", path, (-6.0, -4.0, 0.3), ranges=True)
    two = log_of("two", other, None, ranges=False)
    collective = CollectiveMap(["Sign"], np.array([False]), np.eye(1))
    collective.add_log(one)
    collective.add_log(two)
    found = collective.solve()
    assert len(found.landmarks) == 3
    for n, pose in enumerate(found.trajectories["two"].pose):
        assert pose[:2] == pytest.approx(other[n, :2], abs=0.2)
        assert float(wrap(pose[2] - other[n, 2])) == pytest.approx(0, abs=0.05)


@settings(deadline=None, max_examples=10)
@given(PLACE, PLACE, st.floats(-3, 3))
def test_resection_by_three_bearings(x: float, y: float, turn: float) -> None:
    # The circle through the three: from any place on it bearings are the same.
    (ax, ay), (bx, _), (cx, cy) = MARKS.tolist()
    mx = (ax + bx) / 2
    my = (cx**2 + cy**2 - 2 * cx * mx) / (2 * cy)
    radius = math.hypot(mx - ax, my - ay)
    assume(abs(math.hypot(x - mx, y - my) - radius) > 2)
    bearing, reach = seen_from((x, y, turn), MARKS)
    assume(reach.min() > 1)
    assert_same(resection(MARKS, bearing), (x, y, turn))


def test_too_few_landmarks_are_refused() -> None:
    with pytest.raises(ValueError, match="needs three landmarks"):
        resection(MARKS[:2], np.zeros(2))
