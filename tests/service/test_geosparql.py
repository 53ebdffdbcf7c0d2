"""geof:distance: geodesic, between geometries of any kind, and in a map's own metres."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from pyoxigraph import Literal, NamedNode
from pyproj import Geod

from symboslam.engine.writers.vocabulary import CRS84, GEO, LOCAL_METRES
from symboslam.service.store.geosparql import distance
from tests.service.conftest import MakeService
from tests.service.test_backup import make_map, send

METRE = NamedNode("http://www.opengis.net/def/uom/OGC/1.0/metre")
KILOMETRE = NamedNode("http://www.opengis.net/def/uom/OGC/1.0/kilometre")
GEOD = Geod(ellps="WGS84")


def wkt(text: str, crs: str = "") -> Literal:
    return Literal(f"<{crs}> {text}" if crs else text, datatype=NamedNode(GEO + "wktLiteral"))


def metres(one: Any, two: Any, unit: Any = METRE) -> float:
    found = distance(one, two, unit)
    assert found is not None
    return float(found.value)


@given(st.floats(-170, 170), st.floats(-80, 80), st.floats(-0.4, 0.4), st.floats(-0.4, 0.4))
def test_points_near_each_other(x: float, y: float, east: float, north: float) -> None:
    found = metres(wkt(f"POINT ({x:.7f} {y:.7f})"), wkt(f"POINT({x + east:.7f} {y + north:.7f})"))
    true = GEOD.inv(round(x, 7), round(y, 7), round(x + east, 7), round(y + north, 7))[2]
    assert found == pytest.approx(true, rel=2e-5, abs=1e-4)


def test_points_far_from_each_other() -> None:
    found = metres(wkt("POINT(9.5 47.1)"), wkt("POINT (149.1 -35.3)", CRS84), KILOMETRE)
    assert found == pytest.approx(GEOD.inv(9.5, 47.1, 149.1, -35.3)[2] / 1000, rel=1e-12)


SQUARE = "POLYGON((10 60,10.01 60,10.01 60.01,10 60.01,10 60))"


@pytest.mark.parametrize(
    ("other", "nearest"),
    [
        ("POINT(9.99 60.005)", ((10, 60.005), (9.99, 60.005))),
        ("LINESTRING(10.02 59.9,10.02 60.1)", ((10.01, 60.0), (10.02, 60.0))),
        ("POINT(10.005 60.005)", None),
    ],
)
def test_other_geometries(other: str, nearest: Any) -> None:
    true = 0.0 if nearest is None else GEOD.inv(*nearest[0], *nearest[1])[2]
    assert metres(wkt(SQUARE), wkt(other)) == pytest.approx(true, rel=1e-5, abs=1e-6)
    assert metres(wkt(other), wkt(SQUARE)) == pytest.approx(true, rel=1e-5, abs=1e-6)


def test_local_metres() -> None:
    here, there = wkt("POINT (0 0)", LOCAL_METRES), wkt("POINT (3 4)", LOCAL_METRES)
    assert metres(here, there) == 5
    assert metres(wkt("POLYGON((3 0,4 0,4 9,3 0))", LOCAL_METRES), here) == 3


@pytest.mark.parametrize(
    "arguments",
    [
        (), (wkt("POINT (0 0)"),), (wkt("POINT (0 0)"), wkt("POINT (0 1)")),
        (wkt("POINT (0 0)"), wkt("POINT (0 1)"), NamedNode("urn:furlong")),
        (wkt("POINT (0 0)"), wkt("POINT (0 1)", LOCAL_METRES), METRE),
        (wkt("POINT (0 0)", "urn:crs"), wkt("POINT (0 1)", "urn:crs"), METRE),
        (wkt("POINT (0 0)"), wkt("POINT (0 1"), METRE),
        (wkt("POINT (0 0)"), wkt("POLYGON EMPTY"), METRE),
        (wkt("POINT (0 0)"), Literal("POINT (0 1)"), METRE),
        (wkt("POINT (0 0)"), NamedNode("urn:x"), Literal("metre")),
    ],
)  # fmt: skip
def test_no_distance(arguments: tuple[Any, ...]) -> None:
    assert distance(*arguments) is None


def test_distances_of_segments_by_sparql(make_service: MakeService) -> None:
    service = make_service()
    send(service.client, make_map(service.client), 0)
    rows = service.values(
        "PREFIX geof: <http://www.opengis.net/def/function/geosparql/>"
        "PREFIX geo: <http://www.opengis.net/ont/geosparql#>"
        "PREFIX sl: <https://w3id.org/symboslam#>"
        "SELECT (geof:distance(?a, ?b, <http://www.opengis.net/def/uom/OGC/1.0/metre>) AS ?d) {"
        "GRAPH ?g { ?s a sl:Segment ; geo:hasGeometry/geo:asWKT ?a }"
        "GRAPH ?h { ?l a sl:Landmark ; geo:hasGeometry/geo:asWKT ?b } }"
    )
    assert rows
    assert all(len(row) == 1 and float(row[0]) >= 0 for row in rows)
    assert any(float(row[0]) == 0 for row in rows)
