"""Frontier search: to the nearest border of what was seen, in the robot's own Voronoi cell.

After Yamauchi (1997), with the ground parted among robots by who is nearest, and with a push away
from where others are going ("Frontier-led swarming", arXiv 2111.14295, joins the same two).
"""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np
from scipy.ndimage import binary_dilation
from shapely import LinearRing, box, line_interpolate_point

from symboslam.sim_bridge.search._base import Goals, Search
from symboslam.sim_bridge.search.area import Area, Bools, Floats
from symboslam.sim_bridge.search.swarm import Goal, Swarm

_PLUS = np.array([[0, 1, 0], [1, 1, 1], [0, 1, 0]], bool)
_REPULSION = 0.5  # metres of way for each metre that a goal is nearer to another's than two reaches
_TURN = 0.5  # reaches of way for turning round
_NEAR = 4.0  # reaches within which a frontier is looked for first
_KEEP = 60.0  # seconds after which a goal is chosen anew in any case


class Frontier(Search):
    """The nearest frontier of the own Voronoi cell; when there is none, the nearest of all.

    When all was seen robots look again, along the edge first, as cells are seen by their middles.
    """

    name: ClassVar[str] = "frontier"

    def __init__(self, area: Area, seed: int = 0) -> None:
        super().__init__(area, seed)
        self._goal: Goals = [None] * area.robots
        self._since = [0.0] * area.robots
        self._refused: Bools | None = None
        self._done = False
        inset = min(area.reach / 2, area.width / 4, area.height / 4)
        min_x, min_y, max_x, max_y = area.extent
        ring = LinearRing(box(min_x + inset, min_y + inset, max_x - inset, max_y - inset).exterior)
        places = line_interpolate_point(ring, np.arange(0.0, ring.length, 4 * inset))
        self._edge: list[tuple[float, float]] = [(p.x, p.y) for p in places]
        self._near = inset / 2

    def _goals(self, swarm: Swarm) -> Goals:
        return self.goals_of(swarm, swarm.working)

    def goals_of(self, swarm: Swarm, robots: list[int]) -> Goals:
        """Goals of some working robots; None for the others."""
        grid = swarm.coverage
        if self._refused is None:
            self._refused = np.zeros(grid.seen.shape, bool)
        for robot in robots:
            goal = self._goal[robot]
            if goal is not None and swarm.gave_up[robot]:
                self._refuse(swarm, goal)
        stale = [robot for robot in robots if self._is_stale(swarm, robot)]
        for robot in range(len(self._goal)):
            if robot in stale or robot not in robots:
                self._goal[robot] = None
        for robot in stale:
            self._choose(swarm, robots, robot)
        return list(self._goal)

    def _is_stale(self, swarm: Swarm, robot: int) -> bool:
        goal = self._goal[robot]
        if goal is None or swarm.gave_up[robot] or swarm.time - self._since[robot] > _KEEP:
            return True
        if self._done:
            return goal.distance_from(*swarm.poses[robot, :2].tolist()) < self._near
        row, column = swarm.coverage.cells_of(np.array([[goal.x, goal.y]]))
        return bool(swarm.coverage.seen[row[0], column[0]])

    def _refuse(self, swarm: Swarm, goal: Goal) -> None:
        """Nobody is sent again to where a robot could not get."""
        grid = swarm.coverage
        assert self._refused is not None
        near = np.hypot(grid.x[None, :] - goal.x, grid.y[:, None] - goal.y) < self.area.reach / 4
        row, column = grid.cells_of(np.array([[goal.x, goal.y]]))
        self._refused |= near
        self._refused[row[0], column[0]] = True

    def _choose(self, swarm: Swarm, robots: list[int], robot: int) -> None:
        """The best frontier nearby; where there is none, the best of all."""
        near = self._candidates(swarm, swarm.poses[robot, :2])
        xy, mine = self._own(swarm, robots, robot, near)
        if not mine:
            xy, mine = self._own(swarm, robots, robot, self._candidates(swarm, None))
        if len(xy):
            self._goal[robot] = self._best(swarm, robot, xy)
        else:
            self._done = True
            self._goal[robot] = self._patrol(swarm, robot)
        self._since[robot] = swarm.time

    def _patrol(self, swarm: Swarm, robot: int) -> Goal:
        """Where to look again when all cells were seen: along the edge, then anywhere."""
        x, y = swarm.poses[robot, :2].tolist()
        if self._edge:
            near = [math.dist((x, y), place) for place in self._edge]
            return Goal(*self._edge.pop(near.index(min(near))))
        min_x, min_y, max_x, max_y = self.area.extent
        u, v = self.rng.random(2).tolist()
        return Goal(min_x + u * (max_x - min_x), min_y + v * (max_y - min_y))

    def _candidates(self, swarm: Swarm, middle: Floats | None) -> Floats:
        """(k, 2) unseen cells that border on seen ones; where there are none, any unseen.

        Only those in a square around a middle, if there is one; there only those at borders.
        """
        grid = swarm.coverage
        assert self._refused is not None
        rows = columns = slice(None)
        if middle is not None:
            far = _NEAR * self.area.reach
            corners = np.array([middle - far, middle + far])
            (south, north), (west, east) = grid.cells_of(corners)
            rows, columns = slice(int(south), int(north) + 1), slice(int(west), int(east) + 1)
        seen = grid.seen[rows, columns]
        missing = grid.free[rows, columns] & ~seen & ~self._refused[rows, columns]
        border = missing & binary_dilation(seen, _PLUS)
        some = border if middle is not None or border.any() else missing
        row, column = np.nonzero(some)
        return np.column_stack([grid.x[columns][column], grid.y[rows][row]])

    def _own(self, swarm: Swarm, robots: list[int], robot: int, xy: Floats) -> tuple[Floats, bool]:
        """The places to which no other robot is nearer, or all if there are none; and which."""
        poses = swarm.poses[robots]
        away = np.hypot(xy[:, None, 0] - poses[:, 0], xy[:, None, 1] - poses[:, 1])
        own = away.argmin(1) == robots.index(robot)
        return (xy[own], True) if own.any() else (xy, False)

    def _best(self, swarm: Swarm, robot: int, xy: Floats) -> Goal:
        """The cheapest of some places: near, ahead, and not where others are going."""
        reach = self.area.reach
        dx, dy = xy[:, 0] - swarm.poses[robot, 0], xy[:, 1] - swarm.poses[robot, 1]
        turn = 1 - np.cos(np.arctan2(dy, dx) - swarm.poses[robot, 2])
        cost = np.hypot(dx, dy) + _TURN * reach * turn / 2
        for other, goal in enumerate(self._goal):
            if goal is not None and other != robot:
                gap = np.hypot(xy[:, 0] - goal.x, xy[:, 1] - goal.y)
                cost = cost + _REPULSION * np.clip(2 * reach - gap, 0, None)
        x, y = xy[int(cost.argmin())].tolist()
        return Goal(x, y)
