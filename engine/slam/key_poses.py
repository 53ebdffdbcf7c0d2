"""KeyPoses: turns what a robot reports, row by row, into key poses and sightings made from them.

A key pose is made at most every ``interval`` seconds, on a grid that all robots share, and only if
the robot moved. What was seen in between is carried to the key pose before it by odometry; a range
or a bearing alone cannot be, and gets a key pose of its own.
"""

from __future__ import annotations

import bisect
import heapq
import math
from collections import Counter
from collections.abc import Iterator

import numpy as np

from symboslam.engine.slam.log import (
    FARTHEST,
    FINEST,
    SIGMA_BEARING,
    SIGMA_RANGE,
    OdometryNoise,
    RobotLog,
)
from symboslam.engine.slam.pose_graph import Fix, PoseGraph, Sighting

STILL = 0.01, math.radians(0.5)
"""A robot that moved less (metres, radians) stands still."""
AFTER = 1.0
"""Seconds for which the last odometry holds."""
TINY = 1e-6
"""Seconds; times since 1970 are no finer."""

Planar = tuple[float, float, float]
Row = tuple[float, int, float, float, int, float, str, tuple[float, float]]
"""Time, number, range, bearing, class, confidence, key, deviations of range and bearing."""


class KeyPoses:
    """Key poses of one run.

    Args:
        graph: is filled.
        noise: of the odometry.
        interval: seconds between key poses, at least.

    Attributes:
        problems: what is wrong with the log -> how often.
    """

    def __init__(
        self,
        graph: PoseGraph,
        noise: OdometryNoise,
        interval: float,
    ) -> None:
        self.graph, self._noise, self._interval = graph, noise, interval
        self._from: tuple[float, Planar] = (-math.inf, (0.0, 0.0, 0.0))
        self._to = self._key = self._from
        self._waiting: list[Row] = []
        self._rows = 0
        self.problems: Counter[str] = Counter()
        self._said: set[tuple[object, ...]] = set()

    @property
    def key_odometry(self) -> Planar:
        """What odometry said at the last key pose; (0, 0, 0) before the first."""
        return self._key[1]

    def odometry(self, time: float, x: float, y: float, heading: float) -> list[Sighting]:
        """Where the robot believes to be; returns the sightings that can be placed by it."""
        if not math.isfinite(time + x + y + heading):
            self.problems["odometry that is not finite, left out"] += 1
            return []
        if max(abs(x), abs(y)) > FARTHEST:
            self.problems[f"odometry beyond {FARTHEST:g} m, left out"] += 1
            return []
        pose, (before, there) = (x, y, heading), self._to
        if time <= before:
            if time < before or pose != there:
                self.problems["odometry that goes back in time, left out"] += 1
            return []
        if not len(self.graph):
            self._to = time, pose
            self._append(time, pose)
            return self._settled(time)
        self._from, self._to = self._to, (time, pose)
        tick = math.floor(time / self._interval + TINY) * self._interval
        found = []
        if tick > self._key[0] + TINY and _moved(self._key[1], self._odometry_at(tick)):
            tick = max(tick, before)
            found = self._settled(tick - 2 * TINY)
            self._append(tick, self._odometry_at(tick))
        return found + self._settled(time)

    def sighting(
        self,
        time: float,
        range: float,
        bearing: float,
        feature: int,
        confidence: float,
        key: str,
        sigma_range: float,
        sigma_bearing: float,
        row: int | None = None,
    ) -> list[Sighting]:
        """What the robot saw; returns the sightings that can be placed.

        Without ``row`` the sightings are numbered as they come. The deviation of what was not
        measured may be anything; the usual one stands for it.
        """
        sigma = (
            SIGMA_RANGE if math.isnan(range) else sigma_range,
            SIGMA_BEARING if math.isnan(bearing) else sigma_bearing,
        )
        row = self._rows if row is None else row
        self._rows = row + 1
        if not math.isfinite(time) or (math.isnan(range) and math.isnan(bearing)):
            self.problems["measurements without time, or without range and bearing, left out"] += 1
        elif range > FARTHEST or math.isinf(bearing) or range <= 0:
            self.problems["measurements whose range or bearing cannot be, left out"] += 1
        elif not all(FINEST <= each <= FARTHEST for each in sigma):
            self.problems[f"measurements with a deviation below {FINEST:g} or none, left out"] += 1
        elif not 0 < confidence <= 1:
            self.problems["measurements with a confidence outside (0, 1], left out"] += 1
        elif self._repeated(time, range, bearing, feature, key):
            self.problems["measurements that repeat another, left out"] += 1
        else:
            heapq.heappush(
                self._waiting, (time, row, range, bearing, feature, confidence, key, sigma)
            )
            return self._settled(self._to[0])
        return []

    def _repeated(self, time: float, *measured: object) -> bool:
        """Whether the very same was measured at a time."""
        what = time, *map(str, measured)
        known = what in self._said
        self._said.add(what)
        return known

    def fix(self, time: float, x: float, y: float, sigma: float) -> None:
        """A position from outside, of the key pose before it."""
        if not math.isfinite(time + x + y) or not FINEST <= sigma <= FARTHEST:
            self.problems["positions from outside that cannot be, left out"] += 1
        elif not len(self.graph) or time < self.graph.time[0] - TINY:
            self.problems["positions from outside before the first odometry, left out"] += 1
        else:
            pose = bisect.bisect_right(self.graph.time, time + TINY) - 1
            self.graph.fixes.append(Fix(max(pose, 0), x, y, sigma))

    def finish(self) -> list[Sighting]:
        """The sightings after the last odometry, placed at its end."""
        found = self._settled(self._to[0] + AFTER)
        late = len(self._waiting)
        if late:
            self.problems["measurements without odometry at their time, left out"] += late
        return found

    def _append(self, time: float, pose: Planar) -> None:
        self.graph.extend(time, np.array(pose), self._noise)
        self._key = time, pose

    def _settled(self, until: float) -> list[Sighting]:
        """Sightings up to a time, carried to key poses."""
        found = []
        while self._waiting and self._waiting[0][0] <= until + TINY and len(self.graph):
            row = heapq.heappop(self._waiting)
            if row[0] < self.graph.time[0] - TINY:
                self.problems["measurements before the first odometry, left out"] += 1
            else:
                found.append(self._carried(row))
        return found

    def _carried(self, row: Row) -> Sighting:
        time, number, reach, bearing, feature, confidence, key, sigma = row
        if time >= self._key[0] - TINY:
            at = self._odometry_at(min(time, self._to[0]))
            if (math.isnan(reach) or math.isnan(bearing)) and _moved(self._key[1], at):
                self._append(time, at)
            pose = len(self.graph) - 1
            dx, dy, turn = _step(self._key[1], at)
        else:
            pose = max(bisect.bisect_right(self.graph.time, time + TINY) - 1, 0)
            share = (time - self.graph.time[pose]) / max(
                self.graph.time[pose + 1] - self.graph.time[pose], TINY
            )
            dx, dy, turn = (float(v) for v in share * self.graph.step[pose + 1])
        if not math.isnan(reach) and not math.isnan(bearing):
            x = dx + reach * math.cos(bearing + turn)
            y = dy + reach * math.sin(bearing + turn)
            reach, bearing = math.hypot(x, y), math.atan2(y, x)
        else:
            bearing += turn
        sighting = Sighting(number, time, pose, reach, bearing, *sigma, feature, confidence, key)
        self.graph.sightings.append(sighting)
        return sighting

    def _odometry_at(self, time: float) -> Planar:
        """Between the last two rows of odometry."""
        (start, one), (end, other) = self._from, self._to
        if not math.isfinite(start) or end <= start:
            return other
        share = min(max((time - start) / (end - start), 0.0), 1.0)
        turn = math.remainder(other[2] - one[2], math.tau)
        return (
            one[0] + share * (other[0] - one[0]),
            one[1] + share * (other[1] - one[1]),
            one[2] + share * turn,
        )


def _step(one: Planar, other: Planar) -> Planar:
    """From one pose to another, in the frame of the first."""
    cos, sin = math.cos(one[2]), math.sin(one[2])
    dx, dy = other[0] - one[0], other[1] - one[1]
    return cos * dx + sin * dy, cos * dy - sin * dx, math.remainder(other[2] - one[2], math.tau)


def _moved(one: Planar, other: Planar) -> bool:
    dx, dy, turn = _step(one, other)
    return math.hypot(dx, dy) > STILL[0] or abs(turn) > STILL[1]


def replay(log: RobotLog, keys: KeyPoses) -> Iterator[list[Sighting]]:
    """A log as it came, row by row; yields the sightings after each row of odometry."""
    seen = log.seen
    columns = (
        seen.time, seen.range, seen.bearing, seen.feature, seen.confidence, seen.key,
        *seen.sigmas.T,
    )  # fmt: skip
    rows: list[tuple[float, float, float, int, float, str, float, float]] = list(
        zip(*(column.tolist() for column in columns), strict=True)
    )
    order: list[int] = np.argsort(seen.time, kind="stable").tolist()
    n = 0
    for time, (x, y, heading) in zip(
        log.odometry.time.tolist(), log.odometry.pose.tolist(), strict=True
    ):
        found = []
        while n < len(order) and rows[order[n]][0] <= time:
            found += keys.sighting(*rows[order[n]], row=order[n])
            n += 1
        yield found + keys.odometry(time, x, y, heading)
    found = []
    for row in order[n:]:
        found += keys.sighting(*rows[row], row=row)
    yield found + keys.finish()
