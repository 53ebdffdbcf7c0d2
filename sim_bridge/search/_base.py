"""Search: one way to send robots through an area; all are found by name in ``registry``."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import ClassVar

import numpy as np

from symboslam.errors import InputError
from symboslam.sim_bridge.search.area import Area
from symboslam.sim_bridge.search.swarm import Goal, Swarm

Goals = list[Goal | None]
"""One for each robot: None for a lost one, or for one that has nothing left to do."""


class Search(ABC):
    """One way to search an area.

    Args:
        area: what is to be searched, as far as it is known.
        seed: of all that is random; the same seed and the same swarms give the same goals.

    Attributes:
        name: what users call it.
        random: whether it goes on for ever, where others stop when all was seen.
    """

    name: ClassVar[str]
    random: ClassVar[bool] = False

    def __init__(self, area: Area, seed: int = 0) -> None:
        if seed < 0:
            raise InputError(f"seed {seed}: give an integer of 0 or more")
        self.area = area
        self.rng = np.random.default_rng(seed)

    def __call__(self, swarm: Swarm) -> Goals:
        """Where each robot is to go now; called at each tick, with time going forward.

        Raises:
            InputError: the swarm has another number of robots than the area has starts.
        """
        if len(swarm.poses) != self.area.robots:
            raise InputError(f"{len(swarm.poses)} robots where the area has {self.area.robots}")
        return self._goals(swarm) if swarm.alive.any() else [None] * self.area.robots

    @abstractmethod
    def _goals(self, swarm: Swarm) -> Goals:
        """Goals of a swarm with a working robot at least; places lie within the extent."""
