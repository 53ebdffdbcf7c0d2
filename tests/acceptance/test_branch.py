"""Branch segmentation through the real command line, in every format."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import shapely

from symboslam.engine.sample import sample_area


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("branch") / "small.geojson"
    path.write_text(json.dumps(sample_area(3, 1000.0)))
    return path


def test_all_formats_say_the_same(run: Any, small: Path, tmp_path: Path) -> None:
    outs = [tmp_path / f"map.{e}" for e in ("geojson", "ttl", "nq", "png", "html")]
    done = run("classify", small, "--segmentation", "branch", *(f"--out={o}" for o in outs))
    assert done.code == 0, done.err
    collection = json.loads(outs[0].read_text())
    features = collection["features"]
    shapes = [shapely.from_geojson(json.dumps(f["geometry"])) for f in features]
    assert all(s.is_valid and s.area > 0 for s in shapes)
    names = [f["properties"]["segment_id"] for f in features]
    assert len(set(names)) == len(names) > 5
    assert all(name.startswith("b-") for name in names)
    count = sum(f["properties"]["landmark_count"] for f in features)
    landmarks = json.loads(small.read_text())["features"]
    assert count == len(landmarks)
    west, south, east, north = collection["bbox"]
    whole = (east - west) * (north - south)
    assert sum(s.area for s in shapes) == pytest.approx(whole, rel=1e-4)
    tree = shapely.STRtree(shapes)
    for one, two in zip(*tree.query(shapes, predicate="overlaps"), strict=True):
        # Coordinates are rounded to 7 decimals, which can move a border by as much.
        common = shapely.intersection(shapes[one], shapes[two]).area
        assert common < 2e-7 * min(shapes[one].length, shapes[two].length)
    config = collection["symboslam"]["config"]
    assert config["segmentation"] == "branch"
    assert config["momentum"] == 0
    assert config["reach"] > 0
    assert "cells" not in config
    known = next(f["properties"]["segment_id"] for f in features if f["properties"]["environment"])
    told = [run("explain", out, known) for out in outs[:3]]
    assert all(t.code == 0 for t in told)
    assert told[0].out == told[1].out == told[2].out
    assert outs[3].read_bytes().startswith(b"\x89PNG")
    assert known in outs[4].read_text()


def test_the_rdf_conforms_to_the_shapes(run: Any, small: Path, tmp_path: Path) -> None:
    pytest.importorskip("pyshacl", reason="needs symboslam[shapes]")
    out = tmp_path / "map.ttl"
    assert run("classify", small, "--segmentation", "branch", "--out", out).code == 0
    done = run("validate", out)
    assert done.code == 0, done.out
    assert "conforms" in done.out


def test_seed_momentum_and_reach_are_taken(run: Any, small: Path, tmp_path: Path) -> None:
    out, again = tmp_path / "a.geojson", tmp_path / "b.geojson"
    place = json.loads(small.read_text())["features"][0]["geometry"]["coordinates"]
    options = ["--segmentation=branch", f"--seed-position={place[0]},{place[1]}",
               "--momentum=2", "--reach=55"]  # fmt: skip
    for target in (out, again):
        done = run("classify", small, *options, "--out", target)
        assert done.code == 0, done.err
    assert out.read_bytes() == again.read_bytes()
    config = json.loads(out.read_text())["symboslam"]["config"]
    assert config["seed_position"] == place
    assert (config["momentum"], config["reach"]) == (2, 55)


@pytest.mark.parametrize(
    ("option", "told"),
    [
        ("--seed-position=1", "X,Y"),
        ("--seed-position=a,b", "X,Y"),
        ("--seed-position=nan,1", "seed_position"),
        ("--seed-position=200,10", "out of range"),
        ("--momentum=-1", "momentum"),
        ("--reach=0", "reach"),
        ("--segmentation=voronoi", "grid, branch"),
    ],
)
def test_options_that_cannot_be(
    run: Any, small: Path, tmp_path: Path, option: str, told: str
) -> None:
    out = tmp_path / "map.geojson"
    done = run("classify", small, "--segmentation=branch", option, "--out", out)
    assert done.code == 2
    assert told in done.err
    assert "Traceback" not in done.err
    assert not out.exists()


def test_the_help_lists_the_segmentations(run: Any) -> None:
    assert "grid, branch" in run("classify", "--help").out
