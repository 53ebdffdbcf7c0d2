"""Scale: how far apart landmarks are and how far the sensor reaches, learnt from what was seen."""

from __future__ import annotations

import math
from collections.abc import Hashable, Set

import numpy as np

from symboslam.engine.slam.log import Floats
from symboslam.engine.slam.pose_graph import Sighting

MISSED = 0.4
"""Log odds for each time that of two landmarks at one place only one was seen."""
ENOUGH = 20
"""So many such times count."""
MISTAKEN = 0.05
"""Share of the moments of a landmark in which a sighting may be of another."""
LARGE = 13.8
"""Squared Mahalanobis distance beyond which two are not one (chi-square, 2 degrees, 0.1 %)."""


def together(one: Set[Hashable], other: Set[Hashable]) -> bool:
    """Whether two landmarks were seen beside each other, and so are two.

    Args:
        one: the moments at which one was seen.
        other: those of the other; a twentieth of the fewer may be mistakes.
    """
    return len(one & other) > MISTAKEN * min(len(one), len(other))


class Scale:
    """Statistics of whole sightings.

    Attributes:
        reach: metres, the largest range.
        sigma: metres, standard deviation of ranges: the mean of the sightings', of several robots
            the largest.
    """

    def __init__(self) -> None:
        self.reach = 0.0
        self.sigma = 0.0
        self._bearing = 0.0
        self._count = 0

    def see(self, seen: Sighting) -> None:
        """Take over a sighting."""
        self._count += 1
        self.reach = max(self.reach, seen.range)
        self.sigma += (seen.sigma_range - self.sigma) / self._count
        self._bearing = max(self._bearing, min(abs(seen.bearing), math.pi))

    def include(self, other: Scale) -> None:
        """Take over what another robot saw."""
        self._count += other._count
        self.reach = max(self.reach, other.reach)
        self.sigma = max(self.sigma, other.sigma)
        self._bearing = max(self._bearing, other._bearing)

    def spacing(self, poses: int) -> float:
        """Metres between landmarks: the root of the area in view for each thing in it.

        The area is a sector of the largest range and bearing; ``poses`` key poses looked at it.
        """
        if not self._count:
            return 1.0
        view = self.reach**2 * max(self._bearing, 0.1)
        return math.sqrt(view * max(poses, 1) / self._count)

    def unseen(self, times: int, sigma: float, apart: float) -> float:
        """Log odds that two are one, from never having been seen beside each other.

        If they lie, or may lie, far apart for what the sensor reaches, they need not have been in
        view together, and this says nothing.

        Args:
            times: sightings of either.
            sigma: metres, of how far apart they are.
            apart: metres that they lie apart.
        """
        beside = sigma < self.reach / 3 and apart < self.reach / 2
        return MISSED * min(times, ENOUGH) if beside else 0.0

    def same(
        self, away: Floats, covariance: Floats, alike: float, times: int, spacing: float
    ) -> float:
        """Log odds that two landmarks are one.

        Args:
            away: (2,) metres from one to the other.
            covariance: (2, 2) of that, if they are one.
            alike: log odds that they are of one class.
            times: sightings of either.
            spacing: metres between landmarks.
        """
        square = float(away @ np.linalg.solve(covariance, away))
        if square > LARGE:
            return -math.inf
        area = 2 * math.pi * math.sqrt(float(np.linalg.det(covariance)))
        sigma = math.sqrt(float(np.trace(covariance)) / 2)
        unseen = self.unseen(times, sigma, float(np.hypot(*away)))
        return alike - square / 2 - math.log(area / spacing**2) + unseen
