"""ControlAgent: what the robots' team shares: search goals and who approaches what."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from symboslam.sim_bridge.mission.edge_agent import EdgeAgent, Point
from symboslam.sim_bridge.mission.leash import Leash
from symboslam.sim_bridge.search._base import Search
from symboslam.sim_bridge.search.coverage import Coverage
from symboslam.sim_bridge.search.swarm import Goal, Swarm

FAR = 100.0
"""Metres to the place that stands for a heading to keep."""
SLOW = 3.0
"""A goal is given up after so many times the time that the straight way takes, and `GRACE`."""
GRACE = 15.0
"""Seconds."""
SCAN = 6.0
"""Seconds in which robots stand and look around before they set out: what they see is what ties
their map to their start."""
CLOSE = 5.0
"""Metres from a goal that are there."""


class ControlAgent:
    """Gives goals to edge agents; it knows of them what they believe, never the truth.

    Args:
        agents: the robots.
        search: the strategy.
    """

    def __init__(self, agents: Sequence[EdgeAgent], search: Search) -> None:
        self._agents, self._search = agents, search
        self._coverage = Coverage.of(search.area)
        self._before: list[NDArray[np.float64] | None] = [None] * len(agents)
        self._rounds = 0
        self._bumps = [0] * len(agents)
        self._goal: list[Goal | None] = [None] * len(agents)
        self._until = [math.inf] * len(agents)
        self._leash = [Leash(search.area.speed) for _ in agents]

    def assign(self, time: float, seconds: float) -> dict[str, Point | None]:
        """Goals for the next ``seconds``; a robot with a target has it in ``EdgeAgent.target``."""
        self._coordinate(seconds)
        goals = self._search(self._swarm(time, seconds))
        if all(goal is None for goal in goals) and not all(agent.lost for agent in self._agents):
            self._again()
        found: dict[str, Point | None] = {}
        for n, (agent, goal) in enumerate(zip(self._agents, goals, strict=True)):
            x, y, _ = agent.pose
            if goal is not None and goal != self._goal[n]:
                way = goal.distance_from(x, y) / self._search.area.speed
                self._until[n] = time + SLOW * way + GRACE
            self._goal[n] = goal
            back = self._leash[n].pull(time, (x, y), agent.sigma)
            if time < SCAN:
                found[agent.name] = None
            elif back is not None and not agent.lost:
                self._until[n] += seconds
                found[agent.name] = back
            elif goal is None:
                found[agent.name] = None
            elif goal.heading is not None:
                turn = goal.heading
                found[agent.name] = (x + FAR * math.cos(turn), y + FAR * math.sin(turn))
            else:
                found[agent.name] = (goal.x, goal.y)
        return found

    def _again(self) -> None:
        """All was looked at: begin anew, for what was missed and for the loops that it closes."""
        area = self._search.area
        self._rounds += 1
        self._search = type(self._search)(area, self._rounds)
        self._coverage = Coverage.of(area)

    def _coordinate(self, seconds: float) -> None:
        """Robot after robot chooses a target, and leaves to the others what they have chosen."""
        active = []
        for agent, leash in zip(self._agents, self._leash, strict=True):
            if leash.goal is not None:
                agent.target = None  # no time to lose on the way back
            elif not agent.lost:
                active.append(agent)
        claimed: list[Point] = []
        for agent in active:
            others = [
                (a.target.x, a.target.y)
                for a in active
                if a is not agent and a.target is not None and a.target.spent > 0
            ]
            target = agent.choose([*claimed, *others], seconds)
            if target is not None:
                claimed.append((target.x, target.y))

    def _swarm(self, time: float, seconds: float) -> Swarm:
        """The team as it believes itself to be."""
        area = self._search.area
        poses = np.array([agent.pose for agent in self._agents])
        alive = np.array([not agent.lost for agent in self._agents])
        bumped = np.array([a.bumps > b for a, b in zip(self._agents, self._bumps, strict=True)])
        self._bumps = [agent.bumps for agent in self._agents]
        gave_up = np.zeros(len(poses), bool)
        for n, agent in enumerate(self._agents):
            before = self._before[n] if self._before[n] is not None else poses[n]
            assert before is not None
            # A robot that has just closed a loop jumps in its own eyes; it saw nothing on the way.
            jumped = math.dist(before[:2], poses[n, :2]) > 2 * area.speed * seconds + CLOSE
            self._coverage.sweep(poses[n] if jumped else before, poses[n], area.reach, area.fov)
            self._before[n] = poses[n]
            if agent.target is not None:
                self._until[n] += seconds
            gave_up[n] = agent.stuck or time > self._until[n]
            if gave_up[n]:
                self._goal[n] = None
        features = [(t.x, t.y) for agent in self._agents for t in agent.targets.all if t.mapped]
        obstacles = set().union(*(agent.obstacles for agent in self._agents))
        return Swarm(
            time,
            poses,
            alive,
            self._coverage,
            bumped,
            gave_up,
            np.array(features, float).reshape(-1, 2),
            np.array(sorted(obstacles), float).reshape(-1, 2),
        )
