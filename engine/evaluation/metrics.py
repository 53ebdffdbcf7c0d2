"""Metrics of labelled cells: accuracy, kappa, F1, IoU, average precision, confusion matrix."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ClassScores:
    """How well one environment type was found.

    Attributes:
        support: cells that have it in the truth.
        predicted: cells that the map says have it.
        correct: cells of both.
        precision: correct / predicted; None where nothing was predicted.
        recall: correct / support; None where the truth has none.
        f1: 2 correct / (support + predicted).
        iou: correct / (support + predicted - correct), the paper's intersection over union.
        ap: average precision; None where the truth has none.
    """

    support: int
    predicted: int
    correct: int
    precision: float | None
    recall: float | None
    f1: float
    iou: float
    ap: float | None


@dataclass(frozen=True)
class Scores:
    """Metrics over some truth cells, in which unknown is a wrong answer of its own.

    Attributes:
        cells: how many.
        accuracy: overall accuracy.
        kappa: Cohen's kappa; None where truth and map agree by chance alone.
        macro_f1: mean F1 over the environments that the truth has.
        mean_iou: their mean IoU.
        mean_ap: their mean average precision (mAP).
        classes: environment name -> its scores, for those that truth or map have.
        confusion: (K, K + 1) cells by truth (rows) and answer (columns, the last is unknown).
    """

    cells: int
    accuracy: float
    kappa: float | None
    macro_f1: float
    mean_iou: float
    mean_ap: float
    classes: Mapping[str, ClassScores]
    confusion: Ints


@dataclass(frozen=True)
class Result:
    """What a comparison comes to.

    Attributes:
        cells: cells with a truth.
        coverage: share of them that the map labels.
        all: over all of them; unknown is wrong.
        labelled: over those that the map labels; None if it labels none.
    """

    cells: int
    coverage: float
    all: Scores
    labelled: Scores | None


def result_of(truth: Ints, label: Ints, probability: Floats, names: tuple[str, ...]) -> Result:
    """Metrics over all cells that have a truth, and over those that are labelled as well.

    Args:
        truth: (n,) environment of each cell; -1 = no truth. At least one has a truth.
        label: (n,) what the map says; -1 = unknown.
        probability: (n, K) its probabilities.
        names: the K environments.
    """
    has = truth >= 0
    truth, label, probability = truth[has], label[has], probability[has]
    known = label >= 0
    labelled = None
    if known.any():
        labelled = scores_of(truth[known], label[known], probability[known], names)
    everything = scores_of(truth, label, probability, names)
    return Result(len(truth), float(known.mean()), everything, labelled)


def scores_of(truth: Ints, label: Ints, probability: Floats, names: tuple[str, ...]) -> Scores:
    """Metrics over cells that all have a truth; see ``result_of`` for the arguments."""
    count = len(names)
    answer = np.where(label < 0, count, label)
    flat = np.bincount(truth * (count + 1) + answer, minlength=count * (count + 1))
    confusion = flat.reshape(count, count + 1).astype(np.int64)
    support, predicted = confusion.sum(1), confusion.sum(0)[:count]
    correct = np.diagonal(confusion)
    classes = {
        names[k]: _class_scores(
            int(support[k]),
            int(predicted[k]),
            int(correct[k]),
            average_precision(truth == k, probability[:, k]),
        )
        for k in range(count)
        if support[k] or predicted[k]
    }
    present = [scores for scores in classes.values() if scores.support]
    agreed = float(correct.sum()) / len(truth)
    chance = float(support @ predicted) / len(truth) ** 2
    return Scores(
        cells=len(truth),
        accuracy=agreed,
        kappa=(agreed - chance) / (1 - chance) if chance < 1 else None,
        macro_f1=float(np.mean([c.f1 for c in present])),
        mean_iou=float(np.mean([c.iou for c in present])),
        mean_ap=float(np.mean([c.ap or 0.0 for c in present])),
        classes=classes,
        confusion=confusion,
    )


def _class_scores(support: int, predicted: int, correct: int, ap: float | None) -> ClassScores:
    return ClassScores(
        support=support,
        predicted=predicted,
        correct=correct,
        precision=correct / predicted if predicted else None,
        recall=correct / support if support else None,
        f1=2 * correct / (support + predicted),
        iou=correct / (support + predicted - correct),
        ap=ap,
    )


def average_precision(relevant: NDArray[Any], score: Floats) -> float | None:
    """Area under the stepwise precision-recall curve of the cells ranked by a score.

    Cells with equal scores are one step. A score of 0 never retrieves its cell, so what is held
    impossible, or is not answered, is missed at every threshold.

    Args:
        relevant: (n,) which cells are of the class.
        score: (n,) probability of the class.

    Returns:
        Sum over the thresholds of (gain in recall) x precision; None if nothing is relevant.
    """
    total = int(relevant.sum())
    if not total:
        return None
    positive = score > 0
    thresholds, step = np.unique(-score[positive], return_inverse=True)
    retrieved = np.cumsum(np.bincount(step, minlength=len(thresholds)))
    gained = np.bincount(step, relevant[positive], len(thresholds))
    return float((gained / total) @ (np.cumsum(gained) / np.maximum(retrieved, 1)))
