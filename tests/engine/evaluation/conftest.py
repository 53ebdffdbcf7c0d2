"""Small truths and maps, and the benchmark's own scorer where it is there."""

from __future__ import annotations

import importlib
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

SHARED = Path(os.environ.get("SYMBOSLAM_SHARED", Path(__file__).parents[4] / "shared"))
Feature = dict[str, Any]
Square = Callable[..., Feature]


def square(x0: float, y0: float, x1: float, y1: float, name: str | None, **more: Any) -> Feature:
    """A rectangle with an environment."""
    ring = [[x0, y0], [x1, y0], [x1, y1], [x0, y1], [x0, y0]]
    return {
        "type": "Feature",
        "geometry": {"type": "Polygon", "coordinates": [ring]},
        "properties": {"environment": name, **more},
    }


def collection(*features: Feature, **members: Any) -> Feature:
    """A GeoJSON document in metres."""
    return {
        "type": "FeatureCollection",
        "crs_units": "m",
        "features": list(features),
        **members,
    }


@pytest.fixture(name="square")
def square_fixture() -> Square:
    return square


@pytest.fixture(name="collection")
def collection_fixture() -> Callable[..., Feature]:
    return collection


@pytest.fixture
def town() -> tuple[Feature, Feature]:
    """4 x 4 cells of 10 m: a truth of 12 cells, and a map with errors, a gap and an overlap.

    Truth, rows from the north, R Residential, C Commercial, N NonUrban, . none::

        R R C C      map:  R R R ?
        R R C C            R R C ?
        N N N N            N N N N
        . . . .            N N N N
    """
    truth = collection(
        square(0, 20, 20, 40, "Residential"),
        square(20, 20, 40, 40, "Commercial"),
        square(0, 10, 40, 20, "NonUrban"),
        bbox=[0, 0, 40, 40],
    )
    found = collection(
        square(0, 0, 40, 20, "NonUrban", probabilities={"NonUrban": 1.0}),
        square(0, 20, 30, 40, "Residential", probabilities={"Residential": 0.6, "Commercial": 0.4}),
        square(20, 20, 30, 30, "Commercial", probabilities={"Residential": 0.3, "Commercial": 0.7}),
        square(30, 20, 40, 40, None, probabilities=None),
    )
    return truth, found


@pytest.fixture
def benchmark(monkeypatch: pytest.MonkeyPatch) -> Any:
    """The benchmark's scorer and its areas: (module score, module benchset, module common)."""
    folder = SHARED / "benchmark"
    if not (folder / "score.py").exists():
        pytest.skip("the benchmark of the shared data folder is not there")
    monkeypatch.syspath_prepend(str(folder))
    names = ("common", "score", "benchset")
    for name in names:
        monkeypatch.delitem(importlib.sys.modules, name, raising=False)  # type: ignore[attr-defined]
    return [importlib.import_module(name) for name in ("score", "benchset", "common")]
