"""PoseGraph: a robot's key poses, the steps between them, and what was seen from them."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from symboslam.engine.slam.log import Floats, OdometryNoise
from symboslam.engine.slam.planar import between, compose, place


@dataclass(slots=True)
class Sighting:
    """One measurement, made from a key pose.

    Attributes:
        row: its number in the robot's log.
        time: seconds.
        pose: number of the key pose.
        range: metres from the key pose; NaN for a bearing alone.
        bearing: radians from its heading; NaN for a range alone.
        sigma_range: metres.
        sigma_bearing: radians.
        feature: class by number; -1 for a robot.
        confidence: of the class.
        key: what names it beyond doubt.
        track: number of the track; -1 for none.
    """

    row: int
    time: float
    pose: int
    range: float
    bearing: float
    sigma_range: float
    sigma_bearing: float
    feature: int
    confidence: float
    key: str = ""
    track: int = -1

    @property
    def whole(self) -> bool:
        """Whether it has both range and bearing."""
        return not (math.isnan(self.range) or math.isnan(self.bearing))

    @property
    def point(self) -> tuple[float, float]:
        """Where it is in the frame of the key pose."""
        return self.range * math.cos(self.bearing), self.range * math.sin(self.bearing)

    @property
    def variance(self) -> float:
        """Square metres, of its position in one direction."""
        return self.sigma_range**2 + (self.range * self.sigma_bearing) ** 2


@dataclass(slots=True)
class Fix:
    """A position from outside.

    Attributes:
        pose: number of the key pose.
        x, y: metres in the collective frame.
        sigma: metres.
    """

    pose: int
    x: float
    y: float
    sigma: float


@dataclass
class PoseGraph:
    """Key poses of one run, in the frame where the run began (REP 105's ``odom``).

    Attributes:
        robot: its name.
        time: seconds of each key pose.
        odometry: (3,) of each.
        step: (3,) from the key pose before; zeros for the first.
        sigma: (3,) standard deviations of the steps.
        sightings: in the order in which they came.
        fixes: positions from outside.
    """

    robot: str
    time: list[float] = field(default_factory=list)
    odometry: list[Floats] = field(default_factory=list)
    step: list[Floats] = field(default_factory=list)
    sigma: list[Floats] = field(default_factory=list)
    sightings: list[Sighting] = field(default_factory=list)
    fixes: list[Fix] = field(default_factory=list)
    _spread: list[tuple[float, float, float]] = field(default_factory=list)

    def __len__(self) -> int:
        return len(self.time)

    def add(self, time: float, step: Floats, sigma: Floats) -> None:
        """Append a key pose."""
        first = not self.time
        self.time.append(time)
        self.odometry.append(np.zeros(3) if first else compose(self.odometry[-1], step))
        self.step.append(step)
        self.sigma.append(sigma)
        moved, turned, way = (0.0, 0.0, 0.0) if first else self._spread[-1]
        if not first:
            moved += float(sigma[0] ** 2 + sigma[1] ** 2)
            turned += float(sigma[2] ** 2)
            way += math.hypot(step[0], step[1])
        self._spread.append((moved, turned, way))

    def extend(self, time: float, pose: Floats, noise: OdometryNoise) -> None:
        """Append a key pose at a place of the odometry's own frame."""
        if not self.time:
            self.origin = np.asarray(pose, float)
            self.add(time, np.zeros(3), np.zeros(3))
            return
        step = between(compose(self.origin, self.odometry[-1]), pose)
        self.add(time, step, noise.sigmas(step[None])[0])

    def drift(self, one: int, other: int, reach: float = 0.0) -> float:
        """Variance (m2) of a place ``reach`` metres away that was seen at one key pose and another.

        The sum of what each step may be off, and of what the turns do at the end of the way.
        """
        a, b = self._spread[max(one, other)], self._spread[min(one, other)]
        way = a[2] - b[2]
        return (a[0] - b[0]) + (a[1] - b[1]) * (way * way / 3 + reach * reach)

    def way(self, one: int, other: int) -> float:
        """Metres driven between two key poses."""
        return abs(self._spread[one][2] - self._spread[other][2])

    def at(self, sighting: Sighting) -> Floats:
        """(2,) where a sighting is by odometry alone."""
        return place(self.odometry[sighting.pose], sighting.point)
