"""Leash: a robot that knows less and less where it is goes back to what it knows, to close a loop.

Active loop closing (after Stachniss, Haehnel and Burgard 2004): what odometry loses on new ground
is won back by seeing again what was mapped when the robot still knew better.
"""

from __future__ import annotations

import math

Point = tuple[float, float]

LONG = 20.0
"""Metres by which the deviation of the position may exceed that of a place to go back to."""
SHORT = 4.0
"""A robot that is back within so many metres of it goes on."""
DEAR = 30.0
"""Metres of way that are worth one metre of deviation."""
APART = 20.0
"""Metres between two places that are kept."""
THERE = 25.0
"""Metres from a place that are there."""


SHARE = 0.2
"""Of its time a robot spends so much on ways back, beyond `CREDIT`: a search has to end."""
CREDIT = 120.0
"""Seconds."""


class Leash:
    """Where one robot has been, how well it knew that, and whether it goes back.

    Args:
        speed: of the robot, metres a second.

    Attributes:
        goal: the place to go back to; None while the robot is free.
    """

    def __init__(self, speed: float) -> None:
        self._speed = speed
        self._time = self._spent = 0.0
        self._places: list[tuple[float, float, float]] = []
        self._tried: set[int] = set()
        self._at = -1
        self._enough = 0.0
        self.goal: Point | None = None

    def pull(self, time: float, place: Point, sigma: float) -> Point | None:
        """Where to go back to, if the robot has to.

        Args:
            time: seconds since it set out.
            place: where it believes to be, metres.
            sigma: standard deviation of that along one axis, metres.
        """
        self._remember(place, sigma)
        if self.goal is not None:
            self._spent += time - self._time
        self._time = time
        if self.goal is not None:
            if sigma < self._places[self._at][2] + SHORT:
                self.goal = None
                self._tried.clear()
                self._enough = 0.0
            elif math.dist(place, self.goal) < THERE:
                self._tried.add(self._at)
                self.goal = None
        if self.goal is None:
            self._choose(place, sigma)
        return self.goal

    def _remember(self, place: Point, sigma: float) -> None:
        if not self._places or math.dist(place, self._places[-1][:2]) >= APART:
            self._places.append((*place, sigma))

    def _choose(self, place: Point, sigma: float) -> None:
        if sigma < self._enough - 2 * LONG:
            self._enough = 0.0
        if sigma < self._enough:
            return
        best, least = -1, math.inf
        reach = self._speed * (SHARE * self._time + CREDIT - self._spent)
        for n, (x, y, then) in enumerate(self._places):
            way = math.dist(place, (x, y))
            cost = way / DEAR + then
            if n not in self._tried and way < reach and then + LONG < sigma and cost < least:
                best, least = n, cost
        if best >= 0:
            self._at = best
            x, y, _ = self._places[best]
            self.goal = (x, y)
        elif self._tried:
            # Nothing helped: free until it knows a good deal less, or a good deal more.
            self._tried.clear()
            self._enough = sigma + LONG
