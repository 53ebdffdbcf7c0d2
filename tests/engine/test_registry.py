"""Segmentations are found by name: ours, installed ones and those that a user registers."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from importlib.metadata import EntryPoint, EntryPoints
from typing import Any, ClassVar

import numpy as np
import pytest
import shapely

from symboslam.engine import registry
from symboslam.engine.branch import BranchSegmentation
from symboslam.engine.classify import classify
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.fragments import FragmentEvidence, Fragments
from symboslam.engine.grid_map import GridSegmentation
from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.registry import Segmentation, register, segmentation_of, segmentations
from symboslam.engine.settings import Settings
from symboslam.engine.weights import weights_of
from symboslam.errors import InputError, SegmentationError, UnknownNameError
from symboslam.reasoning.knowledge import Knowledge


class Halves(Segmentation):
    """West and east of the middle, as a user might write it."""

    name: ClassVar[str] = "halves"
    unused: ClassVar[frozenset[str]] = frozenset({"cells", "momentum"})

    def cut(
        self, landmarks: LandmarkMap, knowledge: Knowledge, scheme: str | None,
        settings: Settings, tell: registry.Progress,
    ) -> EnvironmentMap:  # fmt: skip
        west, south, east, north = landmarks.bbox
        middle = (west + east) / 2
        weight = weights_of(landmarks, knowledge, scheme, settings)
        evidence = FragmentEvidence(landmarks.xy, weight, settings.a)
        regions = Fragments.of((landmarks.x > middle).astype(np.int64), landmarks.xy)
        p = evidence.of(regions)
        p = p / p.sum(1, keepdims=True)
        return EnvironmentMap(
            environments=knowledge.scheme(scheme),
            geometry=shapely.box([west, middle], south, [middle, east], north),
            label=p.argmax(1).astype(np.int16),
            probability=p,
            segment_id=np.array(["west", "east"]),
            landmark_count=np.array([len(m) for m in regions.members]),
            depth=np.zeros(2, np.int16),
            landmarks=landmarks,
            knowledge=knowledge,
            config=self.configuration(settings, scheme or "all"),
            evidence=evidence,
            regions=regions,
        )


class Another(Halves):
    """Takes a name that is taken."""


@pytest.fixture(autouse=True)
def _nothing_stays_registered() -> Iterator[None]:
    before = dict(registry._registered)
    yield
    registry._registered.clear()
    registry._registered.update(before)


def test_ours() -> None:
    assert segmentations()[:2] == ("grid", "branch")
    assert isinstance(segmentation_of("grid"), GridSegmentation)
    assert isinstance(segmentation_of("branch"), BranchSegmentation)


def test_one_of_the_user_works_like_ours(
    landmarks_at: Callable[..., Any], knowledge: Knowledge
) -> None:
    assert register(Halves) is Halves
    assert "halves" in segmentations()
    rows = [("House", 10, 10), ("House", 20, 10), ("Shop", 200, 10), ("Shop", 210, 10)]
    found = classify(landmarks_at(rows), knowledge, segmentation="halves")
    assert [found.name_of(i) for i in range(2)] == ["Home", "Work"]
    assert found.config["segmentation"] == "halves"
    assert "cells" not in found.config
    reasons = found.explain("east").reasons
    assert [(r.feature, r.count) for r in reasons] == [("Shop", 2)]


def test_a_name_that_is_taken_is_refused() -> None:
    register(Halves)
    register(Halves)  # the same again does no harm
    with pytest.raises(InputError, match="halves"):
        register(Another)
    Another.name = "grid"
    with pytest.raises(InputError, match="grid"):
        register(Another)


def test_unknown_names_tell_the_known_ones() -> None:
    register(Halves)
    with pytest.raises(UnknownNameError, match="grid, branch, halves"):
        segmentation_of("slic")


def test_installed_packages_bring_theirs(monkeypatch: pytest.MonkeyPatch) -> None:
    values = {"good": f"{__name__}:Halves", "gone": "no.such.module:X", "wrong": "json:loads"}
    monkeypatch.setitem(sys.modules, __name__, sys.modules[__name__])
    points = EntryPoints(EntryPoint(n, v, registry.GROUP) for n, v in values.items())
    monkeypatch.setattr(registry, "entry_points", lambda **given: points.select(**given))
    assert segmentations() == ("grid", "branch", "gone", "good", "wrong")
    assert isinstance(segmentation_of("good"), Halves)
    with pytest.raises(InputError, match=r"'gone' of no\.such\.module:X fails"):
        segmentation_of("gone")
    with pytest.raises(InputError, match="json:loads is no Segmentation"):
        segmentation_of("wrong")


def test_one_that_fails_is_named_with_the_place(knowledge: Knowledge, landmarks_at: Any) -> None:
    class Broken(Halves):
        name: ClassVar[str] = "broken"

        def cut(self, *arguments: Any) -> EnvironmentMap:
            raise ZeroDivisionError("no cells")

    register(Broken)
    with pytest.raises(
        SegmentationError, match=r"broken \(.*\) failed: ZeroDivisionError: no"
    ) as e:
        classify(landmarks_at([("House", 1, 1)]), knowledge, segmentation="broken")
    assert "test_registry.py: line" in str(e.value)


@pytest.mark.parametrize(
    ("segmentation", "changes"),
    [("branch", {"cells": 12}), ("grid", {"momentum": 2}), ("branch", {"threshold": 0.5})],
)
def test_settings_that_it_does_not_use_are_refused(
    knowledge: Knowledge, landmarks_at: Any, segmentation: str, changes: dict[str, Any]
) -> None:
    with pytest.raises(InputError, match=f"{next(iter(changes))} would change nothing"):
        classify(landmarks_at([("House", 1, 1)]), knowledge, segmentation=segmentation, **changes)
