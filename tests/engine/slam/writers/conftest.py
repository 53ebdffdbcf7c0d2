"""A small mission and its map, and missions that hypothesis makes up."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from symboslam.engine.slam.log import (
    ROBOT,
    Closures,
    Fixes,
    Measurements,
    Mission,
    Odometry,
    OdometryNoise,
    RobotLog,
)
from symboslam.engine.slam.slam_map import MappedLandmarks, SlamMap, Trajectory

HALF = np.pi / 2


@pytest.fixture
def mission() -> Mission:
    """Robot A drives 2 m ahead and turns; é stands still. Trees, a car, and a robot are seen."""
    a = RobotLog(
        "Robot A",
        Odometry(
            np.array([10.0, 11, 12]),
            np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, HALF]]),
            OdometryNoise(0, 0, 0, 0, (0.1, 0.05, 0.02)),
        ),
        Measurements(
            time=np.array([10.0, 11.5, 12, 12, 12]),
            range=np.array([5.0, 2, np.nan, 3, 1]),
            bearing=np.array([0.0, HALF, 0.5, np.nan, 0]),
            feature=np.array([0, 1, 0, 0, ROBOT]),
            confidence=np.array([0.9, 0.8, 0.7, 0.6, 1]),
            key=np.array(["", "", "sign", "", ""], object),
            sigma_range=0.2,
            sigma_bearing=0.1,
        ),
        start=(1.0, 1, 0),
        fixes=Fixes(np.array([12.0]), np.array([[3.0, 1]]), np.array([0.5])),
        closures=Closures(
            np.array([[10.0, 12]]), np.array([[2.0, 0.1, 1.5]]), np.diag([0.01, 0.04, 0.25])[None]
        ),
    )
    none = np.zeros(0)
    nothing = Measurements(none, none, none, np.zeros(0, np.int64), none, np.zeros(0, object))
    b = RobotLog("é", Odometry(np.array([5.0]), np.zeros((1, 3))), nothing)
    return Mission((a, b), ("Tree", "Car"), np.array([False, True]), np.eye(2))


@pytest.fixture
def slam_map() -> SlamMap:
    """A map of it: Robot A lies 1 m off its start; two trees and a car."""
    landmarks = MappedLandmarks(
        id=np.array(["t1", "t 2", "c1"], object),
        xy=np.array([[6.0, 1], [3, 4.5], [2.5, 3]]),
        covariance=np.array(
            [[[0.04, 0], [0, 0.01]], [[0.02, 0.01], [0.01, 0.02]], np.full((2, 2), np.nan)]
        ),
        feature=np.array([0, 0, 1]),
        confidence=np.array([0.9, 0.7, 0.8]),
        sightings=np.array([1, 2, 1]),
        dynamic=np.array([False, False, True]),
        key=np.array(["", "sign", ""], object),
    )  # fmt: skip
    return SlamMap(
        trajectories={
            "Robot A": Trajectory(
                np.array([10.0, 11, 12]), np.array([[1.0, 1, 0], [2, 1, 0], [3, 1, HALF]])
            ),
            "é": Trajectory(np.array([5.0]), np.array([[7.0, 8, -1]])),
        },
        landmarks=landmarks,
        landmark_of={
            "Robot A": np.array([0, 2, 1, 1, -1]),
            "é": np.zeros(0, np.int64),
        },
        doubts=("it was raining",),
    )


@pytest.fixture(scope="session")
def shared() -> Path:
    """The folder of other people's data."""
    default = Path(__file__).resolve().parents[5] / "shared"
    folder = Path(os.environ.get("SYMBOSLAM_SHARED", default))
    if not folder.is_dir():
        pytest.skip(f"the shared data folder is not here: {folder}")
    return folder
