"""Fragments: sets of landmarks, and the evidence from all pairs within each (design 5)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.engine._base import Contributions, Evidence, normalised
from symboslam.engine.evidence import pair_parts

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
LARGE = 500
"""Landmarks from which on what was found of a fragment is remembered."""
REMEMBERED = 16
"""Fragments of which it is: the latest."""


@dataclass(frozen=True)
class Fragments:
    """Some fragments of a map.

    Attributes:
        members: positions of the landmarks in each of m fragments, in order.
        diagonal: (m,) diagonals in metres of the boxes around them, over which distances count.
    """

    members: tuple[Ints, ...]
    diagonal: Floats

    @classmethod
    def of(cls, fragment: Ints, xy: Floats) -> Fragments:
        """All fragments.

        Args:
            fragment: (n,) number of the fragment of each landmark; all from 0 on occur.
            xy: (n, 2) positions in metres.
        """
        if not len(fragment):
            return cls((), np.zeros(0))
        order = np.argsort(fragment, kind="stable")
        starts = np.flatnonzero(np.diff(fragment[order], prepend=-1))
        low, high = (f.reduceat(xy[order], starts) for f in (np.minimum, np.maximum))
        return cls(tuple(np.split(order, starts[1:])), np.hypot(*(high - low).T))

    @classmethod
    def some(cls, fragment: Ints, xy: Floats, numbers: Ints) -> Fragments:
        """The fragments of these numbers, in order; see ``of``."""
        here = np.flatnonzero(np.isin(fragment, numbers))
        found = cls.of(np.searchsorted(numbers, fragment[here]), xy[here])
        return cls(tuple(here[members] for members in found.members), found.diagonal)

    def __len__(self) -> int:
        return len(self.members)

    def take(self, index: NDArray[np.generic]) -> Fragments:
        """The fragments at ``index`` (integers or a mask)."""
        chosen = np.arange(len(self))[index].tolist()
        return Fragments(tuple(self.members[i] for i in chosen), self.diagonal[index])

    def without(self, landmarks: Sequence[int]) -> Fragments:
        """The same with the same diagonals, but for some landmarks."""
        gone = np.array(list(landmarks), np.int64)
        kept = (m[~np.isin(m, gone)] for m in self.members)
        return Fragments(tuple(kept), self.diagonal)


class FragmentEvidence(Evidence[Fragments]):
    """Evidence from the pairs of landmarks inside each fragment.

    A landmark alone makes no pair; what it says counts by itself: P~ is SP times confidence.

    Args:
        xy: (n, 2) positions of all landmarks in metres.
        weight: (n, K) SP(e, x) * f_x of each.
        a: weight of C against the share of pairs.
    """

    def __init__(self, xy: Floats, weight: Floats, a: float) -> None:
        self._xy, self._weight, self._a = xy, weight, a
        self._latest: dict[tuple[bytes, float], Contributions] = {}

    def of(self, regions: Fragments) -> Floats:
        """(m, K) P~ of each fragment."""
        evidence = np.zeros((len(regions), self._weight.shape[1]))
        for i, parts in enumerate(self.contributions(regions)):
            evidence[i] = parts.total
        return evidence

    def probability(self, regions: Fragments) -> Floats:
        """(m, K) P of each fragment, or 0 where nothing speaks for any environment.

        Where one environment alone has pairs its P is 1, and no distance is needed to know that.
        """
        found = np.zeros((len(regions), self._weight.shape[1]))
        member = self._weight > 0
        open_ones = []
        for i, members in enumerate(regions.members):
            paired = np.flatnonzero(member[members].sum(0) > 1)
            if len(paired) == 1:
                found[i, paired] = 1.0
            else:
                open_ones.append(i)
        rest = np.array(open_ones, np.int64)
        found[rest] = normalised(self.of(regions.take(rest)))
        return found

    def without(self, regions: Fragments, landmarks: Sequence[int]) -> Floats:
        """(m, K) P~ of each fragment if these landmarks were not there."""
        return self.of(regions.without(landmarks))

    def contributions(self, regions: Fragments) -> Iterator[Contributions]:
        """Each landmark's share of the inferences (own) and of C (pairs)."""
        for members, diagonal in zip(regions.members, regions.diagonal.tolist(), strict=True):
            if len(members) < LARGE:
                yield self._of_one(members, diagonal)
                continue
            key = members.tobytes(), diagonal
            if key not in self._latest:
                self._latest[key] = self._of_one(members, diagonal)
                if len(self._latest) > REMEMBERED:
                    del self._latest[next(iter(self._latest))]
            yield self._latest[key]

    def _of_one(self, members: Ints, diagonal: float) -> Contributions:
        weight, nothing = self._weight[members], np.zeros(self._weight.shape[1])
        if len(members) == 1:
            return Contributions(members, weight, np.zeros(weight.shape), nothing)
        # All at one place: they are no distance apart, whatever it is divided by.
        own, shared, _ = pair_parts(self._xy[members], weight, diagonal or 1.0, self._a)
        return Contributions(members, own, shared, nothing)
