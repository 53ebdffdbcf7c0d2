"""``symboslam sim world``, and the page about worlds."""

import json
import re
from pathlib import Path

import pytest
from typer.testing import CliRunner

from symboslam.cli.main import app
from symboslam.errors import InputError, OutputError, SymboSlamError
from symboslam.sim_bridge.worlds.generator import world_by_name
from symboslam.sim_bridge.worlds.world_file import read_world, world_of

ROOT = Path(__file__).parents[3]


def run(*arguments: object) -> str:
    """What the command prints."""
    result = CliRunner().invoke(app, ["sim", "world", *map(str, arguments)], catch_exceptions=False)
    assert result.exit_code == 0, result.output
    return result.output


def fails(*arguments: object) -> BaseException:
    """The error that the command ends with."""
    result = CliRunner().invoke(app, ["sim", "world", *map(str, arguments)])
    assert result.exception is not None
    return result.exception


def test_named_world_and_all_outputs(tmp_path: Path) -> None:
    names = ["w.json", "w.png", "zones.geojson", "landmarks.geojson"]
    outs = [part for name in names for part in ("--out", tmp_path / name)]
    text = run("kingston", "--seed", 3, *outs)
    assert "Kingston: 710.0 m x 710.0 m = 0.5041 km2, 212 objects" in text
    assert text.count("wrote ") == 4
    assert read_world(tmp_path / "w.json") == (world_by_name("kingston", 3), ())
    assert json.loads((tmp_path / "zones.geojson").read_text())["crs_units"] == "m"
    assert len(json.loads((tmp_path / "landmarks.geojson").read_text())["features"]) == 212
    assert "Residential" in run(tmp_path / "w.json")


def test_file_with_notes(tmp_path: Path) -> None:
    path = tmp_path / "a.sim"
    path.write_text("House 1000 1000 0\nHouse 1100 1000 0\nfence 1 1 1\n")
    text = run(path, "--area", 1)
    assert "left out, no class of ours: fence (1)" in text
    assert "(no zone)" in text


def test_classes() -> None:
    text = run("--classes")
    assert "Skyscraper" in text
    assert len(text.splitlines()) > 56


def test_bad_input(tmp_path: Path) -> None:
    assert isinstance(fails(), InputError)
    assert isinstance(fails("perth"), InputError)
    assert isinstance(fails("city", "--out", tmp_path / "x.doc"), OutputError)
    assert "zones or landmarks?" in str(fails("city", "--out", tmp_path / "x.geojson"))
    assert isinstance(fails("city", "--out", tmp_path / "none" / "x.json"), OutputError)
    path = tmp_path / "w.json"
    path.write_text("{}")
    assert "no world" in str(fails(path))
    assert isinstance(fails(path, "--out", path), SymboSlamError)
    assert path.read_text() == "{}"


def test_the_page_shows_a_world() -> None:
    page = (ROOT / "docs" / "worlds.md").read_text(encoding="utf-8")
    shown = re.findall(r"^```json\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
    assert len(shown) == 1
    world, notes = world_of(json.loads(shown[0]))
    assert len(world.objects) == 3
    assert notes == ()


@pytest.mark.parametrize("name", ["city", "kingston", "airport", "gungahlin"])
def test_the_page_tells_the_mix(name: str) -> None:
    page = (ROOT / "docs" / "worlds.md").read_text(encoding="utf-8")
    world = world_by_name(name)
    assert f"| `{name}` | {world.extent.area_km2:.4f} | {len(world.objects):,} |" in page
