"""Placing: where a robot is that does not know where it began.

By three or more things that it saw and that are on the map (resection, as the paper suggests), or
by what has a name. A window of its tracks is compared with the map as a constellation, wherever it
may lie and however it may be turned; frames are planar and upright.
"""

from __future__ import annotations

import math

import numpy as np

from symboslam.engine.slam.association import Association
from symboslam.engine.slam.beliefs import ClassBeliefs
from symboslam.engine.slam.constellation import Placing, Things, match
from symboslam.engine.slam.joint import JointGraph, Member
from symboslam.engine.slam.log import Floats
from symboslam.engine.slam.planar import between, compose, rigid
from symboslam.engine.slam.scale import Scale

LEAST = 3
"""So many things fix a robot that may be anywhere."""
SURE = 4.0
"""Log odds by which a place has to be surer than for a merge, because any place is possible."""


def place_lost(
    graph: JointGraph, lost: list[Member], beliefs: ClassBeliefs, scale: Scale
) -> tuple[int, Floats] | None:
    """The robot that can be placed most surely.

    Args:
        graph: the map, solved.
        lost: robots in frames of their own.
        beliefs: what sightings say about classes.
        scale: how far apart landmarks are.

    Returns:
        Its number among the lost, and (n, 3) its poses on the map; None if none can be placed.
    """
    best: tuple[float, int, Floats] | None = None
    if not graph.labels():
        return None
    for number, member in enumerate(lost):
        named = _by_names(graph, member)
        if named is None:
            named = _by_bearings(graph, member)
        found = (math.inf, named) if named is not None else _by_class(graph, member, beliefs, scale)
        if found is not None and (best is None or found[0] > best[0]):
            best = found[0], number, found[1]
    return None if best is None else (best[1], best[2])


def _by_names(graph: JointGraph, member: Member) -> Floats | None:
    """(n, 3) poses by two or more things with names."""
    mine: dict[int, Floats] = {}
    known = set(graph.labels())
    for piece in member.pieces:
        if piece.track.key and piece.label in known:
            mine[piece.label] = piece.where(member.poses)[0]
    if len(mine) < 2:
        return None
    here = np.array(list(mine.values()))
    there = np.array([graph.xy[label] for label in mine])
    if np.ptp(here, axis=0).max() < 0.1 * graph.spacing:
        return None
    return compose(rigid(here, there), member.poses)


def _by_bearings(graph: JointGraph, member: Member) -> Floats | None:
    """(n, 3) poses by bearings alone of three or more things with names, from one key pose."""
    named = {piece.track.key: graph.xy[piece.label] for piece in graph.pieces if piece.track.key}
    seen: dict[int, dict[str, float]] = {}
    for sighting in member.graph.sightings:
        if sighting.key in named and not math.isnan(sighting.bearing):
            seen.setdefault(sighting.pose, {})[sighting.key] = sighting.bearing
    number = max(seen, key=lambda pose: len(seen[pose]), default=-1)
    if number < 0 or len(seen[number]) < LEAST:
        return None
    landmarks = np.array([named[key] for key in seen[number]])
    pose = resection(landmarks, np.array(list(seen[number].values())))
    return compose(pose, between(member.poses[number], member.poses))


def _by_class(
    graph: JointGraph, member: Member, beliefs: ClassBeliefs, scale: Scale
) -> tuple[float, Floats] | None:
    """Log odds and (n, 3) poses by the best constellation."""
    alone = JointGraph([member], graph.settings, graph.spacing)
    for piece in member.pieces:
        piece.member = 0
    alone.put_landmarks()
    mine, theirs = Association(alone, beliefs, scale), Association(graph, beliefs, scale)
    if not member.pieces:
        return None
    mine.take_stock()
    theirs.take_stock()
    there = Things(theirs.xy, theirs.told)
    found = []
    for window in mine.windows(0):
        labels = list(dict.fromkeys(piece.label for piece in window))
        if len(labels) < LEAST:
            continue
        here = mine.around(0, window, labels)
        alike = beliefs.alike(here.evidence, there.evidence)
        anywhere = Placing(np.full(len(labels), np.inf), math.pi)
        tolerance = mine.tolerance(0, window, labels)
        for each in match(here, there, alike, anywhere, tolerance, graph.spacing)[:1]:
            sure = each.odds > graph.settings.certainty and each.margin > graph.settings.rival
            if sure and len(each.here) >= LEAST:
                move = rigid(here.xy[each.here], there.xy[each.there])
                middle = window[len(window) // 2].track.last
                found.append((each.odds, middle, compose(move, member.poses[middle])))
    return _agreed(found, member, graph.settings.certainty + SURE)


def _agreed(
    found: list[tuple[float, int, Floats]], member: Member, least: float
) -> tuple[float, Floats] | None:
    """Log odds and (n, 3) poses by the place that most windows agree on.

    Args:
        found: log odds, number of a key pose, and where it is on the map.
        member: the robot.
        least: log odds that are needed; twice as many if a window stands alone.
    """
    best: tuple[float, Floats] | None = None
    for _, number, pose in found:
        path = compose(pose, between(member.poses[number], member.poses))
        odds, windows = 0.0, 0
        for each, other, there in found:
            off = between(path[other], there)
            spread = 2 * member.graph.drift(number, other) + 1e-6
            way = member.graph.way(number, other) + 1e-6
            turn = 4 * math.sqrt(spread) / max(way, 1.0) + 0.2
            if off[0] ** 2 + off[1] ** 2 < 16 * spread + 1 and abs(off[2]) < turn:
                odds, windows = odds + each, windows + 1
        need = least if windows > 1 else 2 * least
        if odds > need and (best is None or odds > best[0]):
            best = odds, path
    return best


def resection(landmarks: Floats, bearing: Floats) -> Floats:
    """(3,) where a robot is that sees known landmarks in some directions.

    The best of many starts, in the least squares of the bearings.

    Args:
        landmarks: (k, 2) metres, k >= 3.
        bearing: (k,) radians from its heading.

    Raises:
        ValueError: too few landmarks.
    """
    if len(landmarks) < LEAST:
        raise ValueError("resection needs three landmarks")
    from scipy.optimize import least_squares

    def miss(pose: Floats) -> Floats:
        away = landmarks - pose[:2]
        turn = np.arctan2(away[:, 1], away[:, 0]) - pose[2] - bearing
        return np.asarray((turn + np.pi) % (2 * np.pi) - np.pi)

    centre, wide = landmarks.mean(0), max(float(np.ptp(landmarks, axis=0).max()), 1e-6)
    best = None
    for angle in np.linspace(0, 2 * np.pi, 12, endpoint=False):
        for far in (0.3, 1.0, 2.0):
            at = centre + far * wide * np.array([np.cos(angle), np.sin(angle)])
            away = landmarks - at
            heading = np.angle(np.exp(1j * (np.arctan2(away[:, 1], away[:, 0]) - bearing)).sum())
            found = least_squares(miss, np.array([*at, heading]))
            if best is None or found.cost < best.cost:
                best = found
    assert best is not None
    return np.asarray(best.x)
