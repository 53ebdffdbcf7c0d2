"""Plan: which mission is flown for a row of the table."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from symboslam.errors import InputError
from symboslam.sim_bridge.search.paper_areas import AREAS

SPEED = 15.0
"""Metres a second of the robots, in all areas."""
REACH = 80.0
"""Metres within which ground counts as looked at, in all areas."""
OTHERS = 10.0
"""Minutes in worlds that the paper does not have."""
MANY = "city-10-robots"
"""The mission that shows how fast ten robots are; no map is built of it."""


@dataclass(frozen=True)
class Plan:
    """One mission.

    Attributes:
        name: of the row and of its folder.
        world: a named world, or a file.
        minutes: simulated, at most.
        robots: how many.
        search: strategy.
        slam: way of map building.
        seed: of the mission.
        world_seed: of a named world.
        speed: of the robots, metres a second.
        reach: metres within which ground counts as looked at.
        mapped: whether a map is built; else the mission is flown for its speed alone.
    """

    name: str
    world: str
    minutes: float
    robots: int = 3
    search: str = "boustrophedon"
    slam: str = "ours"
    seed: int = 0
    world_seed: int = 7
    speed: float = SPEED
    reach: float = REACH
    mapped: bool = True

    @property
    def cost(self) -> float:
        """About how long it takes, to begin with the longest: minutes of all robots."""
        return self.minutes * self.robots


def plans(
    areas: Sequence[str] = (), minutes: float | None = None, **options: float | int | str
) -> list[Plan]:
    """The missions of a table.

    Args:
        areas: names or files of worlds; none for the paper's six and ten robots in City.
        minutes: of each at most; None for the paper's, or 10 where it has none.
        options: other attributes of the plans, the same for all.

    Raises:
        InputError: two worlds of one name.
    """
    found: list[Plan] = []
    for area in areas or (*AREAS, MANY):
        name = Path(area).stem if Path(area).suffix else area.casefold()
        if any(plan.name == name for plan in found):
            raise InputError(f"{name} is named twice")
        if name == MANY:
            most = OTHERS if minutes is None else min(minutes, OTHERS)
            many = options | {"robots": 10, "mapped": False}
            found.append(Plan(name, "city", most, **many))  # type: ignore[arg-type]
            continue
        paper = AREAS.get(name)
        limit = minutes or (OTHERS if paper is None else paper.minutes)
        found.append(Plan(name, area, limit, **options))  # type: ignore[arg-type]
    return found
