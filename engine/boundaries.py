"""Boundaries between fragments: where their pair lines cross, landmarks are traded (design 6).

A fragment's pair lines are those of its Euclidean minimum spanning tree: of all lines between its
landmarks the fewest and shortest that hold it together. Lines longer than the reach hold nothing
together, because the ground between their ends belongs to nobody.

Rounds of trades. At each crossing of two lines, the landmarks of both fragments around it, without
the four at the lines' ends, are parted by the boundary with the largest margin; those of the four
(and of the others, where no boundary parts all) that stand on the wrong side change over. A round
is kept if fewer crossings are left after it than before.

It ends: the number of crossings is a whole number that is never negative and falls with each round
that is kept. After the first round that is not kept, the lines that cross most are taken out, until
none cross. A tree without a line is two trees, each the minimum spanning tree of its landmarks, so
a fragment falls into parts whose lines are all among the lines that were there: no new crossing can
arise, and none is left.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine.triangulation import pair_lines

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
AROUND = 16
"""Landmarks nearest to a crossing, of whatever fragment, among which those of the two count."""
HARD = 1e4
"""Weight of a landmark on the wrong side against the width of the margin."""


@dataclass(frozen=True)
class Parting:
    """What belongs to which fragment, and where that is disputed.

    Attributes:
        fragment: (n,) number of the fragment of each position.
        lines: (m, 2) pair lines of all fragments, as positions.
        crossings: (c, 2) pairs of lines of two fragments that cross or touch, none longer than the
            reach; as rows of ``lines``.
    """

    fragment: Ints
    lines: Ints
    crossings: Ints

    @classmethod
    def of(cls, xy: Floats, fragment: Ints, reach: float, before: Parting | None = None) -> Parting:
        """The pair lines of fragments of distinct positions, and where they cross.

        Lines of fragments that are as they were ``before`` are taken over.
        """
        if before is None:
            lines = pair_lines(xy, fragment)
            return cls(fragment, lines, crossings(xy, fragment, lines, reach))
        moved = fragment != before.fragment
        changed = np.union1d(fragment[moved], before.fragment[moved])
        here = np.flatnonzero(np.isin(fragment, changed))
        old = before.lines[~np.isin(before.fragment[before.lines[:, 0]], changed)]
        lines = np.concatenate([old, here[pair_lines(xy[here], fragment[here])]])
        clear = 0 if len(before.crossings) else len(old)
        return cls(fragment, lines, crossings(xy, fragment, lines, reach, clear))


def crossings(xy: Floats, fragment: Ints, lines: Ints, reach: float, clear: int = 0) -> Ints:
    """(c, 2) lines of different fragments that have a point in common, in order.

    Args:
        xy: (n, 2) positions in metres.
        fragment: (n,) number of the fragment of each.
        lines: (m, 2) lines between positions.
        reach: longest line that counts, in metres.
        clear: of so many lines at the beginning it is known that they do not cross each other.
    """
    short = np.flatnonzero(np.hypot(*(xy[lines[:, 0]] - xy[lines[:, 1]]).T) <= reach)
    drawn = shapely.linestrings(xy[lines[short]])
    asked = np.flatnonzero(short >= clear)
    one, two = shapely.STRtree(drawn).query(drawn[asked], predicate="intersects")
    one, two = short[asked[one]], short[two]
    other = (one > two) & (fragment[lines[one, 0]] != fragment[lines[two, 0]])
    found = np.column_stack([two[other], one[other]])
    return np.asarray(found[np.lexsort(found.T[::-1])])


def settle(
    xy: Floats,
    fragment: Ints,
    reach: float,
    tell: Callable[[float], None] = lambda share: None,
) -> Ints:
    """Trade landmarks between fragments until no pair lines of two fragments cross.

    Args:
        xy: (n, 2) distinct positions in metres.
        fragment: (n,) number of the fragment of each.
        reach: longest line that counts, in metres.
        tell: called now and then with the share of crossings that is resolved.

    Returns:
        (n,) numbers of the fragments; those that fall apart get new ones.
    """
    now = Parting.of(xy, fragment, reach)
    at_first = max(len(now.crossings), 1)
    while len(now.crossings):
        after = Parting.of(xy, traded(xy, now), reach, now)
        if len(after.crossings) >= len(now.crossings):
            return _cut(now)
        now = after
        tell(1 - len(now.crossings) / at_first)
    return now.fragment


def traded(xy: Floats, now: Parting) -> Ints:
    """(n,) the fragments after one round of trades.

    Crossings are taken in order; what has changed over in this round stays for its rest.
    """
    from scipy.spatial import cKDTree

    fragment = now.fragment.copy()
    moved = np.zeros(len(xy), bool)
    ends = np.concatenate([now.lines[now.crossings[:, 0]], now.lines[now.crossings[:, 1]]], axis=1)
    middle = _meeting(xy, ends)
    near = cKDTree(xy).query(middle, min(AROUND, len(xy)))[1].reshape(len(ends), -1)
    scale = np.hypot(*(xy[near[:, -1]] - middle).T)
    for four, centre, size, around in zip(ends, middle, scale.tolist(), near, strict=True):
        if moved[four].any():
            continue
        one, two = fragment[four[0]], fragment[four[2]]
        here = fragment[around]
        known = around[((here == one) | (here == two)) & ~np.isin(around, four)]
        judged = np.concatenate([four, known])
        place = (xy[judged] - centre) / (size or 1.0)
        is_two = fragment[judged] == two
        sides = _sides(place[4:], is_two[4:], place)
        if sides is None:
            continue
        wrong = sides != is_two
        fragment[judged[wrong]] = np.where(is_two[wrong], one, two)
        moved[judged[wrong]] = True
    return fragment


def _meeting(xy: Floats, ends: Ints) -> Floats:
    """(c, 2) where each two lines meet: the middle of what they have in common."""
    one, two = shapely.linestrings(xy[ends[:, :2]]), shapely.linestrings(xy[ends[:, 2:]])
    common = shapely.centroid(shapely.intersection(one, two))
    found = np.column_stack([shapely.get_x(common), shapely.get_y(common)])
    missing = ~np.isfinite(found).all(1)  # they only just touch, and rounding parts them
    found[missing] = xy[ends[missing]].mean(1)
    return found


def _sides(known: Floats, is_two: NDArray[np.bool_], place: Floats) -> NDArray[np.bool_] | None:
    """On which side of the boundary places lie; None if one fragment has nothing around there.

    Args:
        known: (k, 2) landmarks that the boundary is to part.
        is_two: (k,) which of them are of the second fragment.
        place: (j, 2) places.
    """
    if is_two.all() or not is_two.any():
        return None
    from sklearn import config_context
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.svm import SVC

    with config_context(assume_finite=True, skip_parameter_validation=True):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ConvergenceWarning)
            boundary = SVC(kernel="linear", C=HARD, max_iter=10_000).fit(known, is_two)
            if (boundary.predict(known) != is_two).any():
                boundary = SVC(kernel="rbf", gamma=4.0, C=HARD, max_iter=10_000).fit(known, is_two)
        return np.asarray(boundary.predict(place), np.bool_)


def _cut(now: Parting) -> Ints:
    """(n,) the fragments after taking out lines until none cross, those that cross most first."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    kept = np.ones(len(now.lines), bool)
    for line in _covering(now.crossings, len(now.lines)):
        kept[line] = False
    n = len(now.fragment)
    one, two = now.lines[kept].T
    joined = coo_array((np.ones(len(one)), (one, two)), shape=(n, n))
    parts = connected_components(joined, directed=False)[1]
    return _renumbered(now.fragment, parts.astype(np.int64))


def _covering(crossings: Ints, lines: int) -> Iterator[int]:
    """Lines without which none cross: again and again the one with most crossings, ties by row."""
    from heapq import heapify, heappop, heappush

    others: list[set[int]] = [set() for _ in range(lines)]
    for one, two in crossings.tolist():
        others[one].add(two)
        others[two].add(one)
    heap = [(-len(o), line) for line, o in enumerate(others) if o]
    heapify(heap)
    while heap:
        count, line = heappop(heap)
        if not others[line]:
            continue
        if -count != len(others[line]):
            heappush(heap, (-len(others[line]), line))
            continue
        for other in others[line]:
            others[other].discard(line)
        others[line].clear()
        yield line


def _renumbered(fragment: Ints, parts: Ints) -> Ints:
    """(n,) the largest part of each fragment keeps its number, the others get new ones."""
    label, first, size = np.unique(parts, return_index=True, return_counts=True)
    owner = fragment[first]
    order = np.lexsort((first, -size, owner))
    rank_new = np.diff(owner[order], prepend=-1) == 0
    number = owner.copy()
    number[order[rank_new]] = fragment.max() + 1 + np.arange(int(rank_new.sum()))
    return np.asarray(number[np.searchsorted(label, parts)])
