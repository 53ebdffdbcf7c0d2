"""EyeSim: scenes (``.sim``), worlds (``.wld``) and oracle files (``.txt``) as worlds.

A scene names a world file and places objects, ``model x y degrees``, and robots, which have a
program after that. A world file gives ``width``, ``height``, a floor and walls, ``x1 y1 x2 y2``. An
oracle file has ``number class x y degrees``. All lengths are millimetres.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from symboslam.errors import WorldError
from symboslam.sim_bridge.worlds.checks import Notes, checked
from symboslam.sim_bridge.worlds.eyesim_names import ROBOTS, class_of, group_of
from symboslam.sim_bridge.worlds.starts import with_starts
from symboslam.sim_bridge.worlds.voronoi import zones_around
from symboslam.sim_bridge.worlds.world import (
    Extent,
    Ground,
    Start,
    Wall,
    World,
    WorldObject,
)

TOY_MM = 25_000.0
"""Side of the world in millimetres where no world file tells it."""

_SETTINGS = {"world", "settings", "object", "robot"}
_FLOORS = {"floor", "floor_texture", "wall_texture", "texture", "wall_height", "start", "position"}


@dataclass
class _Scene:
    """What was read so far; lengths in millimetres, angles in degrees."""

    width: float = 0.0
    height: float = 0.0
    floor: str = "ground"
    walls: list[tuple[float, ...]] = field(default_factory=list)
    objects: list[tuple[str, str, float, float, float]] = field(default_factory=list)
    groups: list[str | None] = field(default_factory=list)
    robots: list[tuple[float, float, float]] = field(default_factory=list)
    unknown: Counter[str] = field(default_factory=Counter)
    notes: list[str] = field(default_factory=list)


def read_eyesim(source: str | Path, *, area_km2: float | None = None) -> tuple[World, Notes]:
    """The world of an EyeSim file.

    Objects of comments such as ``# Objects - parks`` have that environment; zones are the ground
    nearest to them. Models of no class that we know are left out and counted in the notes.

    Args:
        source: a ``.sim``, ``.wld`` or oracle ``.txt`` file.
        area_km2: the area that the toy world stands for: everything is scaled to it. Without it
            millimetres are taken as such.

    Returns:
        The world in metres, and notes.

    Raises:
        WorldError: the file cannot be read, holds nothing, or a line in it is wrong.
    """
    path = Path(source)
    if area_km2 is not None and not 0 < area_km2 < 1e6:
        raise WorldError(f"an area of {area_km2} km2: give one above 0", source=str(source))
    scene = _Scene()
    ending = path.suffix.lower()
    read = {".sim": _read_sim, ".wld": _read_wld}.get(ending, _read_oracle)
    read(path, scene)
    if not scene.objects and not (ending == ".wld" and scene.width > 0):
        told = f": {_listed(scene.unknown)} is no class" if scene.unknown else ""
        raise WorldError(f"it places no object{told}", source=str(source))
    if not scene.width > 0 or not scene.height > 0:
        _size_from_objects(scene)
    world = _world(path, scene, area_km2)
    if scene.unknown:
        scene.notes.append(f"left out, no class of ours: {_listed(scene.unknown)}")
    if area_km2 is None and scene.objects:
        scene.notes.append("millimetres were taken as such, objects in full size: give the area")
    world, odd = checked(with_starts(world), str(source), strict=False)
    return world, (*scene.notes, *odd)


def _lines(path: Path) -> Iterator[tuple[int, str]]:
    """Number and text of each line that is not empty."""
    try:
        text = path.read_text(encoding="utf-8-sig", errors="replace")
    except OSError as error:
        raise WorldError(f"cannot be read: {error.strerror or error}", source=str(path)) from error
    if not text.strip():
        raise WorldError("the file is empty", source=str(path))
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip():
            yield number, line.strip()


def _read_sim(path: Path, scene: _Scene) -> None:
    group: str | None = None
    for number, line in _lines(path):
        if line.startswith("#"):
            if "object" in line.lower():
                group = group_of(line)
            continue
        words = line.split("#")[0].split()
        kind = words[0].casefold()
        if kind == "world" and len(words) > 1:
            _read_world_of(path, words[1], scene)
        elif kind in _SETTINGS:
            continue
        elif kind.startswith(ROBOTS):
            scene.robots.append(_three(words[1:4], path, number))
        else:
            x, y, turn = _three(words[1:4], path, number)
            _add(scene, words[0], x, y, turn, group)


def _read_world_of(path: Path, name: str, scene: _Scene) -> None:
    """The world file of a scene, beside it; where it is missing the size is guessed."""
    file = path.parent / name.replace("\\", "/")
    if file.is_file():
        _read_wld(file, scene)
    else:
        scene.notes.append(f"world file {name} is missing: its size was taken from the objects")


def _read_wld(path: Path, scene: _Scene) -> None:
    for number, line in _lines(path):
        words = line.split("#")[0].split()
        if not words:
            continue
        kind = words[0].casefold()
        if kind in ("width", "height"):
            value = _number(words[1] if len(words) > 1 else "", path, number)
            if value <= 0:
                raise _wrong(f"{kind} {value:g} is no size: it must be above 0", path, number)
            setattr(scene, kind, value)
        elif kind in ("floor_texture", "floor") and len(words) > 1:
            scene.floor = words[1].replace("\\", "/").split("/")[-1].split(".")[0]
        elif kind in _FLOORS:
            continue
        elif len(words) == 4:
            scene.walls.append(tuple(_number(word, path, number) for word in words))
        else:
            scene.notes.append(f"{path.name}, line {number}: {words[0]!r} is not understood")


def _read_oracle(path: Path, scene: _Scene) -> None:
    for number, line in _lines(path):
        words = line.split("#")[0].split()
        if not words:
            continue
        if len(words) < 4:
            raise _wrong("an oracle line is `number class x y degrees`", path, number)
        x, y, turn = _three([*words[2:5], "0"][:3], path, number)
        _add(scene, words[1], x, y, turn, None)
    scene.width = scene.height = TOY_MM


def _add(scene: _Scene, name: str, x: float, y: float, turn: float, group: str | None) -> None:
    kind = class_of(name)
    if kind is None:
        scene.unknown[name] += 1
    else:
        scene.objects.append((name, kind, x, y, turn))
        scene.groups.append(group)


def _size_from_objects(scene: _Scene) -> None:
    """The usual toy world, or more if objects lie beyond it."""
    scene.width = max([TOY_MM, *(o[2] for o in scene.objects)])
    scene.height = max([TOY_MM, *(o[3] for o in scene.objects)])


def _world(path: Path, scene: _Scene, area_km2: float | None) -> World:
    scale = 0.001
    if area_km2 is not None:
        scale = math.sqrt(area_km2 * 1e6 / (scene.width * scene.height))
    extent = Extent(0.0, 0.0, scene.width * scale, scene.height * scale)
    objects = tuple(
        WorldObject(
            f"{kind.lower()}-{number}", kind, round(x * scale, 3), round(y * scale, 3),
            heading=math.radians(turn) % (2 * math.pi),
            model=None if name.casefold() == kind.casefold() else name,
        )
        for number, (name, kind, x, y, turn) in enumerate(scene.objects, 1)
    )  # fmt: skip
    known = [i for i, group in enumerate(scene.groups) if group is not None]
    xy = np.array([(objects[i].x, objects[i].y) for i in known], float).reshape(-1, 2)
    if known:
        scene.notes.append(f"zones are the ground nearest to {len(known)} grouped objects")
    return World(
        name=path.stem,
        extent=extent,
        objects=objects,
        zones=zones_around(xy, [str(scene.groups[i]) for i in known], extent),
        walls=tuple(
            Wall(((a * scale, b * scale), (c * scale, d * scale))) for a, b, c, d in scene.walls
        ),
        starts=tuple(
            Start(x * scale, y * scale, math.radians(turn) % (2 * math.pi))
            for x, y, turn in scene.robots
        ),
        ground=Ground(scene.floor),
    )


def _three(words: list[str], path: Path, line: int) -> tuple[float, float, float]:
    if len(words) < 3:
        raise _wrong("expected x, y and degrees after the name", path, line)
    x, y, turn = (_number(word, path, line) for word in words)
    return x, y, turn


def _number(word: str, path: Path, line: int) -> float:
    try:
        value = float(word)
    except ValueError:
        raise _wrong(f"{word!r} is no number", path, line) from None
    if not math.isfinite(value):
        raise _wrong(f"{word!r} is no finite number", path, line)
    return value


def _wrong(problem: str, path: Path, line: int) -> WorldError:
    return WorldError(problem, source=str(path), where=f"line {line}")


def _listed(unknown: Counter[str]) -> str:
    return ", ".join(f"{name} ({number})" for name, number in unknown.most_common())
