"""Density: evidence per hectare over the finest cells, and where larger cells will do."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.engine._base import normalised
from symboslam.engine.grid import Cells, Grid

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Density:
    """A field of evidence.

    Attributes:
        grid: the nested cells.
        threshold: a cell whose largest P reaches this is settled.
        finest: (cells, cells, K) mean evidence over each finest cell, per hectare.
        inside: (cells, cells) landmarks in each finest cell.
    """

    grid: Grid
    threshold: float
    finest: Floats
    inside: NDArray[np.int64]

    def of(self, cells: Cells) -> Floats:
        """(m, K) mean of the field over each of m cells of one level, per hectare."""
        if not len(cells):
            return np.zeros((0, self.finest.shape[2]))
        depth = int(cells.depth[0])
        span = int(self.grid.span(depth))
        sums = self.grid.coarsen(self.finest, depth)[cells.row, cells.column]
        return np.asarray(sums, np.float64) / span**2

    def settled(self, cells: Cells, evidence: Floats) -> NDArray[np.bool_]:
        """Where all finest cells inside agree, or the largest P reaches the threshold."""
        depth = int(cells.depth[0])
        best = self.finest.argmax(2)
        votes = np.stack([best == k for k in range(self.finest.shape[2])], 2)
        agree = self.grid.coarsen(votes, depth).max(2) == int(self.grid.span(depth)) ** 2
        bare = self.grid.coarsen(self.inside, depth) == 0
        certain = normalised(evidence).max(1, initial=0) >= self.threshold
        return np.asarray((agree & bare)[cells.row, cells.column] | certain)
