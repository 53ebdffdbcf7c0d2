"""Journal: what one robot drove and saw, row by row, and the log for map building."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from symboslam.engine.slam.log import (
    Fixes,
    Measurements,
    Odometry,
    OdometryNoise,
    RobotLog,
)

Pose = tuple[float, float, float]

START_SIGMA = (0.01, 0.01, 0.002)
"""Standard deviations of where a robot begins, in metres and radians: a place that was surveyed."""


@dataclass(frozen=True)
class Seen:
    """A sighting.

    Attributes:
        time: seconds.
        range: metres; NaN if it was not measured.
        bearing: radians to the left.
        kind: class.
        confidence: in (0, 1].
        sigma: standard deviations of range and bearing.
        thing: for measuring alone: id of the object that it is of; "" for none.
    """

    time: float
    range: float
    bearing: float
    kind: str
    confidence: float
    sigma: tuple[float, float]
    thing: str = ""


@dataclass
class Journal:
    """What one robot drove and saw.

    Attributes:
        name: of the robot.
        start: where it began: metres and radians.
        odometry: time and pose by odometry.
        truth: time and true pose, for measuring alone.
        seen: sightings.
        fixes: time, x and y of GPS.
    """

    name: str
    start: Pose
    odometry: list[tuple[float, Pose]] = field(default_factory=list)
    truth: list[tuple[float, Pose]] = field(default_factory=list)
    seen: list[Seen] = field(default_factory=list)
    fixes: list[tuple[float, float, float]] = field(default_factory=list)

    def log(
        self,
        position: dict[str, int],
        noise: OdometryNoise,
        sigma_fix: float,
    ) -> RobotLog:
        """The log for map building.

        Args:
            position: class -> its number.
            noise: of the odometry.
            sigma_fix: of a fix, metres.
        """
        s = self.seen
        fixes = None
        if self.fixes:
            rows = np.array(self.fixes, float)
            fixes = Fixes(rows[:, 0], rows[:, 1:], np.full(len(rows), sigma_fix))
        return RobotLog(
            self.name,
            Odometry(
                np.array([t for t, _ in self.odometry], float),
                np.array([p for _, p in self.odometry], float).reshape(-1, 3),
                noise,
            ),
            Measurements(
                np.array([x.time for x in s], float),
                np.array([x.range for x in s], float),
                np.array([x.bearing for x in s], float),
                np.array([position[x.kind] for x in s], np.int64),
                np.array([x.confidence for x in s], float),
                np.full(len(s), "", object),
                np.array([x.sigma[0] for x in s], float),
                np.array([x.sigma[1] for x in s], float),
            ),
            self.start,
            START_SIGMA,
            fixes=fixes,
        )
