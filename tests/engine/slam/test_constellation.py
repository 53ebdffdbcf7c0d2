"""match: constellations are found wherever they lie, whole, once, and only if nothing rivals."""

import math
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symboslam.engine.slam.beliefs import ClassBeliefs
from symboslam.engine.slam.constellation import Match, Placing, Things, match
from symboslam.engine.slam.log import Floats
from symboslam.engine.slam.planar import place

SPACING = 10.0
BELIEFS = ClassBeliefs(np.eye(6))


def things(xy: Any, feature: Any) -> Things:
    evidence = [5 * BELIEFS.likelihood(int(f), 0.9) for f in feature]
    return Things(np.asarray(xy, float), np.array(evidence))


def found(
    here: Things, there: Things, variance: float = math.inf, heading: float = math.pi, **more: Any
) -> list[Match]:
    n = len(here.xy)
    alike = BELIEFS.alike(here.evidence, there.evidence)
    placing = Placing(np.full(n, variance), heading)
    return match(here, there, alike, placing, np.full((n, n), 0.2), SPACING, **more)


def pairs(matches: list[Match]) -> list[list[tuple[int, int]]]:
    return [sorted(zip(m.here.tolist(), m.there.tolist(), strict=True)) for m in matches]


def world(seed: int, size: int, classes: int = 6) -> tuple[Floats, Any]:
    rng = np.random.default_rng(seed)
    return rng.uniform(0, 40, (size, 2)), rng.integers(0, classes, size)


@settings(deadline=None)
@given(st.integers(0, 1000), st.floats(-3, 3), st.floats(-500, 500), st.floats(-500, 500))
def test_free_placing_does_not_ask_where_things_lie(
    seed: int, angle: float, x: float, y: float
) -> None:
    xy, feature = world(seed, 12)
    near = np.hypot(*(xy - xy[0]).T).argsort()[:5]
    there = things(xy, feature)
    plain = found(things(xy[near], feature[near]), there)
    moved = found(things(place((x, y, angle), xy[near]), feature[near]), there)
    assert pairs(plain) == pairs(moved)
    assert [m.odds for m in plain] == pytest.approx([m.odds for m in moved], abs=1e-3)


@settings(deadline=None)
@given(st.integers(0, 1000), st.integers(1, 3), st.sampled_from([math.inf, 100.0, 1.0]))
def test_no_thing_is_in_two_matches_nor_twice_in_one(
    seed: int, classes: int, variance: float
) -> None:
    xy, feature = world(seed, 9, classes)
    heading = math.pi if variance == math.inf else 0.1
    matches = found(things(xy[:6], feature[:6]), things(xy[3:], feature[3:]), variance, heading)
    for said in ([m.here.tolist() for m in matches], [m.there.tolist() for m in matches]):
        every = [n for each in said for n in each]
        assert len(every) == len(set(every))
    assert all(m.odds > 0 and m.margin <= m.odds for m in matches)


def test_a_constellation_is_found_whole_and_surely() -> None:
    xy = np.array([[0, 0], [9, 1], [3, 12], [-8, 5.0]])
    there = things(np.vstack([xy, [[60, 60], [75, 40]]]), [0, 1, 2, 3, 4, 5])
    (first, *_) = found(things(place((5, 5, 1), xy), [0, 1, 2, 3]), there)
    assert pairs([first]) == [[(0, 0), (1, 1), (2, 2), (3, 3)]]
    assert first.odds > 7
    assert first.margin == first.odds


def test_of_two_places_that_look_the_same_none_is_believed() -> None:
    xy = np.array([[0, 0], [9, 1], [3, 12.0]])
    there = things(np.vstack([xy, xy + 100]), [0, 1, 2, 0, 1, 2])
    assert found(things(xy, [0, 1, 2]), there) == []


def test_where_it_is_expected_decides_between_them() -> None:
    xy = np.array([[0, 0], [9, 1], [3, 12.0]])
    there = things(np.vstack([xy, xy + 100]), [0, 1, 2, 0, 1, 2])
    (first, *_) = found(things(xy + 0.3, [0, 1, 2]), there, variance=1.0, heading=0.05)
    assert pairs([first]) == [[(0, 0), (1, 1), (2, 2)]]
    assert first.margin > 2.3


def test_a_rotation_that_cannot_be_is_no_match() -> None:
    xy = np.array([[0, 0], [9, 1], [3, 12.0]])
    turned = things(place((0, 0, 1.0), xy), [0, 1, 2])
    matches = found(turned, things(xy, [0, 1, 2]), variance=100.0, heading=0.05)
    assert max((len(m.here) for m in matches), default=0) < 3


def test_other_distances_do_not_agree() -> None:
    here, there = things([[0, 0], [10, 0]], [0, 1]), things([[0, 0], [20, 0]], [0, 1])
    assert max((len(m.here) for m in found(here, there)), default=0) < 2


def test_what_is_not_allowed_is_not_matched() -> None:
    xy = np.array([[0, 0], [9, 1], [3, 12.0]])
    here = things(xy, [0, 1, 2])
    allowed = np.ones((3, 3), bool)
    allowed[1, 1] = False
    for each in pairs(found(here, here, 1.0, 0.05, allowed=allowed)):
        assert (1, 1) not in each
    assert found(here, here, 1.0, 0.05, allowed=np.zeros((3, 3), bool)) == []
