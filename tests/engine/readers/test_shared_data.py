"""Real files, where the shared data folder is present."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import shapely

from symboslam.engine.landmarks import LandmarkMap

Read = Callable[..., LandmarkMap]
AREAS = ["gungahlin", "airport", "vaduz", "monaco", "prattville"]


@pytest.mark.parametrize("name", AREAS)
def test_benchmark_areas(shared: Path, read: Read, name: str) -> None:
    path = shared / "benchmark" / "dev" / name / "landmarks.geojson"
    document = json.loads(path.read_text(encoding="utf-8"))
    landmarks = read(path)
    report = landmarks.report
    total = report.read + report.unknown.total() + report.outside + report.duplicates
    assert total == len(document["features"])
    assert report.read == len(landmarks) > 20
    metric = document.get("crs_units") == "m"
    assert landmarks.frame.geographic is not metric
    if metric:
        assert landmarks.bbox == tuple(document["bbox"])
    else:
        west, south, east, north = document["bbox"]
        corners = landmarks.frame.to_metres([west, east, west], [south, south, north])
        assert landmarks.bbox[0] <= corners[0].min() + 1e-9
        assert landmarks.bbox[2] >= corners[0].max() - 1e-9
        assert landmarks.bbox[1] <= corners[1].min() + 1e-9
        assert landmarks.bbox[3] >= corners[1].max() - 1e-9
    assert landmarks.surveyed is None


@pytest.mark.parametrize("name", ["monaco", "helsinki"])
def test_osm_extracts(shared: Path, read: Read, name: str) -> None:
    """Compared with the benchmark's own extraction of the same place, which is independent."""
    landmarks = read(shared / "data" / "osm" / f"{name}.osm.pbf")
    assert len(landmarks) > 500
    assert {text[0] for text in landmarks.id} >= {"n", "w"}
    area = shapely.box(*landmarks.bbox)
    assert (shapely.contains_xy(area.buffer(1e-6), landmarks.x, landmarks.y)).all()


def test_monaco_agrees_with_the_benchmark(shared: Path, read: Read, knowledge: Any) -> None:
    """Benches: nodes, untouched by the benchmark's leak rule, so that both lists are equal."""
    bench = knowledge.index_of("Bench")
    cut = read(shared / "benchmark" / "dev" / "monaco" / "landmarks.geojson")
    document = json.loads(
        (shared / "benchmark" / "dev" / "monaco" / "landmarks.geojson").read_text(encoding="utf-8")
    )
    whole = read(shared / "data" / "osm" / "monaco.osm.pbf", bbox=document["bbox"])
    assert (cut.feature == bench).sum() == (whole.feature == bench).sum() > 10

    def positions(landmarks: LandmarkMap) -> np.ndarray[Any, Any]:
        found = landmarks.take(landmarks.feature == bench)
        at = np.round(np.column_stack(found.frame.from_metres(found.x, found.y)), 5)
        return at[np.lexsort(at.T)]

    assert np.allclose(positions(cut), positions(whole), atol=2e-5)
