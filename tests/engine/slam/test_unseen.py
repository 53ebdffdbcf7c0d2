"""Unseen: what should have been seen and was not is counted for both who may be wrong."""

from __future__ import annotations

from typing import Any

import pytest

from symboslam.engine.slam.joint import JointGraph, Member
from symboslam.engine.slam.settings import SlamSettings
from symboslam.engine.slam.unseen import unseen

STRAIGHT = [(n, 0, 0) for n in range(60)]
AHEAD = {n: [(n, n + 12, -4), (n + 1, n + 12, 4), (n + 2, n + 12, 0)] for n in range(40)}
"""Things 10 to 12 m ahead, seen at bearings on both sides."""
IN_VIEW = 34
"""Thing n is at n + 12, in view (nearer than 8.9 m) from key poses n + 4 to n + 11; the last one
that saw something is 41: five of them up to n = 33."""
NEAR = 100
"""A thing on the way."""


def counts(*members: Member) -> list[tuple[int, int]]:
    graph = JointGraph(list(members), SlamSettings(), 5.0)
    for number, member in enumerate(members):
        member.renumber(number)
    graph.put_landmarks()
    return unseen(graph)


def test_what_is_in_view_and_seen_is_expected(robot: Any) -> None:
    ((missed, expected),) = counts(robot("r", STRAIGHT, AHEAD))
    assert missed == 0
    assert expected == IN_VIEW


def test_what_another_saw_and_nobody_else_counts_for_both(robot: Any) -> None:
    seen = {NEAR: [(n, 30, 0) for n in range(18, 22)]}
    (first, of_first), (second, of_second) = counts(
        robot("one", STRAIGHT, AHEAD), robot("other", STRAIGHT, seen)
    )
    assert (first, of_first) == (1, IN_VIEW + 1)
    assert second == 1
    assert of_second >= 1


@pytest.mark.parametrize(
    ("before", "missed"),
    [((28.0, 0.0), 0), ((28.0, 8.0), 1), ((32.0, 0.0), 1)],
    ids=["before it", "beside it", "behind it"],
)
def test_what_something_nearer_hides_is_expected_of_nobody(
    robot: Any, before: tuple[float, float], missed: int
) -> None:
    house = {NEAR + 1: [(n, *before) for n in range(18, 28)]}
    seen = {NEAR: [(n, 30, 0) for n in range(18, 22)]}
    # In view from 22 to 29; what is at 28 is seen at less than 0.8 of the distance up to 27.
    (first, _), _ = counts(robot("one", STRAIGHT, AHEAD | house), robot("other", STRAIGHT, seen))
    assert first == missed


def test_what_was_seen_twice_only_is_expected_of_nobody(robot: Any) -> None:
    seen = {NEAR: [(18, 30, 0), (19, 30, 0)]}
    (first, _), (second, _) = counts(robot("one", STRAIGHT, AHEAD), robot("other", STRAIGHT, seen))
    assert first == second == 0


def test_what_lies_out_of_view_is_expected_of_nobody(robot: Any) -> None:
    seen = {NEAR: [(n, 30, 40) for n in range(28, 33)]}
    (first, of_first), (second, _) = counts(
        robot("one", STRAIGHT, AHEAD), robot("other", STRAIGHT, seen)
    )
    assert (first, of_first, second) == (0, IN_VIEW, 0)


def test_who_saw_nothing_expects_nothing(robot: Any) -> None:
    assert counts(robot("r", STRAIGHT, {})) == [(0, 0)]
