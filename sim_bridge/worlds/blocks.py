"""Blocks: finds free places in one block, off the streets and off what stands there already."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from symboslam.sim_bridge.worlds.habits import Habit
from symboslam.sim_bridge.worlds.streets import Floats

Pose = tuple[float, float, float]

_GAP = 0.6  # metres between an object and a street or the border of the world
_APART = 0.4  # metres between objects
_SETBACK = (1.0, 7.0)
_NEAR_M = 5.0


class Block:
    """A block with what stands in it.

    Args:
        corners: (4, 2) counterclockwise.
        widths: (4,) widths of the streets along the edges that begin at them; 0 = none.
    """

    def __init__(self, corners: Floats, widths: Floats) -> None:
        self.corners, self.widths = corners, widths
        edge = np.roll(corners, -1, 0) - corners
        self.length = np.hypot(edge[:, 0], edge[:, 1])
        self.along = edge / self.length[:, None]
        self.inward = np.stack([-self.along[:, 1], self.along[:, 0]], -1)
        self.margin = widths / 2 + _GAP
        self.kinds: list[str] = []
        self._places = np.empty((0, 3))  # x, y, radius

    def find_place(
        self,
        habit: Habit,
        radius: float,
        near: tuple[str, ...],
        aligned: bool,
        rng: np.random.Generator,
        tries: int = 24,
    ) -> Pose | None:
        """A free x, y and heading, or None if none was found.

        Args:
            habit: how the class stands.
            radius: half the diagonal of its footprint, in metres.
            near: classes that it likes to be near.
            aligned: whether it is turned as the block is, where the habit leaves it open.
            rng: of the world.
            tries: places that are tried.
        """
        streets = np.flatnonzero(self.widths > 0)
        if habit != "ground" and not len(streets):
            habit = "ground"
        for _ in range(tries):
            if habit == "ground":
                x, y = self._on_ground(radius, near, rng)
                turn = self._direction(0) + math.pi / 2 * int(rng.integers(4))
                heading = turn if aligned else float(rng.uniform(0, 2 * math.pi))
            elif habit == "corner":
                x, y, heading = self._at_corner(radius, streets, rng)
            else:
                x, y, heading = self._at_street(habit, radius, streets, rng)
            if self._is_free(x, y, radius):
                return x, y, heading % (2 * math.pi)
        return None

    def add(self, kind: str, x: float, y: float, radius: float) -> None:
        """Note that something stands here now."""
        self.kinds.append(kind)
        self._places = np.vstack([self._places, (x, y, radius)])

    def _direction(self, edge: int) -> float:
        return math.atan2(self.along[edge, 1], self.along[edge, 0])

    def _is_free(self, x: float, y: float, radius: float) -> bool:
        inside = ((np.array([x, y]) - self.corners) * self.inward).sum(1)
        if (inside < self.margin + radius).any():
            return False
        gaps = np.hypot(self._places[:, 0] - x, self._places[:, 1] - y) - self._places[:, 2]
        return bool((gaps > radius + _APART).all())

    def _at_street(
        self, habit: Habit, radius: float, streets: NDArray[np.intp], rng: np.random.Generator
    ) -> Pose:
        """Beside a street, turned along it."""
        share = self.length[streets] / self.length[streets].sum()
        edge = int(rng.choice(streets, p=share))
        back = rng.uniform(*_SETBACK) if habit == "front" else rng.uniform(0.05, 0.8)
        place = self.corners[edge] + self.along[edge] * self.length[edge] * rng.uniform(0.04, 0.96)
        place = place + self.inward[edge] * (self.margin[edge] + radius + back)
        return float(place[0]), float(place[1]), self._direction(edge)

    def _at_corner(
        self, radius: float, streets: NDArray[np.intp], rng: np.random.Generator
    ) -> Pose:
        """Beside the crossing at the beginning of a street's edge."""
        edge = int(rng.choice(streets))
        before = (edge - 1) % 4
        off = [self.margin[k] + radius + rng.uniform(0.1, 1.2) for k in (before, edge)]
        normals = self.inward[[before, edge]]
        place = self.corners[edge] + np.linalg.solve(normals, np.array(off))
        return float(place[0]), float(place[1]), self._direction(edge)

    def _on_ground(
        self, radius: float, near: tuple[str, ...], rng: np.random.Generator
    ) -> tuple[float, float]:
        """Anywhere, or near something that it likes."""
        hosts = [i for i, kind in enumerate(self.kinds) if kind in near]
        if hosts and rng.random() < 0.6:
            x, y, reach = self._places[hosts[int(rng.integers(len(hosts)))]]
            turn = rng.uniform(0, 2 * math.pi)
            far = reach + radius + _APART + rng.exponential(_NEAR_M)
            return float(x + far * math.cos(turn)), float(y + far * math.sin(turn))
        u, v = rng.random(2)
        a, b, c, d = self.corners
        place = (1 - u) * (1 - v) * a + u * (1 - v) * b + u * v * c + (1 - u) * v * d
        return float(place[0]), float(place[1])
