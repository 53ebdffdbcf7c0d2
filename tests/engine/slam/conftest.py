"""Small maps and missions of which all numbers can be computed by hand."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest

from symboslam.engine.slam.beliefs import ClassBeliefs
from symboslam.engine.slam.joint import Member, Piece
from symboslam.engine.slam.log import (
    Measurements,
    Mission,
    Odometry,
    OdometryNoise,
    RobotLog,
    Truth,
)
from symboslam.engine.slam.planar import between
from symboslam.engine.slam.pose_graph import PoseGraph, Sighting
from symboslam.engine.slam.slam_map import MappedLandmarks, SlamMap, Trajectory
from symboslam.engine.slam.tracks import Track

CLASSES = ("House", "Cottage", "Tree", "Dog")
SIMILARITY = np.eye(4)
SIMILARITY[0, 1] = SIMILARITY[1, 0] = 0.8


@pytest.fixture
def marks() -> Callable[..., MappedLandmarks]:
    """Landmarks from rows of (x, y, class)."""

    def make(rows: Sequence[tuple[float, float, str]]) -> MappedLandmarks:
        n = len(rows)
        feature = np.array([CLASSES.index(name) for _, _, name in rows], np.int64)
        return MappedLandmarks(
            id=np.array([f"L{i + 1}" for i in range(n)], object),
            xy=np.array([row[:2] for row in rows], float).reshape(-1, 2),
            covariance=np.full((n, 2, 2), np.nan),
            feature=feature,
            confidence=np.ones(n),
            sightings=np.ones(n, np.int64),
            dynamic=feature == CLASSES.index("Dog"),
            key=np.full(n, "", object),
        )

    return make


@pytest.fixture
def log() -> Callable[..., RobotLog]:
    """A robot's log from its odometry and rows of (time, range, bearing, class, confidence)."""

    def make(
        name: str,
        pose: Any,
        rows: Sequence[tuple[float, float, float, str, float]] = (),
        start: tuple[float, float, float] | None = (0.0, 0.0, 0.0),
    ) -> RobotLog:
        columns = np.array([row[:3] for row in rows], float).reshape(-1, 3).T
        seen = Measurements(
            time=columns[0],
            range=columns[1],
            bearing=columns[2],
            feature=np.array([CLASSES.index(row[3]) for row in rows], np.int64),
            confidence=np.array([row[4] for row in rows], float),
            key=np.full(len(rows), "", object),
        )
        way = np.asarray(pose, float).reshape(-1, 3)
        return RobotLog(name, Odometry(np.arange(len(way), dtype=float), way), seen, start)

    return make


@pytest.fixture
def mission() -> Callable[..., Mission]:
    """A mission of these robots, with the classes above."""

    def make(
        *robots: RobotLog,
        identity: dict[str, list[Any]] | None = None,
        truth: Truth | None = None,
    ) -> Mission:
        return Mission(
            robots=robots,
            classes=CLASSES,
            dynamic=np.array([name == "Dog" for name in CLASSES]),
            similarity=SIMILARITY,
            identity={k: np.array(v, object) for k, v in (identity or {}).items()},
            truth=truth,
        )

    return make


@pytest.fixture
def slam_map() -> Callable[..., SlamMap]:
    """A map of these landmarks; robot -> what each of its sightings is of, robot -> (n, 4) path."""

    def make(
        landmarks: MappedLandmarks,
        of: dict[str, list[int]] | None = None,
        paths: dict[str, Any] | None = None,
    ) -> SlamMap:
        rows = {name: np.asarray(path, float) for name, path in (paths or {}).items()}
        trajectories = {name: Trajectory(path[:, 0], path[:, 1:]) for name, path in rows.items()}
        return SlamMap(
            trajectories, landmarks, {k: np.array(v, np.int64) for k, v in (of or {}).items()}
        )

    return make


@pytest.fixture
def robot() -> Callable[..., Member]:
    """A robot of a joint graph that knows where it was: a pose each second.

    Tracks are label -> rows of (number of the pose, x, y of what is seen in the map's frame).
    """

    def make(
        name: str,
        poses: Sequence[tuple[float, float, float]],
        tracks: dict[int, list[tuple[int, float, float]]],
        feature: dict[int, int] | None = None,
        key: dict[int, str] | None = None,
    ) -> Member:
        way = np.asarray(poses, float)
        graph, beliefs = PoseGraph(name), ClassBeliefs(np.eye(8))
        noise = OdometryNoise(along=0.05, across=0.02, turn=0.05, floor=(0.001, 0.001, 0.001))
        for n, pose in enumerate(way):
            graph.extend(float(n), pose, noise)
        pieces = []
        for number, (label, rows) in enumerate(tracks.items()):
            kind, called = (feature or {}).get(label, 0), (key or {}).get(label, "")
            seen = []
            for row, (at, x, y) in enumerate(rows):
                away = between(way[at], (x, y, 0))
                reach, bearing = float(np.hypot(*away[:2])), float(np.arctan2(away[1], away[0]))
                place = (row, float(at), at, reach, bearing)
                seen.append(Sighting(*place, 0.1, 0.01, kind, 0.95, called, number))
            evidence = sum((beliefs.likelihood(kind, 0.95) for _ in seen), np.zeros(8))
            x, y = graph.at(seen[0]).tolist()
            track = Track(number, evidence, x, y, seen[0].variance,
                          seen[0].pose, seen[-1].pose, seen, called)  # fmt: skip
            pieces.append(Piece(0, track, label))
        return Member(name, graph, way.copy(), (0.01, 0.01, 0.01), pieces)

    return make
