"""Trial: one strategy in a flat area with features, without physics or pictures, to metrics."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from symboslam.errors import InputError
from symboslam.sim_bridge.search._base import Search
from symboslam.sim_bridge.search.area import Area, Bools, Floats
from symboslam.sim_bridge.search.coverage import Coverage, swept
from symboslam.sim_bridge.search.registry import get_search
from symboslam.sim_bridge.search.steering import Drive, Pose, Stuck, advance, steer
from symboslam.sim_bridge.search.swarm import Goal, Swarm
from symboslam.sim_bridge.search.swarm_metrics import SearchMetrics, dispersion

ENOUGH = 0.9995
"""A trial ends when so much was seen, and every feature."""


@dataclass(frozen=True)
class Trial:
    """What came of a trial.

    Attributes:
        metrics: coverage, features and dispersion over time.
        paths: (t, n, 3) poses of all robots each second.
        coverage: what was seen in the end.
        gave_up: how many goals could not be reached.
    """

    metrics: SearchMetrics
    paths: Floats
    coverage: Coverage
    gave_up: int


class _Team:
    """Robots that drive: poses, who works, what happened since the last tick."""

    def __init__(self, area: Area, drive: Drive) -> None:
        n = area.robots
        self.area, self.drive = area, drive
        self.poses: Floats = np.array(area.starts, float)
        self.alive: Bools = np.ones(n, bool)
        self.bumped: Bools = np.zeros(n, bool)
        self.gave_up: Bools = np.zeros(n, bool)
        self.watchers = [Stuck(progress=area.speed / 2) for _ in range(n)]
        self.tree = cKDTree(area.outlines) if len(area.outlines) else None

    def move(self, robot: int, goal: Goal, time: float, tick: float) -> None:
        """Drive one robot for a tick."""
        x, y, heading = self.poses[robot].tolist()
        pose: Pose = (x, y, heading)
        self.bumped[robot] = self.gave_up[robot] = False
        advice = self.watchers[robot].watch(time, pose, goal)
        if advice == "give up":
            self.gave_up[robot] = True
        elif advice == "back":
            self._to(robot, advance(pose, -self.drive.speed / 4, 0.0, tick))
        elif advice == "turn":
            self._to(robot, advance(pose, 0.0, self.drive.turn_rate, tick))
        else:
            speed, turn = steer(pose, goal, self.drive, self._near(x, y), tick)
            self._to(robot, advance(pose, speed, turn, tick))

    def _near(self, x: float, y: float) -> Floats:
        if self.tree is None:
            return np.empty((0, 2))
        near: Floats = self.area.outlines[self.tree.query_ball_point((x, y), self.drive.look)]
        return near

    def _to(self, robot: int, pose: Pose) -> None:
        x, y = self.area.clipped(*pose[:2])
        wall = (x, y) != pose[:2]
        if self.area.obstacles and self.area.blocked(np.array([[x, y]]))[0]:
            x, y = self.poses[robot, :2].tolist()
            wall = True
        self.bumped[robot] = wall
        self.poses[robot] = x, y, pose[2]


def run_trial(
    area: Area,
    search: str | type[Search],
    features: Floats,
    seconds: float,
    *,
    seed: int = 0,
    tick: float = 1.0,
    cell: float | None = None,
    drive: Drive | None = None,
    lost: Mapping[int, float] | None = None,
    mapped: bool = False,
    stop: bool = True,
    tell: Callable[[float], None] | None = None,
) -> Trial:
    """Search an area for a time.

    Args:
        area: the ground and the robots.
        search: a strategy or its name.
        features: (k, 2) places of what is to be found, metres.
        seconds: how long at most.
        seed: of the strategy; the same seed gives the same trial.
        tick: seconds between goals.
        cell: of the coverage grid, metres; a sixth of the reach if left out.
        drive: what the robots can do; by default the area's speed and 0.8 rad/s.
        lost: robot -> second at which it stops working.
        mapped: whether the strategy knows the obstacles beforehand.
        stop: whether to end when all was seen.
        tell: called now and then with the share of the time that is over.

    Raises:
        InputError: a time or a tick that is not positive, features that are not finite pairs.
        UnknownNameError: no such strategy.
    """
    if not (math.isfinite(seconds) and seconds > 0 and math.isfinite(tick) and tick > 0):
        raise InputError(f"{seconds} seconds in ticks of {tick}: give numbers above 0")
    left = np.asarray(features, float).reshape(-1, 2)
    if not np.isfinite(left).all():
        raise InputError("features: some coordinates are not finite")
    kind = get_search(search) if isinstance(search, str) else search
    strategy = kind(area if mapped else area.unmapped(), seed)
    team = _Team(area, drive or Drive(area.speed, look=max(2.5 * area.speed, 5.0)))
    record = _Record(area, left, Coverage.of(area, cell))
    record.look(0.0, team.poses, team.poses, team.alive)
    for number in range(math.ceil(seconds / tick)):
        time = number * tick
        for robot, end in (lost or {}).items():
            team.alive[robot] &= time < end
        goals = strategy(record.swarm(time, team))
        before = team.poses.copy()
        for robot, goal in enumerate(goals):
            if goal is not None:
                team.move(robot, goal, time, tick)
        record.look(time + tick, before, team.poses, team.alive)
        record.gave_up += int(team.gave_up.sum())
        if tell is not None and number % 100 == 0:
            tell(time / seconds)
        if stop and record.coverage.share >= ENOUGH and not record.waiting.any():
            break
        if not team.alive.any():
            break
    return record.trial()


class _Record:
    """What the team sees, kept over time."""

    def __init__(self, area: Area, features: Floats, coverage: Coverage) -> None:
        self.area, self.features, self.coverage = area, features, coverage
        self.found: Floats = np.full(len(features), math.inf)
        self.waiting: Bools = np.ones(len(features), bool)
        self.known: Bools = np.zeros(len(area.outlines), bool)
        self.gave_up = 0
        self._rows: list[tuple[float, float, float, float]] = []
        self._poses: list[Floats] = []
        self._driven = 0.0
        self._features, self._obstacles = features[:0], area.outlines[:0]

    def look(self, time: float, before: Floats, after: Floats, alive: Bools) -> None:
        """All working robots look while they move."""
        reach, fov = self.area.reach, self.area.fov
        news = False
        for robot in np.flatnonzero(alive).tolist():
            a, b = before[robot], after[robot]
            self.coverage.sweep(a, b, reach, fov)
            self._driven += math.dist(a[:2].tolist(), b[:2].tolist())
            wait = np.flatnonzero(self.waiting)
            new = wait[swept(self.features[wait], a, b, reach, fov)]
            self.found[new] = time
            self.waiting[new] = False
            news |= len(new) > 0
            if not self.known.all():
                self.known |= swept(self.area.outlines, a, b, reach, fov)
                self._obstacles = self.area.outlines[self.known]
        if news:
            self._features = self.features[~self.waiting]
        self._poses.append(after.copy())
        self._rows.append((time, self.coverage.share, dispersion(after, alive), self._driven))

    def swarm(self, time: float, team: _Team) -> Swarm:
        """What the strategy is told."""
        return Swarm(
            time, team.poses.copy(), team.alive.copy(), self.coverage, team.bumped.copy(),
            team.gave_up.copy(), self._features, self._obstacles,
        )  # fmt: skip

    def trial(self) -> Trial:
        """The end."""
        time, share, apart, driven = np.array(self._rows).T
        area = self.area
        metrics = SearchMetrics(
            time, share, apart, driven, self.found, area.size, area.diagonal, area.speed,
            area.sensor_width, area.robots,
        )  # fmt: skip
        return Trial(metrics, np.array(self._poses), self.coverage, self.gave_up)
