"""Random walks: the paper's quasi-random walk with incentives, and the same without the far ones.

At each tick a robot's heading is turned a little by chance and by the sum of what pulls and pushes
it. Incentives that react: away from edges, obstacles, other robots and from what was bumped into.
Incentives of long range, given by the control agent: away from the middle of the other robots
(dispersion), and, as a dog drives sheep, towards unsearched ground and back to the collective.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from symboslam.sim_bridge.search._base import Goals, Search
from symboslam.sim_bridge.search.area import Area, Floats
from symboslam.sim_bridge.search.swarm import Goal, Swarm

_LOOK_AGAIN = 10.0  # seconds between looks for unsearched ground
_TILES = 24  # of the longer side, at which unsearched ground is looked for


@dataclass(frozen=True)
class Incentives:
    """How strongly a robot is moved, against a vector of length 1 along its heading, a second.

    Attributes:
        noise: standard deviation of the turn by chance, radians in a second.
        edge: away from an edge, at the edge; none at half a reach from it.
        obstacle: away from the nearest obstacle; none at a quarter of a reach.
        robot: away from each robot nearby; none at a reach.
        dispersion: away from the middle of the others.
        unsearched: towards unsearched ground, the near more than the far.
        collective: back to the middle of the team, from half the area's diagonal on.
    """

    noise: float = math.radians(8)
    edge: float = 1.0
    obstacle: float = 1.0
    robot: float = 0.5
    dispersion: float = 0.03
    unsearched: float = 0.03
    collective: float = 0.05


class RandomWalk(Search):
    """The paper's quasi-random walk with reactionary and long-range incentives."""

    name: ClassVar[str] = "random-walk"
    random: ClassVar[bool] = True
    incentives: ClassVar[Incentives] = Incentives()

    def __init__(self, area: Area, seed: int = 0) -> None:
        super().__init__(area, seed)
        self._time: float | None = None
        self._looked = -math.inf
        self._pull: Floats = np.zeros((area.robots, 2))
        self._heading: Floats = np.array([heading for _, _, heading in area.starts])

    def _goals(self, swarm: Swarm) -> Goals:
        step = 1.0 if self._time is None else max(swarm.time - self._time, 0.0)
        self._time = swarm.time
        n = len(swarm.poses)
        noise = self.rng.normal(0, self.incentives.noise * math.sqrt(step), n)
        back = math.pi + self.rng.uniform(-1.0, 1.0, n)
        with np.errstate(invalid="ignore"):  # poses of lost robots may be anything
            push = self._reactions(swarm) + self._far(swarm)
        hit = swarm.bumped | swarm.gave_up
        vector = np.column_stack([np.cos(self._heading), np.sin(self._heading)]) + push * step
        heading = np.arctan2(vector[:, 1], vector[:, 0]) + noise + np.where(hit, back, 0.0)
        self._heading = np.where(swarm.alive, heading, 0.0)
        return [
            Goal.along(float(turn)) if alive else None
            for turn, alive in zip(self._heading, swarm.alive, strict=True)
        ]

    def _reactions(self, swarm: Swarm) -> Floats:
        """(n, 2) pushes away from edges, obstacles and other robots."""
        wants, reach = self.incentives, self.area.reach
        xy = swarm.poses[:, :2]
        low, high = np.array(self.area.extent[:2]), np.array(self.area.extent[2:])
        margin = np.minimum(reach / 2, (high - low) / 4)
        push: Floats = np.clip(1 - (xy - low) / margin, 0, 1) - np.clip(
            1 - (high - xy) / margin, 0, 1
        )
        push = push * wants.edge
        if len(swarm.obstacles):
            for robot in swarm.working:
                delta = xy[robot] - swarm.obstacles
                near = np.hypot(delta[:, 0], delta[:, 1])
                nearest = int(near.argmin())
                if near[nearest] < reach / 4:
                    share = 1 - near[nearest] / (reach / 4)
                    push[robot] += wants.obstacle * share * _unit(delta[nearest])
        working = swarm.working
        apart = xy[working][:, None] - xy[working]
        away = np.hypot(apart[..., 0], apart[..., 1])
        share = np.where((away > 1e-9) & (away < reach), 1 - away / reach, 0.0)
        share = wants.robot * share / np.maximum(away, 1e-9)
        push[working] += (share[..., None] * apart).sum(1)
        return push

    def _far(self, swarm: Swarm) -> Floats:
        """(n, 2) pulls of long range."""
        wants = self.incentives
        pull = np.zeros((len(swarm.poses), 2))
        if not (wants.dispersion or wants.unsearched or wants.collective):
            return pull
        if wants.unsearched and swarm.time - self._looked >= _LOOK_AGAIN:
            self._looked = swarm.time
            self._pull = self._unsearched(swarm)
        working = swarm.working
        xy = swarm.poses[:, :2]
        for robot in working:
            pull[robot] += wants.unsearched * self._pull[robot]
            others = [other for other in working if other != robot]
            if others:
                middle = xy[others].mean(0)
                pull[robot] += wants.dispersion * _unit(xy[robot] - middle)
                if math.hypot(*(xy[robot] - middle)) > self.area.diagonal / 2:
                    pull[robot] += wants.collective * _unit(middle - xy[robot])
        return pull

    def _unsearched(self, swarm: Swarm) -> Floats:
        """(n, 2) unit vectors towards unsearched ground, weighed by 1 / distance squared."""
        grid = swarm.coverage
        every = max(1, max(grid.seen.shape) // _TILES)
        rows, columns = np.nonzero(grid.missing[every // 2 :: every, every // 2 :: every])
        xy = np.column_stack(
            [grid.x[every // 2 :: every][columns], grid.y[every // 2 :: every][rows]]
        )
        found = np.zeros((len(swarm.poses), 2))
        for robot in swarm.working:
            delta = xy - swarm.poses[robot, :2]
            away = np.maximum(np.hypot(delta[:, 0], delta[:, 1]), self.area.reach / 2)
            found[robot] = _unit((delta / away[:, None] ** 3).sum(0))
        return found


class CorrelatedWalk(RandomWalk):
    """The random walk without incentives of long range."""

    name: ClassVar[str] = "correlated-walk"
    incentives: ClassVar[Incentives] = Incentives(dispersion=0, unsearched=0, collective=0)


def _unit(vector: Floats) -> Floats:
    """Of length 1; nothing stays nothing."""
    length = math.hypot(*vector)
    return vector / length if length > 1e-9 else np.zeros(2)
