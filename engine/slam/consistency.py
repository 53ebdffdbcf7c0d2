"""Consistency: whether a solved map can be trusted, and if not, why."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.edge_map import EdgeMap
from symboslam.engine.slam.joint import JointGraph, Member, Piece
from symboslam.engine.slam.log import Floats
from symboslam.engine.slam.meetings import seen_robots
from symboslam.engine.slam.planar import between, wrap
from symboslam.engine.slam.unseen import unseen

MISFITS = 0.15
"""Share of a robot's sightings beyond four standard deviations, from which it is doubted."""
STRAY = 0.2
"""Share of a robot's positions from outside that do not fit, from which it is doubted."""
OFF = 5.0
"""Standard deviations beyond which a position from outside does not fit."""
UNMET = 0.2
"""Share of robots seen that are where no robot is, from which a robot is doubted."""
LOST = 0.15
"""Share of a robot's sightings that are of nothing seen again, from which it is doubted."""
MISSED = 0.2
"""Share of landmarks in view again and again, but never seen, from which a robot is doubted."""
ELSEWHERE = 0.3
"""Share of the sightings of a name that do not fit, from which it is of several things."""
VAGUE = 0.2
"""A landmark is vague if its standard deviation is more than this share of what the sensor reaches;
a map is, if more than this share of its landmarks are."""
WINDOW = 30
"""Steps over which odometry is compared with the map."""
BENT = 12.0
"""Mean squared residual of odometry, in standard deviations, from which a robot is doubted."""


@dataclass(frozen=True)
class Doubt:
    """Why a robot's part of a map should not be trusted.

    Attributes:
        said: a sentence.
        excess: how many times what is allowed; more than 1.
    """

    said: str
    excess: float


def doubts(graph: JointGraph, edges: list[EdgeMap]) -> list[list[Doubt]]:
    """For each robot why the map should not be trusted.

    A bent map shows in sightings that do not fit their landmarks, in odometry that is worse than
    it says it is, in robots seen where none is, and in landmarks not seen where they should be.
    """
    every = []
    fits = misfits(graph)
    missing = unseen(graph)
    met = {number: 0 for number in range(len(graph.members))}
    for number, *_ in graph.meetings:
        met[number] += 1
    for number, (member, edge) in enumerate(zip(graph.members, edges, strict=True)):
        found: list[Doubt] = []
        every.append(found)
        name = member.name
        if edge.trouble:
            said = f"{name}: its own map could not be kept up to date: {edge.trouble}"
            found.append(Doubt(said, np.inf))
        share, total = fits[number]
        once, seen = edge.outliers, sum(s.whole for s in member.graph.sightings)
        if seen >= 20 and once > LOST * seen:
            said = (
                f"{name}: {once / seen:.0%} of {seen} sightings are of nothing that was seen "
                f"again (more than {LOST:.0%})"
            )
            found.append(Doubt(said, once / seen / LOST))
        if total >= 20 and share > MISFITS:
            said = (
                f"{name}: {share:.0%} of {total} sightings do not fit the map "
                f"(more than {MISFITS:.0%})"
            )
            found.append(Doubt(said, share / MISFITS))
        bend = bending(member)
        if bend > BENT:
            said = (
                f"{name}: the map bends its odometry {bend**0.5:.1f} times as much as its noise "
                f"allows"
            )
            found.append(Doubt(said, bend / BENT))
        missed, expected = missing[number]
        if expected >= 10 and missed > MISSED * expected:
            said = (
                f"{name}: {missed} of {expected} times a landmark was in view again and again "
                f"and never seen, one of its own by others or of theirs by it"
            )
            found.append(Doubt(said, missed / expected / MISSED))
        stray, fixes = strays(member), len(member.graph.fixes)
        if fixes >= 5 and stray > STRAY * fixes:
            said = (
                f"{name}: {stray} of {fixes} positions from outside lie more than {OFF:g} standard "
                "deviations from where the map has it"
            )
            found.append(Doubt(said, stray / fixes / STRAY))
        robots = len(seen_robots(member))
        if len(graph.members) > 1 and robots >= 20 and met[number] < (1 - UNMET) * robots:
            said = (
                f"{name}: of {robots} robots that it saw, only {met[number]} are where a robot is"
            )
            found.append(Doubt(said, (1 - met[number] / robots) / UNMET))
    return every


def strays(member: Member) -> int:
    """How many positions from outside do not fit a robot's path."""
    return sum(
        float(np.hypot(*(member.poses[fix.pose, :2] - (fix.x, fix.y)))) > OFF * fix.sigma
        for fix in member.graph.fixes
    )


def vagueness(graph: JointGraph, reach: float) -> list[str]:
    """Why a map that fits should not be trusted all the same: too little was seen twice.

    Args:
        graph: solved, with marginals.
        reach: metres that the sensor reaches.
    """
    far = sum(
        float(np.linalg.eigvalsh(each)[-1]) ** 0.5 > VAGUE * reach
        for each in graph.covariance.values()
    )
    total = len(graph.covariance)
    if far <= VAGUE * total:
        return []
    return [
        f"{far} of {total} landmarks may be off by more than {VAGUE * reach:.0f} m (one standard "
        f"deviation): too little was seen again"
    ]


def names_of_several(graph: JointGraph) -> list[str]:
    """Names that are read in several places, one sentence each: such merge what is not one."""
    bad: dict[str, int] = {}
    total: dict[str, int] = {}
    for piece in graph.pieces:
        name = piece.track.key
        if name:
            bad[name] = bad.get(name, 0) + int(_misfit(graph, piece).sum())
            total[name] = total.get(name, 0) + len(piece.track.sightings)
    return [
        f"what is named {name!r} is not one thing: {bad[name]} of {times} sightings of it are "
        f"somewhere else"
        for name, times in total.items()
        if times >= 5 and bad[name] > ELSEWHERE * times
    ]


def misfits(graph: JointGraph) -> list[tuple[float, int]]:
    """For each robot the share of its sightings that do not fit, and how many there are."""
    bad, total = np.zeros(len(graph.members), int), np.zeros(len(graph.members), int)
    for piece in graph.pieces:
        bad[piece.member] += int(_misfit(graph, piece).sum())
        total[piece.member] += len(piece.track.sightings)
    return [(float(b / max(t, 1)), int(t)) for b, t in zip(bad, total, strict=True)]


def _misfit(graph: JointGraph, piece: Piece) -> NDArray[np.bool_]:
    """(k,) which sightings of a track lie beyond four standard deviations."""
    poses = graph.members[piece.member].poses[piece.at]
    away = graph.xy[piece.label] - poses[:, :2]
    reach = np.hypot(away[:, 0], away[:, 1])
    turn = wrap(np.arctan2(away[:, 1], away[:, 0]) - poses[:, 2])
    seen = piece.track.sightings
    off = (reach - [s.range for s in seen]) / [s.sigma_range for s in seen]
    aside = wrap(turn - [s.bearing for s in seen]) / [s.sigma_bearing for s in seen]
    return np.asarray(off**2 + aside**2 > 16)


def bending(member: Member) -> float:
    """Mean squared residual of odometry over windows, in standard deviations; about 1 if right."""
    if len(member.poses) < WINDOW + 2:
        return 1.0
    got = between(member.poses[:-1], member.poses[1:])
    left = got - member.step[1:]
    left[:, 2] = wrap(left[:, 2])
    return float(np.max(np.mean(_windows(left) ** 2 / _windows(member.sigma[1:] ** 2), axis=0)))


def _windows(values: Floats) -> Floats:
    """(n - WINDOW, 3) sums over windows."""
    sums = np.cumsum(np.vstack([np.zeros(3), values]), axis=0)
    return np.asarray(sums[WINDOW:] - sums[:-WINDOW])
