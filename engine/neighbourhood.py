"""Neighbourhoods on a grid: which cells landmarks reach, and which landmarks reach cells."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.field import REACH, Bands
from symboslam.engine.grid import Cells, Grid
from symboslam.engine.table import LandmarkTable

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Mask = NDArray[np.bool_]
"""(cells, cells) which of the finest cells."""


def filled(cells: int, south: Ints, north: Ints, west: Ints, east: Ints) -> Mask:
    """The cells in any of m rectangles: rows south to north, columns west to east, ends not."""
    corners = np.zeros((cells + 1, cells + 1), np.int64)
    for row, column, sign in (
        (south, west, 1), (north, west, -1), (south, east, -1), (north, east, 1)
    ):  # fmt: skip
        np.add.at(corners, (row, column), sign)
    return np.asarray(corners.cumsum(0).cumsum(1)[:-1, :-1] > 0)


def covered(grid: Grid, cells: Cells) -> Mask:
    """The finest cells inside some cells."""
    span = np.asarray(grid.span(cells.depth))
    south, west = cells.row * span, cells.column * span
    return filled(grid.cells, south, south + span, west, west + span)


def grown(grid: Grid, mask: Mask, metres: float) -> Mask:
    """The cells that may hold a point within a distance of some cells."""
    width, height = grid.step
    rows, columns = math.ceil(metres / height), math.ceil(metres / width)
    row, column = np.nonzero(mask)
    last = grid.cells
    return filled(
        last,
        np.maximum(row - rows, 0),
        np.minimum(row + rows + 1, last),
        np.maximum(column - columns, 0),
        np.minimum(column + columns + 1, last),
    )


def reached(grid: Grid, x: Floats, y: Floats, sigma: Floats) -> Mask:
    """The cells that kernels reach.

    Args:
        grid: the cells.
        x: (n,) middles of the kernels, in metres.
        y: (n,) the same.
        sigma: (n,) their standard deviations in metres.
    """
    found = np.zeros((grid.cells, grid.cells), bool)
    for size in np.unique(sigma).tolist():
        here = sigma == size
        found |= filled(grid.cells, *_rectangles(grid, x[here], y[here], size))
    return found


def reaching(table: LandmarkTable, grid: Grid, mask: Mask, sigma: Floats) -> Ints:
    """Rows of the landmarks whose kernels reach some cells.

    Args:
        table: the landmarks.
        grid: the cells.
        mask: which of them.
        sigma: standard deviation of the kernel of each group of features, in metres.
    """
    sums = np.zeros((grid.cells + 1, grid.cells + 1), np.int64)
    sums[1:, 1:] = mask.cumsum(0).cumsum(1)
    parts = []
    for group, size in enumerate(sigma.tolist()):
        # Twice the reach: at the map's edge a kernel's rectangle is moved inwards.
        around = grown(grid, mask, 2 * REACH * size + 2 * max(grid.step))
        rows = table.within(np.flatnonzero(around).tolist(), group)
        xy = table.xy(rows)
        south, north, west, east = _rectangles(grid, xy[:, 0], xy[:, 1], size)
        inside = sums[north, east] - sums[south, east] - sums[north, west] + sums[south, west]
        parts.append(rows[inside > 0])
    return np.sort(np.concatenate(parts))


def _rectangles(grid: Grid, x: Floats, y: Floats, sigma: float) -> tuple[Ints, Ints, Ints, Ints]:
    """(n,) each: first and last row (not included), first and last column of kernels."""
    (west, columns), (south, rows) = (
        Bands.span(positions, grid.box[axis], grid.step[axis], grid.cells, sigma)
        for axis, positions in enumerate((x, y))
    )
    return south, south + rows, west, west + columns
