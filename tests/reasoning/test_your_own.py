"""Bring your own ontology: the example of rooms, and what its guide says."""

from __future__ import annotations

import csv
import re
from pathlib import Path

import numpy as np
import pytest

from symboslam.errors import InconsistentOntologyError
from symboslam.reasoning.check import check_ontology
from symboslam.reasoning.knowledge import Knowledge

ROOT = Path(__file__).parents[2]
EXAMPLE = ROOT / "examples" / "indoor-rooms"
GUIDE = (ROOT / "docs" / "your-own-ontology.md").read_text("utf-8")
BLOCKS = re.findall(r"^```turtle\n(.*?)^```$", GUIDE, re.MULTILINE | re.DOTALL)

# The rooms of the flat: west, south, east, north in metres.
FLAT: dict[str, list[tuple[float, float, float, float]]] = {
    "LivingRoom": [(0, 0, 5.5, 5)],
    "Kitchen": [(5.5, 0, 9, 4)],
    "Bathroom": [(9, 0, 12, 3.5)],
    "Hallway": [(5.5, 4, 12, 5.5)],
    "Bedroom": [(0, 5, 5, 9), (8.5, 5.5, 12, 9)],
    "Office": [(5, 5.5, 8.5, 9)],
}


@pytest.fixture(scope="module")
def rooms() -> Knowledge:
    return Knowledge.load(EXAMPLE / "rooms.ttl", cache=False)


@pytest.fixture(scope="module")
def flat() -> list[dict[str, str]]:
    with (EXAMPLE / "flat.csv").open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def test_rooms(hermit: None, rooms: Knowledge) -> None:
    assert {e.name for e in rooms.environments} == FLAT.keys()
    assert rooms.scheme() == rooms.environments
    assert sum(f.detector_label is not None for f in rooms.features) >= 30
    assert rooms.bandwidth() == 1.2
    for name in ("cat", "dog", "person"):
        assert not rooms.get_feature(name).static
    assert rooms.get_feature("dining table").name == "DiningTable"
    assert rooms.index_of("House") is None  # our features are not there


def test_steps(hermit: None, rooms: Knowledge) -> None:
    kitchen, living = rooms.indications_of("cup")
    assert (kitchen.environment, kitchen.proximity) == ("Kitchen", 0.8 / 2)
    assert living.path == ("Cup", "Tableware", "DiningCorner", "LivingRoom")
    assert living.proximity == pytest.approx(0.8 / 3)


def test_check_is_clean(hermit: None) -> None:
    assert check_ontology(EXAMPLE / "rooms.ttl").findings == ()


def test_flat(hermit: None, rooms: Knowledge, flat: list[dict[str, str]]) -> None:
    """Every object is known, and in each room the objects' summed weights point to that room."""
    assert len(flat) >= 60
    weights = rooms.weights()
    names = [e.name for e in rooms.environments]
    for room, boxes in FLAT.items():
        for west, south, east, north in boxes:
            total = np.zeros(len(names))
            for thing in flat:
                x, y = float(thing["x"]), float(thing["y"])
                if west <= x <= east and south <= y <= north:
                    index = rooms.index_of(thing["class"])
                    assert index is not None, thing
                    total = total + float(thing["confidence"]) * weights[index]
            assert names[int(total.argmax())] == room
    inside = sum(
        any(w <= float(t["x"]) <= e and s <= float(t["y"]) <= n for w, s, e, n in boxes)
        for t in flat
        for boxes in FLAT.values()
    )
    assert inside == len(flat)


def test_guide(hermit: None, tmp_path: Path) -> None:
    """The guide's Turtle is a whole ontology, and has no findings."""
    assert len(BLOCKS) == 5
    path = tmp_path / "mine.ttl"
    path.write_text("\n".join(BLOCKS), encoding="utf-8")
    assert check_ontology(path).findings == ()
    knowledge = Knowledge.load(path)
    assert knowledge.indications_of("toothbrush")[0].proximity == 0.98 / 2
    assert [f.name for f in knowledge.features] == ["Sink", "Stove", "Toothbrush"]


def test_clash_in_the_guide(hermit: None, tmp_path: Path) -> None:
    path = tmp_path / "mine.ttl"
    extra = ":Stove rdfs:subClassOf :Kitchen ."
    path.write_text("\n".join([*BLOCKS, extra]), encoding="utf-8")
    with pytest.raises(InconsistentOntologyError) as caught:
        Knowledge.load(path)
    shown = re.search(r"^  1 class can.*?(?=^  ```)", GUIDE, re.MULTILINE | re.DOTALL)
    assert shown is not None
    lines = [line.strip() for line in shown[0].strip().splitlines()]
    said = str(caught.value).splitlines()
    assert said[0] == lines[0]
    assert [line.strip() for line in said] == lines


def test_terms_of_the_guide_exist() -> None:
    core = (ROOT / "ontology" / "core.ttl").read_text("utf-8")
    terms = set(re.findall(r"`(sl:\w+)", GUIDE))
    assert len(terms) > 12
    assert not [term for term in terms if not re.search(rf"^{term}\b", core, re.MULTILINE)]
