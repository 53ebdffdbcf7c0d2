"""A small world for the engine's tests: three environments, four features, hand-given strengths."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest

from symboslam.engine.frame import Frame
from symboslam.engine.landmarks import LandmarkMap
from symboslam.reasoning.knowledge import Environment, Feature, Indication, Knowledge

BASE = "https://example.org/small#"
STRENGTHS = {
    "House": {"Home": 0.9},
    "Shop": {"Work": 0.8},
    "Tree": {"Home": 0.3, "Open": 0.3},
    "Ground": {"Open": 1.0},
}


@pytest.fixture
def knowledge() -> Knowledge:
    """House -> Home, Shop -> Work, Tree -> Home and Open, unmarked ground -> Open."""
    environments = tuple(Environment(BASE + n, n, n.lower()) for n in ("Home", "Work", "Open"))
    features = tuple(Feature(BASE + n, n, n.lower()) for n in STRENGTHS)
    names = [e.name for e in environments]
    path = np.zeros((len(features), len(environments)))
    indications = []
    for i, (name, strengths) in enumerate(STRENGTHS.items()):
        for environment, strength in strengths.items():
            path[i, names.index(environment)] = strength
            reason = f"A {name.lower()} is {environment.lower()}."
            way = (name, environment)
            indications.append(
                Indication(name, environment, strength, 0, way, reason, "test", is_direct=True)
            )
    return Knowledge(
        environments=environments,
        features=features,
        indications=tuple(indications),
        proximities={"path": path, "wu_palmer": path, "lin": path},
        schemes={"all": tuple(names), "built": ("Home", "Work")},
        absence=("Ground",),
    )


Maker = Callable[..., LandmarkMap]


@pytest.fixture
def landmarks_at(knowledge: Knowledge) -> Maker:
    """Make a LandmarkMap in metres from (feature, x, y[, confidence]) rows."""

    def make(
        rows: Sequence[tuple[object, ...]],
        bbox: tuple[float, float, float, float] = (0, 0, 240, 240),
    ) -> LandmarkMap:
        n = len(rows)
        names = list(STRENGTHS)
        return LandmarkMap(
            feature=np.array([names.index(str(r[0])) for r in rows], np.int32),
            x=np.array([r[1] for r in rows], float),
            y=np.array([r[2] for r in rows], float),
            confidence=np.array([r[3] if len(r) > 3 else 1.0 for r in rows], float),
            static=np.ones(n, bool),
            id=np.array([str(i) for i in range(n)], dtype=np.str_),
            frame=Frame.metric(),
            bbox=bbox,
        )

    return make


@pytest.fixture(scope="session")
def bundled() -> Knowledge:
    """What ships with the package."""
    return Knowledge.load()


@pytest.fixture(scope="session")
def area(bundled: Knowledge) -> Maker:
    """Make a LandmarkMap of the bundled ontology's features, as ``landmarks_at`` does."""

    def make(
        rows: Sequence[tuple[object, ...]],
        bbox: tuple[float, float, float, float] = (0, 0, 240, 240),
    ) -> LandmarkMap:
        index = [bundled.index_of(str(row[0])) for row in rows]
        assert None not in index
        numbers = np.array([[*row[1:3], row[3] if len(row) > 3 else 1.0] for row in rows], float)
        x, y, confidence = numbers.reshape(-1, 3).T
        return LandmarkMap(
            feature=np.array(index, np.int32), x=x, y=y, confidence=confidence,
            static=np.ones(len(rows), bool),
            id=np.array([f"n{i}" for i in range(len(rows))], dtype=np.str_),
            frame=Frame.metric(), bbox=bbox,
        )  # fmt: skip

    return make
