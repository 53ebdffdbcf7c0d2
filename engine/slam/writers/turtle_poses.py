"""A robot's poses, track and pose graph as RDF records."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from symboslam.engine.slam.log import Floats
from symboslam.engine.slam.planar import wrap
from symboslam.engine.slam.writers.robot_graph import RobotGraph
from symboslam.engine.slam.writers.vocabulary import FR, OS
from symboslam.engine.writers.rdf_records import Property, Record, digits
from symboslam.engine.writers.rdf_syntax import Properties, Syntax
from symboslam.engine.writers.vocabulary import DCTERMS, RDF
from symboslam.reasoning.vocabulary import SL


def a(syntax: Syntax, *classes: str) -> Property:
    """rdf:type."""
    return syntax.iri(RDF + "type"), [syntax.iri(c) for c in classes]


def translation(syntax: Syntax, x: float, y: float) -> Property:
    """os:hasTranslation, in metres."""
    point: Properties = [
        a(syntax, OS + "TranslationMeasure"),
        (syntax.iri(FR + "cartesianX"), [syntax.decimal(digits(x))]),
        (syntax.iri(FR + "cartesianY"), [syntax.decimal(digits(y))]),
    ]
    return syntax.iri(OS + "hasTranslation"), [point]


def covariance_matrix(syntax: Syntax, name: str, matrix: Floats) -> tuple[Property, list[Record]]:
    """sl:hasCovariance, and the elements of the matrix, which point to it."""
    own = syntax.own("covariance", name)
    elements: list[Record] = [(own, [a(syntax, OS + "CovarianceMatrix")])]
    for row, col in zip(*np.triu_indices(len(matrix)), strict=True):
        elements.append(
            (
                syntax.own("element", f"{name}-{row}-{col}"),
                [
                    a(syntax, OS + "MatrixElement"),
                    (syntax.iri(OS + "belongs_to"), [own]),
                    (syntax.iri(OS + "componentRow"), [syntax.integer(int(row))]),
                    (syntax.iri(OS + "componentCol"), [syntax.integer(int(col))]),
                    (
                        syntax.iri(OS + "componentValue"),
                        [syntax.decimal(digits(float(matrix[row, col])))],
                    ),
                ],
            )
        )
    return (syntax.iri(SL + "hasCovariance"), [own]), elements


def pose_name(graph: RobotGraph, vertex: int) -> str:
    """What a pose is called below the map's base."""
    return f"{graph.log.name}-{vertex}"


def pose_records(graph: RobotGraph, s: Syntax) -> Iterator[Record]:
    """The track, its poses, the pose graph, and odometry and closures as its edges."""
    name = graph.log.name
    vertices = [s.own("pose", pose_name(graph, i)) for i in range(len(graph))]
    edges = [s.own("edge", f"{name}-odometry-{i}") for i in range(len(graph) - 1)]
    apart = np.flatnonzero(graph.closed[:, 0] != graph.closed[:, 1]).tolist()
    edges += [s.own("edge", f"{name}-closure-{i}") for i in apart]
    edges += [s.own("edge", f"{name}-seen-{row}") for row in graph.seen.tolist()]
    yield (
        s.own("track", name),
        [
            a(s, SL + "AgentTrack"),
            (s.iri(SL + "trackOf"), [s.own("agent", name)]),
            (s.iri(SL + "builtFrom"), [s.own("graph", name)]),
            (s.iri(SL + "hasTrackPose"), [*vertices]),
        ],
    )
    content: Properties = [
        a(s, SL + "PoseGraph"),
        (s.iri(SL + "hasVertex"), [*vertices]),
    ]
    if edges:
        content.append((s.iri(SL + "hasEdge"), [*edges]))
    yield s.own("graph", name), content
    yield from _poses(graph, s, vertices)
    for i, step in enumerate(graph.step):
        ends = vertices[i], vertices[i + 1]
        yield (
            s.own("edge", f"{name}-odometry-{i}"),
            _between(s, SL + "OdometryConstraint", *ends, step),
        )
    closures = graph.log.closures
    if closures is None:
        return
    for i in apart:
        start, end = graph.closed[i].tolist()
        whose = f"{name}-closure-{i}"
        link, elements = covariance_matrix(s, whose, closures.covariance[i])
        step = closures.step[i]
        found = _between(s, SL + "LoopClosure", vertices[start], vertices[end], step)
        yield s.own("edge", whose), [*found, link]
        yield from elements


def _poses(graph: RobotGraph, s: Syntax, vertices: list[str]) -> Iterator[Record]:
    busy = {*graph.seen_from.tolist(), *graph.closed.ravel().tolist(), *graph.fixed.tolist()}
    for i, vertex in enumerate(vertices):
        x, y, heading = graph.pose[i].tolist()
        moment: Properties = [(s.iri(OS + "hasStamp"), [s.decimal(digits(float(graph.time[i])))])]
        yield (
            vertex,
            [
                a(s, SL + ("Keyframe" if i in busy else "Pose")),
                (s.iri(DCTERMS + "identifier"), [s.text(pose_name(graph, i))]),
                (s.iri(SL + "poseOf"), [s.own("agent", graph.log.name)]),
                (s.iri(FR + "posAtTime"), [moment]),
                translation(s, x, y),
                (s.iri(SL + "heading"), [s.decimal(digits(heading))]),
            ],
        )


def _between(s: Syntax, kind: str, start: str, end: str, step: Floats) -> Properties:
    x, y, turn = step.tolist()
    transform: Properties = [
        a(s, OS + "Position"),
        translation(s, x, y),
        (s.iri(SL + "heading"), [s.decimal(digits(float(wrap(turn))))]),
    ]
    return [
        a(s, kind),
        (s.iri(SL + "constraintFrom"), [start]),
        (s.iri(SL + "constraintTo"), [end]),
        (s.iri(SL + "hasTransform"), [transform]),
    ]
