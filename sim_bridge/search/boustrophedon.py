"""Boustrophedon: the area parted among the robots, each part driven up and down in lanes.

After Choset (2001) for one robot. Lanes of a lost robot go to those that will be done first; who
is done takes half of what the busiest has left, and at last fills the holes by frontier search.
"""

from __future__ import annotations

import math
from typing import ClassVar

import numpy as np

from symboslam.sim_bridge.search._base import Goals, Search
from symboslam.sim_bridge.search.area import Area, Bools, Floats
from symboslam.sim_bridge.search.frontier import Frontier
from symboslam.sim_bridge.search.lanes import Lane, Place, path_length, plan
from symboslam.sim_bridge.search.swarm import Goal, Swarm


class _Work:
    """What one robot has to do: a lane that it is on, lanes of its own in order, adopted ones."""

    def __init__(self) -> None:
        self.lane: Lane | None = None
        self.on_lane = False
        self.way = 0.0
        self.own: list[Lane] = []
        self.adopted: list[Lane] = []

    def left(self) -> list[Lane]:
        """Everything, the rest of the current lane first."""
        now = [self.lane.part(self.way, self.lane.length)] if self.lane else []
        return [*now, *self.own, *self.adopted]

    def take(self, x: float, y: float) -> Lane | None:
        """The next lane, to be driven from its nearer end."""
        if self.own:
            lane = self.own.pop(0)
        elif self.adopted:
            near = [min(math.dist((x, y), e) for e in (a.start, a.end)) for a in self.adopted]
            lane = self.adopted.pop(int(np.argmin(near)))
        else:
            return None
        back = math.dist((x, y), lane.end) < math.dist((x, y), lane.start)
        return lane.turned() if back else lane


class Boustrophedon(Search):
    """Partitioned lanes a bit less than the sensor's width apart."""

    name: ClassVar[str] = "boustrophedon"

    def __init__(self, area: Area, seed: int = 0) -> None:
        super().__init__(area, seed)
        self._work: list[_Work] | None = None
        self._lost: set[int] = set()
        self._filler = Frontier(area, seed)
        self._tolerance = min(max(area.reach / 20, area.speed / 2), area.sensor_width / 2)
        self._ahead = max(area.reach / 2, 2 * area.speed)
        self._skip = area.reach / 2

    def _goals(self, swarm: Swarm) -> Goals:
        work = self._work if self._work is not None else self._begin(swarm)
        for robot in range(len(work)):
            if not swarm.alive[robot] and robot not in self._lost:
                self._lost.add(robot)
                self._hand_over(swarm, work, robot)
        goals: Goals = [None] * len(work)
        idle = []
        for robot in swarm.working:
            goals[robot] = self._follow(swarm, work, robot)
            if goals[robot] is None:
                idle.append(robot)
        if idle:
            filling = self._filler.goals_of(swarm, idle)
            goals = [goal or fill for goal, fill in zip(goals, filling, strict=True)]
        return goals

    def _begin(self, swarm: Swarm) -> list[_Work]:
        self._work = [_Work() for _ in swarm.poses]
        working = swarm.working
        self._lost = set(range(len(swarm.poses))) - set(working)
        places = [_place(swarm, robot) for robot in working]
        for robot, lanes in zip(working, plan(self.area, places), strict=True):
            self._work[robot].own = list(lanes)
        return self._work

    def _hand_over(self, swarm: Swarm, work: list[_Work], lost: int) -> None:
        """Each lane that a lost robot leaves goes to whoever would be done with it first."""
        lanes = work[lost].left()
        work[lost] = _Work()
        for lane in lanes:
            soonest = min(
                swarm.working,
                key=lambda r: path_length((*work[r].left(), lane), _place(swarm, r)),
            )
            work[soonest].adopted.append(lane)

    def _follow(self, swarm: Swarm, work: list[_Work], robot: int) -> Goal | None:
        """A place on the robot's lane ahead of it; None when nothing is left for it."""
        mine = work[robot]
        x, y = _place(swarm, robot)
        if swarm.gave_up[robot] and mine.lane is not None:
            mine.way, mine.on_lane = self._past(mine), True
        for _ in range(1000):
            if mine.lane is None:
                mine.lane = self._next_lane(swarm, work, robot)
                mine.way, mine.on_lane = 0.0, False
                if mine.lane is None:
                    return None
            lane = mine.lane
            if not mine.on_lane:
                if math.dist((x, y), lane.start) > self._tolerance:
                    return Goal(*lane.start)
                mine.on_lane = True
            mine.way = max(mine.way, lane.way_of(x, y))
            if mine.way < lane.length - self.area.speed / 4 and self._is_needed(swarm, mine):
                return Goal(*lane.at(mine.way + self._ahead))
            mine.lane = None
        return None

    def _past(self, mine: _Work) -> float:
        """Metres along a lane to behind the place that could not be reached."""
        return mine.way + self._ahead + self._skip

    def _next_lane(self, swarm: Swarm, work: list[_Work], robot: int) -> Lane | None:
        """The next lane with anything to see, cut to where that is."""
        mine = work[robot]
        x, y = _place(swarm, robot)
        while True:
            lane = mine.take(x, y)
            if lane is None:
                if not self._help(swarm, work, robot):
                    return None
                continue
            trimmed = self._trimmed(swarm, lane)
            if trimmed is not None:
                return trimmed

    def _help(self, swarm: Swarm, work: list[_Work], robot: int) -> bool:
        """Take over half of what the busiest robot has left; false if that is not worth it."""
        others = [other for other in swarm.working if other != robot]
        if not others:
            return False
        left = {o: path_length(tuple(work[o].left()), _place(swarm, o)) for o in others}
        busiest = max(others, key=lambda o: left[o])
        if left[busiest] < 6 * self.area.reach:
            return False
        his, mine = work[busiest], work[robot]
        spare = [*his.own, *his.adopted]
        if spare:
            keep = len(spare) // 2
            mine.adopted.extend(spare[keep:])
            his.own, his.adopted = spare[:keep], []
            return True
        lane = his.lane
        if lane is None or lane.length - his.way < 4 * self.area.reach:
            return False
        cut = (his.way + lane.length) / 2
        mine.adopted.append(lane.part(cut, lane.length).turned())
        his.lane = lane.part(0.0, cut)
        return True

    def _trimmed(self, swarm: Swarm, lane: Lane) -> Lane | None:
        """The part of a lane along which something is unseen; None where nothing is."""
        grid = swarm.coverage
        step = min(grid.step_x, grid.step_y)
        ways = np.linspace(0.0, lane.length, max(2, math.ceil(lane.length / step) + 1))
        unseen = np.flatnonzero(self._unseen(swarm, lane, ways))
        if not len(unseen):
            return None
        first, last = float(ways[unseen[0]]), float(ways[unseen[-1]])
        slack = 2 * step
        return lane.part(first - slack if first > slack else 0.0, last + slack)

    def _is_needed(self, swarm: Swarm, mine: _Work) -> bool:
        """Whether the rest of a lane still shows anything."""
        assert mine.lane is not None
        ways = np.linspace(mine.way, mine.lane.length, 24)
        return bool(self._unseen(swarm, mine.lane, ways).any())

    def _unseen(self, swarm: Swarm, lane: Lane, ways: Floats) -> Bools:
        """(k,) whether anything across the lane at each way is unseen, at its end beyond it too."""
        grid = swarm.coverage
        (ax, ay), (bx, by) = lane.start, lane.end
        length = lane.length or 1.0
        ux, uy = (bx - ax) / length, (by - ay) / length
        half = self.area.sensor_width / 2 * 0.9
        across = np.linspace(-half, half, 7)
        reach = self.area.reach * 0.9
        along = ways + np.where(ways >= lane.length - 1e-9, reach, 0.0)
        along = np.where(ways <= 1e-9, -reach, along)
        x = ax + ux * along[:, None] - uy * across
        y = ay + uy * along[:, None] + ux * across
        xy = np.column_stack([x.ravel(), y.ravel()])
        row, column = grid.cells_of(xy)
        unseen: Bools = np.logical_and(grid.missing[row, column], self.area.inside(xy))
        across_any: Bools = np.any(unseen.reshape(len(ways), -1), axis=1)
        return across_any


def _place(swarm: Swarm, robot: int) -> Place:
    x, y = swarm.poses[robot, :2].tolist()
    return x, y
