"""ControlAgent: what the robots' team shares: search goals and who approaches what."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Protocol

from symboslam.sim_bridge.mission.edge_agent import EdgeAgent, Point

Pose = tuple[float, float, float]


class Search(Protocol):
    """A search strategy, as the control agent uses it."""

    def goals(self, time: float, poses: Mapping[str, Pose]) -> Mapping[str, Point | None]:
        """Where each robot goes if it approaches nothing; None to stay.

        Args:
            time: seconds.
            poses: robot -> where it believes to be, of those that are not given up.
        """
        ...


class ControlAgent:
    """Gives goals to edge agents; it knows of them what they believe, never the truth.

    Args:
        agents: the robots.
        search: the strategy.
    """

    def __init__(self, agents: Sequence[EdgeAgent], search: Search) -> None:
        self._agents, self._search = agents, search

    def assign(self, time: float, seconds: float) -> dict[str, Point | None]:
        """Goals for the next ``seconds``; a robot with a target has it in ``EdgeAgent.target``.

        Targets are coordinated: robot after robot chooses, and leaves to the others what they have
        chosen.
        """
        active = [agent for agent in self._agents if not agent.lost]
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
        goals = self._search.goals(time, {a.name: a.pose for a in active})
        return {agent.name: goals.get(agent.name) for agent in self._agents}
