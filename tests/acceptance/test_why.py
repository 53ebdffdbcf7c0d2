"""``symboslam why`` as users run it: formats, exit codes, bad input."""

from __future__ import annotations

import codecs
import json
from pathlib import Path
from typing import Any

import pytest
from rdflib import RDF, Graph, Namespace

from symboslam.reasoning.vocabulary import SL

ROOMS = (
    "--ontology",
    str(Path(__file__).parents[2] / "examples" / "indoor-rooms" / "rooms.ttl"),
)  # small, so quick
EXTERNAL_ENTITY = """<?xml version="1.0"?>
<!DOCTYPE rdf:RDF [
  <!ENTITY secret SYSTEM "file:///etc/passwd">
]>
<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#">&secret;</rdf:RDF>
"""


@pytest.mark.proof
def test_house(run: Any) -> None:
    done = run("why", "House indicates Residential")
    assert done.code == 0
    assert "House indicates Residential, because of these axioms" in done.out
    assert "every House indicates some Residential  [features-detector.ttl: line " in done.out
    assert "A house is where people live" in done.out


@pytest.mark.proof
def test_line_is_right(run: Any) -> None:
    record = json.loads(run("why", "House indicates Residential", "--format", "json").out)
    (axiom,) = record["justifications"][0]["axioms"]
    path = Path(__file__).parents[2] / "ontology" / axiom["file"]
    line = path.read_text().splitlines()[axiom["line"] - 1]
    assert "rdfs:subClassOf" in line
    assert "_:House-Residential" in line


def test_what_does_not_follow(run: Any) -> None:
    done = run("why", "Oven is a Kitchen", *ROOMS)
    assert done.code == 1
    assert "does not follow" in done.out
    record = json.loads(run("why", "Oven is a Kitchen", *ROOMS, "--format", "json").out)
    assert record["entailed"] is False
    assert record["justifications"] == []


def test_turtle(run: Any) -> None:
    done = run("why", "Oven indicates Kitchen", *ROOMS, "--format", "ttl")
    graph = Graph().parse(data=done.out, format="turtle", publicID="urn:x")
    assert list(graph.subjects(RDF.type, Namespace(SL).Justification))


@pytest.fixture
def broken(tmp_path: Path) -> dict[str, Path]:
    """Ontologies that are refused, by what is wrong with them."""
    head = "@prefix owl: <http://www.w3.org/2002/07/owl#> .\n"
    texts = {
        "import": f"{head}<urn:a> a owl:Ontology ;\n owl:imports <urn:nowhere> .\n",
        "circle": f"{head}<urn:a> a owl:Ontology ;\n owl:imports <urn:circle> .\n",
        "circle2": f"{head}<urn:circle> a owl:Ontology ;\n owl:imports <urn:a> .\n",
        "syntax": f"{head}<urn:a> a owl:Ontology ;;; nonsense .\n",
        "entity": EXTERNAL_ENTITY,
    }
    files = {}
    for name, text in texts.items():
        files[name] = tmp_path / f"{name}.{'owl' if name == 'entity' else 'ttl'}"
        files[name].write_text(text)
    files["bom"] = tmp_path / "bom.ttl"
    files["bom"].write_bytes(codecs.BOM_UTF8 + f"{head}<urn:b> a owl:Ontology .".encode())
    return files


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("import", "import.ttl: line 3: the import <urn:nowhere> was not found"),
        ("circle", "circle.ttl: line 3 imports circle2.ttl"),
        ("syntax", "syntax.ttl: line 2"),
        ("entity", "entity.owl: line 3: the external XML entity 'secret' is refused"),
        ("bom", "bom.ttl: line 1: begins with a byte-order mark"),
    ],
)
def test_broken_ontologies(run: Any, broken: dict[str, Path], name: str, words: str) -> None:
    done = run("why", "inconsistent", "--ontology", broken[name])
    assert done.code == 2
    assert words in done.err
    assert "passwd" not in done.err
    assert done.out == ""


@pytest.mark.parametrize("name", ["import", "circle", "bom"])
def test_lenient(run: Any, broken: dict[str, Path], name: str) -> None:
    done = run("why", "inconsistent", "--ontology", broken[name], "--lenient-imports")
    assert done.code == 1


def test_bad_questions(run: Any, tmp_path: Path) -> None:
    for question, words in (
        ("Oven", "is not understood; ask 'House indicates Residential'"),
        ("Ovne indicates Kitchen", "did you mean Oven"),
        ("", "is not understood"),
    ):
        done = run("why", question, *ROOMS)
        assert done.code == 2
        assert words in done.err
    done = run("why", "inconsistent", "--ontology", tmp_path / "none.ttl")
    assert done.code == 2
    assert "none.ttl: No such file" in done.err


def test_pages_are_not_made_of_half_an_ontology(
    run: Any, broken: dict[str, Path], tmp_path: Path
) -> None:
    done = run("ontology", "docs", broken["import"], "--out", tmp_path / "pages")
    assert done.code == 2
    assert "import.ttl: line 3: the import <urn:nowhere> was not found" in done.err
    assert not (tmp_path / "pages").exists()
    lenient = ("--lenient-imports", "--out", tmp_path / "pages")
    assert run("ontology", "docs", broken["import"], *lenient).code == 0
