"""Coverage: which cells of an area a team has seen, by the true area that its sensors sweep.

What stands in the way of a look is not counted: a sensor sees over obstacles here.
"""

from __future__ import annotations

import math
from functools import cached_property

import numpy as np

from symboslam.errors import GeometryError, InputError
from symboslam.sim_bridge.search.area import Area, Bools, Extent, Floats, Ints

CELLS_A_REACH = 6
"""So many cells to the reach of the sensor, unless a grid is told its cell."""


def swept(
    xy: Floats, before: Floats, after: Floats, reach: float, fov: float = 2 * math.pi
) -> Bools:
    """Which points a robot saw on the straight way from one pose to the next.

    Exact for a full circle. Sectors are looked at every twentieth of the reach and 0.1 radians.

    Args:
        xy: (k, 2) metres.
        before: (3,) pose x, y, heading.
        after: (3,) pose.
        reach: of the sensor, metres.
        fov: its field of view, radians.

    Returns:
        (k,) whether each was seen.
    """
    x, y = xy[:, 0] - before[0], xy[:, 1] - before[1]
    dx, dy = float(after[0] - before[0]), float(after[1] - before[1])
    length = math.hypot(dx, dy)
    if fov >= 2 * math.pi - 1e-9:
        if length > 0:
            share = np.clip((x * dx + y * dy) / length**2, 0.0, 1.0)
            x, y = x - share * dx, y - share * dy
        near: Bools = x * x + y * y <= reach * reach
        return near
    turn = math.remainder(float(after[2] - before[2]), 2 * math.pi)
    count = 1 + math.ceil(max(length / (reach / 20), abs(turn) / 0.1))
    share = np.linspace(0.0, 1.0, count)[:, None]
    x, y = x - share * dx, y - share * dy
    heading = float(before[2]) + share * turn
    forward = x * np.cos(heading) + y * np.sin(heading)
    away = np.hypot(x, y)
    seen: Bools = ((away <= reach) & (forward >= away * math.cos(fov / 2))).any(0)
    return seen


class Coverage:
    """A grid of what has been seen.

    Args:
        extent: min x, min y, max x, max y in metres.
        cell: side of a cell at most, metres; whole numbers of cells fill the extent.

    Attributes:
        seen: (rows, columns) whether the middle of each cell was seen; row 0 is the southernmost.
        free: (rows, columns) cells that count; all unless ``count_only`` was called.

    Raises:
        GeometryError: the extent has no area.
        InputError: the cell is not a positive number, or makes more than 20 million cells.
    """

    def __init__(self, extent: Extent, cell: float) -> None:
        width, height = extent[2] - extent[0], extent[3] - extent[1]
        if not (width > 0 and height > 0 and math.isfinite(width * height)):
            raise GeometryError(f"extent {extent} has no area")
        if not (math.isfinite(cell) and cell > 0):
            raise InputError(f"cell {cell}: give metres above 0")
        columns, rows = math.ceil(width / cell - 1e-9), math.ceil(height / cell - 1e-9)
        if columns * rows > 20_000_000:
            raise InputError(f"cell {cell}: {columns} x {rows} cells are too many")
        self.extent = extent
        self.step_x, self.step_y = width / columns, height / rows
        self.x: Floats = np.asarray(extent[0] + self.step_x * (np.arange(columns) + 0.5), float)
        self.y: Floats = np.asarray(extent[1] + self.step_y * (np.arange(rows) + 0.5), float)
        self.seen: Bools = np.zeros((rows, columns), bool)
        self.free: Bools = np.ones((rows, columns), bool)
        self._count, self._of = 0, rows * columns

    @classmethod
    def of(cls, area: Area, cell: float | None = None) -> Coverage:
        """An empty grid for an area; cells in its obstacles do not count."""
        grid = cls(area.extent, cell or area.reach / CELLS_A_REACH)
        if area.obstacles:
            grid.count_only(~area.blocked(grid.centres).reshape(grid.seen.shape))
        return grid

    @cached_property
    def centres(self) -> Floats:
        """(rows * columns, 2) middles of the cells, row by row."""
        x, y = np.meshgrid(self.x, self.y)
        return np.column_stack([x.ravel(), y.ravel()])

    def count_only(self, free: Bools) -> None:
        """Leave cells out of the share, such as those in obstacles."""
        self.free = free
        self._of = int(free.sum())
        self._count = int((self.seen & free).sum())

    @property
    def share(self) -> float:
        """Of the cells that count, what was seen, from 0 to 1."""
        return self._count / self._of if self._of else 1.0

    @property
    def missing(self) -> Bools:
        """(rows, columns) cells that count and were not seen."""
        found: Bools = self.free & ~self.seen
        return found

    def cells_of(self, xy: Floats) -> tuple[Ints, Ints]:
        """Row and column, (k,) each, of (k, 2) points; of those outside the nearest ones."""
        column = ((xy[:, 0] - self.extent[0]) // self.step_x).astype(np.int64)
        row = ((xy[:, 1] - self.extent[1]) // self.step_y).astype(np.int64)
        rows, columns = self.seen.shape
        return np.clip(row, 0, rows - 1), np.clip(column, 0, columns - 1)

    def sweep(self, before: Floats, after: Floats, reach: float, fov: float = 2 * math.pi) -> int:
        """Mark what one robot sees between two poses, (3,) each; tells how many cells are new."""
        low_x = min(before[0], after[0]) - reach - self.extent[0]
        low_y = min(before[1], after[1]) - reach - self.extent[1]
        high_x = max(before[0], after[0]) + reach - self.extent[0]
        high_y = max(before[1], after[1]) + reach - self.extent[1]
        columns = slice(max(0, int(low_x // self.step_x)), max(0, int(high_x // self.step_x) + 1))
        rows = slice(max(0, int(low_y // self.step_y)), max(0, int(high_y // self.step_y) + 1))
        here = self.seen[rows, columns]
        row, column = np.nonzero(~here)
        if not len(row):
            return 0
        xy = np.column_stack([self.x[columns][column], self.y[rows][row]])
        new = swept(xy, before, after, reach, fov)
        row, column = row[new], column[new]
        here[row, column] = True
        gain = int(self.free[rows, columns][row, column].sum())
        self._count += gain
        return gain
