"""Merging: neighbouring fragments of one environment become one (design 6)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine.boundaries import Parting
from symboslam.engine.triangulation import delaunay_edges, pair_lines

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
WORK = 2_000_000
"""Landmarks, summed over the pairs that are tried; what is beyond stays apart."""


def neighbours(xy: Floats, reach: float) -> Ints:
    """(m, 2) positions that stand next to each other: edges of the Delaunay triangulation.

    Args:
        xy: (n, 2) distinct positions in metres.
        reach: longest edge that counts, in metres.
    """
    edges = delaunay_edges(xy)
    near = np.hypot(*(xy[edges[:, 0]] - xy[edges[:, 1]]).T) <= reach
    return np.asarray(edges[near])


def alike(next_to: Ints, fragment: Ints, label: Ints) -> Ints:
    """(j, 2) pairs of different fragments of one environment that have neighbours among them.

    Args:
        next_to: (m, 2) positions that are neighbours.
        fragment: (n,) number of the fragment of each position.
        label: (f,) environment of each fragment; -1 = unknown, which is like nothing.
    """
    pairs = np.sort(fragment[next_to], 1)
    one, two = pairs.T
    pairs = pairs[(one != two) & (label[one] == label[two]) & (label[one] >= 0)]
    return np.unique(pairs, axis=0).reshape(-1, 2)


def merged(fragment: Ints, pairs: Ints) -> Ints:
    """(n,) the fragments after pairs of them have become one, which keeps the lower number."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    m = int(fragment.max()) + 1
    joined = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(m, m))
    group = connected_components(joined, directed=False)[1]
    _, lowest = np.unique(group, return_index=True)
    return np.asarray(lowest[group][fragment], np.int64)


def merge_alike(
    xy: Floats,
    now: Parting,
    label: Ints,
    reach: float,
    label_of: Callable[[Ints, Ints], Ints],
) -> Ints:
    """(n,) the fragments after all like neighbours have merged whose lines cross no others then.

    In rounds, after each of which the environments of what has merged are looked at again. Each
    round leaves fewer fragments, so it ends. What could not merge is not tried again before one of
    the two has changed, but once more at the end.

    Args:
        xy: (n, 2) distinct positions in metres.
        now: their fragments, of which no lines cross.
        label: (f,) environment of each fragment; -1 = unknown.
        reach: longest line that counts, in metres.
        label_of: from (n,) fragments and some of their numbers the environments of these.
    """
    next_to, label = neighbours(xy, reach), label.copy()
    refused = np.zeros(0, np.int64)
    work = WORK
    while True:
        pairs = alike(next_to, now.fragment, label)
        name = pairs[:, 0] * len(label) + pairs[:, 1]
        round_ = _Round(xy, now, reach, work)
        for one, two in pairs[~np.isin(name, refused)].tolist():
            round_.merge(one, two)
        work = round_.work
        if not len(changed := round_.changed()):
            if not len(refused):
                return now.fragment
            refused = np.zeros(0, np.int64)
            continue
        now = round_.parting()
        label[changed] = label_of(now.fragment, changed)
        refused = name[~np.isin(pairs, changed).any(1)]


class _Round:
    """One round of merges, each made only if its new lines cross none that there are.

    Lines that were there before cross none that were; whether they cross one that a merge adds is
    looked at when it is added.
    """

    def __init__(self, xy: Floats, before: Parting, reach: float, work: int) -> None:
        self._xy, self._before, self._reach, self.work = xy, before, reach, work
        self._fragment = before.fragment.copy()
        self._group = np.arange(self._fragment.max() + 1)
        self._lines: dict[int, Ints] = {}
        self._short = before.lines[self._no_longer(before.lines)]
        self._tree = shapely.STRtree(shapely.linestrings(xy[self._short]))
        self._old = np.unique(self._names(before.lines))
        self._new: dict[int, NDArray[np.object_]] = {}

    def merge(self, one: int, two: int) -> None:
        """Make two fragments one, which keeps the lower number, if no lines cross then."""
        one, two = sorted(self._group[[one, two]].tolist())
        here = np.flatnonzero((self._fragment == one) | (self._fragment == two))
        if one == two or self.work < len(here):
            return
        self.work -= len(here)
        lines = here[pair_lines(self._xy[here], np.zeros(len(here), np.int64))]
        new = lines[self._no_longer(lines) & ~np.isin(self._names(lines), self._old)]
        drawn = shapely.linestrings(self._xy[new])
        near = self._short[self._tree.query(drawn, predicate="intersects")[1], 0]
        if np.isin(self._fragment[near], (one, two), invert=True).any():
            return
        others = [d for number, d in self._new.items() if number not in (one, two)]
        if others and len(
            shapely.STRtree(np.concatenate(others)).query(drawn, predicate="intersects")[0]
        ):
            return
        self._fragment[here] = one
        self._group[self._group == two] = one
        self._lines.pop(two, None)
        self._new.pop(two, None)
        self._lines[one], self._new[one] = lines, drawn

    def changed(self) -> Ints:
        """Numbers of the fragments that have taken others in."""
        return np.array(sorted(self._lines), np.int64)

    def parting(self) -> Parting:
        """The fragments after the round."""
        gone = np.isin(self._fragment[self._before.lines[:, 0]], self.changed())
        lines = np.concatenate([self._before.lines[~gone], *self._lines.values()])
        return Parting(self._fragment, lines, self._before.crossings)

    def _names(self, lines: Ints) -> Ints:
        low, high = lines.min(1, initial=len(self._xy)), lines.max(1, initial=0)
        return np.asarray(low * len(self._xy) + high)

    def _no_longer(self, lines: Ints) -> NDArray[np.bool_]:
        """(m,) which lines count: those that are not longer than the reach."""
        ends = self._xy[lines]
        return np.asarray(np.hypot(*(ends[:, 0] - ends[:, 1]).T) <= self._reach)
