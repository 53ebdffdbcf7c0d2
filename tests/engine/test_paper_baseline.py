"""Profile ``paper`` against the benchmark's own writing of the original authors' algorithm."""

from __future__ import annotations

import importlib
import os
import sys
import types
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from symboslam.engine.evidence import PairEvidence
from symboslam.engine.frame import Frame
from symboslam.engine.grid import Grid
from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.settings import settings_of

SHARED = Path(os.environ.get("SYMBOSLAM_SHARED", Path(__file__).parents[3] / "shared"))


@pytest.fixture
def baselines(monkeypatch: pytest.MonkeyPatch) -> Any:
    """The benchmark's baselines.py; its learners are not needed, so neither is scikit-learn."""
    folder = SHARED / "benchmark"
    if not (folder / "baselines.py").exists():
        pytest.skip("no shared data folder with the benchmark")
    learners = {
        "sklearn.ensemble": "RandomForestClassifier",
        "sklearn.feature_extraction.text": "TfidfTransformer",
        "sklearn.naive_bayes": "MultinomialNB",
    }
    for name in ("sklearn", "sklearn.feature_extraction", *learners):
        module = types.ModuleType(name)
        setattr(module, learners.get(name, "unused"), None)
        monkeypatch.setitem(sys.modules, name, module)
    monkeypatch.syspath_prepend(str(folder))
    for name in ("baselines", "benchset", "common", "osm_classes", "score"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    return importlib.import_module("baselines")


@pytest.mark.parametrize("name", ["airport", "city", "prattville"])
def test_every_segment_has_the_evidence_of_the_authors_algorithm(baselines: Any, name: str) -> None:
    area = next(a for a in baselines.load("dev") if a["name"] == name)
    xy, confidence, _, classes = baselines.landmarks(area)
    keep = [i for i, c in enumerate(classes) if c is not None]
    xy, confidence = xy[keep], confidence[keep]
    members = np.zeros((len(keep), 8))
    for i, j in enumerate(keep):
        for environment in baselines.TABLE.get(classes[j], ()):
            members[i, baselines.INDEX[environment]] = 1
    factor = np.tile(baselines.scale(area), 2)
    west, south, east, north = np.array(area["bbox"]) * factor
    grid = Grid((west, south, east, north), area["cells"])
    landmarks = LandmarkMap(
        feature=np.zeros(len(keep), np.int32),
        x=xy[:, 0],
        y=xy[:, 1],
        confidence=confidence,
        static=np.ones(len(keep), bool),
        id=np.arange(len(keep)).astype(np.str_),
        frame=Frame.metric(),
        bbox=grid.box,
    )
    ours = PairEvidence(landmarks, members * confidence[:, None], grid, settings_of("paper"))
    compared = 0
    for depth in range(grid.depth + 1):
        cells = grid.level(depth)
        w, s, e, n = grid.rectangles(cells)
        for i, (inside, mine) in enumerate(zip(ours.members(cells), ours.of(cells), strict=True)):
            if len(inside) > 1:
                diagonal = float(np.hypot(e[i] - w[i], n[i] - s[i]))
                near = xy[inside] - (w[i], s[i])  # theirs is in single precision
                theirs = baselines.engine(near, confidence[inside], members[inside], diagonal)
                np.testing.assert_allclose(mine, theirs, atol=1e-5)
                compared += 1
    assert compared > 15
