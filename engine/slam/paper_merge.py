"""PaperMerge: the paper's collective map, from the landmarks that agents hand in (design 7).

The rules, with a the radius and "similar" classes of at least a given similarity:

1. A landmark that comes in and has similar ones within a is merged with the nearest of them.
2. One that has none within a, similar or not, is added.
3. One that has only dissimilar ones within a is compared with the nearest of these. If it is
   farther away than a/2, there may well be two things, and it is added; if it is no farther, but
   more confident than the one there, it is added too; else it is put aside.
4. As soon as three or more that were put aside are of similar classes and lie within a of one of
   them, they become one landmark. It replaces the nearest dissimilar one within a, which is put
   aside in its turn.
5. Dynamic ones are never compared with anything: each is kept as evidence, as it came.

A merged landmark has the class and the confidence of the more confident of the two, of equally
confident ones those of the earlier. Its position is the mean of both, weighted by their sightings;
where both have a covariance, weighted by the inverse covariances instead, as if the two were
independent, with the covariance of that mean.

The order of arrival matters, batch by batch: each batch is compared with what was there before it,
by a KD-tree, and not with itself, since an agent knows best which of its landmarks are two. Within
a batch, landmarks that are merged with the same one are so in the order of their rows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from symboslam.engine.slam.log import Floats, Ints
from symboslam.engine.slam.paper_rules import Rules
from symboslam.engine.slam.slam_map import MappedLandmarks

LEAST = 3
"""As many that were put aside replace what is there."""


@dataclass
class _Mark:
    """One landmark: columns of ``MappedLandmarks``, and the entries that went into it."""

    id: str
    xy: Floats
    covariance: Floats
    feature: int
    confidence: float
    sightings: int
    key: str
    entries: list[int]

    def take(self, other: _Mark) -> None:
        """Merge with a later one."""
        if np.isfinite(self.covariance).all() and np.isfinite(other.covariance).all():
            gain = self.covariance @ np.linalg.inv(self.covariance + other.covariance)
            self.xy = self.xy + gain @ (other.xy - self.xy)
            covariance = self.covariance - gain @ self.covariance
            self.covariance = (covariance + covariance.T) / 2
        else:
            share = other.sightings / (self.sightings + other.sightings)
            self.xy = self.xy + share * (other.xy - self.xy)
            self.covariance = np.full((2, 2), np.nan)
        self.sightings += other.sightings
        if other.confidence > self.confidence:
            self.feature, self.confidence = other.feature, other.confidence
        self.key = self.key or other.key
        self.entries = self.entries + other.entries


class PaperMerge:
    """Merges the landmarks of agents into one map; hand in every sighting once.

    Args:
        rules: what may be one landmark.
    """

    def __init__(self, rules: Rules) -> None:
        self._rules = rules
        self._alike = rules.alike
        self._marks: list[_Mark] = []
        self._aside: list[_Mark] = []
        self._evidence: list[_Mark] = []
        self._entries = 0
        self._names = 0

    def add(self, edge: MappedLandmarks) -> Ints:
        """Take in a batch of landmarks of one agent, in the collective frame.

        Returns:
            (n,) numbers of the entries, which ``landmark_of`` counts by.
        """
        numbers = np.arange(self._entries, self._entries + len(edge), dtype=np.int64)
        self._entries += len(edge)
        new = _marks_of(edge, numbers)
        static = [mark for mark, moves in zip(new, edge.dynamic, strict=True) if not moves]
        moving = [mark for mark, moves in zip(new, edge.dynamic, strict=True) if moves]
        similar, unlike, away = self._nearest(static)
        there = list(self._marks)
        confidence = [mark.confidence for mark in there]
        put_aside = False
        for mark, one, other, way in zip(static, similar, unlike, away, strict=True):
            if one >= 0:
                there[one].take(mark)
            elif other < 0 or way > self._rules.radius / 2 or mark.confidence > confidence[other]:
                self._marks.append(self._named(mark))
            else:
                self._aside.append(mark)
                put_aside = True
        self._evidence += [self._named(mark) for mark in moving]
        while put_aside:  # ends, as each promotion leaves two landmarks fewer in all
            put_aside = self._promote()
        return numbers

    def landmarks(self) -> MappedLandmarks:
        """The map: landmarks in the order in which they came up, then the dynamic evidence."""
        return _columns([*self._marks, *self._evidence], len(self._marks))

    def aside(self) -> MappedLandmarks:
        """What is put aside, in the order in which it was; these have no names."""
        return _columns(self._aside, len(self._aside))

    def landmark_of(self) -> Ints:
        """(entries,) position in ``landmarks`` of what came in; -1 for what is put aside."""
        of = np.full(self._entries, -1, np.int64)
        for at, mark in enumerate([*self._marks, *self._evidence]):
            of[mark.entries] = at
        return of

    def _named(self, mark: _Mark) -> _Mark:
        self._names += 1
        mark.id = f"L{self._names}"
        return mark

    def _nearest(self, new: Sequence[_Mark]) -> tuple[list[int], list[int], list[float]]:
        """For each new one: nearest similar one within a, nearest dissimilar one, way to that."""
        similar = np.full(len(new), -1, np.int64)
        unlike, away = similar.copy(), np.full(len(new), np.inf)
        if new and self._marks:
            i, j, way = _within(new, self._marks, self._rules.radius)
            alike = self._alike[_features(new)[i], _features(self._marks)[j]]
            for one, rows in ((similar, alike), (unlike, ~alike)):
                order = np.lexsort((j[rows], way[rows], i[rows]))
                first, at = np.unique(i[rows][order], return_index=True)
                one[first] = j[rows][order][at]
                if one is unlike:
                    away[first] = way[rows][order][at]
        return similar.tolist(), unlike.tolist(), away.tolist()

    def _promote(self) -> bool:
        """Rule 4, for all that is put aside, the earliest first; says whether something changed."""
        i, j, _ = _within(self._aside, self._aside, self._rules.radius)
        feature = _features(self._aside)
        alike = self._alike[feature[i], feature[j]]
        near: dict[int, list[int]] = {}
        for one, other in zip(i[alike].tolist(), j[alike].tolist(), strict=True):
            near.setdefault(one, []).append(other)
        used: set[int] = set()
        promoted = []
        for one in sorted(near):
            group = sorted(set(near[one]) - used)
            if one not in used and len(group) >= LEAST:
                used.update(group)
                found = self._aside[group[0]]
                for other in group[1:]:
                    found.take(self._aside[other])
                promoted.append(found)
        self._aside = [mark for at, mark in enumerate(self._aside) if at not in used]
        _, unlike, _ = self._nearest(promoted)
        replaced = dict.fromkeys(at for at in unlike if at >= 0)  # none twice, in this order
        self._aside += [replace(self._marks[at], id="") for at in replaced]
        self._marks = [mark for at, mark in enumerate(self._marks) if at not in replaced]
        self._marks += [self._named(mark) for mark in promoted]
        return bool(promoted)


def _marks_of(edge: MappedLandmarks, numbers: Ints) -> list[_Mark]:
    columns = (
        edge.feature.tolist(),
        edge.confidence.tolist(),
        edge.sightings.tolist(),
        edge.key.tolist(),
        numbers.tolist(),
    )
    return [
        _Mark("", edge.xy[at], edge.covariance[at], feature, confidence, sightings, key, [number])
        for at, (feature, confidence, sightings, key, number) in enumerate(
            zip(*columns, strict=True)
        )
    ]


def _features(marks: Sequence[_Mark]) -> Ints:
    return np.array([mark.feature for mark in marks], np.int64)


def _within(
    one: Sequence[_Mark], other: Sequence[_Mark], radius: float
) -> tuple[Ints, Ints, Floats]:
    """Positions in two lists, and distance, of all pairs no farther apart than the radius."""
    from scipy.spatial import cKDTree

    trees = [cKDTree(np.array([mark.xy for mark in marks])) for marks in (one, other)]
    found = trees[0].sparse_distance_matrix(trees[1], radius, output_type="ndarray")
    return found["i"], found["j"], found["v"]


def _columns(marks: Sequence[_Mark], static: int) -> MappedLandmarks:
    n = len(marks)
    return MappedLandmarks(
        id=np.array([mark.id for mark in marks], object),
        xy=np.array([mark.xy for mark in marks], float).reshape(n, 2),
        covariance=np.array([mark.covariance for mark in marks], float).reshape(n, 2, 2),
        feature=_features(marks),
        confidence=np.array([mark.confidence for mark in marks], float),
        sightings=np.array([mark.sightings for mark in marks], np.int64),
        dynamic=np.arange(n) >= static,
        key=np.array([mark.key for mark in marks], object),
    )
