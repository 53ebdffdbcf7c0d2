"""Ranging: from a box in a picture to the range and bearing of the object's middle.

The bearing is that of the box's middle. The range is what lidar rays in the box measure, and half
the nominal depth of the class. The height of the box tells roughly how far such a thing should be;
rays that hit something else do not agree with it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from symboslam.sim_bridge.bridge.detections import Box, Detection
from symboslam.sim_bridge.bridge.lidar import Lidar
from symboslam.sim_bridge.bridge.settings import CameraSpec
from symboslam.sim_bridge.objects.bullet import ROUND
from symboslam.sim_bridge.worlds.sizes import SIZES

SIGMA_RANGE, SHARE_DEPTH = 0.7, 0.1
"""Deviation of a range: metres, and a share of the mean of the class's length and width, beside
what its unknown turn does."""
SIGMA_BEARING, SHARE_WIDTH = 0.01, 0.1
"""Deviation of a bearing: radians, and the angle of that share of the mean side.

The middle of a large thing looks different from each side, and stays wrong from picture to picture.
"""
AGREE = 2.0
"""A ray may measure so many times more or less than the height of the box tells."""
FOOT = 0.8
"""Share by which a range may differ from where the foot of the box is."""
ROUND_DEPTH = 0.25
"""Of length and width together: from the front of a round thing to its middle."""
TURNS = np.radians(np.arange(0.5, 90))
"""Angles between the line of sight and the heading of a thing, that are tried."""
LIKE = 0.1, 0.3
"""A box may be wider or narrower than such a thing looks: a share of that, and metres."""
MIDDLE = 0.4
"""Share of a box's width, around its middle, in which rays count."""
NEAREST = 0.25
"""Of the rays that hit a round thing, such as a tree, this share hit its front."""
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
    detection: Detection,
    lidar: Lidar,
    pose: tuple[float, float, float],
    spec: CameraSpec,
    others: Sequence[Detection] = (),
) -> Measured | None:
    """Range and bearing of a detection.

    Args:
        detection: of the picture that was taken from ``pose``.
        lidar: casts the rays.
        pose: of the robot, with the camera's heading; the rays' origin.
        spec: of the camera.
        others: what else is in the picture; what stands before the thing takes its rays.

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
    free = np.ones(len(scan.bearing), bool)
    for other in others:
        if other.box[3] > detection.box[3]:
            first, last = bearing_of(other.box[2], spec), bearing_of(other.box[0], spec)
            free &= (scan.bearing < first) | (scan.bearing > last)
    low, high = (edge / math.cos(bearing) for edge in front_of(detection, spec))
    hits = scan.range[free & (scan.range > low) & (scan.range < high)]
    if len(hits):
        share = NEAREST if detection.kind in ROUND else 0.5
        return _measured(float(np.quantile(hits, share)), bearing, detection, spec)
    near, far = (ground / math.cos(bearing) for ground in foot_of(detection, spec))
    if far < GROUND and low <= (near + far) / 2 <= high:
        return _measured((near + far) / 2, bearing, detection, spec)
    return Measured(math.nan, bearing, (math.nan, math.nan))


def _measured(front: float, bearing: float, detection: Detection, spec: CameraSpec) -> Measured:
    """From the range of a thing's front to that of its middle."""
    left, _, right, _ = detection.box
    angle = bearing_of(left, spec) - bearing_of(right, spec)
    depth, spread = half_depth(detection.kind, 2 * front * math.tan(angle / 2))
    size = SIZES[detection.kind]
    side = (size.length + size.width) / 2
    along = math.hypot(SIGMA_RANGE, SHARE_DEPTH * side, spread)
    across = math.hypot(SIGMA_BEARING, SHARE_WIDTH * side / (front + depth))
    return Measured(front + depth, bearing, (along, across))


def half_depth(kind: str, width: float) -> tuple[float, float]:
    """Metres from the front of a thing to its middle along the line of sight, and how sure.

    A thing of nominal size that looks so wide can only be turned some ways; each has its depth.

    Args:
        kind: its class.
        width: metres from the left to the right of it, as it looks.
    """
    size = SIZES[kind]
    if kind in ROUND:
        return ROUND_DEPTH * (size.length + size.width), 0.0
    sin, cos = np.sin(TURNS), np.cos(TURNS)
    looks = size.length * sin + size.width * cos
    depth = np.minimum(size.length / cos, size.width / sin) / 2
    width = min(max(width, float(looks.min())), float(looks.max()))
    share, metres = LIKE
    weight = np.exp(-0.5 * ((looks - width) / (share * looks + metres)) ** 2)
    mean = float((weight * depth).sum() / weight.sum())
    return mean, float(np.sqrt((weight * (depth - mean) ** 2).sum() / weight.sum()))


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
