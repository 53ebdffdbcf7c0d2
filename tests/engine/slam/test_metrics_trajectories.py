"""ATE and RPE: evo's numbers, and what can be computed by hand."""

from __future__ import annotations

import json
import runpy
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symboslam.engine.slam.planar import compose
from symboslam.engine.slam.trajectory_error import (
    Delta,
    associate,
    pairs_of,
    relative_errors,
    score_trajectory,
)
from symboslam.errors import InputError

HERE = Path(__file__).parent
# Made by scripts/evo_numbers.py with evo 1.38.1: APE and RPE (consecutive pairs, pairs by the
# estimate) of paths in a plane, associated with max_diff 0.01, `align` without scale.
EVO = json.loads((HERE / "evo_numbers.json").read_text())
PATHS = runpy.run_path(str(HERE.parents[2] / "scripts" / "evo_numbers.py"))["paths"]
seconds = st.lists(st.floats(0, 100), max_size=30).map(lambda v: np.array(sorted(v), float))


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize("delta", ["1f", "7f", "1m", "5.5m"])
def test_numbers_are_those_of_evo(seed: int, delta: str) -> None:
    found, truth = PATHS(seed)
    score = score_trajectory(found[:, 0], found[:, 1:], truth, delta=Delta.parse(delta))
    golden = EVO[str(seed)]
    assert score.poses == golden["poses"]
    for name, mine in (
        ("ate", score.ate),
        ("ate_raw", score.ate_raw),
        (f"rpe_m {delta}", score.rpe_translation),
        (f"rpe_rad {delta}", score.rpe_rotation),
    ):
        assert mine is not None
        assert asdict(mine) == pytest.approx(golden[name], rel=0, abs=1e-9), name


def test_by_hand() -> None:
    time = np.arange(3.0)
    truth = np.column_stack([time, [[0, 0, 0], [1, 0, 0], [2, 0, 0]]])
    pose = np.array([[0, 0, 0], [1, 3, 0], [2, 0, 0.5]], float)
    score = score_trajectory(time, pose, truth, delta=Delta(1, "f"))
    assert score.ate_raw is not None
    assert asdict(score.ate_raw) == pytest.approx(
        {"rmse": 3**0.5, "mean": 1, "median": 0, "max": 3}
    )
    assert score.ate is not None  # shifted down by 1: off by 1, 2 and 1
    assert score.ate.rmse == pytest.approx(2**0.5)
    assert score.rpe_translation is not None
    assert score.rpe_rotation is not None
    assert (score.rpe_translation.mean, score.rpe_rotation.mean) == pytest.approx((3, 0.25))


def test_stamps_take_the_nearest_within_the_difference() -> None:
    i, j = associate(np.array([0.0, 1.0, 2.0]), np.array([0.1, 0.9, 1.1, 2.3]), 0.2)
    assert (i.tolist(), j.tolist()) == ([0, 1], [0, 1])
    j, i = associate(np.array([0.1, 0.9, 1.1, 2.3]), np.array([0.0, 1.0, 2.0]), 0.2)
    assert (i.tolist(), j.tolist()) == ([0, 1], [0, 1])


@given(seconds, seconds, st.floats(0, 5))
def test_every_stamp_of_the_shorter_column_has_the_nearest(
    a: np.ndarray, b: np.ndarray, most: float
) -> None:
    i, j = associate(a, b, most)
    if len(a) > len(b):
        a, b, i, j = b, a, j, i
    away = np.abs(a[:, None] - b[None]).min(1, initial=np.inf)
    assert i.tolist() == np.flatnonzero(away <= most).tolist()
    np.testing.assert_array_equal(np.abs(a[i] - b[j]), away[i])


def test_pairs_by_frames_seconds_and_metres() -> None:
    time = np.array([0.0, 1, 2, 4, 5])
    pose = np.zeros((5, 3))
    pose[:, 0] = [0, 0, 3, 4, 9]
    assert pairs_of(time, pose, Delta(2, "f")).tolist() == [[0, 2], [2, 4]]
    assert pairs_of(time, pose, Delta(2, "s")).tolist() == [[0, 2], [2, 3]]
    assert pairs_of(time, pose, Delta(2, "m")).tolist() == [[0, 2], [2, 4]]
    assert pairs_of(time[:0], pose[:0], Delta(2, "m")).tolist() == []
    assert pairs_of(time[:0], pose[:0], Delta(2, "f")).tolist() == []


@given(st.tuples(st.floats(-9, 9), st.floats(-9, 9), st.floats(-3, 3)))
def test_a_shift_and_a_turn_of_all_change_neither_the_ate_nor_the_rpe(
    move: tuple[float, float, float],
) -> None:
    found, truth = PATHS(1)
    one = score_trajectory(found[:, 0], found[:, 1:], truth)
    two = score_trajectory(found[:, 0], compose(move, found[:, 1:]), truth)
    for a, b in ((one.ate, two.ate), (one.rpe_rotation, two.rpe_rotation)):
        assert a is not None
        assert b is not None
        assert a.rmse == pytest.approx(b.rmse, abs=1e-9)


def test_what_cannot_be_compared_is_none() -> None:
    score = score_trajectory(np.array([5.0]), np.zeros((1, 3)), np.zeros((3, 4)))
    assert (score.poses, score.ate, score.ate_raw, score.rpe_translation) == (0, None, None, None)
    score = score_trajectory(np.array([0.0]), np.ones((1, 3)), np.zeros((1, 4)))
    assert score.ate is None
    assert score.ate_raw is not None


def test_relative_errors_are_in_the_frame_of_the_true_step() -> None:
    truth = np.array([[0, 0, 0], [1, 0, np.pi / 2]])
    pose = np.array([[0, 0, 0], [2, 0, np.pi / 2]])
    error = relative_errors(pose, truth, np.array([[0, 1]]))
    np.testing.assert_allclose(error, [[0, -1, 0]], atol=1e-12)


@pytest.mark.parametrize("text", ["", "1", "m", "-1m", "0m", "1.5f", "1km", "nanm", "1 m 2"])
def test_other_deltas_are_refused(text: str) -> None:
    with pytest.raises(InputError, match="delta"):
        Delta.parse(text)
