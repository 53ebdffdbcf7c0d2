"""The area of a map: its box, its metric frame and the part of it that was surveyed."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from symboslam.engine.frame import Frame
from symboslam.engine.landmarks import Box
from symboslam.engine.readers.crs import CoordinateSystem, Floats
from symboslam.errors import GeometryError

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

_EDGE = 64
"""Pieces into which an edge of the box is cut before it is projected; even, see ``outline``."""
_SLIVER = 0.002
"""Share of the metric box outside the true area from which on the difference is kept."""
_PAD = 100.0
_FARTHEST = 1e9
"""Units of any coordinate system; no local map reaches farther."""
_SMALLEST = 0.001
"""Metres; a side below this is no side."""


@dataclass(frozen=True)
class Area:
    """Where a map lies.

    Attributes:
        frame: the local metric frame.
        bbox: the box in metres that covers the area.
        surveyed: what was looked at, in metres; None = all of ``bbox``.
        notes: remarks for the report.
    """

    frame: Frame
    bbox: Box
    surveyed: BaseGeometry | None = None
    notes: tuple[str, ...] = ()


def parse_box(values: object, what: str, system: CoordinateSystem) -> Box:
    """A bounding box in the input's coordinates: min x, min y, max x, max y.

    Args:
        values: four numbers, or six as GeoJSON has them for boxes with heights.
        what: words that name the box in messages.
        system: coordinate system of the numbers.

    Raises:
        GeometryError: not four finite numbers in order and in range, or an area without extent.
    """
    order = "give min x, min y, max x, max y (west, south, east, north)"
    if isinstance(values, str) or not isinstance(values, Sequence | np.ndarray):
        raise GeometryError(f"{what} is not a list of four numbers: {order}")
    if len(values) not in (4, 6):
        raise GeometryError(f"{what} has {len(values)} numbers: {order}")
    numbers = [values[i] for i in ((0, 1, 2, 3) if len(values) == 4 else (0, 1, 3, 4))]
    if not all(
        isinstance(number, int | float | np.number) and not isinstance(number, bool)
        for number in numbers
    ):
        raise GeometryError(f"{what} has something else than numbers in it: {order}")
    try:
        west, south, east, north = map(float, numbers)
    except OverflowError:
        west = south = east = north = math.inf
    shown = f"({west:.10g}, {south:.10g}, {east:.10g}, {north:.10g})"
    if not all(map(math.isfinite, (west, south, east, north))):
        raise GeometryError(f"{what} {shown} is not finite: {order}")
    if system.degrees:
        if max(abs(west), abs(east)) > 180 or max(abs(south), abs(north)) > 90:
            raise GeometryError(
                f"{what} {shown} is out of range for longitude and latitude in degrees: {order}"
            )
        if west > east and west > 0 > east:
            raise GeometryError(f"{what} {shown} {_ANTIMERIDIAN}")
    elif max(map(abs, (west, south, east, north))) > _FARTHEST:
        raise GeometryError(f"{what} {shown} reaches farther than {_FARTHEST:g}: {order}")
    if west > east or south > north:
        raise GeometryError(f"{what} {shown} has its minimum above its maximum: {order}")
    if west == east or south == north:
        raise GeometryError(f"{what} {shown} has no area: {order}")
    return west, south, east, north


_ANTIMERIDIAN = (
    "crosses the antimeridian (180 degrees) or spans more than half the world, which one local "
    "map cannot: split it there, or give local metres (crs m)"
)


def parse_surveyed(value: object, system: CoordinateSystem, source: str) -> BaseGeometry | None:
    """The ``surveyed`` member of a file as a geometry in the input's coordinates.

    Raises:
        GeometryError: no valid Polygon or MultiPolygon, or out of range.
    """
    if value is None:
        return None
    import shapely
    from shapely.geometry import shape

    what = f"{source}: the surveyed area"
    kind = value.get("type") if isinstance(value, Mapping) else None
    if kind not in ("Polygon", "MultiPolygon"):
        raise GeometryError(f"{what} is not a Polygon or MultiPolygon geometry but {kind}")
    try:
        with np.errstate(invalid="ignore"):  # coordinates that are no numbers are found below
            geometry = shapely.force_2d(shape(value))
    except (
        ValueError,
        TypeError,
        KeyError,
        IndexError,
        AttributeError,
        OverflowError,
        shapely.errors.ShapelyError,
    ) as error:
        raise GeometryError(f"{what} has unusable coordinates ({error})") from error
    points = shapely.get_coordinates(geometry)
    if geometry.is_empty or not np.isfinite(points).all():
        raise GeometryError(f"{what} is empty or has coordinates that are not finite")
    if not geometry.is_valid:
        reason = shapely.is_valid_reason(geometry)
        raise GeometryError(f"{what} is not a valid polygon: {reason}")
    if system.degrees and (np.abs(points) > (180.0, 90.0)).any():
        raise GeometryError(f"{what} is out of range for longitude and latitude in degrees")
    return geometry


def outline(box: Box) -> tuple[Floats, Floats]:
    """The box's outline as a dense open ring, counter-clockwise from the south-west corner.

    Corners and midpoints of the edges are among the points, so that the extent of the projected
    ring is that of the projected box: parallels and meridians bulge most in the middle.
    """
    west, south, east, north = box
    step = np.arange(_EDGE) / _EDGE
    across, up = west + (east - west) * step, south + (north - south) * step
    back, down = east - (east - west) * step, north - (north - south) * step
    one = np.ones(_EDGE)
    x = np.concatenate([across, east * one, back, west * one])
    y = np.concatenate([south * one, up, north * one, down])
    return x, y


def area_of(
    box: Box,
    system: CoordinateSystem,
    *,
    given: bool,
    surveyed: BaseGeometry | None,
    source: str,
) -> Area:
    """The area in metres that a box in the input's coordinates stands for.

    Args:
        box: the box; may be without extent if it is only that of the landmarks.
        system: its coordinate system.
        given: False if the box is the landmarks' extent, which is padded where it is a point or
            a line.
        surveyed: what was looked at, in the input's coordinates.
        source: the file, for messages.

    Raises:
        GeometryError: the box cannot be brought to one local map, or nothing in it was surveyed.
    """
    ring_x, ring_y = system.outside(*outline(box))
    if not (np.isfinite(ring_x).all() and np.isfinite(ring_y).all()):
        raise GeometryError(f"{source}: the area {box} lies outside the domain of {system.name}")
    frame = Frame.metric()
    if not system.metric:
        west, east = float(ring_x.min()), float(ring_x.max())
        if east - west > 180:
            raise GeometryError(f"{source}: the area {_ANTIMERIDIAN}")
        frame = Frame.around((west + east) / 2, float(ring_y.min() + ring_y.max()) / 2)
    ring_x, ring_y = frame.to_metres(ring_x, ring_y)
    bbox = float(ring_x.min()), float(ring_y.min()), float(ring_x.max()), float(ring_y.max())
    width, height = bbox[2] - bbox[0], bbox[3] - bbox[1]
    notes: tuple[str, ...] = ()
    if min(width, height) < _SMALLEST:
        if given:
            raise GeometryError(f"{source}: the bounding box {box} has no area")
        bbox = bbox[0] - _PAD, bbox[1] - _PAD, bbox[2] + _PAD, bbox[3] + _PAD
        notes = (f"the landmarks span no area: {_PAD:g} m around them were taken",)
    if system.metric and max(width, height) < 1 and not notes:
        notes = ("the whole area is less than 1 m wide: are the coordinates degrees?",)
    if surveyed is not None:
        return Area(frame, bbox, _to_metres(surveyed, box, system, frame, source), notes)
    covered = abs(np.dot(ring_x, np.roll(ring_y, -1)) - np.dot(ring_y, np.roll(ring_x, -1))) / 2
    if frame.geographic and covered < (1 - _SLIVER) * width * height and not notes:
        from shapely import Polygon

        return Area(frame, bbox, Polygon(np.column_stack([ring_x, ring_y])), notes)
    return Area(frame, bbox, None, notes)


def _to_metres(
    surveyed: BaseGeometry, box: Box, system: CoordinateSystem, frame: Frame, source: str
) -> BaseGeometry:
    """The surveyed area inside the box, with edges cut fine enough to follow the projection."""
    import shapely

    inside = shapely.intersection(surveyed, shapely.box(*box))
    parts = [part for part in shapely.get_parts(inside) if part.area > 0]
    if surveyed.is_empty:
        return surveyed
    if not parts:
        raise GeometryError(f"{source}: the surveyed area lies outside the bounding box {box}")
    inside = parts[0] if len(parts) == 1 else shapely.MultiPolygon(parts)
    if system.metric:
        return inside
    longest = max(box[2] - box[0], box[3] - box[1]) / _EDGE

    def project(points: Floats) -> Floats:
        return np.column_stack(frame.to_metres(*system.outside(points[:, 0], points[:, 1])))

    return shapely.transform(shapely.segmentize(inside, longest), project)
