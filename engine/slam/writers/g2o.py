"""Maps as g2o: VERTEX_SE2, VERTEX_XY, and what was measured between them as edges."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from symboslam.engine.slam.log import Floats
from symboslam.engine.slam.readers.information import covariance_of
from symboslam.engine.slam.writers.output import Output, Written, write_files
from symboslam.engine.slam.writers.robot_graph import SMALLEST, RobotGraph, graphs_of


def write(output: Output) -> Written:
    """Write the graph: poses numbered robot after robot, then landmarks.

    Vertices are the poses of the trajectories and wherever something was measured. Odometry,
    closures and fixes are edges, and each sighting that the map says is of a landmark.

    Raises:
        OutputError: the file cannot be written.
    """
    graphs = graphs_of(output.slam_map, output.mission)
    blind = sum(
        int(np.isnan(graph.log.seen.bearing[graph.seen]).sum()) for graph in graphs
    )  # fmt: skip
    write_files([(output.path, _lines(output, graphs))])
    notes = ["g2o has no times, classes or confidences; what is what is in its comments"]
    lost = sum(_unusable(graph) for graph in graphs)
    if lost:
        notes.append(f"closures of no way, or without a usable covariance, left out: {lost}")
    if blind:
        notes.append(f"g2o has no edge for a range alone: {blind} sightings are not in the file")
    return Written((output.path,), tuple(notes))


def _unusable(graph: RobotGraph) -> int:
    """How many closures lead nowhere or have a covariance without an inverse."""
    if graph.log.closures is None:
        return 0
    still = graph.closed[:, 0] == graph.closed[:, 1]
    matrices = [covariance_of(matrix) for matrix in graph.log.closures.covariance]
    bad = np.array([not np.isfinite(matrix).all() for matrix in matrices])
    return int((still | bad).sum())


def _lines(output: Output, graphs: list[RobotGraph]) -> Iterator[str]:
    """Vertices, edges between poses, all other edges, FIX, comments.

    In this order because GTSAM's reader takes no edge behind a line that it does not know.
    """
    marks, classes = output.slam_map.landmarks, output.mission.classes
    first = np.cumsum([0, *map(len, graphs)]).tolist()
    landmarks = first.pop()
    for graph, number in zip(graphs, first, strict=True):
        for i, (x, y, heading) in enumerate(graph.pose.tolist(), number):
            yield f"VERTEX_SE2 {i} {x!r} {y!r} {heading!r}\n"
    for i, (x, y) in enumerate(marks.xy.tolist(), landmarks):
        yield f"VERTEX_XY {i} {x!r} {y!r}\n"
    for graph, number in zip(graphs, first, strict=True):
        yield from _between_poses(graph, number)
    for graph, number in zip(graphs, first, strict=True):
        yield from _to_landmarks(graph, number, landmarks)
    for graph, number in zip(graphs, first, strict=True):
        yield from _priors(graph, number)
        if number == 0 or graph.log.start is not None:
            yield f"FIX {number}\n"
    for graph, number in zip(graphs, first, strict=True):
        yield f"# {_clean(graph.log.name)}: vertices {number} to {number + len(graph) - 1}\n"
    for i, (name, kind) in enumerate(zip(marks.id, marks.feature, strict=True), landmarks):
        yield f"# vertex {i}: landmark {_clean(str(name))}, {_clean(classes[kind])}\n"


def _between_poses(graph: RobotGraph, first: int) -> Iterator[str]:
    """Odometry and closures."""
    for i, (step, sigma) in enumerate(zip(graph.step, graph.sigma, strict=True), first):
        yield _edge_se2(i, i + 1, step, np.diag(sigma**-2.0))
    closures = graph.log.closures
    if closures is None:
        return
    pairs = (graph.closed + first).tolist()
    matrices = map(covariance_of, closures.covariance)
    for (start, end), step, matrix in zip(pairs, closures.step, matrices, strict=True):
        if start != end and np.isfinite(matrix).all():
            yield _edge_se2(start, end, step, matrix)


def _priors(graph: RobotGraph, first: int) -> Iterator[str]:
    """Positions from outside."""
    fixes = graph.log.fixes
    if fixes is None:
        return
    rows = zip((graph.fixed + first).tolist(), fixes.xy, fixes.sigma, strict=True)
    for i, xy, sigma in rows:
        yield f"EDGE_PRIOR_SE2_XY {i} {_row([*xy, sigma**-2.0, 0.0, sigma**-2.0])}\n"


def _to_landmarks(graph: RobotGraph, first: int, landmarks: int) -> Iterator[str]:
    """Sightings with a range and a bearing, or a bearing alone."""
    seen = graph.log.seen.take(graph.seen)
    ends = zip(
        (graph.seen_from + first).tolist(),
        (graph.landmark + landmarks).tolist(),
        seen.range.tolist(),
        seen.bearing.tolist(),
        *seen.sigmas.T.tolist(),
        strict=True,
    )
    for pose, landmark, reach, bearing, sigma_range, sigma_bearing in ends:
        if np.isnan(bearing):
            continue
        if np.isnan(reach):
            information = max(sigma_bearing, SMALLEST) ** -2.0
            yield f"EDGE_BEARING_SE2_XY {pose} {landmark} {bearing!r} {information!r}\n"
            continue
        ahead = np.array([np.cos(bearing), np.sin(bearing)])
        matrix = _information(ahead, reach, sigma_range, sigma_bearing)
        values = _row([*(ahead * reach), matrix[0, 0], matrix[0, 1], matrix[1, 1]])
        yield f"EDGE_SE2_XY {pose} {landmark} {values}\n"


def _information(ahead: Floats, reach: float, sigma_range: float, sigma_bearing: float) -> Floats:
    """(2, 2) of a point seen in a direction, from the uncertainties of range and bearing."""
    aside = np.array([-ahead[1], ahead[0]])
    along = max(sigma_range, SMALLEST)
    across = max(sigma_bearing * reach, SMALLEST)
    if reach == 0:
        across = along
    return np.asarray(np.outer(ahead, ahead) / along**2 + np.outer(aside, aside) / across**2)


def _edge_se2(start: int, end: int, step: Floats, matrix: Floats) -> str:
    return f"EDGE_SE2 {start} {end} {_row([*step, *matrix[np.triu_indices(3)]])}\n"


def _row(values: list[float]) -> str:
    return " ".join(repr(float(value)) for value in values)


def _clean(text: str) -> str:
    """A text on one line."""
    return " ".join("".join(c if c.isprintable() else " " for c in text).split())
