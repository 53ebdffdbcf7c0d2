"""The paper's own way to map: odometry, merging by radius and similarity, an oracle (design 7).

It is here to compare with. It closes no loops, so that a map is only as good as the odometry, and
as the oracle, which tells robots where they really are.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from symboslam.engine.slam.dead_reckoning import starts_of
from symboslam.engine.slam.landmark_error import SIMILAR
from symboslam.engine.slam.log import Floats, Ints, Mission, Pose, RobotLog
from symboslam.engine.slam.paper_edge import EdgeMap, edge_map_paper
from symboslam.engine.slam.paper_merge import PaperMerge
from symboslam.engine.slam.paper_oracle import path_with_oracle, true_path
from symboslam.engine.slam.paper_rules import Rules
from symboslam.engine.slam.planar import compose, place
from symboslam.engine.slam.slam_map import SlamMap, Trajectory
from symboslam.errors import InputError

ORACLE_EVERY = 60.0
"""Seconds between two resets of the poses to the truth."""


def paper_map(
    mission: Mission,
    radius: float | None = None,
    similarity: float = SIMILAR,
    *,
    oracle: bool = False,
    oracle_every: float = ORACLE_EVERY,
) -> SlamMap:
    """Map a mission as the paper does.

    Each agent maps by odometry from (0, 0) (``edge_map_paper``). Its map is shifted to where it
    began and merged into the collective map (``PaperMerge``), agent after agent in the order of
    ``mission.robots``. Keys of things, such as the text of signs, are not read: the paper has none.

    Args:
        mission: robots that do not know where they began are left out, with a note; if none does,
            the map is in the frame of the first.
        radius: the paper's a in metres; None for 0.15 of the sight, at most 12 m.
        similarity: least similarity of classes that are similar.
        oracle: reset poses to the truth, as the paper has to.
        oracle_every: seconds between two resets.

    Raises:
        InputError: the oracle lacks the true path of a robot; a radius, similarity or time that is
            no number above 0.
    """
    rules = Rules.of(mission, radius, similarity)
    if not 0 < oracle_every < np.inf:
        raise InputError(f"oracle_every is {oracle_every}; give seconds > 0")
    starts, left_out = starts_of(mission)
    notes = [] if oracle else left_out
    merge = PaperMerge(rules)
    edges: dict[str, tuple[EdgeMap, int]] = {}
    for log in mission.robots:
        if oracle:
            path = path_with_oracle(log, true_path(mission, log.name), oracle_every)
            edge = edge_map_paper(log, rules, path)
        elif log.name in starts:
            edge = shifted(edge_map_paper(log, rules), starts[log.name])
        else:
            continue
        first = merge.add(edge.landmarks)
        edges[log.name] = edge, int(first[0]) if len(first) else 0
        notes += _unplaced(log, edge.of)
    of = merge.landmark_of()
    landmark_of = {log.name: np.full(len(log.seen), -1, np.int64) for log in mission.robots}
    for name, (edge, first_entry) in edges.items():
        placed = edge.of >= 0
        landmark_of[name][placed] = of[first_entry + edge.of[placed]]
    if aside := len(merge.aside()):
        notes.append(f"{aside} landmarks were put aside, as others of another class are there")
    return SlamMap(
        trajectories={name: edge.path for name, (edge, _) in edges.items()},
        landmarks=merge.landmarks(),
        landmark_of=landmark_of,
        notes=tuple(notes),
    )


def shifted(edge: EdgeMap, start: Pose) -> EdgeMap:
    """An agent's map in the collective frame, in which the agent began at ``start``."""
    path, marks = edge.path, edge.landmarks
    return EdgeMap(
        Trajectory(path.time, compose(start, path.pose)),
        replace(marks, xy=place(start, marks.xy), covariance=_turned(marks.covariance, start[2])),
        edge.of,
    )


def _turned(covariance: Floats, angle: float) -> Floats:
    """(n, 2, 2) covariances after a rotation."""
    cos, sin = np.cos(angle), np.sin(angle)
    turn = np.array([[cos, -sin], [sin, cos]])
    return np.asarray(turn @ covariance @ turn.T)


def _unplaced(log: RobotLog, of: Ints) -> list[str]:
    count = int(((of < 0) & (log.seen.feature >= 0)).sum())
    if not count:
        return []
    return [f"robot {log.name}: {count} sightings without a range or a bearing were left out"]
