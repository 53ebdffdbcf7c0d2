"""Evidence as a density: kernel, penalty, unmarked ground."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.stats import norm

from symboslam.engine.classify import classify
from symboslam.engine.field import crowding_share, dissimilarity
from symboslam.reasoning.knowledge import Knowledge


def test_one_landmark_is_a_product_of_normal_distributions(
    knowledge: Knowledge, landmarks_at: Any
) -> None:
    town = landmarks_at([("House", 100, 130, 0.5)])
    found = classify(town, knowledge, bandwidth=40, absence=0.3, cells=2, threshold=1.0)
    weight = 0.9 * 1.0 * 0.5  # SP, importance (one environment), confidence
    i = found.position_of("1-1-0")  # north-west quarter, 120 m x 120 m = 1.44 ha
    east = norm.cdf(120, 100, 40) - norm.cdf(0, 100, 40)
    north = norm.cdf(240, 130, 40) - norm.cdf(120, 130, 40)
    home = weight * east * north / 1.44
    p = found.probability[i]
    assert p == pytest.approx([home / (home + 0.3), 0, 0.3 / (home + 0.3)], abs=1e-9)


def test_a_cell_is_the_mean_of_its_parts(knowledge: Knowledge, landmarks_at: Any) -> None:
    rows = [("House", 20, 30), ("Shop", 200, 100), ("Tree", 130, 210), ("House", 25, 31)]
    found = classify(landmarks_at(rows), knowledge, bandwidth=40, cells=24)
    grid_levels = [found.evidence.of(_level(found, d)) for d in range(4)]
    for fine in grid_levels[1:]:
        np.testing.assert_allclose(fine.mean(0), grid_levels[0].mean(0), rtol=1e-12)


def _level(found: Any, depth: int) -> Any:
    from symboslam.engine.grid import Grid

    return Grid(found.landmarks.bbox, 24).level(depth)


def test_evidence_crosses_borders(knowledge: Knowledge, landmarks_at: Any) -> None:
    rows = [("House", 119, 60), ("Shop", 20, 20), ("Shop", 25, 220)]
    found = classify(landmarks_at(rows), knowledge, bandwidth=40, cells=2, absence=0.0)
    east = found.position_of("1-0-1")
    assert found.landmark_count[east] == 0
    assert found.name_of(east) == "Home"


def test_silence_is_open_ground(knowledge: Knowledge, landmarks_at: Any) -> None:
    far = landmarks_at([("House", 20, 20)], (0, 0, 2400, 2400))
    found = classify(far, knowledge, bandwidth=40, cells=24)
    assert found.name_of(len(found) - 1) in {"Open", "Home"}
    assert found.shares()["Open"] > 0.9
    assert found.config["absence"] >= 0.05


def test_without_absence_in_the_scheme_silence_is_unknown(
    knowledge: Knowledge, landmarks_at: Any
) -> None:
    far = landmarks_at([("House", 20, 20)], (0, 0, 2400, 2400))
    found = classify(far, knowledge, bandwidth=40, cells=24, scheme="built", empty="unknown")
    assert found.shares()[None] > 0.8
    assert found.shares()["Home"] > 0


def test_dissimilarity_by_hand() -> None:
    # Two landmarks 30 m apart within a radius of 60 m, a third out of reach.
    xy = np.array([[0.0, 0.0], [30.0, 0.0], [500.0, 0.0]])
    weight = np.array([[1.0, 0.0], [0.2, 0.6], [1.0, 1.0]])
    found = dissimilarity(xy, weight, 60.0)
    assert found[0] == pytest.approx([0.75, 0.25])  # of 0.8 nearby, 0.6 point away from 0
    assert found[1] == pytest.approx([0.0, 1.0])
    assert found[2].tolist() == [0, 0]


def test_dissimilarity_at_one_place_counts_the_others() -> None:
    xy = np.zeros((3, 2))
    weight = np.array([[1.0, 0.0], [0.0, 1.0], [0.0, 1.0]])
    found = dissimilarity(xy, weight, 60.0)
    assert found[0] == pytest.approx([1.0, 0.0])
    assert found[1] == pytest.approx([0.5, 0.5])


@given(
    st.lists(
        st.tuples(st.floats(0, 200), st.floats(0, 200), st.sampled_from([0.0, 0.4, 1.0])),
        max_size=15,
    )
)
def test_dissimilarity_is_a_share(rows: list[tuple[float, float, float]]) -> None:
    xy = np.array([r[:2] for r in rows]).reshape(-1, 2)
    weight = np.array([[r[2], 1 - r[2]] for r in rows]).reshape(-1, 2)
    found = dissimilarity(xy, weight, 50.0)
    assert found.shape == weight.shape
    assert (found >= 0).all()
    assert (found <= 1).all()


def test_crowding_share_by_hand() -> None:
    # Densities 4 and 1: mean crowding (16 + 1) / 5 = 3.4, a tenth of it.
    assert crowding_share(np.array([[[3.0, 1.0], [1.0, 0.0]]])) == 0.34
    assert crowding_share(np.zeros((2, 2, 1))) == 0.05
    assert crowding_share(np.full((2, 2, 1), 1e6)) == 0.6


def test_a_close_stranger_costs_evidence(knowledge: Knowledge, landmarks_at: Any) -> None:
    options: dict[str, Any] = {"bandwidth": 40, "cells": 1, "dissimilarity": 0.4, "absence": 0.0}
    alone = classify(landmarks_at([("House", 60, 60)]), knowledge, **options)
    mixed = classify(landmarks_at([("House", 60, 60), ("Shop", 65, 60)]), knowledge, **options)
    both = mixed.evidence.of(mixed.regions)[0]
    assert both[0] == pytest.approx(alone.evidence.of(alone.regions)[0][0] * 0.6, rel=1e-9)


def test_a_wide_site_speaks_farther_and_as_loud(knowledge: Knowledge, landmarks_at: Any) -> None:
    from dataclasses import replace

    wide = replace(
        knowledge,
        features=tuple(
            replace(f, site=80.0) if f.name == "Shop" else f for f in knowledge.features
        ),
    )
    town = landmarks_at([("Shop", 1500, 1500)], (0, 0, 3000, 3000))
    options: dict[str, Any] = {"bandwidth": 40, "cells": 1, "absence": 0.0}
    small, large = (classify(town, k, **options) for k in (knowledge, wide))
    in_all = [m.evidence.of(m.regions)[0, 1] for m in (small, large)]
    assert in_all[1] / in_all[0] == pytest.approx(4, rel=1e-3)  # (80 / 40)^2
    options["cells"] = 600  # 5 m
    small, large = (classify(town, k, threshold=1.0, **options) for k in (knowledge, wide))
    middle = small.evidence.of(_cell(small, 300, 300)), large.evidence.of(_cell(large, 300, 300))
    assert middle[0][0, 1] == pytest.approx(middle[1][0, 1], rel=1e-2)


def _cell(found: Any, row: int, column: int) -> Any:
    from symboslam.engine.grid import Cells

    return Cells(np.array([3]), np.array([row]), np.array([column]))


def test_only_landmarks_within_reach_have_a_say(knowledge: Knowledge, landmarks_at: Any) -> None:
    rows = [("House", 100, 100), ("House", 1900, 100), ("Shop", 100, 1900), ("Tree", 1900, 1900)]
    found = classify(landmarks_at(rows, (0, 0, 2000, 2000)), knowledge, bandwidth=40, cells=8)
    (parts,) = found.contributions([found.position_of("3-0-0")])
    assert parts.landmark.tolist() == [0]
    assert (parts.own[:, 0] > 0).all()
