"""Truth: a world's zones and its objects as GeoJSON in local metres."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from symboslam.sim_bridge.worlds.world import World


def zones_geojson(world: World) -> dict[str, Any]:
    """The zones as a truth for ``symboslam evaluate``: polygons with ``environment``, ``area_m2``.

    Coordinates are metres (``crs_units`` is ``m``); ``bbox`` is the extent.
    """
    features = [
        {
            "type": "Feature",
            "geometry": {"type": "Polygon", "coordinates": [list(map(list, r)) for r in z.rings]},
            "properties": {"environment": z.environment, "area_m2": round(z.area_m2, 1)},
        }
        for z in world.zones
    ]
    return _collection(world, features)


def landmarks_geojson(world: World) -> dict[str, Any]:
    """The objects as landmarks for ``symboslam classify``: points with ``class`` and ``id``."""
    features = [
        {
            "type": "Feature",
            "geometry": {"type": "Point", "coordinates": [o.x, o.y]},
            "properties": {"class": o.kind, "id": o.id},
        }
        for o in world.objects
    ]
    return _collection(world, features)


def write_geojson(document: dict[str, Any], target: str | Path) -> None:
    """Write a FeatureCollection, one feature a line.

    Raises:
        OutputError: it cannot be written; what was there before is kept.
    """
    from symboslam.engine.writers.atomic import atomic_file

    head = {name: value for name, value in document.items() if name != "features"}
    lines = ",\n".join(json.dumps(f, ensure_ascii=False) for f in document["features"])
    text = json.dumps(head, ensure_ascii=False)[:-1] + ', "features": [\n' + lines + "\n]}\n"
    with atomic_file(target) as stream:
        stream.write(text.encode())


def _collection(world: World, features: list[dict[str, Any]]) -> dict[str, Any]:
    e = world.extent
    found: dict[str, Any] = {
        "type": "FeatureCollection",
        "crs_units": "m",
        "bbox": [e.min_x, e.min_y, e.max_x, e.max_y],
    }
    if world.attribution:
        found["attribution"] = world.attribution
    return found | {"features": features}
