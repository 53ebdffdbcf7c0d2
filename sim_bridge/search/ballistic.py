"""Ballistic search: straight on until something is in the way, then off in a random direction."""

from __future__ import annotations

import math
from typing import ClassVar

from symboslam.sim_bridge.search._base import Goals, Search
from symboslam.sim_bridge.search.area import Area
from symboslam.sim_bridge.search.swarm import Goal, Swarm


class Ballistic(Search):
    """Straight on; at an edge, an obstacle or a robot a new heading that leads away from it."""

    name: ClassVar[str] = "ballistic"
    random: ClassVar[bool] = True

    def __init__(self, area: Area, seed: int = 0) -> None:
        super().__init__(area, seed)
        self._heading = [heading for _, _, heading in area.starts]
        side = min(area.width, area.height)
        self._margin = min(area.reach / 3, side / 6)

    def _goals(self, swarm: Swarm) -> Goals:
        goals: Goals = []
        for robot, alive in enumerate(swarm.alive.tolist()):
            if not alive:
                goals.append(None)
                continue
            self._turn(swarm, robot)
            goals.append(Goal.along(self._heading[robot]))
        return goals

    def _turn(self, swarm: Swarm, robot: int) -> None:
        x, y = swarm.poses[robot, :2].tolist()
        if swarm.bumped[robot] or swarm.gave_up[robot]:
            self._heading[robot] += math.pi + self.rng.uniform(-1.2, 1.2)
        away = self._away(swarm, robot, x, y)
        heading = self._heading[robot]
        if away is not None and math.cos(heading - away) < 0:
            self._heading[robot] = away + self.rng.uniform(-1.4, 1.4)

    def _away(self, swarm: Swarm, robot: int, x: float, y: float) -> float | None:
        """The direction that leads away from what is near; None where nothing is."""
        min_x, min_y, max_x, max_y = self.area.extent
        margin = self._margin
        dx = (x < min_x + margin) - (x > max_x - margin)
        dy = (y < min_y + margin) - (y > max_y - margin)
        if dx or dy:
            return math.atan2(dy, dx)
        for other in swarm.working:
            ox, oy = swarm.poses[other, :2].tolist()
            if other != robot and math.hypot(x - ox, y - oy) < margin:
                return math.atan2(y - oy, x - ox)
        return None
