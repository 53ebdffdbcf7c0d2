"""Starts: a team starts from one place, so that its robots map the same things at first.

The place is where most objects are near, in the middle half of the area.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from symboslam.sim_bridge.worlds.world import Extent, Start, World, WorldObject

STARTS = 10
"""Robot starts of a world that is made here."""
NEAR = 60.0
"""Metres within which objects count."""
APART = 6.0
"""Metres between two robots in the row."""
_GRID = 13


def base(
    places: NDArray[np.float64],
    headings: NDArray[np.float64],
    extent: Extent,
    objects: Sequence[WorldObject],
) -> tuple[Start, ...]:
    """A row of ``STARTS`` at one of some places, the first in its middle, facing all ways in turn.

    Args:
        places: (n, 2) metres, at least one.
        headings: (n,) radians; the row lies along them.
        extent: of the world.
        objects: what there is to see.
    """
    middle = np.array([(extent.min_x + extent.max_x) / 2, (extent.min_y + extent.max_y) / 2])
    away = np.abs(places - middle) / np.array([extent.width, extent.height])
    inner = np.flatnonzero(away.max(1) <= max(0.25, float(away.max(1).min())))
    xy = np.array([(o.x, o.y) for o in objects], float).reshape(-1, 2)
    near = (np.hypot(*(places[inner, None] - xy[None]).transpose(2, 0, 1)) < NEAR).sum(1)
    best = inner[np.lexsort((away[inner].max(1), -near))[0]]
    (x, y), along = places[best].tolist(), float(headings[best])
    found = []
    for n in range(STARTS):
        step = APART * ((n + 1) // 2) * (1 if n % 2 else -1)
        at_x, at_y = x + step * math.cos(along), y + step * math.sin(along)
        turn = (along + n * math.tau / 3) % math.tau
        found.append(Start(round(at_x, 2), round(at_y, 2), round(turn, 4)))
    return tuple(found)


def with_starts(world: World) -> World:
    """The world with starts: its own, or where it has none at one place of a grid."""
    if world.starts:
        return world
    e = world.extent
    x = e.min_x + e.width * (np.arange(_GRID) + 0.5) / _GRID
    y = e.min_y + e.height * (np.arange(_GRID) + 0.5) / _GRID
    places = np.stack(np.meshgrid(x, y, indexing="ij"), -1).reshape(-1, 2)
    return replace(world, starts=base(places, np.zeros(len(places)), e, world.objects))
