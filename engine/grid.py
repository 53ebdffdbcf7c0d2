"""Grid: nested cells over a rectangle, and the quadtree that decides which become segments."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.landmarks import Box

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]
MAX_DEPTH = 3
"""How often a cell of the coarsest level can be split (the paper's 3 x 3 becomes 24 x 24)."""


@dataclass(frozen=True)
class Cells:
    """Some cells of a grid: (m,) depth, row from the south, column from the west."""

    depth: Ints
    row: Ints
    column: Ints

    def __len__(self) -> int:
        return len(self.depth)

    def take(self, index: NDArray[np.generic]) -> Cells:
        """The cells at ``index`` (integers or a mask)."""
        return Cells(self.depth[index], self.row[index], self.column[index])

    def parent(self) -> Cells:
        """The cells that these were split from."""
        return Cells(self.depth - 1, self.row // 2, self.column // 2)


@dataclass(frozen=True)
class Grid:
    """``cells`` x ``cells`` finest cells over ``box``, nested up to three levels.

    Attributes:
        box: (min x, min y, max x, max y) in metres.
        cells: finest cells along each side.
    """

    box: Box
    cells: int

    @property
    def depth(self) -> int:
        """Levels below the coarsest; cells that cannot be halved three times have fewer."""
        depth = 0
        while depth < MAX_DEPTH and self.cells % 2 ** (depth + 1) == 0:
            depth += 1
        return depth

    @property
    def step(self) -> tuple[float, float]:
        """(width, height) of a finest cell in metres."""
        west, south, east, north = self.box
        return (east - west) / self.cells, (north - south) / self.cells

    def span(self, depth: int | Ints) -> int | Ints:
        """Finest cells along the side of a cell at this depth."""
        return 2 ** (self.depth - depth)

    def finest_of(self, x: Floats, y: Floats) -> tuple[Ints, Ints]:
        """(row, column) of the finest cell of each point; the outer edges count as inside."""
        west, south, _, _ = self.box
        width, height = self.step
        column = np.floor((x - west) / width).astype(np.int64)
        row = np.floor((y - south) / height).astype(np.int64)
        last = self.cells - 1
        return np.clip(row, 0, last), np.clip(column, 0, last)

    def cell_of(self, x: float, y: float) -> int:
        """Row * cells + column of the finest cell of one point, as `finest_of` has them."""
        west, south, _, _ = self.box
        width, height = self.step
        last = self.cells - 1
        row = min(max(math.floor((y - south) / height), 0), last)
        return row * self.cells + min(max(math.floor((x - west) / width), 0), last)

    def count(self, x: Floats, y: Floats) -> Ints:
        """(cells, cells) points in each finest cell."""
        found = np.zeros((self.cells, self.cells), np.int64)
        np.add.at(found, self.finest_of(x, y), 1)
        return found

    def rectangles(self, cells: Cells) -> tuple[Floats, Floats, Floats, Floats]:
        """(min x, min y, max x, max y) of each cell in metres."""
        west, south, _, _ = self.box
        width, height = self.step
        span = np.asarray(self.span(cells.depth))
        return (
            west + cells.column * span * width,
            south + cells.row * span * height,
            west + (cells.column + 1) * span * width,
            south + (cells.row + 1) * span * height,
        )

    def level(self, depth: int) -> Cells:
        """All cells of one level, row by row from the south-west."""
        side = self.cells // int(self.span(depth))
        row, column = np.divmod(np.arange(side * side), side)
        return Cells(np.full(side * side, depth), row, column)

    def coarsen(self, finest: NDArray[np.generic], depth: int) -> NDArray[np.generic]:
        """Sums of a (cells, cells, ...) array over the cells of a level."""
        span = int(self.span(depth))
        side = self.cells // span
        blocks = finest.reshape(side, span, side, span, *finest.shape[2:])
        return np.asarray(blocks.sum(axis=(1, 3)))


def quadtree(
    grid: Grid,
    evidence: Callable[[Cells], Floats],
    settled: Callable[[Cells, Floats], NDArray[np.bool_]],
    roots: Cells | None = None,
) -> tuple[Cells, Floats]:
    """Split cells into quadrants until each is settled (design 6, paper section on grid maps).

    Args:
        grid: the nested cells.
        evidence: (m, K) evidence of m cells of one level.
        settled: which of the cells, given their evidence, are not split any further; called for
            all levels but the finest.
        roots: coarsest cells to begin with; all by default.

    Returns:
        The segments, level by level, and their (s, K) evidence.
    """
    kept: list[tuple[Cells, Floats]] = []
    open_cells = grid.level(0) if roots is None else roots
    for depth in range(grid.depth + 1):
        found = evidence(open_cells)
        done = np.ones(len(open_cells), bool) if depth == grid.depth else settled(open_cells, found)
        kept.append((open_cells.take(done), found[done]))
        open_cells = _quadrants(open_cells.take(~done))
        if not len(open_cells):
            break
    columns = (np.concatenate([getattr(c, n) for c, _ in kept]) for n in ("depth", "row", "column"))
    return Cells(*columns), np.concatenate([found for _, found in kept])


def _quadrants(cells: Cells) -> Cells:
    """The four quarters of each cell."""
    down, right = np.array([0, 0, 1, 1]), np.array([0, 1, 0, 1])
    return Cells(
        np.repeat(cells.depth + 1, 4),
        (2 * cells.row[:, None] + down).ravel(),
        (2 * cells.column[:, None] + right).ravel(),
    )
