"""geof:distance between geometries of any kind, in CRS84 or in a map's own metres.

Oxigraph has the function for points in CRS84 alone (GeoSPARQL 1.1, 8.4; OGC 22-047r1).
"""

from __future__ import annotations

import math
import re
from functools import lru_cache
from typing import TYPE_CHECKING, Any, TypeAlias

import pyoxigraph

from symboslam.engine.writers.vocabulary import CRS84, GEO, LOCAL_METRES, XSD

if TYPE_CHECKING:
    from pyproj import Geod
    from shapely.geometry.base import BaseGeometry

_Point: TypeAlias = tuple[float, float]
_Shape: TypeAlias = "_Point | BaseGeometry"
_DISTANCE = pyoxigraph.NamedNode("http://www.opengis.net/def/function/geosparql/distance")
_WKT = pyoxigraph.NamedNode(GEO + "wktLiteral")
_DOUBLE = pyoxigraph.NamedNode(XSD + "double")
_UNITS = {
    "http://www.opengis.net/def/uom/OGC/1.0/metre": 1.0,
    "http://www.opengis.net/def/uom/OGC/1.0/kilometre": 1000.0,
    "http://qudt.org/vocab/unit/M": 1.0,
    "http://qudt.org/vocab/unit/KiloM": 1000.0,
}
_LITERAL = re.compile(r"\s*(?:<([^<>\s]*)>\s+)?(.*)", re.DOTALL)
_NUMBER = r"\s*(-?\d+(?:\.\d*)?(?:[eE][+-]?\d+)?)\s*"
_POINT = re.compile(rf"\s*POINT\s*\({_NUMBER}\s{_NUMBER}\)\s*", re.IGNORECASE)
_REMEMBERED = 20_000
_NEAR = 0.5
"""Degrees within which the ellipsoid's two radii at the middle will do, to a millionth."""
_AXIS, _ECCENTRICITY = 6_378_137.0, 0.0066943799901413165
"""Of WGS 84: the larger axis in metres, and the square of the first eccentricity."""


def distance(*arguments: Any) -> pyoxigraph.Literal | None:
    """The shortest distance between two geometries; None, an error in SPARQL, if there is none.

    In CRS84 it is that on the WGS 84 ellipsoid between the two nearest points, which are found in
    a plane about the middle between the geometries.

    Args:
        *arguments: two WKT literals in the same coordinate system, and the IRI of a unit.
    """
    if len(arguments) != 3 or getattr(arguments[2], "value", "") not in _UNITS:
        return None
    one, two = (_geometry(each) for each in arguments[:2])
    if one is None or two is None or one[0] != two[0]:
        return None
    crs, a, b = one[0], one[1], two[1]
    if not (isinstance(a, tuple) and isinstance(b, tuple)):
        a, b = _nearest(a, b, crs)
    metres = math.hypot(a[0] - b[0], a[1] - b[1]) if crs == LOCAL_METRES else _ground(a, b)
    return pyoxigraph.Literal(repr(metres / _UNITS[arguments[2].value]), datatype=_DOUBLE)


FUNCTIONS: dict[Any, Any] = {_DISTANCE: distance}
"""What queries and updates get in the place of Oxigraph's own."""


def _nearest(one: _Shape, two: _Shape, crs: str) -> tuple[_Point, _Point]:
    """The two points, one of each, that are nearest to each other."""
    import shapely

    a, b = (shapely.Point(each) if isinstance(each, tuple) else each for each in (one, two))
    middle = (a.bounds[1] + a.bounds[3] + b.bounds[1] + b.bounds[3]) / 4
    narrow = 1.0 if crs == LOCAL_METRES else max(math.cos(math.radians(middle)), 1e-9)
    flat = (shapely.transform(each, lambda xy: xy * (narrow, 1.0)) for each in (a, b))
    (x, y), (u, v) = shapely.get_coordinates(shapely.shortest_line(*flat)).tolist()
    return (x / narrow, y), (u / narrow, v)


def _ground(one: _Point, two: _Point) -> float:
    """Metres between two points in degrees."""
    (x, y), (u, v) = one, two
    if max(abs(x - u), abs(y - v)) > _NEAR:
        return float(_geodesic().inv(x, y, u, v)[2])
    middle = math.radians((y + v) / 2)
    squeezed = 1 - _ECCENTRICITY * math.sin(middle) ** 2
    north = _AXIS * (1 - _ECCENTRICITY) / squeezed**1.5 * math.radians(y - v)
    east = _AXIS / math.sqrt(squeezed) * math.cos(middle) * math.radians(x - u)
    return math.hypot(east, north)


@lru_cache(maxsize=1)
def _geodesic() -> Geod:
    from pyproj import Geod

    return Geod(ellps="WGS84")


def _geometry(term: Any) -> tuple[str, _Shape] | None:
    if not isinstance(term, pyoxigraph.Literal) or term.datatype != _WKT:
        return None
    return _parsed(term.value)


@lru_cache(maxsize=_REMEMBERED)
def _parsed(text: str) -> tuple[str, _Shape] | None:
    """Coordinate system and geometry of a WKT literal; None if there is nothing to measure."""
    import shapely

    crs, wkt = _LITERAL.fullmatch(text).groups()  # type: ignore[union-attr]  # it takes all
    if (crs or CRS84) not in (CRS84, LOCAL_METRES):
        return None
    if point := _POINT.fullmatch(wkt):
        return crs or CRS84, (float(point[1]), float(point[2]))
    found = shapely.from_wkt(wkt, on_invalid="ignore")
    return None if found is None or found.is_empty else (crs or CRS84, found)
