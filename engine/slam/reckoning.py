"""Dead reckoning: where a robot was by its odometry alone, and where what it saw is by that."""

from __future__ import annotations

import numpy as np

from symboslam.engine.slam.log import Floats, Mission, Pose, RobotLog
from symboslam.engine.slam.planar import between, compose, place
from symboslam.engine.slam.slam_map import Trajectory
from symboslam.errors import InputError


def poses_at(time: Floats, pose: Floats, when: Floats) -> Floats:
    """(k, 3) poses at other times, along the straight step from one pose to the next.

    Args:
        time: (n,) seconds, increasing; n >= 1.
        pose: (n, 3) at these times.
        when: (k,) seconds; before the first time the first pose holds, after the last the last.
    """
    if len(time) == 1:
        return np.repeat(pose, len(when), 0)
    i = (np.searchsorted(time, when, side="right") - 1).clip(0, len(time) - 2)
    share = ((when - time[i]) / (time[i + 1] - time[i])).clip(0, 1)
    return compose(pose[i], between(pose[i], pose[i + 1]) * share[:, None])


def path_of(log: RobotLog, start: Pose = (0.0, 0.0, 0.0)) -> Trajectory:
    """Where the robot was if it began at ``start`` and its odometry is right."""
    time, pose = log.odometry.time, log.odometry.pose
    if not len(time):
        return Trajectory(time, pose)
    return Trajectory(time, compose(start, between(pose[0], pose)))


def path_with_oracle(log: RobotLog, truth: Floats, every: float) -> Trajectory:
    """The same with the pose reset to the true one every so many seconds, as the paper's oracle.

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
    believed = poses_at(time, pose, resets)
    real = poses_at(truth[:, 0], truth[:, 1:], resets)
    if log.start is not None and resets[0] > time[0]:
        believed = np.concatenate([pose[:1], believed])
        real = np.concatenate([[log.start], real])
        resets = np.concatenate([time[:1], resets])
    last = (np.searchsorted(resets, time, side="right") - 1).clip(0)
    return Trajectory(time, compose(real[last], between(believed[last], pose)))


def points_of(log: RobotLog, path: Trajectory) -> Floats:
    """(m, 2) where what was seen is, if the path is right; NaN without a range or a bearing."""
    seen = log.seen
    if not len(path.time):
        return np.full((len(seen), 2), np.nan)
    way = np.column_stack([np.cos(seen.bearing), np.sin(seen.bearing)]) * seen.range[:, None]
    return place(poses_at(path.time, path.pose, seen.time), way)


def starts_of(mission: Mission) -> tuple[dict[str, Pose], list[str]]:
    """Where robots began, as far as that is known, and a note for each that has to be left out.

    If no start is known at all, the frame of the map is that of the first robot.
    """
    starts = {log.name: log.start for log in mission.robots if log.start is not None}
    if not starts and mission.robots:
        starts = {mission.robots[0].name: (0.0, 0.0, 0.0)}
    left_out = [log.name for log in mission.robots if log.name not in starts]
    return starts, [
        f"robot {name}: left out, as it is not known where it began" for name in left_out
    ]


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
