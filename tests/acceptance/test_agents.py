"""Two robots and a control agent in processes of their own build a map in a service."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest

pytest.importorskip("fastapi", reason="needs symboslam[service]")
pytest.importorskip("gtsam", reason="needs symboslam[slam]")

from symboslam.engine.slam.log import Mission, RobotLog
from symboslam.engine.slam.simulate import World, simulate
from tests.service.conftest import ADMIN, TOKEN
from tests.service.test_durability import serve

pytestmark = pytest.mark.proof

NAMES = (
    "House",
    "Bakery",
    "Bank",
    "Bar",
    "Barn",
    "BellTower",
    "Bench",
    "Billboard",
    "Bollard",
    "Antenna",
)
STREET = World(
    robots=2, poses=200, side=400.0, landmarks=50, classes=len(NAMES), misclassified=0.02
)


def records(mission: Mission, log: RobotLog) -> Iterator[dict[str, Any]]:
    """What a robot would write down."""
    rows: list[dict[str, Any]] = [
        {"time": float(t), "odometry": [float(v) for v in pose]}
        for t, pose in zip(log.odometry.time, log.odometry.pose, strict=True)
    ]
    seen = log.seen
    rows += [
        {
            "time": float(seen.time[n]) + 1e-4, "class": NAMES[seen.feature[n]],
            "range": float(seen.range[n]), "bearing": float(seen.bearing[n]),
            "confidence": float(seen.confidence[n]),
        }
        for n in range(len(seen))
    ]  # fmt: skip
    return iter(sorted(rows, key=lambda row: row["time"]))


def agent(*options: object) -> "subprocess.Popen[str]":
    return subprocess.Popen(
        [sys.executable, "-m", "symboslam", "agent", *map(str, options)],
        text=True, stderr=subprocess.PIPE, env={**os.environ, "SYMBOSLAM_TOKEN": TOKEN},
    )  # fmt: skip


def test_two_robots_build_one_map(tmp_path: Path) -> None:
    mission = simulate(STREET, 3)
    assert mission.truth is not None
    box = [-200, -200, STREET.side + 200, STREET.side + 200]
    with serve(tmp_path / "data") as (_, client):
        wanted = {"name": "street", "bbox": box, "crs": "m", "segmentation": {"cells": 8}}
        made = client.post("/v1/maps", json=wanted, headers=ADMIN).raise_for_status().json()
        url, which = str(client.base_url), made["id"]
        where = ("--map", which, "--to", url)
        running = [agent("control", *where, "--once", "--robots", 2, "--every", 1, "--name", "c")]
        for log in mission.robots:
            file = tmp_path / f"{log.name}.ndjson"
            file.write_text("".join(json.dumps(row) + "\n" for row in records(mission, log)))
            assert log.start is not None
            x, y, heading = log.start
            start = f"{x},{y},{np.degrees(heading)}"
            spool = tmp_path / "spool"
            options = ("--robot", log.name, *where, "--start", start, "--spool", spool)
            running.append(agent("edge", file, *options, "--every", 20, "--sigma-bearing", 0.0175))
        for process in reversed(running):
            _, said = process.communicate(timeout=200)
            assert process.returncode == 0, said
        check(client, which, mission)


def check(client: httpx.Client, which: str, mission: Mission) -> None:
    assert mission.truth is not None
    found = client.get(f"/v1/maps/{which}/landmarks", params={"limit": 1000}).json()["features"]
    true = np.array(list(mission.truth.landmarks.values()))
    names = list(mission.truth.features.values())
    seen = {name for each in mission.identity.values() for name in each}
    off, right = [], 0
    for each in found:
        away = np.hypot(*(true - each["geometry"]["coordinates"]).T)
        nearest = int(away.argmin())
        off.append(away[nearest])
        index = int(names[nearest].split()[-1]) - 1
        right += each["properties"]["class"] == NAMES[index]
    assert len(seen) - 3 <= len(found) <= 1.25 * len(seen)  # a few are there twice
    assert np.mean(off) < 2.5
    assert right >= 0.9 * len(found)
    segments = client.get(f"/v1/maps/{which}/segments").json()["features"]
    assert any(each["properties"]["landmark_count"] for each in segments)
