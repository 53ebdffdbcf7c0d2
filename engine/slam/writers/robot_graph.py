"""RobotGraph: a robot's trajectory as the vertices of a pose graph, and what hangs on them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from symboslam.engine.slam.log import Floats, Ints, Mission, RobotLog
from symboslam.engine.slam.odometry import pose_at
from symboslam.engine.slam.planar import between, compose
from symboslam.engine.slam.slam_map import SlamMap, Trajectory

SMALLEST = 1e-6
"""Least standard deviation of a step, in metres and radians: files want matrices with an inverse.
"""


@dataclass(frozen=True)
class RobotGraph:
    """One robot's part of a pose graph.

    Attributes:
        log: its log.
        time: (n,) of its vertices: poses of the trajectory, and wherever something was measured.
        pose: (n, 3) estimates.
        step: (n - 1, 3) from each vertex to the next, by odometry.
        sigma: (n - 1, 3) standard deviations of the steps.
        seen: (s,) rows of ``log.seen`` that are of a landmark.
        landmark: (s,) position of that landmark.
        seen_from: (s,) vertex from which each was seen.
        closed: (k, 2) vertices that the closures lie between.
        fixed: (g,) vertices of the fixes.
    """

    log: RobotLog
    time: Floats
    pose: Floats
    step: Floats
    sigma: Floats
    seen: Ints
    landmark: Ints
    seen_from: Ints
    closed: Ints
    fixed: Ints

    def __len__(self) -> int:
        return len(self.time)


def graphs_of(slam_map: SlamMap, mission: Mission, keyframes: bool = False) -> list[RobotGraph]:
    """The graphs of all robots that the map places.

    Args:
        slam_map: the map.
        mission: the logs that it was made of.
        keyframes: of a trajectory only the first and last pose and those from which something was
            measured.
    """
    return [
        _graph(slam_map, log, slam_map.trajectories[log.name], keyframes)
        for log in mission.robots
        if log.name in slam_map.trajectories
    ]


def _graph(slam_map: SlamMap, log: RobotLog, path: Trajectory, keyframes: bool) -> RobotGraph:
    landmark = slam_map.landmark_of.get(log.name, np.full(len(log.seen), -1))
    seen = np.flatnonzero(landmark >= 0)
    closures = np.zeros((0, 2)) if log.closures is None else log.closures.time
    fixes = np.zeros(0) if log.fixes is None else log.fixes.time
    kept = path.time[[0, -1]] if keyframes and len(path.time) else path.time
    when = log.seen.time[seen]
    time: Floats = np.unique(np.concatenate([kept, when, closures.ravel(), fixes]))
    driven = pose_at(log.odometry.time, log.odometry.pose, time)
    step = between(driven[:-1], driven[1:])
    return RobotGraph(
        log=log,
        time=time,
        pose=_poses(log, path, time, driven),
        step=step,
        sigma=np.maximum(log.odometry.noise.sigmas(step), SMALLEST),
        seen=seen,
        landmark=landmark[seen],
        seen_from=np.searchsorted(time, when),
        closed=np.searchsorted(time, closures),
        fixed=np.searchsorted(time, fixes),
    )


def _poses(log: RobotLog, path: Trajectory, time: Floats, driven: Floats) -> Floats:
    """(n, 3) estimates at times; between two of the trajectory's, odometry leads on."""
    before = np.clip(np.searchsorted(path.time, time, side="right") - 1, 0, None)
    known = pose_at(log.odometry.time, log.odometry.pose, path.time)
    return compose(path.pose[before], between(known[before], driven))
