"""Errors of landmarks by position: which are matched, coverage, accuracy, offsets of centres.

This asks only where things are, so it works for any two lists of landmarks. Errors that know which
sighting was of what are in ``identity_error``.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.error_statistics import Statistics
from symboslam.engine.slam.log import Floats, Ints
from symboslam.engine.slam.planar import place, rigid
from symboslam.engine.slam.trajectory_error import distances

SIMILAR = 0.5
"""Least semantic similarity of classes that may be of one landmark."""
ROUNDS = 20
"""Most alignments before what is matched must have settled."""


@dataclass(frozen=True)
class Points:
    """Landmarks by position.

    Attributes:
        id: (n,) names.
        xy: (n, 2) metres.
        feature: (n,) position of the class in a list of classes; -1 if not known.
    """

    id: NDArray[np.object_]
    xy: Floats
    feature: Ints

    def __len__(self) -> int:
        return len(self.xy)


@dataclass(frozen=True)
class LandmarkScore:
    """How landmarks agree with true ones, by position.

    Attributes:
        pairs: (k, 2) position in the map and in the truth of what is matched.
        coverage: share of the true landmarks that are matched; None if there are none.
        accuracy: share of the map's landmarks that are matched to one of the same class (of any,
            where the true class is not known); None if the map has none.
        offset: metres between the centres of the pairs; its mean is the paper's Er. None without.
        alignment: (3,) pose that was applied to the map; None for none.
    """

    pairs: Ints
    coverage: float | None
    accuracy: float | None
    offset: Statistics | None
    alignment: Floats | None = None


def score_landmarks(
    found: Points,
    true: Points,
    similarity: Floats,
    radius: float,
    *,
    least: float = SIMILAR,
    alignment: Floats | None = None,
) -> LandmarkScore:
    """Match landmarks with the true ones and say how well they agree.

    Args:
        found: the map's landmarks.
        true: the true ones.
        similarity: (C, C) how alike the classes are, in [0, 1].
        radius: largest distance in metres of a pair.
        least: least similarity of classes that can be a pair.
        alignment: (3,) pose to apply to the map first.
    """
    xy = found.xy if alignment is None else place(alignment, found.xy)
    pairs = match(Points(found.id, xy, found.feature), true, similarity, radius, least)
    i, j = pairs.T
    one, other = found.feature[i], true.feature[j]
    right = int(((one == other) | (one < 0) | (other < 0)).sum())
    return LandmarkScore(
        pairs=pairs,
        coverage=len(pairs) / len(true) if len(true) else None,
        accuracy=right / len(found) if len(found) else None,
        offset=Statistics.of(distances(xy[i], true.xy[j])),
        alignment=alignment,
    )


def score_aligned(
    found: Points,
    true: Points,
    similarity: Floats,
    radius: float,
    *,
    least: float = SIMILAR,
    start: Floats | None = None,
) -> LandmarkScore | None:
    """The same after the best rigid alignment (Umeyama 1991, without scale).

    What is matched depends on the alignment, and the alignment on what is matched, so the two are
    repeated until the pairs stay, at most 20 times.

    Args:
        found: as in ``score_landmarks``.
        true: as there.
        similarity: as there.
        radius: as there.
        least: as there.
        start: (3,) alignment to begin with; None for none.

    Returns:
        The score; None where fewer than two pairs are found.
    """
    score = score_landmarks(found, true, similarity, radius, least=least, alignment=start)
    for _ in range(ROUNDS):
        if len(score.pairs) < 2:
            return None
        before, (i, j) = score.pairs, score.pairs.T
        best = rigid(found.xy[i], true.xy[j])
        score = score_landmarks(found, true, similarity, radius, least=least, alignment=best)
        if np.array_equal(before, score.pairs):
            break
    return score


def match(found: Points, true: Points, similarity: Floats, radius: float, least: float) -> Ints:
    """(k, 2) pairs, each landmark in one at most: as many as can be, then the shortest in sum.

    A pair may be no longer than the radius and of classes that are at least so similar; a class
    that is not known is similar to all. The assignment problem is solved exactly, on the pairs
    that may be (scipy's sparse variant of ``linear_sum_assignment``).

    Args:
        found: the map's landmarks.
        true: the true ones.
        similarity: (C, C).
        radius: metres.
        least: least similarity.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import min_weight_full_bipartite_matching
    from scipy.spatial import cKDTree

    n, m = len(found), len(true)
    if not n or not m:
        return np.empty((0, 2), np.int64)
    near = cKDTree(found.xy).sparse_distance_matrix(cKDTree(true.xy), radius, output_type="ndarray")
    i, j, way = near["i"], near["j"], near["v"]
    one, other = found.feature[i], true.feature[j]
    like = (one == other) | (one < 0) | (other < 0) | (similarity[one, other] >= least)
    i, j, way = i[like], j[like], way[like]
    # A landmark that stays alone is paired with a stand-in, which costs more than all else.
    alone = np.arange(n)
    rows, columns = np.concatenate([i, alone]), np.concatenate([j, m + alone])
    cost = 1 + np.concatenate([way, np.full(n, 1 + 2 * radius * n)])  # 0 would be no edge
    graph = coo_array((cost, (rows, columns)), shape=(n, m + n)).tocsr()
    row, column = min_weight_full_bipartite_matching(graph)
    kept = column < m
    return np.column_stack([row[kept], column[kept]]).astype(np.int64)
