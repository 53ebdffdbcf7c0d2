"""Consistency: a bent map, sightings that do not fit and robots that are not there are doubted."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from symboslam.engine.slam.consistency import (
    Doubt,
    bending,
    doubts,
    misfits,
    names_of_several,
    vagueness,
)
from symboslam.engine.slam.joint import JointGraph, Member
from symboslam.engine.slam.log import ROBOT
from symboslam.engine.slam.pose_graph import Fix, Sighting
from symboslam.engine.slam.settings import SlamSettings

STRAIGHT = [(n, 0, 0) for n in range(60)]
MARKS = {n: [(n, n + 3, 4)] for n in range(40)}


def said(*members: Member, **edge: Any) -> list[list[str]]:
    graph = JointGraph(list(members), SlamSettings(), 5.0)
    for n, member in enumerate(members):
        member.renumber(n)
    graph.put_landmarks()
    edges: Any = [SimpleNamespace(**({"trouble": "", "outliers": 0} | edge)) for _ in members]
    return [[doubt.said for doubt in each] for each in doubts(graph, edges)]


def test_a_map_that_fits_is_not_doubted(robot: Any) -> None:
    member: Member = robot("r", STRAIGHT, MARKS)
    assert bending(member) == pytest.approx(0)
    assert said(member) == [[]]


def test_a_bent_map_is_doubted(robot: Any) -> None:
    member: Member = robot("r", STRAIGHT, MARKS)
    angle = np.linspace(0, 2 * np.pi, 60)
    member.poses = np.column_stack([10 * np.sin(angle), 10 - 10 * np.cos(angle), angle])
    assert bending(member) > 12
    ((sentence, *_),) = said(member)
    assert "bends its odometry" in sentence
    assert sentence.startswith("r: ")


def test_bending_is_how_many_deviations_a_window_is_off(robot: Any) -> None:
    member: Member = robot("r", STRAIGHT, {})
    sigma = float(member.sigma[1, 0])
    member.poses = member.poses * [1 + sigma, 1, 1]  # each step a deviation too long
    assert bending(member) == pytest.approx(30)


def test_too_short_a_way_is_not_judged(robot: Any) -> None:
    member: Member = robot("r", STRAIGHT[:20], {})
    member.poses = member.poses * [5, 1, 1]
    assert bending(member) == 1.0


def test_sightings_that_do_not_fit_are_doubted(robot: Any) -> None:
    member: Member = robot("r", STRAIGHT, MARKS)
    graph = JointGraph([member], SlamSettings(), 5.0)
    graph.put_landmarks()
    assert misfits(graph) == [(0.0, 40)]
    for n in range(10):
        graph.xy[n] = graph.xy[n] + 3.0
    assert misfits(graph) == [(0.25, 40)]
    edge: Any = SimpleNamespace(trouble="", outliers=0)
    sentence = "r: 25% of 40 sightings do not fit the map (more than 15%)"
    assert doubts(graph, [edge]) == [[Doubt(sentence, 0.25 / 0.15)]]


def test_trouble_and_outliers_of_its_own_map_are_told(robot: Any) -> None:
    member: Member = robot("r", STRAIGHT, MARKS)
    member.graph.sightings += [s for p in member.pieces for s in p.track.sightings]
    ((trouble, once),) = said(member, trouble="singular", outliers=10)
    assert "could not be kept up to date: singular" in trouble
    assert "25% of 40 sightings are of nothing" in once


def test_robots_seen_where_none_is_are_doubted(robot: Any) -> None:
    one: Member = robot("one", STRAIGHT, MARKS)
    other: Member = robot("other", STRAIGHT, {})
    one.graph.sightings += [Sighting(n, n, n, 5.0, 0.0, 0.1, 0.01, ROBOT, 0.9) for n in range(30)]
    first, second = said(one, other)
    assert first == ["one: of 30 robots that it saw, only 0 are where a robot is"]
    assert second == []


def test_a_map_that_fits_but_is_vague_is_doubted() -> None:
    graph = JointGraph([], SlamSettings(), 5.0)
    graph.covariance = {n: np.diag([1.0, 1.0]) for n in range(7)}
    graph.covariance |= {n: np.diag([0.1, 4.1]) for n in range(7, 9)}
    assert vagueness(graph, 10.0) == [
        "2 of 9 landmarks may be off by more than 2 m (one standard deviation): "
        "too little was seen again"
    ]
    assert vagueness(graph, 10.2) == []
    graph.covariance[9] = np.eye(2)  # two of ten are no more than a fifth
    assert vagueness(graph, 10.0) == []


@pytest.mark.parametrize(("elsewhere", "told"), [(3, False), (4, True)])
def test_a_name_that_is_read_in_several_places_is_told(
    robot: Any, elsewhere: int, told: bool
) -> None:
    there = [(n, 20, 4) for n in range(10 - elsewhere)]
    other = [(n, 20, -40) for n in range(10 - elsewhere, 10)]
    member: Member = robot("r", STRAIGHT, {0: there, 1: other})
    for piece in member.pieces:
        piece.label, piece.track.key = 0, "EXIT"
    graph = JointGraph([member], SlamSettings(), 5.0)
    graph.xy[0] = np.array([20.0, 4.0])
    sentence = "what is named 'EXIT' is not one thing: 4 of 10 sightings of it are somewhere else"
    assert names_of_several(graph) == ([sentence] if told else [])


def test_landmarks_in_view_that_were_never_seen_are_doubted(robot: Any) -> None:
    own = {n: [(n + k, n + 12, 4 * (k - 1)) for k in range(3)] for n in range(40)}
    other = {100 + n: [(n + k, n + 12.5, 4 * (k - 1)) for k in range(3)] for n in range(40)}
    # Each has 34 of its own in view five times; "one" 34 of the other's, "two", whose view reaches
    # 9.2 m and not 8.9 m, 35.
    for name, found in zip(
        ("one", "two"),
        said(robot("one", STRAIGHT, own), robot("two", STRAIGHT, other)),
        strict=True,
    ):
        (sentence,) = [each for each in found if "in view" in each]
        assert sentence.startswith(f"{name}: 69 of 103 times a landmark was in view again")


def test_positions_from_outside_that_do_not_fit_are_doubted(robot: Any) -> None:
    member: Member = robot("r", STRAIGHT, MARKS)
    member.graph.fixes += [Fix(n, n, 4.9 if n else 5.1, 1.0) for n in range(6)]
    assert said(member) == [[]]
    member.graph.fixes[1] = Fix(1, 1, 5.1, 1.0)
    assert said(member) == [
        ["r: 2 of 6 positions from outside lie more than 5 standard deviations from where the map "
         "has it"]
    ]  # fmt: skip
