"""Meetings: the robot that was seen is the one that was there, and nobody if two were."""

import math
from typing import Any

import numpy as np

from symboslam.engine.slam.joint import JointGraph, Member
from symboslam.engine.slam.log import ROBOT
from symboslam.engine.slam.meetings import at_time, find_meetings
from symboslam.engine.slam.pose_graph import Sighting
from symboslam.engine.slam.settings import SlamSettings


def seen(x: float, y: float, time: float = 0.0, key: str = "") -> Sighting:
    return Sighting(0, time, 0, math.hypot(x, y), math.atan2(y, x), 0.1, 0.01, ROBOT, 0.9, key)


def met(robot: Any, sighting: Sighting, *others: tuple[float, float]) -> list[tuple[int, int]]:
    members: list[Member] = [robot("robot 0", [(0, 0, 0), (1, 0, 0)], {})]
    for n, (x, y) in enumerate(others):
        members.append(robot(f"robot {n + 1}", [(x, y, 0), (x, y, 0)], {}))
    members[0].graph.sightings.append(sighting)
    graph = JointGraph(members, SlamSettings(), 10.0)
    find_meetings(graph)
    return [(other, at) for _, _, other, at in graph.meetings]


def test_the_robot_that_was_there(robot: Any) -> None:
    assert met(robot, seen(8, 1), (30, 0), (8.5, 1)) == [(2, 0)]


def test_nobody_there_or_two_there_is_no_meeting(robot: Any) -> None:
    assert met(robot, seen(8, 1), (30, 0), (20, 1)) == []
    assert met(robot, seen(8, 1), (7, 1), (9, 1)) == []


def test_a_key_that_is_a_name_tells_who_it_is(robot: Any) -> None:
    assert met(robot, seen(8, 1, key="robot 2"), (8, 1), (14, 1)) == [(2, 0)]


def test_nobody_meets_itself_or_anybody_at_another_time(robot: Any) -> None:
    assert met(robot, seen(0.1, 0, key="robot 0"), (30, 0)) == []
    assert met(robot, seen(8, 1, time=9.0), (8, 1)) == []
    assert met(robot, seen(8, 1, time=9.0, key="robot 1"), (8, 1)) == []


def test_alone_nobody_is_met(robot: Any) -> None:
    assert met(robot, seen(8, 1)) == []


def test_the_key_pose_at_a_time(robot: Any) -> None:
    member: Member = robot("r", [(n, 0, 0) for n in range(4)], {})
    number, there = at_time(member, np.array([-2.0, -0.5, 0.0, 1.7, 3.0, 3.9, 4.5]))
    assert number.tolist() == [0, 0, 0, 1, 3, 3, 3]
    assert there.tolist() == [False, True, True, True, True, True, False]
