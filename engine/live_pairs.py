"""LivePairs: how near landmarks are to the others in their cells, kept up to date.

A landmark that comes or goes costs one distance to each other landmark in its cells, never the
distances between all of them (design 5).
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.grid import Grid
from symboslam.engine.table import Landmark

Floats = NDArray[np.float64]
Rows = NDArray[np.int64]


class LivePairs:
    """What `evidence.nearness` gives for each landmark, at each depth.

    Args:
        grid: the nested cells.
        proximity: (features, K) semantic proximity; S_e are the features above 0.
    """

    def __init__(self, grid: Grid, proximity: Floats) -> None:
        self._grid = grid
        self._member = (proximity > 0).astype(np.float64)
        self._cells: list[dict[tuple[int, int], set[int]]] = [{} for _ in range(grid.depth + 1)]
        self._xy = np.zeros((0, 2))
        self._members = np.zeros((0, proximity.shape[1]))
        self._near = np.zeros((grid.depth + 1, 0, proximity.shape[1]))

    def near(self, rows: Rows) -> Floats:
        """(depths, m, K) for some rows."""
        return self._near[:, rows]

    def follow(self, gone: Iterable[int], come: Iterable[tuple[int, Landmark]]) -> None:
        """Take over that landmarks left rows, and then that others, or the same, are in rows."""
        for row in gone:
            self._leave(row)
        for row, landmark in come:
            self._come(row, landmark)

    def _leave(self, row: int) -> None:
        for depth, cell in enumerate(self._cells_of(row)):
            others = self._cells[depth][cell]
            others.discard(row)
            self._count(depth, row, others, -1.0)

    def _come(self, row: int, landmark: Landmark) -> None:
        self._grow(row)
        self._xy[row] = landmark.x, landmark.y
        self._members[row] = self._member[landmark.feature]
        for depth, cell in enumerate(self._cells_of(row)):
            others = self._cells[depth].setdefault(cell, set())
            self._near[depth, row] = self._count(depth, row, others, 1.0)
            others.add(row)

    def _count(self, depth: int, row: int, others: set[int], sign: float) -> Floats:
        """Add a landmark to its neighbours' sums; (K,) its own."""
        if not others:
            return np.zeros(self._members.shape[1])
        rows = np.fromiter(others, np.int64, len(others))
        rows.sort()
        width, height = self._grid.step
        diagonal = float(self._grid.span(depth)) * float(np.hypot(width, height))
        closeness = 1 - np.hypot(*(self._xy[rows] - self._xy[row]).T) / diagonal
        self._near[depth, rows] += sign * closeness[:, None] * self._members[row]
        return np.asarray(closeness @ self._members[rows])

    def _cells_of(self, row: int) -> list[tuple[int, int]]:
        """The cell at each depth."""
        x, y = self._xy[row]
        r, c = (int(v[0]) for v in self._grid.finest_of(np.array([x]), np.array([y])))
        depth = self._grid.depth
        return [(r >> (depth - d), c >> (depth - d)) for d in range(depth + 1)]

    def _grow(self, row: int) -> None:
        missing = row + 1 - len(self._xy)
        if missing > 0:
            more = max(missing, len(self._xy), 256)
            self._xy = np.pad(self._xy, ((0, more), (0, 0)))
            self._members = np.pad(self._members, ((0, more), (0, 0)))
            self._near = np.pad(self._near, ((0, 0), (0, more), (0, 0)))
