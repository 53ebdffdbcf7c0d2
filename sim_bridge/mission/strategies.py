"""Strategies by name, behind the interface of the control agent."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

import numpy as np

from symboslam.errors import InputError
from symboslam.sim_bridge.mission.control_agent import Pose, Search
from symboslam.sim_bridge.worlds.world import Extent

Point = tuple[float, float]


class Waypoints:
    """Each robot drives from one random place to the next.

    Args:
        extent: of the world.
        rng: draws the places.
    """

    CLOSE = 25.0
    LONGEST = 150.0

    def __init__(self, extent: Extent, rng: np.random.Generator) -> None:
        self._extent, self._rng = extent, rng
        self._goal: dict[str, tuple[Point, float]] = {}

    def goals(self, time: float, poses: Mapping[str, Pose]) -> Mapping[str, Point | None]:
        """A new place for each robot that has come to its own, or has taken too long."""
        found: dict[str, Point | None] = {}
        e = self._extent
        for name, (x, y, _) in poses.items():
            goal, since = self._goal.get(name, ((x, y), -math.inf))
            if math.dist(goal, (x, y)) < self.CLOSE or time - since > self.LONGEST:
                u, v = self._rng.uniform(0.04, 0.96, 2).tolist()
                goal = (e.min_x + u * e.width, e.min_y + v * e.height)
                self._goal[name] = goal, time
            found[name] = goal
        return found


STRATEGIES: Mapping[str, Callable[[Extent, np.random.Generator], Search]] = {"waypoints": Waypoints}
"""All strategies by name."""


def get_search(name: str, extent: Extent, seed: int) -> Search:
    """The strategy of a name.

    Raises:
        InputError: there is none of that name.
    """
    if name not in STRATEGIES:
        raise InputError(f"no search {name!r}; there are: {', '.join(STRATEGIES)}")
    return STRATEGIES[name](extent, np.random.default_rng([seed, 99]))
