"""GeoJSON worlds: landmarks, and beside them zones or labelled points, as a world."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.frame import Frame
from symboslam.errors import WorldError
from symboslam.reasoning.knowledge import Knowledge
from symboslam.sim_bridge.worlds.checks import Notes, checked
from symboslam.sim_bridge.worlds.stand_ins import stand_in
from symboslam.sim_bridge.worlds.starts import with_starts
from symboslam.sim_bridge.worlds.voronoi import zone_of, zones_around
from symboslam.sim_bridge.worlds.world import Extent, World, WorldObject, Zone

TRUTH_FILES = ("zones.geojson", "zones.geojson.gz", "truth_points.geojson")
"""Where zones are looked for beside a landmark file."""


def read_geojson_world(
    landmarks: str | Path, zones: str | Path | None = None
) -> tuple[World, Notes]:
    """A world of landmarks, classes or OpenStreetMap tags, in metres or degrees.

    Args:
        landmarks: the file.
        zones: polygons or points with ``environment``; default: ``zones.geojson`` or
            ``truth_points.geojson`` in the same folder, if there is one.

    Returns:
        The world and notes; features that a robot cannot see are counted there.

    Raises:
        InputError: a file cannot be read or is wrong.
    """
    from symboslam.engine.readers import read_landmarks

    knowledge = Knowledge.load()
    read = read_landmarks(landmarks, knowledge)
    extent = Extent(*(float(v) for v in read.bbox))
    if extent.width <= 0 or extent.height <= 0:
        raise WorldError("its bbox has no area: give it a bbox", source=str(landmarks))
    kinds = [stand_in(feature) for feature in knowledge.features]
    objects, unseen = [], 0
    for row, feature in enumerate(read.feature.tolist()):
        if (kind := kinds[feature]) is None:
            unseen += 1
            continue
        x, y = float(read.x[row]), float(read.y[row])
        objects.append(WorldObject(str(read.id[row]), kind, round(x, 2), round(y, 2)))
    path = Path(landmarks)
    truth = zones or next((p for n in TRUTH_FILES if (p := path.parent / n).exists()), None)
    name = path.parent.name if path.name.startswith("landmarks") else path.name.split(".")[0]
    world = World(name or "world", extent, tuple(objects), attribution=read.report.attribution)
    notes: list[str] = []
    if unseen:
        notes.append(f"{unseen} features of which a robot sees nothing were left out")
    if read.report.unknown:
        total = sum(read.report.unknown.values())
        shown = ", ".join(f"{n} x {what}" for what, n in read.report.unknown.most_common(3))
        notes.append(f"{total} landmarks of no known class were left out: {shown}")
    if truth is None:
        notes.append("no zones beside it: the world has no truth")
    else:
        found, about = _zones(truth, read.frame, extent)
        world = replace(world, zones=found)
        notes += [f"zones of {truth}", *about]
    world, odd = checked(with_starts(world), str(landmarks), strict=False)
    return world, (*notes, *odd)


def _zones(source: str | Path, frame: Frame, extent: Extent) -> tuple[tuple[Zone, ...], list[str]]:
    """Zones of a truth, moved into the landmarks' frame."""
    import shapely

    from symboslam.engine.evaluation.places import read_places

    places = read_places(source, points=True)

    def moved(coordinates: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.column_stack(frame.to_metres(coordinates[:, 0], coordinates[:, 1]))

    shapes = shapely.transform(places.geometry, moved)
    notes = list(places.notes)
    if places.points:
        known = [i for i, name in enumerate(places.environment) if name is not None]
        xy = shapely.get_coordinates(shapes[known])
        names = [str(places.environment[i]) for i in known]
        notes.append(f"zones are the ground nearest to {len(known)} labelled points")
        return zones_around(xy, names, extent), notes
    zones = []
    box = shapely.box(extent.min_x, extent.min_y, extent.max_x, extent.max_y)
    for shape, name in zip(shapes, places.environment, strict=True):
        if name is None:
            continue
        part = shapely.set_precision(shapely.make_valid(shape).intersection(box), 0.01)
        for polygon in shapely.get_parts(part):
            if polygon.geom_type == "Polygon" and polygon.area > 0.01:
                zones.append(zone_of(name, polygon))
    return tuple(zones), notes
