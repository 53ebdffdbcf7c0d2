"""Odometry from velocities or steps, and where a robot was by it at any time."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from symboslam.engine.slam.log import Floats
from symboslam.engine.slam.planar import wrap


def arcs(forward: Floats, turning: Floats, duration: Floats) -> Floats:
    """(n, 3) steps of a robot that drives with constant velocities: arcs of circles, exact.

    Args:
        forward: (n,) metres a second.
        turning: (n,) radians a second.
        duration: (n,) seconds.
    """
    way, turn = forward * duration, turning * duration
    ahead = way * np.sinc(turn / np.pi)  # sin(a) / a
    aside = way * np.sin(turn / 2) * np.sinc(turn / 2 / np.pi)  # (1 - cos(a)) / a
    return np.column_stack([ahead, aside, turn])


def chain(start: ArrayLike, steps: Floats) -> Floats:
    """(n + 1, 3) poses that (n, 3) steps lead to, one after the other, from a start."""
    x, y, heading = np.asarray(start, float)
    headings = heading + np.concatenate([[0.0], np.cumsum(steps[:, 2])])
    cos, sin = np.cos(headings[:-1]), np.sin(headings[:-1])
    east = np.cumsum(np.append(x, cos * steps[:, 0] - sin * steps[:, 1]))
    north = np.cumsum(np.append(y, sin * steps[:, 0] + cos * steps[:, 1]))
    return np.column_stack([east, north, wrap(headings)])


def pose_at(time: Floats, pose: Floats, when: ArrayLike) -> Floats:
    """(..., 3) poses at times, between the (n, 3) known ones in a straight line.

    Before the first and behind the last pose the robot stands still.
    """
    at = np.asarray(when, float)
    x, y = (np.interp(at, time, pose[:, i]) for i in (0, 1))
    return np.stack([x, y, wrap(np.interp(at, time, np.unwrap(pose[:, 2])))], -1)
