"""Simulated missions: robots that walk through a square of landmarks, with all that goes wrong."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.log import (
    ROBOT,
    Floats,
    Ints,
    Measurements,
    Mission,
    Odometry,
    OdometryNoise,
    Pose,
    RobotLog,
    Truth,
)
from symboslam.engine.slam.planar import compose, wrap


@dataclass(frozen=True)
class World:
    """What is simulated; the defaults are the town of 1.35 km square.

    Attributes:
        robots: how many.
        poses: of each robot, one a second.
        step: metres between poses.
        side: of the square, metres.
        landmarks: how many, anywhere in the square.
        classes: how many kinds; the k-th is 1/k times as frequent as the first (Zipf).
        reach: of the sensor, metres; it sees the half circle ahead.
        sigma_range: metres.
        sigma_bearing: radians.
        way_noise: of the odometry's way, as a share.
        turn_noise: of the odometry's heading, radians a step.
        way_bias: share by which a robot's odometry is too long or too short all the time.
        turn_bias: radians by which each step turns to the same side.
        misclassified: share of sightings with another class.
        outliers: share of sightings with any range and bearing.
        meetings: whether robots see each other, as robots without a name.
        known_starts: how many robots know where they begin.
        named: whether every landmark bears a name that is read whenever it is seen.
        wander: a random walk, which may see nothing twice for kilometres, instead of driving from
            one random place to the next.
    """

    robots: int = 3
    poses: int = 1000
    step: float = 5.0
    side: float = 1350.0
    landmarks: int = 300
    classes: int = 56
    reach: float = 80.0
    sigma_range: float = 0.5
    sigma_bearing: float = float(np.radians(1.0))
    way_noise: float = 0.03
    turn_noise: float = float(np.radians(0.6))
    way_bias: float = 0.01
    turn_bias: float = float(np.radians(0.03))
    misclassified: float = 0.05
    outliers: float = 0.0
    meetings: bool = False
    known_starts: int = 3
    named: bool = False
    wander: bool = False


TURN = float(np.radians(20))
"""A robot turns at most so much a step."""

TOWN = World()
CONFUSED = World(misclassified=0.3)
FYSHWICK = World(side=6.7e6**0.5, landmarks=152, reach=150.0)
AIRPORT = World(side=27.9e6**0.5, landmarks=199, reach=150.0)


def simulate(world: World = TOWN, seed: int = 0) -> Mission:
    """A mission in a world; the same seed gives the same mission."""
    rng = np.random.default_rng(seed)
    xy = rng.uniform(0, world.side, (world.landmarks, 2))
    share = 1 / np.arange(1, world.classes + 1)
    feature = rng.choice(world.classes, world.landmarks, p=share / share.sum())
    names = np.array([f"L{n}" for n in range(world.landmarks)], object)
    walk = _wander if world.wander else _drive
    paths = [walk(world, rng) for _ in range(world.robots)]
    time = np.arange(world.poses, dtype=float)
    robots, identity = [], {}
    for n, path in enumerate(paths):
        others = [other for m, other in enumerate(paths) if m != n] if world.meetings else []
        called = [f"robot {m + 1}" for m in range(world.robots) if m != n]
        seen, what = _look(world, rng, path, xy, feature, names, others, called)
        name = f"robot {n + 1}"
        identity[name] = what
        start: Pose = (float(path[0, 0]), float(path[0, 1]), float(path[0, 2]))
        robots.append(
            RobotLog(
                name,
                Odometry(time, _odometry(world, rng, path), _noise(world)),
                seen,
                start if n < world.known_starts else None,
                (0.01, 0.01, 0.001),
            )
        )
    classes = tuple(f"class {n + 1}" for n in range(world.classes))
    return Mission(
        tuple(robots),
        classes,
        np.zeros(world.classes, bool),
        np.eye(world.classes),
        identity,
        Truth(
            {str(n): (float(x), float(y)) for n, (x, y) in zip(names, xy, strict=True)},
            {r.name: np.column_stack([time, p]) for r, p in zip(robots, paths, strict=True)},
            {str(n): classes[f] for n, f in zip(names, feature, strict=True)},
        ),
    )


def _noise(world: World) -> OdometryNoise:
    return OdometryNoise(
        along=float(np.hypot(world.way_noise, world.way_bias)),
        across=0.002,
        turn=0.0,
        drift=float(np.hypot(world.turn_noise, world.turn_bias)) / world.step,
        floor=(0.01, 0.01, 1e-4),
    )


def _drive(world: World, rng: np.random.Generator) -> Floats:
    """(n, 3) from one random place of the square to the next (random waypoint model)."""
    path = np.empty((world.poses, 3))
    path[0] = *rng.uniform(0.1, 0.9, 2) * world.side, rng.uniform(-np.pi, np.pi)
    goal = rng.uniform(0, world.side, 2)
    for n in range(1, world.poses):
        x, y, heading = compose(path[n - 1], (world.step, 0, 0))
        while np.hypot(*(goal - (x, y))) < 8 * world.step:
            goal = rng.uniform(0, world.side, 2)
        turn = wrap(np.arctan2(goal[1] - y, goal[0] - x) - heading)
        path[n] = x, y, wrap(heading + np.clip(turn, -TURN, TURN))
    return path


def _wander(world: World, rng: np.random.Generator) -> Floats:
    """(n, 3) correlated random walk that turns back from the walls."""
    path = np.empty((world.poses, 3))
    path[0] = *rng.uniform(0.1, 0.9, 2) * world.side, rng.uniform(-np.pi, np.pi)
    for n in range(1, world.poses):
        x, y, heading = compose(path[n - 1], (world.step, 0, 0))
        heading += rng.normal(0, np.radians(8))
        ahead = np.array([x, y]) + 6 * world.step * np.array([np.cos(heading), np.sin(heading)])
        if (ahead < 0).any() or (ahead > world.side).any():
            inward = np.arctan2(world.side / 2 - y, world.side / 2 - x)
            heading += np.clip(wrap(inward - heading), -TURN, TURN)
        path[n] = x, y, wrap(heading)
    return path


def _odometry(world: World, rng: np.random.Generator, path: Floats) -> Floats:
    """(n, 3) what the wheels say of a path, from (0, 0, 0)."""
    turn = wrap(np.diff(path[:, 2]))
    steps = len(turn)
    scale = 1 + world.way_bias * rng.choice([-1, 1])
    way = world.step * (scale + rng.normal(0, world.way_noise, steps))
    bias = world.turn_bias * rng.choice([-1, 1])
    turn = turn + bias + rng.normal(0, world.turn_noise, steps)
    pose = np.zeros((steps + 1, 3))
    for n in range(steps):
        pose[n + 1] = compose(pose[n], (way[n], 0, turn[n]))
    return pose


def _look(
    world: World,
    rng: np.random.Generator,
    path: Floats,
    xy: Floats,
    feature: Ints,
    names: NDArray[np.object_],
    others: list[Floats],
    called: list[str],
) -> tuple[Measurements, NDArray[np.object_]]:
    """What is seen along a path, and what it really is."""
    rows: list[tuple[float, float, float, int, str]] = []
    for n, pose in enumerate(path):
        points = np.vstack([xy, *[other[n, :2] for other in others]])
        delta = points - pose[:2]
        distance = np.hypot(*delta.T)
        bearing = wrap(np.arctan2(delta[:, 1], delta[:, 0]) - pose[2])
        for k in np.flatnonzero((distance < world.reach) & (abs(bearing) < np.pi / 2)).tolist():
            is_robot = k >= len(xy)
            what = ROBOT if is_robot else int(feature[k])
            if not is_robot and rng.random() < world.misclassified and world.classes > 1:
                what = (what + int(rng.integers(1, world.classes))) % world.classes
            reach, angle = distance[k], bearing[k]
            if rng.random() < world.outliers:
                reach, angle = rng.uniform(1, world.reach), rng.uniform(-np.pi / 2, np.pi / 2)
            rows.append(
                (
                    float(n),
                    max(reach + rng.normal(0, world.sigma_range), 0.01),
                    float(wrap(angle + rng.normal(0, world.sigma_bearing))),
                    what,
                    called[k - len(xy)] if is_robot else str(names[k]),
                )
            )
    key = np.full(len(rows), "", object)
    if world.named:
        key[:] = ["" if row[3] == ROBOT else row[4] for row in rows]
    sure = np.full(len(rows), 1 - max(world.misclassified, 0.01))
    seen = Measurements(
        np.array([row[0] for row in rows], float),
        np.array([row[1] for row in rows], float),
        np.array([row[2] for row in rows], float),
        np.array([row[3] for row in rows], np.int64),
        sure,
        key,
        world.sigma_range,
        world.sigma_bearing,
    )
    return seen, np.array([row[4] for row in rows], object)
