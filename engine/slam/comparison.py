"""Comparison of ways to map a mission by a few figures; what its picture is drawn of."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from symboslam.engine.slam.error_statistics import Statistics
from symboslam.engine.slam.identity_error import holders
from symboslam.engine.slam.log import Mission
from symboslam.engine.slam.metrics import evaluate_slam, static_points, true_points
from symboslam.engine.slam.planar import place, rigid
from symboslam.engine.slam.score import SlamScore
from symboslam.engine.slam.score_files import Side
from symboslam.engine.slam.slam_map import SlamMap, Trajectory
from symboslam.engine.slam.trajectory_error import distances


@dataclass(frozen=True)
class Figures:
    """How good a map is, in short; None stands for what cannot be computed.

    Attributes:
        landmark_rmse_m: of the true landmarks that were mapped, from the landmark that holds most
            of their sightings, after the best rigid alignment of these pairs.
        landmark_rmse_raw_m: the same in the frame of the map.
        ate_mean_m: mean over the robots of the RMSE of their paths, each aligned by itself.
        ate_max_m: the largest of these.
        landmarks_matched: true landmarks for which a landmark stands: most of its sightings are of
            that one.
        landmarks_true: all of them.
        landmarks_mapped: static landmarks in the map.
        wrong_merges: see ``IdentityScore``.
        duplicates: likewise.
        wrong_sightings_share: of the sightings, those attached to a landmark of another thing.
        robots_missing: robots that have a true path, but none in the map.
        seconds: that the map took.
    """

    landmark_rmse_m: float | None
    landmark_rmse_raw_m: float | None
    ate_mean_m: float | None
    ate_max_m: float | None
    landmarks_matched: int | None
    landmarks_true: int | None
    landmarks_mapped: int
    wrong_merges: int | None
    duplicates: int | None
    wrong_sightings_share: float | None
    robots_missing: tuple[str, ...]
    seconds: float

    def to_json(self) -> dict[str, Any]:
        """All figures by name."""
        return asdict(self) | {"robots_missing": list(self.robots_missing)}


@dataclass(frozen=True)
class Result:
    """A map with its figures.

    Attributes:
        slam_map: the map.
        score: all that can be said of it.
        figures: in short.
    """

    slam_map: SlamMap
    score: SlamScore
    figures: Figures


def blind(mission: Mission) -> Mission:
    """The mission without truth and identities: no way to map can look at them."""
    return replace(mission, identity={}, truth=None)


def measure(make: Callable[[], SlamMap], mission: Mission) -> Result:
    """Make a map, and compare it with the truth.

    Args:
        make: makes it; its time is taken.
        mission: with truth and identities.
    """
    begun = time.perf_counter()
    found = make()
    seconds = time.perf_counter() - begun
    score = evaluate_slam(found, mission)
    known = score.to_json()
    raw, aligned = _landmark_errors(found, mission)
    return Result(found, score, Figures(
        landmark_rmse_m=None if aligned is None else aligned.rmse,
        landmark_rmse_raw_m=None if raw is None else raw.rmse,
        ate_mean_m=float(np.mean(score.ate)) if score.ate else None,
        ate_max_m=max(score.ate, default=None),
        landmarks_matched=score.matched,
        landmarks_true=score.landmarks_true,
        landmarks_mapped=score.landmarks_mapped,
        wrong_merges=known["wrong_merges"],
        duplicates=known["duplicates"],
        wrong_sightings_share=known["wrong_sightings_share"],
        robots_missing=score.robots_missing,
        seconds=round(seconds, 3),
    ))  # fmt: skip


def sides(slam_map: SlamMap, mission: Mission) -> tuple[Side, Side]:
    """A map and the truth of its mission, for ``score_picture.draw``."""
    truth = mission.truth
    paths: Mapping[str, Trajectory] = {}
    if truth is not None:
        paths = {name: Trajectory(t[:, 0], t[:, 1:]) for name, t in truth.trajectories.items()}
    points = true_points(mission)[0] if truth is not None and truth.landmarks else None
    return Side(slam_map.trajectories, static_points(slam_map)), Side(paths, points)


def _landmark_errors(
    slam_map: SlamMap, mission: Mission
) -> tuple[Statistics | None, Statistics | None]:
    """Errors by identity in the frame of the map, and aligned; that takes two landmarks."""
    if mission.truth is None or not mission.identity:
        return None, None
    places = mission.truth.landmarks
    pairs = [
        (at, places[name]) for name, at in holders(slam_map, mission).items() if name in places
    ]
    found = slam_map.landmarks.xy[[at for at, _ in pairs]].reshape(-1, 2)
    true = np.array([xy for _, xy in pairs], float).reshape(-1, 2)
    raw = Statistics.of(distances(found, true))
    if len(pairs) < 2:
        return raw, None
    return raw, Statistics.of(distances(place(rigid(found, true), found), true))
