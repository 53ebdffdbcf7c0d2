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
        self._left = np.ones(len(xy), bool)
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
        while not (found := self._listed(x, y, count)):
            self._ask(x, y, max(FIRST, 2 * count))
        return found

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
        """List so many neighbours of a place, or all that are left.

        A tree that answers with many that are taken away is made anew: their number is counted,
        and a new tree costs about as much as having looked at all of its points once.
        """
        if self._wasted > len(self._planted):
            self._plant()
        asked = wanted
        while True:
            asked = min(asked, len(self._planted))
            distance, near = self._tree.query((x, y), asked)
            listed = self._planted[np.atleast_1d(near)]
            left = self._left[listed]
            fresh = int(np.count_nonzero(left))
            self._wasted += asked - fresh
            everything = asked == len(self._planted)
            if fresh >= wanted or everything:
                break
            asked *= 2
        listed, distance = listed[left][:wanted], np.atleast_1d(distance)[left][:wanted]
        # Rounding must not make a point outside the list seem farther away than it is.
        whole = everything and fresh <= wanted
        self._radius = math.inf if whole else float(distance[-1]) * (1 - 1e-12)
        self._centre = x, y
        places = self._xy[listed].tolist()
        self._list = [(i, px, py) for i, (px, py) in zip(listed.tolist(), places, strict=True)]

    def _plant(self) -> None:
        from scipy.spatial import cKDTree

        self._wasted = 0
        self._planted = np.flatnonzero(self._left)
        self._tree = cKDTree(self._xy[self._planted])
        self._list = []
        self._radius, self._centre = 0.0, (0.0, 0.0)
