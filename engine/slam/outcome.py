"""Outcome: a solved joint graph as a SlamMap."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.beliefs import ClassBeliefs
from symboslam.engine.slam.joining import Joining
from symboslam.engine.slam.joint import JointGraph, Piece
from symboslam.engine.slam.log import Floats
from symboslam.engine.slam.slam_map import MappedLandmarks, SlamMap, Trajectory
from symboslam.engine.slam.still import put_together
from symboslam.engine.slam.tracks import OFTEN

MANY = 100
"""So many sightings tell whether things are seen often."""


def outcome(
    joined: Joining,
    dynamic: NDArray[np.bool_],
    similarity: Floats,
    doubts: list[str],
    notes: list[str],
) -> SlamMap:
    """What was mapped.

    Args:
        joined: all robots.
        dynamic: (C,) which classes move.
        similarity: (C, C) how alike classes are.
        doubts: why the map should not be trusted.
        notes: what was left out.
    """
    graph, runs, edges, placed = joined.graph, joined.runs, joined.edges, joined.placed
    groups: dict[int, list[Piece]] = {}
    for piece in graph.pieces:
        groups.setdefault(piece.label, []).append(piece)
    moving = [
        Piece(number, track, -1)
        for number, run in enumerate(placed)
        for track in edges[run].moving.tracks
    ]
    sigma = graph.settings.floor * joined.scale.sigma
    put_together(graph, moving, max(groups, default=-1) + 1, sigma)
    for piece in moving:
        groups.setdefault(piece.label, []).append(piece)
    seldom = _seldom(groups, graph.settings.confirm)
    for label in seldom:
        del groups[label]
    if seldom:
        notes = [
            *notes,
            f"things seen fewer than {graph.settings.confirm} times, where others are seen often, "
            f"left out: {len(seldom)}",
        ]
    labels = sorted(groups)
    landmarks = _landmarks(graph, groups, labels, dynamic, similarity)
    row = {label: n for n, label in enumerate(labels)}
    of = {run.name: np.full(run.rows, -1, np.int64) for run in runs}
    for label, pieces in groups.items():
        for piece in pieces:
            rows = [seen.row for seen in piece.track.sightings]
            of[graph.members[piece.member].name][rows] = row[label]
    for number, seen, label in graph.parts:
        of[graph.members[number].name][seen.row] = row.get(label, -1)
    return SlamMap(
        {member.name: Trajectory(member.time, member.poses) for member in graph.members},
        landmarks,
        of,
        tuple(doubts),
        tuple(notes),
    )


def _seldom(groups: dict[int, list[Piece]], confirm: int) -> list[int]:
    """Labels of what was seen too seldom to be there, where most things are seen often."""
    times = {n: sum(len(p.track.sightings) for p in pieces) for n, pieces in groups.items()}
    total = sum(times.values())
    if total <= MANY or 2 * sum(n for n in times.values() if n >= OFTEN) <= total:
        return []
    named = {n for n, pieces in groups.items() if any(p.track.key for p in pieces)}
    return [n for n, seen in times.items() if seen < confirm and n not in named]


def _landmarks(
    graph: JointGraph,
    groups: dict[int, list[Piece]],
    labels: list[int],
    dynamic: NDArray[np.bool_],
    similarity: Floats,
) -> MappedLandmarks:
    beliefs = ClassBeliefs(similarity)
    told = np.array([sum(p.track.evidence for p in groups[label]) for label in labels])
    told = told.reshape(len(labels), beliefs.size)
    shares = beliefs.posterior(told) if len(labels) else told
    feature = shares.argmax(1) if len(labels) else np.zeros(0, np.int64)
    missing = np.full((2, 2), np.nan)
    keys = [next((p.track.key for p in groups[n] if p.track.key), "") for n in labels]
    return MappedLandmarks(
        np.array([f"L{n + 1}" for n in range(len(labels))], object),
        np.array([graph.xy[n] for n in labels]).reshape(-1, 2),
        np.array([graph.covariance.get(n, missing) for n in labels]).reshape(-1, 2, 2),
        feature.astype(np.int64),
        shares.max(1) if len(labels) else np.zeros(0),
        np.array([sum(len(p.track.sightings) for p in groups[n]) for n in labels], np.int64),
        dynamic[feature],
        np.array(keys, object),
    )
