"""Landmark parts: what single landmarks, and pairs of them, add to the P of a segment's type.

Both lists are closed: what is listed and what is not add up to P, and to all that pairs do.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symboslam.engine._base import normalised
from symboslam.engine.writers.vocabulary import CRS84, LOCAL_METRES

if TYPE_CHECKING:
    from symboslam.engine.environment_map import EnvironmentMap
    from symboslam.engine.local import LocalEvidence

LANDMARKS = 20
"""Landmarks, and pairs of them, that are listed unless a number is asked for."""
AMONG, MOST = 400, 3000
"""Landmarks among which the strongest pairs are looked for: those that add most. More where more
are asked for, up to ``MOST``, whose pairs need some 300 MB."""


@dataclass(frozen=True)
class LandmarkPart:
    """What one landmark adds to the winner's P.

    Attributes:
        id: the landmark.
        feature: its class.
        label: the same for people.
        position: in the input's coordinates.
        contribution: what it adds in all; ``own`` and ``pairs`` together.
        own: what it adds by itself, or by being counted; see ``LandmarkParts.counted``.
        pairs: what it adds, or loses, through others.
        without: P(winner) if it were not there, worked out anew; None where that is not known.
    """

    id: str
    feature: str
    label: str
    position: tuple[float, float]
    contribution: float
    own: float
    pairs: float
    without: float | None = None


@dataclass(frozen=True)
class PairPart:
    """What two landmarks add to the winner's P, or take from it, by being together."""

    first: str
    second: str
    features: tuple[str, str]
    contribution: float


@dataclass(frozen=True)
class Others:
    """What the landmarks that are not listed add to the winner's P, and how many they are."""

    count: int
    contribution: float


@dataclass(frozen=True)
class LandmarkParts:
    """What adds up to the winner's P, by landmark; empty where the landmarks are not at hand.

    Attributes:
        landmarks: the strongest; with ``other_landmarks`` and ``ground`` they add up to P.
        other_landmarks: all that are not listed and add something; None where not known.
        ground: what ground without landmarks adds; None where not known.
        pairs: the strongest pairs of landmarks; with ``other_pairs`` they add up to the ``pairs``
            of all landmarks.
        other_pairs: what all pairs that are not listed add; None where not known. Also what
            landmarks do that stand too far away to add anything but deny others something.
        counted: whether ``own`` is a landmark's part of the share of inferences (evidence from
            pairs) and not what it says by itself (a density, or one landmark alone).
        held: whether ``without`` is what a fragment is if it is otherwise held as it is; cut anew,
            the map may have other fragments.
        crs: IRI of the coordinate system of all positions; empty where there are none.
    """

    landmarks: tuple[LandmarkPart, ...] = ()
    other_landmarks: Others | None = None
    ground: float | None = None
    pairs: tuple[PairPart, ...] = ()
    other_pairs: float | None = None
    counted: bool = False
    held: bool = False
    crs: str = ""


def parts_of(m: EnvironmentMap, local: LocalEvidence, label: int, listed: int) -> LandmarkParts:
    """The parts of P of one segment.

    Args:
        m: the map.
        local: the evidence around the segment.
        label: column of the environment.
        listed: how many landmarks, and how many pairs, to list.
    """
    from symboslam.engine.local import LocalFragment, LocalPairs

    each = (local.own + local.pairs)[:, label]
    order = np.argsort(-np.abs(each), kind="stable")
    order = order[np.abs(each)[order] > 0]
    total, rest = local.total.sum(), order[listed:]
    pairs = _pairs(m, local, label, listed)
    return LandmarkParts(
        _landmarks(m, local, label, order[:listed]),
        Others(len(rest), float(each[rest].sum() / total)),
        float(local.ground[label] / total),
        pairs,
        float(local.pairs[:, label].sum() / total - sum(pair.contribution for pair in pairs)),
        isinstance(local, LocalPairs) and len(local.landmark) > 1,
        isinstance(local, LocalFragment),
        CRS84 if m.landmarks.frame.geographic else LOCAL_METRES,
    )


def _landmarks(
    m: EnvironmentMap, local: LocalEvidence, label: int, rows: NDArray[np.intp]
) -> tuple[LandmarkPart, ...]:
    """The parts of some landmarks, given as rows of ``local.landmark``."""
    total, marks, known = local.total.sum(), m.landmarks, m.knowledge.features
    own, pairs = local.own[rows, label] / total, local.pairs[rows, label] / total
    alone = normalised(local.without(rows, np.eye(len(rows), dtype=np.bool_)))[:, label]
    positions = local.landmark[rows]
    first, second = marks.frame.from_metres(marks.x[positions], marks.y[positions])
    found = []
    for at, position in enumerate(positions.tolist()):
        feature = known[int(marks.feature[position])]
        found.append(
            LandmarkPart(
                str(marks.id[position]),
                feature.name,
                feature.label,
                (float(first[at]), float(second[at])),
                float(own[at] + pairs[at]),
                float(own[at]),
                float(pairs[at]),
                float(alone[at]),
            )
        )
    return tuple(found)


def _pairs(
    m: EnvironmentMap, local: LocalEvidence, label: int, listed: int
) -> tuple[PairPart, ...]:
    """The strongest pairs among the landmarks that add most."""
    total, marks, known = local.total.sum(), m.landmarks, m.knowledge.features
    loudest = np.abs(local.own + local.pairs).max(1, initial=0)
    among = np.argsort(-loudest, kind="stable")[: max(AMONG, min(listed, MOST))]
    through = local.between(among, label) / total
    together = np.triu(through + through.T, 1)
    rows, columns = np.nonzero(together)
    parts = together[rows, columns]
    found = []
    for j in np.argsort(-np.abs(parts), kind="stable")[:listed].tolist():
        ends = [int(local.landmark[among[k]]) for k in (rows[j], columns[j])]
        one, two = (known[int(marks.feature[end])].name for end in ends)
        found.append(
            PairPart(str(marks.id[ends[0]]), str(marks.id[ends[1]]), (one, two), float(parts[j]))
        )
    return tuple(found)
