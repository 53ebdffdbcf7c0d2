"""Leash: when a robot goes back, where to, and when it is free again; by hand."""

from __future__ import annotations

from symboslam.sim_bridge.mission.leash import CREDIT, LONG, SHARE, SHORT, THERE, Leash


def driven(*way: tuple[float, float]) -> Leash:
    """A leash after a drive along x: places and deviations, none of which pulls."""
    found = Leash(10.0)
    for x, sigma in way:
        assert found.pull(0, (x, 0), sigma) is None
    return found


def test_a_robot_that_knows_where_it_is_is_free() -> None:
    leash = driven((0, 0), (100, 5), (200, 10), (300, 20))
    assert LONG == 20
    assert leash.pull(0, (300, 0), 20.1) == (0, 0)


def test_only_what_was_much_better_known_is_gone_back_to() -> None:
    """30 m are worth a metre: (100, 0) costs 7 + 1, (0, 0) costs 10.3, (280, 0) is no better."""
    leash = driven((0, 0), (100, 1), (280, 8))
    assert leash.pull(0, (310, 0), 25) == (100, 0)


def test_it_is_free_again_once_it_knows_nearly_as_well_as_then() -> None:
    leash = driven((0, 0), (100, 1), (280, 8))
    assert leash.pull(0, (310, 0), 25) == (100, 0)
    assert leash.pull(0, (200, 0), 24) == (100, 0)
    assert leash.pull(0, (200, 0), 1 + SHORT) == (100, 0)
    assert leash.pull(0, (200, 0), 1 + SHORT - 0.1) is None
    assert leash.goal is None


def test_where_arriving_does_not_help_the_next_place_is_tried() -> None:
    leash = driven((0, 0), (100, 1))
    assert leash.pull(0, (310, 0), 25) == (100, 0)
    assert leash.pull(0, (100 + THERE, 0), 25) == (100, 0)
    assert leash.pull(0, (99 + THERE, 0), 25) == (0, 0)
    assert leash.pull(0, (THERE - 1, 0), 25) is None  # no place helped: it goes on


def test_places_close_to_the_last_are_not_kept() -> None:
    """(119, 0) was known well, but is 19 m from (100, 0)."""
    leash = driven((0, 19), (100, 19), (119, 0))
    assert leash.pull(0, (200, 0), 38) is None
    assert leash.pull(0, (200, 0), 40) == (100, 0)


def test_ways_back_take_a_share_of_the_time_at_most() -> None:
    """At 10 m/s the credit is 1,200 m; each second adds 2 m."""
    assert (SHARE, CREDIT) == (0.2, 120)
    assert driven((0, 0)).pull(0, (1201, 0), 25) is None
    assert driven((0, 0)).pull(0, (1199, 0), 25) == (0, 0)
    assert driven((0, 0)).pull(100, (1399, 0), 25) == (0, 0)
    leash = driven((0, 0))
    assert leash.pull(100, (900, 0), 30) == (0, 0)
    assert leash.pull(190, (THERE - 1, 0), 25) is None  # 90 of 158 s are spent: 68 are left
    assert leash.pull(200, (735, 0), 46) is None  # (24, 0) is 711 m away
    assert leash.pull(200, (720, 0), 46) == (24, 0)
