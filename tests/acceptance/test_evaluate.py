"""``symboslam evaluate`` through the command line."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

BOX = {"type": "Polygon", "coordinates": [[[0, 0], [8, 0], [8, 8], [0, 8], [0, 0]]]}


@pytest.fixture
def truth(tmp_path: Path, points: Any) -> Path:
    path: Path = points([({"environment": "Commercial"}, BOX)], bbox=[0, 0, 8, 8], crs_units="m")
    return path.rename(tmp_path / "truth.geojson")


@pytest.fixture
def found(tmp_path: Path, points: Any, truth: Path) -> Path:
    path: Path = points([({"environment": "Residential"}, BOX)], crs_units="m")
    return path.rename(tmp_path / "map.geojson")


def test_from_landmarks_to_reports(run: Any, town: Path, tmp_path: Path) -> None:
    for name, cells in (("truth", 24), ("map", 12)):
        done = run("classify", town, "--cells", cells, "--out", tmp_path / f"{name}.geojson", "-q")
        assert done.code == 0
    targets = [tmp_path / f"report.{ending}" for ending in ("json", "md", "html")]
    outs = [word for target in targets for word in ("--out", target)]
    done = run("evaluate", tmp_path / "truth.geojson", tmp_path / "map.geojson", *outs)
    assert done.code == 0, done
    report = json.loads(targets[0].read_text())
    assert report["pairs"][0]["grid"] == 12
    assert f"{report['all']['macro_f1']:.3f}" in done.out
    assert "Confusion matrix" in done.out
    assert targets[1].read_text().startswith("# Evaluation")
    assert targets[2].read_text().startswith("<!doctype html>")


def test_json_on_standard_output(run: Any, truth: Path, found: Path) -> None:
    done = run("evaluate", truth, found, "--out", "-")
    assert done.code == 0
    assert json.loads(done.out)["all"]["accuracy"] == 0
    assert "overall accuracy" in done.err


def test_pairs_together(run: Any, truth: Path, found: Path) -> None:
    done = run("evaluate", truth, found, truth, truth, "--cells", 2, "--out", "-", "-q")
    report = json.loads(done.out)
    assert (report["cells"], report["all"]["accuracy"]) == (8, 0.5)
    assert [pair["all"]["accuracy"] for pair in report["pairs"]] == [0, 1]
    assert done.err == ""


def test_bbox(run: Any, truth: Path, found: Path) -> None:
    done = run("evaluate", truth, found, "--bbox", "0,0,4,4", "--cells", 3, "--out", "-", "-q")
    assert json.loads(done.out)["pairs"][0]["bbox"] == [0, 0, 4, 4]


def refused(done: Any, *words: str) -> None:
    assert done.code == 2, done
    assert len(done.err.strip().splitlines()) == 1, done.err
    for word in words:
        assert word in done.err


def test_bad_input(run: Any, truth: Path, found: Path, tmp_path: Path) -> None:
    refused(run("evaluate", truth), "each TRUTH needs a MAP")
    refused(run("evaluate", truth, tmp_path / "none.geojson"), "none.geojson", "no such file")
    refused(run("evaluate", truth, tmp_path / "none.ttl"), "none.ttl", "cannot be read")
    refused(run("evaluate", truth, found, "--out", tmp_path / "r.pdf"), ".pdf", ".html")
    refused(run("evaluate", truth, found, "--out", truth), "no report has the ending '.geojson'")
    refused(run("evaluate", truth, found, "--bbox", "1,2"), "--bbox")
    refused(run("evaluate", truth, found, truth, found, "--bbox", "0,0,1,1"), "one pair")
    refused(run("evaluate", truth, found, "--cells", "0"), "cells is 0")
    found.write_text("{")
    refused(run("evaluate", truth, found), "map.geojson", "not valid JSON")
    found.write_text("")
    refused(run("evaluate", truth, found), "map.geojson", "empty")
    found.write_text(truth.read_text().replace("Commercial", "Comercial"))
    refused(run("evaluate", truth, found), "'Comercial'", "did you mean Commercial")
    found.write_text(truth.read_text().replace('"crs_units": "m"', '"x": 1'))
    refused(run("evaluate", truth, found), "local metres", "OGC:CRS84")
    (tmp_path / "map.ttl").write_text("@prefix : <#> . :a :b :c .")
    refused(run("evaluate", truth, tmp_path / "map.ttl"), "no sl:EnvironmentMap")


def test_a_json_input_is_not_replaced(run: Any, truth: Path, found: Path, tmp_path: Path) -> None:
    same = truth.rename(tmp_path / "truth.json")
    refused(run("evaluate", same, found, "--out", same), "is an input")
