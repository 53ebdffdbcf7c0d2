"""Radii: within how many metres two places may be of one landmark, where nobody says."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from symboslam.engine.slam.log import Floats, Measurements

LARGEST = 12.0
"""Metres: the gate of worlds of a kilometre and more, which were driven with a sight of 80 m."""
OF_SIGHT = 0.15
"""Radius of merging as a share of the sight; 12 m of 80 m."""


def radius_by_sight(seen: Iterable[Measurements]) -> float:
    """Radius of merging in metres: 0.15 of the sight, at most 12 m (docs/decisions/0019).

    The sight is the range within which 95 % of all sightings lie; without any range it is 80 m.
    """
    ranges = np.concatenate([np.empty(0), *(s.range[np.isfinite(s.range)] for s in seen)])
    if not len(ranges):
        return LARGEST
    return min(LARGEST, OF_SIGHT * float(np.quantile(ranges, 0.95)))


def radius_by_spacing(xy: Floats) -> float:
    """Radius of matching in metres: half the spacing of the true landmarks, at most 12 m.

    The spacing is what it would be if the n landmarks stood evenly in a square with the same
    diagonal as their bounding box: diagonal / sqrt(2 n). The distance to the nearest neighbour
    would be no measure: MRCLAM's landmarks stand back to back, 18 cm apart, in a hall of 10 m.

    Args:
        xy: (n, 2) metres; in one and the same place, or fewer than two, the radius is 12 m.
    """
    diagonal = float(np.hypot(*np.ptp(xy, axis=0))) if len(xy) else 0.0
    return min(LARGEST, diagonal / np.sqrt(2 * len(xy)) / 2) if diagonal else LARGEST
