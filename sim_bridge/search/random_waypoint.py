"""Random waypoint: from one random place of the area to the next."""

from __future__ import annotations

from typing import ClassVar

from symboslam.sim_bridge.search._base import Goals, Search
from symboslam.sim_bridge.search.area import Area
from symboslam.sim_bridge.search.swarm import Goal, Swarm


class RandomWaypoint(Search):
    """Each robot drives to a place drawn evenly from the extent, then to another."""

    name: ClassVar[str] = "random-waypoint"
    random: ClassVar[bool] = True

    def __init__(self, area: Area, seed: int = 0) -> None:
        super().__init__(area, seed)
        self._goal: Goals = [None] * area.robots
        self._near = min(max(area.speed, area.reach / 4), min(area.width, area.height) / 4)

    def _goals(self, swarm: Swarm) -> Goals:
        min_x, min_y, max_x, max_y = self.area.extent
        for robot, alive in enumerate(swarm.alive.tolist()):
            goal = self._goal[robot]
            x, y = swarm.poses[robot, :2].tolist()
            if not alive:
                self._goal[robot] = None
            elif goal is None or swarm.gave_up[robot] or goal.distance_from(x, y) < self._near:
                u, v = self.rng.random(2).tolist()
                self._goal[robot] = Goal(min_x + u * (max_x - min_x), min_y + v * (max_y - min_y))
        return list(self._goal)
