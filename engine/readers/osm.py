"""OpenStreetMap landmarks: tagged nodes and closed areas of a .pbf or XML extract."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from symboslam.engine.landmarks import Box
from symboslam.engine.readers.columns import (
    Codes,
    Columns,
    FeatureIndex,
    Floats,
    Kind,
    Progress,
    Tags,
)
from symboslam.engine.readers.osm_ground import ground_near_objects
from symboslam.engine.readers.source import Source
from symboslam.errors import LandmarkError, SymboSlamError

if TYPE_CHECKING:
    import osmium
    from shapely.geometry.base import BaseGeometry

_ATTRIBUTION = "\N{COPYRIGHT SIGN} OpenStreetMap contributors, ODbL 1.0"

_LAND_USE = frozenset({"landuse", "place", "boundary"})
"""Keys that on an area state how ground is used or what it is called, not what stands there."""

_AREA_VALUES = {
    "aerialway": {"station"},
    "barrier": set(),
    "highway": {"services", "rest_area", "platform", "elevator"},
    "railway": {"station", "platform", "turntable", "roundhouse"},
    "waterway": {"dam", "dock", "boatyard", "fuel"},
}
"""Keys of lines: on a closed way only these values mean the ground inside."""

_LINE_VALUES = {
    "aeroway": {"taxiway", "runway"},
    "leisure": {"track", "slipway"},
    "man_made": {"pipeline", "embankment", "cutline", "groyne"},
    "natural": {"tree_row", "cliff", "ridge", "arete", "coastline", "valley"},
    "power": {"line", "minor_line", "cable"},
}
"""Keys of areas: on a closed way these values still mean the line."""

_BATCH = 20_000


@dataclass
class _Rows:
    """Rows of one type of element: ids, positions and kinds."""

    id: list[str] = field(default_factory=list)
    x: list[float] = field(default_factory=list)
    y: list[float] = field(default_factory=list)
    kind: list[int] = field(default_factory=list)


def read(source: Source, knowledge: FeatureIndex, progress: Progress) -> Columns:
    """Columns of an OpenStreetMap extract.

    Taken are nodes and areas (closed ways and multipolygons; a point inside stands for them) that
    have a key which some feature has; plain lines and mere land use never are landmarks. A node
    on the outline of an area with the same tags is the same thing and is left out.

    Raises:
        LandmarkError: the file is empty, damaged or not OpenStreetMap data.
        SymboSlamError: pyosmium, which is installed with this package, cannot be loaded.
    """
    progress("reading", 0.0)
    head = source.head()
    if not head.strip():
        raise LandmarkError("the file is empty", source=source.name)
    try:
        import osmium
    except ImportError as error:
        raise SymboSlamError(
            f"{source.name}: the package osmium, which reads OpenStreetMap files, cannot be loaded "
            f"({error}): pip install --force-reinstall osmium"
        ) from error
    suffix = _format(head)
    packed: Any = (
        osmium.io.FileBuffer(source.data, suffix)
        if source.path is None
        else osmium.io.File(str(source.path), suffix)
    )
    with _guard(source.name):
        return _read(packed, source.name, knowledge.tag_keys)


@contextmanager
def _guard(name: str) -> Iterator[None]:
    import osmium

    try:
        yield
    except (RuntimeError, OSError, osmium.InvalidLocationError) as error:
        problem = f"this is not readable OpenStreetMap data, or it is cut short ({error})"
        raise LandmarkError(problem, source=name) from error


def _format(head: bytes) -> str:
    """The name that pyosmium has for the format of content that starts like this."""
    if head[:2] == b"\x1f\x8b":
        return "osm.gz"
    if head[:3] == b"BZh":
        return "osm.bz2"
    return "osm" if head.removeprefix(b"\xef\xbb\xbf").lstrip()[:1] == b"<" else "osm.pbf"


def _read(packed: Any, name: str, keys: frozenset[str]) -> Columns:
    codes = Codes()
    nodes, areas = _Rows(), _Rows()
    on_outline: set[int] = set()
    broken, unplaced = _collect(packed, keys, codes, nodes, areas, on_outline)
    if not nodes.id and not areas.id:
        _refuse_out_of_range(packed, name)
    keep = [i for i, text in enumerate(nodes.id) if int(text[1:]) not in on_outline]
    notes = []
    if len(keep) < len(nodes.id):
        left_out = len(nodes.id) - len(keep)
        notes.append(f"{left_out} nodes repeat the tags of the area that they outline: left out")
    if broken:
        notes.append(f"{broken} areas have no usable outline: left out")
    if unplaced:
        notes.append(
            f"{unplaced} elements could not be placed: their nodes are missing or out of range"
        )
    ids = [nodes.id[i] for i in keep] + areas.id
    x = np.array([nodes.x[i] for i in keep] + areas.x, np.float64)
    y = np.array([nodes.y[i] for i in keep] + areas.y, np.float64)
    box = _header_box(packed)
    if box is not None and not _is_sensible(box, x, y):
        notes.append("the file's own bounding box does not fit its content and is not used")
        box = None
    kinds: list[Kind] = [("", tags) for tags in codes]

    def find_surveyed(area: Box) -> BaseGeometry | None:
        with _guard(name):
            return ground_near_objects(packed, area)

    return Columns(
        source=name,
        x=x,
        y=y,
        kind=np.array([nodes.kind[i] for i in keep] + areas.kind, np.int32),
        kinds=kinds,
        place=lambda row: f"element {ids[row]}",
        crs_from="format",
        id=ids,
        bbox=box,
        find_surveyed=find_surveyed,
        notes=tuple(notes),
        attribution=_ATTRIBUTION,
    )


def _collect(
    packed: Any,
    keys: frozenset[str],
    codes: Codes,
    nodes: _Rows,
    areas: _Rows,
    on_outline: set[int],
) -> tuple[int, int]:
    """Fill the rows.

    Returns:
        The number of areas without a usable outline, and that of elements without a place.
    """
    import osmium

    kind_of_node: dict[int, int] = {}
    wkb = osmium.geom.WKBFactory()
    outlines: list[str] = []
    broken = lost = 0
    awaited: set[str] = set()  # ways and relations whose area was not seen yet
    for element in _elements(packed, keys):
        if isinstance(element, osmium.osm.Node):
            tags = tuple(sorted((tag.k, tag.v) for tag in element.tags if tag.k in keys))
            if not element.location.valid():
                lost += 1
                continue
            kind_of_node[element.id] = code = codes[tags]
            nodes.id.append(f"n{element.id}")
            nodes.x.append(element.location.lon)
            nodes.y.append(element.location.lat)
            nodes.kind.append(code)
        elif isinstance(element, osmium.osm.Area):
            tags = _area_tags(element, keys, from_way=element.from_way())
            if not tags:
                continue
            name = f"{'w' if element.from_way() else 'r'}{element.orig_id()}"
            awaited.discard(name)
            try:
                outlines.append(wkb.create_multipolygon(element))
            except RuntimeError:
                broken += 1
                continue
            code = codes[tags]
            areas.id.append(name)
            areas.kind.append(code)
            on_outline.update(ref for ref in _outline(element) if kind_of_node.get(ref, -1) == code)
            if len(outlines) >= _BATCH:
                _add_points(areas, outlines)
        elif _is_outline(element) and _area_tags(element, keys, from_way=element.is_way()):
            awaited.add(f"{'w' if element.is_way() else 'r'}{element.id}")
    _add_points(areas, outlines)
    return broken, lost + len(awaited)


def _elements(packed: Any, keys: frozenset[str]) -> Iterator[Any]:
    """Nodes, ways, relations and areas that have one of the keys; areas after their origin."""
    import osmium

    if not keys:
        return
    processor = osmium.FileProcessor(packed).with_areas()
    processor.with_filter(osmium.filter.KeyFilter(*sorted(keys)))
    yield from processor


def _is_outline(element: Any) -> bool:
    """Whether an area is to be made of a way or relation."""
    if element.is_way():
        closed = len(element.nodes) > 3 and element.is_closed()
        return closed and element.tags.get("area") != "no"
    return element.tags.get("type") in ("multipolygon", "boundary")


def _refuse_out_of_range(packed: Any, name: str) -> None:
    """Refuse an extract that has nodes, but none in range.

    Raises:
        LandmarkError: it is one.
    """
    import osmium

    count = 0
    node: Any
    for node in osmium.FileProcessor(packed, osmium.osm.NODE):
        if node.location.valid():
            return
        count += 1
    if count:
        problem = (
            f"all {count} nodes are out of range for longitude and latitude in degrees: the two "
            "look swapped"
        )
        raise LandmarkError(problem, source=name)


def _area_tags(element: Any, keys: frozenset[str], *, from_way: bool) -> Tags:
    """The tags that say what an area is, without those that only describe its outline."""
    found = sorted(
        (tag.k, tag.v) for tag in element.tags if tag.k in keys and tag.k not in _LAND_USE
    )
    if not from_way or element.tags.get("area") == "yes":
        return tuple(found)
    return tuple(
        (key, value)
        for key, value in found
        if value not in _LINE_VALUES.get(key, ()) and value in _AREA_VALUES.get(key, (value,))
    )


def _outline(area: osmium.osm.Area) -> Iterator[int]:
    for outer in area.outer_rings():
        yield from (node.ref for node in outer)
        for inner in area.inner_rings(outer):
            yield from (node.ref for node in inner)


def _add_points(areas: _Rows, outlines: list[str]) -> None:
    """Append a point inside each outline to the rows, and empty the list of outlines."""
    import shapely

    points = shapely.point_on_surface(shapely.from_wkb(outlines))
    areas.x.extend(shapely.get_x(points).tolist())
    areas.y.extend(shapely.get_y(points).tolist())
    outlines.clear()


def _header_box(packed: Any) -> tuple[float, float, float, float] | None:
    import osmium

    with osmium.io.Reader(packed, osmium.osm.NOTHING) as reader:
        box = reader.header().box()
    if not box.valid():
        return None
    west_south, east_north = box.bottom_left, box.top_right
    return west_south.lon, west_south.lat, east_north.lon, east_north.lat


def _is_sensible(box: tuple[float, float, float, float], x: Floats, y: Floats) -> bool:
    """Whether the box has an area, holds most of the landmarks and is not mostly empty around."""
    west, south, east, north = box
    area = (east - west) * (north - south)
    if east <= west or north <= south or not len(x):
        return bool(east > west and north > south and east - west < 180)
    inside = (x >= west) & (x <= east) & (y >= south) & (y <= north)
    extent = float((x.max() - x.min()) * (y.max() - y.min()))
    return bool(2 * inside.sum() >= len(x) and (len(x) < 10 or area <= 10 * extent))
