"""Zoning: blocks get a type, patch by patch, each grown from seeds so that it hangs together."""

from __future__ import annotations

import heapq
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.sim_bridge.worlds.plans import Patch, Plan
from symboslam.sim_bridge.worlds.streets import Floats, Streets
from symboslam.sim_bridge.worlds.world import Zone

BASE = -1
"""The patch number of blocks that no patch has taken."""


@dataclass(frozen=True)
class Zoning:
    """Which patch each block belongs to.

    Attributes:
        plan: the area's plan.
        patch: (columns, rows) position in ``plan.patches``, or ``BASE``.
    """

    plan: Plan
    patch: NDArray[np.int64]

    def environment(self, i: int, j: int) -> str:
        """Type of a block."""
        number = int(self.patch[i, j])
        return self.plan.base if number == BASE else self.plan.patches[number].environment

    @property
    def environments(self) -> NDArray[np.str_]:
        """(columns, rows) types of the blocks."""
        columns, rows = self.patch.shape
        return np.array([[self.environment(i, j) for j in range(rows)] for i in range(columns)])


def zone_blocks(streets: Streets, plan: Plan, rng: np.random.Generator) -> Zoning:
    """Give every block a type, close to the shares of the plan; every patch gets a block."""
    patch = np.full(streets.shape, BASE)
    areas, total = streets.areas, float(streets.areas.sum())
    for number, wanted in enumerate(plan.patches):
        seeds = _seeds(streets, wanted, patch == BASE, rng)
        noise = rng.uniform(0.75, 1.25, streets.shape)
        _grow(streets, patch, number, seeds, wanted.share * total, areas, noise)
    return Zoning(plan, patch)


def _seeds(
    streets: Streets, patch: Patch, free: NDArray[np.bool_], rng: np.random.Generator
) -> list[tuple[int, int]]:
    """Blocks to begin at: free ones, where the patch wants them, far from each other."""
    columns, rows = streets.shape
    i, j = np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij")
    depth = np.minimum(np.minimum(i, columns - 1 - i) / columns, np.minimum(j, rows - 1 - j) / rows)
    score = rng.uniform(0, 0.2, streets.shape)
    if patch.where == "centre":
        score += depth * 2
    elif patch.where == "edge":
        score += 0.6 * (depth == 0)
    found: list[tuple[int, int]] = []
    for _ in range(patch.seeds):
        far = np.zeros(streets.shape)
        if found:
            gaps = [np.hypot((i - a) / columns, (j - b) / rows) for a, b in found]
            far = np.minimum(np.min(gaps, axis=0), 0.5)
        open_blocks = np.where(free, score + 1.5 * far, -np.inf)
        for a, b in found:
            open_blocks[a, b] = -np.inf
        if not np.isfinite(open_blocks).any():
            break
        found.append(divmod(int(np.argmax(open_blocks)), rows))
    return found


def _grow(
    streets: Streets,
    patch: NDArray[np.int64],
    number: int,
    seeds: list[tuple[int, int]],
    target: float,
    areas: Floats,
    noise: Floats,
) -> None:
    """Take free blocks around the seeds, nearest first, until the target area is reached."""
    columns, rows = streets.shape
    middles = streets.middles
    queue = [(0.0, a, b, a, b) for a, b in seeds]
    heapq.heapify(queue)
    taken = 0.0
    while queue:
        _, a, b, sa, sb = heapq.heappop(queue)
        if patch[a, b] != BASE:
            continue
        if taken > 0 and taken + 0.5 * areas[a, b] > target:
            break
        patch[a, b] = number
        taken += float(areas[a, b])
        for da, db in ((1, 0), (-1, 0), (0, 1), (0, -1)):
            na, nb = a + da, b + db
            if 0 <= na < columns and 0 <= nb < rows and patch[na, nb] == BASE:
                gap = float(np.hypot(*(middles[na, nb] - middles[sa, sb])) * noise[na, nb])
                heapq.heappush(queue, (gap, na, nb, sa, sb))


def zones_of(streets: Streets, zoning: Zoning) -> tuple[Zone, ...]:
    """Polygons of the types: neighbouring blocks of one type are one zone, streets included."""
    import shapely

    environments = zoning.environments
    columns, rows = streets.shape
    zones = []
    for environment in sorted(set(environments.ravel().tolist())):
        blocks = [
            shapely.Polygon(streets.corners(i, j))
            for i in range(columns)
            for j in range(rows)
            if environments[i, j] == environment
        ]
        for part in shapely.get_parts(shapely.coverage_union_all(blocks)):
            whole = shapely.Polygon(shapely.normalize(part))
            rings = [whole.exterior, *whole.interiors]
            told = tuple(tuple((float(x), float(y)) for x, y in r.coords) for r in rings)
            zones.append(Zone(str(environment), told))
    return tuple(zones)
