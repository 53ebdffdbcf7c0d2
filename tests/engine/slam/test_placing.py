"""Placing: resection is exact; robots are placed by names, by constellations, or not at all."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from symboslam.engine.slam.log import Floats
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


@given(PLACE, PLACE, st.floats(-3, 3), st.integers(2, 3))
def test_resection_by_ranges_and_bearings(x: float, y: float, turn: float, k: int) -> None:
    bearing, reach = seen_from((x, y, turn), MARKS[:k])
    assert_same(resection(MARKS[:k], bearing, reach), (x, y, turn))


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
    with pytest.raises(ValueError, match="needs two landmarks"):
        resection(MARKS[:1], np.zeros(1), np.ones(1))
    with pytest.raises(ValueError, match="needs three landmarks"):
        resection(MARKS[:2], np.zeros(2))
