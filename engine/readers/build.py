"""Columns -> LandmarkMap: checks, identifiers, features, area and metres; the only such path."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.landmarks import Box, LandmarkMap, ReadReport
from symboslam.engine.readers.area import Area, area_of, parse_box, parse_surveyed
from symboslam.engine.readers.checks import (
    UNWRITABLE,
    check_confidence,
    check_positions,
    fail,
    make_ids,
    read_agents,
    read_times,
    without_duplicates,
)
from symboslam.engine.readers.columns import Columns, FeatureIndex, Floats, Kind
from symboslam.engine.readers.crs import (
    DEGREES,
    METRES,
    CoordinateSystem,
    canonical,
    coordinate_system,
)
from symboslam.errors import GeometryError

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

_LONGEST_ATTRIBUTION = 300
_SHOWN = 80
"""Characters of an unknown class or tag that the report shows."""


def build(
    columns: Columns, knowledge: FeatureIndex, *, crs: str | None = None, bbox: object = None
) -> LandmarkMap:
    """The landmark map of a file's columns.

    Args:
        columns: what a reader found.
        knowledge: which features there are.
        crs: coordinate system that overrides the file's.
        bbox: area that overrides the file's, in the input's coordinates.

    Raises:
        LandmarkError: a coordinate, confidence, time or id is wrong; names its place.
        GeometryError: the area or coordinate system is wrong, or there is no area at all.
    """
    notes = list(columns.notes)
    system = _system(columns, crs, notes)
    check_positions(columns, system)
    check_confidence(columns)
    times, agents, ids = read_times(columns, notes), read_agents(columns), make_ids(columns)
    surveyed = parse_surveyed(columns.surveyed, system, columns.source)
    box = _box(columns, bbox, system)
    fresh = without_duplicates(columns)
    inside = np.ones(len(columns), bool) if box is None else _inside(columns, box)
    around = box or _extent(columns, None if surveyed is None else surveyed.bounds)
    if surveyed is None and columns.find_surveyed is not None:
        surveyed = columns.find_surveyed(around)
        notes.extend(_left_out(surveyed, around))
    area = area_of(
        around,
        system,
        given=box is not None,
        surveyed=surveyed,
        source=columns.source,
    )
    notes.extend(area.notes)
    features, unknown = _features(columns, fresh & inside, knowledge)
    keep = fresh & inside & (features >= 0)
    if unknown and not keep.any():
        notes.append("no landmark has a class or tags that the ontology knows: all is unknown")
    if columns.surveyed is not None:
        notes.extend(_not_surveyed(columns, surveyed, keep))
    x, y = area.frame.to_metres(*_outside(columns, system, keep))
    return LandmarkMap(
        x=x,
        y=y,
        id=ids[keep],
        frame=area.frame,
        bbox=_cover(area, x, y),
        surveyed=area.surveyed,
        report=ReadReport(
            source=columns.source,
            read=int(keep.sum()),
            unknown=unknown,
            outside=int((fresh & ~inside).sum()),
            duplicates=int((~fresh).sum()),
            notes=tuple(notes),
            attribution=_one_line(columns.attribution),
        ),
        **_kept(columns, knowledge, features, keep, times, agents),
    )


def _kept(
    columns: Columns,
    knowledge: FeatureIndex,
    features: NDArray[np.int32],
    keep: NDArray[np.bool_],
    times: NDArray[Any] | None,
    agents: NDArray[Any] | None,
) -> dict[str, Any]:
    """The columns of a landmark map that do not depend on where it lies."""
    feature = features[keep]
    confidence = np.ones(len(columns)) if columns.confidence is None else columns.confidence
    return {
        "feature": feature,
        "confidence": confidence[keep],
        "static": np.array([known.static for known in knowledge.features], np.bool_)[feature],
        "time": None if times is None else times[keep],
        "agent": None if agents is None else agents[keep],
    }


def place(
    columns: Columns, knowledge: FeatureIndex, like: LandmarkMap, crs: str | None = None
) -> LandmarkMap:
    """The rows of a file that lie in the area of a map, in its frame; the same checks as `build`.

    Ids are not looked at: each landmark's is the number of its row.

    Args:
        columns: what a reader found.
        knowledge: which features there are.
        like: the map.
        crs: coordinate system of a file that names none; by default the map's.

    Raises:
        LandmarkError: a coordinate, confidence or time is wrong; names its place.
        GeometryError: the coordinate system cannot be brought into the map's.
    """
    notes: list[str] = []
    default = crs or (DEGREES if like.frame.geographic else METRES)
    name = columns.crs if columns.crs_from != "default" else default
    system = coordinate_system(name, columns.source)
    if (canonical(name) == METRES) == like.frame.geographic:
        raise GeometryError(
            f"{columns.source}: its coordinates are in {name}, the map is in {like.frame.name}"
        )
    check_positions(columns, system)
    check_confidence(columns)
    times, agents = read_times(columns, notes), read_agents(columns)
    everything = np.ones(len(columns), bool)
    x, y = like.frame.to_metres(*_outside(columns, system, everything))
    west, south, east, north = like.bbox
    inside = (x >= west) & (x <= east) & (y >= south) & (y <= north)
    features, unknown = _features(columns, inside, knowledge)
    keep = inside & (features >= 0)
    return LandmarkMap(
        x=x[keep],
        y=y[keep],
        id=np.flatnonzero(keep).astype(np.str_),
        frame=like.frame,
        bbox=like.bbox,
        surveyed=like.surveyed,
        report=ReadReport(
            source=columns.source,
            read=int(keep.sum()),
            unknown=unknown,
            outside=int((~inside).sum()),
            notes=tuple(notes),
        ),
        **_kept(columns, knowledge, features, keep, times, agents),
    )


def _left_out(surveyed: BaseGeometry | None, box: Box) -> list[str]:
    """A remark on the part of the box that was not looked at, if there is any."""
    if surveyed is None:
        return []
    share = 1 - surveyed.area / ((box[2] - box[0]) * (box[3] - box[1]))
    return [f"{100 * share:.0f} % of the area holds no object of the file and stays unknown"]


def _not_surveyed(
    columns: Columns, surveyed: BaseGeometry | None, keep: NDArray[np.bool_]
) -> list[str]:
    """A remark on the landmarks outside the surveyed area that the file states, if any."""
    if surveyed is None:
        return []
    import shapely

    shapely.prepare(surveyed)
    count = int((~shapely.intersects_xy(surveyed, columns.x[keep], columns.y[keep])).sum())
    if not count:
        return []
    return [f"{count} landmarks lie outside the surveyed area; the map is unknown there"]


def _one_line(text: str) -> str:
    """A text of a file without line breaks and other characters that do not print."""
    words = "".join(c if c.isprintable() else " " for c in text).split()
    return " ".join(words)[:_LONGEST_ATTRIBUTION].rstrip()


def _system(columns: Columns, crs: str | None, notes: list[str]) -> CoordinateSystem:
    """The coordinate system that was asked for, or else the input's own."""
    if crs is None or canonical(crs) == canonical(columns.crs):
        return coordinate_system(columns.crs, columns.source)
    if columns.crs_from == "format":
        raise GeometryError(
            f"{columns.source}: this format is always in {columns.crs}, it cannot be {crs}"
        )
    if columns.crs_from == "file":
        notes.append(f"coordinates were read as {crs}; the file itself says {columns.crs}")
    return coordinate_system(crs, columns.source)


def _box(columns: Columns, bbox: object, system: CoordinateSystem) -> Box | None:
    """The area that was asked for, or that the file names."""
    if bbox is not None:
        return parse_box(bbox, "the bounding box", system)
    if columns.bbox is not None:
        return parse_box(columns.bbox, f"{columns.source}: bbox", system)
    return None


def _inside(columns: Columns, box: Box) -> NDArray[np.bool_]:
    """Mask of the rows in the box, edges included."""
    west, south, east, north = box
    x, y = columns.x, columns.y
    inside = (x >= west) & (x <= east) & (y >= south) & (y <= north)
    if len(inside) and not inside.any():
        hint = ""
        if ((y >= west) & (y <= east) & (x >= south) & (x <= north)).any():
            hint = "; longitude and latitude (x and y) look swapped in one of the two"
        raise GeometryError(
            f"{columns.source}: the bounding box {_shown(box)} holds no landmark; they lie within "
            f"{_shown(_extent(columns, None))}{hint}"
        )
    return inside


def _shown(box: Box) -> str:
    return f"({', '.join(f'{number:.10g}' for number in box)})"


def _extent(columns: Columns, also: Sequence[float] | None) -> Box:
    """The box of all landmarks and of another box.

    Raises:
        GeometryError: there is neither.
    """
    boxes = [] if also is None else [tuple(also)]
    if len(columns):
        x, y = columns.x, columns.y
        boxes.append((x.min(), y.min(), x.max(), y.max()))
    if not boxes:
        raise GeometryError(
            f"{columns.source}: there are no landmarks and no area: give a bounding box "
            "(--bbox min x, min y, max x, max y)"
        )
    lows, highs = np.array(boxes)[:, :2].min(0), np.array(boxes)[:, 2:].max(0)
    return float(lows[0]), float(lows[1]), float(highs[0]), float(highs[1])


def _outside(
    columns: Columns, system: CoordinateSystem, keep: NDArray[np.bool_]
) -> tuple[Floats, Floats]:
    """Positions of the kept rows in the frame's outside coordinates."""
    x, y = system.outside(columns.x[keep], columns.y[keep])
    finite = np.isfinite(x) & np.isfinite(y)
    if not finite.all():
        row = int(np.flatnonzero(keep)[np.argmin(finite)])
        problem = f"({columns.x[row]}, {columns.y[row]}) lies outside the domain of {system.name}"
        raise fail(columns, row, problem)
    return x, y


def _features(
    columns: Columns, rows: NDArray[np.bool_], knowledge: FeatureIndex
) -> tuple[NDArray[np.int32], Counter[str]]:
    """The (n,) features, -1 where unknown, and a count of the unknown ones among ``rows``."""
    found = [_feature(kind, knowledge) for kind in columns.kinds]
    table = np.array([-1 if index is None else index for index in found], np.int32)
    counts = np.bincount(columns.kind[rows], minlength=len(table))
    unknown: Counter[str] = Counter()
    for kind, index, count in zip(columns.kinds, found, counts.tolist(), strict=True):
        if index is None and count:
            unknown[_label(kind)] += count
    return table[columns.kind] if len(table) else columns.kind, unknown


def _feature(kind: Kind, knowledge: FeatureIndex) -> int | None:
    name, tags = kind
    index = knowledge.index_of(name) if name else None
    if index is None and tags:
        return knowledge.match_tags(dict(tags))
    return index


def _label(kind: Kind) -> str:
    """What the report calls an unknown kind: its class, or its tags."""
    name, tags = kind
    text = name or ", ".join(f"{key}={value}" for key, value in tags) or "(no tag of any feature)"
    text = UNWRITABLE.sub("\ufffd", text)
    return text if len(text) <= _SHOWN else text[: _SHOWN - 3] + "..."


def _cover(area: Area, x: Floats, y: Floats) -> Box:
    """The area's box; landmarks on its edge may lie a rounding error outside: they belong to it."""
    west, south, east, north = area.bbox
    if not len(x):
        return area.bbox
    return (
        min(west, float(x.min())),
        min(south, float(y.min())),
        max(east, float(x.max())),
        max(north, float(y.max())),
    )
