"""TUM trajectories."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from symboslam.engine.slam.readers import format_of, read_mission
from symboslam.engine.slam.readers.tum import read_trajectory
from symboslam.errors import InputError

Write = Callable[..., Path]


def test_by_hand(write: Write) -> None:
    path = write("a.txt", "# t\n3 3 4 0.1 0 0 2 2\n1 1 2 0 0 0 0 1\n1 1 2 0 0 0 0 1\n")
    assert format_of(path) == "tum"
    found, notes = read_trajectory(path)
    assert found.time.tolist() == [1, 3]
    assert found.pose == pytest.approx(np.array([[1, 2, 0], [3, 4, np.pi / 2]]))
    assert notes == [
        "a.txt: 1 repeated row left out",
        "a.txt: time goes back at 1 row, by up to 2 s; rows were sorted by time",
    ]
    mission, _ = read_mission(path)
    assert mission.robots[0].start == (1, 2, 0)
    assert len(mission.robots[0].seen) == 0


def test_hills_are_told(write: Write) -> None:
    _, notes = read_trajectory(write("a.tum", "1 0 0 0 0 0 0 1\n2 0 0 5 0 0 0 1\n"))
    assert notes == ["a.tum: poses climb by 5.0 m and tilt by up to 0.00 rad; they were brought "
                     "down to the plane"]  # fmt: skip


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        ("1 0 0 0 0.5 0.5 0.5 0.5\n", "poses tilt by 1.57 rad"),
        ("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 0 0\n", "line 2: the quaternion is 0"),
        ("1 0 0 0 0 0 1\n", "line 1: this row has 7 columns, 8 are needed"),
        ("nan 0 0 0 0 0 0 1\n", "no row can be read"),
        ("# comments alone\n", "no row can be read"),
    ],
)
def test_what_is_refused(write: Write, content: str, problem: str) -> None:
    path = write("a.tum", content)
    with pytest.raises(InputError) as error:
        read_trajectory(path)
    assert problem in str(error.value)
