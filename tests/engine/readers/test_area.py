"""Boxes, frames and surveyed areas, with lengths worked out by hand."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import shapely

from symboslam.engine.landmarks import LandmarkMap
from symboslam.errors import GeometryError, LandmarkError

Read = Callable[..., LandmarkMap]
A = 6378137.0  # WGS 84
E2 = 0.00669437999014


def collection(*positions: tuple[float, float], **members: Any) -> dict[str, Any]:
    """Houses at these positions."""
    features = [
        {
            "type": "Feature",
            "geometry": {"type": "Point", "coordinates": list(position)},
            "properties": {"class": "House"},
        }
        for position in positions
    ]
    return {"type": "FeatureCollection", "features": features, **members}


def polygon(*ring: tuple[float, float]) -> dict[str, Any]:
    return {"type": "Polygon", "coordinates": [[*map(list, ring), list(ring[0])]]}


def square(low: float, high: float) -> dict[str, Any]:
    return polygon((low, low), (high, low), (high, high), (low, high))


# Boxes in degrees


def test_metres_of_a_box_at_the_equator(read: Read) -> None:
    """0.01 degrees of the equator are a * 0.01 rad; of the meridian there a (1 - e^2) * 0.01."""
    landmarks = read(collection((0, 0), bbox=[-0.01, -0.01, 0.01, 0.01]))
    east, north = A * math.radians(0.01), A * (1 - E2) * math.radians(0.01)
    assert landmarks.frame.origin == (0, 0)
    assert landmarks.bbox == pytest.approx((-east, -north, east, north), abs=1e-4)
    assert landmarks.surveyed is None


def test_a_meridian_is_widest_at_the_equator(read: Read) -> None:
    """There, between the corners, it is a * 1 degree away; at the corners 17 m less."""
    west, _, east, _ = read(collection((0, 0), bbox=[-1, -1, 1, 1])).bbox
    assert (west, east) == pytest.approx((-A * math.radians(1), A * math.radians(1)), abs=1e-5)


def test_the_box_covers_its_bulging_edges(read: Read) -> None:
    """North of the equator the southern corners are the widest, the northern the highest."""
    box = [9, 47, 10, 48]
    landmarks = read(collection((9, 47), (10, 47), (9.5, 47), (9, 48), (10, 48), bbox=box))
    west, south, east, north = landmarks.bbox
    assert landmarks.x[:2] == pytest.approx([west, east], abs=1e-6)
    assert landmarks.y[2] == pytest.approx(south, abs=1e-6)
    assert landmarks.y[3:] == pytest.approx([north, north], abs=1e-6)
    assert landmarks.report.outside == 0


def test_slivers_outside_a_large_box_stay_unknown(read: Read) -> None:
    landmarks = read(collection((9.5, 47.5), bbox=[9, 47, 10, 48]))
    surveyed = landmarks.surveyed
    assert surveyed is not None
    whole = shapely.box(*landmarks.bbox)
    # The southern edge is 76.06 km wide, the northern 74.63 km: 1 % of the box is sliver.
    assert 0.98 < surveyed.area / whole.area < 0.995
    assert surveyed.bounds == pytest.approx(landmarks.bbox)
    corner = shapely.Point(landmarks.bbox[2] - 1, landmarks.bbox[3] - 1)
    assert not surveyed.contains(corner)


@pytest.mark.parametrize(("side", "kept"), [(0.04, False), (0.5, True)])
def test_small_boxes_need_no_outline(read: Read, side: float, kept: bool) -> None:
    landmarks = read(collection((9.5, 47.1), bbox=[9.5, 47.1, 9.5 + side, 47.1 + side]))
    assert (landmarks.surveyed is not None) is kept


def test_edges_belong_to_the_box(read: Read) -> None:
    box = (9.0, 47.0, 9.3, 47.2)
    corners = [(9.0, 47.0), (9.3, 47.2), (9.1234567, 47.0), (9.3, 47.1234567)]
    landmarks = read(collection(*corners, (9.30001, 47.1)), bbox=box)
    assert (len(landmarks), landmarks.report.outside) == (4, 1)
    west, south, east, north = landmarks.bbox
    assert ((landmarks.x >= west) & (landmarks.x <= east)).all()
    assert ((landmarks.y >= south) & (landmarks.y <= north)).all()


def test_the_option_beats_the_file(read: Read) -> None:
    document = collection((1, 1), (8, 8), crs_units="m", bbox=[0, 0, 10, 10])
    landmarks = read(document, bbox=(0, 0, 5, 5))
    assert landmarks.bbox == (0, 0, 5, 5)
    assert landmarks.report.outside == 1


def test_a_box_with_heights(read: Read) -> None:
    landmarks = read(collection((1, 1), crs_units="m", bbox=[0, 0, -5, 10, 20, 90]))
    assert landmarks.bbox == (0, 0, 10, 20)


def test_a_box_in_another_system_is_that_of_the_input(read: Read) -> None:
    """UTM, 78 km = 0.859 deg west of the central meridian: turned by 0.859 sin(lat) degrees."""
    document = collection((422_000, 6_090_000))
    landmarks = read(document, crs="EPSG:28355", bbox=(420_000, 6_088_000, 424_000, 6_092_000))
    surveyed = landmarks.surveyed
    assert surveyed is not None
    assert landmarks.frame.geographic
    # The scale there is 0.9996 * (1 + (78 km)^2 / 2 R^2) = 0.99967: areas grow by 0.066 %.
    assert surveyed.area == pytest.approx(16e6 * 1.00066, rel=1e-4)
    turn = math.radians(0.859) * math.sin(math.radians(35.33))
    side = 4000 / 0.99967
    width = side * (math.cos(turn) + math.sin(turn))
    assert landmarks.bbox[2] - landmarks.bbox[0] == pytest.approx(width, rel=5e-5)


@pytest.mark.parametrize(
    ("box", "message"),
    [
        ((0, 0, 10), "has 3 numbers"),
        ((0, 0, 10, 10, 10), "has 5 numbers"),
        ("0,0,1,1", "not a list"),
        (5, "not a list"),
        ((0, 0, "10", 10), "something else than numbers"),
        ((0, 0, True, 10), "something else than numbers"),
        ((0, 0, math.nan, 10), "not finite"),
        ((0, 0, math.inf, 10), "not finite"),
        ((0, 0, 10**400, 10), "not finite"),
        ((10, 0, 0, 10), "minimum above its maximum"),
        ((0, 10, 10, 0), "minimum above its maximum"),
        ((0, 0, 0, 10), "has no area"),
        ((0, 5, 10, 5), "has no area"),
        ((1, 1, 1, 1), "has no area"),
        ((0, 0, 1e-9, 1e-9), "has no area"),
    ],
)
@pytest.mark.parametrize("given", ["option", "file"])
def test_bad_boxes(read: Read, box: Any, message: str, given: str) -> None:
    members = {"crs_units": "m"} | ({"bbox": box} if given == "file" else {})
    with pytest.raises(GeometryError, match=message):
        read(collection((0, 0), **members), bbox=box if given == "option" else None)


@pytest.mark.parametrize("box", [(-181, 0, 10, 10), (0, 0, 10, 91), (149, -35, 47, 149)])
def test_boxes_out_of_range(read: Read, box: Any) -> None:
    with pytest.raises(GeometryError, match="out of range for longitude and latitude"):
        read(collection((0, 0)), bbox=box)


def test_a_box_without_landmarks_says_where_they_are(read: Read) -> None:
    with pytest.raises(GeometryError, match=r"holds no landmark.*\(9.5, 47.1, 9.6, 47.2\)$"):
        read(collection((9.5, 47.1), (9.6, 47.2)), bbox=(10, 47, 11, 48))


def test_a_swapped_box_is_recognised(read: Read) -> None:
    with pytest.raises(GeometryError, match="look swapped"):
        read(collection((9.5, 47.1), (9.6, 47.2)), bbox=(47, 9, 48, 10))


# No box


def test_no_landmarks_and_no_box(read: Read) -> None:
    with pytest.raises(GeometryError, match="no landmarks and no area: give a bounding box"):
        read(collection())


def test_no_landmarks_in_a_box_is_a_valid_map(read: Read) -> None:
    landmarks = read(collection(bbox=[9.5, 47.1, 9.6, 47.2]))
    assert len(landmarks) == 0
    assert landmarks.bbox[2] > 3000
    assert landmarks.id.tolist() == []
    assert landmarks.report.read == 0


def test_the_extent_of_the_landmarks_is_the_area(read: Read) -> None:
    assert read(collection((5, 7), (1, 2), (3, 9), crs_units="m")).bbox == (1, 2, 5, 9)


@pytest.mark.parametrize(
    "positions",
    [[(5.0, 7.0)], [(5.0, 7.0)] * 3, [(5.0, 7.0), (5.0, 9.0)], [(5.0, 7.0), (9.0, 7.0)]],
)
def test_landmarks_without_extent_are_padded(
    read: Read, positions: list[tuple[float, float]]
) -> None:
    landmarks = read(collection(*positions, crs_units="m"))
    east, north = max(x for x, _ in positions), max(y for _, y in positions)
    assert landmarks.bbox == (-95, -93, east + 100, north + 100)
    assert "100 m around them" in landmarks.report.notes[0]
    assert len(landmarks) == len(positions)


def test_one_landmark_in_degrees_is_padded_in_metres(read: Read) -> None:
    landmarks = read(collection((9.5, 47.1)))
    assert landmarks.frame.origin == (9.5, 47.1)
    assert landmarks.bbox == pytest.approx((-100, -100, 100, 100), abs=1e-6)
    assert landmarks.surveyed is None


def test_a_small_area_far_from_the_origin_is_whole(read: Read) -> None:
    far = 5e8
    landmarks = read(collection((far, far), (far + 3, far + 3), crs_units="m"))
    assert landmarks.bbox == (far, far, far + 3, far + 3)
    assert landmarks.surveyed is None


# The antimeridian


@pytest.mark.parametrize(
    "document",
    [
        collection((179.99, -17), (-179.99, -17.1)),
        collection((179.99, -17), bbox=[179.9, -18, -179.9, -16]),
        collection((0, 0), bbox=[-170, -60, 170, 60]),
    ],
)
def test_areas_across_the_antimeridian_are_refused(read: Read, document: Any) -> None:
    with pytest.raises(GeometryError, match="antimeridian"):
        read(document)


def test_a_projected_area_across_the_antimeridian_works_as_local_metres(read: Read) -> None:
    document = collection((0, 0), (20_000, 10_000))
    with pytest.raises(GeometryError, match="antimeridian"):
        read(document, crs="+proj=merc +lon_0=180", bbox=(-20_000, 0, 20_000, 10_000))
    assert read(document, crs="m").bbox == (0, 0, 20_000, 10_000)


@pytest.mark.parametrize(("x", "width"), [(179.99, 0.01), (-180, 0.01)])
def test_areas_that_end_at_the_antimeridian_work(read: Read, x: float, width: float) -> None:
    landmarks = read(collection((x, 0), (x + width, 0.01)))
    assert landmarks.bbox[2] - landmarks.bbox[0] == pytest.approx(A * math.radians(0.01), abs=0.01)


# Surveyed areas


def test_surveyed_in_metres(read: Read) -> None:
    document = collection((1, 1), crs_units="m", bbox=[0, 0, 10, 10], surveyed=square(-5, 5))
    surveyed = read(document).surveyed
    assert surveyed is not None
    assert surveyed.equals(shapely.box(0, 0, 5, 5))


def test_surveyed_of_several_parts(read: Read) -> None:
    parts = [square(0, 2)["coordinates"], square(5, 7)["coordinates"]]
    geometry = {"type": "MultiPolygon", "coordinates": parts}
    surveyed = read(collection((1, 1), crs_units="m", surveyed=geometry)).surveyed
    assert surveyed is not None
    assert surveyed.area == 8


def test_surveyed_in_degrees_follows_the_parallels(read: Read) -> None:
    document = collection((9.5, 47.5), bbox=[9, 47, 10, 48])
    whole = read(document).surveyed
    ring = polygon((9, 47), (10, 47), (10, 48), (9, 48))
    stated = read({**document, "surveyed": ring}).surveyed
    assert whole is not None
    assert stated is not None
    assert whole.symmetric_difference(stated).area < 1e-5 * whole.area


def test_without_a_box_the_surveyed_area_counts_too(read: Read) -> None:
    landmarks = read(collection((3, 12), crs_units="m", surveyed=square(0, 10)))
    assert landmarks.bbox == (0, 0, 10, 12)
    empty = read(collection(crs_units="m", surveyed=square(0, 10)))
    assert (len(empty), empty.bbox) == (0, (0, 0, 10, 10))


@pytest.mark.parametrize(
    ("surveyed", "message"),
    [
        ({"type": "Point", "coordinates": [1, 1]}, "not a Polygon or MultiPolygon geometry but P"),
        ("everything", "not a Polygon"),
        ([], "not a Polygon"),
        ({"type": "Polygon"}, "unusable coordinates"),
        ({"type": "Polygon", "coordinates": [[[0, 0], [1, 1]]]}, "unusable coordinates"),
        ({"type": "Polygon", "coordinates": [[["a", "b"]] * 4]}, "unusable coordinates"),
        ({"type": "Polygon", "coordinates": []}, "is empty"),
        (polygon((0, 0), (5, 0), (math.nan, 5)), "not finite"),
        (polygon((0, 0), (5, 5), (5, 0), (0, 5)), "not a valid polygon: Self-intersection"),
        (square(20, 30), "surveyed area lies outside"),
        (square(10, 20), "surveyed area lies outside"),
    ],
)
def test_bad_surveyed_areas(read: Read, surveyed: Any, message: str) -> None:
    document = collection((1, 1), crs_units="m", bbox=[0, 0, 10, 10], surveyed=surveyed)
    with pytest.raises(GeometryError, match=message):
        read(document)


def test_surveyed_out_of_range(read: Read) -> None:
    with pytest.raises(GeometryError, match="surveyed area is out of range"):
        read(collection((1, 1), surveyed=square(0, 200)))


# Systems of coordinates by option


@pytest.mark.parametrize("name", ["nonsense", "EPSG:0", "", "EPSG:4978"])
def test_unusable_systems(read: Read, name: str) -> None:
    with pytest.raises(GeometryError, match="coordinate system"):
        read(collection((1, 1)), crs=name)


def test_positions_outside_the_domain_of_a_system(read: Read) -> None:
    with pytest.raises(GeometryError, match="outside the domain of EPSG:3035"):
        read(collection((4e8, 3e8), (4.1e8, 3e8)), crs="EPSG:3035")


def test_national_degrees_are_converted_and_checked(read: Read) -> None:
    """GDA94 and WGS 84 are the same to within a metre or two."""
    landmarks = read(collection((149.1, -35.3), (149.2, -35.2)), crs="EPSG:4283")
    assert np.allclose(landmarks.frame.origin, (149.15, -35.25), atol=5e-5)
    with pytest.raises(LandmarkError, match="look swapped"):
        read(collection((-35.3, 149.1)), crs="EPSG:4283")


LIES_OUTSIDE = "lie outside the surveyed area; the map is unknown there"


def test_landmarks_outside_the_surveyed_area_are_counted(read: Read) -> None:
    """Of those in the box: (6, 6) and (9, 1) lie outside, (5, 5) on its corner belongs to it."""
    positions = (1, 1), (5, 5), (6, 6), (9, 1), (20, 20)
    members = {"crs_units": "m", "bbox": [0, 0, 10, 10], "surveyed": square(0, 5)}
    report = read(collection(*positions, **members)).report
    assert report.notes == (f"2 landmarks {LIES_OUTSIDE}",)
    assert (report.read, report.outside) == (4, 1)


def test_landmarks_outside_a_surveyed_area_in_degrees(read: Read) -> None:
    surveyed = polygon((9.0, 47.0), (9.01, 47.0), (9.01, 47.01), (9.0, 47.01))
    document = collection((9.001, 47.001), (9.02, 47.02), surveyed=surveyed)
    assert f"1 landmarks {LIES_OUTSIDE}" in read(document).report.notes


def test_no_remark_if_all_is_surveyed(read: Read) -> None:
    members = {"crs_units": "m", "bbox": [0, 0, 10, 10]}
    assert read(collection((1, 1), surveyed=square(0, 5), **members)).report.notes == ()
    assert read(collection((1, 1), **members)).report.notes == ()
