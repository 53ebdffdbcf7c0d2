"""Evidence as a density: what landmarks in and around a cell say of it, and what silence says.

The field F_e(p), in landmarks per hectare, is the sum over all landmarks of
``w_x(e) * G_x(p - x)`` plus the evidence of unmarked ground; a cell's evidence is the mean of F_e
over the cell. ``w_x(e) = SP(e, x) I(x) f_x (1 - dissimilarity * D_x(e))`` where D_x(e) is the share
of the evidence close by that points elsewhere; G_x is a Gaussian as wide as the site that x stands
for. docs/evidence.md tells why.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine._base import CellEvidence, Contributions
from symboslam.engine.density import Density
from symboslam.engine.grid import Cells, Grid
from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.settings import Settings

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
HECTARE = 10_000.0
REACH = 3.5
"""Standard deviations after which a kernel is cut off (it holds 99.95 % of a landmark by then)."""
CLOSE = 1.5
"""Neighbours within this many bandwidths can contradict a landmark."""
WIDEST = 3.0
"""A site counts as at most this many times as wide as the bandwidth, whatever that is set to."""
CROWDING_SHARE = 0.1
ABSENCE_LEAST, ABSENCE_MOST = 0.05, 0.6
"""Evidence of unmarked ground: this share of the map's mean crowding, between these bounds."""
BLOCK = 100_000
"""Landmarks that are worked on at a time."""

_erf = np.frompyfunc(math.erf, 1, 1)  # as exact as the C library, and needs no further import


@dataclass(frozen=True)
class Bands:
    """How the kernels of n landmarks lie over the finest columns (or rows) of a grid.

    Attributes:
        first: (n,) first column that a kernel reaches.
        below: (n, b + 1) share of the kernel before column ``first + j``, cut off at both ends.
    """

    first: Ints
    below: Floats

    @classmethod
    def over(cls, positions: Floats, origin: float, step: float, cells: int, sigma: float) -> Bands:
        """The bands of Gaussians at ``positions`` (metres) with standard deviation ``sigma``."""
        first, width = cls.span(positions, origin, step, cells, sigma)
        edges = origin + (first[:, None] + np.arange(width + 1)) * step
        below = _erf((edges - positions[:, None]) / (sigma * math.sqrt(2)))
        return cls(first, np.asarray(below, np.float64) / 2)

    @staticmethod
    def span(
        positions: Floats, origin: float, step: float, cells: int, sigma: float
    ) -> tuple[Ints, int]:
        """(n,) first column that each kernel reaches, and how many columns from there on."""
        width = min(math.ceil(2 * REACH * sigma / step) + 1, cells)
        first = np.floor((positions - REACH * sigma - origin) / step).astype(np.int64)
        return np.clip(first, 0, cells - width), width

    @classmethod
    def joined(cls, parts: list[Bands], order: Ints) -> Bands:
        """Several bands as one, in another order; narrow ones are filled up with nothing."""
        width = max(part.below.shape[1] for part in parts)
        wide = [
            np.pad(part.below, ((0, 0), (0, width - part.below.shape[1])), mode="edge")
            for part in parts
        ]
        first = np.concatenate([part.first for part in parts])
        return cls(first[order], np.concatenate(wide)[order])

    def shares(self) -> Floats:
        """(n, b) share of each kernel in each column of its band."""
        return np.diff(self.below, axis=1)

    def between(self, chosen: Ints, start: int, stop: int) -> Floats:
        """(m,) share of the chosen kernels in columns ``start`` to ``stop`` (not included)."""
        last, first = self.below.shape[1] - 1, self.first[chosen]
        high, low = (np.minimum(np.maximum(edge - first, 0), last) for edge in (stop, start))
        return np.asarray(self.below[chosen, high] - self.below[chosen, low])


@dataclass(frozen=True)
class Kernels:
    """The kernels of some landmarks.

    Attributes:
        landmark: (n,) their positions in the map.
        columns: their bands from west to east.
        rows: their bands from south to north.
    """

    landmark: Ints
    columns: Bands
    rows: Bands

    @classmethod
    def joined(cls, parts: list[Kernels]) -> Kernels:
        """Several as one, sorted by the first column that they reach."""
        landmark = np.concatenate([part.landmark for part in parts])
        order = np.argsort(np.concatenate([p.columns.first for p in parts]), kind="stable")
        columns = Bands.joined([part.columns for part in parts], order)
        return cls(landmark[order], columns, Bands.joined([p.rows for p in parts], order))

    def near(self, start: int, stop: int) -> Ints:
        """Which of them may reach columns ``start`` to ``stop``; they must be sorted."""
        width = self.columns.below.shape[1] - 1
        return np.arange(*np.searchsorted(self.columns.first, [start - width + 1, stop]))


class FieldEvidence(CellEvidence):
    """Evidence density over a grid.

    Args:
        landmarks: the map.
        weight: (n, K) SP(e, x) I(x) f_x of each landmark.
        grid: the nested cells.
        settings: dissimilarity, absence, threshold.
        bandwidth: standard deviation of the kernel in metres.
        site: (n,) radius in metres of the ground that each landmark stands for; where it exceeds
            the bandwidth the kernel is as wide, and as high in the middle, so it says more in all.
        absence: (K,) what ground without landmarks indicates, 0 where nothing.
        denied: (n, K) what `dissimilarity` gives, where that is known already.

    Attributes:
        bandwidth: as given.
        absence: evidence of unmarked ground per hectare, as set or estimated.
        field: (cells, cells, K) what landmarks add to each finest cell, per hectare.
        density: the field and the ground's evidence.
    """

    def __init__(
        self,
        landmarks: LandmarkMap,
        weight: Floats,
        grid: Grid,
        settings: Settings,
        bandwidth: float,
        site: Floats,
        absence: Floats,
        denied: Floats | None = None,
    ) -> None:
        self._landmarks, self._weight, self._settings = landmarks, weight, settings
        self._site, self._silence = site, absence
        self._xy, self._grid = landmarks.xy, grid
        self.bandwidth = bandwidth
        width = np.maximum(site, bandwidth)
        self._kernels = [self._kernels_of(np.flatnonzero(width == w), w) for w in np.unique(width)]
        if denied is None:
            denied = dissimilarity(self._xy, weight, CLOSE * bandwidth)
        loss = settings.dissimilarity * weight * denied
        size = np.minimum(width / bandwidth, WIDEST)[:, None] ** 2
        self._plain, self._loss = weight * size, loss * size
        self.field = self._spread(self._plain - self._loss)
        self.absence = crowding_share(self.field) if settings.absence is None else settings.absence
        self._ground = self.absence * absence
        self.density = Density(
            grid, settings.threshold, self.field + self._ground,
            grid.count(landmarks.x, landmarks.y),
        )  # fmt: skip

    def _kernels_of(self, landmark: Ints, sigma: float) -> Kernels:
        columns, rows = (
            Bands.over(
                self._xy[landmark, axis],
                self._grid.box[axis],
                self._grid.step[axis],
                self._grid.cells,
                float(sigma),
            )
            for axis in (0, 1)
        )
        return Kernels(landmark, columns, rows)

    @cached_property
    def _all_kernels(self) -> Kernels:
        return Kernels.joined(self._kernels)

    def _spread(self, weight: Floats) -> Floats:
        """(cells, cells, K) the mean of the field over each finest cell, without the ground."""
        cells, (width, height) = self._grid.cells, self._grid.step
        field = np.zeros((weight.shape[1], cells * cells))
        used = np.flatnonzero(weight.any(0))
        for kernel in self._kernels:
            east, north = kernel.columns.shares(), kernel.rows.shares()
            across = np.arange(east.shape[1])
            for start in range(0, len(east), BLOCK):
                part = slice(start, start + BLOCK)
                weights = weight[kernel.landmark[part]]
                corner = kernel.rows.first[part] * cells + kernel.columns.first[part]
                for row in range(north.shape[1]):
                    index = (corner[:, None] + (row * cells + across)).ravel()
                    share = east[part] * north[part, row, None]
                    for k in used:
                        amount = (share * weights[:, k, None]).ravel()
                        field[k] += np.bincount(index, amount, cells * cells)
        per_hectare = HECTARE / (width * height)
        return np.moveaxis(field.reshape(-1, cells, cells), 0, 2) * per_hectare

    def of(self, cells: Cells) -> Floats:
        """(m, K) mean of the field over each cell, per hectare."""
        return self.density.of(cells)

    def settled(self, cells: Cells, evidence: Floats) -> NDArray[np.bool_]:
        """Where all finest cells inside agree, or the largest P reaches the threshold."""
        return self.density.settled(cells, evidence)

    def without(self, cells: Cells, landmarks: Sequence[int]) -> Floats:
        """(m, K) P~ if these landmarks were not there; unmarked ground says what it said."""
        keep = np.ones(len(self._xy), bool)
        keep[list(landmarks)] = False
        rest = FieldEvidence(
            self._landmarks.take(keep), self._weight[keep], self._grid,
            replace(self._settings, absence=self.absence), self.bandwidth, self._site[keep],
            self._silence,
        )  # fmt: skip
        return rest.of(cells)

    def contributions(self, cells: Cells) -> Iterator[Contributions]:
        """Each landmark's weight times its kernel over the cell, less what neighbours deny."""
        if not len(self._xy):
            nothing = np.zeros((0, len(self._ground)))
            empty = Contributions(np.zeros(0, np.int64), nothing, nothing, self._ground)
            yield from [empty] * len(cells)
            return
        kernels, (width, height) = self._all_kernels, self._grid.step
        for depth, row, column in zip(
            cells.depth.tolist(), cells.row.tolist(), cells.column.tolist(), strict=True
        ):
            span = int(self._grid.span(depth))
            near = kernels.near(column * span, (column + 1) * span)
            share = kernels.rows.between(near, row * span, (row + 1) * span)
            share *= kernels.columns.between(near, column * span, (column + 1) * span)
            near, share = near[share > 0], share[share > 0]
            share = (share * (HECTARE / (width * height * span**2)))[:, None]
            landmark = kernels.landmark[near]
            own, loss = self._plain[landmark], self._loss[landmark]
            yield Contributions(landmark, share * own, -share * loss, self._ground)

    def of_one(self, cells: Cells, xy: Floats, site: float) -> float:
        """What a landmark of weight 1 would add by itself to one cell, per hectare.

        Args:
            cells: one cell.
            xy: (2,) where the landmark would stand.
            site: radius in metres of the ground that it would stand for.
        """
        grid, span = self._grid, int(self._grid.span(int(cells.depth[0])))
        width, share = max(site, self.bandwidth), 1.0
        for axis, start in ((0, int(cells.column[0]) * span), (1, int(cells.row[0]) * span)):
            bands = Bands.over(
                xy[axis : axis + 1], grid.box[axis], grid.step[axis], grid.cells, width
            )
            share *= float(bands.between(np.zeros(1, np.int64), start, start + span)[0])
        size = min(width / self.bandwidth, WIDEST) ** 2
        return share * size * HECTARE / (grid.step[0] * grid.step[1] * span**2)


def dissimilarity(xy: Floats, weight: Floats, radius: float) -> Floats:
    """D_x(e): share of the evidence of the landmarks around x that points away from e.

    Neighbours y within ``radius`` count by 1 - distance/radius, landmarks at one place together.

    Args:
        xy: (n, 2) metres.
        weight: (n, K) evidence of each landmark.
        radius: in metres.

    Returns:
        (n, K) in [0, 1]; 0 where x has no neighbours.
    """
    n, k = weight.shape
    if n < 2:
        return np.zeros((n, k))
    complex_places, place = np.unique(xy @ (1, 1j), return_inverse=True)
    places = np.column_stack([complex_places.real, complex_places.imag])
    there = np.zeros((len(places), k))
    np.add.at(there, place, weight)
    points = shapely.points(places)
    tree = shapely.STRtree(points)
    around = there.copy()
    for start in range(0, len(places), BLOCK):
        part = points[start : start + BLOCK]
        near, other = tree.query(part, predicate="dwithin", distance=radius)
        apart = near + start != other
        near, other = near[apart], other[apart]
        closeness = 1 - np.hypot(*(places[near + start] - places[other]).T) / radius
        for e in range(k):
            around[start : start + len(part), e] += np.bincount(
                near, closeness * there[other, e], minlength=len(part)
            )
    around = np.maximum(around[place] - weight, 0)  # others only
    total = around.sum(1, keepdims=True)
    zeros = np.zeros((n, k))
    return np.asarray(np.divide(total - around, total, out=zeros, where=total > 1e-12))


def crowding_share(field: Floats) -> float:
    """Evidence of unmarked ground per hectare, from how much the map says where it says anything.

    A tenth of the mean crowding (Lloyd 1967: the density that an average piece of evidence has
    around it), because silence means more where a survey is thorough; two digits, because it is
    an estimate, and so that single landmarks do not move it.

    Args:
        field: (rows, columns, K) evidence per hectare.
    """
    density = field.sum(2)
    total = density.sum()
    crowding = float((density**2).sum() / total) if total > 0 else 0.0
    share = min(max(CROWDING_SHARE * crowding, ABSENCE_LEAST), ABSENCE_MOST)
    return float(f"{share:.2g}")
