"""The paper's merging, rule by rule."""

from __future__ import annotations

import time
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symboslam.engine.slam.log import Mission
from symboslam.engine.slam.paper_merge import PaperMerge
from symboslam.engine.slam.paper_rules import Rules
from symboslam.engine.slam.slam_map import MappedLandmarks
from symboslam.errors import InputError

A = 10.0
rows = st.lists(
    st.tuples(
        st.integers(0, 40),
        st.integers(0, 40),
        st.sampled_from(["House", "Cottage", "Tree", "Dog"]),
        st.sampled_from([0.3, 0.6, 0.9]),
    ),
    max_size=25,
)


@pytest.fixture
def merge(mission: Any) -> PaperMerge:
    return PaperMerge(Rules.of(mission(), A))


@pytest.fixture
def batch(marks: Any) -> Any:
    """Landmarks from rows of (x, y, class, confidence), maybe with sightings and covariances."""

    def make(*table: tuple[Any, ...], sightings: Any = None, covariance: Any = None) -> Any:
        from dataclasses import replace

        made = marks([row[:3] for row in table])
        made = replace(made, confidence=np.array([row[3] for row in table], float))
        if sightings is not None:
            made = replace(made, sightings=np.array(sightings, np.int64))
        if covariance is not None:
            made = replace(made, covariance=np.array(covariance, float))
        return made

    return make


def told(found: MappedLandmarks, mission: Mission) -> list[tuple[Any, ...]]:
    names = [mission.classes[f] for f in found.feature]
    return [
        (*np.round(xy, 6).tolist(), name, c)
        for xy, name, c in zip(found.xy, names, found.confidence.tolist(), strict=True)
    ]


def test_similar_ones_within_the_radius_become_one(
    merge: PaperMerge, batch: Any, mission: Any
) -> None:
    merge.add(batch((0, 0, "House", 0.5), (50, 0, "House", 0.5)))
    entries = merge.add(batch((8, 0, "Cottage", 0.7), (50, 9, "House", 0.4), sightings=[3, 1]))
    found = merge.landmarks()
    assert told(found, mission()) == [(6, 0, "Cottage", 0.7), (50, 4.5, "House", 0.5)]
    assert found.sightings.tolist() == [4, 2]
    assert found.id.tolist() == ["L1", "L2"]
    assert merge.landmark_of()[entries].tolist() == [0, 1]


def test_the_nearest_similar_one_wins(merge: PaperMerge, batch: Any, mission: Any) -> None:
    merge.add(batch((0, 0, "House", 0.5), (12, 0, "House", 0.5), (7, 0, "Tree", 0.5)))
    merge.add(batch((7, 0, "House", 0.5)))
    assert told(merge.landmarks(), mission())[1] == (9.5, 0, "House", 0.5)


def test_covariances_weight_the_mean(merge: PaperMerge, batch: Any) -> None:
    merge.add(batch((0, 0, "House", 0.5), covariance=[np.diag([1.0, 3.0])]))
    merge.add(batch((4, 4, "House", 0.5), covariance=[np.diag([3.0, 1.0])]))
    found = merge.landmarks()
    np.testing.assert_allclose(found.xy, [[1, 3]])
    np.testing.assert_allclose(found.covariance, [np.diag([0.75, 0.75])])
    merge.add(batch((5, 3, "House", 0.5), sightings=[2]))  # without a covariance: by sightings
    found = merge.landmarks()
    np.testing.assert_allclose(found.xy, [[3, 3]])
    assert np.isnan(found.covariance).all()


@pytest.mark.parametrize(
    ("x", "confidence", "added"),
    [(5.1, 0.3, True), (5, 0.6, True), (5, 0.5, False), (5, 0.3, False), (0, 0.9, True)],
)
def test_dissimilar_ones_are_added_or_put_aside(
    merge: PaperMerge, batch: Any, x: float, confidence: float, added: bool
) -> None:
    merge.add(batch((0, 0, "House", 0.5)))
    entries = merge.add(batch((x, 0, "Tree", confidence)))
    assert (len(merge.landmarks()), len(merge.aside())) == ((2, 0) if added else (1, 1))
    assert merge.landmark_of()[entries].tolist() == [1 if added else -1]


def test_three_put_aside_replace_what_is_there(merge: PaperMerge, batch: Any, mission: Any) -> None:
    tree = merge.add(batch((0, 0, "Tree", 0.9), (50, 0, "Tree", 0.9)))
    merge.add(batch((3, 0, "House", 0.5)))
    merge.add(batch((0, 3, "Cottage", 0.7)))
    assert (len(merge.landmarks()), len(merge.aside())) == (2, 2)
    last = merge.add(batch((-3, 0, "House", 0.5)))
    assert told(merge.landmarks(), mission()) == [(50, 0, "Tree", 0.9), (0, 1, "Cottage", 0.7)]
    assert told(merge.aside(), mission()) == [(0, 0, "Tree", 0.9)]
    assert merge.landmark_of()[[*tree, *last]].tolist() == [-1, 0, 1]
    assert merge.landmarks().sightings.tolist() == [1, 3]


def test_two_or_far_ones_do_not(merge: PaperMerge, batch: Any) -> None:
    merge.add(batch((0, 0, "Tree", 0.9), (100, 0, "Tree", 0.9)))
    for x in (0, 1, 100, 101):
        merge.add(batch((x, 0, "House", 0.5)))
    assert (len(merge.landmarks()), len(merge.aside())) == (2, 4)


def test_one_batch_is_not_compared_with_itself(merge: PaperMerge, batch: Any) -> None:
    merge.add(batch((0, 0, "House", 0.5), (1, 0, "House", 0.5), (1, 1, "Tree", 0.1)))
    assert len(merge.landmarks()) == 3


def test_what_moves_is_evidence_and_never_merged(merge: PaperMerge, batch: Any) -> None:
    first = merge.add(batch((0, 0, "Dog", 0.5), (0, 0, "House", 0.5)))
    second = merge.add(batch((0, 0, "Dog", 0.9)))
    found = merge.landmarks()
    assert found.dynamic.tolist() == [False, True, True]
    assert merge.landmark_of()[[*first, *second]].tolist() == [1, 0, 2]
    assert len(merge.aside()) == 0


@given(st.lists(rows, max_size=5))
def test_nothing_is_lost(marks_batches: list[Any]) -> None:
    classes = ("House", "Cottage", "Tree", "Dog")
    similarity = np.eye(4)
    similarity[0, 1] = similarity[1, 0] = 0.8
    merge = PaperMerge(Rules(A, similarity, np.array([False, False, False, True])))
    total, dogs = 0, 0
    for table in marks_batches:
        n = len(table)
        feature = np.array([classes.index(row[2]) for row in table], np.int64)
        merge.add(
            MappedLandmarks(
                id=np.full(n, "", object),
                xy=np.array([row[:2] for row in table], float).reshape(n, 2),
                covariance=np.full((n, 2, 2), np.nan),
                feature=feature,
                confidence=np.array([row[3] for row in table], float),
                sightings=np.ones(n, np.int64),
                dynamic=feature == 3,
                key=np.full(n, "", object),
            )
        )
        total, dogs = total + n, dogs + int((feature == 3).sum())
    found, aside, of = merge.landmarks(), merge.aside(), merge.landmark_of()
    assert found.sightings.sum() + aside.sightings.sum() == total == len(of)
    assert found.dynamic.sum() == dogs
    assert np.bincount(of[of >= 0], minlength=len(found)).tolist() == found.sightings.tolist()
    assert len(set(found.id)) == len(found)
    near = np.hypot(*(aside.xy[:, None] - aside.xy[None]).T) <= A
    house = aside.feature < 2
    alike = house[:, None] & house[None] | (aside.feature[:, None] == aside.feature[None])
    assert ((near & alike).sum(1) < 3).all()


def test_ten_thousand_landmarks_take_less_than_two_seconds(mission: Any, batch: Any) -> None:
    rng = np.random.default_rng(1)
    merge = PaperMerge(Rules.of(mission(), A))
    names = np.array(["House", "Cottage", "Tree", "Dog"])
    xy = rng.uniform(0, 6000, (5000, 2))
    kind = names[rng.integers(0, 4, 5000)]
    batches = []
    for _ in range(2):
        confidence = rng.uniform(0.1, 1, 5000)
        place = xy + rng.normal(0, 2, xy.shape)
        batches.append(batch(*zip(*place.T, kind, confidence, strict=True)))
    began = time.process_time()
    for one in batches:
        merge.add(one)
    assert 3000 < len(merge.landmarks()) < 7000
    assert time.process_time() - began < 2


@pytest.mark.parametrize(("radius", "least"), [(0, 0.5), (np.nan, 0.5), (1, 0), (1, 1.1)])
def test_rules_are_checked(mission: Any, radius: float, least: float) -> None:
    with pytest.raises(InputError, match=r"radius of merging is|similarity is"):
        Rules.of(mission(), radius, least)
