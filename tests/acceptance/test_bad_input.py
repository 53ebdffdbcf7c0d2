"""Bad input through the command line: exit code 2, a message that helps, nothing half-written."""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

HOUSE: dict[str, Any] = {"class": "House"}
HERE = [149.10, -35.20]
BOX = [149.09, -35.21, 149.11, -35.19]


def refused(result: Any, *words: str) -> None:
    assert result.code == 2, result
    assert "Traceback" not in result.err
    assert "internal error" not in result.err
    for word in words:
        assert word in result.err


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", ["points.geojson", "empty"]),
        ('{"type": "FeatureCollection", "features": [{"type": "Fea', ["points.geojson", "line 1"]),
        ('{"type": "Feature", "geometry": null}', ["Feature", "FeatureCollection"]),
        ("[1, 2]", ["FeatureCollection"]),
        ("\x00\x01\x02", ["points.geojson"]),
    ],
)
def test_broken_files(run: Any, tmp_path: Path, text: str, words: list[str]) -> None:
    path = tmp_path / "points.geojson"
    path.write_text(text)
    refused(run("classify", path, "--out", tmp_path / "map.geojson"), *words)
    assert not (tmp_path / "map.geojson").exists()


@pytest.mark.parametrize(
    ("properties", "geometry", "words"),
    [
        (HOUSE, {"type": "LineString", "coordinates": [HERE, HERE]}, ["LineString", "oint"]),
        (HOUSE, {"type": "Polygon", "coordinates": [[HERE, HERE, HERE, HERE]]}, ["Polygon"]),
        (HOUSE, None, ["no geometry"]),
        ({}, HERE, ["class", "tags"]),
        (HOUSE, [149.1], ["coordinates"]),
        (HOUSE, ["x", "y"], ["coordinate", "not a number"]),
        (HOUSE, [float("nan"), -35.2], ["coordinates"]),
        (HOUSE, [149.1, float("inf")], ["coordinates"]),
        (HOUSE | {"confidence": 1.5}, HERE, ["confidence", "1.5"]),
        (HOUSE | {"confidence": -0.1}, HERE, ["confidence", "-0.1"]),
        (HOUSE | {"confidence": float("nan")}, HERE, ["confidence"]),
        (HOUSE, [-35.2, 149.1], ["swapped"]),
        (HOUSE, [5000.0, 20.0], ["crs_units"]),
    ],
)
def test_a_bad_landmark_is_named_by_its_index(
    run: Any, points: Any, properties: dict[str, Any], geometry: Any, words: list[str]
) -> None:
    path = points([(HOUSE, HERE), (properties, geometry)])
    refused(run("classify", path), "points.geojson", "feature 1", *words)


def test_mixed_coordinate_systems(run: Any, points: Any) -> None:
    path = points([(HOUSE, HERE), (HOUSE, HERE)])
    data = json.loads(path.read_text())
    data["features"][1]["crs"] = {"type": "name", "properties": {"name": "EPSG:32755"}}
    path.write_text(json.dumps(data))
    refused(run("classify", path), "feature 1", "coordinate system of its own")


def test_duplicate_ids(run: Any, points: Any) -> None:
    rows = [(HOUSE | {"id": "a"}, HERE), (HOUSE | {"id": "a"}, [149.101, -35.2])]
    refused(run("classify", points(rows)), "'a'", "feature 1")


def test_exact_duplicates_are_counted(run: Any, points: Any) -> None:
    result = run("classify", points([(HOUSE | {"id": "a"}, HERE)] * 2))
    assert result.code == 0
    assert "exact duplicates left out: 1" in result.out


def test_unknown_classes_are_counted_and_listed(run: Any, points: Any) -> None:
    rows = [(HOUSE, HERE), ({"class": "Unicorn"}, HERE), ({"tags": {"shop": "no"}}, HERE)]
    result = run("classify", points(rows))
    assert result.code == 0
    assert "Unicorn (1)" in result.out


def test_no_landmarks(run: Any, points: Any, tmp_path: Path) -> None:
    refused(run("classify", points([])), "--bbox")
    out = tmp_path / "map.geojson"
    assert run("classify", points([], bbox=BOX), "--out", out).code == 0
    assert json.loads(out.read_text())["features"]


def test_no_landmarks_in_the_paper_profile_is_all_unknown(
    run: Any, points: Any, tmp_path: Path
) -> None:
    out = tmp_path / "map.geojson"
    assert run("classify", points([], bbox=BOX), "--profile", "paper", "--out", out).code == 0
    found = json.loads(out.read_text())["features"]
    assert {f["properties"]["environment"] for f in found} == {None}


@pytest.mark.parametrize("count", [1, 5])
def test_all_at_one_point(run: Any, points: Any, tmp_path: Path, count: int) -> None:
    out = tmp_path / "map.geojson"
    assert run("classify", points([(HOUSE, HERE)] * count), "--out", out).code == 0
    found = json.loads(out.read_text())["features"]
    assert "Residential" in {f["properties"]["environment"] for f in found}
    alone = [f for f in found if f["properties"]["landmark_count"] == 1]
    assert [f["properties"].get("single_landmark") for f in alone] == [True] * len(alone)


@pytest.mark.parametrize(
    "bbox",
    ["149.1,-35.2,149.1,-35.1", "149.2,-35.2,149.1,-35.1", "1,2,3", "a,b,c,d", "nan,0,1,1"],
)
def test_bad_boxes(run: Any, points: Any, bbox: str) -> None:
    refused(run("classify", points([(HOUSE, HERE)]), "--bbox", bbox))


def test_a_box_outside_the_data_says_where_the_data_is(run: Any, points: Any) -> None:
    refused(run("classify", points([(HOUSE, HERE)]), "--bbox", "10,10,11,11"), "149.1", "-35.2")


@pytest.mark.parametrize(
    "arguments",
    [
        ["--profile", "best"],
        ["--scheme", "mine"],
        ["--segmentation", "voronoi"],
        ["--cells", "0"],
        ["--crs", "EPSG:999999"],
        ["--out", "map.docx"],
        ["--format", "shp"],
        ["--measure", "cosine"],
        ["--threshold", "7"],
    ],
)
def test_bad_options(run: Any, points: Any, arguments: list[str]) -> None:
    refused(run("classify", points([(HOUSE, HERE)]), *arguments))


def test_a_missing_file(run: Any, tmp_path: Path) -> None:
    refused(run("classify", tmp_path / "no.geojson"), "no.geojson")
    refused(run("explain", tmp_path / "no.geojson", "0-0-0"), "no.geojson")


def test_an_unknown_segment_and_feature(run: Any, town: Path, tmp_path: Path) -> None:
    out = tmp_path / "map.geojson"
    assert run("classify", town, "--out", out).code == 0
    refused(run("explain", out, "9-9-9"), "9-9-9")
    refused(run("feature", "Huose"), "House")


BROKEN = "@prefix : <http://x#> .\n:a :b\n"
PREFIXES = """@prefix : <https://example.org/mine#> .
@prefix sl: <https://w3id.org/symboslam#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
"""
NO_ENVIRONMENTS = PREFIXES + ":Thing a owl:Class .\n"


def test_an_ontology_with_a_syntax_error(run: Any, town: Path, tmp_path: Path) -> None:
    mine = tmp_path / "mine.ttl"
    mine.write_text(BROKEN)
    refused(run("classify", town, "--ontology", mine), "mine.ttl", "line")
    refused(run("ontology", "check", mine), "mine.ttl")


def test_an_ontology_without_environments(run: Any, town: Path, tmp_path: Path) -> None:
    mine = tmp_path / "mine.ttl"
    mine.write_text(NO_ENVIRONMENTS)
    refused(run("classify", town, "--ontology", mine), "environment")


def test_a_missing_ontology(run: Any, town: Path) -> None:
    refused(run("classify", town, "--ontology", "nowhere.ttl"), "nowhere.ttl")


def test_an_output_that_cannot_be_written(run: Any, town: Path, tmp_path: Path) -> None:
    refused(run("classify", town, "--out", tmp_path / "no" / "map.geojson"), "map.geojson")
    (tmp_path / "folder.geojson").mkdir()
    refused(run("classify", town, "--out", tmp_path / "folder.geojson"), "folder.geojson")


@pytest.mark.parametrize("name", ["map.geojson", "map.ttl", "map.nq", "map.png", "map.html"])
def test_a_full_disk_keeps_the_old_file(town: Path, tmp_path: Path, name: str) -> None:
    folder = tmp_path / "results"
    folder.mkdir()
    old = folder / name
    old.write_text("old")
    done = subprocess.run(
        [sys.executable, "-m", "symboslam", "classify", str(town), "--out", str(old)],
        capture_output=True,
        text=True,
        timeout=120,
        env={**os.environ, "MPLCONFIGDIR": str(tmp_path)},
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096)),
    )
    assert done.returncode == 2, done.stderr
    assert name in done.stderr
    assert old.read_text() == "old"
    assert list(folder.iterdir()) == [old]


def test_an_output_may_not_replace_an_input(run: Any, town: Path, tmp_path: Path) -> None:
    before = town.read_text()
    refused(run("classify", town, "--out", town), "town.geojson", "input")
    assert town.read_text() == before
    mine = tmp_path / "mine.ttl"
    mine.write_text(NO_ENVIRONMENTS)
    refused(run("classify", town, "--ontology", mine, "--out", mine), "mine.ttl", "input")
    assert mine.read_text() == NO_ENVIRONMENTS


@pytest.mark.parametrize("value", ["inf", "nan", "-1"])
def test_absence_must_be_a_number(run: Any, town: Path, value: str) -> None:
    refused(run("classify", town, "--absence", value), "absence")
