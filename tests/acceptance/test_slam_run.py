"""``symboslam slam run`` through the command line, with a stand-in for the estimator."""

from __future__ import annotations

import builtins
import json
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.acceptance.mrclam_set import LANDMARKS, write_set
from tests.acceptance.slam_stand_in import DOUBT, stand_in

ODOMETRY = "time,x,y,heading\n0,0,0,0\n1,1,0,0\n2,2,0,0\n"
DETECTIONS = "time,range,bearing,class,key\n0,5,0,Tree,a\n2,3,0,Tree,a\n2,1,0,Car,b\n"
LINES = (
    '{"time": 0, "odometry": [0, 0, 0]}\n'
    '{"time": 0, "class": "Tree", "range": 5, "bearing": 0, "key": "a"}\n'
    '{"time": 1, "odometry": [1, 0, 0]}\n'
    '{"time": 1, "class": "Tree", "range": 4, "bearing": 0, "key": "a"}\n'
)
GRAPH = "VERTEX2 0 0 0 0\nVERTEX2 1 1.5 0 0\nEDGE2 0 1 1 0 0 1 0 0 1 0 1\n"
G2O = (
    "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_XY 2 3 1\n"
    "EDGE_SE2 0 1 1 0 0 100 0 0 100 0 100\nEDGE_SE2_XY 0 2 3 1 100 0 100\n"
    "EDGE_SE2_XY 1 2 2 1 100 0 100\n"
)


@pytest.fixture(autouse=True)
def _stand_in(monkeypatch: pytest.MonkeyPatch) -> None:
    stand_in(monkeypatch)


@pytest.fixture
def logs(tmp_path: Path) -> Path:
    """A folder of CSV."""
    folder = tmp_path / "logs"
    folder.mkdir()
    (folder / "odometry.csv").write_text(ODOMETRY)
    (folder / "detections.csv").write_text(DETECTIONS)
    return folder


def test_every_format_goes_out(run: Any, tmp_path: Path) -> None:
    outs = [tmp_path / f"m{end}" for end in (".geojson", ".tum", ".g2o", ".ttl")]
    words = [word for out in outs for word in ("--out", out)]
    done = run("slam", "run", write_set(tmp_path / "set", robots=1), *words)
    assert (done.code, done.err) == (0, f"doubt: {DOUBT}\n")
    told = done.out.splitlines()
    assert told[0] == f"1 of 1 robot placed, {LANDMARKS} landmarks, 1 doubt"
    assert "stood in" in told
    assert told[-4:] == [f"wrote {out}" for out in outs]
    assert all(out.stat().st_size > 100 for out in outs)


def test_what_formats_come_in(run: Any, logs: Path, tmp_path: Path) -> None:
    lines = (("a.graph", GRAPH), ("b.g2o", G2O), ("c.txt", GRAPH), ("d.ndjson", LINES))
    for name, text in (*lines, ("e.log", LINES)):
        (tmp_path / name).write_text(text)
    for source, landmarks in (
        (logs, 1),
        (tmp_path / "a.graph", 0),
        (tmp_path / "b.g2o", 1),
        (tmp_path / "c.txt", 0),
        (tmp_path / "d.ndjson", 1),
        (tmp_path / "e.log", 1),
        (write_set(tmp_path / "set"), LANDMARKS),
    ):
        done = run("slam", "run", source, "--json")
        assert done.code == 0, done
        assert json.loads(done.out)["landmarks"] == landmarks, source


def test_logs_of_agents_are_robots_by_their_names(run: Any, tmp_path: Path) -> None:
    for name in ("r1.ndjson", "r2.jsonl"):
        (tmp_path / name).write_text(LINES + "what is that?\n")
    done = run("slam", "run", tmp_path / "r1.ndjson", tmp_path / "r2.jsonl", "--json")
    found = json.loads(done.out)
    assert [(r["name"], r["sightings"]) for r in found["robots"]] == [("r1", 2), ("r2", 2)]
    assert found["starts"] == {"r1": "first", "r2": "none"}
    assert sum("line 5 is left out: it is no JSON" in note for note in found["notes"]) == 2


def test_json(run: Any, logs: Path, tmp_path: Path) -> None:
    out = tmp_path / "m.geojson"
    done = run("slam", "run", logs, "--out", out, "--json")
    assert (done.code, done.err) == (0, f"doubt: {DOUBT}\n")
    found = json.loads(done.out)
    assert found.pop("seconds") >= 0
    assert [robot.pop("name") for robot in found["robots"]]
    assert "stood in" in found.pop("notes")
    placed = {"placed": True, "poses": 3, "sightings": 3, "sightings_of_landmarks": 3}
    assert found == {
        "method": "ours",
        "starts": {"Robot 1": "first"},
        "robots_lost": [],
        "robots": [placed],
        "landmarks": 1,
        "moving": 1,
        "doubts": [DOUBT],
        "files": [str(out)],
    }


def test_robots_that_have_no_place(run: Any, tmp_path: Path) -> None:
    done = run("slam", "run", write_set(tmp_path / "set"), "--starts", "first", "--json")
    robots = json.loads(done.out)["robots"]
    assert [(r["name"], r["placed"], r["poses"] > 0) for r in robots] == [
        ("Robot 1", True, True),
        ("Robot 2", False, False),
    ]


def test_other_methods(run: Any, tmp_path: Path) -> None:
    source = write_set(tmp_path / "set", drift=0.02)
    places = {}
    for name, words in {
        "dead reckoning": ["--method", "dead-reckoning"],
        "paper": ["--method", "paper"],
        "oracle": ["--method", "paper", "--oracle"],
    }.items():
        out = tmp_path / "m.geojson"
        done = run("slam", "run", source, *words, "--out", out, "--classes", 8)
        assert done.code == 0, done
        assert "stood in" not in done.out
        places[name] = json.loads(out.read_text())["features"]
    assert len(places["dead reckoning"]) > len(places["paper"]) >= LANDMARKS
    assert places["oracle"] != places["paper"]


def test_moving_things_are_told(run: Any, logs: Path) -> None:
    done = run("slam", "run", logs)
    assert done.out.splitlines()[0] == "1 of 1 robot placed, 1 landmark, 1 that move, 1 doubt"


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["nowhere"], "nowhere"),
        (["empty"], "holds none of the files that tell a format"),
        (["prose.txt"], "neither name nor first line tell the format"),
        (["logs", "--oracle"], "give --method paper too"),
        (["logs", "--method", "paper", "--oracle"], "the oracle needs its true path"),
        (["logs", "--method", "magic"], "magic"),
        (["logs", "--classes", "3"], "the format csv has no option 'classes'"),
        (["logs", "--out", "a.bin"], "no format has this ending"),
        (["logs", "--out", "no/a.tum"], "no/a.tum"),
        (["logs", "--out", "a.geojson", "--origin", "here"], "give two numbers LON,LAT"),
        (["logs", "--origin", "1,2"], "--origin is for GeoJSON"),
        (["a.g2o", "--out", "a.g2o"], "is an input"),
        (["a.g2o", "a.graph"], "odometry"),
    ],
)
def test_bad_input(
    run: Any,
    logs: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    words: list[str],
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty").mkdir()
    (tmp_path / "prose.txt").write_text("This is prose.\n")
    (tmp_path / "a.g2o").write_text(G2O)
    (tmp_path / "a.graph").write_text(GRAPH)
    before = sorted(tmp_path.iterdir())
    done = run("slam", "run", *words)
    assert (done.code, done.out) == (2, ""), done
    assert message in done.err
    assert sorted(tmp_path.iterdir()) == before


def test_gtsam_is_an_extra(run: Any, logs: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    genuine = builtins.__import__

    def without(name: str, *rest: Any, **named: Any) -> Any:
        if name == "symboslam.engine.slam.estimate":
            raise ModuleNotFoundError("No module named 'gtsam'", name="gtsam")
        return genuine(name, *rest, **named)

    monkeypatch.delitem(sys.modules, "symboslam.engine.slam.estimate")
    monkeypatch.setattr(builtins, "__import__", without)
    done = run("slam", "run", logs)
    assert done.code == 2
    assert "gtsam is not installed: pip install 'symboslam[slam]'" in done.err
