"""Nearest: the landmarks nearest to a place among those that are left, one after the other."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
FIRST = 24
"""Neighbours that are asked for at once."""


class Nearest:
    """Points that are taken away one by one, found by how near they are; ties by position.

    A KD-tree holds the points that were left when it was made. It is asked for the neighbours of
    one place, and as long as the nearest to another place provably is among them, it is not asked
    again: whatever is not in the list lies at least ``radius`` from the first place, and so at
    least ``radius`` less the shift from the second.

    Args:
        xy: (n, 2) positions in metres.
    """

    def __init__(self, xy: Floats) -> None:
        self._xy = xy
        self._left = [True] * len(xy)
        self._number = len(xy)
        self._list: list[tuple[int, float, float]] = []
        self._plant()

    def __len__(self) -> int:
        return self._number

    def take(self, position: int) -> None:
        """Take a point away."""
        self._left[position] = False
        self._number -= 1
        if 2 * self._number < len(self._planted):
            self._plant()

    def find(self, x: float, y: float, count: int = 1) -> list[int]:
        """The ``count`` points that are nearest to a place, or all if fewer are left."""
        count = min(count, self._number)
        if not count:
            return []
        wanted = FIRST
        while True:
            found = self._listed(x, y, count)
            if found:
                return found
            wanted = max(wanted, 2 * count)
            self._ask(x, y, wanted)
            wanted *= 4

    def _listed(self, x: float, y: float, count: int) -> list[int]:
        """The nearest by the list; nothing if the list does not prove them."""
        sure = self._radius - math.hypot(x - self._centre[0], y - self._centre[1])
        if sure <= 0:
            return []
        left = self._left
        near = [
            ((px - x) * (px - x) + (py - y) * (py - y), i) for i, px, py in self._list if left[i]
        ]
        if len(near) < count:
            return []
        best = [min(near)] if count == 1 else sorted(near)[:count]
        return [i for _, i in best] if math.sqrt(best[-1][0]) < sure else []

    def _ask(self, x: float, y: float, wanted: int) -> None:
        """Ask the tree for the neighbours of a place."""
        wanted = min(wanted, len(self._planted))
        distance, near = self._tree.query((x, y), wanted)
        everything = wanted == len(self._planted)
        # Rounding must not make a point outside the list seem farther away than it is.
        self._radius = math.inf if everything else float(np.max(distance)) * (1 - 1e-12)
        self._centre = x, y
        listed = self._planted[np.atleast_1d(near)]
        self._list = [(i, px, py) for i, (px, py) in zip(
            listed.tolist(), self._xy[listed].tolist(), strict=True) if self._left[i]]  # fmt: skip

    def _plant(self) -> None:
        from scipy.spatial import cKDTree

        self._planted = np.flatnonzero(np.array(self._left))
        self._tree = cKDTree(self._xy[self._planted])
        self._list = []
        self._radius, self._centre = 0.0, (0.0, 0.0)
