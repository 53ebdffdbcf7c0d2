"""GeoJSON maps: the contract with readers, digit by digit."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.explanation import Reason
from symboslam.engine.frame import Frame
from symboslam.engine.landmarks import ReadReport
from symboslam.engine.writers import write_map
from symboslam.engine.writers.content import MILLION, Content, divided, millionths, rounded
from symboslam.engine.writers.geojson import to_geojson

Make = Callable[..., EnvironmentMap]


def written(environment_map: EnvironmentMap, folder: Path, **options: Any) -> dict[str, Any]:
    write_map(environment_map, folder / "map.geojson", **options)
    found: dict[str, Any] = json.loads((folder / "map.geojson").read_bytes())
    return found


def by_id(collection: dict[str, Any]) -> dict[str, dict[str, Any]]:
    return {f["properties"]["segment_id"]: f["properties"] for f in collection["features"]}


def test_properties_of_segments(town: EnvironmentMap, tmp_path: Path) -> None:
    segments = by_id(written(town, tmp_path, reasons=8))
    assert list(segments) == ["0-0-0", "0-0-1", "0-1-0", "0-1-1"]
    home, shop, unknown, open_ground = segments.values()
    assert home["environment"] == "Residential"
    assert home["probabilities"] == {"Residential": 0.7, "Commercial": 0.1, "NonUrban": 0.2}
    assert (home["landmark_count"], home["depth"]) == (4, 0)
    assert "single_landmark" not in home
    assert shop["single_landmark"] is True
    assert (unknown["environment"], unknown["probabilities"], unknown["reasons"]) == (
        None,
        None,
        [],
    )
    assert open_ground["reasons"] == [
        {
            "feature": "OpenGround",
            "label": "open ground",
            "count": 0,
            "contribution": {"NonUrban": 1},
        }
    ]


def test_reasons_beyond_the_limit_are_summed_up(town: EnvironmentMap) -> None:
    home = by_id(to_geojson(town, reasons=2))["0-0-0"]
    assert [r["feature"] for r in home["reasons"]] == ["House", "Tree", None]
    assert home["reasons"][2] == {
        "feature": None,
        "label": "other",
        "count": 1,
        "contribution": {"Residential": -0.05, "Commercial": 0.1, "NonUrban": 0.05},
    }


def test_no_reasons(town: EnvironmentMap) -> None:
    collection = to_geojson(town, reasons=0)
    assert all("reasons" not in segment for segment in by_id(collection).values())
    assert collection["symboslam"]["features"] == {}


def test_metric_coordinates(make_town: Make) -> None:
    collection = to_geojson(make_town())
    assert collection["crs_units"] == "m"
    assert collection["bbox"] == [-100, -100, 100, 100]
    ring = collection["features"][0]["geometry"]["coordinates"][0]
    assert sorted(map(tuple, ring[1:])) == [(-100, -100), (-100, 0), (0, -100), (0, 0)]


def test_geographic_coordinates(make_town: Make) -> None:
    collection = to_geojson(make_town(Frame.around(9.52, 47.14)))
    assert "crs_units" not in collection
    # One degree of latitude is 111.18 km at 47.14 degrees north on WGS 84, of longitude 75.86 km.
    expected = [9.52 - 0.1 / 75.86, 47.14 - 0.1 / 111.18, 9.52 + 0.1 / 75.86, 47.14 + 0.1 / 111.18]
    assert collection["bbox"] == pytest.approx(expected, abs=2e-6)
    corners = np.concatenate([f["geometry"]["coordinates"][0] for f in collection["features"]])
    assert [9.52, 47.14] in corners.tolist()
    assert {round(v, 8) for v in corners.ravel()} == set(corners.ravel())


def test_attribution(make_town: Make) -> None:
    assert "attribution" not in to_geojson(make_town())
    line = '© "Contributors"'
    collection = to_geojson(make_town(report=ReadReport(attribution=line)))
    assert collection["attribution"] == collection["symboslam"]["report"]["attribution"] == line


def test_neighbours_share_their_corners(make_town: Make) -> None:
    features = to_geojson(make_town(Frame.around(-122.4, 37.8)))["features"]
    corners = {tuple(c) for f in features for c in f["geometry"]["coordinates"][0]}
    assert len(corners) == 9


def test_what_the_map_was_made_of(town: EnvironmentMap) -> None:
    about = to_geojson(town, reasons=1)["symboslam"]
    assert about["config"]["threshold"] == 0.95
    assert about["knowledge_hash"] == "ab" * 32
    assert about["source"] == "town.geojson"
    assert about["report"] == {
        "read": 5,
        "unknown": {"shop=moon": 2},
        "outside": 1,
        "duplicates": 0,
        "notes": ["A note."],
        "attribution": "",
    }
    assert about["environments"]["NonUrban"] == {
        "iri": "https://w3id.org/symboslam#NonUrban",
        "label": "Non-urban",
        "definition": 'Open "country".',
        "colour": "#8fb573",
    }
    assert list(about["features"]) == ["House", "OpenGround", "Shop"]  # not Tree: never listed
    assert about["features"]["Shop"]["indications"]["Commercial"] == {
        "strength": 0.8,
        "steps": 1,
        "path": ["Shop", "Commercial"],
        "reason": "A Shop is often in Commercial.",
        "source": "https://w3id.org/symboslam#source-judgement",
        "source_iri": "",
        "stands": "",
    }
    assert about["levels"]["Urban"]["members"] == ["Commercial", "Residential"]
    assert about["levels"]["RZ2"]["within"] == "Residential"


def test_chains_add_up_to_the_digit(town: EnvironmentMap) -> None:
    home, shop, unknown, ground = by_id(to_geojson(town, reasons=8)).values()
    assert home["chain"] == {
        "groups": {"Urban": 0.8, "NonUrban": 0.2},
        "zones": {"Residential": {"RZ1": 0.35, "RZ2": 0.35}, "NonUrban": None},
    }
    assert shop["chain"] == {"groups": {"Urban": 1.0}, "zones": {}}
    assert "chain" not in unknown
    assert ground["chain"]["zones"] == {"NonUrban": {"NUZ2": 1.0}}
    assert all("chain" not in each for each in by_id(to_geojson(town, reasons=0)).values())


@given(st.integers(0, 10**6), st.lists(st.floats(0, 1), min_size=1, max_size=6).filter(any))
def test_a_divided_whole_is_whole(whole: int, parts: list[float]) -> None:
    shares = {f"z{i}": part / sum(parts) for i, part in enumerate(parts)}
    found = divided(whole, shares)
    assert sum(found.values()) == whole
    assert all(abs(found.get(name, 0) - whole * share) < 1 for name, share in shares.items())


def test_empty_map(empty: EnvironmentMap, tmp_path: Path) -> None:
    collection = written(empty, tmp_path)
    assert [f["properties"]["environment"] for f in collection["features"]] == [None] * 4
    assert collection["symboslam"]["report"]["read"] == 0


def test_file_and_call_agree(town: EnvironmentMap, tmp_path: Path) -> None:
    assert written(town, tmp_path, reasons=2) == to_geojson(town, reasons=2)


def test_one_line_a_segment(town: EnvironmentMap, tmp_path: Path) -> None:
    write_map(town, tmp_path / "map.geojson")
    lines = (tmp_path / "map.geojson").read_text().splitlines()
    assert [line.startswith('{"type":"Feature"') for line in lines] == [False, *[True] * 4, False]


def test_many_blocks_make_one_collection(
    town: EnvironmentMap, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    whole = to_geojson(town)
    monkeypatch.setattr("symboslam.engine.writers.content.BLOCK", 1)
    assert to_geojson(town) == whole


def test_names_that_need_escaping(make_town: Make, tmp_path: Path) -> None:
    ids = ('a"b', "50 %d\\", "ü\n", "\udc80")
    name = "caf\udce9.geojson"  # a file name that is no UTF-8
    found = make_town(report=ReadReport(name))
    object.__setattr__(found, "segment_id", np.array(ids))
    collection = written(found, tmp_path)
    assert tuple(by_id(collection)) == ids
    assert collection["symboslam"]["source"] == name


def test_benchmark_contract(town: EnvironmentMap, empty: EnvironmentMap) -> None:
    shared = Path(os.environ.get("SYMBOSLAM_SHARED", Path(__file__).parents[4] / "shared"))
    if not (shared / "benchmark" / "score_all.py").exists():
        pytest.skip("the benchmark of the shared data folder is not there")
    before = set(sys.modules)
    sys.path.insert(0, str(shared / "benchmark"))
    try:
        from score_all import check  # type: ignore[import-not-found]

        for environment_map in (town, empty):
            assert check(to_geojson(environment_map)) == []
    finally:
        sys.path.pop(0)
        for name in set(sys.modules) - before:
            if name in ("score_all", "score", "common", "benchset"):
                del sys.modules[name]


distributions = arrays(float, (4, 3), elements=st.floats(1e-9, 1)).map(
    lambda rows: rows / rows.sum(1, keepdims=True)
)


@settings(deadline=None)
@given(
    probability=distributions,
    known=arrays(bool, 4),
    place=st.one_of(st.none(), st.tuples(st.floats(-170, 170), st.floats(-80, 80))),
    size=st.floats(0.1, 50_000),
)
def test_any_map_is_valid(
    make_map: Make,
    probability: Any,
    known: Any,
    place: tuple[float, float] | None,
    size: float,
) -> None:
    frame = Frame.metric() if place is None else Frame.around(*place)
    environment_map = make_map(
        frame, probability=probability * known[:, None], bbox=(-size, -size, size, size)
    )
    collection = to_geojson(environment_map)
    west, south, east, north = collection["bbox"]
    assert west < east
    assert south < north
    for feature, is_known in zip(collection["features"], known, strict=True):
        ring = feature["geometry"]["coordinates"][0]
        assert ring[0] == ring[-1]
        assert shapely.LinearRing(ring).is_ccw
        assert shapely.Polygon(ring).is_valid
        given = feature["properties"]["probabilities"]
        if is_known:
            assert sum(given.values()) == pytest.approx(1, abs=1e-9)
            assert max(given, key=given.__getitem__) == feature["properties"]["environment"] or (
                given[feature["properties"]["environment"]] >= max(given.values()) - 1e-6
            )
        else:
            assert given is None


@settings(deadline=None)
@given(distributions)
def test_millionths_add_up_and_stay_close(probability: Any) -> None:
    whole = millionths(probability)
    assert whole.sum(1).tolist() == [MILLION] * 4
    assert np.abs(whole - probability * MILLION).max() < 1


def test_millionths_by_hand() -> None:
    third = [1 / 3, 1 / 3, 1 / 3]
    assert millionths(np.array([third, [0, 0, 0]])).tolist() == [[333334, 333333, 333333], [0] * 3]


shares = st.dictionaries(st.sampled_from("AB"), st.floats(-1, 1), max_size=2)


@settings(deadline=None)
@given(st.lists(shares, min_size=1, max_size=6), st.integers(1, 7))
def test_listed_reasons_add_up_to_the_probability(
    contributions: list[dict[str, float]], limit: int
) -> None:
    reasons = tuple(Reason(f"F{i}", f"f{i}", i, c) for i, c in enumerate(contributions))
    total = {e: sum(c.get(e, 0.0) for c in contributions) for e in "AB"}
    probability = {e: round(p * MILLION) for e, p in total.items()}
    parts = rounded(reasons, probability, limit)
    if any(share for part in parts for share in part.shares.values()):
        for environment, p in probability.items():
            assert sum(part.shares.get(environment, 0) for part in parts) == p
    listed = [part for part in parts if part.feature is not None]
    assert len(listed) <= limit
    if len(listed) < len(parts):
        assert parts[-1].count == sum(range(limit, len(reasons)))


def test_outlines_with_holes_and_several_parts(make_town: Make) -> None:
    ring = shapely.box(-100, -100, 0, 0).difference(shapely.box(-60, -60, -40, -40))
    several = shapely.MultiPolygon([shapely.box(0, 0, 10, 10), shapely.box(20, 20, 30, 30)])
    found = make_town()
    geometry = found.geometry.copy()
    geometry[0], geometry[3] = ring, several
    object.__setattr__(found, "geometry", geometry)
    features = to_geojson(found)["features"]
    outer, hole = features[0]["geometry"]["coordinates"]
    assert shapely.LinearRing(outer).is_ccw
    assert not shapely.LinearRing(hole).is_ccw
    assert features[3]["geometry"]["type"] == "MultiPolygon"
    assert len(features[3]["geometry"]["coordinates"]) == 2


def test_small_maps_get_finer_coordinates(make_map: Make) -> None:
    # 20 cm across: 1/100000 of it has six decimals; a degree is about 100 km, five decimals more.
    box = (-0.1, -0.1, 0.1, 0.1)
    assert Content(make_map(bbox=box)).decimals == 6
    assert Content(make_map(Frame.around(9.5, 47.1), bbox=box)).decimals == 11
    assert Content(make_map(Frame.around(9.5, 47.1), bbox=(0, 0, 5000, 5000))).decimals == 7


@pytest.mark.parametrize(
    "folder", ["/home/somebody/hidden-away/", "hidden-away/", "C:\\hidden-away\\", ""]
)
@pytest.mark.parametrize("ending", ["geojson", "ttl", "nq", "html"])
def test_folders_are_not_published(
    make_town: Make, tmp_path: Path, folder: str, ending: str
) -> None:
    found = make_town(report=ReadReport(f"{folder}a, b.csv"))
    own = f"{folder}one.ttl, {folder}two.ttl"
    found = replace(found, knowledge=replace(found.knowledge, source=own))
    write_map(found, tmp_path / f"map.{ending}")
    text = (tmp_path / f"map.{ending}").read_text(encoding="utf-8")
    assert "a, b.csv" in text
    assert ("one.ttl, two.ttl" in text) is (ending != "geojson")  # which has only its hash
    assert "somebody" not in text
    assert "hidden-away" not in text
    assert found.landmarks.report.source == f"{folder}a, b.csv"
