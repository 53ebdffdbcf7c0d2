"""Plain lists agree with the ontology; class counts come from its tags and tree alone."""

import importlib.util
import sys
from dataclasses import replace
from importlib.resources import files
from pathlib import Path
from types import ModuleType

import pytest

from symboslam.reasoning.knowledge import Knowledge
from symboslam.sim_bridge.worlds.frequencies import COMPANIONS, OPEN_GROUND, real_frequencies
from symboslam.sim_bridge.worlds.habits import ALIGNED, HABITS, NEAR, SIGNS
from symboslam.sim_bridge.worlds.sizes import CLASSES, SIZES, find_class, near_classes
from symboslam.sim_bridge.worlds.stand_ins import BY_FEATURE, stand_in

ROOT = Path(__file__).parents[3]
COUNTS = ROOT.parent / "shared/reference/zone-class-frequencies.csv"


@pytest.fixture(scope="module")
def knowledge() -> Knowledge:
    return Knowledge.load()


@pytest.fixture(scope="module")
def script() -> ModuleType:
    spec = importlib.util.spec_from_file_location(
        "class_frequencies", ROOT / "scripts" / "class_frequencies.py"
    )
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules["class_frequencies"] = module
    spec.loader.exec_module(module)
    return module


def test_classes_are_the_detector_labels(knowledge: Knowledge) -> None:
    labels = {f.detector_label: f for f in knowledge.features if f.detector_label}
    assert set(CLASSES) == set(labels)
    assert len(CLASSES) == 56
    assert {n: s.moves for n, s in SIZES.items()} == {n: not labels[n].static for n in CLASSES}
    assert {find_class(f.name) for f in labels.values()} == set(CLASSES)
    assert near_classes("Hose") == ["House", "Horse"]


def test_sizes_are_sizes() -> None:
    assert all(min(size[:3]) > 0 for size in SIZES.values())


def test_tables_name_classes_that_exist(knowledge: Knowledge) -> None:
    named = {*HABITS, *NEAR, *ALIGNED, *SIGNS, *OPEN_GROUND, *(c for c, _, _ in COMPANIONS)}
    assert named <= set(CLASSES)
    table = real_frequencies()
    assert {host for _, host, _ in COMPANIONS} <= {*table.counts, *table.sites}
    assert set(real_frequencies().counts) <= set(CLASSES)
    assert set(BY_FEATURE) <= {f.name for f in knowledge.features}


def test_stand_ins(knowledge: Knowledge) -> None:
    seen = {
        "SingleTree": "Tree", "House": "House", "UnspecifiedBuilding": "Building",
        "IndustrialBuilding": "Factory", "ClothesShop": "ConvenienceStore",
        "RailSignal": "Train", "Parking": "Car", "Restaurant": None, "StopPosition": None,
    }  # fmt: skip
    assert {name: stand_in(knowledge.get_feature(name)) for name in seen} == seen


SMALL = """key,value,Residential,Commercial
(zone area km2),,10.0,2.0
building,yes,100,3
building,house,30,1
building,apartments,10,0
natural,tree,7,8
amenity,restaurant,5,6
"""


def test_script_shares_out_untold_buildings(script: ModuleType, knowledge: Knowledge) -> None:
    text, unseen = script.table(SMALL, knowledge.features)
    rows = [line.split(",")[:3] for line in text.splitlines() if not line.startswith("#")]
    assert rows == [
        ["class", "Residential", "Commercial"],
        ["(km2)", "10.0", "2.0"],
        ["(restaurant)", "5", "6"],
        ["Apartment", "35", "0"],
        ["Building", "0", "3"],
        ["House", "105", "1"],
        ["Tree", "7", "8"],
    ]
    assert unseen == ["amenity=restaurant"]


def test_script_never_reads_indications(script: ModuleType, knowledge: Knowledge) -> None:
    """It is handed features, which carry no indications; altered strengths leave them alike."""
    altered = replace(knowledge, indications=(), proximities={})
    assert altered.features == knowledge.features
    assert not any("indicat" in name for f in altered.features for name in vars(f))
    assert script.table(SMALL, altered.features) == script.table(SMALL, knowledge.features)


def test_shipped_counts_are_the_scripts(script: ModuleType, knowledge: Knowledge) -> None:
    if not COUNTS.exists():
        pytest.skip(f"needs the counts of tags by zone: {COUNTS}")
    text, _ = script.table(COUNTS.read_text(encoding="utf-8"), knowledge.features)
    shipped = files("symboslam.sim_bridge.worlds") / "class_frequencies.csv"
    assert shipped.read_text(encoding="utf-8") == text


def test_densities() -> None:
    table = real_frequencies()
    assert "Military" not in table.environments
    assert len(table.environments) == 7
    assert table.counted("Residential")["House"] > 100
    assert table.density("NonUrban")["Sheep"] == OPEN_GROUND["Sheep"]
    assert "Sheep" not in table.density("Residential")
    residential = table.density("Residential")
    assert residential["Cat"] == pytest.approx(0.05 * residential["House"])
