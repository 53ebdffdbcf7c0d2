"""Areas of the paper: size, features, and the time and coverage that it reports where known.

Of the coverage the paper's six areas have between 74.5 and 98.5 %, of the time between 12.7 and 84
minutes (arXiv 2403.15504). Where an area's own figures are not at hand, the hardest of the range is
asked of it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from symboslam.errors import InputError, UnknownNameError
from symboslam.sim_bridge.search.area import Area, Floats


@dataclass(frozen=True)
class PaperArea:
    """One area.

    Attributes:
        name: as on the command line.
        km2: its size.
        features: how many it has.
        minutes: that a search may take.
        coverage: share that the paper's robots saw in that time, or that is asked here.
        known: whether minutes and coverage are the paper's own.
    """

    name: str
    km2: float
    features: int
    minutes: float
    coverage: float
    known: bool


AREAS: dict[str, PaperArea] = {
    area.name: area
    for area in (
        PaperArea("kingston", 0.5041, 212, 14.6, 0.877, True),
        PaperArea("train-depot", 1.0976, 167, 12.7, 0.985, False),
        PaperArea("city", 1.8225, 429, 40.0, 0.985, True),
        PaperArea("fyshwick", 6.6667, 152, 30.0, 0.832, True),
        PaperArea("airport", 27.8891, 199, 84.0, 0.985, False),
        PaperArea("gungahlin", 29.5609, 3694, 84.0, 0.985, False),
    )
}


def get_paper_area(name: str) -> PaperArea:
    """An area by its name, whatever its case.

    Raises:
        UnknownNameError: there is none.
    """
    if name.casefold() not in AREAS:
        raise UnknownNameError(f"no area {name!r}; there are: {', '.join(AREAS)}")
    return AREAS[name.casefold()]


def square(km2: float) -> tuple[float, float]:
    """Width and height in metres of a square."""
    return math.sqrt(km2) * 1000, math.sqrt(km2) * 1000


def open_area(
    width: float, height: float, robots: int, features: int, seed: int,
    *, speed: float = 10.0, reach: float = 60.0, fov: float = 2 * math.pi,
) -> tuple[Area, Floats]:  # fmt: skip
    """Flat open ground with starts and features anywhere on it, from a seed.

    Returns:
        The area, and (features, 2) places.

    Raises:
        GeometryError: width or height is not positive.
        InputError: no robots, a negative number or seed.
    """
    if seed < 0 or robots < 1 or features < 0:
        raise InputError(
            f"{robots} robots, {features} features, seed {seed}: give 1, 0 and 0 or more"
        )
    rng = np.random.default_rng([seed, 8])
    size = np.array([width, height])
    places = rng.uniform(0.02, 0.98, (robots, 2)) * size
    turns = rng.uniform(-math.pi, math.pi, robots)
    starts = tuple((float(x), float(y), float(t)) for (x, y), t in zip(places, turns, strict=True))
    area = Area((0.0, 0.0, width, height), starts, speed, reach, fov)
    return area, rng.uniform(0, 1, (features, 2)) * size
