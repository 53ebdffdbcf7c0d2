"""Figures of a map by identity, by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from symboslam.engine.slam.comparison import blind, measure
from symboslam.engine.slam.identity_error import holders
from symboslam.engine.slam.log import Truth

TRUTH = Truth({"a": (0.0, 0.0), "b": (4.0, 0.0), "c": (4.0, 3.0), "unseen": (9.0, 9.0)}, {})


def case(marks: Any, log: Any, mission: Any, slam_map: Any) -> tuple[Any, Any]:
    """The true places turned by 90 degrees; "c" is taken for "b", and "a" is there twice."""
    names = ["a", "a", "a", "b", "b", "b", "c", "c", "?"]
    robot = log("r", [[0, 0, 0]], [(0.0, 1.0, 0.0, "Tree", 1.0)] * len(names))
    made = mission(robot, identity={"r": names}, truth=TRUTH)
    found = marks([(0, 0, "Tree"), (5, 5, "Tree"), (0, 4, "Tree")])
    return slam_map(found, {"r": [1, 0, 0, 2, 2, 2, 2, 2, -1]}), made


def test_a_landmark_that_mixes_two_holds_both(
    marks: Any, log: Any, mission: Any, slam_map: Any
) -> None:
    found, made = case(marks, log, mission, slam_map)
    assert holders(found, made) == {"a": 0, "b": 2, "c": 2}
    figures = measure(lambda: found, made).figures
    assert (figures.landmarks_matched, figures.landmarks_true) == (2, 4)
    assert (figures.landmarks_mapped, figures.wrong_merges, figures.duplicates) == (3, 1, 1)
    assert figures.wrong_sightings_share == 2 / 8
    assert figures.landmark_rmse_raw_m == pytest.approx(np.sqrt((0 + 32 + 17) / 3))
    # the best alignment has (0, 0) and twice (4, 0) on (0, 0), (4, 0), (4, 3): see Umeyama
    best = np.inf
    true = np.array([[0, 0], [4, 0], [4, 3]]) - (8 / 3, 1)
    own = np.array([[0, 0], [0, 4], [0, 4]]) - (0, 8 / 3)
    for angle in np.linspace(-np.pi, np.pi, 20_001):
        cos, sin = np.cos(angle), np.sin(angle)
        turned = own @ np.array([[cos, sin], [-sin, cos]])
        best = min(best, float(np.sqrt(((turned - true) ** 2).sum(1).mean())))
    assert figures.landmark_rmse_m == pytest.approx(best, abs=1e-6)


def test_nothing_to_compare_with(marks: Any, log: Any, mission: Any, slam_map: Any) -> None:
    found, made = case(marks, log, mission, slam_map)
    hidden = blind(made)
    assert hidden.truth is None
    assert not hidden.identity
    figures = measure(lambda: found, hidden).figures
    assert figures.landmark_rmse_m is figures.landmark_rmse_raw_m is figures.wrong_merges is None
    one = mission(log("r", [[0, 0, 0]], [(0.0, 1.0, 0.0, "Tree", 1.0)]), truth=TRUTH,
                  identity={"r": ["a"]})  # fmt: skip
    figures = measure(lambda: slam_map(marks([(1, 0, "Tree")]), {"r": [0]}), one).figures
    assert figures.landmark_rmse_raw_m == 1
    assert figures.landmark_rmse_m is None  # one landmark has no alignment
