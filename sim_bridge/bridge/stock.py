"""Stock: what stands in a world as columns, in tiles, so that what is near is found at once."""

from __future__ import annotations

import math
import zlib
from collections import defaultdict

import numpy as np
from numpy.typing import NDArray

from symboslam.sim_bridge.worlds.world import World, WorldObject

TILE = 40.0
"""Metres along a side of a tile."""
MODELS = 8
"""Variants of a class in one world; fewer meshes than there are variants, for the memory's sake."""
SCALES = 1.1
"""Scales are powers of this, so that few meshes are made."""


class Stock:
    """The objects of a world.

    Args:
        world: it.

    Attributes:
        objects: the world's, in its order.
        xy: (n, 2) metres.
        radius: (n,) half the diagonals of the footprints, metres.
        height: (n,) metres.
        tiles: column and row -> positions of the objects whose middle lies there.
    """

    def __init__(self, world: World) -> None:
        self.world = world
        self.objects = world.objects
        self.xy: NDArray[np.float64] = world.positions
        sizes = [o.size for o in world.objects]
        self.radius = np.array([s.radius for s in sizes], float)
        self.height = np.array([s.height for s in sizes], float)
        found: dict[tuple[int, int], list[int]] = defaultdict(list)
        for n, (x, y) in enumerate(self.xy.tolist()):
            found[math.floor(x / TILE), math.floor(y / TILE)].append(n)
        self.tiles = dict(found)
        # A tile's objects may reach out of it by so much.
        self.overhang = {t: float(self.radius[rows].max()) for t, rows in self.tiles.items()}

    def tiles_near(self, x: float, y: float, reach: float) -> set[tuple[int, int]]:
        """Tiles with an object that may reach into a circle, in metres."""
        most = reach + max(self.overhang.values(), default=0.0)
        columns = range(math.floor((x - most) / TILE), math.floor((x + most) / TILE) + 1)
        rows = range(math.floor((y - most) / TILE), math.floor((y + most) / TILE) + 1)
        found = set()
        for column in columns:
            for row in rows:
                over = self.overhang.get((column, row))
                if over is not None and _gap(x, y, column, row) < reach + over:
                    found.add((column, row))
        return found


def model_of(thing: WorldObject) -> str:
    """Variant of the mesh: the object's own, or one by class and id."""
    if thing.model is not None and thing.model.isdecimal():
        return thing.model
    text = f"{thing.kind}/{thing.id}/{thing.model or ''}"
    return str(zlib.crc32(text.encode()) % MODELS)


def scale_of(thing: WorldObject) -> float:
    """The object's scale, rounded to a power of ``SCALES``."""
    return float(SCALES ** round(math.log(thing.scale, SCALES)))


def _gap(x: float, y: float, column: int, row: int) -> float:
    """Metres from a point to a tile."""
    dx = max(column * TILE - x, x - (column + 1) * TILE, 0.0)
    dy = max(row * TILE - y, y - (row + 1) * TILE, 0.0)
    return math.hypot(dx, dy)
