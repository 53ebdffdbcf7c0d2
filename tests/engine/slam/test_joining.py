"""Joining: a robot whose own map is wrong is found out, and mapped again by what others mapped."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from symboslam.engine.slam.edge_landmarks import Known
from symboslam.engine.slam.edge_map import EdgeMap
from symboslam.engine.slam.estimate import estimate
from symboslam.engine.slam.log import Mission, Pose
from symboslam.engine.slam.odometry import pose_at
from symboslam.engine.slam.run import Run
from symboslam.engine.slam.settings import SlamSettings
from symboslam.engine.slam.simulate import World, simulate
from symboslam.engine.slam.slam_map import SlamMap

pytestmark = pytest.mark.proof

ROOM = World(
    robots=3,
    poses=250,
    side=120.0,
    landmarks=25,
    classes=6,
    reach=50.0,
    turn_noise=float(np.radians(1.5)),
    meetings=True,
)


def off(mission: Mission, found: SlamMap, name: str) -> float:
    """RMSE in metres of a path in the frame of the map."""
    assert mission.truth is not None
    path, got = mission.truth.trajectories[name], found.trajectories[name]
    away = got.pose[:, :2] - pose_at(path[:, 0], path[:, 1:], got.time)[:, :2]
    return float(np.sqrt((away**2).sum(1).mean()))


@pytest.fixture
def confused(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Robot 2 takes most landmarks for others, but not when mapped again; who is mapped again."""
    again: list[str] = []
    right, mapped_again = Run.edge_map, Run.mapped_again

    def edge_map(self: Run, last: bool = False) -> EdgeMap | None:
        edge = right(self, last)
        if edge is not None and self.name == "robot 2":
            names = sorted(set(edge.landmark_of.values()))
            other = dict(zip(names, names[5:] + names[:5], strict=True))
            late = len(edge.tracker.tracks) / 4
            for track, landmark in edge.landmark_of.items():
                edge.landmark_of[track] = other[landmark] if track > late else landmark
        return edge

    def note(self: Run, start: Pose, known: Sequence[Known], certainty: float) -> EdgeMap:
        again.append(self.name)
        return mapped_again(self, start, known, certainty)

    monkeypatch.setattr(Run, "edge_map", edge_map)
    monkeypatch.setattr(Run, "mapped_again", note)
    return again


def test_a_robot_that_is_wrong_is_mapped_again(confused: list[str]) -> None:
    mission = simulate(ROOM, 3)
    found = estimate(mission)
    assert confused == ["robot 2"]
    assert off(mission, found, "robot 2") < 1.0
    assert found.doubts == ()
    left = estimate(mission, SlamSettings(repairs=0))
    assert off(mission, left, "robot 2") > 10.0
    assert any(doubt.startswith("robot 2") for doubt in left.doubts)


def test_nobody_is_mapped_again_without_a_doubt(monkeypatch: pytest.MonkeyPatch) -> None:
    def never(*_: object) -> EdgeMap:
        raise AssertionError("nobody is doubted")

    monkeypatch.setattr(Run, "mapped_again", never)
    assert estimate(simulate(ROOM, 3)).doubts == ()
