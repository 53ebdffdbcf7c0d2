"""Proximities and importances of the town, against values worked out by hand.

Features, by depth: Feature 1; Static, Dynamic 2; Building, Tower, Car 3; House 4; Cottage 5.
Places, by depth: Place 1; Environment 2; Home, Work, Park 3; School (part of Work), Playground
(a Park), HomeZone1 4.
Stated: Building -> Work 0.4, House -> Home 0.9, Cottage -> Playground 0.5, Tower -> Work (1),
Car -> School 0.6.
"""

from __future__ import annotations

from math import log

import numpy as np
import pytest

from symboslam.errors import UnknownNameError
from symboslam.reasoning.knowledge import Environment, Feature, Indication, Knowledge

PATH = {
    ("Building", "Work"): 0.4,
    ("House", "Home"): 0.9,
    ("House", "Work"): 0.4 / 2,
    ("Cottage", "Home"): 0.9 / 2,
    ("Cottage", "Work"): 0.4 / 3,
    ("Cottage", "Park"): 0.5 / 2,
    ("Tower", "Work"): 1.0,
    ("Car", "Work"): 0.6 / 2,
}
WU_PALMER = {
    ("Building", "Work"): 0.4,
    ("House", "Home"): 0.9,
    ("House", "Work"): 0.4 * 6 / 7,
    ("Cottage", "Home"): 0.9 * 8 / 9,
    ("Cottage", "Work"): 0.4 * 6 / 8,
    ("Cottage", "Park"): 0.5 * 6 / 7,
    ("Tower", "Work"): 1.0,
    ("Car", "Work"): 0.6 * 6 / 7,
}
# Of the 8 features 1 is at or below Cottage, 2 House, 3 Building; of the 8 places 1 is at or below
# School and Playground, 2 Work and Park.
LIN = {
    ("Building", "Work"): 0.4,
    ("House", "Home"): 0.9,
    ("House", "Work"): 0.4 * 2 * log(8 / 3) / (log(4) + log(8 / 3)),
    ("Cottage", "Home"): 0.9 * 2 * log(4) / (log(8) + log(4)),
    ("Cottage", "Work"): 0.4 * 2 * log(8 / 3) / (log(8) + log(8 / 3)),
    ("Cottage", "Park"): 0.5 * 2 * log(4) / (log(8) + log(4)),
    ("Tower", "Work"): 1.0,
    ("Car", "Work"): 0.6 * 2 * log(4) / (log(8) + log(4)),
}


def test_order(town: Knowledge) -> None:
    assert [e.name for e in town.environments] == ["Home", "Park", "Work"]
    assert [f.name for f in town.features] == ["Building", "Car", "Cottage", "House", "Tower"]


@pytest.mark.parametrize(
    ("measure", "expected"), [("path", PATH), ("wu_palmer", WU_PALMER), ("lin", LIN)]
)
def test_values(town: Knowledge, measure: str, expected: dict[tuple[str, str], float]) -> None:
    table = np.zeros((5, 3))
    features = [f.name for f in town.features]
    environments = [e.name for e in town.environments]
    for (feature, environment), value in expected.items():
        table[features.index(feature), environments.index(environment)] = value
    np.testing.assert_allclose(town.proximity(measure), table, rtol=0, atol=1e-12)


def test_direct_links_are_exact(town: Knowledge) -> None:
    direct = town.direct()
    assert direct.sum() == 3
    for measure in ("path", "wu_palmer", "lin"):
        values = sorted(town.proximity(measure)[direct == 1].tolist())
        assert values == [0.4, 0.9, 1.0]


def test_importance(town: Knowledge) -> None:
    house = np.array([0.9, 0.2]) / 1.1
    cottage = np.array([0.45, 0.25, 0.4 / 3]) / (0.45 + 0.25 + 0.4 / 3)
    expected = [
        1.0,
        1.0,
        1 + (cottage * np.log(cottage)).sum() / log(3),
        1 + (house * np.log(house)).sum() / log(3),
        1.0,
    ]
    np.testing.assert_allclose(town.importance(), expected, atol=1e-12)


def test_importance_within_a_scheme(town: Knowledge) -> None:
    """In the scheme of Home and Work only these two count, and log|E| is log 2."""
    cottage = np.array([0.45, 0.4 / 3]) / (0.45 + 0.4 / 3)
    entropy = -(cottage * np.log(cottage)).sum()
    assert town.importance(scheme="busy")[2] == pytest.approx(1 - entropy / log(2), abs=1e-12)


def test_weights(town: Knowledge) -> None:
    np.testing.assert_array_equal(
        town.weights(), town.proximity() * town.importance()[:, np.newaxis]
    )
    np.testing.assert_array_equal(town.weights(importance="none"), town.proximity())
    with pytest.raises(
        UnknownNameError, match="there is no importance 'entropi'; did you mean entropy"
    ):
        town.weights(importance="entropi")


def test_unknown_measure(town: Knowledge) -> None:
    with pytest.raises(UnknownNameError, match="path, wu_palmer, lin"):
        town.proximity("cosine")


def _two_features(schemes: dict[str, tuple[str, ...]]) -> Knowledge:
    """One feature that points to both environments alike, one that points to none."""
    return Knowledge(
        environments=(Environment("a", "A", "A"), Environment("b", "B", "B")),
        features=(Feature("f", "F", "F"), Feature("g", "G", "G")),
        indications=(
            Indication("F", "A", 0.5, 0, ("F", "A")),
            Indication("F", "B", 0.5, 0, ("F", "B")),
        ),
        proximities={"path": np.array([[0.5, 0.5], [0.0, 0.0]])},
        schemes=schemes,
    )


def test_importance_of_no_information() -> None:
    np.testing.assert_allclose(_two_features({"all": ("A", "B")}).importance(), [0, 0], atol=1e-15)


def test_importance_with_one_environment() -> None:
    np.testing.assert_array_equal(_two_features({"one": ("B",)}).importance(), [1, 0])


def test_ways_are_explained(town: Knowledge) -> None:
    home, park, work = (
        next(i for i in town.indications_of("Cottage") if i.environment == e)
        for e in ("Home", "Park", "Work")
    )
    assert home.path == ("Cottage", "House", "Home")
    assert (home.strength, home.steps, home.proximity) == (0.9, 1, 0.45)
    assert (home.reason, home.source) == ("", "")
    assert park.path == ("Cottage", "Playground", "Park")
    assert work.path == ("Cottage", "House", "Building", "Work")
    assert work.axioms == (
        "Country cottage is a kind of House",
        "House is a kind of Building",
        "Building indicates Work (strength 0.4)",
    )
    assert work.reason == "Half the buildings of the town are workshops."
    assert work.source == "Survey of the town"
    assert work.source_iri == "https://example.org/town#survey"
    car = town.indications_of("car")[0]
    assert car.axioms == ("Car indicates School (strength 0.6)", "School is part of Work")
