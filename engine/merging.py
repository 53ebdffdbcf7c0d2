"""Merging: neighbouring fragments of one environment become one (design 6)."""

from __future__ import annotations

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine.boundaries import Parting
from symboslam.engine.triangulation import delaunay_edges, pair_lines

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
WORK = 3_000_000
"""Landmarks, summed over the pairs that are tried one by one; what is beyond stays apart."""


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


def merged_uncrossed(xy: Floats, before: Parting, pairs: Ints, reach: float) -> Parting:
    """As ``merged``, but only as far as no pair lines of two fragments cross afterwards.

    Two fragments that a line joins which crosses another one are not merged; where there are no
    such two, whatever is involved in a crossing stays as it is. Each round has fewer pairs, and
    fragments that nothing merges with have no crossings, because they had none before. If nothing
    is left to merge, the pairs are tried one by one.

    Args:
        xy: (n, 2) distinct positions in metres.
        before: their fragments, of which no lines cross.
        pairs: (j, 2) fragments that are to become one.
        reach: longest line that counts, in metres.
    """
    fragment, wanted = before.fragment, pairs
    while len(pairs):
        found = merged(fragment, pairs)
        now = Parting.of(xy, found, reach, before)
        if not len(now.crossings):
            return now
        ends = now.lines[np.unique(now.crossings)]
        joined = np.sort(fragment[ends], 1)
        bad = (pairs[:, None] == joined[None]).all(2).any(1)
        if not bad.any():
            bad = np.isin(merged(np.arange(fragment.max() + 1), pairs)[pairs[:, 0]], found[ends])
        pairs = pairs[~bad]
    return Parting.of(xy, _one_by_one(xy, before, wanted, reach), reach, before)


def _one_by_one(xy: Floats, before: Parting, pairs: Ints, reach: float) -> Ints:
    """(n,) the fragments after merging each pair that can be alone, each fragment once."""
    fragment, work = before.fragment.copy(), WORK
    short = before.lines[_no_longer(xy, before.lines, reach)]
    tree = shapely.STRtree(shapely.linestrings(xy[short]))
    taken: set[int] = set()
    added = np.zeros(0, object)
    for one, two in pairs.tolist():
        here = np.flatnonzero((fragment == one) | (fragment == two))
        if taken & {one, two} or (work := work - len(here)) < 0:
            continue
        lines = here[pair_lines(xy[here], np.zeros(len(here), np.int64))]
        drawn = shapely.linestrings(xy[lines[_no_longer(xy, lines, reach)]])
        near = before.fragment[short[tree.query(drawn, predicate="intersects")[1], 0]]
        if np.isin(near, (one, two), invert=True).any():
            continue
        if len(shapely.STRtree(added).query(drawn, predicate="intersects")[0]):
            continue
        fragment[here] = one
        taken |= {one, two}
        added = np.append(added, drawn)
    return fragment


def _no_longer(xy: Floats, lines: Ints, reach: float) -> NDArray[np.bool_]:
    """(m,) which lines count: those that are not longer than the reach."""
    return np.asarray(np.hypot(*(xy[lines[:, 0]] - xy[lines[:, 1]]).T) <= reach)
