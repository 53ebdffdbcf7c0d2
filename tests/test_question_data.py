"""The data of the competency questions: the town is what its script makes, all of it conforms."""

from __future__ import annotations

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest
from rdflib import Graph

from symboslam.errors import ReasonerError
from symboslam.reasoning.axioms import split
from symboslam.reasoning.hermit import Hermit, find_java
from symboslam.reasoning.parsing import parse

FOLDER = Path(__file__).parents[1] / "competency_questions"
SCRIPT = Path(__file__).parents[1] / "scripts" / "question_data.py"


def _question_data() -> ModuleType:
    spec = importlib.util.spec_from_file_location("question_data", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


question_data = _question_data()


def test_town_is_what_the_script_makes(tmp_path: Path) -> None:
    """If this fails after a change of strengths or reasons, run scripts/question_data.py.

    Hash and version are left out: a new comment in the ontology must not ask for new data.
    """
    question_data.write(tmp_path / "town.ttl")
    made, kept = (
        re.sub(r'[0-9a-f]{64}|(?<=software/)[\w.]+|(?<=versionInfo ")[\w.]+', "", path.read_text())
        for path in (tmp_path / "town.ttl", FOLDER / "data" / "town.ttl")
    )
    assert made == kept


def test_town_is_small_and_conforms_to_the_shapes() -> None:
    pytest.importorskip("pyshacl", reason="pySHACL comes with symboslam[shapes]")
    from symboslam.engine.validate import validate_map

    file = FOLDER / "data" / "town.ttl"
    assert file.stat().st_size < 300_000
    assert str(validate_map(file)) == "The map conforms to the shapes."


@pytest.mark.proof
@pytest.mark.parametrize("names", [("slam",), ("team", "town")])
def test_other_data_conform_to_the_shapes(names: tuple[str, ...]) -> None:
    """Together with the ontology, since they do not describe its classes as a written map does."""
    pytest.importorskip("pyshacl", reason="pySHACL comes with symboslam[shapes]")
    from symboslam.engine.validate import validate_map

    graph = Graph()
    for name in names:
        graph.parse(FOLDER / "data" / f"{name}.ttl")
    assert len(graph) > 100
    for file in _ontology():
        graph.parse(file)
    assert str(validate_map(graph)) == "The map conforms to the shapes."


@pytest.mark.proof
def test_all_data_are_consistent_with_the_ontology() -> None:
    try:
        find_java()
    except ReasonerError:
        pytest.skip("no Java: pip install 'symboslam[reasoner]'")
    graph = Graph()
    for file in [*_ontology(), *(FOLDER / "data").glob("*.ttl")]:
        graph += parse(str(file), file.read_bytes())
    declarations, axioms = split(graph)
    found = Hermit().classify([*declarations, *(t for axiom in axioms for t in axiom.triples)])
    assert found is not None, "ontology and data contradict each other"
    assert not found.unsatisfiable


def _ontology() -> list[Path]:
    folder = FOLDER.parent / "ontology"
    found = [*folder.glob("*.ttl"), *(folder / "upstream").glob("*.ttl")]
    assert len(found) > 10
    return found
