"""Counterfactuals: what a segment would be with some landmarks fewer or more.

The search, for a segment of type A:

- *Fewer*: greedy. The landmark whose loss brings the segment nearest to the other type goes, with
  its effect worked out exactly, until the type changes or ``MOST`` are gone; then whatever turns
  out not to be needed comes back. Then all smaller sets of the landmarks that have a say are tried,
  sizes 1, 2, ... as far as ``TRIES`` sets and ``WORK`` go: a smaller one that is found is taken,
  and if every smaller set was tried the result is *minimal*, proved.
- *More*: 1, 2, ... up to ``MOST`` sure landmarks of one class in the middle of the segment, for the
  classes of the map that speak most for another type; minimal for their class and place. In a
  segment of so many landmarks that ``WORK`` would be exceeded, fewer classes.

The segment's outline, bandwidth and the evidence of unmarked ground stay what they are. What is
found so for a fragment is then tried on the whole map (``anew.py``).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from itertools import combinations, islice
from math import comb

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine._base import normalised
from symboslam.engine.anew import proved
from symboslam.engine.changes import MOST, Counterfactual
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.fragments import Fragments
from symboslam.engine.local import LocalEvidence, local_evidence

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
CANDIDATES = 96
"""Landmarks that the greedy search chooses from: those that speak most for the type."""
TRIES = 5_000
"""Sets that the proof of minimality may try, in a segment of few landmarks."""
WORK = 250_000
"""Landmarks, summed over all sets, that each of the three searches may weigh."""
BLOCK = 100
"""Sets that the proof weighs at once: neighbours, so that few landmarks differ among them."""
CLASSES = 12
"""Feature classes that may be added: those that speak most for another type."""
CLEAR = 1e-12
"""Leads up to this are a draw."""


def without(
    environment_map: EnvironmentMap, segment_id: str, landmarks: list[int]
) -> dict[str, float]:
    """P(e) of a segment if these landmarks were not there, computed anew and so exact.

    The estimated evidence of unmarked ground stays what it was for the whole map; classifying the
    reduced landmarks with that ``absence`` gives the same numbers. A fragment stays the same
    but for these landmarks: it keeps its diagonal.

    Args:
        environment_map: the map.
        segment_id: the segment.
        landmarks: positions in ``environment_map.landmarks``.

    Returns:
        environment name -> P(e); all 0 where nothing is left to say.

    Raises:
        UnknownNameError: no such segment.
    """
    i = environment_map.position_of(segment_id)
    region = environment_map.regions.take(np.array([i]))
    values = environment_map.evidence.without(region, landmarks)
    return {
        e.name: float(p)
        for e, p in zip(environment_map.environments, normalised(values)[0], strict=True)
    }


def counterfactuals(
    environment_map: EnvironmentMap,
    segment_id: str,
    *,
    against: str | None = None,
    limit: int = 3,
    local: LocalEvidence | None = None,
) -> tuple[Counterfactual, ...]:
    """The smallest changes found that give a segment another type, fewer landmarks first.

    Args:
        environment_map: the map.
        segment_id: the segment; an unknown one has none.
        against: the type that it shall get; None: any other.
        limit: how many classes to add are told.
        local: the evidence around the segment, where it was made already.

    Raises:
        UnknownNameError: no such segment or type.
        InputError: the map's evidence is of a kind that cannot be weighed anew.
    """
    i = environment_map.position_of(segment_id)
    if environment_map.label[i] < 0:
        return ()
    local = local or local_evidence(environment_map, i)
    search = _Search(environment_map, i, local, against)
    fewer, more = search.fewer(), search.more()
    if isinstance(environment_map.regions, Fragments):
        sets = search.larger(fewer) if fewer else ()
        return proved(environment_map, i, sets, more, against=against, limit=limit)
    return ((fewer,) if fewer else ()) + more[:limit]


class _Search:
    """The search for changes of one segment."""

    def __init__(
        self, environment_map: EnvironmentMap, i: int, local: LocalEvidence, against: str | None
    ) -> None:
        self._map, self._position, self._local = environment_map, i, local
        self._names = [e.name for e in environment_map.environments]
        self._now = int(environment_map.label[i])
        self._wanted = None if against is None else environment_map.column_of(against)

    def _scores(self, evidence: Floats) -> Floats:
        """(b,) how far each evidence is beyond the change of type; above 0 it has happened."""
        p = normalised(evidence)
        if self._wanted is None:
            lead = np.delete(p, self._now, 1).max(1, initial=0) - p[:, self._now]
            lead[~evidence.any(1)] = 1.0  # nothing is left: unknown
        else:
            lead = p[:, self._wanted] - np.delete(p, self._wanted, 1).max(1, initial=0)
        return np.asarray(lead - CLEAR)

    def _changed(self, evidence: Floats, **change: object) -> Counterfactual:
        p = normalised(evidence[None])[0]
        name = self._names[int(p.argmax())] if p.any() else None
        return Counterfactual(name, float(p.max()), **change)  # type: ignore[arg-type]

    def fewer(self) -> Counterfactual | None:
        """The smallest set of landmarks found without which the type is another; None: none."""
        if self._wanted == self._now:
            return None
        found, tried = self._greedy()
        m = len(self._local.landmark)
        left = min(TRIES, WORK // max(m, 1))
        most = len(found) if found else min(m, MOST) + 1
        for size in range(1, most):
            if (left := left - comb(m, size)) < 0:
                break
            tried += comb(m, size)
            if smaller := self._exhaustive(size):
                found = smaller
                break
        minimal = left >= 0  # then all smaller sets were tried
        if not found:
            return None
        chosen = np.array(found)
        evidence = self._local.without(chosen, np.ones((1, len(found)), bool))[0]
        removed = tuple(sorted(self._local.landmark[chosen].tolist()))
        return self._changed(evidence, removed=removed, minimal=minimal, tried=tried)

    def larger(self, change: Counterfactual) -> tuple[Counterfactual, ...]:
        """A change, and changes of twice as many landmarks each, up to ``MOST`` of them."""
        order = self._local.landmark[self._order(self._rival())].tolist()
        chosen, found = list(change.removed), [change]
        more = [position for position in order if position not in set(chosen)]
        while more and 2 * len(chosen) <= MOST:
            chosen, more = chosen + more[: len(chosen)], more[len(chosen) :]
            found.append(replace(change, removed=tuple(sorted(chosen))))
        return tuple(found)

    def _rival(self) -> int:
        """The type that is wanted, or the one that comes second."""
        rivals = self._local.total.copy()
        rivals[self._now] = -1
        return int(rivals.argmax()) if self._wanted is None else self._wanted

    def _order(self, rival: int) -> Ints:
        """The landmarks as rows, those first that speak most for the type rather than a rival."""
        each = self._local.own + self._local.pairs
        return np.argsort(each[:, rival] - each[:, self._now], kind="stable").astype(np.int64)

    def _greedy(self) -> tuple[list[int], int]:
        """Rows of a set without which the type is another, empty if not found; sets tried."""
        order = self._order(self._rival())
        chosen = order[:CANDIDATES]
        q, tried = len(chosen), 0
        width = max(1, WORK // (MOST * max(len(order), 1)))  # the strongest that are weighed
        gone = np.zeros(q, np.bool_)
        for _ in range(min(q, MOST)):
            left = np.flatnonzero(~gone)[:width]
            sets = np.repeat(gone[None], len(left), 0)
            sets[np.arange(len(left)), left] = True
            scores = self._scores(self._local.without(chosen, sets))
            tried += len(sets)
            best = int(scores.argmax())
            gone[left[best]] = True
            if scores[best] > 0:
                break
        else:
            return [], tried
        for row in np.flatnonzero(gone).tolist():  # what is not needed comes back
            fewer = gone.copy()
            fewer[row] = False
            tried += 1
            if fewer.any() and self._scores(self._local.without(chosen, fewer[None]))[0] > 0:
                gone = fewer
        return chosen[gone].tolist(), tried

    def _exhaustive(self, size: int) -> list[int]:
        """The best of all sets of a size without which the type is another; empty: none is."""
        m = len(self._local.landmark)
        best, most = [], 0.0
        subsets = combinations(range(m), size)
        while block := list(islice(subsets, BLOCK)):
            rows, columns = np.unique(block, return_inverse=True)
            sets = np.zeros((len(block), len(rows)), np.bool_)
            sets[np.arange(len(block))[:, None], columns.reshape(-1, size)] = True
            scores = self._scores(self._local.without(rows, sets))
            if scores.max() > most:
                best, most = list(block[int(scores.argmax())]), float(scores.max())
        return best

    def more(self) -> tuple[Counterfactual, ...]:
        """For some classes the smallest number that gives another type, the smallest first."""
        middle = shapely.point_on_surface(self._map.geometry[self._position])
        place = np.array([middle.x, middle.y])
        counts, found, tried = np.arange(1, MOST + 1), [], 0
        for feature in self._speaking():
            evidence = self._local.plus(feature, place, counts)
            tried += len(counts)
            enough = np.flatnonzero(self._scores(evidence) > 0)
            if len(enough):
                change = {
                    "added": feature, "count": int(counts[enough[0]]),
                    "place": (float(place[0]), float(place[1])), "minimal": True,
                }  # fmt: skip
                found.append(self._changed(evidence[enough[0]], **change))
        found.sort(key=lambda each: (each.count, -each.probability))
        return tuple(replace(each, tried=tried) for each in found)

    def _speaking(self) -> Iterator[int]:
        """The classes of the map that speak most for a type that is wanted, the strongest first."""
        weight = self._local.proximity
        others = [
            k
            for k in range(len(self._names))
            if k != self._now and (self._wanted is None or k == self._wanted)
        ]
        present = np.unique(self._map.landmarks.feature)
        lead = (weight[present][:, others] - weight[present][:, [self._now]]).max(1, initial=0)
        most = max(1, min(CLASSES, WORK // (MOST * max(len(self._local.landmark), 1))))
        order = np.argsort(-lead, kind="stable")[:most]
        yield from present[order[lead[order] > 0]].tolist()
