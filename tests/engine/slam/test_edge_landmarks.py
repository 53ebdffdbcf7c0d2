"""EdgeLandmarks: what is known of landmarks, also when two turn out to be one."""

from __future__ import annotations

import math

import numpy as np
import pytest

from symboslam.engine.slam.edge_landmarks import EdgeLandmarks
from symboslam.engine.slam.pose_graph import Sighting

NAN = math.nan


def landmarks() -> EdgeLandmarks:
    """A landmark of class 0 at (3, 4), one of class 1 at (0, 10)."""
    made = EdgeLandmarks(2)
    for xy, evidence in (((3.0, 4.0), (0.0, -2.0)), ((0.0, 10.0), (-2.0, 0.0))):
        number = made.new(np.array(xy))
        made.see(number, float(number), np.array(evidence))
    return made


def sighting(distance: float, bearing: float, feature: int = 0) -> Sighting:
    return Sighting(0, 0.0, 0, distance, bearing, 0.1, 0.01, feature, 0.9)


def test_classes_are_the_likeliest() -> None:
    assert landmarks().classes().tolist() == [0, 1]


def test_a_landmark_that_is_another_is_no_root_any_more() -> None:
    made = landmarks()
    made.named["school"] = 1
    made.merge(0, 1)
    assert made.roots == [0]
    assert made.seen(0) == 2
    assert made.named == {"school": 0}
    assert made.evidence([0]).tolist() == [[-2.0, -2.0]]
    assert len(made) == 2  # numbers stay


def test_seen_at_one_moment_they_are_two() -> None:
    made = landmarks()
    assert not made.together(0, 1)
    made.see(1, 0.0, np.zeros(2))
    assert made.together(0, 1)


@pytest.mark.parametrize(
    ("distance", "bearing", "feature", "found"),
    [
        (5.0, NAN, 0, 0),  # at (3, 4), seen from the origin
        (5.5, NAN, 0, 0),  # 0.5 m are slack
        (5.9, NAN, 0, None),
        (5.0, NAN, 1, None),  # the other class
        (NAN, math.atan2(4, 3), 0, 0),
        (NAN, math.atan2(4, 3) + 0.12, 0, 0),  # 0.03 + 0.5 / 5 rad are slack
        (NAN, math.atan2(4, 3) + 0.14, 0, None),
        (NAN, math.pi / 2, 1, None),  # beyond the reach of 8 m
    ],
)
def test_a_range_or_a_bearing_alone_finds_what_it_fits(
    distance: float, bearing: float, feature: int, found: int | None
) -> None:
    seen = sighting(distance, bearing, feature)
    assert landmarks().in_view(seen, np.zeros(3), 0.5, 8.0) == found


def test_of_two_that_fit_none_is_found() -> None:
    made = landmarks()
    made.see(made.new(np.array([4.0, 3.0])), 5.0, np.array([0.0, -2.0]))
    assert made.in_view(sighting(5.0, NAN), np.zeros(3), 0.5, 8.0) is None
    assert made.in_view(sighting(NAN, math.atan2(3, 4)), np.zeros(3), 0.1, 8.0) == 2
