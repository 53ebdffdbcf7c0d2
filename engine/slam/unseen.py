"""Unseen: landmarks that a robot had in view again and again, and never saw.

A robot that is wrong merges nothing, and what is not merged fits itself. But then the landmarks of
others lie in its view all the time without being seen, and its own in theirs. What something nearer
hides, such as a building, is not in view.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.joint import JointGraph, Member
from symboslam.engine.slam.log import Floats
from symboslam.engine.slam.planar import wrap

NEAR = 0.7
"""What lies within this share of a robot's usual range is in view, not at the rim."""
USUAL = (5.0, 95.0)
"""Percentiles of the bearings and ranges of what a robot saw, between which its view lies."""
AGAIN = 5
"""A landmark is expected to be seen if it is in view from so many key poses."""
WELL = 3
"""Landmarks with fewer sightings are expected of nobody."""


BESIDE = float(np.radians(10.0))
"""What is seen nearer by in about the same direction, by so many radians, may hide what lies
behind; a house of 10 m does at 30 m."""
BEFORE = 0.8
"""Nearer by is what lies within this share of the distance."""


def unseen(graph: JointGraph) -> list[tuple[int, int]]:
    """For each robot how many landmarks were not seen that should have been, and of how many.

    A landmark that a robot should have seen counts for that robot and for those that did see it:
    either may be in the wrong place.

    Args:
        graph: solved.
    """
    sightings: dict[int, int] = {}
    seers: dict[int, set[int]] = {}
    for piece in graph.pieces:
        sightings[piece.label] = sightings.get(piece.label, 0) + len(piece.track.sightings)
        seers.setdefault(piece.label, set()).add(piece.member)
    labels = [label for label, times in sightings.items() if times >= WELL]
    xy = np.array([graph.xy[label] for label in labels]).reshape(-1, 2)
    counts = np.zeros((len(graph.members), 2), int)
    for number, member in enumerate(graph.members):
        for at in np.flatnonzero(_in_view(member, xy) >= AGAIN).tolist():
            of = seers[labels[at]]
            counts[sorted(of | {number})] += (number not in of, 1)
    return [(missed, expected) for missed, expected in counts.tolist()]


def _in_view(member: Member, xy: Floats) -> Floats:
    """(n,) from how many key poses, at which it saw something, places lie in a robot's view."""
    seen = [s for piece in member.pieces for s in piece.track.sightings]
    if not seen or not len(xy):
        return np.zeros(len(xy))
    low, high = np.percentile([wrap(s.bearing) for s in seen], USUAL)
    reach = NEAR * float(np.percentile([s.range for s in seen], USUAL[1]))
    times = np.zeros(len(xy))
    there: dict[int, list[tuple[float, float]]] = {}
    for s in seen:
        there.setdefault(s.pose, []).append((s.range, s.bearing))
    for number, those in there.items():
        x, y, heading = member.poses[number].tolist()
        away = xy - (x, y)
        far, turn = np.hypot(*away.T), wrap(np.arctan2(away[:, 1], away[:, 0]) - heading)
        times += (far < reach) & (low < turn) & (turn < high) & ~_hidden(far, turn, those)
    return times


def _hidden(far: Floats, turn: Floats, seen: list[tuple[float, float]]) -> NDArray[np.bool_]:
    """(n,) whether something that was seen stands before places.

    Args:
        far: (n,) metres to the places.
        turn: (n,) radians, their bearings.
        seen: ranges and bearings of what was seen.
    """
    ranges, bearings = np.array(seen).T
    nearer = ranges < BEFORE * far[:, None]
    beside = np.abs(wrap(turn[:, None] - bearings)) < BESIDE
    return np.asarray((nearer & beside).any(1))
