"""PoseGraph: what files of pose graphs state, cut into the odometry of robots.

Poses that follow each other by number and have an edge between them are one robot's odometry; a
number without such an edge to the next begins another robot. All other edges are closures.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import numpy as np

from symboslam.engine.slam.log import Floats, Pose
from symboslam.engine.slam.planar import between
from symboslam.errors import InputError

_SYMBOL = 56
"""GTSAM's keys hold a letter above this bit."""


@dataclass(frozen=True)
class Edge:
    """How a pose lies as seen from another.

    Attributes:
        start: number of the first pose.
        end: number of the second.
        step: (3,) of the second in the frame of the first.
        covariance: (3, 3) in the frame of the second, as g2o has it; NaN where not known.
    """

    start: int
    end: int
    step: Floats
    covariance: Floats


@dataclass(frozen=True)
class Sighting:
    """A landmark as seen from a pose; NaN for what was not measured."""

    pose: int
    landmark: int
    range: float
    bearing: float
    sigma_range: float
    sigma_bearing: float


@dataclass
class PoseGraph:
    """What a file states.

    Attributes:
        path: the file.
        poses: number -> estimate.
        points: number of a landmark -> estimate.
        edges: between poses, in the file's order.
        sightings: of landmarks, in the file's order.
        priors: (number of a pose, x, y, standard deviation) of positions from outside.
        fixed: numbers of the poses that are held.
        ignored: tags that were not understood, with their counts.
        notes: what was mended.
    """

    path: Path
    poses: dict[int, Pose] = field(default_factory=dict)
    points: dict[int, tuple[float, float]] = field(default_factory=dict)
    edges: list[Edge] = field(default_factory=list)
    sightings: list[Sighting] = field(default_factory=list)
    priors: list[tuple[int, float, float, float]] = field(default_factory=list)
    fixed: set[int] = field(default_factory=set)
    ignored: Counter[str] = field(default_factory=Counter)
    notes: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Chain:
    """One robot's odometry.

    Attributes:
        name: of the robot.
        ids: (n,) numbers of the poses.
        edges: (n - 1) from each pose to the next.
    """

    name: str
    ids: list[int]
    edges: list[Edge]


def name_of(number: int) -> str:
    """What a number is called: GTSAM's keys are a letter and a number.

    >>> name_of(7), name_of((ord("l") << 56) + 7)
    ('7', 'l7')
    """
    letter, index = divmod(number, 1 << _SYMBOL)
    known = letter < 128 and chr(letter).isalpha()
    return f"{chr(letter)}{index}" if known else str(number)


def chains_of(graph: PoseGraph) -> tuple[list[Chain], list[Edge]]:
    """The robots' odometry, and all other edges.

    Raises:
        InputError: no edge is odometry.
    """
    used = {i for edge in graph.edges for i in (edge.start, edge.end)}
    ids = sorted(used | set(graph.poses) | {seen.pose for seen in graph.sightings})
    after = dict(pairwise(ids))
    steps: dict[int, Edge] = {}
    others = []
    for edge in graph.edges:
        if after.get(edge.end) == edge.start:
            edge_on = _reversed(edge)
        else:
            edge_on = edge
        if after.get(edge_on.start) == edge_on.end and edge_on.start not in steps:
            steps[edge_on.start] = edge_on
        else:
            others.append(edge)
    if not steps:
        raise InputError(f"{graph.path}: no edge leads from a pose to the next: no odometry")
    runs: list[list[int]] = [[]]
    for i in ids:
        runs[-1].append(i)
        if i not in steps:
            runs.append([])
    chains = [
        Chain(f"Robot {n}", run, [steps[i] for i in run[:-1]])
        for n, run in enumerate(filter(None, runs), 1)
    ]
    return chains, others


def _reversed(edge: Edge) -> Edge:
    """The same the other way round; its covariance moves with the adjoint."""
    x, y, turn = edge.step.tolist()
    cos, sin = np.cos(turn), np.sin(turn)
    adjoint = np.array([[cos, -sin, y], [sin, cos, -x], [0, 0, 1]])
    back = between(edge.step, (0, 0, 0))
    return Edge(edge.end, edge.start, back, adjoint @ edge.covariance @ adjoint.T)
