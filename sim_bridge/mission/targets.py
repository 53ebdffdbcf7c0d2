"""Targets: what an edge agent has seen, and what of it is not mapped yet (the paper's own map).

Positions are those of the robot's estimate when it saw the thing. They steer the robot; the map
that counts is made of the log.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

Point = tuple[float, float]

SAME = 4.0
"""Metres, and a tenth of the range, within which a sighting is of a thing seen before."""
ENOUGH = 2
"""A thing that was ranged so often is mapped."""
PATIENCE = 7.0
"""Seconds of approach after which a target is given up."""
CLAIM = 12.0
"""Metres around another robot's target within which nothing is approached."""


@dataclass
class Target:
    """A thing that was seen.

    Attributes:
        kind: class, as it was reported first.
        x: metres, in the robot's estimate.
        y: metres.
        ranged: how often its range was measured.
        seen: in how many pictures it was.
        spent: seconds of approach.
    """

    kind: str
    x: float
    y: float
    ranged: int = 0
    seen: int = 1
    spent: float = 0.0

    @property
    def mapped(self) -> bool:
        """Whether it was ranged often enough."""
        return self.ranged >= ENOUGH

    @property
    def given_up(self) -> bool:
        """Whether it was approached for too long."""
        return self.spent >= PATIENCE


class Targets:
    """All that one robot has seen of what stands still."""

    def __init__(self) -> None:
        self.all: list[Target] = []
        self._xy = np.zeros((64, 2))

    def see(self, kind: str, x: float, y: float, distance: float, ranged: bool) -> Target:
        """Take over a sighting; returns what it is of."""
        gate = SAME + 0.1 * distance
        n = len(self.all)
        gaps = np.hypot(self._xy[:n, 0] - x, self._xy[:n, 1] - y)
        near = np.flatnonzero(gaps < gate)
        if len(near):
            # One of the same class before others: a wrong class now and then is no new thing.
            rank = [(self.all[row].kind != kind, gaps[row], row) for row in near.tolist()]
            row = min(rank)[2]
            found = self.all[row]
            found.seen += 1
            if ranged:
                found.x, found.y = x, y
                self._xy[row] = x, y
                found.ranged += 1
            return found
        if n == len(self._xy):
            self._xy = np.vstack([self._xy, np.zeros_like(self._xy)])
        self._xy[n] = x, y
        self.all.append(Target(kind, x, y, int(ranged)))
        return self.all[-1]

    def nearest(self, place: Point, reach: float, claimed: Sequence[Point]) -> Target | None:
        """The nearest one within reach that is not mapped, not given up and not claimed.

        What only one picture showed is not approached: it may be of nothing.
        """
        best, least = None, reach
        n = len(self.all)
        if not n:
            return None
        gaps = np.hypot(self._xy[:n, 0] - place[0], self._xy[:n, 1] - place[1])
        for row in np.flatnonzero(gaps < reach).tolist():
            one = self.all[row]
            if gaps[row] >= least or one.seen < 2 or one.mapped or one.given_up:
                continue
            if any(math.dist((one.x, one.y), other) < CLAIM for other in claimed):
                continue
            best, least = one, float(gaps[row])
        return best
