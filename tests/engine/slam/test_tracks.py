"""Tracker: which sightings are of one thing, by odometry alone."""

import math

import numpy as np
import pytest

from symboslam.engine.slam.beliefs import ClassBeliefs
from symboslam.engine.slam.pose_graph import PoseGraph, Sighting
from symboslam.engine.slam.tracks import Tracker


def seen(
    time: float, x: float, y: float, feature: int = 0, key: str = "", pose: int = 0
) -> Sighting:
    return Sighting(0, time, pose, math.hypot(x, y), math.atan2(y, x), 0.1, 0.01, feature, 0.9, key)


@pytest.fixture
def tracker() -> Tracker:
    graph = PoseGraph("r")
    graph.add(0, np.zeros(3), np.zeros(3))
    graph.add(1, np.array([1.0, 0, 0]), np.array([2.0, 2.0, 0.1]))
    return Tracker(graph, ClassBeliefs(np.eye(5)))


def follow(tracker: Tracker, *sightings: Sighting, limit: float = 1.0) -> list[int]:
    return [tracker.follow(s, 5.0, limit).number for s in sightings]


def test_the_same_place_at_another_time_is_the_same_thing(tracker: Tracker) -> None:
    assert follow(tracker, seen(0, 10, 0), seen(1, 10.1, 0)) == [0, 0]
    (track,) = tracker.tracks
    one, other = 0.01 + 0.01, 0.01 + (10.1 * 0.01) ** 2
    assert track.x == pytest.approx(10 + 0.1 * one / (one + other))
    assert track.variance == pytest.approx(one * other / (one + other))


def test_what_is_seen_at_one_time_is_two_things(tracker: Tracker) -> None:
    assert follow(tracker, seen(0, 10, 0), seen(0, 10.1, 0)) == [0, 1]


def test_another_place_is_another_thing(tracker: Tracker) -> None:
    assert follow(tracker, seen(0, 10, 0), seen(1, 10, 3)) == [0, 1]


@pytest.mark.parametrize(("feature", "number"), [(0, 0), (3, 1)])
def test_where_places_leave_doubt_the_class_decides(
    tracker: Tracker, feature: int, number: int
) -> None:
    assert follow(tracker, seen(0, 10, 0), seen(1, 10.7, 0, feature=feature)) == [0, number]


def test_names_that_differ_are_never_one_thing(tracker: Tracker) -> None:
    rows = seen(0, 10, 0, key="a"), seen(1, 10, 0, key="b"), seen(2, 10, 0, key="a")
    assert follow(tracker, *rows) == [0, 1, 0]
    assert [t.key for t in tracker.tracks] == ["a", "b"]


def test_a_track_ends_when_odometry_is_no_longer_good_enough(tracker: Tracker) -> None:
    assert follow(tracker, seen(0, 10, 0), seen(1, 9, 0, pose=1)) == [0, 1]
    assert [t.live for t in tracker.tracks] == [False, True]
    assert tracker.live == [tracker.tracks[1]]


def test_most_things_are_seen_often_only_after_a_while(tracker: Tracker) -> None:
    follow(tracker, *(seen(n, 10, 0) for n in range(100)))
    assert not tracker.often
    follow(tracker, seen(100, 10, 0))
    assert tracker.often
