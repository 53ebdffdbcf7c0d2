"""How long ``symboslam evaluate`` takes: grid maps against a truth of irregular polygons."""

from __future__ import annotations

import json
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from bench.cases import SYMBOSLAM
from bench.measure import process, table

CELL_M = 10.0


def evaluation(sides: Sequence[int], polygons: int) -> str:
    """Whole processes: GeoJSON in, JSON and HTML out.

    Args:
        sides: cells along each side; the map has one segment a cell.
        polygons: how many the truth has, of 40 corners each.
    """
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        truth, found, out = (folder / f for f in ("truth.geojson", "map.geojson", "out"))
        for side in sides:
            rng = np.random.default_rng(side)
            _write(truth, side, [_blob(rng, side * CELL_M, polygons) for _ in range(polygons)], rng)
            _write(found, side, [_cell(*divmod(i, side)) for i in range(side * side)], rng)
            command = [
                *SYMBOSLAM, "evaluate", str(truth), str(found), "--cells", str(side), "--quiet",
                "--out", f"{out}.json", "--out", f"{out}.html",
            ]  # fmt: skip
            run = min((process(command) for _ in range(3)), key=lambda one: one.seconds)
            page = Path(f"{out}.html").stat().st_size / 1e6
            rows.append([f"{side} x {side}", polygons, f"{run.seconds:.2f}", f"{run.peak_mb:.0f}",
                         f"{page:.1f}"])  # fmt: skip
    return (
        "## Evaluation (whole process `symboslam evaluate`, GeoJSON to JSON and HTML)\n\n"
        "A map of one segment a cell, all of random types, against overlapping polygons of 40 "
        "corners; the fastest of 3.\n\n"
        + table(("cells and segments", "truth polygons", "seconds", "peak MB", "page MB"), rows)
    )


def _blob(rng: np.random.Generator, extent: float, count: int) -> list[list[float]]:
    """A ring around a random place; all together they could cover the area once."""
    angle = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    radius = extent / np.sqrt(count * np.pi) * (0.7 + 0.6 * rng.random(40))
    ring = (
        rng.random(2) * extent + np.column_stack([np.cos(angle), np.sin(angle)]) * radius[:, None]
    )
    return [*ring.round(2).tolist(), ring[0].round(2).tolist()]


def _cell(row: int, column: int) -> list[list[float]]:
    west, south = column * CELL_M, row * CELL_M
    east, north = west + CELL_M, south + CELL_M
    return [[west, south], [east, south], [east, north], [west, north], [west, south]]


def _write(
    path: Path, side: int, rings: Sequence[list[list[float]]], rng: np.random.Generator
) -> None:
    """A GeoJSON file of polygons with random types and probabilities."""
    names = ("Residential", "Commercial", "Industrial", "NonUrban")
    kinds = rng.integers(len(names), size=len(rings)).tolist()
    features = [
        {
            "type": "Feature",
            "geometry": {"type": "Polygon", "coordinates": [ring]},
            "properties": {
                "environment": names[k],
                "probabilities": {names[k]: 0.75, names[k - 1]: 0.25},
            },
        }
        for ring, k in zip(rings, kinds, strict=True)
    ]
    box = [0, 0, side * CELL_M, side * CELL_M]
    collection = {"type": "FeatureCollection", "crs_units": "m", "bbox": box, "features": features}
    path.write_text(json.dumps(collection))
