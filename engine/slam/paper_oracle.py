"""The paper's oracle: from time to time robots are told where they really are."""

from __future__ import annotations

import numpy as np

from symboslam.engine.slam.log import Floats, Mission, RobotLog
from symboslam.engine.slam.odometry import pose_at
from symboslam.engine.slam.planar import between, compose
from symboslam.engine.slam.slam_map import Trajectory
from symboslam.errors import InputError


def path_with_oracle(log: RobotLog, truth: Floats, every: float) -> Trajectory:
    """Where the robot was by its odometry, which is reset to the true pose every so many seconds.

    Resets are at the beginning and at each whole multiple of ``every`` seconds after it, as far as
    the truth goes. Before the first of them the known start holds, and where there is none what
    the first reset says of the beginning.

    Args:
        log: of the robot.
        truth: (n, 4) time, x, y, heading; n >= 1.
        every: seconds, > 0.
    """
    time, pose = log.odometry.time, log.odometry.pose
    if not len(time):
        return Trajectory(time, pose)
    resets = np.arange(time[0], time[-1], every) if time[-1] > time[0] else time[:1]
    resets = resets[(resets >= truth[0, 0]) & (resets <= truth[-1, 0])]
    if not len(resets):
        resets = truth[:1, 0]
    believed = pose_at(time, pose, resets)
    real = pose_at(truth[:, 0], truth[:, 1:], resets)
    if log.start is not None and resets[0] > time[0]:
        believed = np.concatenate([pose[:1], believed])
        real = np.concatenate([[log.start], real])
        resets = np.concatenate([time[:1], resets])
    last = (np.searchsorted(resets, time, side="right") - 1).clip(0)
    return Trajectory(time, compose(real[last], between(believed[last], pose)))


def true_path(mission: Mission, robot: str) -> Floats:
    """(n, 4) where a robot really was.

    Raises:
        InputError: the mission does not have it.
    """
    truth = None if mission.truth is None else mission.truth.trajectories.get(robot)
    if truth is None or not len(truth):
        raise InputError(
            f"robot {robot}: the oracle needs its true path, which this mission does not have; "
            "go without the oracle, or give the truth"
        )
    return truth
