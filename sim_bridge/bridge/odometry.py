"""Odometry: what wheels, IMU and GPS tell of how a robot truly moved."""

from __future__ import annotations

import math

import numpy as np

from symboslam.engine.slam.log import OdometryNoise
from symboslam.engine.slam.planar import between, compose
from symboslam.sim_bridge.bridge.settings import GpsSpec, OdometrySpec

Pose = tuple[float, float, float]


class WheelOdometry:
    """Adds up noisy steps: the way by the wheels, the heading by the IMU.

    Args:
        start: the true pose at the beginning: metres and radians.
        spec: of the noise.
        rng: draws it, first the biases.

    Attributes:
        pose: in a frame of its own that begins at (0, 0, 0).
    """

    def __init__(self, start: Pose, spec: OdometrySpec, rng: np.random.Generator) -> None:
        self._spec, self._rng, self._last = spec, rng, start
        self._scale = 1 + spec.way_bias * float(rng.choice([-1, 1]))
        self._drift = spec.turn_bias / spec.step * float(rng.choice([-1, 1]))
        self.pose: Pose = (0.0, 0.0, 0.0)

    def move(self, true: Pose) -> Pose:
        """The pose by odometry, after the robot truly went to a pose."""
        spec, rng = self._spec, self._rng
        along, across, turn = between(self._last, true).tolist()
        self._last = true
        way = math.hypot(along, across)
        share = math.sqrt(way / spec.step)  # variances add up along the way
        factor = self._scale + rng.normal() * spec.way_noise * share / max(way / spec.step, 1e-9)
        factor = factor if way > 0 else 1.0
        turned = turn * (1 + rng.normal() * spec.turn_scale)
        turned += self._drift * way + rng.normal() * spec.turn_noise * share
        x, y, heading = compose(self.pose, (along * factor, across * factor, turned)).tolist()
        self.pose = (x, y, heading)
        return self.pose


def noise_of(spec: OdometrySpec) -> OdometryNoise:
    """What the noise comes to for map building, for steps of ``spec.step`` metres."""
    return OdometryNoise(
        along=math.hypot(spec.way_noise, spec.way_bias),
        across=0.006,  # a turn in mid-step
        turn=spec.turn_scale,
        drift=math.hypot(spec.turn_noise, spec.turn_bias) / spec.step,
        floor=(0.01, 0.01, 1e-4),
    )


class Gps:
    """Fixes with white noise.

    Args:
        spec: of the receiver.
        rng: draws the noise.
    """

    def __init__(self, spec: GpsSpec, rng: np.random.Generator) -> None:
        self.spec, self._rng = spec, rng
        self._next = 0.0

    def fix(self, time: float, true: Pose) -> tuple[float, float] | None:
        """X and y in metres if a fix is due at a time in seconds, else None."""
        if time + 1e-9 < self._next:
            return None
        self._next += 1 / self.spec.rate
        dx, dy = self._rng.normal(0, self.spec.sigma, 2).tolist()
        return true[0] + dx, true[1] + dy
