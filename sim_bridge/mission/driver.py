"""Driver: from a goal and a lidar scan to a speed and a turn (a vector field histogram, cut short).

Directions in which an obstacle is near are closed. Of the open ones the driver takes the one that
is nearest to the goal's, and goes as fast as what is ahead lets it brake.
"""

from __future__ import annotations

import math

import numpy as np

from symboslam.sim_bridge.bridge.lidar import Scan

GAIN = 2.5
"""Radians a second of turn for a radian of error."""
BRAKE = 4.0
"""Metres a second squared by which a robot brakes."""
MARGIN = 0.6
"""Metres that are left between the robot and what it passes."""


def heading_for(scan: Scan | None, wanted: float, radius: float, look: float) -> tuple[float, bool]:
    """An open bearing near a wanted one.

    Args:
        scan: what is ahead; None if nothing is near.
        wanted: bearing of the goal, in radians to the left.
        radius: of the robot, in metres.
        look: metres within which obstacles close a direction.

    Returns:
        The bearing, and whether any was open.
    """
    if scan is None:
        return wanted, True
    near = scan.range < look
    if not near.any():
        return wanted, True
    bearing, ranges = scan.bearing[near], scan.range[near]
    wide = np.arcsin(np.minimum((radius + MARGIN) / np.maximum(ranges, radius + MARGIN), 1.0))
    # Where the goal is behind, the scan says nothing: the robot turns on the spot first.
    if abs(wanted) > scan.bearing[-1]:
        return wanted, True
    tried = np.append(scan.bearing, wanted)
    closed = (np.abs(tried[:, None] - bearing[None, :]) < wide[None, :]).any(1)
    if closed.all():
        # Nothing is wide enough: towards the most room.
        room = np.minimum(scan.range, look)
        best = np.lexsort((np.abs(scan.bearing - wanted), -room))[0]
        return float(scan.bearing[best]), bool(room[best] > 2 * radius)
    open_ = tried[~closed]
    best = open_[np.abs(open_ - wanted).argmin()]
    return float(best), True


def ahead(scan: Scan | None, bearing: float, radius: float) -> float:
    """Metres that are free in the lane of a robot's width along a bearing."""
    if scan is None:
        return math.inf
    turned = scan.bearing - bearing
    finite = np.isfinite(scan.range) & (np.abs(turned) < math.pi / 2)
    side = np.abs(scan.range[finite] * np.sin(turned[finite]))
    lane = scan.range[finite] * np.cos(turned[finite])
    blocked = lane[side < radius + MARGIN / 2]
    return max(float(blocked.min()) - radius, 0.0) if len(blocked) else math.inf


def command(
    scan: Scan | None, wanted: float, distance: float, top: float, radius: float
) -> tuple[float, float]:
    """Speed in metres a second and turn in radians a second.

    Args:
        scan: what is ahead; None if nothing is near.
        wanted: bearing of the goal, in radians to the left.
        distance: metres to the goal.
        top: fastest metres a second.
        radius: of the robot, in metres.
    """
    look = min(max(top * top / (2 * BRAKE), 3.0) + radius, distance + radius + MARGIN)
    if distance <= 0:
        return 0.0, GAIN * wanted
    bearing, free = heading_for(scan, wanted, radius, look)
    turn = GAIN * bearing
    if not free:
        return 0.0, turn
    room = min(ahead(scan, 0.0, radius), max(distance, 0.5))
    speed = min(top, math.sqrt(2 * BRAKE * room)) * max(math.cos(bearing), 0.0) ** 2
    return speed, turn
