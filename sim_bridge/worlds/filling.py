"""Filling: draws classes for each zone from real frequencies and finds a place for each object."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass

import numpy as np

from symboslam.errors import WorldError
from symboslam.sim_bridge.worlds.blocks import Block
from symboslam.sim_bridge.worlds.frequencies import Frequencies
from symboslam.sim_bridge.worlds.habits import ALIGNED, HABITS, NEAR, SIGNS
from symboslam.sim_bridge.worlds.sizes import SIZES
from symboslam.sim_bridge.worlds.streets import Network, Streets
from symboslam.sim_bridge.worlds.world import WorldObject
from symboslam.sim_bridge.worlds.zoning import Zoning

Cell = tuple[int, int]

_CLUMPS = 2.5  # shape of the gamma distribution by which blocks of a zone differ; small = clumpy
_REDRAWS = 60


@dataclass(frozen=True)
class _Stand:
    kind: str
    x: float
    y: float
    heading: float
    scale: float


class Filler:
    """Fills the blocks of a world.

    Args:
        streets: the grid.
        network: which edges carry streets.
        zoning: types of the blocks.
        frequencies: real counts.
        rng: of the world.
    """

    def __init__(
        self,
        streets: Streets,
        network: Network,
        zoning: Zoning,
        frequencies: Frequencies,
        rng: np.random.Generator,
    ) -> None:
        columns, rows = streets.shape
        self.zoning, self.frequencies, self.rng = zoning, frequencies, rng
        self.areas = streets.areas
        self.blocks = {
            (i, j): Block(streets.corners(i, j), network.around(i, j))
            for i in range(columns)
            for j in range(rows)
        }
        weight = self.areas * rng.gamma(_CLUMPS, size=streets.shape)
        self.weight = {cell: float(weight[cell]) for cell in self.blocks}
        self.found: list[_Stand] = []

    def fill(self, features: int) -> tuple[WorldObject, ...]:
        """Exactly so many objects, sites first, then by zone; ordered by position.

        Raises:
            WorldError: there is no room for them.
        """
        for number, patch in enumerate(self.zoning.plan.patches):
            cells = [c for c in self.blocks if self.zoning.patch[c] == number]
            for kind, wanted in patch.objects.items():
                for _ in range(wanted):
                    if not self._place(kind, cells):
                        raise self._full()
        cells_of = self._cells_of()
        for environment, number in self._shares(cells_of, features - len(self.found)).items():
            self._fill_zone(environment, number, cells_of[environment])
        return self._objects()

    def _cells_of(self) -> dict[str, list[Cell]]:
        found: dict[str, list[Cell]] = {}
        for cell in self.blocks:
            found.setdefault(self.zoning.environment(*cell), []).append(cell)
        return dict(sorted(found.items()))

    def _shares(self, cells_of: dict[str, list[Cell]], features: int) -> dict[str, int]:
        """Objects of each zone type, by its area and the root of the real density there.

        A world holds a small part of what is really there. By plain proportion open country would
        then be empty; the root keeps the order of the densities and leaves something everywhere.
        """
        weights = [
            sum(float(self.areas[c]) for c in cells)
            * float(np.sqrt(sum(self.frequencies.density(environment).values())))
            for environment, cells in cells_of.items()
        ]
        exact = np.array(weights) / sum(weights) * features
        numbers = np.floor(exact).astype(int)
        for i in np.argsort(-(exact - numbers), kind="stable")[: features - numbers.sum()]:
            numbers[i] += 1
        return dict(zip(cells_of, numbers.tolist(), strict=True))

    def _fill_zone(self, environment: str, number: int, cells: list[Cell]) -> None:
        """Draw classes as real zones of the type have them; the largest are placed first."""
        density = self.frequencies.density(environment)
        names = sorted(density)
        share = np.array([density[name] for name in names])
        share /= share.sum()
        counts = self.rng.multinomial(number, share)
        drawn = [name for name, n in zip(names, counts.tolist(), strict=True) for _ in range(n)]
        drawn.sort(key=lambda name: (-SIZES[name].radius, name))
        for kind in drawn:
            tries = 0
            while not self._place(kind, cells):  # too large for what is left: draw another class
                tries += 1
                if tries > _REDRAWS:
                    raise self._full()
                kind = str(self.rng.choice(names, p=share))

    def _place(self, kind: str, cells: list[Cell]) -> bool:
        """Place an object in one of some blocks; whether there was a place."""
        scale = round(float(self.rng.uniform(0.9, 1.1)), 2)
        radius = SIZES[kind].radius * scale
        weights = np.array([self.weight[c] for c in cells])
        habit, near = HABITS.get(kind, "ground"), NEAR.get(kind, (kind,))
        if kind in NEAR:  # go where its hosts are, if they are anywhere
            hosted = np.array([any(k in near for k in self.blocks[c].kinds) for c in cells])
            weights = np.where(hosted, weights, 0.02 * weights)
        order = self.rng.choice(
            len(cells), size=min(len(cells), 12), replace=False, p=weights / weights.sum()
        )
        for index in order.tolist():
            block = self.blocks[cells[index]]
            pose = block.find_place(habit, radius, near, kind in ALIGNED, self.rng)
            if pose is not None:
                x, y, heading = round(pose[0], 2), round(pose[1], 2), round(pose[2], 4)
                block.add(kind, x, y, radius)
                self.found.append(_Stand(kind, x, y, heading, scale))
                return True
        return False

    def _objects(self) -> tuple[WorldObject, ...]:
        numbers: Counter[str] = Counter()
        objects = []
        for stand in sorted(self.found, key=lambda s: (s.x, s.y)):  # the order tells nothing
            numbers[stand.kind] += 1
            texts = SIGNS.get(stand.kind, ())
            name = texts[int(self.rng.integers(len(texts)))] if texts else None
            identity = f"{stand.kind.lower()}-{numbers[stand.kind]}"
            objects.append(
                WorldObject(
                    identity, stand.kind, stand.x, stand.y, 0.0, stand.heading, stand.scale,
                    None, name,
                )
            )  # fmt: skip
        return tuple(objects)

    def _full(self) -> WorldError:
        plan = self.zoning.plan
        problem = f"{plan.features} features do not fit in {plan.area_km2:g} km2: ask for fewer"
        return WorldError(problem, source=plan.name)
