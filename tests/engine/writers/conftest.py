"""Maps made by hand for the writers' tests: four segments, three environments, known reasons."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np
import pytest
import shapely

from symboslam.engine._base import Evidence
from symboslam.engine.chain import Shares
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.explanation import Reason
from symboslam.engine.frame import Frame
from symboslam.engine.grid import Cells
from symboslam.engine.landmarks import LandmarkMap, ReadReport
from symboslam.reasoning.knowledge import (
    Environment,
    EnvironmentGroup,
    Feature,
    Indication,
    Knowledge,
)

SL = "https://w3id.org/symboslam#"
ENVIRONMENTS = (
    Environment(SL + "Residential", "Residential", "Residential", "People live here.", "#f2cf63"),
    Environment(SL + "Commercial", "Commercial", "Commercial", "People trade here.", "#b04a5a"),
    Environment(SL + "NonUrban", "NonUrban", "Non-urban", 'Open "country".', "#8fb573"),
)
FEATURES = tuple(
    Feature(SL + name, name, label)
    for name, label in (
        ("House", "house"),
        ("Shop", "shop"),
        ("Tree", "tree"),
        ("OpenGround", "open ground"),
    )
)
INDICATIONS = tuple(
    Indication(
        feature,
        environment,
        strength,
        steps,
        (feature, environment),
        f"A {feature} is often in {environment}.",
        SL + "source-judgement",
    )
    for feature, environment, strength, steps in (
        ("House", "Residential", 0.9, 0),
        ("Shop", "Commercial", 0.8, 1),
        ("Tree", "Residential", 0.3, 0),
        ("Tree", "NonUrban", 0.3, 0),
        ("OpenGround", "NonUrban", 1.0, 0),
    )
)
KNOWLEDGE = Knowledge(
    environments=ENVIRONMENTS,
    features=FEATURES,
    indications=INDICATIONS,
    proximities={"path": np.zeros((4, 3))},
    schemes={"all": tuple(e.name for e in ENVIRONMENTS)},
    absence=("OpenGround",),
    source_hash="ab" * 32,
    groups=(
        EnvironmentGroup(SL + "Urban", "Urban", "Urban", "Built.", ("Commercial", "Residential")),
    ),
    zones=Knowledge(
        environments=tuple(
            Environment(SL + name, name, f"{name} zone", "A zone.")
            for name in ("NUZ1", "NUZ2", "RZ1", "RZ2")
        ),
        features=FEATURES,
        indications=(),
        proximities={"path": np.zeros((4, 4))},
        schemes={"Residential": ("RZ1", "RZ2"), "NonUrban": ("NUZ1", "NUZ2")},
    ),
)

Given = Mapping[int, tuple[Reason, ...]]


class HandMadeMap(EnvironmentMap):
    """A map whose reasons are given instead of computed."""

    given: ClassVar[Given] = {}

    def told(self, segments: Sequence[int]) -> list[tuple[tuple[Reason, ...], Shares]]:
        return [(self.given.get(i, ()), SHARES.get(i, {})) for i in segments]


def make_map(
    frame: Frame | None = None,
    landmarks: Sequence[tuple[Any, ...]] = (),
    probability: Sequence[Sequence[float]] = ((0.0, 0.0, 0.0),) * 4,
    given: Given | None = None,
    ids: Sequence[str] = ("0-0-0", "0-0-1", "0-1-0", "0-1-1"),
    bbox: tuple[float, float, float, float] = (-100.0, -100.0, 100.0, 100.0),
    **columns: Any,
) -> HandMadeMap:
    """A map of 2 x 2 segments.

    Args:
        frame: metres unless given.
        landmarks: (feature index, x, y, confidence) each.
        probability: a row for each segment; zeros = unknown.
        given: segment position -> its reasons.
        ids: of the segments.
        bbox: the area in metres.
        columns: more columns of the LandmarkMap.
    """
    rows = np.array([r[1:] for r in landmarks], float).reshape(-1, 3)
    marks = LandmarkMap(
        feature=np.array([r[0] for r in landmarks], np.int32),
        x=rows[:, 0],
        y=rows[:, 1],
        confidence=rows[:, 2],
        static=np.ones(len(rows), bool),
        id=np.array([f"n{i}" for i in range(len(rows))], dtype=np.str_),
        frame=frame or Frame.metric(),
        bbox=bbox,
        report=ReadReport("town.geojson", len(rows), Counter({"shop=moon": 2}), 1, 0, ("A note.",)),
    )
    marks = replace(marks, **columns)
    west, south, east, north = bbox
    xs, ys = [west, (west + east) / 2, east], [south, (south + north) / 2, north]
    boxes = np.array(
        [shapely.box(xs[c], ys[r], xs[c + 1], ys[r + 1]) for r in (0, 1) for c in (0, 1)]
    )
    p = np.array(probability, float)
    made = HandMadeMap(
        environments=ENVIRONMENTS,
        geometry=boxes,
        label=np.where(p.any(1), p.argmax(1), -1).astype(np.int16),
        probability=p,
        segment_id=np.array(ids, dtype=np.str_),
        landmark_count=np.array(
            [int(shapely.contains_xy(b, marks.x, marks.y).sum()) for b in boxes], np.int64
        ),
        depth=np.zeros(4, np.int16),
        landmarks=marks,
        knowledge=KNOWLEDGE,
        config={"profile": "default", "threshold": 0.95, "cells": 2, "bandwidth": None},
        evidence=NoEvidence(),
        regions=Cells(*np.zeros((3, 4), np.int64)),
    )
    object.__setattr__(made, "given", given or {})
    return made


class NoEvidence(Evidence[Cells]):
    """Evidence that nobody asks."""

    def of(self, cells: Cells) -> Any:
        raise AssertionError

    def without(self, cells: Cells, landmarks: Sequence[int]) -> Any:
        raise AssertionError

    def contributions(self, cells: Cells) -> Any:
        raise AssertionError


# Hand-computed: in segment 0 the reasons add up to (0.7, 0.1, 0.2), in segment 3 to (0, 0, 1).
REASONS: Given = {
    0: (
        Reason("House", "house", 2, {"Residential": 0.6}),
        Reason("Tree", "tree", 1, {"Residential": 0.15, "NonUrban": 0.15}),
        Reason("Shop", "shop", 1, {"Residential": -0.05, "Commercial": 0.1}),
        Reason("OpenGround", "open ground", 0, {"NonUrban": 0.05}),
    ),
    1: (Reason("Shop", "shop", 1, {"Commercial": 1.0}),),
    3: (Reason("OpenGround", "open ground", 0, {"NonUrban": 1.0}),),
}
# In segment 0 the zones of Residential are told apart: 0.7 = 0.35 + 0.35.
SHARES: Mapping[int, Shares] = {
    0: {"Residential": {"RZ1": 0.5, "RZ2": 0.5}, "NonUrban": None},
    3: {"NonUrban": {"NUZ1": 0.0, "NUZ2": 1.0}},
}
LANDMARKS = (
    (0, -60.0, -60.0, 1.0),
    (0, -40.0, -50.0, 0.9),
    (2, -30.0, -70.0, 0.5),
    (1, -20.0, -20.0, 0.00001),
    (1, 60.0, -60.0, 0.8),
)
PROBABILITY = ((0.7, 0.1, 0.2), (0.0, 1.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0))


def full_map(frame: Frame | None = None, **columns: Any) -> HandMadeMap:
    """Segment 0 Residential, 1 Commercial with one landmark, 2 unknown, 3 NonUrban and empty."""
    return make_map(frame, LANDMARKS, PROBABILITY, REASONS, **columns)


VADUZ = Frame.around(9.52, 47.14)


@pytest.fixture(params=["metric", "geographic"])
def town(request: pytest.FixtureRequest) -> HandMadeMap:
    """The full map, in metres and in degrees."""
    return full_map(VADUZ if request.param == "geographic" else None)


@pytest.fixture(scope="session", name="make_map")
def make_map_fixture() -> Callable[..., HandMadeMap]:
    """``make_map``, for tests that need a map of their own."""
    return make_map


@pytest.fixture(scope="session", name="make_town")
def make_town_fixture() -> Callable[..., HandMadeMap]:
    """``full_map``, for tests that change a column."""
    return full_map


@pytest.fixture
def empty() -> HandMadeMap:
    """A map of an area without landmarks: all unknown."""
    return make_map()
