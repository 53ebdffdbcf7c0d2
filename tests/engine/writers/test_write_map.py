"""Formats by extension, and what is refused before anything is written."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.writers import FORMATS, check_targets, format_of, write_map
from symboslam.engine.writers.options import reasons_wanted
from symboslam.errors import InputError, OutputError


@pytest.mark.parametrize(
    ("target", "format"),
    [
        ("a/map.geojson", "geojson"),
        ("map.JSON", "geojson"),
        ("map.ttl", "ttl"),
        ("map.nq", "nq"),
        ("map.png", "png"),
        ("map.html", "html"),
        ("-", "geojson"),
    ],
)
def test_the_ending_tells_the_format(target: str, format: str) -> None:
    assert format_of(target) == format
    assert format_of(Path(target)) == format


def test_a_named_format_counts_more_than_the_ending(town: EnvironmentMap, tmp_path: Path) -> None:
    write_map(town, tmp_path / "map.txt", format="geojson")
    assert json.loads((tmp_path / "map.txt").read_text())["type"] == "FeatureCollection"


def test_every_format_can_be_loaded() -> None:
    for known in FORMATS.values():
        assert callable(known.load())


def test_an_unknown_ending_lists_the_known_ones(town: EnvironmentMap, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match=r"'\.shp'.*\.geojson, \.json, \.ttl, \.nq, \.png, "):
        write_map(town, tmp_path / "map.shp")
    with pytest.raises(OutputError, match="no format 'shp'; there are: geojson, ttl, nq"):
        write_map(town, tmp_path / "map", format="shp")
    assert list(tmp_path.iterdir()) == []


def test_targets_are_checked_before_the_work(tmp_path: Path) -> None:
    check_targets([tmp_path / "a.geojson", str(tmp_path / "b.ttl"), "-"])
    with pytest.raises(OutputError, match="ending"):
        check_targets([tmp_path / "a.geojson", tmp_path / "b.txt"])
    with pytest.raises(OutputError, match="there is no folder"):
        check_targets([tmp_path / "nowhere" / "a.geojson"])
    with pytest.raises(OutputError, match="named twice"):
        check_targets([tmp_path / "a.ttl", str(tmp_path / "x" / ".." / "a.ttl")])
    with pytest.raises(OutputError, match="named twice"):
        check_targets(["-", "-"])
    assert list(tmp_path.iterdir()) == []


def test_standard_output(town: EnvironmentMap, capfdbinary: Any) -> None:
    write_map(town, "-")
    assert json.loads(capfdbinary.readouterr().out)["type"] == "FeatureCollection"
    write_map(town, "-", format="ttl")
    assert capfdbinary.readouterr().out.startswith(b"@prefix sl: ")


@pytest.mark.parametrize("ending", ["geojson", "ttl", "nq", "png"])
def test_progress_ends_at_one(town: EnvironmentMap, tmp_path: Path, ending: str) -> None:
    shares: list[float] = []
    write_map(town, tmp_path / f"m.{ending}", progress=lambda stage, share: shares.append(share))
    assert shares[-1] == 1
    assert shares == sorted(shares)


def test_reasons_are_left_out_of_large_maps_unless_asked_for() -> None:
    assert reasons_wanted(None, 20_000) == 8
    assert reasons_wanted(None, 20_001) == 0
    assert reasons_wanted(3, 1_000_000) == 3
    with pytest.raises(InputError, match="must be 0 or more"):
        reasons_wanted(-1, 1)
