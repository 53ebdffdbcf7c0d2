"""Maps as Turtle: landmarks, poses, tracks and pose graphs in the terms of OntoSLAM and ours.

``ontology/map.ttl`` tells the model. Of a trajectory the keyframes are written: the first and last
pose, and those from which something was measured.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterator

import numpy as np

from symboslam.engine.slam.writers.output import Output, Written, write_files
from symboslam.engine.slam.writers.robot_graph import graphs_of
from symboslam.engine.slam.writers.turtle_landmarks import LandmarkRecords
from symboslam.engine.slam.writers.turtle_poses import pose_records
from symboslam.engine.slam.writers.vocabulary import FR, OS
from symboslam.engine.writers.rdf_records import Record
from symboslam.engine.writers.rdf_syntax import ABSOLUTE_IRI, Turtle
from symboslam.engine.writers.vocabulary import MAPS, NAMESPACES
from symboslam.errors import InputError

_KINDS = ("landmark", "position", "observation", "pose", "agent", "track", "graph", "edge")


def write(output: Output) -> Written:
    """Write a map as Turtle that is valid against ``ontology/shapes``.

    Raises:
        InputError: ``base`` is no absolute IRI.
        OutputError: the file cannot be written.
    """
    base = _base(output)
    kinds = {kind: f"{base}{kind}/" for kind in _KINDS}
    syntax = Turtle(base, {**NAMESPACES, "os": OS, "fr": FR, "map": base, **kinds})
    write_files([(output.path, _texts(output, syntax))])
    return Written((output.path,))


def _texts(output: Output, syntax: Turtle) -> Iterator[str]:
    yield syntax.head()
    graph = syntax.own("graph")
    for subject, properties in _records(output, syntax):
        yield syntax.statements(graph, subject, properties)


def _records(output: Output, syntax: Turtle) -> Iterator[Record]:
    graphs = graphs_of(output.slam_map, output.mission, keyframes=True)
    landmarks = LandmarkRecords(output, syntax, graphs)
    yield from landmarks.maps()
    yield from landmarks.classes()
    yield from landmarks.landmarks()
    for graph in graphs:
        yield from pose_records(graph, syntax)
        yield from landmarks.seen_by(graph)


def _base(output: Output) -> str:
    """The IRI below which the map's own lie; equal maps get equal ones."""
    base = output.base
    if base is not None:
        if not ABSOLUTE_IRI.fullmatch(base):
            raise InputError(f"{base!r} is no absolute IRI, such as https://example.org/maps/1/")
        return base if base[-1] in "/#:" else base + "/"
    marks = output.slam_map.landmarks
    found = hashlib.sha256(repr((marks.id.tolist(), output.mission.classes)).encode())
    found.update(np.ascontiguousarray(marks.xy).tobytes())
    for name, path in output.slam_map.trajectories.items():
        found.update(name.encode("utf-8", "replace"))
        found.update(np.ascontiguousarray(path.time).tobytes())
        found.update(np.ascontiguousarray(path.pose).tobytes())
    return f"{MAPS}{found.hexdigest()[:16]}/"
