"""Metrics of a search: coverage against V W t, dispersion, time to discover all features."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np

from symboslam.errors import InputError
from symboslam.sim_bridge.search.area import Bools, Floats


def ideal_area(speed: float, width: float, seconds: float, robots: int = 1) -> float:
    """A' = V W t of all robots: square metres that they would see if they saw nothing twice.

    Args:
        speed: V, metres a second.
        width: W, of the strip that a robot sees, metres.
        seconds: t.
        robots: how many.
    """
    return robots * speed * width * seconds


def dispersion(xy: Floats, alive: Bools | None = None) -> float:
    """Mean distance between two robots, metres; 0 where there are fewer than two.

    Args:
        xy: (n, 2 or more) places.
        alive: (n,) which robots count.
    """
    places = xy[:, :2] if alive is None else xy[alive, :2]
    pairs = [math.dist(a, b) for a, b in combinations(places.tolist(), 2)]
    return sum(pairs) / len(pairs) if pairs else 0.0


@dataclass(frozen=True)
class SearchMetrics:
    """What came of a search, sampled each second.

    Attributes:
        time: (t,) seconds, rising.
        coverage: (t,) share of the area that the team has really seen.
        dispersion: (t,) mean distance between two robots, metres.
        driven: (t,) metres that all robots have driven together.
        found: (k,) when each feature was first seen, seconds; infinite if never.
        size: of the area, square metres.
        diagonal: of the area, metres.
        speed: of the robots, metres a second.
        width: of the strip that a robot sees, metres.
        robots: how many.

    Raises:
        InputError: the arrays do not fit each other, or hold nothing.
    """

    time: Floats
    coverage: Floats
    dispersion: Floats
    driven: Floats
    found: Floats
    size: float
    diagonal: float
    speed: float
    width: float
    robots: int

    def __post_init__(self) -> None:
        shapes = {a.shape for a in (self.time, self.coverage, self.dispersion, self.driven)}
        if len(shapes) != 1 or not len(self.time):
            raise InputError(
                "time, coverage, dispersion, driven: give arrays of one length, 1 or more"
            )

    def coverage_at(self, seconds: float) -> float:
        """Share that was seen by a time; after the end that of the end."""
        return float(np.interp(seconds, self.time, self.coverage))

    def time_to(self, share: float) -> float:
        """Seconds until a share was seen; infinite if it never was."""
        enough = np.flatnonzero(self.coverage >= share)
        return float(self.time[enough[0]]) if len(enough) else math.inf

    @property
    def time_to_all_features(self) -> float:
        """Seconds until every feature was seen; infinite if one never was; 0 without features."""
        return float(self.found.max()) if len(self.found) else 0.0

    def ideal_share(self, seconds: float) -> float:
        """A'/A of all robots at a time, not capped: above 1 there was time to see all of it."""
        return ideal_area(self.speed, self.width, seconds, self.robots) / self.size

    def capped_share(self, seconds: float) -> float:
        """A'/A of all robots at a time, at most 1."""
        return min(self.ideal_share(seconds), 1.0)

    def mean_dispersion(self, seconds: float = math.inf) -> float:
        """Mean of the dispersion until a time, metres."""
        upto = self.time <= seconds
        return float(self.dispersion[upto].mean()) if upto.any() else float(self.dispersion[0])

    def normalised_dispersion(self, seconds: float = math.inf) -> float:
        """Mean dispersion over the area's diagonal, from 0 to 1."""
        return self.mean_dispersion(seconds) / self.diagonal

    def to_json(self, seconds: float | None = None) -> dict[str, Any]:
        """As JSON values, figures at a time or at the end; what never happened is null."""
        at = float(self.time[-1]) if seconds is None else seconds
        return {
            "seconds": at,
            "coverage": self.coverage_at(at),
            "ideal_share": self.ideal_share(at),
            "capped_share": self.capped_share(at),
            "time_to_95_percent": _finite(self.time_to(0.95)),
            "time_to_all_features": _finite(self.time_to_all_features),
            "dispersion": self.mean_dispersion(at),
            "normalised_dispersion": self.normalised_dispersion(at),
            "driven": float(np.interp(at, self.time, self.driven)),
            "robots": self.robots,
            "speed": self.speed,
            "sensor_width": self.width,
            "area": self.size,
            "found": [_finite(t) for t in self.found.tolist()],
            "over_time": {
                "time": self.time.tolist(),
                "coverage": [round(v, 6) for v in self.coverage.tolist()],
                "dispersion": [round(v, 3) for v in self.dispersion.tolist()],
            },
        }

    def to_text(self) -> str:
        """``to_json`` as a line of text."""
        return json.dumps(self.to_json())


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
