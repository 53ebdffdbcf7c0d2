"""Where an OpenStreetMap extract holds objects: the ground that somebody looked at.

docs/decisions/0003-surveyed-area-of-osm-extracts.md tells why.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.landmarks import Box
from symboslam.engine.readers.columns import Floats

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

_CELL = 125.0
"""Metres; side of a cell of the mask."""
_REACH = 1
"""Cells around an object that were looked at with it: 125 m."""
_MARGIN = 2000.0
"""Metres around the area that are looked at too: a field may be cut by the area's edge."""
_MOST_CELLS = 4096
"""Cells along a side; areas of over 500 km get larger cells."""
_DEGREE = 111_195.0
"""Metres in a degree of latitude."""
_WHOLE = 0.98
"""Share of the area from which on all of it counts as surveyed."""
_BATCH = 20_000

_REMARKS = frozenset({"created_by", "fixme", "note", "source", "type"})
"""Keys that say nothing of what is there."""
_NOT_ON_THE_GROUND = (
    ("location", ("underwater",)),
    ("natural", ("bay", "strait")),
    ("place", ("ocean", "sea")),
    ("route", ("ferry",)),
    ("submarine", ("yes",)),
)
"""Lines across water and names of it: nobody mapped the ground there."""
_PHYSICAL = "barrier building highway landuse man_made natural power railway waterway".split()
"""Keys that make a boundary line an object too, such as a river."""


def ground_near_objects(packed: Any, box: Box) -> BaseGeometry | None:
    """The part of an area that lies near objects of an extract, or that such ground encloses.

    Objects are tagged nodes, and ways that are tagged or belong to a multipolygon; ferry routes,
    boundaries and names of water are none.

    Args:
        packed: the extract, an ``osmium.io.File`` or ``FileBuffer``.
        box: the area in degrees: west, south, east, north.

    Returns:
        Polygons in degrees inside the box; None if they cover (nearly) all of it.

    Raises:
        RuntimeError: the extract is damaged.
    """
    import shapely

    if box[0] >= box[2] or box[1] >= box[3]:
        return None
    mask = _Mask(box)
    _mark(packed, mask)
    area = shapely.box(*box)
    ground = shapely.intersection(mask.ground(), area)
    return None if ground.area >= _WHOLE * area.area else ground


def _mark(packed: Any, mask: _Mask) -> None:
    """Mark all objects of the extract."""
    import osmium

    kinds = osmium.osm.NODE | osmium.osm.WAY | osmium.osm.RELATION
    processor = osmium.FileProcessor(packed, kinds).with_locations()
    tagged = osmium.filter.EmptyTagFilter()
    tagged.enable_for(osmium.osm.NODE)
    processor.with_filter(tagged)
    factory = osmium.geom.WKBFactory()
    points: list[tuple[float, float]] = []
    lines: list[str] = []
    bare: dict[int, str] = {}
    element: Any
    for element in processor:
        tags = element.tags
        if element.is_node():
            if element.location.valid() and not _is_bare(tags) and _is_on_the_ground(tags):
                points.append((element.lon, element.lat))
        elif element.is_way():
            if _is_bare(tags):  # counts as a part of a multipolygon; those come after all ways
                bare[element.id] = _line(element, factory)
            elif _is_on_the_ground(tags):
                lines.append(_line(element, factory))
        elif tags.get("type") == "multipolygon" and _is_on_the_ground(tags):
            refs = (member.ref for member in element.members if member.type == "w")
            lines.extend(bare.pop(ref) for ref in refs if ref in bare)
        if len(points) + len(lines) >= _BATCH:
            mask.add(points, lines)
            points.clear()
            lines.clear()
    mask.add(points, lines)


def _is_bare(tags: Any) -> bool:
    """Whether there are no tags but remarks."""
    for tag in tags:  # plain loops: a generator for each of a million objects takes its time
        if tag.k not in _REMARKS:
            return False
    return True


def _is_on_the_ground(tags: Any) -> bool:
    """Whether something with these tags is an object on the ground."""
    if "boundary" in tags and not any(key in tags for key in _PHYSICAL):
        return False
    for key, values in _NOT_ON_THE_GROUND:
        if tags.get(key) in values:
            return False
    return True


def _line(way: Any, factory: Any) -> str:
    """A way as WKB; just its nodes where the extract does not hold all of them."""
    import osmium
    import shapely

    try:
        return str(factory.create_linestring(way))
    except (osmium.InvalidLocationError, RuntimeError):
        points = [(node.lon, node.lat) for node in way.nodes if node.location.valid()]
        return str(shapely.to_wkb(shapely.MultiPoint(points), hex=True))


class _Mask:
    """Cells over an area and a margin around it.

    Args:
        box: the area in degrees.
    """

    def __init__(self, box: Box) -> None:
        west, south, east, north = box
        narrow = max(np.cos(np.radians((south + north) / 2)), 0.01)  # metres, east to north
        longest = _DEGREE * max((east - west) * narrow, north - south) + 2 * _MARGIN
        size = max(_CELL, longest / _MOST_CELLS) / _DEGREE
        margin = _MARGIN / _DEGREE
        self.step = np.array([size / narrow, size])
        self.origin = np.array([west - margin / narrow, south - margin])
        end = np.array([east + margin / narrow, north + margin])
        columns, rows = np.ceil((end - self.origin) / self.step).astype(int).tolist()
        self.seen = np.zeros((columns, rows), np.bool_)

    def add(self, points: Iterable[tuple[float, float]], lines: list[str]) -> None:
        """Mark the cells of points, and those that lines (as WKB) cross.

        A line that cuts a corner of a cell may miss it: the reach makes up for that.
        """
        import shapely

        end = self.origin + self.step * self.seen.shape
        inside = shapely.clip_by_rect(shapely.from_wkb(lines), *self.origin, *end)
        dense = shapely.get_coordinates(shapely.segmentize(inside, self.step[1]))
        self._set(dense)
        self._set(np.array(list(points), np.float64).reshape(-1, 2))

    def _set(self, places: Floats) -> None:
        cells = np.floor((places - self.origin) / self.step).astype(np.int64)
        cells = cells[((cells >= 0) & (cells < self.seen.shape)).all(1)]
        self.seen[cells[:, 0], cells[:, 1]] = True

    def ground(self) -> BaseGeometry:
        """The ground within reach of the marked cells, or enclosed by it, in degrees."""
        import shapely
        from scipy import ndimage

        reach = np.arange(-_REACH, _REACH + 1)
        disc = np.hypot(*np.meshgrid(reach, reach)) < _REACH + 0.5
        near = ndimage.binary_fill_holes(ndimage.binary_dilation(self.seen, disc))
        runs = _runs(near)
        corners = [self.origin + self.step * runs[:, columns] for columns in ((0, 1), (2, 3))]
        return shapely.union_all(shapely.box(*corners[0].T, *corners[1].T))


def _runs(mask: NDArray[np.bool_]) -> NDArray[np.int64]:
    """(r, 4) west, south, east, north of the marked runs of cells, each one column wide."""
    change = np.diff(np.pad(mask, ((0, 0), (1, 1))).astype(np.int8), axis=1)
    column, south = np.nonzero(change == 1)
    _, north = np.nonzero(change == -1)
    return np.column_stack([column, south, column + 1, north])
