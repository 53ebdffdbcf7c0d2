"""Lanes: an area parted among robots into balanced blocks, each block into parallel lanes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.optimize import linear_sum_assignment

from symboslam.sim_bridge.search.area import Area, Extent

OVERLAP = 0.015
"""Share of the sensor's width by which neighbouring lanes overlap at least."""
Place = tuple[float, float]


@dataclass(frozen=True)
class Lane:
    """A straight drive from one place to another, metres."""

    start: Place
    end: Place

    @property
    def length(self) -> float:
        """Metres."""
        return math.dist(self.start, self.end)

    def at(self, way: float) -> Place:
        """The place so many metres from its start, within the lane."""
        share = min(max(way / self.length, 0.0), 1.0) if self.length else 0.0
        (ax, ay), (bx, by) = self.start, self.end
        return ax + share * (bx - ax), ay + share * (by - ay)

    def way_of(self, x: float, y: float) -> float:
        """Metres from its start to the point of its line that is nearest to a place."""
        (ax, ay), (bx, by) = self.start, self.end
        length = self.length
        return ((x - ax) * (bx - ax) + (y - ay) * (by - ay)) / length if length else 0.0

    def part(self, first: float, last: float) -> Lane:
        """From one number of metres to another."""
        return Lane(self.at(first), self.at(last))

    def turned(self) -> Lane:
        """The other way round."""
        return Lane(self.end, self.start)


Lanes = tuple[Lane, ...]


def lanes_of(block: Extent, area: Area, along_x: bool) -> Lanes:
    """Lanes that cover a block, one after the other, from its south-west corner.

    They are as far apart as the sensor's width allows and end where it covers the corners.
    """
    min_x, min_y, max_x, max_y = block
    if not along_x:
        flipped = lanes_of((min_y, min_x, max_y, max_x), area, True)
        return tuple(Lane(lane.start[::-1], lane.end[::-1]) for lane in flipped)
    count = max(1, math.ceil((max_y - min_y) / (area.sensor_width * (1 - OVERLAP)) - 1e-9))
    step = (max_y - min_y) / count
    inset = 0.0
    if area.fov >= 2 * math.pi - 1e-9:
        corner = math.sqrt(max(area.reach**2 - (step / 2) ** 2, 0.0))
        inset = max(corner - area.speed / 2, 0.0)  # robots turn a little before the end
    inset = min(inset, (max_x - min_x) / 2)
    made = []
    for number in range(count):
        y = min_y + (number + 0.5) * step
        lane = Lane((min_x + inset, y), (max_x - inset, y))
        made.append(lane.turned() if number % 2 else lane)
    return tuple(made)


def path_length(lanes: Lanes, start: Place | None = None) -> float:
    """Metres of the lanes and the ways between them, from a start if there is one."""
    places = [*([start] if start else []), *[p for lane in lanes for p in (lane.start, lane.end)]]
    return sum(math.dist(a, b) for a, b in pairwise(places))


def partitions(extent: Extent, count: int) -> Iterator[list[Extent]]:
    """Ways to part a rectangle into blocks of equal size: rows of blocks, or columns of them."""
    min_x, min_y, max_x, max_y = extent
    for bands in range(1, count + 1):
        sizes = [count // bands + (band < count % bands) for band in range(bands)]
        rows, columns = [], []
        done = 0
        for size in sizes:
            low, high = done / count, (done + size) / count
            done += size
            south, north = (min_y + share * (max_y - min_y) for share in (low, high))
            west, east = (min_x + share * (max_x - min_x) for share in (low, high))
            for cell in range(size):
                a, b = cell / size, (cell + 1) / size
                rows.append(
                    (min_x + a * (max_x - min_x), south, min_x + b * (max_x - min_x), north)
                )
                columns.append(
                    (west, min_y + a * (max_y - min_y), east, min_y + b * (max_y - min_y))
                )
        yield rows
        yield columns


def _variants(lanes: Lanes) -> tuple[Lanes, ...]:
    """The same lanes begun at each of the block's four corners."""
    turned = tuple(lane.turned() for lane in lanes)
    return lanes, turned, lanes[::-1], turned[::-1]


def plan(area: Area, places: list[Place]) -> list[Lanes]:
    """Lanes for each robot: the partition and the corners by which the last is done soonest.

    Args:
        area: what is to be covered.
        places: where the robots are, at least one.
    """
    best: list[Lanes] = []
    shortest = math.inf
    for blocks in partitions(area.extent, len(places)):
        cost = np.empty((len(places), len(blocks)))
        chosen: dict[tuple[int, int], Lanes] = {}
        for j, block in enumerate(blocks):
            ways = [v for along in (True, False) for v in _variants(lanes_of(block, area, along))]
            lengths = [path_length(way) for way in ways]
            for i, place in enumerate(places):
                first = [math.dist(place, way[0].start) for way in ways]
                totals = np.add(lengths, first)
                k = int(np.argmin(totals))
                cost[i, j], chosen[i, j] = totals[k], ways[k]
        rows, columns = linear_sum_assignment((cost / max(cost.max(), 1.0)) ** 8)  # the last counts
        longest = float(cost[rows, columns].max())
        if longest < shortest - 1e-6:
            shortest = longest
            best = [chosen[i, j] for i, j in zip(rows.tolist(), columns.tolist(), strict=True)]
    return best
