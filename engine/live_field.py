"""LiveField: what landmarks deny each other, kept up to date, and how far a change reaches."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.field import CLOSE, dissimilarity
from symboslam.engine.grid import Grid
from symboslam.engine.neighbourhood import Mask, grown, reached, reaching
from symboslam.engine.table import Landmark, LandmarkTable

Floats = NDArray[np.float64]
Rows = NDArray[np.int64]


class LiveField:
    """What `field.dissimilarity` gives for each landmark of a table.

    Args:
        grid: the nested cells.
        table: the landmarks; its groups are those of ``widths``.
        proximity: (features, K) semantic proximity times importance.
        width: (features,) standard deviation of each feature's kernel in metres.
        bandwidth: in metres.
        contradicts: whether landmarks deny each other anything.
    """

    def __init__(
        self, grid: Grid, table: LandmarkTable, proximity: Floats, width: Floats,
        bandwidth: float, contradicts: bool,
    ) -> None:  # fmt: skip
        self._grid, self._table, self._proximity, self._width = grid, table, proximity, width
        self._widths = np.unique(width)
        self._radius, self._contradicts = CLOSE * bandwidth, contradicts
        self._denied = np.zeros((0, proximity.shape[1]))

    def rows(self, cells: Mask) -> Rows:
        """Rows of the landmarks that have a say in some cells."""
        return reaching(self._table, self._grid, cells, self._widths)

    def with_neighbours(self, rows: Rows) -> Rows:
        """The rows, and those of the landmarks that may contradict them."""
        if not self._contradicts or not len(rows):
            return rows
        return np.union1d(rows, self._within(self._table.xy(rows)))

    def denied(self, rows: Rows) -> Floats:
        """(m, K) for some rows."""
        if not self._contradicts:
            return np.zeros((len(rows), self._denied.shape[1]))
        return np.asarray(self._denied[rows])

    def follow(self, moved: Sequence[Landmark]) -> Mask:
        """Take over that landmarks came, changed or went.

        Args:
            moved: as they were and as they are; the table has the latter already.

        Returns:
            The cells whose evidence changes by it.
        """
        x, y = np.array([(each.x, each.y) for each in moved]).T
        feature = np.array([each.feature for each in moved])
        near = self._near(x, y)
        self._contradict(near)
        around = self._table.xy(near)
        return reached(
            self._grid,
            np.concatenate([x, around[:, 0]]),
            np.concatenate([y, around[:, 1]]),
            self._width[np.concatenate([feature, self._table.feature(near)])],
        )

    def _near(self, x: Floats, y: Floats) -> Rows:
        """Rows of the landmarks that those at some places can contradict, and they themselves."""
        if not self._contradicts:
            return np.zeros(0, np.int64)
        return self._within(np.column_stack([x, y]))

    def _contradict(self, rows: Rows) -> None:
        """Work out anew what the landmarks around some rows deny them."""
        if not len(rows):
            return
        around = self._within(self._table.xy(rows))
        weight = self._proximity[self._table.feature(around)]
        weight = weight * self._table.confidence(around)[:, None]
        found = dissimilarity(self._table.xy(around), weight, self._radius)
        missing = int(rows[-1]) + 1 - len(self._denied)
        if missing > 0:
            self._denied = np.pad(self._denied, ((0, max(missing, len(self._denied))), (0, 0)))
        self._denied[rows] = found[np.searchsorted(around, rows)]

    def _within(self, places: Floats) -> Rows:
        """Rows of the landmarks within the radius of any of (m, 2) places."""
        from scipy.spatial import cKDTree

        cells = np.zeros((self._grid.cells, self._grid.cells), bool)
        cells[self._grid.finest_of(*places.T)] = True
        wide = grown(self._grid, cells, self._radius)
        rows = self._table.within(np.flatnonzero(wide).tolist())
        # An infinite distance is that to none; the radius itself belongs to the disc.
        nearest, _ = cKDTree(places).query(
            self._table.xy(rows), distance_upper_bound=np.nextafter(self._radius, np.inf)
        )
        return np.asarray(rows[np.isfinite(nearest)])
