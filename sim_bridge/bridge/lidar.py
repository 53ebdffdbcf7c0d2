"""Lidar: one plane of rays over the half circle ahead."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.sim_bridge.bridge.scene import Scene
from symboslam.sim_bridge.bridge.settings import LidarSpec

Pose = tuple[float, float, float]


@dataclass(frozen=True)
class Scan:
    """A scan.

    Attributes:
        bearing: (n,) radians from the heading, increasing, so from right to left.
        range: (n,) metres; infinity where nothing was hit.
    """

    bearing: NDArray[np.float64]
    range: NDArray[np.float64]


class Lidar:
    """Scans ahead of a robot; the rays begin in front of its own body.

    Args:
        scene: what there is to hit.
        spec: of the lidar.
        noise: standard deviation of a range in metres.
        rng: draws the noise.
        body: the robot's own radius in metres, within which nothing is hit.
    """

    def __init__(
        self,
        scene: Scene,
        spec: LidarSpec,
        rng: np.random.Generator,
        noise: float = 0.03,
        body: float = 0.7,
    ) -> None:
        self._scene, self.spec, self._rng, self._noise = scene, spec, rng, noise
        self._body = body
        rays = round(spec.span / spec.step) + 1
        self._bearing: NDArray[np.float64] = np.asarray(
            (np.arange(rays, dtype=float) - (rays - 1) / 2) * spec.step
        )

    def scan(self, pose: Pose, every: int = 1, reach: float | None = None) -> Scan:
        """Ranges from a pose.

        Args:
            pose: of the robot: metres and radians.
            every: cast only each so-manieth ray.
            reach: metres, if less than the lidar's.
        """
        middle = (len(self._bearing) - 1) // 2
        bearing = self._bearing[middle % every :: every]
        return self._cast(pose, bearing, min(reach or self.spec.reach, self.spec.reach))

    def between(self, pose: Pose, low: float, high: float) -> Scan:
        """The rays between two bearings in radians; at least the one that is nearest to them."""
        inside = (self._bearing >= low) & (self._bearing <= high)
        if not inside.any():
            inside[np.abs(self._bearing - (low + high) / 2).argmin()] = True
        return self._cast(pose, self._bearing[inside], self.spec.reach)

    def _cast(self, pose: Pose, bearing: NDArray[np.float64], reach: float) -> Scan:
        x, y, heading = pose
        angle = bearing + heading
        direction = np.column_stack([np.cos(angle), np.sin(angle), np.zeros(len(angle))])
        origin = np.array([x, y, self.spec.mount])
        begin = (origin + self._body * direction).tolist()
        end = (origin + reach * direction).tolist()
        bullet = self._scene.bullet
        hits = bullet.rayTestBatch(begin, end, physicsClientId=self._scene.client)
        body = np.array([hit[0] for hit in hits])
        share = np.array([hit[2] for hit in hits])
        ranges = self._body + share * (reach - self._body)
        ranges = ranges + self._rng.normal(0, self._noise, len(ranges))
        ranges[body < 0] = math.inf
        return Scan(bearing, np.maximum(ranges, 0.01))
