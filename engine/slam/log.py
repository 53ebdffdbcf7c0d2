"""RobotLog: what one robot drove and saw, column by column; a Mission is the logs of several."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Pose = tuple[float, float, float]
"""x and y in metres, heading in radians counted from x to y."""

ROBOT = -1
"""Class of a robot that was seen."""

FARTHEST = 1e8
"""Metres; no two places on a planet are farther apart, so that more is a mistake."""
FINEST = 1e-9
"""Metres or radians; no sensor has a smaller deviation."""
SIGMA_RANGE, SIGMA_BEARING = 0.5, 0.02
"""Metres and radians of sightings that do not say how good they are."""


@dataclass(frozen=True)
class OdometryNoise:
    """Standard deviations of one step of odometry: a part for the way, one for the turn.

    Attributes:
        along: of the way, as a share of it.
        across: sideways, as a share of the way.
        turn: of the heading, as a share of the turn.
        drift: of the heading, in radians a metre of way.
        floor: (along, across, heading) that each step has even if nothing moves.
    """

    along: float = 0.05
    across: float = 0.02
    turn: float = 0.05
    drift: float = 0.002
    floor: tuple[float, float, float] = (0.003, 0.002, 0.003)

    def sigmas(self, steps: Floats) -> Floats:
        """(n, 3) standard deviations of (n, 3) steps."""
        way, turn = np.hypot(steps[:, 0], steps[:, 1]), np.abs(steps[:, 2])
        spread = np.column_stack(
            [self.along * way, self.across * way, self.turn * turn + self.drift * way]
        )
        return np.asarray(np.hypot(spread, self.floor))


@dataclass(frozen=True)
class Odometry:
    """Where a robot believes to have gone, in its own frame (REP 105's ``odom``).

    Attributes:
        time: (n,) seconds, increasing.
        pose: (n, 3) x, y, heading.
        noise: how far a step may be off.
    """

    time: Floats
    pose: Floats
    noise: OdometryNoise = OdometryNoise()

    def __len__(self) -> int:
        return len(self.time)


@dataclass(frozen=True)
class Measurements:
    """What a robot saw, one row each; NaN stands for what a sensor does not measure.

    Attributes:
        time: (m,) seconds.
        range: (m,) metres; NaN for a bearing alone.
        bearing: (m,) radians from the robot's heading; NaN for a range alone.
        feature: (m,) position in ``Mission.classes``, or ``ROBOT``.
        confidence: (m,) of the class, in (0, 1].
        key: (m,) what names the thing seen beyond doubt, such as the text of a sign; "" for none.
        sigma_range: metres; one for all rows, or (m,).
        sigma_bearing: radians; one for all rows, or (m,).
    """

    time: Floats
    range: Floats
    bearing: Floats
    feature: Ints
    confidence: Floats
    key: NDArray[np.object_]
    sigma_range: float | Floats = SIGMA_RANGE
    sigma_bearing: float | Floats = SIGMA_BEARING

    def __len__(self) -> int:
        return len(self.time)

    @property
    def sigmas(self) -> Floats:
        """(m, 2) standard deviations of range (metres) and bearing (radians)."""
        found = np.empty((len(self), 2))
        found[:, 0], found[:, 1] = self.sigma_range, self.sigma_bearing
        return found

    def take(self, index: NDArray[np.bool_] | Ints) -> Measurements:
        """The rows at ``index``."""
        return Measurements(
            self.time[index],
            self.range[index],
            self.bearing[index],
            self.feature[index],
            self.confidence[index],
            self.key[index],
            sigma_range=_rows(self.sigma_range, index),
            sigma_bearing=_rows(self.sigma_bearing, index),
        )


def _rows(sigma: float | Floats, index: NDArray[np.bool_] | Ints) -> float | Floats:
    return sigma[index] if isinstance(sigma, np.ndarray) else sigma


@dataclass(frozen=True)
class Fixes:
    """Positions from outside, such as GPS, in the collective frame.

    Attributes:
        time: (g,) seconds.
        xy: (g, 2) metres.
        sigma: (g,) metres.
    """

    time: Floats
    xy: Floats
    sigma: Floats


@dataclass(frozen=True)
class Closures:
    """Relative poses that somebody else worked out, such as a scan matcher (g2o's ``EDGE_SE2``).

    Attributes:
        time: (k, 2) seconds: when the robot was at the first pose, and at the second.
        step: (k, 3) the second pose in the frame of the first.
        covariance: (k, 3, 3) of the steps.
    """

    time: Floats
    step: Floats
    covariance: Floats


@dataclass(frozen=True)
class RobotLog:
    """All that one robot has to tell.

    Attributes:
        name: of the robot.
        odometry: where it believes to have gone.
        seen: what it saw.
        start: where it was when its odometry began, in the collective frame; None if not known.
        start_sigma: standard deviations of that.
        fixes: positions from outside.
        closures: relative poses from outside.
    """

    name: str
    odometry: Odometry
    seen: Measurements
    start: Pose | None = None
    start_sigma: Pose = (0.01, 0.01, 0.01)
    fixes: Fixes | None = None
    closures: Closures | None = None


@dataclass(frozen=True)
class Truth:
    """What really was, for those who measure.

    Attributes:
        landmarks: name -> (x, y).
        trajectories: robot -> (n, 4) time, x, y, heading.
        features: name of a landmark -> its class, where known.
    """

    landmarks: dict[str, tuple[float, float]]
    trajectories: dict[str, Floats]
    features: dict[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Mission:
    """The logs of robots that were in the same place.

    Attributes:
        robots: their logs.
        classes: names of the classes of what they saw.
        dynamic: (C,) which classes move and so are no landmarks.
        similarity: (C, C) how alike two classes are, in [0, 1]; the unit matrix if not known.
        identity: for measuring alone: robot -> (m,) the name of what each row of ``seen`` is of,
            by the truth; the estimators never look at it.
        truth: what really was.
    """

    robots: tuple[RobotLog, ...]
    classes: tuple[str, ...]
    dynamic: NDArray[np.bool_]
    similarity: Floats
    identity: dict[str, NDArray[np.object_]] = field(default_factory=dict)
    truth: Truth | None = None
