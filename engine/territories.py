"""Territories: the ground that each fragment stands for, as polygons that never overlap.

A piece of ground belongs to the fragment of the landmark nearest to it (Voronoi), if that is
within reach; else to nobody. So territories have no ground in common, and each holds its own
landmarks.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine.landmarks import Box

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
CORNERS = 6
"""Corners in a quarter of the circle of a landmark's reach."""
FINE = 1e-6
"""Step, in reaches, to which pieces of ground are rounded before they are joined."""


def territories(
    xy: Floats, fragment: Ints, reach: float, box: Box, surveyed: BaseGeometry | None
) -> NDArray[Any]:
    """(m,) polygons of m fragments, or several as one each.

    Args:
        xy: (n, 2) distinct positions in metres.
        fragment: (n,) number of the fragment of each; all from 0 on occur.
        reach: in metres.
        box: area of the map.
        surveyed: the area that was looked at; None means all of the box.
    """
    order = np.argsort(fragment, kind="stable")
    starts = np.flatnonzero(np.diff(fragment[order], prepend=-1))
    cells, points = nearest_ground(xy, box)[order], shapely.points(xy[order])
    looked_at = shapely.box(*box)
    if surveyed is not None:
        looked_at = shapely.intersection(looked_at, surveyed)
    shapely.prepare(looked_at)
    far = ~_within(cells, xy[order], reach)
    near = shapely.buffer(points[far], reach, quad_segs=CORNERS)
    cells[far] = shapely.intersection(cells[far], near)
    ground = np.empty(len(starts), object)
    stop = [*starts[1:].tolist(), len(xy)]
    for i, (first, last) in enumerate(zip(starts.tolist(), stop, strict=True)):
        mine, edge = cells[first:last], far[first:last]
        inner = shapely.coverage_union_all(mine[~edge])
        ground[i] = shapely.union_all([inner, *mine[edge]], grid_size=FINE * reach)
    cut = ~shapely.contains_properly(looked_at, ground)
    ground[cut] = shapely.intersection(ground[cut], looked_at)
    return np.array([_polygonal(g) for g in ground], object)


def _within(cells: NDArray[Any], xy: Floats, reach: float) -> NDArray[np.bool_]:
    """(n,) which cells lie wholly within reach of their positions."""
    corner, cell = shapely.get_coordinates(cells, return_index=True)
    distance = np.hypot(*(corner - xy[cell]).T)
    farthest = np.maximum.reduceat(distance, np.flatnonzero(np.diff(cell, prepend=-1)))
    return np.asarray(farthest <= reach)


def rest_of(box: Box, ground: NDArray[Any]) -> Any:
    """The ground of a box that is nobody's; empty if there is none worth speaking of."""
    whole = shapely.box(*box)
    rest = _polygonal(shapely.difference(whole, shapely.union_all(ground)))
    return rest if shapely.area(rest) > FINE * shapely.area(whole) else shapely.Polygon()


def nearest_ground(xy: Floats, box: Box) -> NDArray[Any]:
    """(n,) the ground nearest to each of distinct positions, out to beyond a box."""
    frame = shapely.buffer(shapely.box(*box), max(box[2] - box[0], box[3] - box[1], 1.0))
    if len(xy) == 1:
        return np.array([frame], object)
    cells = shapely.voronoi_polygons(shapely.multipoints(xy), extend_to=frame, ordered=True)
    return np.asarray(shapely.get_parts(cells))


def _polygonal(geometry: Any) -> Any:
    """The parts that have an area; without any, an empty polygon."""
    parts = shapely.get_parts(geometry)
    parts = parts[shapely.get_type_id(parts) == shapely.GeometryType.POLYGON]
    if len(parts) == 1:
        return parts[0]
    return shapely.multipolygons(parts) if len(parts) else shapely.Polygon()
