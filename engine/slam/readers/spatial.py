"""Poses in space brought down to the plane, where they are near it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from symboslam.engine.slam.log import Pose
from symboslam.errors import InputError

STEEPEST = 0.2
"""Radians by which a robot may tilt, and metres a metre by which it may climb, in a plane map."""


def heading_of(quaternion: Sequence[float], where: str) -> tuple[float, float]:
    """Heading about the vertical axis, and tilt away from it, in radians.

    Args:
        quaternion: x, y, z, w; its length does not matter.
        where: file and line, for the message.

    Raises:
        InputError: its length is 0.
    """
    q = np.asarray(quaternion, float)
    length = float(np.linalg.norm(q))
    if length < 1e-9:
        raise InputError(f"{where}: the quaternion is 0, which is no orientation")
    x, y, z, w = (q / length).tolist()
    tilt = float(np.arccos(np.clip(1 - 2 * (x * x + y * y), -1, 1)))
    return float(np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))), tilt


def planar_step(values: Sequence[float], where: str) -> Pose:
    """A relative pose (x, y, z, qx, qy, qz, qw) in the plane.

    Raises:
        InputError: it climbs or tilts too much.
    """
    x, y, z, *quaternion = values
    heading, tilt = heading_of(quaternion, where)
    if tilt > STEEPEST or abs(z) > STEEPEST * max(1.0, float(np.hypot(x, y))):
        raise InputError(
            f"{where}: this step climbs {z:.2f} m and tilts by {tilt:.2f} rad: the graph is not in "
            "a plane, and only maps of the plane are made"
        )
    return x, y, heading
