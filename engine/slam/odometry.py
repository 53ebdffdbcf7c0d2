"""Odometry from velocities or steps, and where a robot was by it at any time."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from symboslam.engine.slam.log import Floats, Mission, Odometry, RobotLog
from symboslam.engine.slam.planar import between, compose, place, wrap
from symboslam.engine.slam.slam_map import MappedLandmarks, SlamMap, Trajectory


def arcs(forward: Floats, turning: Floats, duration: Floats) -> Floats:
    """(n, 3) steps of a robot that drives with constant velocities: arcs of circles, exact.

    Args:
        forward: (n,) metres a second.
        turning: (n,) radians a second.
        duration: (n,) seconds.
    """
    way, turn = forward * duration, turning * duration
    ahead = way * np.sinc(turn / np.pi)  # sin(a) / a
    aside = way * np.sin(turn / 2) * np.sinc(turn / 2 / np.pi)  # (1 - cos(a)) / a
    return np.column_stack([ahead, aside, turn])


def chain(start: ArrayLike, steps: Floats) -> Floats:
    """(n + 1, 3) poses that (n, 3) steps lead to, one after the other, from a start."""
    x, y, heading = np.asarray(start, float)
    headings = heading + np.concatenate([[0.0], np.cumsum(steps[:, 2])])
    cos, sin = np.cos(headings[:-1]), np.sin(headings[:-1])
    east = np.cumsum(np.append(x, cos * steps[:, 0] - sin * steps[:, 1]))
    north = np.cumsum(np.append(y, sin * steps[:, 0] + cos * steps[:, 1]))
    return np.column_stack([east, north, wrap(headings)])


def pose_at(time: Floats, pose: Floats, when: ArrayLike) -> Floats:
    """(..., 3) poses at times, between the (n, 3) known ones in a straight line.

    Before the first and behind the last pose the robot stands still.
    """
    at = np.asarray(when, float)
    x, y = (np.interp(at, time, pose[:, i]) for i in (0, 1))
    return np.stack([x, y, wrap(np.interp(at, time, np.unwrap(pose[:, 2])))], -1)


def dead_reckoned(mission: Mission, every: float = 0.0) -> SlamMap:
    """The map by odometry alone, from the starts; robots without a start begin at (0, 0, 0).

    Landmarks are the things whose ``key`` is known, or else each of ``Mission.identity``; each
    lies at the mean of where it was seen. Nothing is estimated: this is what there was before.

    Args:
        mission: the logs.
        every: seconds from one pose to the next at least; 0 keeps all.
    """
    paths = {log.name: _path(log, every) for log in mission.robots}
    seen: dict[str, list[tuple[float, float, int, float]]] = {}
    names = {}
    for log in mission.robots:
        names[log.name] = thing = _things(mission, log)
        at = compose(
            _offset(log), pose_at(log.odometry.time, log.odometry.pose, log.seen.time)
        ) if len(log.seen) else np.zeros((0, 3))  # fmt: skip
        reach, angle = log.seen.range, log.seen.bearing
        spots = place(at, np.column_stack([reach * np.cos(angle), reach * np.sin(angle)]))
        for i in np.flatnonzero((thing != "") & np.isfinite(spots).all(1)).tolist():
            row = (*spots[i].tolist(), int(log.seen.feature[i]), float(log.seen.confidence[i]))
            seen.setdefault(str(thing[i]), []).append(row)
    order = {name: i for i, name in enumerate(seen)}
    notes = ["robots are where their odometry puts them; nothing was estimated"]
    known = {str(t) for thing in names.values() for t in thing if t}
    if len(seen) < len(known):
        notes.append(f"landmarks without both range and bearing left out: {len(known - set(seen))}")
    nameless = sum(
        int(((thing == "") & (log.seen.feature >= 0)).sum())
        for log in mission.robots
        for thing in [names[log.name]]
    )
    if nameless:
        notes.append(f"sightings without a known landmark left out: {nameless}")
    homeless = [log.name for log in mission.robots if log.start is None]
    if homeless:
        notes.append(f"no start is known of {', '.join(homeless)}: put at (0, 0, 0)")
    return SlamMap(
        trajectories=paths,
        landmarks=_landmarks(mission, seen),
        landmark_of={
            name: np.array([order.get(str(t), -1) for t in thing], np.int64)
            for name, thing in names.items()
        },
        doubts=("this is odometry alone: it drifts",),
        notes=tuple(notes),
    )


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


def _things(mission: Mission, log: RobotLog) -> np.ndarray[tuple[int], np.dtype[np.object_]]:
    """(m,) name of what each row is of; "" where that is not known, and for robots."""
    names = np.asarray(mission.identity.get(log.name, log.seen.key), object)
    names = np.where(log.seen.key != "", log.seen.key, names)
    return np.where(log.seen.feature < 0, "", names)


def _landmarks(
    mission: Mission, seen: dict[str, list[tuple[float, float, int, float]]]
) -> MappedLandmarks:
    keys = {str(k) for log in mission.robots for k in log.seen.key}
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
