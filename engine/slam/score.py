"""SlamScore: all figures of one comparison, as values and as JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from symboslam.engine.slam.error_statistics import Statistics
from symboslam.engine.slam.identity_error import IdentityScore
from symboslam.engine.slam.landmark_error import LandmarkScore
from symboslam.engine.slam.trajectory_error import TrajectoryScore


@dataclass(frozen=True)
class SlamScore:
    """How well a map agrees with the truth; None stands for what cannot be computed.

    Attributes:
        robots: robot -> errors of its path, for those that have a true one.
        robots_missing: robots that have a true path, but none in the map.
        landmarks_mapped: static landmarks of the map.
        landmarks_true: true landmarks.
        radius: metres within which landmarks were matched.
        raw: the paper's figures by position, in the frame of the map.
        aligned: the same after the best rigid alignment.
        identities: what the true identity of sightings tells.
        by_identity: whether the pairs behind the next three are known by identity; if not, they
            are those of ``raw``.
        matched: true landmarks for which a landmark stands.
        error: metres of these landmarks from the true ones, in the frame of the map.
        error_aligned: the same after the best rigid alignment of these pairs.
        notes: what could not be compared, one sentence each.
    """

    robots: Mapping[str, TrajectoryScore]
    robots_missing: tuple[str, ...]
    landmarks_mapped: int
    landmarks_true: int | None = None
    radius: float | None = None
    raw: LandmarkScore | None = None
    aligned: LandmarkScore | None = None
    identities: IdentityScore | None = None
    by_identity: bool = False
    matched: int | None = None
    error: Statistics | None = None
    error_aligned: Statistics | None = None
    notes: tuple[str, ...] = ()

    @property
    def ate(self) -> tuple[float, ...]:
        """RMSE in metres of each robot's path after its alignment, as evo's ``ape -a``."""
        return tuple(robot.ate.rmse for robot in self.robots.values() if robot.ate is not None)

    def to_json(self) -> dict[str, Any]:
        """All figures under the names that docs/slam-evaluation.md defines."""
        ate, known = self.ate, self.identities
        return {
            "landmarks_true": self.landmarks_true,
            "landmarks_mapped": self.landmarks_mapped,
            "landmarks_matched": self.matched,
            "matched_by": "identity" if self.by_identity else "position",
            **_statistics("landmark", self.error),
            **_statistics("landmark_aligned", self.error_aligned),
            "radius_m": self.radius,
            "raw": _by_position(self.raw),
            "aligned": _by_position(self.aligned),
            "duplicates": known and known.duplicates,
            "wrong_merges": known and known.wrong_merges,
            "sightings": known and known.sightings,
            "wrong_sightings": known and known.wrong_sightings,
            "wrong_sightings_share": known.wrong_sightings / known.sightings
            if known and known.sightings
            else None,
            "missed": known and len(known.missed),
            "ate_mean_m": float(np.mean(ate)) if ate else None,
            "ate_max_m": max(ate, default=None),
            "robots_missing": list(self.robots_missing),
            "robots": {name: _trajectory(robot) for name, robot in self.robots.items()},
            "notes": list(self.notes),
        }


def _by_position(score: LandmarkScore | None) -> dict[str, Any] | None:
    if score is None:
        return None
    return {
        "matched": len(score.pairs),
        "coverage": score.coverage,
        "accuracy": score.accuracy,
        **_statistics("offset", score.offset),
    }


def _trajectory(score: TrajectoryScore) -> dict[str, Any]:
    return {
        "poses": score.poses,
        **_statistics("ate", score.ate),
        **_statistics("ate_raw", score.ate_raw),
        "rpe_delta": str(score.delta),
        **_statistics("rpe", score.rpe_translation),
        **_statistics("rpe", score.rpe_rotation, "rad"),
    }


def _statistics(name: str, found: Statistics | None, unit: str = "m") -> dict[str, float | None]:
    return {
        f"{name}_{kind}_{unit}": None if found is None else getattr(found, kind)
        for kind in ("rmse", "mean", "median", "max")
    }
