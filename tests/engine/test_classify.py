"""classify: from landmarks to an explained map."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from shapely.geometry import box

from symboslam.engine.classify import classify
from symboslam.engine.counterfactual import without
from symboslam.errors import InputError, UnknownNameError
from symboslam.reasoning.knowledge import Knowledge

ROWS = st.lists(
    st.tuples(
        st.sampled_from(["House", "Shop", "Tree"]),
        st.floats(0, 240),
        st.floats(0, 240),
        st.floats(0.1, 1),
    ),
    min_size=1,
    max_size=25,
)
PROFILES = st.sampled_from(["default", "paper"])
CHECKS = settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=40)


@CHECKS
@given(ROWS, PROFILES, st.sampled_from(["inherit", "unknown"]))
def test_probabilities_are_distributions(
    knowledge: Knowledge, landmarks_at: Any, rows: Any, profile: str, empty: str
) -> None:
    found = classify(landmarks_at(rows), knowledge, profile=profile, cells=12, empty=empty)
    sums = found.probability.sum(1)
    known = found.label >= 0
    assert np.allclose(sums[known], 1)
    assert not found.probability[~known].any()
    assert (found.probability >= 0).all()
    assert found.landmark_count.sum() == len(rows)


@CHECKS
@given(ROWS, PROFILES)
def test_reasons_add_up_to_the_probabilities(
    knowledge: Knowledge, landmarks_at: Any, rows: Any, profile: str
) -> None:
    found = classify(landmarks_at(rows), knowledge, profile=profile, cells=6)
    for segment in found.segment_id:
        explanation = found.explain(str(segment))
        for name, p in explanation.probabilities.items():
            total = sum(r.contribution.get(name, 0.0) for r in explanation.reasons)
            assert total == pytest.approx(p, abs=1e-12)


@CHECKS
@given(ROWS, PROFILES, st.data())
def test_deleting_a_landmark_does_what_the_explanation_says(
    knowledge: Knowledge, landmarks_at: Any, rows: Any, profile: str, data: Any
) -> None:
    town = landmarks_at(rows)
    gone = data.draw(st.integers(0, len(rows) - 1))
    found = classify(town, knowledge, profile=profile, cells=3)
    fixed = {"absence": found.config["absence"]} if profile == "default" else {}
    again = classify(town.without(gone), knowledge, profile=profile, cells=3, **fixed)
    for segment in found.segment_id:
        told = without(found, str(segment), [gone])
        i = again.position_of(str(segment))
        assert list(told.values()) == pytest.approx(again.probability[i].tolist(), abs=1e-12)


@CHECKS
@given(ROWS, PROFILES, st.randoms(use_true_random=False))
def test_order_does_not_matter(
    knowledge: Knowledge, landmarks_at: Any, rows: Any, profile: str, random: Any
) -> None:
    shuffled = list(rows)
    random.shuffle(shuffled)
    one = classify(landmarks_at(rows), knowledge, profile=profile, cells=6)
    two = classify(landmarks_at(shuffled), knowledge, profile=profile, cells=6)
    assert one.segment_id.tolist() == two.segment_id.tolist()
    np.testing.assert_allclose(one.probability, two.probability, atol=1e-9)


def test_an_empty_map_of_a_survey_is_open_ground(knowledge: Knowledge, landmarks_at: Any) -> None:
    found = classify(landmarks_at([]), knowledge)
    assert set(found.shares()) == {"Home", "Work", "Open", None}
    assert found.shares()["Open"] == pytest.approx(1)


def test_an_empty_map_is_unknown_in_the_paper_profile(
    knowledge: Knowledge, landmarks_at: Any
) -> None:
    found = classify(landmarks_at([]), knowledge, profile="paper")
    assert found.shares()[None] == pytest.approx(1)
    assert found.explain("0-0-0").reasons == ()
    assert "unknown" in found.tell("0-0-0")


def test_what_was_not_surveyed_is_unknown(knowledge: Knowledge, landmarks_at: Any) -> None:
    from dataclasses import replace

    town = replace(landmarks_at([("House", 30, 30)]), surveyed=box(0, 0, 130, 240))
    found = classify(town, knowledge, cells=24)
    west = [i for i in range(len(found)) if found.geometry[i].centroid.x < 130]
    east = [i for i in range(len(found)) if found.geometry[i].centroid.x > 130]
    assert len(west) > 0
    assert len(east) > 0
    assert all(found.label[i] >= 0 for i in west)
    assert all(found.label[i] < 0 for i in east)
    assert found.shares()[None] == pytest.approx(110 / 240, abs=0.01)


def test_a_bare_cell_inherits_or_stays_unknown(knowledge: Knowledge, landmarks_at: Any) -> None:
    # Houses and shops in the south-west corner split the cell; its other quarters are bare.
    rows = [(kind, x, x) for x in (2, 4, 6, 8) for kind in ("House", "Shop")]
    options: dict[str, Any] = {"profile": "paper", "cells": 6}
    inherited = classify(landmarks_at(rows), knowledge, empty="inherit", **options)
    bare = classify(landmarks_at(rows), knowledge, empty="unknown", **options)
    assert bare.name_of(bare.position_of("1-1-1")) is None
    assert inherited.name_of(inherited.position_of("1-1-1")) is not None
    told = inherited.explain("1-1-1")
    assert sum(r.contribution.get("Home", 0) for r in told.reasons) == pytest.approx(
        told.probabilities["Home"]
    )


def test_the_words_name_winner_and_runner_up(knowledge: Knowledge, landmarks_at: Any) -> None:
    rows = [("House", 50, 50)] * 3 + [("Shop", 60, 60)]
    found = classify(landmarks_at(rows), knowledge, cells=1, absence=0.0, bandwidth=40)
    told = found.tell("0-0-0")
    assert told.startswith("Segment 0-0-0 is Home (P = ")
    assert "3 x house: A house is home." in told
    assert "Why not Work" in told
    assert "1 x shop: A shop is work." in told


@pytest.mark.parametrize(
    "changes",
    [{"a": 0}, {"a": 1}, {"cells": 0}, {"threshold": 2}, {"empty": "maybe"}, {"bandwidth": -1}],
)
def test_settings_out_of_range_are_refused(
    knowledge: Knowledge, landmarks_at: Any, changes: dict[str, Any]
) -> None:
    with pytest.raises(InputError):
        classify(landmarks_at([]), knowledge, **changes)


@pytest.mark.parametrize(
    "changes", [{"profile": "best"}, {"segmentation": "slic"}, {"scheme": "mine"}, {"cels": 3}]
)
def test_unknown_names_are_refused_with_those_that_exist(
    knowledge: Knowledge, landmarks_at: Any, changes: dict[str, Any]
) -> None:
    with pytest.raises(UnknownNameError, match=r"there (are|is)"):
        classify(landmarks_at([]), knowledge, **changes)


def test_an_unknown_segment_is_refused_with_close_ones(
    knowledge: Knowledge, landmarks_at: Any
) -> None:
    found = classify(landmarks_at([]), knowledge)
    with pytest.raises(UnknownNameError, match=r"close: .-.-."):
        found.explain("0-0")
