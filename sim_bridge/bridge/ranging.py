"""Ranging: from a box in a picture to the range and bearing of the object's middle.

The bearing is that of the box's middle. The range is what lidar rays in the box measure, and half
the nominal depth of the class. The height of the box tells roughly how far such a thing should be;
rays that hit something else do not agree with it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from symboslam.sim_bridge.bridge.detections import Box, Detection
from symboslam.sim_bridge.bridge.lidar import Lidar
from symboslam.sim_bridge.bridge.settings import CameraSpec
from symboslam.sim_bridge.objects.bullet import ROUND
from symboslam.sim_bridge.worlds.sizes import SIZES

SIGMA_RANGE, SHARE_DEPTH = 0.7, 0.2
"""Deviation of a range: metres, and a share of the mean of the class's length and width."""
SIGMA_BEARING, SHARE_WIDTH = 0.01, 0.1
"""Deviation of a bearing: radians, and the angle of that share of the mean side.

The middle of a large thing looks different from each side, and stays wrong from picture to picture.
"""
AGREE = 2.0
"""A ray may measure so many times more or less than the height of the box tells."""
FOOT = 0.8
"""Share by which a range may differ from where the foot of the box is."""
BOX_DEPTH, ROUND_DEPTH = 0.29, 0.25
"""Of length and width together: from the front of a thing to its middle, on the average."""
MIDDLE = 0.6
"""Share of a box's width, around its middle, in which rays count."""
GROUND = 30.0
"""Metres up to which the foot of a box on the ground gives a range where no ray does."""


@dataclass(frozen=True)
class Measured:
    """Where something is, from the robot.

    Attributes:
        range: metres to its middle; NaN if it could not be measured.
        bearing: radians to the left of where the camera looks.
        sigma: standard deviations of both; of the range if it was measured.
    """

    range: float
    bearing: float
    sigma: tuple[float, float]


def whole(box: Box, spec: CameraSpec) -> bool:
    """Whether a box is wholly in frame, but that its top may be cut.

    A tower next to a robot never fits into the picture; its bearing is right all the same.
    """
    left, _, right, bottom = box
    return left > 0 and right < spec.width and bottom < spec.height


def bearing_of(column: float, spec: CameraSpec) -> float:
    """Radians to the left of where the camera looks, of a column (0 is the left edge)."""
    return math.atan2(spec.width / 2 - column, spec.focal)


def expected_range(detection: Detection, spec: CameraSpec) -> float:
    """Metres at which a thing of its class's nominal height has a box as high as this one.

    If the top is cut it is farther than this, so that only half of the estimate says something.
    """
    _, top, _, bottom = detection.box
    return SIZES[detection.kind].height * spec.focal / max(bottom - top, 1)


def measure(
    detection: Detection, lidar: Lidar, pose: tuple[float, float, float], spec: CameraSpec
) -> Measured | None:
    """Range and bearing of a detection.

    Args:
        detection: of the picture that was taken from ``pose``.
        lidar: casts the rays.
        pose: of the robot, with the camera's heading; the rays' origin.
        spec: of the camera.

    Returns:
        None if it is not wholly in frame.
    """
    if not whole(detection.box, spec):
        return None
    left, _, right, _ = detection.box
    middle = (left + right) / 2
    bearing = bearing_of(middle, spec)
    half = MIDDLE * (right - left) / 2
    scan = lidar.between(pose, bearing_of(middle + half, spec), bearing_of(middle - half, spec))
    low, high = (edge / math.cos(bearing) for edge in front_of(detection, spec))
    hits = scan.range[(scan.range > low) & (scan.range < high)]
    behind = half_depth(detection.kind)
    if len(hits):
        return _measured(float(np.quantile(hits, 0.25)) + behind, bearing, detection.kind)
    near, far = (ground / math.cos(bearing) for ground in foot_of(detection, spec))
    if far < GROUND and low <= (near + far) / 2 <= high:
        return _measured((near + far) / 2 + behind, bearing, detection.kind)
    return Measured(math.nan, bearing, (math.nan, math.nan))


def _measured(distance: float, bearing: float, kind: str) -> Measured:
    side = (SIZES[kind].length + SIZES[kind].width) / 2
    along = math.hypot(SIGMA_RANGE, SHARE_DEPTH * side)
    across = math.hypot(SIGMA_BEARING, SHARE_WIDTH * side / distance)
    return Measured(distance, bearing, (along, across))


def half_depth(kind: str) -> float:
    """Metres from the front of a thing of nominal size to its middle, over all sides."""
    size = SIZES[kind]
    return (ROUND_DEPTH if kind in ROUND else BOX_DEPTH) * (size.length + size.width)


def foot_of(detection: Detection, spec: CameraSpec) -> tuple[float, float]:
    """Least and most metres, along the camera's axis, to where the box stands on the ground.

    It is good to a point of the picture. If something hides the foot, it is too far.
    """
    foot = detection.box[3] - spec.height / 2
    near = spec.mount * spec.focal / (foot + 1) if foot > -1 else math.inf
    far = spec.mount * spec.focal / (foot - 1) if foot > 1 else math.inf
    return near, far


def front_of(detection: Detection, spec: CameraSpec) -> tuple[float, float]:
    """Least and most metres, along the camera's axis, at which a thing in the box can begin.

    Its height says so roughly, its foot better. Rays outside hit something before or behind it.
    """
    expected = expected_range(detection, spec)
    near, far = foot_of(detection, spec)
    low = max(expected / AGREE, FOOT * near if math.isfinite(near) else 0.0)
    high = math.inf if detection.box[1] <= 0 else AGREE * expected
    return low, min(high, far / FOOT)
