"""LiveMap: after any change it is what classify makes of all landmarks."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from symboslam.engine.classify import classify
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.frame import Frame
from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.live import LiveMap
from symboslam.engine.table import Landmark
from symboslam.reasoning.knowledge import Knowledge


@pytest.fixture(scope="module")
def bundled() -> Knowledge:
    return Knowledge.load()


SIDE = 1200.0
NAMES = ("House", "Factory", "Skyscraper", "Tree", "Silo", "Bench", "Warehouse", "Apartment")


def area(surveyed: Any = None) -> LandmarkMap:
    empty = np.zeros(0)
    return LandmarkMap(
        feature=empty.astype(np.int32), x=empty, y=empty, confidence=empty,
        static=empty.astype(bool), id=empty.astype(str), frame=Frame.metric(),
        bbox=(0.0, 0.0, SIDE, SIDE), surveyed=surveyed,
    )  # fmt: skip


def same(live: LiveMap, knowledge: Knowledge, told: dict[str, tuple[Any, ...]]) -> None:
    whole = classify(live.landmarks(), knowledge, **live.config)
    assert {**rows(whole)}.keys() == told.keys()
    for name, (label, probability, count) in rows(whole).items():
        assert told[name][1] == pytest.approx(probability, abs=1e-9), name
        assert told[name][2] == count, name
        ties = np.sort(probability)[-2:]
        assert told[name][0] == label or np.ptp(ties) < 1e-9


def rows(m: EnvironmentMap) -> dict[str, tuple[Any, ...]]:
    return {
        name: (int(m.label[i]), m.probability[i], int(m.landmark_count[i]))
        for i, name in enumerate(m.segment_id.tolist())
    }


def follow(live: LiveMap, told: dict[str, tuple[Any, ...]]) -> None:
    """What somebody knows who hears of changes only."""
    change = live.catch_up()
    if change is None:
        return
    if change.changed is None:
        assert not change.gone
        return
    for name in change.gone:
        del told[name]
    told.update(rows(change.changed))
    known = [i for i in range(len(change.changed)) if change.changed.label[i] >= 0]
    for i, parts in zip(known, change.changed.contributions(known), strict=True):
        total = parts.total / parts.total.sum()
        assert total == pytest.approx(change.changed.probability[i], abs=1e-9)


positions = st.floats(0, SIDE, allow_nan=False)
steps = st.lists(
    st.lists(
        st.tuples(st.integers(0, 30), st.sampled_from(NAMES), positions, positions,
                  st.sampled_from([0.2, 0.9, 1.0]), st.booleans()),
        min_size=1, max_size=12,
    ),
    min_size=1, max_size=6,
)  # fmt: skip


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"profile": "paper"},
        {"profile": "paper", "empty": "unknown"},
        {"dissimilarity": 0.0, "absence": 0.0},
        {"cells": 12, "bandwidth": 90.0, "threshold": 0.6},
    ],
)
@settings(max_examples=25, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(changes=steps)
def test_the_same_as_at_one_go(
    bundled: Knowledge, options: dict[str, Any], changes: list[Any]
) -> None:
    knowledge = bundled
    live = LiveMap(area(), knowledge, **options)
    told = rows(live.environment_map())
    for step in changes:
        for number, name, x, y, confidence, keep in step:
            if keep:
                feature = knowledge.index_of(name)
                assert feature is not None
                live.table.put(Landmark(str(number), feature, x, y, confidence))
            else:
                live.table.remove(str(number))
        follow(live, told)
        same(live, knowledge, told)


def test_a_map_made_anew_takes_over_the_estimate_of_absence(bundled: Knowledge) -> None:
    """Else its probabilities would change when the service is started again."""
    chance = np.random.default_rng(3)
    kept = LiveMap(area(), bundled)
    for n in range(60):
        feature = bundled.index_of(NAMES[n % 3])
        assert feature is not None
        x, y = (float(v) for v in chance.uniform(1, SIDE - 1, 2))
        kept.table.put(Landmark(f"L{n}", feature, x, y, 0.9, None, None, 1, 0.9))
        kept.catch_up()
    anew = LiveMap(area(), bundled)
    for row in kept.table.rows().tolist():
        anew.table.put(kept.table[row])
    anew.catch_up()
    assert anew.config["absence"] != kept.config["absence"], "this shows nothing"
    anew.resume(kept.config["absence"])
    assert anew.config == kept.config
    before, after = rows(kept.segments()), rows(anew.segments())
    assert before.keys() == after.keys()
    for name, (_, probability, count) in before.items():
        assert after[name][1] == pytest.approx(probability, abs=1e-9)
        assert after[name][2] == count
