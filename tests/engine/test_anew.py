"""Counterfactuals of fragments: what is told holds on the landmarks changed and classified anew."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely

from symboslam.engine import anew
from symboslam.engine.account import full_account
from symboslam.engine.changes import MOST, Counterfactual, applied
from symboslam.engine.classify import classify
from symboslam.engine.counterfactual import counterfactuals, without
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.wording import text_of
from symboslam.reasoning.knowledge import Knowledge

KINDS = ["House", "Apartment", "ClothesShop", "Hotel", "Factory", "Warehouse"]


@pytest.fixture(scope="module")
def quarters(bundled: Knowledge, area: Any) -> EnvironmentMap:
    """Nine quarters of one kind each among some strangers."""
    rng = np.random.default_rng(5)
    xy = rng.uniform(0, 240, (260, 2))
    quarter = (xy // 80).astype(int) @ (1, 3)
    kind = np.where(rng.uniform(size=260) < 0.25, rng.integers(0, 6, 260), quarter % 6)
    rows = [(KINDS[k], x, y, 1.0) for k, (x, y) in zip(kind.tolist(), xy.tolist(), strict=True)]
    return classify(area(rows), bundled, segmentation="branch")


def there(found: EnvironmentMap, change: Counterfactual, middle: Any) -> tuple[str | None, float]:
    """What the ground around a place is after a change, and how sure that is."""
    again = classify(applied(found, change), found.knowledge, **dict(found.config))
    i = int(np.flatnonzero(shapely.intersects(again.geometry, middle))[-1])
    return again.name_of(i), float(again.probability[i].max())


def test_changes_of_fragments_hold_when_they_are_applied(quarters: EnvironmentMap) -> None:
    fewer = more = 0
    for i in np.flatnonzero(quarters.label >= 0)[:12].tolist():
        middle = shapely.point_on_surface(quarters.geometry[i])
        for change in counterfactuals(quarters, str(quarters.segment_id[i])):
            assert change.anew
            # Of larger sets it was proved for the fragment as it is, at most.
            assert change.minimal == (len(change.removed) + change.count == 1)
            name, p = there(quarters, change, middle)
            assert name == change.environment
            assert p == pytest.approx(change.probability, abs=1e-12)
            assert name != quarters.name_of(i)
            fewer, more = fewer + bool(change.removed), more + (change.added is not None)
            assert max(len(change.removed), change.count) <= MOST
    assert fewer >= 3
    assert more >= 6


def test_they_lead_to_what_is_wanted(quarters: EnvironmentMap) -> None:
    seen = 0
    for i in np.flatnonzero(quarters.label >= 0)[:8].tolist():
        wanted = "Industrial" if quarters.name_of(i) != "Industrial" else "Residential"
        for change in counterfactuals(quarters, str(quarters.segment_id[i]), against=wanted):
            seen += 1
            assert change.environment == wanted
    assert seen >= 3


def test_on_a_map_too_large_to_be_cut_anew_that_is_said(
    quarters: EnvironmentMap, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(anew, "LANDMARKS", 100)
    told = fewer = 0
    for i in np.flatnonzero(quarters.label >= 0)[:6].tolist():
        name = str(quarters.segment_id[i])
        found = counterfactuals(quarters, name)
        assert not any(change.anew or change.minimal for change in found)
        for change in (c for c in found if c.removed):
            p = without(quarters, name, list(change.removed))
            best = max(p, key=p.__getitem__) if any(p.values()) else None
            assert best == change.environment != quarters.name_of(i)
            fewer += 1
        words = text_of(full_account(quarters, name, counterfactual=True), "full")
        assert words.count("if the segment's outline stays as it is") == len(found)
        assert "P without one: of the fragment otherwise as it is" in words
        told += len(found)
    assert fewer >= 3
    assert told > fewer
