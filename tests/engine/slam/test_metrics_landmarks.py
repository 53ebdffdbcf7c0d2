"""Landmarks against the truth: by position and by identity."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linear_sum_assignment

from symboslam.engine.slam.landmark_error import Points, match, score_aligned, score_landmarks
from symboslam.engine.slam.log import Truth
from symboslam.engine.slam.metrics import Options, evaluate_slam
from symboslam.engine.slam.planar import place
from symboslam.engine.slam.spacing import radius_by_spacing
from symboslam.errors import InputError

UNIT = np.eye(3)
places = st.lists(st.tuples(st.integers(0, 12), st.integers(0, 12), st.integers(-1, 1)), max_size=8)


def points(rows: Any) -> Points:
    table = np.array(rows, float).reshape(-1, 3)
    return Points(np.arange(len(table)).astype(object), table[:, :2], table[:, 2].astype(np.int64))


def test_coverage_accuracy_and_offset_by_hand() -> None:
    true = points([(0, 0, 0), (10, 0, 0), (20, 0, 1), (30, 0, 2)])
    found = points([(3, 4, 0), (10, 1, 0), (20, 0, 2), (30, 9, 2), (10, 2, 0)])
    score = score_landmarks(found, true, UNIT, 6)
    assert score.pairs.tolist() == [[0, 0], [1, 1]]  # too unlike, too far, second of one
    assert (score.coverage, score.accuracy) == (0.5, 0.4)
    assert score.offset is not None
    assert (score.offset.mean, score.offset.rmse) == pytest.approx((3, 13**0.5))


def test_a_similar_class_is_matched_but_not_right() -> None:
    alike = np.array([[1, 0.5], [0.5, 1]])
    score = score_landmarks(points([(0, 0, 0)]), points([(0, 1, 1)]), alike, 2)
    assert (score.coverage, score.accuracy) == (1, 0)
    score = score_landmarks(points([(0, 0, 0)]), points([(0, 1, 1)]), alike, 2, least=0.6)
    assert score.coverage == 0


def test_one_to_one_prefers_more_pairs_to_shorter_ones() -> None:
    found, true = points([(0, 0, 0), (2, 0, 0)]), points([(2, 0, 0), (4, 0, 0)])
    assert match(found, true, UNIT, 3, 0.5).tolist() == [[0, 0], [1, 1]]


@given(places, places, st.integers(1, 8))
def test_matching_is_the_assignment_of_scipy(one: Any, other: Any, radius: int) -> None:
    found, true = points(one), points(other)
    pairs = match(found, true, UNIT, radius, 0.5)
    away = np.hypot(*(found.xy[:, None] - true.xy[None]).T).T.reshape(len(one), len(other))
    f, t = found.feature[:, None], true.feature[None]
    allowed = (away <= radius) & ((f == t) | (f < 0) | (t < 0))
    i, j = linear_sum_assignment(np.where(allowed, away, 1e4))
    kept = allowed[i, j]
    assert len(pairs) == kept.sum()
    assert len(set(pairs[:, 0])) == len(set(pairs[:, 1])) == len(pairs)
    assert allowed[pairs[:, 0], pairs[:, 1]].all()
    assert away[pairs[:, 0], pairs[:, 1]].sum() == pytest.approx(away[i, j][kept].sum())


def test_alignment_finds_a_turned_map() -> None:
    rng = np.random.default_rng(5)
    xy = rng.uniform(0, 100, (40, 2))
    true = points(np.column_stack([xy, np.zeros(40)]))
    found = points(np.column_stack([place((3, -2, 0.08), xy), np.zeros(40)]))
    raw = score_landmarks(found, true, UNIT, 6)
    score = score_aligned(found, true, UNIT, 6)
    assert raw.coverage is not None
    assert raw.coverage < 1
    assert score is not None
    assert score.offset is not None
    assert score.coverage == 1
    assert score.offset.max == pytest.approx(0, abs=1e-9)


def test_no_alignment_from_one_pair() -> None:
    assert score_aligned(points([(0, 0, 0)]), points([(0, 0, 0)]), UNIT, 1) is None


def test_radius_is_half_the_spacing_and_at_most_12_metres() -> None:
    corners = np.array([[0.0, 0], [4, 0], [0, 4], [4, 4]])
    assert radius_by_spacing(corners) == pytest.approx(1)  # four in 4 m x 4 m: one every 2 m
    assert radius_by_spacing(corners * 100) == 12
    assert radius_by_spacing(np.zeros((3, 2))) == 12
    assert radius_by_spacing(np.zeros((0, 2))) == 12


TRUTH = Truth(
    landmarks={"a": (0.0, 0.0), "b": (10.0, 0.0), "c": (20.0, 0.0), "d": (30.0, 0.0)},
    trajectories={},
    features={"a": "House", "b": "House", "c": "Tree"},
)


def test_identities_by_hand(marks: Any, log: Any, mission: Any, slam_map: Any) -> None:
    sighting = (0.0, 1.0, 0.0, "House", 1.0)
    # L1: 3 of a, 2 of b. L2: 2 of a. L3: 20 of c, 2 of b, 1 of a. c has no other; d is not seen.
    names = ["a"] * 3 + ["b"] * 2 + ["a"] * 2 + ["c"] * 20 + ["b"] * 2 + ["a"] + ["", None, "d"]
    of = [0] * 5 + [1] * 2 + [2] * 23 + [0, 0, -1]
    found = slam_map(
        marks([(0, 1, "House"), (0, 5, "House"), (20, 2, "Tree"), (9, 9, "Tree")]), {"r": of}
    )
    robot = log("r", [[0, 0, 0]], [sighting] * len(names))
    score = evaluate_slam(found, mission(robot, identity={"r": names}, truth=TRUTH))
    known = score.identities
    assert known is not None
    assert known.true_of.tolist() == ["a", "a", "c", None]
    assert known.stands == {"a": 0, "c": 2}
    assert (known.duplicates, known.wrong_merges) == (1, 1)  # 2 of 23 are less than a tenth
    assert (known.sightings, known.wrong_sightings) == (30, 5)
    assert known.missed == ("b", "d")
    values = score.to_json()
    assert (values["landmark_rmse_m"], values["landmark_mean_m"]) == pytest.approx((2.5**0.5, 1.5))
    assert (values["landmark_max_m"], values["landmarks_matched"]) == (2, 2)
    assert values["matched_by"] == "identity"
    assert values["wrong_sightings_share"] == pytest.approx(1 / 6)
    json.dumps(values, allow_nan=False)


def test_the_landmark_with_most_sightings_stands(
    marks: Any, log: Any, mission: Any, slam_map: Any
) -> None:
    robot = log("r", [[0, 0, 0]], [(0.0, 1.0, 0.0, "House", 1.0)] * 5)
    found = slam_map(marks([(0, 9, "House"), (0, 1, "House")]), {"r": [0, 0, 1, 1, 1]})
    score = evaluate_slam(found, mission(robot, identity={"r": ["a"] * 5}, truth=TRUTH))
    assert score.to_json()["landmark_max_m"] == 1
    assert score.to_json()["duplicates"] == 1


def test_what_moves_does_not_count(marks: Any, log: Any, mission: Any, slam_map: Any) -> None:
    rows = [(0.0, 1.0, 0.0, name, 1.0) for name in ("Dog", "House", "Dog")]
    found = slam_map(marks([(0, 0, "Dog"), (0, 0, "House")]), {"r": [0, 1, 1]})
    robot = log("r", [[0, 0, 0]], rows)
    score = evaluate_slam(found, mission(robot, identity={"r": ["rex", "a", "rex"]}, truth=TRUTH))
    values = score.to_json()
    assert (values["landmarks_mapped"], values["sightings"], values["missed"]) == (1, 1, 0)
    assert values["landmark_max_m"] == 0


def test_truth_may_be_absent_in_part(marks: Any, log: Any, mission: Any, slam_map: Any) -> None:
    robot = log("r", [[0, 0, 0]], [(0.0, 1.0, 0.0, "House", 1.0)])
    path = {"r": [[0, 0, 0, 0], [1, 1, 0, 0], [2, 2, 1, 0]]}
    found = slam_map(marks([(0, 0, "House")]), {"r": [0]}, path)
    names = {"r": ["a"]}
    paths = Truth({}, {"r": np.array(path["r"], float), "s": np.zeros((1, 4))})
    for truth in (None, Truth({}, {}), TRUTH, paths):
        for identity in (None, names):
            for a_map in (found, slam_map(marks([]))):
                a_mission = mission(robot, identity=identity, truth=truth)
                json.dumps(evaluate_slam(a_map, a_mission).to_json(), allow_nan=False)
    score = evaluate_slam(found, mission(robot, identity=names, truth=paths)).to_json()
    assert (score["ate_mean_m"], score["ate_max_m"]) == pytest.approx((0, 0), abs=1e-12)
    assert score["robots_missing"] == ["s"]
    assert (score["duplicates"], score["landmark_rmse_m"], score["raw"]) == (0, None, None)
    assert "robot s has a true path, but none in the map" in score["notes"]


def test_ate_is_over_robots(marks: Any, mission: Any, slam_map: Any) -> None:
    straight = np.array([[0, 0, 0, 0], [1, 1, 0, 0], [2, 2, 0, 0]], float)
    bent = straight.copy()
    bent[1, 2] = 3
    later = straight.copy()
    later[:, 0] += 9
    truth = Truth({}, {"a": straight, "b": straight, "c": later})
    found = slam_map(marks([]), {}, {"a": straight, "b": bent, "c": straight})
    score = evaluate_slam(found, mission(truth=truth))
    assert score.to_json()["ate_max_m"] == pytest.approx(2**0.5)
    assert score.to_json()["ate_mean_m"] == pytest.approx(2**0.5 / 2)
    assert any("robot c: no pose within 0.01 s" in note for note in score.notes)


def test_identities_must_fit_the_log(marks: Any, log: Any, mission: Any, slam_map: Any) -> None:
    robot = log("r", [[0, 0, 0]], [(0.0, 1.0, 0.0, "House", 1.0)])
    with pytest.raises(InputError, match="1 sightings, but 2 landmarks and 1 identities"):
        evaluate_slam(slam_map(marks([]), {"r": [0, 0]}), mission(robot, identity={"r": ["a"]}))


@pytest.mark.parametrize(("name", "value"), [("radius", 0), ("max_diff", -1), ("radius", np.nan)])
def test_options_are_checked(name: str, value: Any) -> None:
    with pytest.raises(InputError, match=name):
        Options(**{name: value})


def test_ten_thousand_landmarks_are_matched_in_seconds() -> None:
    rng = np.random.default_rng(1)
    xy = rng.uniform(0, 5000, (10_000, 2))
    table = np.column_stack([xy, rng.integers(0, 3, 10_000)])
    moved = table + np.column_stack([rng.normal(0, 3, (10_000, 2)), np.zeros(10_000)])
    score = score_landmarks(points(moved), points(table), UNIT, 12)
    assert score.coverage is not None
    assert score.coverage > 0.99
