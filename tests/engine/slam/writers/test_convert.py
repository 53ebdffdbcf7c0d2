"""``symboslam slam convert``."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from symboslam.cli.main import app
from symboslam.engine.slam.readers import read_mission
from symboslam.errors import GeometryError, InputError, OutputError

ODOMETRY = "time,x,y,heading\n0,0,0,0\n1,1,0,0\n2,2,0,0\n"
DETECTIONS = "time,range,bearing,class,key\n0,5,0,Tree,a\n2,3,0,Tree,a\n2,1,0,Yeti,b\n"


@pytest.fixture
def logs(tmp_path: Path) -> Path:
    folder = tmp_path / "logs"
    folder.mkdir()
    (folder / "odometry.csv").write_text(ODOMETRY)
    (folder / "detections.csv").write_text(DETECTIONS)
    return folder


def convert(*words: str | Path) -> None:
    app(["slam", "convert", *map(str, words)], standalone_mode=False)


def test_logs_to_landmarks(logs: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    target, paths = tmp_path / "a.geojson", tmp_path / "p.geojson"
    convert(logs, target, "--paths", paths, "--every", "1.5")
    told = capsys.readouterr().out.splitlines()
    assert told[0] == "1 robot, 3 poses, 3 sightings of 2 classes"
    assert "classes that the ontology does not know, kept as they are: Yeti (1)" in told
    assert told[-2:] == [f"wrote {target}", f"wrote {paths}"]
    features = json.loads(target.read_text())["features"]
    assert [f["geometry"]["coordinates"] for f in features] == [[5, 0], [3, 0]]
    assert json.loads(paths.read_text())["features"][0]["properties"]["time"] == [0, 2]


@pytest.mark.parametrize("name", ["a.tum", "a.g2o", "a.ttl"])
def test_other_formats(logs: Path, tmp_path: Path, name: str) -> None:
    convert(logs, tmp_path / name)
    assert (tmp_path / name).stat().st_size > 100


def test_the_estimate_of_a_graph_counts(tmp_path: Path) -> None:
    source = tmp_path / "a.graph"
    source.write_text("VERTEX2 0 0 0 0\nVERTEX2 1 1.5 0 0\nEDGE2 0 1 1 0 0 1 0 0 1 0 1\n")
    convert(source, tmp_path / "b.txt", "--to", "tum")
    log = read_mission(tmp_path / "b.txt")[0].robots[0]
    assert log.odometry.pose.tolist() == [[0, 0, 0], [1.5, 0, 0]]


def test_what_is_refused(logs: Path, tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="no format has this ending"):
        convert(logs, tmp_path / "a.bin")
    with pytest.raises(OutputError, match="is an input"):
        convert(logs / "odometry.csv", logs / "odometry.csv", "--to", "tum")
    with pytest.raises(GeometryError, match="give two numbers LON,LAT"):
        convert(logs, tmp_path / "a.geojson", "--origin", "here")
    with pytest.raises(InputError, match="the format csv has no option 'classes'"):
        convert(logs, tmp_path / "a.geojson", "--classes", "3")
    with pytest.raises(OutputError, match="the format g2o has no option 'origin'"):
        convert(logs, tmp_path / "a.g2o", "--origin", "1,2")
    assert sorted(p.name for p in tmp_path.iterdir()) == ["logs"]


def test_robots_of_set_6_and_back(shared: Path, tmp_path: Path) -> None:
    """Odometry and ranges of two robots of MRCLAM 6, thinned to 20 s, are the same behind g2o."""
    source, target = tmp_path / "set", tmp_path / "a.g2o"
    source.mkdir()
    for file in (shared / "data" / "mrclam6").iterdir():
        if file.name.startswith(("Barcodes", "Landmark", "Robot1", "Robot4")):
            (source / file.name).symlink_to(file)
    convert(source, target, "--every", "20", "--start", "first")
    mission, _ = read_mission(target)
    assert [log.start is not None for log in mission.robots] == [True, False]
    own, _ = read_mission(source)
    for before, after in zip(own.robots, mission.robots, strict=True):
        assert after.odometry.pose[-1] == pytest.approx(before.odometry.pose[-1], abs=1e-6)
        ranges = before.seen.range[before.seen.feature >= 0]
        assert np.sort(after.seen.range) == pytest.approx(np.sort(ranges))


def test_starting_up_loads_nothing_heavy() -> None:
    code = (
        "import sys, symboslam.cli.main\n"
        "heavy = {'gtsam', 'spark_dsg', 'scipy', 'pyproj', 'rdflib'}\n"
        "sys.exit(' '.join(heavy & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.stderr.strip() == ""
