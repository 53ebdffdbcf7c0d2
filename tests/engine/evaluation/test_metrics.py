"""Metrics: by hand, against scikit-learn, and what always holds."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symboslam.engine.evaluation.metrics import average_precision, result_of, scores_of

NAMES = ("A", "B", "C")


def one_hot(label: Any, count: int = 3) -> Any:
    return np.vstack([np.eye(count), np.zeros(count)])[label]


def test_by_hand() -> None:
    truth = np.array([0, 0, 0, 1, 1, 2])
    label = np.array([0, 0, 1, 1, -1, 0])
    got = scores_of(truth, label, one_hot(label), NAMES)
    assert got.confusion.tolist() == [[2, 1, 0, 0], [0, 1, 0, 1], [1, 0, 0, 0]]
    assert got.accuracy == 3 / 6
    # By chance: A 3 x 3, B 2 x 2, C 1 x 0 of 36.
    chance = 13 / 36
    assert got.kappa == pytest.approx((0.5 - chance) / (1 - chance))
    a, b, c = (got.classes[n] for n in NAMES)
    assert (a.precision, a.recall, a.f1, a.iou) == (2 / 3, 2 / 3, 2 / 3, 2 / 4)
    assert (b.precision, b.recall, b.f1, b.iou) == (1 / 2, 1 / 2, 1 / 2, 1 / 3)
    assert (c.precision, c.recall, c.f1, c.iou, c.predicted) == (None, 0.0, 0.0, 0.0, 0)
    assert got.macro_f1 == pytest.approx((2 / 3 + 1 / 2 + 0) / 3)
    assert got.mean_iou == pytest.approx((1 / 2 + 1 / 3 + 0) / 3)
    # One threshold: A retrieves 3 cells, 2 of 3 right: 2/3 x 2/3; B 1/2 x 1/2; C nothing.
    assert got.mean_ap == pytest.approx((4 / 9 + 1 / 4 + 0) / 3)


def test_average_precision_by_hand() -> None:
    relevant = np.array([True, False, True, True, False])
    score = np.array([0.9, 0.8, 0.8, 0.0, 0.1])
    # 0.9: 1/3 recall at precision 1; 0.8: +1/3 at 2/3; 0.1: none; 0: never retrieved.
    assert average_precision(relevant, score) == pytest.approx(1 / 3 + 1 / 3 * 2 / 3)
    assert average_precision(relevant, np.zeros(5)) == 0.0
    assert average_precision(np.zeros(5, bool), score) is None


def test_what_the_truth_lacks_is_told_but_not_averaged() -> None:
    got = scores_of(np.array([0, 0]), np.array([0, 1]), one_hot([0, 1]), NAMES)
    assert got.macro_f1 == pytest.approx(2 / 3)
    absent = got.classes["B"]
    assert (absent.support, absent.predicted, absent.precision) == (0, 1, 0.0)
    assert absent.recall is None
    assert absent.ap is None
    assert "C" not in got.classes


def test_all_cells_and_labelled_ones() -> None:
    truth, label = np.array([0, 1, -1, 1]), np.array([0, -1, 2, 1])
    got = result_of(truth, label, one_hot(label), NAMES)
    assert (got.cells, got.coverage) == (3, 2 / 3)
    assert got.all.accuracy == pytest.approx(2 / 3)
    assert got.labelled is not None
    assert (got.labelled.cells, got.labelled.accuracy) == (2, 1.0)


def test_nothing_labelled() -> None:
    got = result_of(np.array([0, 1]), np.array([-1, -1]), np.zeros((2, 3)), NAMES)
    assert got.labelled is None
    assert (got.coverage, got.all.accuracy, got.all.kappa, got.all.mean_ap) == (0, 0, 0, 0)


def test_agreement_by_chance_alone_has_no_kappa() -> None:
    got = scores_of(np.array([1, 1]), np.array([1, 1]), one_hot([1, 1]), NAMES)
    assert got.kappa is None
    assert got.macro_f1 == 1.0


def cells_at_random(seed: int, count: int = 400, kinds: int = 5) -> Any:
    rng = np.random.default_rng(seed)
    truth = rng.integers(0, kinds, count)
    probability = 0.01 + np.round(rng.random((count, kinds)), 1)
    label = np.where(rng.random(count) < 0.2, -1, probability.argmax(1))
    return truth, label, probability


@pytest.mark.parametrize("seed", range(3))
def test_same_as_scikit_learn(seed: int) -> None:
    metrics = pytest.importorskip("sklearn.metrics", reason="scikit-learn is not installed")
    truth, label, probability = cells_at_random(seed)
    names = tuple("ABCDE")
    got = scores_of(truth, label, probability, names)
    kinds = range(5)
    assert got.accuracy == pytest.approx(metrics.accuracy_score(truth, label), abs=1e-12)
    assert got.kappa == pytest.approx(metrics.cohen_kappa_score(truth, label), abs=1e-12)
    for name, values in {
        "precision": metrics.precision_score(truth, label, labels=kinds, average=None),
        "recall": metrics.recall_score(truth, label, labels=kinds, average=None),
        "f1": metrics.f1_score(truth, label, labels=kinds, average=None),
        "iou": metrics.jaccard_score(truth, label, labels=kinds, average=None),
        "ap": [metrics.average_precision_score(truth == k, probability[:, k]) for k in kinds],
    }.items():
        ours = [getattr(got.classes[n], name) for n in names]
        np.testing.assert_allclose(ours, values, atol=1e-12, err_msg=name)
    matrix = metrics.confusion_matrix(truth, np.where(label < 0, 5, label), labels=range(6))
    assert got.confusion.tolist() == matrix[:5].tolist()


@given(st.integers(0, 10**6), st.permutations(range(5)))
@settings(max_examples=20)
def test_order_of_cells_and_names_means_nothing(seed: int, order: list[int]) -> None:
    truth, label, probability = cells_at_random(seed, 60)
    names = np.array(list("ABCDE"))
    got = scores_of(truth, label, probability, tuple(names))
    place = np.argsort(order)
    shuffled = np.random.default_rng(seed).permutation(60)
    moved = scores_of(
        place[truth][shuffled],
        np.where(label < 0, -1, place[label])[shuffled],
        probability[:, order][shuffled],
        tuple(names[order]),
    )
    assert moved.accuracy == got.accuracy
    assert moved.kappa == pytest.approx(got.kappa)
    for name, c in got.classes.items():
        assert moved.classes[name].f1 == c.f1
        assert moved.classes[name].ap == pytest.approx(c.ap)


@given(st.integers(0, 10**6))
@settings(max_examples=20)
def test_bounds(seed: int) -> None:
    truth, label, probability = cells_at_random(seed, 40)
    got = scores_of(truth, label, probability, tuple("ABCDE"))
    assert int(got.confusion.sum()) == got.cells == 40
    for c in got.classes.values():
        assert 0 <= c.iou <= c.f1 <= 1
        assert c.f1 == pytest.approx(2 * c.iou / (1 + c.iou))
        assert c.ap is None or 0 <= c.ap <= 1 + 1e-12
