"""Logs of other formats are replayed as the robot would have written them."""

from pathlib import Path

import numpy as np
import pytest

from symboslam.engine.slam.log import Measurements, Mission, Odometry, RobotLog
from symboslam.engine.slam.readers.records import OdometryRecord, SightingRecord
from symboslam.errors import InputError
from symboslam.reasoning.knowledge import Knowledge
from symboslam.sim_bridge.agents.replay import is_mission, read, robot_of


def test_what_is_a_mission(tmp_path: Path) -> None:
    assert is_mission(tmp_path)
    for name, text, expected in (
        ("a.ndjson", "x", False), ("a.log", '\n {"time": 1}', False), ("a.g2o", "VERTEX_SE2", True),
    ):  # fmt: skip
        (tmp_path / name).write_text(text)
        assert is_mission(tmp_path / name) is expected
    with pytest.raises(InputError, match="cannot be read"):
        is_mission(tmp_path / "none")


def test_the_robot_of_a_mission() -> None:
    none = np.zeros(0)
    seen = Measurements(none, none, none, np.zeros(0, np.int64), none, np.zeros(0, object))
    logs = [RobotLog(name, Odometry(none, np.zeros((0, 3))), seen) for name in ("r1", "r2")]
    both = Mission((logs[0], logs[1]), (), np.zeros(0, bool), np.eye(0))
    assert robot_of(both, "r2", "x") is logs[1]
    with pytest.raises(InputError, match="x has no robot 'r3'; it has: r1, r2"):
        robot_of(both, "r3", "x")
    one = Mission((logs[0],), (), np.zeros(0, bool), np.eye(0))
    assert robot_of(one, "r3", "x") is logs[0]


def test_a_folder_of_csv(tmp_path: Path) -> None:
    pytest.importorskip("symboslam.engine.slam.readers")
    (tmp_path / "odometry.csv").write_text("time,x,y,heading\n0,0,0,0\n1,1,0,0\n")
    (tmp_path / "detections.csv").write_text(
        "time,range,bearing,class\n1,5,0.1,house\n1,5,1,robot\n"
    )
    (tmp_path / "starts.csv").write_text("robot,x,y,heading\nRobot 1,7,8,0.5\n")
    told: list[str] = []
    records, known = read(tmp_path, "r1", Knowledge.load(), told.append)
    found = list(records)
    assert [type(each) for each in found] == [OdometryRecord] * 2 + [SightingRecord] * 2
    assert [each.feature for each in found if isinstance(each, SightingRecord)] == [
        "House", "Robot"
    ]  # fmt: skip
    assert known["start"] == (7.0, 8.0, 0.5)
    assert set(known) == {"start", "start_sigma", "noise", "sigma_range", "sigma_bearing"}
