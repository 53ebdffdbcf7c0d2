"""Arcs, chains, and poses at any time."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symboslam.engine.slam.odometry import arcs, chain, pose_at
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
