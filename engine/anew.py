"""Counterfactuals of fragments, proved by cutting the map anew.

Without some landmarks, or with some more, fragments grow in another way. So a change that gives a
fragment another type if it is held as it is, is applied to the landmarks, the map is cut anew, and
what the ground in the middle of the segment is then is what is told. A change that does not do it
is doubled, up to ``MOST`` landmarks. On a map of so many landmarks that not one such run fits
into ``LANDMARKS``, changes of the fragment as it is are told, and marked so.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import islice

import numpy as np
import shapely

from symboslam.engine.changes import MOST, Counterfactual, applied
from symboslam.engine.environment_map import EnvironmentMap

LANDMARKS = 40_000
"""Landmarks, summed over all runs, that the proofs of one segment may cut anew."""
RUNS = 20
"""Runs that they may take."""


def proved(
    environment_map: EnvironmentMap,
    position: int,
    fewer: Sequence[Counterfactual],
    more: Sequence[Counterfactual],
    *,
    against: str | None,
    limit: int,
) -> tuple[Counterfactual, ...]:
    """Those of some changes of a fragment that do it on a map that is cut anew.

    Args:
        environment_map: the map.
        position: of the segment.
        fewer: landmarks to take away, each set with more than the one before; the first that does
            it is told.
        more: landmarks to add, of one class each; larger numbers follow from them.
        against: the type that it shall get; None: any other.
        limit: how many classes to add are told.
    """
    runs = min(RUNS, LANDMARKS // max(len(environment_map.landmarks), 1))
    if not runs:
        held = [*islice(fewer, 1), *islice(more, limit)]
        return tuple(replace(each, anew=False, minimal=False) for each in held)
    proof = _Proof(environment_map, position, against)
    found = list(islice(filter(None, map(proof.of, fewer[: max(runs // 2, 1)])), 1))
    left = runs - proof.runs
    found += islice(filter(None, map(proof.of, islice(_larger(more), left))), limit)
    return tuple(found)


def _larger(more: Sequence[Counterfactual]) -> Iterator[Counterfactual]:
    """Each change as it is, then all with twice as many landmarks, and so on."""
    while more:
        yield from more
        more = [replace(c, count=2 * c.count) for c in more if 2 * c.count <= MOST]


class _Proof:
    """Cuts a map anew with changes, and looks at the middle of one segment."""

    def __init__(self, environment_map: EnvironmentMap, position: int, against: str | None) -> None:
        self._map, self._against = environment_map, against
        self._now = environment_map.name_of(position)
        self._middle = shapely.point_on_surface(environment_map.geometry[position])
        self._done: set[int] = set()
        self.runs = 0

    def of(self, change: Counterfactual) -> Counterfactual | None:
        """The change with what it leads to, or None if it does not do it or is not needed."""
        from symboslam.engine.classify import classify

        if change.added is not None and change.added in self._done:
            return None  # fewer of this class do it
        self.runs += 1
        m = self._map
        again = classify(applied(m, change), m.knowledge, **dict(m.config))
        there = np.flatnonzero(shapely.intersects(again.geometry, self._middle))
        i = int(there[-1]) if len(there) else 0
        name = again.name_of(i)
        if name == self._now or (self._against is not None and name != self._against):
            return None
        if change.added is not None:
            self._done.add(change.added)
        p = float(again.probability[i].max()) if name is not None else 0.0
        alone = len(change.removed) + change.count == 1  # there is no smaller change
        return replace(change, environment=name, probability=p, anew=True, minimal=alone)
