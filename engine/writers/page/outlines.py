"""Outlines: polygons as short lists of integers, and neighbouring segments joined to regions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Integers = NDArray[np.int64]
NAMED = 60
"""Regions that get their name written on the map, the largest first."""
JOINED = 60_000
"""A map of more segments than this is drawn without regions: its borders are a blur anyway."""


@dataclass(frozen=True)
class Quantiser:
    """Metres <-> integers.

    Attributes:
        unit: metres of one step.
        origin: (x, y) in metres of the integer (0, 0).
    """

    unit: float
    origin: tuple[float, float]

    @classmethod
    def for_bounds(cls, bounds: tuple[float, float, float, float]) -> Quantiser:
        """0.1 m for an area of over a kilometre, finer for smaller ones (at most 10000 steps)."""
        west, south, east, north = bounds
        extent = max(east - west, north - south)
        unit = 0.1
        while extent / unit < 10_000 and unit > 1e-4:
            unit /= 10
        return cls(round(unit, 5), (west, south))

    def points(self, xy: NDArray[np.float64]) -> Integers:
        """(n, 2) metres -> (n, 2) integers."""
        steps: Integers = np.rint((xy - np.array(self.origin)) / self.unit).astype(np.int64)
        return steps

    def boxes(self, geometry: NDArray[Any]) -> Integers:
        """(s, 4) west, south, width, height of each polygon; neighbours stay neighbours."""
        import shapely

        if not len(geometry):
            return np.zeros((0, 4), np.int64)
        corners = self.points(shapely.bounds(geometry).reshape(-1, 2)).reshape(-1, 4)
        corners[:, 2:] -= corners[:, :2]
        return corners

    def rings(self, shape: Any) -> list[list[int]]:
        """Outer and inner rings: x, y of the first corner, then the steps to the next ones."""
        import shapely

        rings = []
        for polygon in shapely.get_parts(shape):
            if polygon.geom_type != "Polygon":
                continue
            for ring in (polygon.exterior, *polygon.interiors):
                corners = self.points(shapely.get_coordinates(ring))[:-1]
                if len(corners) > 2:
                    steps = np.diff(corners, axis=0, prepend=np.zeros((1, 2), np.int64))
                    rings.append(steps.ravel().tolist())
        return rings

    def shapes(self, geometry: NDArray[Any]) -> dict[str, list[list[int]]]:
        """Position -> rings, of the polygons that are not upright rectangles."""
        import shapely

        if not len(geometry):
            return {}
        bounds = shapely.bounds(geometry)
        full = (bounds[:, 2] - bounds[:, 0]) * (bounds[:, 3] - bounds[:, 1])
        corners = shapely.get_num_coordinates(geometry)
        upright = (corners == 5) & (np.abs(shapely.area(geometry) - full) <= 1e-6 * full)
        return {str(i): self.rings(geometry[i]) for i in np.flatnonzero(~upright)}


def regions(
    geometry: NDArray[Any], label: NDArray[np.int16], quantiser: Quantiser
) -> dict[str, list[Any]]:
    """Segments of the same environment that touch, joined.

    Returns:
        ``rings``: the borders of all regions; ``names``: [environment, x, y, radius] of the
        largest circle in each of the largest regions, where its name can stand.
    """
    import shapely

    if len(label) > JOINED:
        return {"rings": [], "names": []}
    rings: list[list[int]] = []
    parts: list[tuple[float, int, Any]] = []
    for k in np.unique(label[label >= 0]):
        joined = shapely.simplify(
            shapely.union_all(geometry[label == k], grid_size=quantiser.unit), 0
        )
        rings += quantiser.rings(joined)
        parts += [(p.area, int(k), p) for p in shapely.get_parts(joined) if p.area > 0]
    parts.sort(key=lambda part: -part[0])
    least = parts[0][0] / 200 if parts else 0.0
    named = [part for part in parts[:NAMED] if part[0] >= least]
    return {"rings": rings, "names": [_place(k, shape, quantiser) for _, k, shape in named]}


def _place(k: int, shape: Any, quantiser: Quantiser) -> list[int]:
    """Where a region's name stands: the middle of its largest inscribed circle."""
    import shapely

    tolerance = np.sqrt(shape.area) / 50
    middle, border = shapely.get_coordinates(shapely.maximum_inscribed_circle(shape, tolerance))
    x, y = quantiser.points(middle[None])[0]
    return [k, int(x), int(y), int(np.hypot(*(border - middle)) / quantiser.unit)]
