"""The map by odometry alone: what there is before anything is estimated."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.log import Floats, Mission, Odometry, RobotLog
from symboslam.engine.slam.odometry import pose_at
from symboslam.engine.slam.planar import between, compose, place
from symboslam.engine.slam.slam_map import MappedLandmarks, SlamMap, Trajectory


def dead_reckoned(mission: Mission, every: float = 0.0) -> SlamMap:
    """The map by odometry alone, from the starts; robots without a start begin at (0, 0, 0).

    Sightings with the same ``key`` are of one landmark, at the mean of where they lie; each other
    one is a landmark of its own. ``Mission.identity`` is not looked at.

    Args:
        mission: the logs.
        every: seconds from one pose to the next at least; 0 keeps all.
    """
    keys = {str(key) for log in mission.robots for key in log.seen.key}
    things = {log.name: _things(log, keys) for log in mission.robots}
    seen: dict[str, list[tuple[float, float, int, float]]] = {}
    unplaced = 0
    for log in mission.robots:
        thing, spots = things[log.name], _spots(log)
        good = (thing != "") & np.isfinite(spots).all(1)
        unplaced += int(((thing != "") & ~good).sum())
        for i in np.flatnonzero(good).tolist():
            row = (*spots[i].tolist(), int(log.seen.feature[i]), float(log.seen.confidence[i]))
            seen.setdefault(str(thing[i]), []).append(row)
    order = {name: i for i, name in enumerate(seen)}
    notes = ["robots are where their odometry puts them; nothing was estimated"]
    alone = len(seen.keys() - keys)
    if alone:
        notes.append(f"sightings without a key, each a landmark of its own: {alone}")
    if unplaced:
        notes.append(f"sightings with a range or a bearing alone, which place nothing: {unplaced}")
    homeless = [log.name for log in mission.robots if log.start is None]
    if homeless:
        notes.append(f"no start is known of {', '.join(homeless)}: put at (0, 0, 0)")
    return SlamMap(
        trajectories={log.name: _path(log, every) for log in mission.robots},
        landmarks=_landmarks(mission, seen, keys),
        landmark_of={
            name: np.array([order.get(str(t), -1) for t in thing], np.int64)
            for name, thing in things.items()
        },
        doubts=("this is odometry alone: it drifts",),
        notes=tuple(notes),
    )


def _things(log: RobotLog, keys: set[str]) -> NDArray[np.object_]:
    """(m,) name of what each row is of: its key, or one of its own; "" for robots."""
    names = []
    for row, (key, feature) in enumerate(zip(log.seen.key, log.seen.feature, strict=True)):
        name = str(key) or f"{log.name}-{row}"
        while not key and name in keys:
            name += "'"
        names.append(name if feature >= 0 else "")
    return np.array(names, object)


def _spots(log: RobotLog) -> Floats:
    """(m, 2) where each sighting lies; NaN where range or bearing is missing."""
    at = pose_at(log.odometry.time, log.odometry.pose, log.seen.time)
    reach, angle = log.seen.range, log.seen.bearing
    ahead = np.column_stack([reach * np.cos(angle), reach * np.sin(angle)])
    return place(compose(_offset(log), at), ahead)


def _offset(log: RobotLog) -> Floats:
    """(3,) pose of the odometry's frame in the collective frame."""
    origin = between(log.odometry.pose[0], (0, 0, 0))
    return compose((0, 0, 0) if log.start is None else log.start, origin)


def _path(log: RobotLog, every: float) -> Trajectory:
    odometry: Odometry = log.odometry
    kept = np.arange(len(odometry))
    if every > 0:
        bins = np.floor((odometry.time - odometry.time[0]) / every)
        kept = np.unique([*np.unique(bins, return_index=True)[1].tolist(), len(odometry) - 1])
    return Trajectory(odometry.time[kept], compose(_offset(log), odometry.pose[kept]))


def _landmarks(
    mission: Mission, seen: dict[str, list[tuple[float, float, int, float]]], keys: set[str]
) -> MappedLandmarks:
    rows = [np.array(found) for found in seen.values()]
    classes = [int(np.bincount(r[:, 2].astype(int)).argmax()) for r in rows]
    return MappedLandmarks(
        id=np.array(list(seen), object),
        xy=np.array([r[:, :2].mean(0) for r in rows]).reshape(-1, 2),
        covariance=np.full((len(rows), 2, 2), np.nan),
        feature=np.array(classes, np.int64),
        confidence=np.array([r[:, 3].max() for r in rows]),
        sightings=np.array([len(r) for r in rows], np.int64),
        dynamic=mission.dynamic[classes] if rows else np.zeros(0, np.bool_),
        key=np.array([name if name in keys else "" for name in seen], object),
    )
