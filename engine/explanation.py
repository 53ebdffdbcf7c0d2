"""Explanation: why a segment is what it is, as sums that anyone can check."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.engine._base import Contributions
from symboslam.engine.chain import Chain
from symboslam.engine.landmarks import LandmarkMap
from symboslam.reasoning.knowledge import Environment, Knowledge


@dataclass(frozen=True)
class Reason:
    """What all landmarks of one feature class, or the open ground, add to a segment's P.

    Attributes:
        feature: local name of the feature; of an absence feature for open ground.
        label: words for people.
        count: landmarks of this feature that had a say (0 for open ground).
        contribution: environment name -> share of P(e); summed over a segment's reasons it is
            exactly P(e).
    """

    feature: str
    label: str
    count: int
    contribution: Mapping[str, float]


@dataclass(frozen=True)
class Explanation:
    """A segment's probabilities and the reasons that add up to them.

    Attributes:
        segment_id: the segment.
        environment: its environment type, or None if unknown.
        probabilities: environment name -> P(e).
        reasons: one for each feature class that had a say, the largest share of any P first.
        chain: the same above and below environment types; None where that is not known.
    """

    segment_id: str
    environment: str | None
    probabilities: Mapping[str, float]
    reasons: tuple[Reason, ...]
    chain: Chain | None = None

    @property
    def runner_up(self) -> str | None:
        """The environment that comes second, or None."""
        others = {e: p for e, p in self.probabilities.items() if e != self.environment and p > 0}
        return max(others, key=others.__getitem__) if others else None

    def speaking_for(self, environment: str) -> list[Reason]:
        """Reasons that have a part in P(environment), the largest first."""
        found = [r for r in self.reasons if r.contribution.get(environment)]
        return sorted(found, key=lambda r: -r.contribution[environment])


@dataclass(frozen=True)
class ClassParts:
    """A segment's contributions by feature class.

    Attributes:
        classes: (c,) feature classes of the landmarks that have a say.
        counts: (c,) how many landmarks of each.
        parts: (c, K) what each adds to P~(e).
        ground: (K,) what ground without landmarks adds.
    """

    classes: NDArray[np.int64]
    counts: NDArray[np.int64]
    parts: NDArray[np.float64]
    ground: NDArray[np.float64]

    @classmethod
    def of(cls, contributions: Contributions, landmarks: LandmarkMap) -> ClassParts:
        """The contributions of one segment, added up by class."""
        classes, index, counts = np.unique(
            landmarks.feature[contributions.landmark], return_inverse=True, return_counts=True
        )
        parts = np.eye(len(classes))[:, index] @ contributions.each
        return cls(classes.astype(np.int64), counts, parts, contributions.ground)

    @property
    def total(self) -> NDArray[np.float64]:
        """(K,) the segment's evidence P~."""
        return np.asarray(self.parts.sum(0) + self.ground)


def reasons_of(
    parts: ClassParts, knowledge: Knowledge, environments: tuple[Environment, ...]
) -> tuple[Reason, ...]:
    """A segment's contributions by feature class, as shares of P, the largest first.

    Args:
        parts: of one segment.
        knowledge: names and labels.
        environments: the K environments.
    """
    total = parts.total.sum()
    if total <= 0:
        return ()
    classes, counts, shares = parts.classes, parts.counts, parts.parts / total
    if parts.ground.any() and knowledge.absence:
        ground = knowledge.index_of(knowledge.absence[0])
        if ground is not None:
            classes, counts = np.append(classes, ground), np.append(counts, 0)
            shares = np.vstack([shares, parts.ground / total])
    largest = np.abs(shares).max(1)
    order = np.argsort(-largest, kind="stable")[: int(np.count_nonzero(largest))]
    names = [e.name for e in environments]
    found = []
    for row in order.tolist():
        known = knowledge.features[int(classes[row])]
        added = {n: v for n, v in zip(names, shares[row].tolist(), strict=True) if v}
        found.append(Reason(known.name, known.label, int(counts[row]), added))
    return tuple(found)
