"""``symboslam sim run`` end to end, in a small world."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from symboslam.cli.main import app
from symboslam.engine.readers import read_landmarks
from symboslam.engine.slam.readers import read_mission
from symboslam.errors import InputError, MissingExtraError, OutputError
from symboslam.reasoning.knowledge import Knowledge
from symboslam.sim_bridge.mission.survey import classify_survey
from symboslam.sim_bridge.worlds.generator import world_by_name
from symboslam.sim_bridge.worlds.world_file import read_world, write_world

pytest.importorskip("pybullet", reason="pybullet is not installed: pip install 'symboslam[sim]'")
pytest.importorskip("gtsam", reason="gtsam is not installed: pip install 'symboslam[slam]'")

SHORT = ("--time-limit", "0.3", "--robots", "2")


def run(*arguments: object) -> str:
    """What the command prints."""
    result = CliRunner().invoke(app, ["sim", "run", *map(str, arguments)], catch_exceptions=False)
    assert result.exit_code == 0, result.output
    return result.stdout


def fails(*arguments: object) -> BaseException:
    """The error that the command ends with."""
    result = CliRunner().invoke(app, ["sim", "run", *map(str, arguments)])
    assert result.exception is not None
    return result.exception


def events(folder: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in (folder / "events.ndjson").read_text().splitlines()]


def yard(path: Path, **more: object) -> Path:
    """A small world with a house in its middle."""
    document: dict[str, object] = {
        "format": "symboslam-world",
        "version": 1,
        "name": "yard",
        "extent": [0, 0, 120, 120],
        "zones": [
            {
                "environment": "Residential",
                "polygon": [[[0, 0], [120, 0], [120, 120], [0, 120], [0, 0]]],
            }
        ],
        "objects": [
            {"id": "house", "class": "House", "x": 60, "y": 60},
            {"id": "tree", "class": "Tree", "x": 90, "y": 30},
            {"id": "bus", "class": "Bus", "x": 30, "y": 95},
        ],
        "starts": [{"x": 20, "y": 20, "heading": 0.8}],
    }
    path.write_text(json.dumps(document | more))
    return path


CAT = {"id": "cat", "class": "Cat", "x": 118, "y": 118}  # too small to be seen from afar


def test_a_whole_mission(tmp_path: Path) -> None:
    record, page = tmp_path / "record", tmp_path / "map.html"
    args = ("demo", "--time-limit", 1.5, "--seed", 2, "--record", record, "--out", page)
    metrics = json.loads(run(*args, "--json"))
    assert metrics["ended"] == "time"
    assert metrics["time_s"] == 90
    assert metrics["objects"] == 80
    assert 0.3 < metrics["coverage"] <= 1
    assert metrics["objects_found"] > 30
    assert metrics["slam"]["landmark_mean_m"] < 8
    assert metrics["slam"]["robots_missing"] == []
    assert metrics["map"]["grid"]["cells"] > 300
    assert set(metrics["map"]["branch"]["all"]) >= {"mean_iou", "mean_ap"}
    assert metrics == json.loads((record / "metrics.json").read_text())
    assert "<html" in page.read_text()[:200]

    mission, notes = read_mission(record, "csv", knowledge=Knowledge.load())
    assert [log.name for log in mission.robots] == ["robot 1", "robot 2", "robot 3"]
    assert all(len(log.odometry) == 181 and log.start is not None for log in mission.robots)
    assert sum(len(log.seen) for log in mission.robots) > 200
    assert notes == []
    for log in mission.robots:
        assert len(set(log.seen.sigmas[:, 1].tolist())) > 3
        assert log.seen.sigmas.min() > 0
    identity = (record / "identity.csv").read_text().splitlines()
    detections = (record / "detections.csv").read_text().splitlines()
    assert len(identity) == len(detections)
    assert len((record / "truth-robot_1.tum").read_text().splitlines()) == 181
    assert read_world(record / "world.json")[0].objects == world_by_name("demo").objects
    assert len((record / "coverage.csv").read_text().splitlines()) == 92
    assert events(record)[-1]["event"] == "end"
    assert json.loads((record / "config.json").read_text())["seed"] == 2
    for name in ("map.geojson", "landmarks.geojson", "zones.geojson", "objects.geojson"):
        assert json.loads((record / name).read_text())["features"]
    landmarks = read_landmarks(record / "landmarks.geojson", Knowledge.load())
    expected = classify_survey(landmarks, Knowledge.load(), "grid")
    config = json.loads((record / "map.geojson").read_text())["symboslam"]["config"]
    assert config["bandwidth"] == expected.config["bandwidth"]
    result = CliRunner().invoke(app, ["slam", "run", str(record), "--json"])
    assert result.exit_code == 0, result.output
    assert json.loads(result.stdout)["landmarks"] > 20


def contents(folder: Path) -> dict[str, bytes]:
    """All that does not hold wall times."""
    return {f.name: f.read_bytes() for f in folder.iterdir() if f.name != "metrics.json"}


@pytest.mark.proof
def test_the_same_seed_gives_the_same_run(tmp_path: Path) -> None:
    one, other, third = (tmp_path / name for name in ("one", "other", "third"))
    run("demo", *SHORT, "--record", one, "--gps")
    run("demo", *SHORT, "--record", other, "--gps")
    run("demo", *SHORT, "--record", third, "--gps", "--seed", 1)
    assert contents(one) == contents(other)
    assert (one / "fixes.csv").read_text().count("\n") > 30
    assert (one / "detections.csv").read_bytes() != (third / "detections.csv").read_bytes()


def test_interrupted_records_can_be_read(tmp_path: Path) -> None:
    record = tmp_path / "record"
    command = [sys.executable, "-m", "symboslam", "sim", "run", "demo", "--record", str(record)]
    # Where the tests run in the background, ctrl-C is ignored, and would be here.
    process = subprocess.Popen(
        command,
        stdout=subprocess.PIPE,
        env=os.environ,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    coverage = record / "coverage.csv"
    until = time.monotonic() + 60
    while not coverage.exists() or coverage.read_text().count("\n") < 10:
        assert process.poll() is None
        assert time.monotonic() < until
        time.sleep(0.1)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    assert process.returncode == 130
    mission, notes = read_mission(record, "csv", knowledge=Knowledge.load())
    assert len(mission.robots) == 3
    assert notes == []
    assert json.loads((record / "metrics.json").read_text())["ended"] == "interrupted"
    assert events(record)[-1]["text"] == "interrupted"
    rows = coverage.read_text().splitlines()
    assert all(row.count(",") == 4 for row in rows)


def test_the_paper_s_ways_to_map(tmp_path: Path) -> None:
    for slam in ("paper", "oracle"):
        world = yard(tmp_path / "w.json")
        metrics = json.loads(
            run(world, "--robots", 1, "--time-limit", 0.2, "--slam", slam, "--json")
        )
        assert metrics["slam"]["method"] == slam
        assert metrics["slam"]["landmarks_mapped"] > 0


def test_a_robot_that_starts_in_a_house_is_moved_out(tmp_path: Path) -> None:
    world = yard(tmp_path / "w.json", starts=[{"x": 61, "y": 60}])
    text = run(world, "--robots", 1, "--time-limit", 0.5)
    assert "start 0 was not free and moved by" in text


def test_all_is_found_and_the_mission_ends(tmp_path: Path) -> None:
    world = yard(tmp_path / "w.json")
    metrics = json.loads(run(world, "--robots", 1, "--time-limit", 10, "--json"))
    assert metrics["ended"] == "all found"
    assert metrics["time_all_found_s"] == metrics["time_s"]
    assert metrics["map"]["grid"]["all"]["accuracy"] > 0.3


def test_a_robot_that_is_walled_in_is_given_up(tmp_path: Path) -> None:
    ring = [[18.8, 18.8], [21.2, 18.8], [21.2, 21.2], [18.8, 21.2], [18.8, 18.8]]
    world = yard(
        tmp_path / "w.json",
        walls=[{"points": ring, "height": 1.2}],
        starts=[{"x": 20, "y": 20}, {"x": 20, "y": 90}],
        objects=[CAT],
    )
    record = tmp_path / "r"
    args = ("--robots", 2, "--time-limit", 1.5, "--search", "random-waypoint", "--record", record)
    text = run(world, *args)
    assert "robot 1: stuck 5 times in one place; it is given up" in text
    kinds = [(e["robot"], e["event"]) for e in events(record)]
    assert kinds.count(("robot 1", "stuck")) == 5
    assert ("robot 2", "given up") not in kinds


def test_a_husky_in_a_yard(tmp_path: Path) -> None:
    args = ("--robot", "husky", "--robots", 1, "--time-limit", 0.2, "--json")
    metrics = json.loads(run(yard(tmp_path / "w.json", objects=[CAT]), *args))
    assert metrics["time_s"] == 12


def test_bad_input(tmp_path: Path) -> None:
    assert isinstance(fails("atlantis"), InputError)
    assert "starts for 1 to 10" in str(fails("demo", "--robots", 11))
    assert "no model is installed" in str(fails("demo", "--detector", "onnx"))
    assert "no search 'magic'" in str(fails("demo", "--search", "magic"))
    assert "--speed" in str(fails("demo", "--speed", 0))
    assert "--time-limit" in str(fails("demo", "--time-limit", 0))
    assert isinstance(fails("demo", "--out", tmp_path / "map.xyz"), OutputError)
    (tmp_path / "letters.txt").write_text("mine")
    assert "holds other files" in str(fails("demo", "--record", tmp_path))
    assert (tmp_path / "letters.txt").read_text() == "mine"
    empty = yard(tmp_path / "e.json", extent=[0, 0, 0, 10])
    assert "extent" in str(fails(empty))


def test_without_pybullet_it_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pybullet", None)
    error = fails("demo")
    assert isinstance(error, MissingExtraError)
    assert "symboslam[sim]" in str(error)


def test_worlds_of_others_get_starts(tmp_path: Path) -> None:
    path = tmp_path / "w.json"
    write_world(read_world(yard(tmp_path / "y.json", starts=[]))[0], path)
    assert "robot" not in run(path, "--robots", 2, "--time-limit", 0.05)
