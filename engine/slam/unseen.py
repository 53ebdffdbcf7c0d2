"""Unseen: landmarks that a robot had in view again and again, and never saw.

A robot that is wrong merges nothing, and what is not merged fits itself. But then the landmarks of
others lie in its view all the time without being seen, and its own in theirs.
"""

from __future__ import annotations

import numpy as np

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
    for x, y, heading in member.poses[sorted({s.pose for s in seen})].tolist():
        away = xy - (x, y)
        turn = wrap(np.arctan2(away[:, 1], away[:, 0]) - heading)
        times += (np.hypot(*away.T) < reach) & (low < turn) & (turn < high)
    return times
