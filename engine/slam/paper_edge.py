"""EdgeMap: the paper's map of one agent, from (0, 0), by odometry alone."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from symboslam.engine.slam.dead_reckoning import path_of, points_of
from symboslam.engine.slam.log import Ints, RobotLog
from symboslam.engine.slam.paper_rules import Rules
from symboslam.engine.slam.slam_map import MappedLandmarks, Trajectory


@dataclass(frozen=True)
class EdgeMap:
    """What one agent has mapped.

    Attributes:
        path: where it was.
        landmarks: what it saw, in the frame of the path.
        of: (m,) position in ``landmarks`` of each of its sightings; -1 for robots and for what has
            no range or no bearing.
    """

    path: Trajectory
    landmarks: MappedLandmarks
    of: Ints


def edge_map_paper(log: RobotLog, rules: Rules, path: Trajectory | None = None) -> EdgeMap:
    """Map what one robot saw, sighting by sighting in the order of time.

    A sighting belongs to the nearest landmark within the radius whose class is similar; without
    one it is a new landmark. A landmark lies at the mean of its sightings and has the class of the
    most confident one, of equal ones the first. Sightings of dynamic classes go together in the
    same way, with each other alone: one car that stands there is one piece of evidence.

    Args:
        log: of the robot.
        rules: what may be one landmark.
        path: where it was; None for odometry from (0, 0) with heading 0.
    """
    path = path or path_of(log)
    xy, feature, confidence = points_of(log, path), log.seen.feature, log.seen.confidence
    usable = np.isfinite(xy).all(1) & (feature >= 0)
    rows = np.flatnonzero(usable)
    rows = rows[np.argsort(log.seen.time[rows], kind="stable")]
    alike = rules.alike & (rules.dynamic[:, None] == rules.dynamic[None])
    similar = [set(np.flatnonzero(row).tolist()) for row in alike]
    found = _Gathering(rules.radius)
    of = np.full(len(log.seen), -1, np.int64)
    for row in rows.tolist():
        f = int(feature[row])
        of[row] = found.put(
            float(xy[row, 0]), float(xy[row, 1]), f, float(confidence[row]), similar[f]
        )
    n = len(found.x)
    kind = np.array(found.feature, np.int64)
    return EdgeMap(
        path,
        MappedLandmarks(
            id=np.array([f"{log.name}/{i + 1}" for i in range(n)], object),
            xy=np.column_stack([found.x, found.y]).reshape(-1, 2).astype(float),
            covariance=np.full((n, 2, 2), np.nan),
            feature=kind,
            confidence=np.array(found.confidence, float),
            sightings=np.array(found.count, np.int64),
            dynamic=rules.dynamic[kind],
            key=np.full(n, "", object),
        ),
        of,
    )


class _Gathering:
    """Landmarks in squares of a grid as wide as the radius, so that near ones are found at once."""

    def __init__(self, radius: float) -> None:
        self._radius = radius
        self._squares: dict[tuple[int, int], set[int]] = {}
        self.x: list[float] = []
        self.y: list[float] = []
        self.feature: list[int] = []
        self.confidence: list[float] = []
        self.count: list[int] = []

    def put(self, x: float, y: float, feature: int, confidence: float, similar: set[int]) -> int:
        """Add one sighting; returns the number of its landmark."""
        at = self._nearest(x, y, similar)
        if at is None:
            at = len(self.x)
            self.x.append(x)
            self.y.append(y)
            self.feature.append(feature)
            self.confidence.append(confidence)
            self.count.append(1)
        else:
            self._squares[self._square(self.x[at], self.y[at])].discard(at)
            self.count[at] += 1
            self.x[at] += (x - self.x[at]) / self.count[at]
            self.y[at] += (y - self.y[at]) / self.count[at]
            if confidence > self.confidence[at]:
                self.feature[at], self.confidence[at] = feature, confidence
        self._squares.setdefault(self._square(self.x[at], self.y[at]), set()).add(at)
        return at

    def _square(self, x: float, y: float) -> tuple[int, int]:
        return math.floor(x / self._radius), math.floor(y / self._radius)

    def _nearest(self, x: float, y: float, similar: set[int]) -> int | None:
        i, j = self._square(x, y)
        best = None
        for u in (i - 1, i, i + 1):
            for v in (j - 1, j, j + 1):
                for at in self._squares.get((u, v), ()):
                    if self.feature[at] in similar:
                        found = math.hypot(self.x[at] - x, self.y[at] - y), at
                        if found[0] <= self._radius and (best is None or found < best):
                            best = found
        return None if best is None else best[1]
