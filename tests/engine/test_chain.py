"""Chains: zones below and groups above environment types, and that every level sums."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symboslam.engine.chain import Zoning
from symboslam.engine.classify import classify
from symboslam.reasoning.knowledge import Environment, EnvironmentGroup, Knowledge

BASE = "https://example.org/small#"
# SP(zone, feature): a house says flat as strongly as home, and tower a third as strongly.
ZONES = {"House": {"Flat": 0.9, "Tower": 0.3}, "Shop": {}, "Tree": {"Flat": 0.15}, "Ground": {}}


@pytest.fixture
def chained(knowledge: Knowledge) -> Knowledge:
    """The small world, in which Home has the zones Flat and Tower, and Work the zone Yard."""
    names = ("Flat", "Tower", "Yard")
    path = np.array([[ZONES[f.name].get(z, 0.0) for z in names] for f in knowledge.features])
    table = Knowledge(
        environments=tuple(Environment(BASE + n, n, n.lower()) for n in names),
        features=knowledge.features,
        indications=(),
        proximities={"path": path},
        schemes={"Home": ("Flat", "Tower"), "Work": ("Yard",)},
    )
    group = EnvironmentGroup(BASE + "Built", "Built", "built", members=("Home", "Work"))
    return replace(knowledge, zones=table, groups=(group,))


def shares_of(knowledge: Knowledge, parts: list[list[float]], ground: float = 0.0) -> Any:
    """The shares of House, Shop, Tree with these parts of P~ for Home, Work and Open."""
    each = np.array(parts)
    return Zoning(knowledge, None).shares(
        np.arange(len(each)), each, each.sum(0) + np.array([0.0, 0.0, ground])
    )


def test_shares_by_hand(chained: Knowledge) -> None:
    # House 2.0: 2.0 to Flat, 2.0 * 0.3 / 0.9 to Tower; Tree 0.6: 0.6 * 0.15 / 0.3 = 0.3 to Flat.
    found = shares_of(chained, [[2.0, 0, 0], [0.1, 1.0, 0], [0.6, 0, 0.6]])
    assert found["Home"] == pytest.approx(
        {"Flat": 2.3 / (2.3 + 2 / 3), "Tower": (2 / 3) / (2.3 + 2 / 3)}
    )
    assert found["Work"] == {"Yard": 1.0}  # the only zone
    assert "Open" not in found  # it has none


def test_a_minority_does_not_tell_zones_apart(chained: Knowledge) -> None:
    assert shares_of(chained, [[1.0, 0, 0], [1.01, 0, 0]])["Home"] is None
    assert shares_of(chained, [[1.0, 0, 0], [0.99, 0, 0]])["Home"] is not None
    assert shares_of(chained, [[0.0, 0, 0], [1.0, 1.0, 0]])["Home"] is None


def test_equal_zones_are_not_told_apart(chained: Knowledge) -> None:
    assert chained.zones is not None
    level = {"path": np.where(chained.zones.proximities["path"] > 0, 0.3, 0.0)}
    even = replace(chained, zones=replace(chained.zones, proximities=level))
    assert shares_of(even, [[1.0, 0, 0]])["Home"] is None


def test_chain_of_a_map_by_hand(chained: Knowledge, landmarks_at: Any) -> None:
    town = landmarks_at([("House", 60, 60), ("Shop", 180, 180)])
    found = classify(town, chained, bandwidth=40, cells=2, absence=0.1, dissimilarity=0.0)
    told = found.explain("1-0-0") if "1-0-0" in found.segment_id else found.explain("0-0-0")
    p, chain = told.probabilities, told.chain
    assert chain is not None
    assert chain.groups == pytest.approx({"Built": p["Home"] + p["Work"], "Open": p["Open"]})
    assert chain.zones["Home"] == pytest.approx({"Flat": p["Home"] * 0.75, "Tower": p["Home"] / 4})
    assert chain.zone_of("Home") == "Flat"
    assert chain.zone_of("Open") is None


def test_without_zones_and_groups_there_is_no_chain(
    knowledge: Knowledge, landmarks_at: Any
) -> None:
    found = classify(landmarks_at([("House", 60, 60)]), knowledge, bandwidth=40, cells=2)
    assert all(found.explain(str(name)).chain is None for name in found.segment_id)


@pytest.mark.parametrize("profile", ["default", "paper"])
@settings(max_examples=15, deadline=None)
@given(
    rows=st.lists(
        st.tuples(
            st.sampled_from(
                ["House", "Apartment", "ClothesShop", "Hotel", "Tree", "Factory", "Barn"]
            ),
            st.floats(0, 240),
            st.floats(0, 240),
            st.floats(0.1, 1.0),
        ),
        min_size=1,
        max_size=25,
    )
)
def test_every_level_sums(profile: str, rows: list[Any], bundled: Knowledge, area: Any) -> None:
    found = classify(area(rows), bundled, profile=profile, cells=6)
    for name in found.segment_id:
        told = found.explain(str(name))
        if told.environment is None:
            assert told.chain is None
            continue
        assert told.chain is not None
        assert sum(told.chain.groups.values()) == pytest.approx(1, abs=1e-12)
        urban = sum(p for e, p in told.probabilities.items() if e != "NonUrban")
        assert told.chain.groups.get("Urban", 0.0) == pytest.approx(urban, abs=1e-12)
        for environment, zones in told.chain.zones.items():
            assert sum(zones.values()) == pytest.approx(told.probabilities[environment], abs=1e-12)
            assert all(p > 0 for p in zones.values())
        assert not set(told.chain.untold) & set(told.chain.zones)


def test_bundled_zones_never_outdo_their_environment(bundled: Knowledge) -> None:
    """A zone's indication is a step further from the environment than the feature's own."""
    assert bundled.zones is not None
    assert len(bundled.zones.environments) == 23
    whole = {z.name: e.name for e in bundled.environments for z in e.zones}
    for way in bundled.zones.indications:
        of_all = bundled.find_indication(way.feature, whole[way.environment])
        assert of_all is not None
        assert way.proximity <= of_all.proximity * 2
        assert of_all.steps == 0 or "zones.ttl" not in of_all.stands


def test_groups_of_the_bundled_ontology(bundled: Knowledge) -> None:
    (urban,) = bundled.groups
    assert urban.name == "Urban"
    assert set(urban.members) == {e.name for e in bundled.environments} - {"NonUrban"}
