"""Segmentation: cells of a grid become segments with an environment type and probabilities."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine._base import normalised
from symboslam.engine.grid import Cells, Grid, quadtree

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]


@dataclass(frozen=True)
class Segments:
    """Segments of a grid, column by column.

    Attributes:
        cells: (s,) the cell that each is.
        source: (s,) the cell whose evidence each has: its own, or that of a larger one around it.
        probability: (s, K), rows sum to 1, or are all 0 where unknown.
    """

    cells: Cells
    source: Cells
    probability: Floats

    @classmethod
    def joined(cls, parts: Sequence[Segments]) -> Segments:
        """Several one after the other."""
        cells, source = (
            Cells(
                np.concatenate([c.depth for c in each]),
                np.concatenate([c.row for c in each]),
                np.concatenate([c.column for c in each]),
            )
            for each in ([p.cells for p in parts], [p.source for p in parts])
        )
        return cls(cells, source, np.concatenate([p.probability for p in parts]))

    @property
    def label(self) -> NDArray[np.int16]:
        """(s,) position of the most probable environment; -1 = unknown."""
        p = self.probability
        return np.where(p.any(1), p.argmax(1), -1).astype(np.int16)

    @property
    def names(self) -> NDArray[np.str_]:
        """(s,) depth-row-column of each cell, rows from the south."""
        c = self.cells
        return np.array(
            [f"{d}-{r}-{k}" for d, r, k in zip(c.depth, c.row, c.column, strict=True)],
            dtype=np.str_,
        )

    def take(self, index: NDArray[np.generic]) -> Segments:
        """The segments at ``index`` (integers or a mask)."""
        return Segments(self.cells.take(index), self.source.take(index), self.probability[index])


def cut(
    grid: Grid,
    evidence: Callable[[Cells], Floats],
    settled: Callable[[Cells, Floats], NDArray[np.bool_]],
    seen: Ints,
    *,
    inherit: bool,
    roots: Cells | None = None,
) -> Segments:
    """Cut a map into segments (design 6).

    Args:
        grid: the nested cells.
        evidence: (m, K) evidence of m cells of one level.
        settled: which of the cells, given their evidence, need no splitting.
        seen: (cells, cells) 1 where a finest cell was looked at.
        inherit: cells without evidence take that of the nearest larger cell that has some.
        roots: coarsest cells to cut; all by default.
    """

    def whole(cells: Cells, values: Floats) -> NDArray[np.bool_]:
        """Settled by the evidence, and not partly outside what was looked at."""
        part = sums(grid, seen, cells)
        same = (part == 0) | (part == np.asarray(grid.span(cells.depth)) ** 2)
        return np.asarray(settled(cells, values) & same)

    cells, values = quadtree(grid, evidence, whole, roots)
    source = cells
    if inherit:
        source, values = _inherit(grid, evidence, cells, values)
    values[sums(grid, seen, cells) == 0] = 0
    return Segments(cells, source, normalised(values))


def _inherit(
    grid: Grid, evidence: Callable[[Cells], Floats], cells: Cells, values: Floats
) -> tuple[Cells, Floats]:
    """Cells without evidence take that of the nearest larger cell that has some."""
    source = Cells(cells.depth.copy(), cells.row.copy(), cells.column.copy())
    values = values.copy()
    for _ in range(grid.depth):
        bare = np.flatnonzero(~values.any(1) & (source.depth > 0))
        if not len(bare):
            break
        parents = source.take(bare).parent()
        source.depth[bare], source.row[bare], source.column[bare] = (
            parents.depth,
            parents.row,
            parents.column,
        )
        for depth in np.unique(parents.depth):
            here = parents.depth == depth
            values[bare[here]] = evidence(parents.take(here))
    return source, values


def sums(grid: Grid, finest: Ints, cells: Cells) -> Ints:
    """(s,) sum of a (cells, cells) array over each segment."""
    found = np.zeros(len(cells), np.int64)
    for depth in np.unique(cells.depth):
        here = cells.depth == depth
        found[here] = grid.coarsen(finest, int(depth))[cells.row[here], cells.column[here]]
    return found


def seen_cells(grid: Grid, surveyed: BaseGeometry | None) -> Ints:
    """(cells, cells) 1 where the middle of the finest cell was looked at (design 5)."""
    if surveyed is None:
        return np.ones((grid.cells, grid.cells), np.int64)
    west, south, east, north = grid.rectangles(grid.level(grid.depth))
    shapely.prepare(surveyed)
    middle = shapely.contains_xy(surveyed, (west + east) / 2, (south + north) / 2)
    return np.asarray(middle, np.int64).reshape(grid.cells, grid.cells)
