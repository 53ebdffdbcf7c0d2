"""World files: the JSON form of a world, read with checks and written whole or not at all."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from symboslam.errors import WorldError
from symboslam.sim_bridge.worlds.checks import Notes, checked
from symboslam.sim_bridge.worlds.fields import Part
from symboslam.sim_bridge.worlds.sizes import find_class, near_classes
from symboslam.sim_bridge.worlds.world import (
    Extent,
    Ground,
    Ring,
    Road,
    Start,
    Wall,
    World,
    WorldObject,
    Zone,
)

FORMAT = "symboslam-world"
VERSION = 1

_WORLD = (
    "format", "version", "name", "extent", "ground", "attribution", "roads", "walls", "zones",
    "objects", "starts",
)  # fmt: skip
_OBJECT = ("id", "class", "x", "y", "z", "heading", "scale", "model", "name")


def read_world(source: str | Path) -> tuple[World, Notes]:
    """Read a world file.

    Args:
        source: the file; ``docs/worlds.md`` says what it holds.

    Returns:
        The world, and notes on what is odd in it or was mended: objects outside the extent,
        objects that overlap, starts that were moved out of objects.

    Raises:
        WorldError: the file cannot be read, is no world, or a part of it is wrong; names the file
            and the place.
    """
    name = str(source)
    try:
        text = Path(source).read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise WorldError(
            f"not UTF-8 at byte {error.start}: save it as UTF-8", source=name
        ) from None
    except OSError as error:
        raise WorldError(f"cannot be read: {error.strerror or error}", source=name) from error
    if not text.strip():
        raise WorldError("the file is empty", source=name)
    try:
        document = json.loads(text)
    except json.JSONDecodeError as error:
        problem = f"no JSON: {error.msg}; is the file cut off or no world?"
        where = f"line {error.lineno}, column {error.colno}"
        raise WorldError(problem, source=name, where=where) from None
    except (RecursionError, ValueError) as error:  # nested too deep; an integer too long
        raise WorldError(f"no JSON that can be a world: {error}", source=name) from None
    return world_of(document, name)


def world_of(document: object, source: str = "world") -> tuple[World, Notes]:
    """The world of a JSON document that is in memory; see ``read_world``."""
    if not isinstance(document, Mapping) or document.get("format") != FORMAT:
        raise WorldError(f'no world: it does not say "format": "{FORMAT}"', source=source)
    if document.get("version") != VERSION or isinstance(document["version"], bool):
        told = document.get("version")
        raise WorldError(f"{told!r}: only version {VERSION} is known", source=source,
                         where="version")  # fmt: skip
    part = Part(document, source, "", _WORLD)
    ground = Part(part.value.get("ground", {}), source, "ground", ("name", "colour"))
    world = World(
        name=part.text("name"),
        extent=_extent(part),
        objects=_objects(part),
        zones=tuple(_zone(Part(v, source, at, ("environment", "polygon")))
                    for at, v in part.items("zones")),
        roads=tuple(_road(Part(v, source, at, ("points", "width")))
                    for at, v in part.items("roads")),
        walls=tuple(_wall(Part(v, source, at, ("points", "height")))
                    for at, v in part.items("walls")),
        starts=tuple(_start(Part(v, source, at, ("x", "y", "heading")))
                     for at, v in part.items("starts")),
        ground=_ground(ground),
        attribution=part.text("attribution", ""),
    )  # fmt: skip
    return checked(world, source)


def write_world(world: World, target: str | Path) -> None:
    """Write a world file: one zone, road or object a line, so that differences stay readable.

    Raises:
        OutputError: it cannot be written; what was there before is kept.
    """
    from symboslam.engine.writers.atomic import atomic_file

    with atomic_file(target) as stream:
        stream.write(to_text(world).encode())


def to_text(world: World) -> str:
    """The text of a world file."""
    members = [
        f"{json.dumps(name)}: {_list(value) if isinstance(value, list) else _json(value)}"
        for name, value in document_of(world).items()
    ]
    return "{\n" + ",\n".join(members) + "\n}\n"


def document_of(world: World) -> dict[str, Any]:
    """The JSON document of a world; members that have their default are left out."""
    e = world.extent
    document: dict[str, Any] = {
        "format": FORMAT,
        "version": VERSION,
        "name": world.name,
        "extent": (e.min_x, e.min_y, e.max_x, e.max_y),
        "ground": {"name": world.ground.name, "colour": world.ground.colour},
    }
    if world.attribution:
        document["attribution"] = world.attribution
    document["roads"] = [{"points": r.points, "width": r.width} for r in world.roads]
    if world.walls:
        document["walls"] = [{"points": w.points, "height": w.height} for w in world.walls]
    document["zones"] = [{"environment": z.environment, "polygon": z.rings} for z in world.zones]
    document["objects"] = [_object_json(o) for o in world.objects]
    document["starts"] = [{"x": s.x, "y": s.y, "heading": s.heading} for s in world.starts]
    return document


def _object_json(o: WorldObject) -> dict[str, Any]:
    found: dict[str, Any] = {"id": o.id, "class": o.kind, "x": o.x, "y": o.y}
    defaults = {"z": 0.0, "heading": 0.0, "scale": 1.0, "model": None, "name": None}
    given = {member: getattr(o, member) for member in defaults}
    return found | {m: v for m, v in given.items() if v != defaults[m]}


def _json(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, allow_nan=False)


def _list(items: list[Any]) -> str:
    return "[\n" + ",\n".join(map(_json, items)) + "\n]" if items else "[]"


def _extent(part: Part) -> Extent:
    extent = Extent(*part.numbers("extent", "min_x, min_y, max_x, max_y"))
    if extent.width <= 0 or extent.height <= 0:
        raise part.error(
            f"{extent.width:g} m x {extent.height:g} m is no area: max must be above min", "extent"
        )
    return extent


def _ground(part: Part) -> Ground:
    default = Ground()
    ground = Ground(part.text("name", default.name), part.text("colour", default.colour))
    if not re.fullmatch(r"#[0-9a-fA-F]{6}", ground.colour):
        raise part.error(f"{ground.colour!r} is no colour: write it as #rrggbb", "colour")
    return ground


def _objects(part: Part) -> tuple[WorldObject, ...]:
    """All objects; what classes are unknown is told at once."""
    found: list[WorldObject] = []
    unknown: dict[str, int] = {}
    seen: dict[str, str] = {}
    for at, value in part.items("objects"):
        given = Part(value, part.source, at, _OBJECT)
        name = given.text("class")
        kind = find_class(name)
        if kind is None:
            unknown[name] = unknown.get(name, 0) + 1
            continue
        identity = given.text("id")
        if identity in seen:
            raise given.error(f"{identity!r} is also the id of {seen[identity]}", "id")
        seen[identity] = at
        found.append(
            WorldObject(
                identity,
                kind,
                given.number("x"),
                given.number("y"),
                given.number("z", 0.0),
                given.number("heading", 0.0),
                given.number("scale", 1.0, above=0.0),
                given.optional_text("model"),
                given.optional_text("name"),
            )
        )
    if unknown:
        raise WorldError(_unknown(unknown), source=part.source, where="objects")
    return tuple(found)


def _unknown(unknown: Mapping[str, int]) -> str:
    told = []
    for name, number in unknown.items():
        close = near_classes(name)
        hint = f", did you mean {' or '.join(close)}?" if close else ""
        told.append(f"{name!r} ({number} object{'s' * (number != 1)}{hint})")
    return f"no detector class: {'; '.join(told)}; `symboslam sim world --classes` lists all 56"


def _zone(part: Part) -> Zone:
    rings: list[Ring] = []
    for at, value in part.items("polygon"):
        member = at[len(part.where) + 1 :]
        ring = part.line_of(value, member, 4)
        if ring[0] != ring[-1]:
            raise part.error("the ring is not closed: repeat its first point at its end", member)
        rings.append(ring)
    if not rings:
        raise part.error("give a list of rings, the outline first", "polygon")
    zone = Zone(part.text("environment"), tuple(rings))
    polygon = zone.polygon
    if not polygon.is_valid or polygon.area <= 0:
        from shapely.validation import explain_validity

        problem = explain_validity(polygon) if not polygon.is_valid else "it has no area"
        raise part.error(f"no valid polygon: {problem}", "polygon")
    return zone


def _road(part: Part) -> Road:
    return Road(part.line("points"), part.number("width", 8.0, above=0.0))


def _wall(part: Part) -> Wall:
    return Wall(part.line("points"), part.number("height", 1.0, above=0.0))


def _start(part: Part) -> Start:
    return Start(part.number("x"), part.number("y"), part.number("heading", 0.0))
