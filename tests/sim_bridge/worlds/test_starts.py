"""Starts of a team, by hand."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pytest

from symboslam.sim_bridge.worlds.starts import base, with_starts
from symboslam.sim_bridge.worlds.world import Extent, Start, World, WorldObject

EXTENT = Extent(0, 0, 400, 400)
PLACES = np.array([(200.0, 200.0), (150.0, 150.0), (20.0, 20.0)])


def trees(*places: tuple[float, float]) -> tuple[WorldObject, ...]:
    return tuple(WorldObject(f"t{n}", "Tree", x, y) for n, (x, y) in enumerate(places))


def first(objects: Sequence[WorldObject], places: np.ndarray = PLACES) -> tuple[float, float]:
    start = base(places, np.zeros(len(places)), EXTENT, objects)[0]
    return start.x, start.y


def test_a_team_starts_where_most_objects_are_near() -> None:
    """Five stand at the corner, but the corner is not in the middle half."""
    corner = [(20.0, 20.0 + n) for n in range(5)]
    assert first(trees(*corner, (150, 100), (150, 120), (210, 259))) == (150, 150)
    assert first(trees(*corner, (150, 89), (150, 120), (210, 245), (250, 200))) == (200, 200)


def test_of_equal_places_the_more_central() -> None:
    assert first(()) == (200, 200)
    assert first((), PLACES[::-1]) == (200, 200)


def test_without_a_place_in_the_middle_the_nearest_to_it() -> None:
    assert first(trees((20, 20)), np.array([(20.0, 20.0), (300.5, 200.0)])) == (300.5, 200)


def test_robots_stand_in_a_row_and_look_all_ways() -> None:
    found = base(PLACES[:1], np.array([math.pi / 2]), EXTENT, ())
    assert [start.x for start in found] == [200] * 10
    assert [start.y for start in found] == [200, 206, 194, 212, 188, 218, 182, 224, 176, 230]
    degrees = [math.degrees(start.heading) for start in found]
    assert degrees[:4] == pytest.approx([90, 210, 330, 90], abs=0.01)


def test_a_world_keeps_its_own_starts() -> None:
    world = World("w", EXTENT, trees((100, 100)), starts=(Start(1, 2, 3),))
    assert with_starts(world).starts == (Start(1, 2, 3),)


def test_a_world_without_starts_gets_a_row_on_a_grid() -> None:
    """13 x 13 places, 400 / 13 m apart; that at (138.46, 138.46) is near the only tree."""
    found = with_starts(World("w", EXTENT, trees((110, 110)))).starts
    assert len(found) == 10
    assert math.dist((found[0].x, found[0].y), (110, 110)) < 60
    assert [start.x - found[0].x for start in found[:3]] == pytest.approx([0, 6, -6])
    assert {start.y for start in found} == {found[0].y}
