"""Coverage: which ground the robots' cameras have passed over, truly and by the paper's formula."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from symboslam.sim_bridge.worlds.world import Extent

Pose = tuple[float, float, float]


class Swept:
    """Ground within a camera's sector, cell by cell; what stands in the way is not looked at.

    Args:
        extent: of the world.
        reach: of the sensor, metres.
        fov: radians.
        robots: how many.
        speed: metres a second, of the paper's formula.
        cell: metres along a side, at least; a larger world has larger cells.
    """

    MOST = 400

    def __init__(
        self, extent: Extent, reach: float, fov: float, robots: int, speed: float, cell: float = 5.0
    ) -> None:
        self._cell = max(cell, extent.width / self.MOST, extent.height / self.MOST)
        shape = math.ceil(extent.height / self._cell), math.ceil(extent.width / self._cell)
        self.seen: NDArray[np.bool_] = np.zeros(shape, bool)
        self._extent, self._reach, self._fov = extent, reach, fov
        self._rate = robots * speed * 2 * reach * math.sin(min(fov, math.pi) / 2)
        n = math.ceil(reach / self._cell) + 1
        self._offset = np.arange(-n, n + 1)

    def see(self, poses: Iterable[Pose]) -> None:
        """Mark what is within the sectors of some poses."""
        e, cell = self._extent, self._cell
        rows, columns = self.seen.shape
        for x, y, heading in poses:
            column, row = math.floor((x - e.min_x) / cell), math.floor((y - e.min_y) / cell)
            across, up = column + self._offset, row + self._offset
            across = across[(across >= 0) & (across < columns)]
            up = up[(up >= 0) & (up < rows)]
            if not len(across) or not len(up):
                continue
            dx = e.min_x + (across + 0.5) * cell - x
            dy = (e.min_y + (up + 0.5) * cell - y)[:, None]
            along = dx * math.cos(heading) + dy * math.sin(heading)
            distance = np.hypot(dx, dy)
            inside = (distance <= self._reach) & (along >= distance * math.cos(self._fov / 2))
            self.seen[up[0] : up[-1] + 1, across[0] : across[-1] + 1] |= inside

    @property
    def share(self) -> float:
        """Share of the world's ground that was truly swept."""
        return float(self.seen.mean())

    def formula(self, seconds: float) -> float:
        """The paper's A'/A after some seconds: A' = V W t for each robot, at most 1.

        V is the speed and W the width that the sensor sweeps.
        """
        area = self._extent.width * self._extent.height
        return min(self._rate * seconds / area, 1.0)


def dispersion(poses: Iterable[Pose]) -> float:
    """Mean distance between two robots in metres; 0 for a single one."""
    xy = np.array([p[:2] for p in poses], float).reshape(-1, 2)
    if len(xy) < 2:
        return 0.0
    first, second = np.triu_indices(len(xy), 1)
    return float(np.hypot(*(xy[first] - xy[second]).T).mean())
