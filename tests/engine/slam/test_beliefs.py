"""ClassBeliefs: hand-computed likelihoods and posteriors, and what holds for any."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symboslam.engine.slam.beliefs import SUREST, ClassBeliefs

LOGS = st.lists(st.floats(-200, 0), min_size=4, max_size=4)


def test_a_sighting_is_of_its_class_with_its_confidence_and_the_rest_is_spread() -> None:
    found = np.exp(ClassBeliefs(np.eye(3)).likelihood(0, 0.8))
    assert found == pytest.approx([0.8, 0.1, 0.1])


def test_classes_that_are_alike_are_mistaken_more_often() -> None:
    similarity = np.eye(3)
    similarity[0, 1] = similarity[1, 0] = 1.0
    found = np.exp(ClassBeliefs(similarity).likelihood(1, 0.8))
    assert found == pytest.approx([0.2 * 1.05 / 1.1, 0.8, 0.2 * 0.05 / 0.10])


def test_confidence_is_kept_between_a_guess_and_the_surest() -> None:
    beliefs = ClassBeliefs(np.eye(4))
    assert np.exp(beliefs.likelihood(2, 0.01)) == pytest.approx([0.25] * 4)
    assert np.exp(beliefs.likelihood(2, 1.0))[2] == pytest.approx(SUREST)


def test_one_class_alone_is_certain() -> None:
    beliefs = ClassBeliefs(np.eye(1))
    assert beliefs.likelihood(0, 0.3).tolist() == [0.0]
    assert beliefs.posterior(np.zeros(1)).tolist() == [1.0]


def test_without_evidence_classes_are_as_frequent_as_learnt() -> None:
    beliefs = ClassBeliefs(np.eye(3))
    assert beliefs.posterior(np.zeros(3)) == pytest.approx([1 / 3] * 3)
    beliefs.learn(np.array([0, 0, 1]))
    assert beliefs.posterior(np.zeros(3)) == pytest.approx([2.5 / 4.5, 1.5 / 4.5, 0.5 / 4.5])


def test_two_sightings_of_a_class_make_things_alike_and_of_two_classes_unlike() -> None:
    beliefs = ClassBeliefs(np.eye(3))
    one, other = beliefs.likelihood(0, 0.8)[None], beliefs.likelihood(1, 0.8)[None]
    assert beliefs.alike(one, one)[0, 0] == pytest.approx(np.log(3 * (0.64 + 0.01 + 0.01)))
    assert beliefs.alike(one, other)[0, 0] == pytest.approx(np.log(3 * (0.08 + 0.08 + 0.01)))


@given(LOGS, st.lists(st.integers(0, 3), max_size=20))
def test_posteriors_sum_to_one(evidence: list[float], learnt: list[int]) -> None:
    beliefs = ClassBeliefs(np.eye(4))
    beliefs.learn(np.array(learnt, np.int64))
    found = beliefs.posterior(np.array([evidence, evidence]))
    assert found.sum(1) == pytest.approx([1, 1])
    assert (found >= 0).all()


@given(LOGS, LOGS)
def test_to_be_alike_is_mutual(one: list[float], other: list[float]) -> None:
    beliefs = ClassBeliefs(np.eye(4))
    a, b = np.array([one]), np.array([other])
    assert beliefs.alike(a, b)[0, 0] == pytest.approx(beliefs.alike(b, a)[0, 0])


@given(st.integers(0, 3), st.floats(0.001, 1))
def test_a_sighting_never_speaks_against_its_own_class(feature: int, confidence: float) -> None:
    beliefs = ClassBeliefs(np.eye(4))
    found = beliefs.posterior(beliefs.likelihood(feature, confidence))
    assert found[feature] >= 0.25 - 1e-9
