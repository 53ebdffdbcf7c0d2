"""Interleaving: two drives in one log are found, robots that turn or stand are not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symboslam.engine.slam.control import CollectiveMap
from symboslam.engine.slam.interleaving import OFTEN, jumps
from symboslam.engine.slam.log import Floats, Odometry
from symboslam.engine.slam.simulate import World, simulate


def mixed(pattern: str, rows: int = 60) -> Floats:
    """Two drives, A from (0, 0), B from (40, 10), a metre a row, sorted into one by a pattern."""
    at = {"A": 0, "B": 0}
    found = []
    for n in range(rows):
        which = pattern[n % len(pattern)]
        found.append((at[which], 0.0) if which == "A" else (40.0 + at[which], 10.0))
        at[which] += 1
    return np.array(found, float)


@pytest.mark.parametrize(("pattern", "expected"), [("AB", 58), ("AAB", 38), ("AABB", 28), ("A", 0)])
def test_jumps_there_and_back_are_counted(pattern: str, expected: int) -> None:
    assert jumps(mixed(pattern)) == expected


def test_one_jump_is_none_there_and_back() -> None:
    assert jumps(np.vstack([mixed("A"), mixed("B")])) == 0
    assert jumps(np.zeros((2, 2))) == 0


@given(st.integers(0, 1000), st.booleans())
def test_true_drives_do_not_jump(seed: int, wander: bool) -> None:
    log = simulate(World(robots=1, poses=80, landmarks=0, wander=wander), seed).robots[0]
    assert jumps(log.odometry.pose[:, :2]) < OFTEN


def test_a_log_whose_clock_was_set_back_is_doubted() -> None:
    mission = simulate(World(robots=1, poses=120, side=200.0, landmarks=40, reach=60.0), 3)
    log = mission.robots[0]

    def doubts(time: Floats) -> tuple[str, ...]:
        order = np.argsort(time, kind="stable")
        track = Odometry(time[order], log.odometry.pose[order], log.odometry.noise)
        collective = CollectiveMap(mission.classes, mission.dynamic, mission.similarity)
        collective.add_log(replace(log, odometry=track))
        return collective.solve().doubts

    time = log.odometry.time
    assert not any("jumps there and back" in doubt for doubt in doubts(time))
    first, *_ = doubts(np.where(time < 60, time, time - 49.5))
    assert first.startswith("robot 1: its odometry jumps there and back ")
    assert "the clock was set back" in first
