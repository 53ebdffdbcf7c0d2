"""NDJSON logs: records as agents write them are read as a mission."""

from __future__ import annotations

import gzip
import json
import math
from pathlib import Path
from typing import Any

import pytest

from symboslam.engine.slam.log import ROBOT
from symboslam.engine.slam.readers import format_of, read_mission
from symboslam.errors import InputError

RECORDS: list[dict[str, Any]] = [
    {"time": 1, "odometry": [0, 0, 0]},
    {"time": 1, "class": "Tree", "range": 5, "bearing": 0.5, "confidence": 0.8, "key": "7b"},
    {"time": 3, "odometry": [2, 0, 0.1]},
    {"time": 2, "odometry": [1, 0, 0]},
    {"time": 2.5, "class": "Robot", "bearing": 0.2},
    {"time": 3, "fix": [10, 20, 1.5]},
]


def write(file: Path, records: list[dict[str, Any]]) -> Path:
    text = "".join(json.dumps(each) + "\n" for each in records)
    file.write_bytes(gzip.compress(text.encode()) if file.suffix == ".gz" else text.encode())
    return file


@pytest.mark.parametrize("name", ["r1.ndjson", "r1.jsonl", "r1.ndjson.gz"])
def test_every_record_is_read(tmp_path: Path, name: str) -> None:
    mission, notes = read_mission(write(tmp_path / name, RECORDS))
    (log,) = mission.robots
    assert log.name == "r1"
    assert log.start is None
    assert log.odometry.time.tolist() == [1, 2, 3]
    assert log.odometry.pose.tolist() == [[0, 0, 0], [1, 0, 0], [2, 0, 0.1]]
    assert mission.classes == ("Tree",)
    assert log.seen.feature.tolist() == [0, ROBOT]
    assert log.seen.time.tolist() == [1, 2.5]
    assert log.seen.range[0] == 5
    assert math.isnan(log.seen.range[1])
    assert log.seen.bearing.tolist() == [0.5, 0.2]
    assert log.seen.confidence.tolist() == [0.8, 1.0]
    assert log.seen.key.tolist() == ["7b", ""]
    assert log.fixes is not None
    assert log.fixes.xy.tolist() == [[10, 20]]
    assert log.fixes.sigma.tolist() == [1.5]
    assert any("odometry: time goes back at 1 row" in note for note in notes)


def test_what_cannot_be_read_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="it holds no odometry"):
        read_mission(write(tmp_path / "a.ndjson", RECORDS[1:2]))
    with pytest.raises(InputError, match=r"none\.ndjson cannot be read: No such file"):
        read_mission(tmp_path / "none.ndjson")
    one, other = write(tmp_path / "a.ndjson", RECORDS), write(tmp_path / "a.jsonl", RECORDS)
    with pytest.raises(InputError, match="another log of a robot 'a'"):
        read_mission([one, other])
    (tmp_path / "b.ndjson.gz").write_bytes(b"x")
    with pytest.raises(InputError, match=r"b\.ndjson\.gz cannot be read"):
        read_mission(tmp_path / "b.ndjson.gz")
    whole = gzip.compress(one.read_bytes(), mtime=0)
    for damaged in (whole[:-20], whole[:12] + b"\xff" * 9 + whole[21:]):
        (tmp_path / "b.ndjson.gz").write_bytes(damaged)
        with pytest.raises(InputError, match=r"b\.ndjson\.gz cannot be read"):
            read_mission(tmp_path / "b.ndjson.gz")


def test_files_of_several_robots_tell_their_format(tmp_path: Path) -> None:
    assert format_of([tmp_path / "a.ndjson", tmp_path / "b.jsonl.gz"]) == "ndjson"
    assert format_of([tmp_path / "odometry.csv", tmp_path / "b.ndjson"]) == "csv"
    with pytest.raises(InputError, match=r"a\.tum: several files at once are read of CSV and"):
        format_of([tmp_path / "a.tum", tmp_path / "b.tum"])


def test_each_sighting_keeps_its_own_deviations(tmp_path: Path) -> None:
    records = [
        {"time": 1, "odometry": [0, 0, 0]},
        {"time": 2, "class": "Tree", "range": 5, "bearing": 0.5, "sigma": [0.3, 0.01]},
        {"time": 1, "class": "Tree", "range": 6, "bearing": 0.5},
    ]
    mission, _ = read_mission(write(tmp_path / "r.ndjson", records))
    assert mission.robots[0].seen.sigmas.tolist() == [[0.5, 0.02], [0.3, 0.01]]
    mission, _ = read_mission(write(tmp_path / "s.ndjson", [records[0], records[2]]))
    assert mission.robots[0].seen.sigma_range == 0.5
