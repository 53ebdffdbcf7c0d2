"""The paper's two equations: evidence from all pairs of landmarks inside a segment (design 5)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, nullcontext
from functools import cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symboslam.engine._base import CellEvidence, Contributions, normalised
from symboslam.engine.grid import Cells, Grid
from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.settings import Settings

if TYPE_CHECKING:
    from threadpoolctl import ThreadpoolController

Floats = NDArray[np.float64]
BLOCK = 256
"""Landmarks along each side of a block of distances: 0.5 MB, which stays in a cache."""


def one_thread() -> AbstractContextManager[object]:
    """While it lasts, products of matrices take one thread.

    Those of a segment are small and many: threads would wait for each other, and on a machine with
    other work several times as long as they compute.
    """
    limited: AbstractContextManager[object] = _controller().limit(limits=1, user_api="blas")
    return limited


@cache
def _controller() -> ThreadpoolController:
    from threadpoolctl import ThreadpoolController

    return ThreadpoolController()


def nearness(xy: Floats, member: Floats, diagonal: float) -> Floats:
    """Sum of 1 - d(x, y) over the other members y, for each landmark x and environment e.

    Args:
        xy: (z, 2) positions in metres.
        member: (z, K) 1 where SP(e, x) > 0.
        diagonal: the segment's diagonal in metres; d is the distance over it, at most 1.

    Returns:
        (z, K).
    """
    from scipy.spatial.distance import cdist

    scaled = xy / diagonal
    far = np.zeros(member.shape)
    blocks = [slice(start, start + BLOCK) for start in range(0, len(xy), BLOCK)]
    with one_thread() if len(blocks) > 1 else nullcontext():
        for i, rows in enumerate(blocks):
            for columns in blocks[i:]:  # distances are symmetric: each block serves twice
                d = cdist(scaled[rows], scaled[columns])
                far[rows] += d @ member[columns]
                if columns != rows:
                    far[columns] += d.T @ member[rows]
    # The sum of 1 - d is the number of members less the sum of d; none makes a pair with itself.
    return np.asarray(member.sum(0) - far - member)


def pair_evidence(
    xy: Floats, weight: Floats, diagonal: float, a: float = 0.5
) -> tuple[Floats, Floats, Floats]:
    """P~, C and n of one segment (paper equations 2 and 3 as made exact in design 5).

    C(e) = 1/n_e * sum over x != y in S_e of 1/2 (w_x + w_y)(1 - d(x, y)), and by symmetry that is
    1/n_e * sum over x of w_x * sum over y != x of (1 - d(x, y)), which is one matrix product.

    Args:
        xy: (z, 2) positions in metres.
        weight: (z, K) SP(e, x) * f_x; S_e are the rows above 0.
        diagonal: the segment's diagonal in metres.
        a: weight of C, 0 < a < 1.

    Returns:
        (P~ (K,), C (K,), n (K,)): P~ = a C + (1 - a) n / (z (z - 1)); all 0 where z < 2.
    """
    own, shared, n = pair_parts(xy, weight, diagonal, a)
    c = shared.sum(0) / a
    return own.sum(0) + shared.sum(0), c, n


def pair_parts(
    xy: Floats, weight: Floats, diagonal: float, a: float, near: Floats | None = None
) -> tuple[Floats, Floats, Floats]:
    """Each landmark's part of the second and of the first term of P~, both (z, K); and n (K,)."""
    z, k = weight.shape
    if z < 2:
        return np.zeros((z, k)), np.zeros((z, k)), np.zeros(k)
    member = (weight > 0).astype(np.float64)
    size = member.sum(0)
    n = size * (size - 1)
    near = (nearness(xy, member, diagonal) if near is None else near) * member
    shared = a * np.divide(weight * near, n, out=np.zeros((z, k)), where=n > 0)
    own = (1 - a) * member * np.maximum(size - 1, 0) / (z * (z - 1))
    return own, shared, n


class PairEvidence(CellEvidence):
    """Evidence from the pairs of landmarks inside each cell; cells know nothing of each other.

    Args:
        landmarks: the map.
        weight: (n, K) SP(e, x) * f_x of each landmark.
        grid: the nested cells.
        settings: a, threshold, min_landmarks.
        near: depth -> (n, K) what `nearness` gives within the cells of that depth, where that is
            known already.
    """

    def __init__(
        self,
        landmarks: LandmarkMap,
        weight: Floats,
        grid: Grid,
        settings: Settings,
        near: Sequence[Floats] | None = None,
    ) -> None:
        self._near = near
        self._landmarks, self._weight, self._grid, self._settings = (
            landmarks,
            weight,
            grid,
            settings,
        )
        row, column = grid.finest_of(landmarks.x, landmarks.y)
        self._sorted = {}
        for depth in range(grid.depth + 1):
            span = int(grid.span(depth))
            number = row // span * (grid.cells // span) + column // span
            order = np.argsort(number, kind="stable")
            self._sorted[depth] = (number[order], order)

    def members(self, cells: Cells) -> Iterator[NDArray[np.int64]]:
        """Positions of the landmarks in each cell."""
        for depth, row, column in zip(cells.depth, cells.row, cells.column, strict=True):
            numbers, order = self._sorted[int(depth)]
            number = row * (self._grid.cells // int(self._grid.span(int(depth)))) + column
            start, stop = np.searchsorted(numbers, [number, number + 1])
            yield order[start:stop]

    def _diagonals(self, cells: Cells) -> Floats:
        west, south, east, north = self._grid.rectangles(cells)
        return np.hypot(east - west, north - south)

    def of(self, cells: Cells) -> Floats:
        """(m, K) P~; one landmark alone makes no pair and so gives none."""
        evidence = np.zeros((len(cells), self._weight.shape[1]))
        for i, (_, own, shared) in enumerate(self._of_each(cells)):
            evidence[i] = own.sum(0) + shared.sum(0)
        return evidence

    def _of_each(self, cells: Cells) -> Iterator[tuple[NDArray[np.int64], Floats, Floats]]:
        """The landmarks in each cell, and each one's part of the two terms of P~."""
        xy, weight = self._landmarks.xy, self._weight
        for inside, diagonal, depth in zip(
            self.members(cells), self._diagonals(cells), cells.depth.tolist(), strict=True
        ):
            near = None if self._near is None else self._near[depth][inside]
            own, shared, _ = pair_parts(
                xy[inside], weight[inside], float(diagonal), self._settings.a, near
            )
            yield inside, own, shared

    def settled(self, cells: Cells, evidence: Floats) -> NDArray[np.bool_]:
        """A cell with too few landmarks, or whose largest P reaches the threshold."""
        count = np.array([len(inside) for inside in self.members(cells)])
        few = count < max(self._settings.min_landmarks, 1)
        sure = normalised(evidence).max(1, initial=0) >= self._settings.threshold
        return np.asarray(few | sure)

    def without(self, cells: Cells, landmarks: Sequence[int]) -> Floats:
        """(m, K) P~ if these landmarks were not there."""
        keep = np.ones(len(self._weight), bool)
        keep[list(landmarks)] = False
        rest = self._landmarks.take(keep)
        return PairEvidence(rest, self._weight[keep], self._grid, self._settings).of(cells)

    def contributions(self, cells: Cells) -> Iterator[Contributions]:
        """Each landmark's share of the inferences (own) and of C (pairs)."""
        for inside, own, shared in self._of_each(cells):
            yield Contributions(inside, own, shared, np.zeros(own.shape[1]))
