"""The sample area: the same for a seed, inside its box, and true to its own rates."""

import json
from collections import Counter
from typing import Any

import numpy as np
import pytest
import shapely

from symboslam.engine.sample import sample_area, sample_truth
from symboslam.engine.sample_rates import ENVIRONMENTS, RATES_PER_KM2, SITES, amounts
from symboslam.errors import InputError

SEEDS = (0, 7, 2024)


def points(area: dict[str, Any]) -> np.ndarray:
    return np.array([f["geometry"]["coordinates"] for f in area["features"]])


def zones(truth: dict[str, Any]) -> tuple[np.ndarray, np.ndarray]:
    """Polygons, and the index of each one's environment."""
    polygons = [shapely.Polygon(f["geometry"]["coordinates"][0]) for f in truth["features"]]
    names = [f["properties"]["environment"] for f in truth["features"]]
    return np.array(polygons), np.array([ENVIRONMENTS.index(n) for n in names])


def test_same_seed_same_town() -> None:
    assert json.dumps(sample_area(7)) == json.dumps(sample_area(7))
    assert json.dumps(sample_truth(7)) == json.dumps(sample_truth(7))
    assert json.dumps(sample_area(8)) != json.dumps(sample_area(7))


@pytest.mark.parametrize("size", [1000.0, 3000.0, 6000.0])
def test_everything_is_inside_the_box(size: float) -> None:
    area = sample_area(7, size)
    west, south, east, north = area["bbox"]
    xy = points(area)
    assert ((xy >= [west, south]) & (xy <= [east, north])).all()
    # A degree of latitude is 110.94 km at 35.2 degrees south, one of longitude 91.09 km.
    assert (north - south) * 110_940 == pytest.approx(size, rel=1e-3)
    assert (east - west) * 91_090 == pytest.approx(size, rel=1e-3)
    blocks, _ = zones(sample_truth(7, size))
    assert shapely.get_coordinates(blocks).min(axis=0) == pytest.approx([west, south], abs=2e-7)
    assert shapely.get_coordinates(blocks).max(axis=0) == pytest.approx([east, north], abs=2e-7)


def test_a_few_thousand_landmarks_with_tags_and_ids() -> None:
    features = sample_area()["features"]
    assert 3000 <= len(features) <= 6000
    assert len({f["id"] for f in features}) == len(features)
    for feature in features:
        assert feature["geometry"]["type"] == "Point"
        assert set(feature["properties"]) == {"tags"}  # nothing that gives the zone away
        assert all(isinstance(v, str) for v in feature["properties"]["tags"].values())


@pytest.mark.parametrize("seed", SEEDS)
def test_blocks_tile_the_area_without_overlap(seed: int) -> None:
    blocks, zone = zones(sample_truth(seed))
    assert shapely.is_valid(blocks).all()
    assert shapely.is_ccw(shapely.get_exterior_ring(blocks)).all()
    whole = shapely.union_all(blocks)
    assert shapely.area(blocks).sum() == pytest.approx(whole.area, rel=1e-6)
    assert whole.area == pytest.approx(whole.envelope.area, rel=1e-6)
    assert set(zone) == set(range(len(ENVIRONMENTS)))  # every kind of zone occurs


@pytest.mark.parametrize("seed", SEEDS)
def test_numbers_follow_the_rates_of_the_zones(seed: int) -> None:
    """Sum over zones and tags of (seen - expected)^2 / expected is what Poisson numbers give."""
    blocks, zone = zones(sample_truth(seed))
    area = sample_area(seed)
    landmark, block = shapely.STRtree(blocks).query(shapely.points(points(area)), "within")
    tags = ["+".join(map("=".join, f["properties"]["tags"].items())) for f in area["features"]]
    seen = Counter((int(zone[b]), tags[i]) for i, b in zip(landmark, block, strict=True))
    km2 = shapely.area(blocks) * 110.94 * 91.09
    at_sites = {tag for text in SITES.values() for tag in amounts(text)}
    chi, cells = 0.0, 0
    for index, name in enumerate(ENVIRONMENTS):
        for tag, rate in amounts(RATES_PER_KM2[name]).items():
            expected = rate * km2[zone == index].sum()
            if expected >= 3 and tag not in at_sites:
                chi += (seen[index, tag] - expected) ** 2 / expected
                cells += 1
    assert cells >= 60
    assert abs(chi - cells) < 4 * np.sqrt(2 * cells)


def test_sites_stand_on_their_own_grounds() -> None:
    truth = sample_truth()
    grounds = {f["properties"]["kind"] for f in truth["features"]} - {""}
    assert grounds == set(SITES)
    blocks, _ = zones(truth)
    schools = shapely.union_all(
        [
            b
            for b, f in zip(blocks, truth["features"], strict=True)
            if f["properties"]["kind"] == "school"
        ]
    )
    area = sample_area()
    at = [
        shapely.Point(f["geometry"]["coordinates"])
        for f in area["features"]
        if f["properties"]["tags"].get("building") == "school"
    ]
    assert len(at) == 15  # three schools of 1 + 4
    assert all(schools.contains(point) for point in at)


@pytest.mark.parametrize(("seed", "size"), [(-1, 3000.0), (7, 999.0), (7, 1e6), (7, float("nan"))])
def test_out_of_range_is_refused(seed: int, size: float) -> None:
    with pytest.raises(InputError):
        sample_area(seed, size)
