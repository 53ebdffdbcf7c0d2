"""How well generated worlds could be classified: ``scripts/world_bounds.py``."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from symboslam.engine.evaluation import evaluate_pairs
from symboslam.reasoning.knowledge import Knowledge
from symboslam.sim_bridge.worlds.truth import zones_geojson

SEED = 100


@pytest.fixture(scope="module")
def bounds() -> ModuleType:
    path = Path(__file__).parents[3] / "scripts" / "world_bounds.py"
    spec = importlib.util.spec_from_file_location("world_bounds", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["world_bounds"] = module  # dataclasses look there
    spec.loader.exec_module(module)
    return module


def test_bounds_know_what_the_generator_knew(bounds: ModuleType) -> None:
    area = bounds.area_of("kingston", SEED)
    assert area.prior.sum() == pytest.approx(1, abs=1e-4)
    assert area.prior @ area.rate.sum(1) * area.world.extent.area_km2 == pytest.approx(212, abs=1)
    whole = bounds.area_of("airport", SEED)
    community = bounds.TYPES.index("CommunityFacility")
    airplanes = whole.rate[community, bounds.CLASSES.index("Airplane")]
    assert airplanes * whole.prior[community] * whole.world.extent.area_km2 == pytest.approx(
        7, abs=0.01
    )  # but for classes that were never counted


def test_who_is_told_more_errs_less(bounds: ModuleType) -> None:
    knowledge = Knowledge.load()
    areas = [bounds.area_of(name, SEED) for name in ("kingston", "train-depot")]

    def iou(make: Callable[[Any], Any]) -> float:
        pairs = [(zones_geojson(area.world), make(area)) for area in areas]
        return evaluate_pairs(pairs, cells=24, knowledge=knowledge).result.all.mean_iou

    cells, blocks, around, zones = (
        iou(make)
        for make in (bounds.by_cells, bounds.by_blocks, bounds.by_neighbours, bounds.by_zones)
    )
    assert max(cells, blocks) < around < zones
    assert zones > 0.9
