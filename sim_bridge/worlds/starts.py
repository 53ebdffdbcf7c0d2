"""Starts: places for robots, the first near the middle, each next far from the others."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from symboslam.sim_bridge.worlds.world import Extent, Start, World

STARTS = 10
"""Robot starts of a world that is made here."""
_GRID = 13


def spread(
    places: NDArray[np.float64], headings: NDArray[np.float64], extent: Extent
) -> tuple[Start, ...]:
    """Up to ``STARTS`` of some places.

    Args:
        places: (n, 2) metres, at least one.
        headings: (n,) radians.
        extent: of the world.
    """
    middle = np.array([(extent.min_x + extent.max_x) / 2, (extent.min_y + extent.max_y) / 2])
    chosen = [int(np.argmin(np.hypot(*(places - middle).T)))]
    gaps = np.full(len(places), np.inf)
    while len(chosen) < min(STARTS, len(places)):
        gaps = np.minimum(gaps, np.hypot(*(places - places[chosen[-1]]).T))
        chosen.append(int(np.argmax(gaps)))
    return tuple(
        Start(round(float(x), 2), round(float(y), 2), round(float(turn) % (2 * math.pi), 4))
        for x, y, turn in np.column_stack([places, headings])[chosen]
    )


def with_starts(world: World) -> World:
    """The world with starts: its own, or where it has none places of a grid over its extent."""
    if world.starts:
        return world
    e = world.extent
    x = e.min_x + e.width * (np.arange(_GRID) + 0.5) / _GRID
    y = e.min_y + e.height * (np.arange(_GRID) + 0.5) / _GRID
    places = np.stack(np.meshgrid(x, y, indexing="ij"), -1).reshape(-1, 2)
    return replace(world, starts=spread(places, np.zeros(len(places)), e))
