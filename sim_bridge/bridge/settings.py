"""Settings of simulated robots and sensors; docs/simulation.md gives the reasons."""

from __future__ import annotations

import math
from dataclasses import dataclass, field


@dataclass(frozen=True)
class CameraSpec:
    """A pinhole camera on a turning mount, level.

    Attributes:
        width: of the picture, in points.
        height: likewise.
        fov: angle from the left edge to the right one, in radians.
        mount: metres above the ground.
        near: nearest metres that are drawn.
        far: farthest metres that are drawn; beyond it nothing is seen.
        rate: pictures a second.
        pan: where it looks, picture after picture, in radians to the left of the heading.
    """

    width: int = 320
    height: int = 240
    fov: float = math.radians(90)
    mount: float = 1.5
    near: float = 0.3
    far: float = 100.0
    rate: float = 2.0
    pan: tuple[float, ...] = tuple(math.radians(pan) for pan in (0, 90, -90, 180))

    @property
    def field(self) -> float:
        """Radians around the heading that are seen in one turn of the mount."""
        return min(self.fov + 2 * max(abs(pan) for pan in self.pan), math.tau)

    @property
    def focal(self) -> float:
        """Focal length in points, the same along both axes."""
        return self.width / 2 / math.tan(self.fov / 2)

    @property
    def intrinsics(self) -> tuple[tuple[float, float, float], ...]:
        """The matrix K: focal lengths and the principal point, in points."""
        f = self.focal
        return ((f, 0.0, self.width / 2), (0.0, f, self.height / 2), (0.0, 0.0, 1.0))


@dataclass(frozen=True)
class LidarSpec:
    """A planar lidar that scans the half circle around where it is turned.

    Attributes:
        reach: farthest metres.
        step: radians between two rays.
        span: radians from the first ray to the last, half of it to each side.
        mount: metres above the ground; low, so that a cat is hit.
    """

    reach: float = 100.0
    step: float = math.radians(0.5)
    span: float = math.pi
    mount: float = 0.25


@dataclass(frozen=True)
class OdometrySpec:
    """Noise of the wheels (the way) and the IMU (the heading).

    The same as in ``engine.slam.simulate``, whose steps are 5 m: there each step's way is off by
    3 % and its heading by 0.6 degrees. Here the variance grows with the way, whatever the steps.

    Attributes:
        way_noise: standard deviation of the way of a step of ``step`` metres, as a share.
        way_bias: share by which one robot's way is too long or too short all the time.
        turn_noise: standard deviation of the heading over ``step`` metres, in radians.
        turn_bias: radians by which ``step`` metres turn to the same side all the time.
        turn_scale: standard deviation of a turn, as a share of it.
        step: metres.
    """

    way_noise: float = 0.03
    way_bias: float = 0.01
    turn_noise: float = math.radians(0.6)
    turn_bias: float = math.radians(0.03)
    turn_scale: float = 0.01
    step: float = 5.0


@dataclass(frozen=True)
class GpsSpec:
    """A plain GPS receiver.

    Attributes:
        rate: fixes a second.
        sigma: metres along each axis, independent from fix to fix.
    """

    rate: float = 1.0
    sigma: float = 3.0


@dataclass(frozen=True)
class DetectorSpec:
    """How the segmentation oracle errs.

    Attributes:
        misses: share of visible objects that a picture does not report.
        false_positives: boxes a picture on average that are of nothing.
        confusion: share of the reports that have another class, any with the same chance.
        least_height: lowest box, in points.
        least_points: fewest points of an object that are seen.
        least_share: of a box, the smallest share that the object fills; below it most of the
            object is hidden behind another.
    """

    misses: float = 0.1
    false_positives: float = 0.01
    confusion: float = 0.05
    least_height: int = 5
    least_points: int = 12
    least_share: float = 0.1


@dataclass(frozen=True)
class BridgeSettings:
    """All of a robot's equipment.

    Attributes:
        camera: looks ahead.
        lidar: scans ahead.
        odometry: noise of wheels and IMU.
        gps: the receiver; None for none.
        detector: how the segmentation oracle errs.
        speed: metres a second, at most.
        turn: radians a second, at most.
        radius: of the car's footprint, in metres.
        control: seconds between two commands to the wheels.
    """

    camera: CameraSpec = field(default_factory=CameraSpec)
    lidar: LidarSpec = field(default_factory=LidarSpec)
    odometry: OdometrySpec = field(default_factory=OdometrySpec)
    gps: GpsSpec | None = None
    detector: DetectorSpec = field(default_factory=DetectorSpec)
    speed: float = 10.0
    turn: float = 1.5
    radius: float = 0.7
    control: float = 0.1
