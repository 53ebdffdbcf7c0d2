"""g2o: graphs of poses and landmarks (github.com/RainerKuemmerle/g2o, "File format").

VERTEX_SE2, VERTEX_XY, EDGE_SE2, EDGE_SE2_XY, EDGE_BEARING_SE2_XY, EDGE_PRIOR_SE2_XY, FIX; also
VERTEX_SE3:QUAT and EDGE_SE3:QUAT where they are near the plane. Other tags are counted.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from symboslam.engine.slam.log import Floats, Mission
from symboslam.engine.slam.readers.information import covariance_of, polar, symmetric
from symboslam.engine.slam.readers.pose_graph import Edge, PoseGraph, Sighting
from symboslam.engine.slam.readers.pose_graph_log import estimate_of, mission_of
from symboslam.engine.slam.readers.spatial import planar_step
from symboslam.engine.slam.readers.tagged import Fields, parse
from symboslam.engine.slam.slam_map import SlamMap
from symboslam.errors import InputError

_PLANE = [0, 1, 5]
"""x, y and the turn about the vertical among the six numbers of EDGE_SE3:QUAT."""


def read(path: Path, identities: str = "shown") -> tuple[Mission, list[str]]:
    """Read the logs behind a graph; see `pose_graph_log.mission_of`.

    Raises:
        InputError: a line is wrong, there is no odometry, or the graph is not in a plane.
    """
    return mission_of(graph_of(path), identities)


def read_estimate(path: Path, mission: Mission) -> SlamMap | None:
    """The poses and landmarks that the file holds, or None where it has no vertices."""
    return estimate_of(graph_of(path), mission)


def graph_of(path: Path) -> PoseGraph:
    """What the file states."""
    return parse(path, TAGS)


def _vertex_se2(graph: PoseGraph, f: Fields) -> None:
    number, x, y, heading = f.ids(1, 3)
    graph.poses[f.new(number, graph.poses)] = (x, y, heading)


def _vertex_xy(graph: PoseGraph, f: Fields) -> None:
    number, x, y = f.ids(1, 2)
    graph.points[f.new(number, graph.points)] = (x, y)


def _vertex_se3(graph: PoseGraph, f: Fields) -> None:
    number, x, y, _, *quaternion = f.ids(1, 7)
    _, _, heading = planar_step((0, 0, 0, *quaternion), f.where)
    graph.poses[f.new(number, graph.poses)] = (x, y, heading)


def _edge_se2(graph: PoseGraph, f: Fields) -> None:
    start, end, *values = f.ids(2, 9)
    covariance = covariance_of(symmetric(values[3:], 3))
    graph.edges.append(Edge(*f.apart(start, end), np.array(values[:3]), covariance))


def _edge_se3(graph: PoseGraph, f: Fields) -> None:
    start, end, *values = f.ids(2, 28)
    step = planar_step(values[:7], f.where)
    whole = covariance_of(symmetric(values[7:], 6))
    covariance: Floats = whole[np.ix_(_PLANE, _PLANE)]
    covariance = covariance * np.outer((1, 1, 2), (1, 1, 2))  # qz is half a turn
    graph.edges.append(Edge(*f.apart(start, end), np.array(step), covariance))


def _edge_se2_xy(graph: PoseGraph, f: Fields) -> None:
    pose, landmark, x, y, *triangle = f.ids(2, 5)
    found = polar(x, y, covariance_of(symmetric(triangle, 2)))
    graph.sightings.append(Sighting(int(pose), int(landmark), *found))


def _edge_bearing(graph: PoseGraph, f: Fields) -> None:
    pose, landmark, bearing, information = f.ids(2, 2)
    sigma = float(information**-0.5) if information > 0 else float("nan")
    nan = float("nan")
    graph.sightings.append(Sighting(int(pose), int(landmark), nan, bearing, nan, sigma))


def _prior_xy(graph: PoseGraph, f: Fields) -> None:
    number, x, y, *triangle = f.ids(1, 5)
    covariance = covariance_of(symmetric(triangle, 2))
    sigma = float(np.sqrt(np.trace(covariance) / 2))
    if not np.isfinite(sigma):
        raise InputError(f"{f.where}: the information matrix has no inverse")
    graph.priors.append((int(number), x, y, sigma))


def _fix(graph: PoseGraph, f: Fields) -> None:
    graph.fixed.update(int(number) for number in f.ids(len(f.words), 0))


TAGS: dict[str, Callable[[PoseGraph, Fields], None]] = {
    "VERTEX_SE2": _vertex_se2,
    "VERTEX_XY": _vertex_xy,
    "VERTEX_SE3:QUAT": _vertex_se3,
    "EDGE_SE2": _edge_se2,
    "EDGE_SE3:QUAT": _edge_se3,
    "EDGE_SE2_XY": _edge_se2_xy,
    "EDGE_BEARING_SE2_XY": _edge_bearing,
    "EDGE_PRIOR_SE2_XY": _prior_xy,
    "FIX": _fix,
}
