"""How the landmarks of a mission are classified: settings by hand, and worlds of another seed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from symboslam.engine.classify import classify
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.evaluation import evaluate_pairs
from symboslam.engine.evaluation.metrics import Scores
from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.readers import read_landmarks
from symboslam.reasoning.knowledge import Knowledge
from symboslam.sim_bridge.mission.survey import SCHEME, classify_survey, survey_settings
from symboslam.sim_bridge.search.paper_areas import AREAS
from symboslam.sim_bridge.worlds.generator import world_by_name
from symboslam.sim_bridge.worlds.truth import landmarks_geojson, zones_geojson
from symboslam.sim_bridge.worlds.world import World

HELD_OUT = 100
"""A seed that no figures are reported of."""


@pytest.fixture(scope="module")
def knowledge() -> Knowledge:
    return Knowledge.load()


@pytest.fixture(scope="module")
def worlds() -> list[World]:
    return [world_by_name(name, HELD_OUT) for name in AREAS]


def row_of(xs: list[float], knowledge: Knowledge) -> LandmarkMap:
    """Houses in a row."""
    features = [
        {
            "type": "Feature",
            "geometry": {"type": "Point", "coordinates": [x, 500.0]},
            "properties": {"class": "House"},
        }
        for x in xs
    ]
    head = {"type": "FeatureCollection", "crs_units": "m", "bbox": [0, 0, 1000, 1000]}
    return read_landmarks(head | {"features": features}, knowledge)


def pooled(worlds: list[World], made: Callable[[LandmarkMap], Any], knowledge: Knowledge) -> Scores:
    pairs = [
        (zones_geojson(w), made(read_landmarks(landmarks_geojson(w), knowledge))) for w in worlds
    ]
    return evaluate_pairs(pairs, cells=24, knowledge=knowledge).result.all


def test_sparse_landmarks_speak_for_more_ground(knowledge: Knowledge) -> None:
    sparse = row_of([100, 200, 300, 400, 500, 600], knowledge)
    # The fifth neighbours are 500, 400, 300, 300, 400, 500 m away.
    assert survey_settings(sparse, knowledge, "grid") == {"bandwidth": 400.0}
    assert classify_survey(sparse, knowledge, "grid").config["bandwidth"] == 400.0
    assert survey_settings(sparse, knowledge, "branch") == {"a": 0.1}
    assert classify_survey(sparse, knowledge, "branch").config["a"] == 0.1


@pytest.mark.parametrize("xs", [[], [500.0], [500.0] * 8, list(np.arange(100.0, 200.0, 5))])
def test_dense_landmarks_few_and_none_leave_the_ontologys_bandwidth(
    xs: list[float], knowledge: Knowledge
) -> None:
    landmarks = row_of(xs, knowledge)
    assert survey_settings(landmarks, knowledge, "grid") == {}
    found = classify_survey(landmarks, knowledge, "grid")
    assert found.config["bandwidth"] == knowledge.bandwidth(SCHEME)


def test_the_bandwidth_goes_by_the_median_alone(knowledge: Knowledge) -> None:
    """A few landmarks that map building put twice, or far off, do not move it much."""
    good = [100.0 * k for k in range(1, 10)]
    bad = [*good, 100.5, 999.0]
    one, other = (survey_settings(row_of(xs, knowledge), knowledge, "grid") for xs in (good, bad))
    assert other["bandwidth"] == pytest.approx(one["bandwidth"], rel=0.3)


def test_it_helps_in_worlds_of_another_seed(worlds: list[World], knowledge: Knowledge) -> None:
    def default(landmarks: LandmarkMap) -> EnvironmentMap:
        return classify(landmarks, knowledge, scheme=SCHEME)

    before = pooled(worlds, default, knowledge)
    after = pooled(worlds, lambda found: classify_survey(found, knowledge, "grid"), knowledge)
    assert after.mean_iou > before.mean_iou + 0.03
    assert after.mean_ap > before.mean_ap + 0.05
    assert after.accuracy > before.accuracy + 0.03


@pytest.mark.slow
def test_it_helps_the_ranking_of_branches(worlds: list[World], knowledge: Knowledge) -> None:
    def default(landmarks: LandmarkMap) -> EnvironmentMap:
        return classify(landmarks, knowledge, scheme=SCHEME, segmentation="branch")

    before = pooled(worlds, default, knowledge)
    after = pooled(worlds, lambda found: classify_survey(found, knowledge, "branch"), knowledge)
    assert after.mean_ap > before.mean_ap + 0.02
    assert after.mean_iou > before.mean_iou - 0.03
