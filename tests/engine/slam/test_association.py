"""Association: landmarks that are one are merged; those that cannot be are not."""

from typing import Any

import numpy as np
import pytest

from symboslam.engine.slam.association import FAR, Association
from symboslam.engine.slam.beliefs import ClassBeliefs
from symboslam.engine.slam.joint import JointGraph, Member
from symboslam.engine.slam.scale import Scale
from symboslam.engine.slam.settings import SlamSettings

Rows = dict[int, list[tuple[float, float, float]]]


def solved(*members: Member) -> Association:
    graph, scale = JointGraph(list(members), SlamSettings(), 10.0), Scale()
    for n, member in enumerate(members):
        member.renumber(n)
        for piece in member.pieces:
            for seen in piece.track.sightings:
                scale.see(seen)
    graph.solve(2.0)
    graph.marginals()
    return Association(graph, ClassBeliefs(np.eye(8)), scale)


def seen_at(label: int, x: float, y: float, *poses: int) -> Rows:
    return {label: [(n, x, y) for n in poses]}


PATH = [(n, 0, 0) for n in range(12)]


def test_landmarks_at_one_place_seen_at_other_times_are_merged(robot: Any) -> None:
    found = solved(robot("r", PATH, seen_at(0, 5, 3, 0, 1, 2, 3) | seen_at(1, 5, 3.05, 8, 9, 10)))
    assert found.merge_near() == 1
    assert found.graph.labels() == [0]
    assert found.graph.xy[0] == pytest.approx([5, 3.02], abs=0.1)


def test_landmarks_seen_beside_each_other_are_two(robot: Any) -> None:
    found = solved(robot("r", PATH, seen_at(0, 5, 3, 0, 1, 2, 3) | seen_at(1, 5, 3.05, 0, 1, 2)))
    assert found.merge_near() == 0
    assert found.constellations() == (0, False)


def test_landmarks_of_two_classes_are_two(robot: Any) -> None:
    rows = seen_at(0, 5, 3, 0, 1, 2, 3) | seen_at(1, 5, 3.05, 8, 9, 10)
    assert solved(robot("r", PATH, rows, feature={1: 4})).merge_near() == 0


def test_landmarks_of_two_names_are_two(robot: Any) -> None:
    rows = seen_at(0, 5, 3, 0, 1, 2, 3) | seen_at(1, 5, 3.05, 8, 9, 10)
    assert solved(robot("r", PATH, rows, key={0: "a", 1: "b"})).merge_near() == 0
    assert solved(robot("r", PATH, rows, key={0: "a"})).merge_near() == 1


def test_landmarks_that_may_be_far_apart_have_to_be_surer_to_be_merged(robot: Any) -> None:
    rows = seen_at(0, 5, 3, 0, 1, 2, 3) | seen_at(1, 5, 3.05, 8, 9, 10)

    def merged(sigma: float, share: float) -> int:
        found = solved(robot("r", PATH, rows))
        graph, scale = found.graph, found.scale
        graph.covariance = {label: np.eye(2) * sigma**2 / 2 for label in (0, 1)}
        found.take_stock()
        floor = (graph.settings.floor * scale.sigma) ** 2
        odds = scale.same(
            graph.xy[0] - graph.xy[1], np.eye(2) * (sigma**2 + floor),
            float(found.alike[0, 1]), 7, graph.spacing,
        )  # fmt: skip
        assert odds > 0
        graph.settings = SlamSettings(certainty=share * odds)
        return found.merge_near()

    assert FAR * 10 == 3
    assert merged(3.5, 1.2) == 0
    assert merged(3.5, 0.9) == 1
    assert merged(2.5, 1.2) == 1


def test_landmarks_far_apart_are_two(robot: Any) -> None:
    found = solved(robot("r", PATH, seen_at(0, 5, 3, 0, 1, 2) | seen_at(1, 5, 7, 8, 9, 10)))
    assert found.merge_near() == 0
    assert found.move() == 0


def test_a_track_of_another_landmark_is_moved_there(robot: Any) -> None:
    member: Member = robot("r", PATH, seen_at(0, 5, 3, 0, 1, 2) | seen_at(1, 5, 9, 3, 4, 5))
    other: Member = robot("s", PATH, seen_at(0, 5, 3, 6, 7) | seen_at(2, 5, 9, 8, 9))
    other.pieces[1].label = 0
    found = solved(member, other)
    found.graph.xy |= {0: np.array([5.0, 3.0]), 1: np.array([5.0, 9.0])}
    assert found.move() == 1
    assert [p.label for p in other.pieces] == [0, 1]


def test_a_track_that_fits_nothing_is_split_off(robot: Any) -> None:
    member: Member = robot("r", PATH, seen_at(0, 5, 3, 0, 1, 2) | seen_at(1, 5, -6, 3, 4))
    member.pieces[1].label = 0
    found = solved(member)
    found.graph.xy[0] = np.array([5.0, 3.0])
    assert found.move() == 1
    assert [p.label for p in member.pieces] == [0, 1]
    assert found.graph.xy[1] == pytest.approx([5, -6], abs=0.2)


def test_named_tracks_stay_with_their_landmark(robot: Any) -> None:
    rows = seen_at(0, 5, 3, 0, 1, 2) | seen_at(1, 5, -6, 3, 4)
    member: Member = robot("r", PATH, rows, key={1: "a"})
    member.pieces[1].label = 0
    found = solved(member)
    found.graph.xy[0] = np.array([5.0, 3.0])
    assert found.move() == 0


def test_windows_hold_every_track(robot: Any) -> None:
    rows: Rows = {}
    for n in range(12):
        rows |= seen_at(n, n, 3, n)
    found = solved(robot("r", PATH, rows))
    windows = found.windows(0)
    assert {p.label for window in windows for p in window} == set(range(12))
