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

    Points at exactly the same place are one spot. A KD-tree holds the spots that were left when it
    was made. It is asked for the neighbours of one place, and as long as the nearest to another
    place provably is among them, it is not asked again: whatever is not in the list lies at least
    ``radius`` from the first place, and so at least ``radius`` less the shift from the second.

    Args:
        xy: (n, 2) positions in metres.
    """

    def __init__(self, xy: Floats) -> None:
        self._xy, spot = np.unique(xy, axis=0, return_inverse=True)
        spot = spot.reshape(-1)
        self._spot: list[int] = spot.tolist()
        by_spot = np.argsort(spot, kind="stable")
        ends = np.cumsum(np.bincount(spot, minlength=len(self._xy)))
        self._points: list[list[int]] = [
            points.tolist()[::-1] for points in np.split(by_spot, ends[:-1])
        ]
        """The points of each spot, the first last."""
        self._first = [points[-1] for points in self._points]
        """The first point that is left at each spot; -1 if none is."""
        self._left = [True] * len(xy)
        self._number, self._spots = len(xy), len(self._xy)
        self._list: list[tuple[int, float, float]] = []
        self._plant()

    def __len__(self) -> int:
        return self._number

    def take(self, position: int) -> None:
        """Take a point away."""
        self._left[position] = False
        self._number -= 1
        spot = self._spot[position]
        points = self._points[spot]
        while points and not self._left[points[-1]]:
            points.pop()
        if points:
            self._first[spot] = points[-1]
            return
        self._first[spot] = -1
        self._spots -= 1
        if 2 * self._spots < len(self._planted):
            self._plant()

    def find(self, x: float, y: float, count: int = 1) -> list[int]:
        """The ``count`` points that are nearest to a place, or all if fewer are left."""
        count = min(count, self._number)
        if not count:
            return []
        wanted = FIRST
        while not (found := self._listed(x, y, count)):
            self._ask(x, y, wanted)
            wanted *= 2  # more than one time only where so many lie at the same distance
        return found

    def _listed(self, x: float, y: float, count: int) -> list[int]:
        """The nearest by the list; nothing if the list does not prove them."""
        sure = self._radius - math.hypot(x - self._centre[0], y - self._centre[1])
        if sure <= 0:
            return []
        first = self._first
        near = [
            ((px - x) * (px - x) + (py - y) * (py - y), first[s])
            for s, px, py in self._list
            if first[s] >= 0
        ]
        if not near:
            return []
        best = [min(near)] if count == 1 else self._several(sorted(near)[:count], count)
        whole = self._radius == math.inf
        proven = len(best) == count and (whole or math.sqrt(best[-1][0]) < sure)
        return [i for _, i in best] if proven else []

    def _several(self, nearest: list[tuple[float, int]], count: int) -> list[tuple[float, int]]:
        """The nearest points, of the nearest spots' distances and first points."""
        points = []
        for distance, first in nearest:
            number = 0
            for i in reversed(self._points[self._spot[first]]):
                if self._left[i] and number < count:
                    points.append((distance, i))
                    number += 1
                elif number == count:
                    break
        return sorted(points)[:count]

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
            left = np.array([self._first[s] >= 0 for s in listed.tolist()])
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
        self._list = [(s, px, py) for s, (px, py) in zip(listed.tolist(), places, strict=True)]

    def _plant(self) -> None:
        from scipy.spatial import cKDTree

        self._wasted = 0
        self._planted = np.flatnonzero(np.array(self._first, np.int64) >= 0)
        self._tree = cKDTree(self._xy[self._planted])
        self._list = []
        self._radius, self._centre = 0.0, (0.0, 0.0)
