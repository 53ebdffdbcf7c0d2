"""Swarm and goals: what a strategy is told at each tick, and what it answers."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from symboslam.errors import InputError
from symboslam.sim_bridge.search.area import Bools, Floats
from symboslam.sim_bridge.search.coverage import Coverage


@dataclass(frozen=True)
class Goal:
    """Where a robot is to go: a place, or a heading to keep.

    Attributes:
        x: metres, of a place.
        y: metres, of a place.
        heading: radians, of a heading; then there is no place.
    """

    x: float = math.nan
    y: float = math.nan
    heading: float | None = None

    @classmethod
    def along(cls, heading: float) -> Goal:
        """A heading to keep, radians."""
        return cls(heading=math.remainder(heading, 2 * math.pi))

    def bearing_from(self, x: float, y: float) -> float:
        """Radians from east of the way to it from a place."""
        return self.heading if self.heading is not None else math.atan2(self.y - y, self.x - x)

    def distance_from(self, x: float, y: float) -> float:
        """Metres to it from a place; of a heading infinite."""
        return math.inf if self.heading is not None else math.hypot(self.x - x, self.y - y)


def _nowhere() -> Floats:
    return np.empty((0, 2))


@dataclass(frozen=True)
class Swarm:
    """The team at one tick, as its control agent knows it.

    Attributes:
        time: seconds since the start.
        poses: (n, 3) x, y in metres and heading in radians.
        alive: (n,) whether each robot still works; poses of others may be anything.
        coverage: what the team has seen together.
        bumped: (n,) whether each ran into something since the last tick.
        gave_up: (n,) whether each could not reach its last goal.
        features: (k, 2) features that are known so far.
        obstacles: (m, 2) points where obstacles were found so far.

    Raises:
        InputError: shapes that do not fit, or a pose of a working robot that is not finite.
    """

    time: float
    poses: Floats
    alive: Bools
    coverage: Coverage
    bumped: Bools
    gave_up: Bools
    features: Floats = field(default_factory=_nowhere)
    obstacles: Floats = field(default_factory=_nowhere)

    def __post_init__(self) -> None:
        n = len(self.poses)
        if self.poses.shape != (n, 3):
            raise InputError(f"poses of shape {self.poses.shape}: give (robots, 3)")
        for name in ("alive", "bumped", "gave_up"):
            if getattr(self, name).shape != (n,):
                raise InputError(f"{name} of shape {getattr(self, name).shape}: give ({n},)")
        if not math.isfinite(self.poses.sum()):
            bad = np.flatnonzero(~np.isfinite(self.poses).all(1) & self.alive)
            if len(bad):
                raise InputError(f"pose of robot {bad[0]} is {self.poses[bad[0]]}: not finite")

    @property
    def working(self) -> list[int]:
        """Numbers of the robots that work."""
        found: list[int] = np.flatnonzero(self.alive).tolist()
        return found
