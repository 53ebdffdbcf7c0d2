"""Evidence as a density: what landmarks in and around a cell say of it, and what silence says.

The field F_e(p), in landmarks per hectare, is the sum over all landmarks of
``w_x(e) * G_x(p - x)`` plus the evidence of unmarked ground; a cell's evidence is the mean of F_e
over the cell. ``w_x(e) = SP(e, x) I(x) f_x (1 - dissimilarity * D_x(e))`` where D_x(e) is the share
of the evidence close by that points elsewhere; G_x is a Gaussian as wide as the site that x stands
for. docs/evidence.md tells why.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine._base import Contributions, Evidence, normalised
from symboslam.engine.grid import Cells, Grid
from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.settings import Settings

if TYPE_CHECKING:
    from scipy.sparse import csr_array

Floats = NDArray[np.float64]
HECTARE = 10_000.0
REACH = 3.5
"""Standard deviations after which a kernel is cut off (it holds 99.95 % of a landmark by then)."""
CLOSE = 1.5
"""Neighbours within this many bandwidths can contradict a landmark."""
CROWDING_SHARE = 0.1
ABSENCE_LEAST, ABSENCE_MOST = 0.05, 0.6
"""Evidence of unmarked ground: this share of the map's mean crowding, between these bounds."""
BLOCK = 100_000
"""Landmarks that are spread over the cells at a time."""


class FieldEvidence(Evidence):
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
    ) -> None:
        self._xy, self._grid, self._settings = landmarks.xy, grid, settings
        self.bandwidth = bandwidth
        width = np.maximum(site, bandwidth)
        self._kernels = [(float(w), np.flatnonzero(width == w)) for w in np.unique(width)]
        loss = settings.dissimilarity * weight * dissimilarity(self._xy, weight, CLOSE * bandwidth)
        size = (width / bandwidth)[:, None] ** 2
        self._plain, self._loss = weight * size, loss * size
        finest = self._spread(self._plain - self._loss)
        self.absence = crowding_share(finest) if settings.absence is None else settings.absence
        self._ground = self.absence * absence
        self._finest = finest + self._ground
        self._inside = np.zeros((grid.cells, grid.cells), np.int64)
        np.add.at(self._inside, grid.finest_of(landmarks.x, landmarks.y), 1)

    def _masses(self, positions: Floats, axis: int, sigma: float) -> csr_array:
        """(n, cells) how much of each landmark's kernel lies in each column (row) of cells."""
        from scipy.sparse import csr_array
        from scipy.special import ndtr

        origin, step, cells = self._grid.box[axis], self._grid.step[axis], self._grid.cells
        first = np.floor((positions - REACH * sigma - origin) / step).astype(np.int64)
        width = math.ceil(2 * REACH * sigma / step) + 1
        first = np.clip(first, 0, max(cells - width, 0))
        width = min(width, cells)
        edges = origin + (first[:, None] + np.arange(width + 1)) * step
        mass = np.diff(ndtr((edges - positions[:, None]) / sigma), axis=1)
        index = (first[:, None] + np.arange(width)).ravel()
        starts = np.arange(len(positions) + 1) * width
        return csr_array((mass.ravel(), index, starts), shape=(len(positions), cells))

    def _spread(self, weight: Floats) -> Floats:
        """(cells, cells, K) the mean of the field over each finest cell, without the ground."""
        from scipy.sparse import diags_array

        cells, width, height = self._grid.cells, *self._grid.step
        field = np.zeros((cells, cells, weight.shape[1]))
        used = np.flatnonzero(weight.any(0))
        for sigma, chosen in self._kernels:
            for start in range(0, len(chosen), BLOCK):
                part = chosen[start : start + BLOCK]
                columns = self._masses(self._xy[part, 0], 0, sigma)
                rows = self._masses(self._xy[part, 1], 1, sigma).T.tocsr()
                for k in used:
                    field[:, :, k] += (rows @ diags_array(weight[part, k]) @ columns).toarray()
        return field * (HECTARE / (width * height))

    def of(self, cells: Cells) -> Floats:
        """(m, K) mean of the field over each cell, per hectare."""
        if not len(cells):
            return np.zeros((0, self._finest.shape[2]))
        depth = int(cells.depth[0])
        span = int(self._grid.span(depth))
        sums = self._grid.coarsen(self._finest, depth)[cells.row, cells.column]
        return np.asarray(sums, np.float64) / span**2

    def settled(self, cells: Cells, evidence: Floats) -> NDArray[np.bool_]:
        """Where all finest cells inside agree, or the largest P reaches the threshold."""
        depth = int(cells.depth[0])
        best = self._finest.argmax(2)
        votes = np.stack([best == k for k in range(self._finest.shape[2])], 2)
        agree = self._grid.coarsen(votes, depth).max(2) == int(self._grid.span(depth)) ** 2
        bare = self._grid.coarsen(self._inside, depth) == 0
        certain = normalised(evidence).max(1, initial=0) >= self._settings.threshold
        return np.asarray((agree & bare)[cells.row, cells.column] | certain)

    def _coverage(self, cells: Cells) -> csr_array:
        """(m, n) share of each landmark's kernel in each cell, per hectare of the cell."""
        from scipy.sparse import csr_array, diags_array

        side, span = self._grid.cells, np.asarray(self._grid.span(cells.depth))

        def members(index: NDArray[np.int64]) -> csr_array:
            """(m, side) 1 for the columns (rows) of finest cells inside each cell."""
            starts = np.concatenate([[0], np.cumsum(span)])
            within = np.arange(starts[-1]) - np.repeat(starts[:-1], span)
            return csr_array(
                (np.ones(starts[-1]), np.repeat(index * span, span) + within, starts),
                shape=(len(cells), side),
            )

        rows, columns = members(cells.row), members(cells.column)
        width, height = self._grid.step
        total = csr_array((len(cells), len(self._xy)))
        for sigma, chosen in self._kernels:
            north = rows @ self._masses(self._xy[chosen, 1], 1, sigma).T
            east = columns @ self._masses(self._xy[chosen, 0], 0, sigma).T
            both = north.multiply(east).tocsr()
            total = total + csr_array(
                (both.data, chosen[both.indices], both.indptr), shape=total.shape
            )
        area = width * height * span**2
        return diags_array(HECTARE / area) @ total

    def contributions(self, cells: Cells) -> Iterator[Contributions]:
        """Each landmark's weight times its kernel over the cell, less what neighbours deny."""
        for start in range(0, len(cells), 500):
            part = cells.take(np.arange(start, min(start + 500, len(cells))))
            coverage = self._coverage(part)
            for i in range(len(part)):
                row = slice(coverage.indptr[i], coverage.indptr[i + 1])
                landmark = coverage.indices[row].astype(np.int64)
                share = coverage.data[row][:, None]
                yield Contributions(
                    landmark,
                    share * self._plain[landmark],
                    -share * self._loss[landmark],
                    self._ground,
                )


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
