"""Metrics of map building: how well a SlamMap agrees with the truth (docs/slam-evaluation.md)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from symboslam.engine.slam.error_statistics import Statistics
from symboslam.engine.slam.identity_error import IdentityScore, score_identities
from symboslam.engine.slam.landmark_error import (
    SIMILAR,
    Points,
    score_aligned,
    score_landmarks,
)
from symboslam.engine.slam.log import Floats, Ints, Mission
from symboslam.engine.slam.planar import place, rigid
from symboslam.engine.slam.score import SlamScore
from symboslam.engine.slam.slam_map import SlamMap, Trajectory
from symboslam.engine.slam.spacing import radius_by_spacing
from symboslam.engine.slam.trajectory_error import (
    MAX_DIFF,
    ONE_METRE,
    Delta,
    associate,
    distances,
    score_trajectory,
)
from symboslam.errors import InputError


@dataclass(frozen=True)
class Options:
    """How to compare.

    Attributes:
        radius: longest distance in metres of a landmark from the true one that it is matched with;
            None for half the spacing of the true landmarks, at most 12 m.
        least: least semantic similarity of classes that are matched.
        max_diff: seconds by which the times of an estimated and a true pose may differ.
        delta: what the relative pose errors are over.
    """

    radius: float | None = None
    least: float = SIMILAR
    max_diff: float = MAX_DIFF
    delta: Delta = ONE_METRE

    def __post_init__(self) -> None:
        if self.radius is not None and not 0 < self.radius < np.inf:
            raise InputError(f"radius is {self.radius}; give metres > 0")
        if not 0 <= self.max_diff < np.inf:
            raise InputError(f"max_diff is {self.max_diff}; give seconds >= 0")


def evaluate_slam(slam_map: SlamMap, mission: Mission, options: Options | None = None) -> SlamScore:
    """Compare a map with the truth of its mission, as far as there is one.

    What cannot be computed is None: errors of landmarks without true landmarks, of paths without
    true paths, and what needs identities without ``mission.identity``.

    Args:
        slam_map: what an estimator made of the mission.
        mission: with ``truth``, ``identity``, both or none.
        options: how to compare.

    Raises:
        InputError: the identities or the map's ``landmark_of`` do not fit the logs.
    """
    truth, static = mission.truth, np.flatnonzero(~slam_map.landmarks.dynamic)
    found = static_points(slam_map)
    true, similarity = None, mission.similarity
    if truth is not None and truth.landmarks:
        true, similarity = true_points(mission)
    identities = pairs = None
    if mission.identity:
        identities = score_identities(slam_map, mission)
        if true is not None:
            row = {name: j for j, name in enumerate(true.id)}
            stands = [(at, row[n]) for n, at in identities.stands.items() if n in row]
            pairs = np.array(stands, np.int64).reshape(-1, 2)
            pairs[:, 0] = np.searchsorted(static, pairs[:, 0])
    return compare(
        slam_map.trajectories,
        {} if truth is None else truth.trajectories,
        found,
        true,
        similarity,
        options,
        identities=identities,
        pairs=pairs,
    )


def compare(
    trajectories: Mapping[str, Trajectory],
    true_trajectories: Mapping[str, Floats],
    found: Points,
    true: Points | None,
    similarity: Floats,
    options: Options | None = None,
    *,
    identities: IdentityScore | None = None,
    pairs: Ints | None = None,
) -> SlamScore:
    """Compare paths and landmarks with true ones.

    Args:
        trajectories: robot -> estimated path.
        true_trajectories: robot -> (n, 4) time, x, y, heading.
        found: estimated landmarks.
        true: true ones; None for none.
        similarity: (C, C) of the classes of both.
        options: how to compare.
        identities: what identities tell, where known.
        pairs: (k, 2) landmarks and true ones that belong together by identity, where known.
    """
    options = options or Options()
    robots = {
        name: score_trajectory(
            path.time,
            path.pose,
            true_trajectories[name],
            max_diff=options.max_diff,
            delta=options.delta,
        )
        for name, path in trajectories.items()
        if name in true_trajectories
    }
    missing = tuple(sorted(true_trajectories.keys() - trajectories.keys()))
    notes = [f"robot {name} has a true path, but none in the map" for name in missing]
    notes += [
        f"robot {name}: no pose within {options.max_diff:g} s of a true one; is it another clock, "
        "or does it want a larger max_diff?"
        for name, score in robots.items()
        if not score.poses
    ]
    if true is None or not len(true):
        return SlamScore(robots, missing, len(found), identities=identities, notes=tuple(notes))
    radius = options.radius or radius_by_spacing(true.xy)
    raw = score_landmarks(found, true, similarity, radius, least=options.least)
    if pairs is not None and len(pairs) >= 2:
        start: Floats | None = rigid(found.xy[pairs[:, 0]], true.xy[pairs[:, 1]])
    else:
        start = _alignment_of_paths(trajectories, true_trajectories, options.max_diff)
    aligned = score_aligned(found, true, similarity, radius, least=options.least, start=start)
    by_identity = pairs is not None
    if pairs is None:
        pairs = raw.pairs
    return SlamScore(
        robots,
        missing,
        len(found),
        landmarks_true=len(true),
        radius=radius,
        raw=raw,
        aligned=aligned,
        identities=identities,
        by_identity=by_identity,
        matched=len(pairs),
        error=Statistics.of(distances(found.xy[pairs[:, 0]], true.xy[pairs[:, 1]])),
        error_aligned=_aligned_error(found, true, pairs),
        notes=tuple(notes),
    )


def _aligned_error(found: Points, true: Points, pairs: Ints) -> Statistics | None:
    """Distances of pairs after their own best alignment; None for fewer than two."""
    if len(pairs) < 2:
        return None
    one, other = found.xy[pairs[:, 0]], true.xy[pairs[:, 1]]
    return Statistics.of(distances(place(rigid(one, other), one), other))


def _alignment_of_paths(
    trajectories: Mapping[str, Trajectory], truth: Mapping[str, Floats], max_diff: float
) -> Floats | None:
    """One alignment of all robots' paths together; None with fewer than two poses."""
    one, other = [np.empty((0, 2))], [np.empty((0, 2))]
    for name in sorted(trajectories.keys() & truth.keys()):
        i, j = associate(trajectories[name].time, truth[name][:, 0], max_diff)
        one.append(trajectories[name].pose[i, :2])
        other.append(truth[name][j, 1:3])
    found, true = np.concatenate(one), np.concatenate(other)
    return rigid(found, true) if len(found) >= 2 else None


def static_points(slam_map: SlamMap) -> Points:
    """The static landmarks of a map."""
    marks = slam_map.landmarks
    static = ~marks.dynamic
    return Points(marks.id[static], marks.xy[static], marks.feature[static])


def true_points(mission: Mission) -> tuple[Points, Floats]:
    """The static true landmarks, and the similarity with classes that only the truth has added.

    Args:
        mission: with ``truth``.
    """
    assert mission.truth is not None
    classes = list(mission.classes)
    number = {name: i for i, name in enumerate(classes)}
    marks = mission.truth.landmarks
    names, feature = [], []
    for name in marks:
        label = mission.truth.features.get(name)
        at = -1 if label is None else number.setdefault(label, len(number))
        if at < 0 or at >= len(classes) or not mission.dynamic[at]:
            names.append(name)
            feature.append(at)
    similarity = np.eye(len(number) + 1)
    similarity[: len(classes), : len(classes)] = mission.similarity
    xy = np.array([marks[name] for name in names], float).reshape(-1, 2)
    return Points(np.array(names, object), xy, np.array(feature, np.int64)), similarity
