"""Voronoi: zones from points of known environment: each place belongs to the nearest point."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from symboslam.sim_bridge.worlds.world import Extent, Zone

REACH = 0.08
"""How far a point speaks for the ground around it, in shares of the extent's longer side."""


def zones_around(
    xy: NDArray[np.float64], environments: Sequence[str], extent: Extent
) -> tuple[Zone, ...]:
    """Zones of labelled points.

    The extent is divided into Voronoi cells, cells of one environment are joined, and ground
    further than ``REACH`` from all points is in no zone.

    Args:
        xy: (n, 2) metres.
        environments: n names.
        extent: what the zones are cut to.
    """
    import shapely

    inside = [i for i, (x, y) in enumerate(xy.tolist()) if extent.has(x, y)]
    if not inside:
        return ()
    box = shapely.box(extent.min_x, extent.min_y, extent.max_x, extent.max_y)
    places, first = np.unique(xy[inside], axis=0, return_index=True)
    points = shapely.points(places)
    cells = (
        shapely.get_parts(shapely.voronoi_polygons(shapely.multipoints(points), extend_to=box))
        if len(points) > 1
        else np.array([box])
    )
    cell, point = shapely.STRtree(points).query(cells, predicate="covers")
    near = shapely.buffer(
        shapely.multipoints(points), REACH * max(extent.width, extent.height), quad_segs=4
    )
    names = np.array([environments[inside[i]] for i in first])
    zones = []
    for name in sorted(set(names.tolist())):
        whole = shapely.union_all(cells[cell[names[point] == name]], grid_size=0.01)
        part = shapely.set_precision(whole.intersection(near).intersection(box), 0.01)
        for polygon in shapely.get_parts(part):
            if polygon.geom_type == "Polygon" and polygon.area > 0.01:
                zones.append(zone_of(name, polygon))
    return tuple(zones)


def zone_of(environment: str, polygon: object) -> Zone:
    """The zone of a shapely polygon."""
    import shapely

    assert isinstance(polygon, shapely.Polygon)
    rings = [polygon.exterior, *polygon.interiors]
    told = tuple(tuple((float(p[0]), float(p[1])) for p in ring.coords) for ring in rings)
    return Zone(environment, told)
