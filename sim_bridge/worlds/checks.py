"""Checks of whole worlds: what is odd is noted, starts inside objects are moved out."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from symboslam.errors import WorldError
from symboslam.sim_bridge.worlds.frequencies import real_frequencies
from symboslam.sim_bridge.worlds.world import Start, World, footprints

Notes = tuple[str, ...]

ROBOT_RADIUS = 0.8
"""Half the diagonal of the largest robot, in metres."""
_STEP = 0.5
_TURNS = 24
_SLIVER = 1.0  # square metres of overlap that are roundings
_TOUCH = 0.98  # overlaps of less than a fiftieth of the size are roundings


def checked(world: World, source: str, strict: bool = True) -> tuple[World, Notes]:
    """The world with its starts outside of objects, and notes on what is odd.

    Args:
        world: it.
        source: the file, for messages.
        strict: whether a start without any free place near it is an error; else it is left out.

    Raises:
        WorldError: a start has no free place near it.
    """
    world, moved = free_starts(world, source, strict)
    notes = [_outside(world), _overlaps(world), *_zone_notes(world), *moved]
    return world, tuple(note for note in notes if note)


def _outside(world: World) -> str:
    out = [o for o in world.objects if not world.extent.has(o.x, o.y)]
    if not out:
        return ""
    return f"{_many(len(out), 'object')} outside the extent, such as {out[0].id!r}"


def _overlaps(world: World) -> str:
    """How many pairs of objects stand in each other."""
    pairs = overlapping(world)
    if not pairs:
        return ""
    a, b = (world.objects[i] for i in pairs[0])
    return (
        f"{_many(len(pairs), 'pair')} of objects overlap, such as {a.id!r} ({a.kind}) and "
        f"{b.id!r} ({b.kind})"
    )


def overlapping(world: World) -> list[tuple[int, int]]:
    """Positions of pairs of objects whose footprints overlap, the lower one first."""
    import shapely

    smaller = tuple(replace(o, scale=o.scale * _TOUCH) for o in world.objects)
    shapes = footprints(smaller)
    if len(shapes) < 2:
        return []
    first, second = shapely.STRtree(shapes).query(shapes, predicate="intersects")
    found = [
        (a, b)
        for a, b in zip(first.tolist(), second.tolist(), strict=True)
        if a < b and _share_height(world, a, b)
    ]
    return sorted(found)


def _share_height(world: World, a: int, b: int) -> bool:
    one, other = world.objects[a], world.objects[b]
    return one.z < other.z + other.size.height and other.z < one.z + one.size.height


def _zone_notes(world: World) -> list[str]:
    """Zones that overlap each other, or reach beyond the extent."""
    import shapely

    if not world.zones:
        return []
    shapes = [zone.polygon for zone in world.zones]
    first, second = shapely.STRtree(shapes).query(shapes, predicate="intersects")
    both = first < second
    areas = [
        shapes[a].intersection(shapes[b]).area
        for a, b in zip(first[both].tolist(), second[both].tolist(), strict=True)
    ]
    known = {*real_frequencies().environments, "Military"}  # no real zone of the latter
    notes = [
        f"environment {name!r} is none of ours: {', '.join(sorted(known))}"
        for name in sorted({zone.environment for zone in world.zones} - set(known))
    ]
    if (over := sum(area > _SLIVER for area in areas)) > 0:
        notes.append(f"{_many(over, 'pair')} of zones overlap: the smaller zone counts there")
    e = world.extent
    box = shapely.box(e.min_x, e.min_y, e.max_x, e.max_y)
    out = sum(shape.difference(box).area > _SLIVER for shape in shapes)
    if out:
        notes.append(f"{_many(out, 'zone')} beyond the extent")
    return notes


def free_starts(
    world: World, source: str = "world", strict: bool = True
) -> tuple[World, list[str]]:
    """Starts inside objects or outside the extent moved to the nearest free place.

    A place is free if a robot of ``ROBOT_RADIUS`` touches no footprint, no wall and no other
    robot there. Places are tried in circles that widen by half a metre, so that the same world
    always gives the same starts.

    Raises:
        WorldError: there is no free place.
    """
    import shapely

    if not world.starts:
        return world, []
    walls = [shapely.LineString(wall.points) for wall in world.walls]
    tree = shapely.STRtree([*footprints(world.objects), *walls])
    taken: list[Start] = []
    notes = []
    for number, start in enumerate(world.starts):
        place = _nearest_free(world, tree, taken, start)
        if place is None and not strict:
            notes.append(f"start {number} was left out: there is no free place near it")
            continue
        if place is None:
            problem = "no free place near it: give another start or a larger extent"
            raise WorldError(problem, source=source, where=f"starts[{number}]")
        if place != start:
            distance = math.hypot(place.x - start.x, place.y - start.y)
            why = "not free" if world.extent.has(start.x, start.y) else "outside the extent"
            notes.append(f"start {number} was {why} and moved by {distance:.1f} m")
        taken.append(place)
    return replace(world, starts=tuple(taken)), notes


def _nearest_free(world: World, tree: object, taken: list[Start], start: Start) -> Start | None:
    import shapely

    assert isinstance(tree, shapely.STRtree)
    e = world.extent
    start_x = min(max(start.x, e.min_x), e.max_x)
    start_y = min(max(start.y, e.min_y), e.max_y)
    angles = np.arange(_TURNS) * 2 * math.pi / _TURNS
    margin = min(ROBOT_RADIUS, e.width / 4, e.height / 4)
    radius = 0.0
    while radius <= math.hypot(e.width, e.height):
        turn = angles if radius else angles[:1]
        x, y = start_x + radius * np.cos(turn), start_y + radius * np.sin(turn)
        free = (x >= e.min_x + margin) & (x <= e.max_x - margin)
        free &= (y >= e.min_y + margin) & (y <= e.max_y - margin)
        near = tree.query(shapely.points(x, y), predicate="dwithin", distance=ROBOT_RADIUS)[0]
        free[near] = False
        for other in taken:
            free &= np.hypot(x - other.x, y - other.y) > 2 * ROBOT_RADIUS
        if free.any():
            first = int(np.flatnonzero(free)[0])
            if radius == 0:
                return replace(start, x=start_x, y=start_y)
            return replace(start, x=round(float(x[first]), 3), y=round(float(y[first]), 3))
        radius += max(_STEP, 0.05 * radius)
    return None


def _many(number: int, one: str) -> str:
    return f"{number} {one}{'s' * (number != 1)}"
