"""A pose graph as the logs of robots, and the estimate that it holds as a map."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.dead_reckoning import dead_reckoned
from symboslam.engine.slam.log import (
    SIGMA_BEARING,
    SIGMA_RANGE,
    Closures,
    Fixes,
    Floats,
    Measurements,
    Mission,
    Odometry,
    OdometryNoise,
    Pose,
    RobotLog,
)
from symboslam.engine.slam.odometry import chain
from symboslam.engine.slam.planar import compose
from symboslam.engine.slam.readers.pose_graph import (
    Chain,
    Edge,
    PoseGraph,
    Sighting,
    chains_of,
    name_of,
)
from symboslam.engine.slam.readers.text import count
from symboslam.engine.slam.slam_map import MappedLandmarks, SlamMap, Trajectory
from symboslam.errors import InputError

LANDMARK = "Landmark"
"""The one class of what pose graphs have as landmarks."""
IDENTITIES = ("shown", "hidden")


def mission_of(graph: PoseGraph, identities: str = "shown") -> tuple[Mission, list[str]]:
    """The logs that the graph is made of, with one second from pose to pose.

    Args:
        graph: it.
        identities: ``shown``: the key of each sighting is its landmark's number; ``hidden``: that
            is in ``Mission.identity`` only.

    Raises:
        InputError: there is no odometry, or the option is wrong.
    """
    if identities not in IDENTITIES:
        raise InputError(f"identities is {identities!r}; it can be {' or '.join(IDENTITIES)}")
    chains, others = chains_of(graph)
    notes = [*graph.notes, f"{graph.path.name} has no times: one second from pose to pose"]
    if graph.ignored:
        tags = ", ".join(f"{tag} ({n})" for tag, n in graph.ignored.most_common())
        notes.append(f"{graph.path.name}: lines that were not used: {tags}")
    if len(chains) > 1:
        notes.append(f"the poses fall into {len(chains)} chains: read as {len(chains)} robots")
    inside = _closures_of(chains, others, notes)
    seen: dict[str, list[Sighting]] = {part.name: [] for part in chains}
    robot_of = {i: part.name for part in chains for i in part.ids}
    for sighting in graph.sightings:
        seen[robot_of[sighting.pose]].append(sighting)
    for found in seen.values():
        found.sort(key=lambda sighting: sighting.pose)
    identity = {
        name: np.array([name_of(s.landmark) for s in found], object) for name, found in seen.items()
    }
    logs = []
    for number, part in enumerate(chains):
        names = identity[part.name]
        key = names.copy() if identities == "shown" else np.full(len(names), "", object)
        logs.append(
            RobotLog(
                part.name,
                _odometry(part, notes),
                _measurements(part, seen[part.name], key),
                _start(graph, part, first=number == 0),
                fixes=_fixes(graph, part),
                closures=_closures(inside[part.name], part, notes),
            )
        )
    unit = np.eye(1)
    return Mission(tuple(logs), (LANDMARK,), np.zeros(1, np.bool_), unit, identity), notes


def estimate_of(graph: PoseGraph, mission: Mission) -> SlamMap | None:
    """The map of the file's own estimates, or None where it has none.

    Poses without one lie where odometry leads from the pose before; landmarks without one are at
    the mean of where they are seen by odometry.
    """
    if not graph.poses:
        return None
    chains, _ = chains_of(graph)
    driven = dead_reckoned(_shown(mission))
    paths, missing = {}, 0
    for part in chains:
        poses: list[Floats] = []
        for i, number in enumerate(part.ids):
            known = graph.poses.get(number)
            missing += known is None
            if known is not None:
                poses.append(np.array(known))
            else:
                before = poses[-1] if poses else np.zeros(3)
                poses.append(compose(before, part.edges[i - 1].step) if i else before)
        paths[part.name] = Trajectory(np.arange(len(poses), dtype=float), np.array(poses))
    marks, lost = _placed(graph, mission, driven)
    notes = [f"poses and landmarks are the estimates of {graph.path.name}"]
    if missing:
        notes.append(f"{count(missing, 'pose')} without an estimate follow odometry")
    if lost:
        notes.append(f"{count(lost, 'landmark')} with neither range nor estimate left out")
    order = {str(name): i for i, name in enumerate(marks.id)}
    landmark_of = {
        robot: np.array([order.get(str(name), -1) for name in names], np.int64)
        for robot, names in mission.identity.items()
    }
    return SlamMap(paths, marks, landmark_of, notes=tuple(notes))


def _shown(mission: Mission) -> Mission:
    """The mission with the identities as keys."""
    logs = [
        replace(log, seen=replace(log.seen, key=mission.identity[log.name]))
        for log in mission.robots
    ]
    return replace(mission, robots=tuple(logs))


def _placed(graph: PoseGraph, mission: Mission, driven: SlamMap) -> tuple[MappedLandmarks, int]:
    """Landmarks where the file has them, or else where odometry does; how many are nowhere."""
    spots = dict(zip(driven.landmarks.id.tolist(), driven.landmarks.xy.tolist(), strict=True))
    spots |= {name_of(number): list(xy) for number, xy in graph.points.items()}
    seen = Counter(str(name) for names in mission.identity.values() for name in names)
    names = np.array(list(spots), object)
    shown = {str(key) for log in mission.robots for key in log.seen.key}
    n = len(names)
    return MappedLandmarks(
        id=names,
        xy=np.array(list(spots.values()), float).reshape(-1, 2),
        covariance=np.full((n, 2, 2), np.nan),
        feature=np.zeros(n, np.int64),
        confidence=np.ones(n),
        sightings=np.array([seen[name] for name in spots], np.int64),
        dynamic=np.zeros(n, np.bool_),
        key=np.array([name if name in shown else "" for name in spots], object),
    ), len(seen.keys() - spots.keys())


def _closures_of(
    chains: list[Chain], others: list[Edge], notes: list[str]
) -> dict[str, list[Edge]]:
    """Robot -> edges between its own poses, without exact repeats."""
    robot_of = {i: part.name for part in chains for i in part.ids}
    steps = {
        (e.start, e.end, *e.step.tolist(), *e.covariance.ravel().tolist())
        for part in chains
        for e in part.edges
    }
    inside: dict[str, list[Edge]] = {part.name: [] for part in chains}
    outside = repeated = 0
    for edge in others:
        content = (edge.start, edge.end, *edge.step.tolist(), *edge.covariance.ravel().tolist())
        if content in steps:
            repeated += 1
        elif robot_of[edge.start] != robot_of[edge.end]:
            outside += 1
        else:
            inside[robot_of[edge.start]].append(edge)
        steps.add(content)
    if repeated:
        notes.append(f"{count(repeated, 'repeated edge')} left out")
    if outside:
        notes.append(
            f"{count(outside, 'edge')} between different robots left out: a log has closures of "
            "one robot only"
        )
    return inside


def _odometry(part: Chain, notes: list[str]) -> Odometry:
    """Steps, with the median of their standard deviations for each."""
    steps = np.array([edge.step for edge in part.edges]).reshape(-1, 3)
    spread = [np.sqrt(np.diag(edge.covariance)) for edge in part.edges]
    known = np.array([s for s in spread if np.isfinite(s).all()]).reshape(-1, 3)
    noise = OdometryNoise()
    if len(known):
        along, across, turn = np.median(known, 0).tolist()
        noise = OdometryNoise(0.0, 0.0, 0.0, 0.0, (along, across, turn))
        if (np.ptp(known, axis=0) > 0.01 * np.median(known, 0)).any():
            notes.append(f"{part.name}: its steps are not equally sure; their median is used")
    return Odometry(np.arange(len(part.ids), dtype=float), chain((0, 0, 0), steps), noise)


def _start(graph: PoseGraph, part: Chain, first: bool) -> Pose | None:
    """Where the file holds the first pose; the first robot's gives the frame in any case."""
    pose = graph.poses.get(part.ids[0])
    if first:
        return pose or (0.0, 0.0, 0.0)
    return pose if part.ids[0] in graph.fixed else None


def _measurements(part: Chain, seen: list[Sighting], key: NDArray[np.object_]) -> Measurements:
    when = {number: i for i, number in enumerate(part.ids)}
    return Measurements(
        time=np.array([when[s.pose] for s in seen], float),
        range=np.array([s.range for s in seen], float),
        bearing=np.array([s.bearing for s in seen], float),
        feature=np.zeros(len(seen), np.int64),
        confidence=np.ones(len(seen)),
        key=key,
        sigma_range=_known([s.sigma_range for s in seen], SIGMA_RANGE),
        sigma_bearing=_known([s.sigma_bearing for s in seen], SIGMA_BEARING),
    )


def _known(values: list[float], default: float) -> Floats:
    """(m,) deviations; those that the file does not say are the median of the others."""
    found = np.array(values, float)
    said = np.isfinite(found) & (found > 0)
    found[~said] = np.median(found[said]) if said.any() else default
    return found


def _fixes(graph: PoseGraph, part: Chain) -> Fixes | None:
    when = {number: i for i, number in enumerate(part.ids)}
    rows = sorted((when[i], x, y, sigma) for i, x, y, sigma in graph.priors if i in when)
    if not rows:
        return None
    values = np.array(rows, float)
    return Fixes(values[:, 0], values[:, 1:3], values[:, 3])


def _closures(edges: list[Edge], part: Chain, notes: list[str]) -> Closures | None:
    when = {number: i for i, number in enumerate(part.ids)}
    good = [edge for edge in edges if np.isfinite(edge.covariance).all()]
    if len(good) < len(edges):
        notes.append(
            f"{part.name}: {count(len(edges) - len(good), 'closure')} without usable information "
            "left out"
        )
    if not good:
        return None
    return Closures(
        np.array([(when[e.start], when[e.end]) for e in good], float),
        np.array([e.step for e in good]),
        np.array([e.covariance for e in good]),
    )
