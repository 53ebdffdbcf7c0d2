"""Dead reckoning: where robots were by their odometry alone, and where what they saw is by that."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.log import Floats, Ints, Mission, Pose, RobotLog
from symboslam.engine.slam.odometry import pose_at
from symboslam.engine.slam.planar import between, compose, place
from symboslam.engine.slam.slam_map import MappedLandmarks, SlamMap, Trajectory
from symboslam.errors import InputError

By = Literal["key", "identity"]
"""What tells that two sightings are of one thing: the log's keys, or the truth."""
Lost = Literal["origin", "left out"]
"""What becomes of robots whose start is not known."""


def dead_reckoned(
    mission: Mission, every: float = 0.0, *, by: By = "key", lost: Lost = "origin"
) -> SlamMap:
    """The map by odometry alone, from the starts. Landmarks are at the mean of their sightings.

    Args:
        mission: the logs.
        every: seconds from one pose to the next at least; 0 keeps all.
        by: ``key``: sightings with the same key are of one landmark, each other one is a landmark
            of its own. ``identity``, for comparison alone: the truth says what each is of, so that
            all error comes from the odometry; what it does not know is of nothing.
        lost: robots whose start is not known begin at the ``origin``, or are ``left out`` (but the
            first robot, if no start is known at all: the map is in its frame).

    Raises:
        InputError: by identity, and the mission has none.
    """
    if by == "identity" and not mission.identity:
        raise InputError(
            "dead reckoning by identity maps what the truth says that sightings are of, and this "
            "mission does not say; without identities, use the paper's merging (paper_map)"
        )
    starts, told = starts_of(mission, lost)
    notes = ["robots are where their odometry puts them; nothing was estimated"]
    keys = {str(key) for log in mission.robots for key in log.seen.key} if by == "key" else set()
    numbers: dict[str, int] = {}
    landmark_of = {log.name: np.full(len(log.seen), -1, np.int64) for log in mission.robots}
    paths, points, rows = {}, [np.empty((0, 2))], [np.empty((0, 3))]
    unplaced = 0
    for log in mission.robots:
        if log.name not in starts:
            continue
        path = path_of(log, starts[log.name])
        paths[log.name] = _thinned(path, every)
        xy = points_of(log, path)
        names = _by_key(log, keys) if by == "key" else _by_identity(log, mission)
        wanted = (names != "") & (log.seen.feature >= 0)
        use = np.flatnonzero(wanted & np.isfinite(xy).all(1))
        unplaced += int(wanted.sum()) - len(use)
        at = [numbers.setdefault(str(name), len(numbers)) for name in names[use]]
        landmark_of[log.name][use] = at
        points.append(xy[use])
        rows.append(np.column_stack([at, log.seen.feature[use], log.seen.confidence[use]]))
    if by == "key" and (alone := len(numbers.keys() - keys)):
        notes.append(f"sightings without a key, each a landmark of its own: {alone}")
    if unplaced:
        notes.append(f"sightings with a range or a bearing alone, which place nothing: {unplaced}")
    marks = _means(np.concatenate(points), np.concatenate(rows), list(numbers), mission, keys)
    return SlamMap(
        trajectories=paths,
        landmarks=marks,
        landmark_of=landmark_of,
        doubts=("this is odometry alone: it drifts",),
        notes=(*notes, *told),
    )


def path_of(log: RobotLog, start: Pose = (0.0, 0.0, 0.0)) -> Trajectory:
    """Where the robot was if it began at ``start`` and its odometry is right."""
    time, pose = log.odometry.time, log.odometry.pose
    if not len(time):
        return Trajectory(time, pose)
    return Trajectory(time, compose(start, between(pose[0], pose)))


def points_of(log: RobotLog, path: Trajectory) -> Floats:
    """(m, 2) where what was seen is, if the path is right; NaN without a range or a bearing."""
    seen = log.seen
    if not len(path.time):
        return np.full((len(seen), 2), np.nan)
    way = np.column_stack([np.cos(seen.bearing), np.sin(seen.bearing)]) * seen.range[:, None]
    return place(pose_at(path.time, path.pose, seen.time), way)


def starts_of(mission: Mission, lost: Lost = "left out") -> tuple[dict[str, Pose], list[str]]:
    """Where robots begin, and notes on those of which it is not known (see `dead_reckoned`)."""
    starts = {log.name: log.start for log in mission.robots if log.start is not None}
    unknown = [log.name for log in mission.robots if log.name not in starts]
    origin = (0.0, 0.0, 0.0)
    if lost == "origin":
        starts |= dict.fromkeys(unknown, origin)
        told = f"no start is known of {', '.join(unknown)}: put at (0, 0, 0)"
        return starts, [told] if unknown else []
    if not starts and unknown:
        starts = {unknown.pop(0): origin}
    return starts, [
        f"robot {name}: left out, as it is not known where it began" for name in unknown
    ]


def _by_key(log: RobotLog, keys: set[str]) -> NDArray[np.object_]:
    """(m,) name of what each row is of: its key, or one of its own."""
    names = []
    for row, key in enumerate(log.seen.key):
        name = str(key) or f"{log.name}-{row}"
        while not key and name in keys:
            name += "'"
        names.append(name)
    return np.array(names, object)


def _by_identity(log: RobotLog, mission: Mission) -> NDArray[np.object_]:
    """(m,) name of what each row is of by the truth; "" where that is not known."""
    known = mission.identity.get(log.name)
    if known is None or not len(known):
        return np.full(len(log.seen), "", object)
    return np.array([str(name or "") for name in known], object)


def _thinned(path: Trajectory, every: float) -> Trajectory:
    if every <= 0 or not len(path.time):
        return path
    bins = np.floor((path.time - path.time[0]) / every)
    kept: Ints = np.unique([*np.unique(bins, return_index=True)[1].tolist(), len(bins) - 1])
    return Trajectory(path.time[kept], path.pose[kept])


def _means(
    xy: Floats, rows: Floats, names: list[str], mission: Mission, keys: set[str]
) -> MappedLandmarks:
    """Landmarks at the means of (k, 2) points; rows are (k, 3) landmark, class, confidence."""
    n, classes = len(names), len(mission.classes)
    at, kind = rows[:, 0].astype(np.int64), rows[:, 1].astype(np.int64)
    count = np.bincount(at, minlength=n)
    # The class that most sightings have. Votes are sorted, as landmarks times classes may be many.
    votes, number = np.unique(at * max(classes, 1) + kind, return_counts=True)
    best = np.lexsort((votes, -number, votes // max(classes, 1)))
    first = np.unique(votes[best] // max(classes, 1), return_index=True)[1]
    feature: Ints = votes[best][first] % max(classes, 1)
    confidence = np.zeros(n)
    same = kind == feature[at]
    np.maximum.at(confidence, at[same], rows[same, 2])
    sums = np.column_stack([np.bincount(at, column, minlength=n) for column in xy.T])
    return MappedLandmarks(
        id=np.array(names, object),
        xy=sums / np.maximum(count, 1)[:, None],
        covariance=np.full((n, 2, 2), np.nan),
        feature=feature,
        confidence=confidence,
        sightings=count.astype(np.int64),
        dynamic=mission.dynamic[feature],
        key=np.array([name if name in keys else "" for name in names], object),
    )
