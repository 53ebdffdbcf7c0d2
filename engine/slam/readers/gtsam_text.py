"""GTSAM's text graphs: VERTEX2, EDGE2, ODOMETRY, LANDMARK and BR (``gtsam/slam/dataset.cpp``).

Six numbers behind an edge are a covariance row by row, as in GTSAM's own data sets, or an
information matrix in TORO's order; zeros off the diagonal tell which.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from symboslam.engine.slam.log import Floats, Mission
from symboslam.engine.slam.readers import g2o
from symboslam.engine.slam.readers.information import (
    covariance_of,
    polar,
    positive,
    symmetric,
    toro,
)
from symboslam.engine.slam.readers.pose_graph import Edge, PoseGraph, Sighting
from symboslam.engine.slam.readers.pose_graph_log import estimate_of, mission_of
from symboslam.engine.slam.readers.tagged import Fields, parse
from symboslam.engine.slam.slam_map import SlamMap
from symboslam.errors import InputError


def read(path: Path, identities: str = "shown") -> tuple[Mission, list[str]]:
    """Read the logs behind a graph; see `pose_graph_log.mission_of`.

    Raises:
        InputError: a line is wrong, or there is no odometry.
    """
    return mission_of(parse(path, TAGS), identities)


def read_estimate(path: Path, mission: Mission) -> SlamMap | None:
    """The poses that the file holds (``VERTEX2``), or None where it has none."""
    return estimate_of(parse(path, TAGS), mission)


def covariance_by_layout(numbers: Sequence[float], where: str) -> Floats:
    """(3, 3) covariance of the six numbers behind an edge.

    As GTSAM guesses: the places of the zeros tell the order. With TORO's order goes information.

    Raises:
        InputError: they are in neither order.
    """
    a, b, c, d, e, f = numbers
    if a and d and f and b == c == e == 0:
        return positive(symmetric(numbers, 3))
    if a and c and d and b == e == f == 0:
        return covariance_of(toro(numbers))
    if np.isfinite(positive(symmetric(numbers, 3))).all():
        return symmetric(numbers, 3)
    raise InputError(
        f"{where}: the six numbers of the uncertainty are neither a covariance row by row nor "
        "TORO's information matrix"
    )


def _edge(graph: PoseGraph, f: Fields) -> None:
    start, end, *values = f.ids(2, 9)
    covariance = covariance_by_layout(values[3:], f.where)
    graph.edges.append(Edge(*f.apart(start, end), np.array(values[:3]), covariance))


def _landmark(graph: PoseGraph, f: Fields) -> None:
    pose, landmark, x, y, *triangle = f.ids(2, 5)
    found = polar(x, y, positive(symmetric(triangle, 2)))
    graph.sightings.append(Sighting(pose, landmark, *found))


def _bearing_range(graph: PoseGraph, f: Fields) -> None:
    pose, landmark, bearing, reach, sigma_bearing, sigma_range = f.ids(2, 4)
    if reach < 0:
        raise InputError(f"{f.where}: the range is {reach:g}, below 0")
    sigmas = (s if s > 0 else float("nan") for s in (sigma_range, sigma_bearing))
    graph.sightings.append(Sighting(pose, landmark, reach, bearing, *sigmas))


_vertex = g2o.TAGS["VERTEX_SE2"]
TAGS: dict[str, Callable[[PoseGraph, Fields], None]] = {
    "VERTEX2": _vertex,
    "VERTEX": _vertex,
    "VERTEX_SE2": _vertex,
    "EDGE2": _edge,
    "EDGE": _edge,
    "ODOMETRY": _edge,
    "EDGE_SE2": g2o.TAGS["EDGE_SE2"],
    "LANDMARK": _landmark,
    "BR": _bearing_range,
}
