"""Area: what is to be searched, and with what: extent, obstacles, starts, speed and sensor."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from symboslam.errors import GeometryError, InputError

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]
Extent = tuple[float, float, float, float]


@dataclass(frozen=True)
class Circle:
    """A round obstacle: centre and radius in metres."""

    x: float
    y: float
    radius: float

    def outline(self, step: float) -> Floats:
        """(k, 2) points of the border, at most ``step`` metres apart."""
        count = max(8, math.ceil(2 * math.pi * self.radius / step))
        turn = np.arange(count) * (2 * math.pi / count)
        return np.column_stack(
            [self.x + self.radius * np.cos(turn), self.y + self.radius * np.sin(turn)]
        )

    def has(self, xy: Floats) -> Bools:
        """(k,) which of (k, 2) points lie in it."""
        inside: Bools = np.hypot(xy[:, 0] - self.x, xy[:, 1] - self.y) < self.radius
        return inside


@dataclass(frozen=True)
class Box:
    """An obstacle along the axes: min x, min y, max x, max y in metres."""

    min_x: float
    min_y: float
    max_x: float
    max_y: float

    def outline(self, step: float) -> Floats:
        """(k, 2) points of the border, at most ``step`` metres apart."""
        corners = np.array(
            [
                (self.min_x, self.min_y),
                (self.max_x, self.min_y),
                (self.max_x, self.max_y),
                (self.min_x, self.max_y),
            ]
        )
        sides = []
        for a, b in zip(corners, np.roll(corners, -1, 0), strict=True):
            count = max(1, math.ceil(float(np.hypot(*(b - a))) / step))
            sides.append(a + (b - a) * (np.arange(count) / count)[:, None])
        return np.vstack(sides)

    def has(self, xy: Floats) -> Bools:
        """(k,) which of (k, 2) points lie in it."""
        x, y = xy[:, 0], xy[:, 1]
        inside: Bools = (x > self.min_x) & (x < self.max_x) & (y > self.min_y) & (y < self.max_y)
        return inside


def boxes_of(
    occupied: Bools, cell: float, origin: tuple[float, float] = (0.0, 0.0)
) -> tuple[Box, ...]:
    """Obstacles of an occupancy grid, one box for each run of cells of a row.

    Args:
        occupied: (rows, columns) where something stands; row 0 is the southernmost.
        cell: side of a cell, metres.
        origin: the south-west corner.
    """
    found = []
    for row, line in enumerate(np.asarray(occupied, bool)):
        edges = np.flatnonzero(np.diff(np.r_[0, line.astype(np.int8), 0]))
        y = origin[1] + row * cell
        for first, last in edges.reshape(-1, 2).tolist():
            found.append(Box(origin[0] + first * cell, y, origin[0] + last * cell, y + cell))
    return tuple(found)


@dataclass(frozen=True)
class Area:
    """What is to be searched, and with what.

    Attributes:
        extent: min x, min y, max x, max y in metres.
        starts: of each robot: x, y in metres and heading in radians.
        speed: of the robots at most, metres a second.
        reach: of their sensor, metres.
        fov: its field of view around the heading, radians; a full circle sees all around.
        obstacles: that are known beforehand.

    Raises:
        GeometryError: the extent is empty or not finite, or a start lies outside.
        InputError: no robots, or a speed, reach or field of view that is not positive.
    """

    extent: Extent
    starts: tuple[tuple[float, float, float], ...]
    speed: float = 10.0
    reach: float = 60.0
    fov: float = 2 * math.pi
    obstacles: tuple[Circle | Box, ...] = ()

    def __post_init__(self) -> None:
        min_x, min_y, max_x, max_y = self.extent
        if not all(map(math.isfinite, self.extent)) or max_x <= min_x or max_y <= min_y:
            raise GeometryError(
                f"extent {self.extent}: give min x < max x, min y < max y in metres"
            )
        if not self.starts:
            raise InputError("no robots: give the start of one at least")
        for name in ("speed", "reach", "fov"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise InputError(f"{name} {value}: give a number above 0")
        if self.fov > 2 * math.pi + 1e-9:
            raise InputError(f"fov {self.fov}: give radians, at most a full circle (6.283)")
        for number, (x, y, heading) in enumerate(self.starts):
            if not (min_x <= x <= max_x and min_y <= y <= max_y and math.isfinite(heading)):
                raise GeometryError(
                    f"start {number} at ({x}, {y}, {heading}) is not in {self.extent}"
                )

    @property
    def robots(self) -> int:
        """How many."""
        return len(self.starts)

    @property
    def width(self) -> float:
        """From west to east, metres."""
        return self.extent[2] - self.extent[0]

    @property
    def height(self) -> float:
        """From south to north, metres."""
        return self.extent[3] - self.extent[1]

    @property
    def size(self) -> float:
        """Square metres, obstacles included."""
        return self.width * self.height

    @property
    def diagonal(self) -> float:
        """Metres."""
        return math.hypot(self.width, self.height)

    @property
    def middle(self) -> tuple[float, float]:
        """Of the extent."""
        return (self.extent[0] + self.extent[2]) / 2, (self.extent[1] + self.extent[3]) / 2

    @property
    def sensor_width(self) -> float:
        """Width of the strip that a robot sees on a straight drive, metres."""
        return 2 * self.reach * math.sin(min(self.fov, math.pi) / 2)

    @cached_property
    def outlines(self) -> Floats:
        """(k, 2) points on the borders of the obstacles, a tenth of the reach apart at most."""
        step = min(self.reach / 10, 5.0)
        return np.vstack([np.empty((0, 2)), *[shape.outline(step) for shape in self.obstacles]])

    def inside(self, xy: Floats) -> Bools:
        """(k,) which of (k, 2) points lie in the extent, its border included."""
        low, high = np.array(self.extent[:2]), np.array(self.extent[2:])
        within: Bools = np.all((xy >= low) & (xy <= high), axis=1)
        return within

    def blocked(self, xy: Floats) -> Bools:
        """(k,) which of (k, 2) points lie in an obstacle."""
        found = [shape.has(xy) for shape in self.obstacles]
        any_of: Bools = np.any([np.zeros(len(xy), bool), *found], axis=0)
        return any_of

    def clipped(self, x: float, y: float) -> tuple[float, float]:
        """The nearest point of the extent."""
        min_x, min_y, max_x, max_y = self.extent
        return min(max(x, min_x), max_x), min(max(y, min_y), max_y)

    def unmapped(self) -> Area:
        """The same without obstacles: what a team knows that has no map."""
        return replace(self, obstacles=())
