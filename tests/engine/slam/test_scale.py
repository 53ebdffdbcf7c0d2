"""Scale: spacing of landmarks and the odds that two are one, by hand."""

import math

import numpy as np
import pytest

from symboslam.engine.slam.pose_graph import Sighting
from symboslam.engine.slam.scale import Scale


def seen(reach: float, bearing: float, sigma: float = 0.5) -> Sighting:
    return Sighting(0, 0.0, 0, reach, bearing, sigma, 0.02, 0, 0.9)


def scale(*rows: tuple[float, float]) -> Scale:
    found = Scale()
    for row in rows:
        found.see(seen(*row))
    return found


def test_spacing_is_the_root_of_the_sector_in_view_for_each_thing_in_it() -> None:
    found = scale((10, 0.5), (4, -1.0))
    assert found.reach == 10
    assert found.sigma == 0.5
    assert found.spacing(4) == pytest.approx(math.sqrt(100 * 1.0 * 4 / 2))


def test_nothing_seen_has_a_spacing_of_a_metre() -> None:
    assert Scale().spacing(7) == 1.0


def test_a_view_straight_ahead_is_no_line() -> None:
    assert scale((10, 0.0)).spacing(1) == pytest.approx(math.sqrt(100 * 0.1))


def test_two_robots_together_saw_what_both_saw() -> None:
    one, other, both = scale((10, 0.5)), scale((4, -1.0)), scale((10, 0.5), (4, -1.0))
    one.include(other)
    assert one.spacing(3) == both.spacing(3)
    assert one.reach == 10


def test_the_deviation_of_ranges_is_the_mean_and_of_robots_the_largest() -> None:
    found, other = Scale(), Scale()
    for sigma in (4.0, 1.0, 1.0):
        found.see(seen(5, 0, sigma))
    assert found.sigma == pytest.approx(2)
    other.see(seen(5, 0, 3.0))
    found.include(other)
    assert found.sigma == 3
    found.include(Scale())
    assert found.sigma == 3


def test_never_seen_together_counts_up_to_enough_times_and_only_if_near() -> None:
    found = scale((9, 0.5))
    assert found.unseen(3, 1.0, 1.0) == pytest.approx(1.2)
    assert found.unseen(100, 1.0, 4.4) == pytest.approx(8.0)
    assert found.unseen(100, 3.0, 1.0) == 0.0
    assert found.unseen(100, 1.0, 4.6) == 0.0


def test_odds_that_two_landmarks_are_one() -> None:
    odds = scale((9, 0.5)).same(np.array([0.1, 0.0]), np.eye(2) * 0.01, 1.0, 3, 2.0)
    assert odds == pytest.approx(1.0 - 0.5 - math.log(2 * math.pi * 0.01 / 4) + 1.2)


def test_far_outside_their_covariance_they_are_not_one() -> None:
    found = scale((9, 0.5))
    assert found.same(np.array([0.4, 0.0]), np.eye(2) * 0.01, 9.0, 20, 2.0) == -math.inf
