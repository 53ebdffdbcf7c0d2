"""The paper's equations against hand computations and a plain transcription."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst
from numpy.typing import NDArray

from symboslam.engine import evidence
from symboslam.engine.classify import classify
from symboslam.engine.evidence import pair_evidence
from symboslam.reasoning.knowledge import Knowledge

Floats = NDArray[np.float64]


def transcription(
    xy: Floats, weight: Floats, diagonal: float, a: float
) -> tuple[Floats, Floats, Floats]:
    """Design 5, term by term."""
    z, k = weight.shape
    c, n = np.zeros(k), np.zeros(k)
    for e in range(k):
        members = [i for i in range(z) if weight[i, e] > 0]
        n[e] = len(members) * (len(members) - 1)
        total = 0.0
        for x in members:
            for y in members:
                if x != y:
                    near = 1 - math.dist(xy[x], xy[y]) / diagonal
                    total += 0.5 * (weight[x, e] + weight[y, e]) * near
        c[e] = total / n[e] if n[e] else 0.0
    return a * c + (1 - a) * n / (z * (z - 1)), c, n


def test_two_landmarks_by_hand() -> None:
    # Distance 5 over a diagonal of 10: 1 - d = 0.5. Environment 0 holds both, 1 only the second.
    xy = np.array([[0.0, 0.0], [3.0, 4.0]])
    weight = np.array([[1.0, 0.0], [0.5, 1.0]])
    p, c, n = pair_evidence(xy, weight, 10.0, 0.5)
    assert n.tolist() == [2, 0]
    assert c == pytest.approx([0.75 * 0.5, 0], abs=1e-12)
    assert p == pytest.approx([0.5 * 0.375 + 0.5 * 1, 0], abs=1e-12)


def test_three_landmarks_by_hand() -> None:
    # A 3-4-5 triangle over a diagonal of 10; a = 0.25; environment 1 lacks the first landmark.
    xy = np.array([[0.0, 0.0], [3.0, 0.0], [3.0, 4.0]])
    weight = np.array([[1.0, 0.0], [1.0, 0.8], [1.0, 0.6]])
    p, c, _ = pair_evidence(xy, weight, 10.0, 0.25)
    c0 = 2 * (0.7 + 0.6 + 0.5) / 6
    c1 = 0.5 * (0.8 + 0.6) * 0.6
    assert c == pytest.approx([c0, c1], abs=1e-12)
    assert p == pytest.approx([0.25 * c0 + 0.75, 0.25 * c1 + 0.75 * 2 / 6], abs=1e-12)


@pytest.mark.parametrize("z", [0, 1])
def test_fewer_than_two_landmarks_make_no_pair(z: int) -> None:
    p, c, n = pair_evidence(np.zeros((z, 2)), np.ones((z, 3)), 1.0)
    assert not p.any()
    assert not c.any()
    assert not n.any()


@given(st.data(), st.integers(2, 12), st.floats(0.05, 0.95))
def test_equals_the_plain_transcription(data: Any, z: int, a: float) -> None:
    coordinates = st.floats(0, 100, allow_subnormal=False)
    xy = data.draw(npst.arrays(float, (z, 2), elements=coordinates))
    strengths = st.sampled_from([0.0, 0.0, 0.3, 1.0])
    weight = data.draw(npst.arrays(float, (z, 3), elements=strengths))
    diagonal = math.hypot(100, 100)
    for mine, plain in zip(
        pair_evidence(xy, weight, diagonal, a), transcription(xy, weight, diagonal, a), strict=True
    ):
        np.testing.assert_allclose(mine, plain, rtol=0, atol=1e-12)


def test_blocks_do_not_change_the_result(monkeypatch: pytest.MonkeyPatch) -> None:
    rng = np.random.default_rng(1)
    xy, weight = rng.uniform(0, 50, (101, 2)), rng.choice([0, 0.5, 1.0], (101, 4))
    whole = pair_evidence(xy, weight, 80.0)[0]
    monkeypatch.setattr(evidence, "BLOCK", 7)
    np.testing.assert_allclose(pair_evidence(xy, weight, 80.0)[0], whole, rtol=1e-13)


def test_no_matrix_of_all_pairs_is_held(monkeypatch: pytest.MonkeyPatch) -> None:
    from scipy.spatial import distance

    sizes: list[int] = []
    plain = distance.cdist

    def watched(a: Floats, b: Floats) -> Any:
        found = plain(a, b)
        sizes.append(found.nbytes)
        return found

    monkeypatch.setattr(distance, "cdist", watched)
    pair_evidence(np.random.default_rng(0).uniform(0, 1, (6000, 2)), np.ones((6000, 1)), 2.0)
    assert sum(sizes) >= 6000 * 6000 * 8 / 2
    assert max(sizes) < 256e6 / 100


def test_paper_profile_of_one_cell_by_hand(knowledge: Knowledge, landmarks_at: Any) -> None:
    # One cell of 30 m x 40 m, diagonal 50 m; two houses 30 m apart and a tree: direct links are 1.
    rows = [("House", 0, 0, 0.8), ("House", 30, 0, 0.6), ("Tree", 30, 40, 1.0)]
    found = classify(
        landmarks_at(rows, (0, 0, 30, 40)), knowledge, profile="paper", cells=1, scheme="all"
    )
    # Home: all three. Pairs: 30 m, 40 m, 50 m -> 1 - d = 0.4, 0.2, 0.
    home_c = 2 * (0.5 * (0.8 + 0.6) * 0.4 + 0.5 * (0.6 + 1) * 0.2 + 0.5 * (0.8 + 1) * 0) / 6
    home = 0.5 * home_c + 0.5 * 6 / 6
    # Open: only the tree, no pair.
    assert found.probability[0] == pytest.approx([1, 0, 0], abs=1e-12)
    raw = found.evidence.of(found.regions)
    assert raw[0] == pytest.approx([home, 0, 0], abs=1e-12)
