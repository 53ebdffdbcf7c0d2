"""Factors: what steps, sightings and fixes say, in GTSAM's terms."""

from __future__ import annotations

import math
from collections.abc import Iterable
from functools import lru_cache
from typing import Any

import gtsam
import numpy as np

from symboslam.engine.slam.log import Closures, Floats
from symboslam.engine.slam.pose_graph import Sighting

Graph = Any
"""gtsam.NonlinearFactorGraph."""


def landmark_key(number: int) -> int:
    """The variable of a landmark."""
    return int(gtsam.symbol("l", number))


def pose_key(robot: int, number: int) -> int:
    """The variable of a key pose of a robot, of which there may be 2^24."""
    return int(gtsam.symbol("x", (robot << 40) + number))


def _plain(*sigmas: float) -> Any:
    return gtsam.noiseModel.Diagonal.Sigmas(np.array(sigmas))


@lru_cache(4096)
def _robust(loss: str, width: float, *sigmas: float) -> Any:
    kind = getattr(gtsam.noiseModel.mEstimator, loss)
    return gtsam.noiseModel.Robust.Create(kind.Create(width), _plain(*sigmas))


class Loss:
    """How much a measurement counts that does not fit.

    Args:
        width: of the Cauchy loss in standard deviations; 0 for Huber's, which gives way less and
            so finds its way from far off.
    """

    def __init__(self, width: float) -> None:
        self._loss, self._width = ("Cauchy", width) if width > 0 else ("Huber", 1.345)

    def of(self, *sigmas: float) -> Any:
        """A noise model."""
        return _robust(self._loss, self._width, *sigmas)


def pose(at: Iterable[float]) -> Any:
    """gtsam.Pose2 of x, y, heading."""
    return gtsam.Pose2(*(float(value) for value in at))


def add_start(graph: Graph, key: int, at: Floats, sigma: Iterable[float]) -> None:
    """Where a robot begins."""
    graph.add(gtsam.PriorFactorPose2(key, pose(at), _plain(*(float(s) for s in sigma))))


def add_step(graph: Graph, before: int, after: int, step: Floats, sigma: Floats) -> None:
    """Odometry from one key pose to the next."""
    noise = _plain(*(float(s) for s in sigma))
    graph.add(gtsam.BetweenFactorPose2(before, after, pose(step), noise))


def add_landmark(graph: Graph, key: int, xy: Floats, sigma: float) -> None:
    """That a landmark is somewhere near, so that no system is without a solution."""
    graph.add(gtsam.PriorFactorPoint2(key, np.asarray(xy, float), _plain(sigma, sigma)))


def add_known(graph: Graph, key: int, xy: Floats, covariance: Floats) -> None:
    """Where a landmark is that others have mapped."""
    noise = gtsam.noiseModel.Gaussian.Covariance(np.asarray(covariance, float))
    graph.add(gtsam.PriorFactorPoint2(key, np.asarray(xy, float), noise))


def add_same(graph: Graph, one: int, other: int, sigma: float) -> None:
    """That two landmarks are one."""
    graph.add(gtsam.BetweenFactorPoint2(one, other, np.zeros(2), _plain(sigma, sigma)))


def add_sighting(graph: Graph, key: int, landmark: int, seen: Sighting, loss: Loss) -> None:
    """A landmark seen from a key pose: range, bearing, or both."""
    if math.isnan(seen.bearing):
        graph.add(gtsam.RangeFactor2D(key, landmark, seen.range, loss.of(seen.sigma_range)))
    elif math.isnan(seen.range):
        turn = gtsam.Rot2(seen.bearing)
        graph.add(gtsam.BearingFactor2D(key, landmark, turn, loss.of(seen.sigma_bearing)))
    else:
        noise = loss.of(seen.sigma_bearing, seen.sigma_range)
        turn = gtsam.Rot2(seen.bearing)
        graph.add(gtsam.BearingRangeFactor2D(key, landmark, turn, seen.range, noise))


def add_meeting(graph: Graph, key: int, other: int, seen: Sighting, loss: Loss) -> None:
    """Another robot seen from a key pose."""
    noise = loss.of(seen.sigma_bearing, seen.sigma_range)
    turn = gtsam.Rot2(seen.bearing)
    graph.add(gtsam.BearingRangeFactorPose2(key, other, turn, seen.range, noise))


def add_fix(graph: Graph, key: int, xy: Floats, sigma: float, loss: Loss) -> None:
    """A position from outside, such as GPS."""
    at = gtsam.Pose2(float(xy[0]), float(xy[1]), 0.0)
    graph.add(gtsam.PoseTranslationPrior2D(key, at, loss.of(sigma, sigma)))


def add_closures(
    graph: Graph, keys: list[int], time: Floats, closures: Closures, loss: Loss
) -> None:
    """Relative poses from outside, between the key poses nearest in time."""
    ends = np.clip(np.searchsorted(time, closures.time + 1e-6) - 1, 0, len(time) - 1)
    for (one, other), step, covariance in zip(
        ends.tolist(), closures.step, closures.covariance, strict=True
    ):
        if one != other:
            sigma = np.sqrt(np.diag(covariance)).tolist()
            graph.add(gtsam.BetweenFactorPose2(keys[one], keys[other], pose(step), loss.of(*sigma)))
