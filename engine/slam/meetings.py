"""Meetings: which robot it is that a robot saw."""

from __future__ import annotations

import numpy as np

from symboslam.engine.slam.joint import JointGraph, Member
from symboslam.engine.slam.log import ROBOT, Floats, Ints
from symboslam.engine.slam.planar import place
from symboslam.engine.slam.pose_graph import Sighting

NEAR = 0.36
"""A robot is where it was predicted, up to this share of the spacing of landmarks."""
ALONE = 0.1
"""Another has to be farther away than twice that and this share."""


def seen_robots(member: Member) -> list[Sighting]:
    """Whole sightings of robots."""
    return [s for s in member.graph.sightings if s.feature == ROBOT and s.whole]


def at_time(
    member: Member, time: Floats
) -> tuple[Ints, np.ndarray[tuple[int], np.dtype[np.bool_]]]:
    """The key pose at each time, and whether the robot was there then at all."""
    number = np.searchsorted(member.time, time + 1e-6) - 1
    there = (time >= member.time[0] - 1) & (time <= member.time[-1] + 1)
    return np.clip(number, 0, len(member.time) - 1), there


def find_meetings(graph: JointGraph) -> None:
    """Give each sighting of a robot the robot that is predicted there, if it is the only one.

    A sighting whose key is a robot's name is of that robot.
    """
    graph.meetings = []
    names = {member.name: n for n, member in enumerate(graph.members)}
    for number, member in enumerate(graph.members):
        seen = seen_robots(member)
        if not seen or len(graph.members) < 2:
            continue
        others = [n for n in range(len(graph.members)) if n != number]
        time = np.array([s.time for s in seen])
        where = place(member.poses[[s.pose for s in seen]], np.array([s.point for s in seen]))
        away, at = np.full((len(others), len(seen)), np.inf), []
        for row, other in enumerate(others):
            poses, there = at_time(graph.members[other], time)
            at.append(poses)
            distance = np.hypot(*(graph.members[other].poses[poses, :2] - where).T)
            away[row, there] = distance[there]
        order = np.argsort(away, axis=0)
        for n, sighting in enumerate(seen):
            row = int(order[0, n])
            first = away[row, n]
            second = away[order[1, n], n] if len(others) > 1 else np.inf
            if sighting.key in names:
                other = names[sighting.key]
                row = others.index(other) if other != number else -1
                sure = row >= 0 and np.isfinite(away[row, n])
            else:
                sure = first < NEAR * graph.spacing
                sure = sure and second > 2 * first + ALONE * graph.spacing
            if sure:
                graph.meetings.append((number, sighting, others[row], int(at[row][n])))
