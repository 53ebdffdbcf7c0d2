"""Starts: a wrong one is told by the name of its robot, right ones are not."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from symboslam.engine.slam.beliefs import ClassBeliefs
from symboslam.engine.slam.joint import JointGraph, Member
from symboslam.engine.slam.pose_graph import Fix
from symboslam.engine.slam.scale import Scale
from symboslam.engine.slam.settings import SlamSettings
from symboslam.engine.slam.starts import SUSPECT, doubtful_starts, pull, wrong_starts

MARKS = [(x, y) for x in (4.0, 12.0, 20.0) for y in (-5.0, 5.0)]


def team(robot: Any, *off: tuple[float, float, float]) -> JointGraph:
    """Robots that drive beside each other and see the same; their starts are so far off."""
    members = []
    for n, away in enumerate(off):
        way = [(float(x), float(n), 0.0) for x in range(25)]
        tracks = {k: [(at, x, y) for at in range(0, 25, 3)] for k, (x, y) in enumerate(MARKS)}
        member: Member = robot(f"r{n + 1}", way, tracks)
        member.start = member.start + np.array(away)
        member.renumber(n)
        members.append(member)
    graph = JointGraph(members, SlamSettings(), 8.0)
    graph.solve(0, 50)
    graph.solve(graph.settings.kernel, 50)
    graph.marginals()
    return graph


def test_the_pull_of_a_start_is_its_distance_from_the_rest_in_deviations(robot: Any) -> None:
    member: Member = robot("r", [(0, 0, 0)], {})
    member.start_sigma = (1.0, 1.0, 1.0)
    member.graph.fixes.append(Fix(0, 3.0, 0.0, 2.0))
    graph = JointGraph([member], SlamSettings(), 5.0)
    graph.solve(0, 50)
    graph.marginals()
    # Without the start it is at 3 with the variance 4, the start at 0 with 1: 3^2 / (4 + 1).
    assert member.poses[0, 0] == pytest.approx(0.6, abs=1e-4)
    assert pull(graph, 0) == pytest.approx(9 / 5, rel=1e-3)


def test_right_starts_are_not_doubted(robot: Any) -> None:
    graph = team(robot, (0, 0, 0), (0, 0, 0), (0, 0, 0))
    assert wrong_starts(graph) == {}
    assert max(pull(graph, n) for n in range(3)) < 0.1


@pytest.mark.parametrize(("off", "metres", "degrees"), [((5, 0, 0), 5, 0), ((0, 0, 0.4), 0, 23)])
def test_the_robot_whose_start_is_wrong_is_told_first(
    robot: Any, off: tuple[float, float, float], metres: float, degrees: float
) -> None:
    graph = team(robot, (0, 0, 0), off, (0, 0, 0))
    before = [member.poses.copy() for member in graph.members]
    (number, first), *_ = wrong_starts(graph).items()
    assert number == 1
    assert first.startswith("r2: the start that it was given is ")
    words = first.split()
    assert float(words[words.index("m") - 1]) == pytest.approx(metres, abs=0.3)
    assert float(words[words.index("degrees") - 1]) == pytest.approx(degrees, abs=2)
    for member, poses in zip(graph.members, before, strict=True):
        assert member.poses.tolist() == poses.tolist(), "the map is left as it is"


def test_two_robots_alone_contradict_each_other(robot: Any) -> None:
    said = wrong_starts(team(robot, (0, 0, 0), (5, 0, 0)))
    assert said.keys() == {0, 1}


def test_a_start_alone_contradicts_nobody(robot: Any) -> None:
    graph = team(robot, (50, 0, 0), (0, 0, 0))
    for member in graph.members[1:]:
        member.start_sigma = None
    graph.solve(graph.settings.kernel, 50)
    graph.marginals()
    assert wrong_starts(graph) == {}


@pytest.mark.parametrize(("sigma", "doubted"), [(0.01, True), (2.0, False)])
def test_a_start_may_be_off_as_far_as_it_says(robot: Any, sigma: float, doubted: bool) -> None:
    graph = team(robot, (0, 0, 0), (3, 0, 0))
    graph.members[1].start_sigma = (sigma, sigma, 0.1)
    graph.solve(graph.settings.kernel, 50)
    graph.marginals()
    assert (pull(graph, 1) > SUSPECT) == doubted
    assert bool(wrong_starts(graph)) == doubted


@pytest.mark.parametrize(("doubted", "said"), [([1, 2], ["r2"]), ([2], []), ([], [])])
def test_who_merges_nothing_is_placed_by_what_it_saw(
    robot: Any, doubted: list[int], said: list[str]
) -> None:
    members, scale = [], Scale()
    for n in range(3):
        off = 30.0 if n == 1 else 0.0  # where "r2" was told that it began
        way = [(x + off, float(n), 0.0) for x in range(25)]
        seen = {
            k + 10 * (n == 1): [(at, x + off, y) for at in range(0, 25, 3)]
            for k, (x, y) in enumerate(MARKS)
        }
        member: Member = robot(f"r{n + 1}", way, seen, feature={k: k % 10 for k in seen})
        member.renumber(n)
        members.append(member)
        for sighting in (s for piece in member.pieces for s in piece.track.sightings):
            scale.see(sighting)
    graph = JointGraph(members, SlamSettings(), 8.0)
    graph.solve(graph.settings.kernel, 50)
    graph.marginals()
    labels = [piece.label for piece in graph.pieces]
    found = doubtful_starts(graph, doubted, ClassBeliefs(np.eye(8)), scale)
    assert found == [
        f"{name}: by what it saw of what others mapped it began 30 m from the start that it was "
        "given"
        for name in said
    ]
    assert [piece.label for piece in graph.pieces] == labels
    assert [{piece.member for piece in member.pieces} for member in members] == [{0}, {1}, {2}]
