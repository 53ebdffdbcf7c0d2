"""Starts: those that robots were given, against where the map without them has the robots.

A start that was given holds, however wrong: the map bends, in no one place enough to show. What
shows is the force that pulls at the start. It is worked out from the solved map (a score test, Rao
1948); where it is too large, the map is solved without that start to see how far it is off.
Nothing pulls at a robot that is so far off that it merges nothing: if it is doubted, it is placed
as one that does not know where it began.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from symboslam.engine.slam.beliefs import ClassBeliefs
from symboslam.engine.slam.joint import JointGraph
from symboslam.engine.slam.log import Floats
from symboslam.engine.slam.placing import place_lost
from symboslam.engine.slam.planar import between
from symboslam.engine.slam.scale import Scale

FAR = 25.0
"""Squared distance in standard deviations (three degrees of freedom) from which a start is doubted;
one in 65,000 right ones lies beyond it, if all is as it is modelled."""
SUSPECT = 12.0
"""The same, as far as the map is linear, from which a start is looked at."""
ELSEWHERE = 0.5
"""A robot is misplaced if it is nowhere nearer to where it is placed than this share of the
spacing."""
LEAST = 1e-9
"""Share of its own variance that a start has to take away from a direction to be tested in it."""
ITERATIONS = 20
"""Of a solution without one start, at most."""


def doubtful_starts(
    graph: JointGraph, doubted: Sequence[int], beliefs: ClassBeliefs, scale: Scale
) -> list[str]:
    """Starts, as given, that do not fit the map, one sentence each.

    Args:
        graph: solved, with marginals.
        doubted: numbers of members that are doubted for what they saw, the most doubted first.
        beliefs: what sightings say about classes.
        scale: how far apart landmarks are.
    """
    wrong = wrong_starts(graph)
    return [*wrong.values(), *_misplaced(graph, doubted, set(wrong), beliefs, scale)]


def wrong_starts(graph: JointGraph) -> dict[int, str]:
    """Members whose starts contradict the others', with a sentence; the farthest off first.

    Two robots alone contradict each other, and nothing says which of them is right.

    Args:
        graph: solved, with marginals.
    """
    known = [n for n, member in enumerate(graph.members) if member.start_sigma is not None]
    fixes = any(member.graph.fixes for member in graph.members)
    if len(known) < (1 if fixes else 2) or not graph.covariance:
        return {}
    found = []
    for number in known:
        if pull(graph, number) <= SUSPECT:
            continue
        off, square = _without(graph, number)
        if square > FAR:
            found.append((square, number, off))
    return {
        number: (
            f"{graph.members[number].name}: the start that it was given is "
            f"{math.hypot(*off[:2]):.1f} m and {math.degrees(abs(off[2])):.0f} degrees off where "
            f"the rest of the map has it ({math.sqrt(square):.0f} standard deviations); the map "
            "was bent to meet it, so that it may be farther off"
        )
        for square, number, off in sorted(found, key=lambda each: -each[0])
    }


def _misplaced(
    graph: JointGraph, doubted: Sequence[int], wrong: set[int], beliefs: ClassBeliefs, scale: Scale
) -> Iterator[str]:
    """Robots whose start is not where what they saw would place them, one sentence each.

    What the robots in ``wrong`` mapped does not count; those found here are added to them.
    """
    for number in doubted:
        member = graph.members[number]
        if member.start_sigma is None or number in wrong:
            continue
        lost = replace(member, pieces=[replace(piece) for piece in member.pieces])
        others = [
            replace(other, pieces=[]) if n in wrong | {number} else other
            for n, other in enumerate(graph.members)
        ]
        found = place_lost(replace(graph, members=others), [lost], beliefs, scale)
        if found is None:
            continue
        path = found[1]
        away = np.hypot(*(path - member.poses)[:, :2].T)
        if float(away.min()) > ELSEWHERE * graph.spacing:
            off = float(np.hypot(*(path[0] - member.start)[:2]))
            wrong.add(number)
            yield (
                f"{member.name}: by what it saw of what others mapped it began {off:.0f} m from "
                f"the start that it was given"
            )


def pull(graph: JointGraph, number: int) -> float:
    """Squared distance of a start from where the rest of the map has it, in standard deviations.

    As far as the map is linear: by the residual of the start and the covariance of the first pose.
    """
    member = graph.members[number]
    sigma = np.array(member.start_sigma)
    residual = between(member.start, member.poses[0]) / sigma
    left = graph.pose_covariance(number, 0) / np.outer(sigma, sigma)
    share, axes = np.linalg.eigh((left + left.T) / 2)
    tested = (share > 0) & (share < 1 - LEAST)
    along = (axes.T @ residual)[tested]
    return float((along**2 / (1 - share[tested])).sum())


def _without(graph: JointGraph, number: int) -> tuple[Floats, float]:
    """(3,) the start as seen from where the map has it without, and that in deviations, squared.

    Beside the covariances the map may be off as far as merged landmarks may (``floor``).
    """
    given = graph.members[number]
    members = [replace(member, poses=member.poses.copy()) for member in graph.members]
    for member, before in zip(members, graph.members, strict=True):
        member.start = before.start
    members[number].start_sigma = None
    members[number].start = given.poses[0]
    trial = replace(graph, members=members, xy=dict(graph.xy), covariance={})
    trial.solve(graph.settings.kernel, ITERATIONS)
    trial.marginals()
    off = between(members[number].poses[0], given.start)
    ranges = [seen.sigma_range for piece in graph.pieces for seen in piece.track.sightings]
    floor = graph.settings.floor * float(np.median(ranges))
    spread = trial.pose_covariance(number, 0) + np.diag(np.square(np.array(given.start_sigma)))
    spread += np.diag([floor**2, floor**2, 0.0])
    return off, float(off @ np.linalg.solve(spread, off))
