"""Sightings: what is one landmark, and where it lies then."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symboslam.engine.grid import Grid
from symboslam.engine.sightings import Sightings
from symboslam.engine.table import Landmark, LandmarkTable
from symboslam.reasoning.knowledge import Knowledge

HOUSE, TREE = 0, 1
EARLY, LATE = "2026-01-01T12:00:00+00:00", "2026-01-01T12:30:00+02:00"  # LATE is the earlier one


@pytest.fixture
def table() -> LandmarkTable:
    return LandmarkTable(Knowledge.load(), Grid((0.0, 0.0, 100.0, 100.0), 24))


def seen(feature: int, x: float, y: float, confidence: float = 1.0, **rest: Any) -> Landmark:
    return Landmark("", feature, x, y, confidence, **rest)


def test_the_mean_by_confidence(table: LandmarkTable) -> None:
    merge = Sightings(table, 5.0)
    merge.observe(seen(HOUSE, 10, 10, 0.25))
    found = merge.observe(seen(HOUSE, 14, 10, 0.75))
    assert (found.x, found.y) == (13.0, 10.0)
    assert (found.confidence, found.count, found.weight) == (0.75, 2, 1.0)
    assert len(table) == 1


def test_apart_by_class_and_by_distance(table: LandmarkTable) -> None:
    merge = Sightings(table, 5.0)
    one, other = merge.observe(seen(HOUSE, 10, 10)), merge.observe(seen(TREE, 10, 10))
    far, at_the_radius = merge.observe(seen(HOUSE, 15.1, 10)), merge.observe(seen(TREE, 15, 10))
    assert len({one.id, other.id, far.id}) == 3
    assert at_the_radius.id == other.id


def test_the_nearest_one(table: LandmarkTable) -> None:
    merge = Sightings(table, 5.0)
    merge.observe(seen(HOUSE, 10, 10))
    near = merge.observe(seen(HOUSE, 17, 10))
    assert merge.observe(seen(HOUSE, 13.6, 10)).id == near.id


def test_what_an_agent_calls_it(table: LandmarkTable) -> None:
    merge = Sightings(table, 5.0)
    one = merge.observe(seen(HOUSE, 10, 10, agent="a"), "7")
    moved = merge.observe(seen(HOUSE, 90, 90, agent="a"), "7")
    theirs = merge.observe(seen(HOUSE, 50, 10, agent="b"), "7")
    other_class = merge.observe(seen(TREE, 50, 90, agent="a"), "7")
    assert one.id == moved.id == "7"
    assert (moved.x, moved.y) == (50.0, 50.0)
    assert theirs.id == "b/7"
    assert other_class.id == "a/7"


def test_an_id_without_an_agent_is_no_identity(table: LandmarkTable) -> None:
    merge = Sightings(table, 5.0)
    one = merge.observe(seen(HOUSE, 10, 10), "1")
    far = merge.observe(seen(HOUSE, 90, 90), "1")
    near = merge.observe(seen(HOUSE, 12, 10), "2")
    owned = merge.observe(seen(HOUSE, 50, 50, agent="a"), "1")
    assert (one.id, far.id, near.id, owned.id) == ("1", "L1", "1", "a/1")
    assert (far.x, far.y, far.count) == (90.0, 90.0, 1)
    assert (near.x, near.count) == (11.0, 2)
    assert merge.names == {("a", "1"): "a/1"}


def test_names_without_an_agent_that_were_kept_count_no_more(table: LandmarkTable) -> None:
    first = Sightings(table, 5.0)
    one = first.observe(seen(HOUSE, 10, 10), "1")
    again = Sightings(table, 5.0, {("", "1"): one.id})
    assert again.observe(seen(HOUSE, 90, 90), "1").id != one.id


def test_the_last_observation_is_the_latest(table: LandmarkTable) -> None:
    merge = Sightings(table, 5.0)
    merge.observe(seen(HOUSE, 10, 10, time=EARLY, agent="a"))
    found = merge.observe(seen(HOUSE, 10, 10, time=LATE, agent="b"))
    assert (found.time, found.agent) == (EARLY, "a")
    assert merge.observe(seen(HOUSE, 10, 10, agent="c")).agent == "a"


def test_goes_on_where_another_stopped(table: LandmarkTable) -> None:
    first = Sightings(table, 5.0)
    first.observe(seen(HOUSE, 10, 10, agent="a"), "7")
    again = Sightings(table, 5.0, dict(first.names))
    assert again.observe(seen(HOUSE, 12, 10)).count == 2
    assert again.observe(seen(HOUSE, 99, 10, agent="a"), "7").count == 3


places = st.tuples(st.sampled_from([HOUSE, TREE]), st.floats(0, 100), st.floats(0, 100))


@given(st.lists(places, max_size=60))
def test_none_is_lost(observations: list[tuple[int, float, float]]) -> None:
    table = LandmarkTable(Knowledge.load(), Grid((0.0, 0.0, 100.0, 100.0), 24))
    merge = Sightings(table, 8.0)
    for feature, x, y in observations:
        merge.observe(seen(feature, x, y, 0.5))
    rows = table.rows()
    assert sum(table[int(r)].count for r in rows) == len(observations)
    for feature in (HOUSE, TREE):
        mine = [table[int(r)] for r in rows if table[int(r)].feature == feature]
        total = np.sum([(p.x * p.count, p.y * p.count) for p in mine], 0) if mine else np.zeros(2)
        theirs = np.sum([(x, y) for f, x, y in observations if f == feature] or [(0, 0)], 0)
        assert total == pytest.approx(theirs)
