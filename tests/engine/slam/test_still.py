"""Still: tracks of one class at one place are of one thing that did not move."""

from typing import Any

import pytest

from symboslam.engine.slam.joint import JointGraph, Member
from symboslam.engine.slam.settings import SlamSettings
from symboslam.engine.slam.still import put_together

PATH = [(n, 0, 0) for n in range(12)]


def labels(*members: Member, sigma: float = 0.5) -> tuple[list[int], JointGraph]:
    graph = JointGraph(list(members), SlamSettings(), 10.0)
    pieces = []
    for number, member in enumerate(members):
        member.renumber(number)
        pieces += member.pieces
    put_together(graph, pieces, 100, sigma)
    return [piece.label for piece in pieces], graph


def test_tracks_at_one_place_are_of_one_thing(robot: Any) -> None:
    tracks = {0: [(0, 5, 3), (1, 5, 3)], 1: [(5, 5.2, 3), (6, 5.2, 3), (7, 5.2, 3)]}
    other = {0: [(2, 5.1, 3)]}
    found, graph = labels(robot("r", PATH, tracks), robot("s", PATH, other))
    assert found == [100, 100, 100]
    assert graph.xy[100] == pytest.approx([5.2, 3.0], abs=0.01)  # of the one seen most


def test_what_moved_is_another_thing(robot: Any) -> None:
    tracks = {0: [(0, 5, 3), (1, 5, 3)], 1: [(5, 12, 3)]}
    assert labels(robot("r", PATH, tracks))[0] == [100, 101]
    assert labels(robot("r", PATH, tracks), sigma=4.0)[0] == [100, 100]


def test_other_classes_and_things_seen_side_by_side_are_other_things(robot: Any) -> None:
    tracks = {0: [(0, 5, 3), (1, 5, 3)], 1: [(5, 5, 3)]}
    assert labels(robot("r", PATH, tracks, feature={1: 4}))[0] == [100, 101]
    beside = {0: [(0, 5, 3), (1, 5, 3)], 1: [(0, 5.3, 3), (1, 5.3, 3)]}
    assert labels(robot("r", PATH, beside))[0] == [100, 101]


def test_of_nothing_nothing_is_made(robot: Any) -> None:
    assert labels(robot("r", PATH, {}))[0] == []
