"""Who is next to whom: neighbours by Delaunay's triangulation, and the pair lines of fragments."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
FEW = 24
"""Up to this many landmarks all pairs are looked at, which is faster than a triangulation."""


def delaunay_edges(xy: Floats) -> Ints:
    """(m, 2) edges of the Delaunay triangulation of distinct points, the lower position first.

    Points on one line, or fewer than three, are joined one after the other along it.

    Args:
        xy: (n, 2) positions in metres.
    """
    from scipy.spatial import Delaunay, QhullError

    if len(xy) < 2:
        return np.zeros((0, 2), np.int64)
    try:
        found = Delaunay(xy - xy.mean(0)) if len(xy) > 3 or _has_area(xy) else None
    except QhullError:
        found = None
    if found is None:
        along = np.linalg.svd(xy - xy.mean(0), full_matrices=False)[2][0]
        order = np.argsort(xy @ along, kind="stable")
        edges = np.column_stack([order[:-1], order[1:]])
    else:
        one, two, three = found.simplices.T
        left_out, _, nearest = found.coplanar.T  # too near to another to be told apart from it
        first, second = [one, two, three, left_out], [two, three, one, nearest]
        edges = np.column_stack([np.concatenate(first), np.concatenate(second)])
    edges = edges.astype(np.int64)
    number = np.unique(edges.min(1) * len(xy) + edges.max(1))  # each edge once, in order
    return np.column_stack(np.divmod(number, len(xy)))


def _has_area(xy: Floats) -> bool:
    return len(xy) == 3 and bool(np.linalg.matrix_rank(xy - xy.mean(0)) == 2)


def pair_lines(xy: Floats, fragment: Ints) -> Ints:
    """(m, 2) the shortest lines that join the landmarks of each fragment: its Euclidean MST.

    Args:
        xy: (n, 2) distinct positions in metres.
        fragment: (n,) number of the fragment that each is in.

    Returns:
        For a fragment of z positions z - 1 lines.
    """
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import minimum_spanning_tree

    n = len(xy)
    order = np.argsort(fragment, kind="stable")
    starts = np.flatnonzero(np.diff(fragment[order], prepend=-1)) if n else np.zeros(0, np.int64)
    sizes = np.diff(np.append(starts, n))
    candidates = [np.zeros((0, 2), np.int64)]
    for size in np.unique(sizes[(sizes > 1) & (sizes <= FEW)]).tolist():
        one, two = np.triu_indices(size, 1)
        rows = order[starts[sizes == size][:, None] + np.arange(size)]
        candidates.append(np.column_stack([rows[:, one].ravel(), rows[:, two].ravel()]))
    for start, size in zip(starts[sizes > FEW], sizes[sizes > FEW], strict=True):
        members = order[start : start + size]
        candidates.append(members[delaunay_edges(xy[members])])
    edges = np.concatenate(candidates)
    length = np.hypot(*(xy[edges[:, 0]] - xy[edges[:, 1]]).T)
    tree = minimum_spanning_tree(coo_array((length, edges.T), shape=(n, n)).tocsr()).tocoo()
    return np.column_stack([tree.row, tree.col]).astype(np.int64)
