"""Why something follows: minimal sets of axioms with their file and line, in every format."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from rdflib import OWL, RDF, Graph, Namespace

from symboslam.errors import (
    InconsistentOntologyError,
    InputError,
    OntologySyntaxError,
    ReasonerError,
    UnknownNameError,
)
from symboslam.reasoning.axioms import split
from symboslam.reasoning.hermit import Hermit
from symboslam.reasoning.vocabulary import SL
from symboslam.reasoning.why import Justifications, why
from symboslam.reasoning.why_formats import as_json, as_text, as_turtle

ONTOLOGY = """@prefix : <https://example.org/x#> .
@prefix sl: <https://w3id.org/symboslam#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
<https://example.org/x> a owl:Ontology ; owl:imports <https://w3id.org/symboslam/core> .
:Town rdfs:subClassOf sl:Environment .
:Square rdfs:subClassOf sl:Place , [ owl:onProperty sl:partOf ; owl:someValuesFrom :Town ] .
:Street rdfs:subClassOf :Town .
:Shop a owl:Class ; rdfs:label "Corner shop"@en ; rdfs:subClassOf sl:StaticFeature .
:Bakery rdfs:subClassOf :Shop ,
    _:direct , _:square .
_:direct a owl:Restriction ; owl:onProperty sl:indicates ; owl:someValuesFrom :Town .
_:square a owl:Restriction ; owl:onProperty sl:indicates ; owl:someValuesFrom :Square .
[] a owl:Axiom ; owl:annotatedSource :Bakery ; owl:annotatedProperty rdfs:subClassOf ;
    owl:annotatedTarget _:direct ; sl:strength 0.75 ; rdfs:comment "Towns eat bread." .
:Ghost rdfs:subClassOf :Shop , :Town .
:GhostShop rdfs:subClassOf :Ghost .
"""
BAKERY = {"every Bakery indicates some Town"}
SQUARE = {
    "every Bakery indicates some Square",
    "every Square partOf some Town",
    "indicates of partOf implies indicates",
}


@pytest.fixture(scope="module")
def mine(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("why") / "mine.ttl"
    path.write_text(ONTOLOGY)
    return path


@pytest.fixture(scope="module")
def bakery(mine: Path) -> Justifications:
    return why("Bakery indicates Town", mine)


def texts(found: Justifications) -> list[set[str]]:
    return [{axiom.text for axiom in axioms} for axioms in found.sets]


def test_both_ways_are_found(hermit: None, bakery: Justifications) -> None:
    assert bakery.entailed
    assert bakery.complete
    assert texts(bakery) == [BAKERY, SQUARE]


def test_axioms_know_where_they_stand(hermit: None, bakery: Justifications, mine: Path) -> None:
    (direct,) = bakery.sets[0]
    assert direct.place == (str(mine), 11)
    assert (direct.strength, direct.reason) == (0.75, "Towns eat bread.")
    places = {axiom.text: axiom.place for axiom in bakery.sets[1]}
    assert places["every Square partOf some Town"] == (str(mine), 7)
    chain = places["indicates of partOf implies indicates"]
    assert chain is not None
    assert chain.file == "core.ttl"


@pytest.mark.parametrize(
    ("question", "expected"),
    [
        ("Street is a Place", ["every Street is a Town", "every Town is an Environment",
                               "every Environment is a Place"]),
        ("'Street' SubClassOf: Environment", ["every Street is a Town",
                                              "every Town is an Environment"]),
        ("corner shop subclassof sl:Feature", ["every Shop is a StaticFeature",
                                               "every StaticFeature is a Feature"]),
        ("<https://example.org/x#Ghost> is a Feature", None),
    ],
)  # fmt: skip
def test_subclass(hermit: None, mine: Path, question: str, expected: list[str] | None) -> None:
    found = why(question, mine, limit=8)
    assert found.entailed
    if expected is not None:
        assert set(expected) in texts(found)


def test_what_does_not_follow(hermit: None, mine: Path) -> None:
    for question in ("Bakery is a Town", "Street indicates Town", "Shop is unsatisfiable",
                     "inconsistent"):  # fmt: skip
        found = why(question, mine)
        assert not found.entailed
        assert found.complete
        assert "does not follow" in str(found)


def test_unsatisfiable(hermit: None, mine: Path) -> None:
    found = why("GhostShop is unsatisfiable", mine, limit=1)
    assert found.entailment.text == "GhostShop is unsatisfiable"
    assert texts(found) == [
        {
            "every GhostShop is a Ghost", "every Ghost is a Shop", "every Ghost is a Town",
            "every Shop is a StaticFeature", "every StaticFeature is a Feature",
            "every Town is an Environment", "every Environment is a Place",
            "no Feature is a Place",
        }
    ]  # fmt: skip


@pytest.mark.proof
def test_inconsistent(hermit: None, tmp_path: Path) -> None:
    path = tmp_path / "bad.ttl"
    path.write_text(ONTOLOGY + "\n:one a :Shop , :Town .\n:two a :Ghost .\n:fine a :Shop .\n")
    found = why("the ontology is inconsistent", path, limit=9)
    assert found.complete
    core = {
        "every Shop is a StaticFeature", "every StaticFeature is a Feature",
        "every Town is an Environment", "every Environment is a Place", "no Feature is a Place",
    }  # fmt: skip
    expected = [
        core | {"one is a Shop", "one is a Town"},
        core | {"two is a Ghost", "every Ghost is a Shop", "every Ghost is a Town"},
    ]
    assert texts(found) == expected


@pytest.mark.proof
def test_sets_are_minimal(hermit: None, mine: Path) -> None:
    """From each set it follows; from no set without one of its axioms does it."""
    found = why("Ghost is unsatisfiable", mine, limit=4)
    assert found.sets
    for axioms in found.sets:
        triples = [axiom.axiom.triples for axiom in axioms]
        fewer = [triples[:i] + triples[i + 1 :] for i in range(len(triples))]
        asked = [[t for one in kept for t in one] for kept in (triples, *fewer)]
        answers = Hermit().clashes(asked, "https://example.org/x#Ghost")
        assert answers == [True, *[False] * len(fewer)]


@pytest.mark.proof
def test_no_set_contains_another(hermit: None, tmp_path: Path) -> None:
    """A class without members is a kind of everything, which must not hide the direct axiom."""
    path = tmp_path / "ghost.ttl"
    path.write_text(
        ONTOLOGY.replace("_:direct a owl", ":Ghost rdfs:subClassOf :Park .\n_:direct a owl")
    )
    found = why("Ghost is a Park", path, limit=10)
    sets = texts(found)
    assert {"every Ghost is a Park"} in sets
    assert not any(one < other for one in sets for other in sets)
    assert all(len(one) > 3 for one in sets if one != {"every Ghost is a Park"})


@pytest.mark.proof
def test_everything_follows_from_a_contradiction(hermit: None, tmp_path: Path) -> None:
    path = tmp_path / "bad.ttl"
    path.write_text(ONTOLOGY + "\n:one a :Shop , :Town .\n")
    with pytest.raises(InconsistentOntologyError, match="everything follows"):
        why("Shop is a Town", path)


def test_ranges_of_numbers_are_told(hermit: None, tmp_path: Path) -> None:
    path = tmp_path / "age.ttl"
    prefixes = ONTOLOGY.partition("<https://example.org/x>")[0]
    adult = (
        "[ a rdfs:Datatype ; owl:onDatatype xsd:integer ; owl:withRestrictions ( [ xsd:%s %d ] ) ]"
    )
    path.write_text(
        f"{prefixes}@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .\n"
        ":age a owl:DatatypeProperty , owl:FunctionalProperty .\n:Odd rdfs:subClassOf "
        f"[ owl:onProperty :age ; owl:someValuesFrom {adult % ('minInclusive', 18)} ] , "
        f"[ owl:onProperty :age ; owl:allValuesFrom {adult % ('maxExclusive', 18)} ] ."
    )
    (one,) = texts(why("Odd is unsatisfiable", path))
    assert one == {"every Odd age some (integer >= 18)", "every Odd age only (integer < 18)"}


def test_what_always_holds(hermit: None, mine: Path) -> None:
    assert "holds in any ontology" in str(why("Shop is a Shop", mine))


def test_a_search_without_time_says_so(hermit: None, mine: Path) -> None:
    with pytest.raises(ReasonerError, match=r"within|longer than"):
        why("Ghost is unsatisfiable", mine, seconds=0.01)


def test_a_thing_said_twice_is_one_axiom(hermit: None, tmp_path: Path) -> None:
    path = tmp_path / "twice.ttl"
    prefixes = ONTOLOGY.partition("<https://example.org/x>")[0]
    path.write_text(
        f"{prefixes}:A owl:disjointWith :B . :B owl:disjointWith :A .\n:C rdfs:subClassOf :A , :B ."
    )
    found = why("C is unsatisfiable", path)
    assert found.complete
    assert len(found.sets) == 1


def test_text(hermit: None, bakery: Justifications, mine: Path) -> None:
    lines = as_text(bakery).splitlines()
    assert lines[0] == "Bakery indicates Town, because of these axioms (2 ways):"
    assert f"  every Bakery indicates some Town  [{mine}: line 11]" in lines
    assert "    strength 0.75: Towns eat bread." in lines


def test_json(hermit: None, bakery: Justifications, mine: Path) -> None:
    record = json.loads(as_json(bakery))
    assert record["entailed"] is True
    assert record["complete"] is True
    assert record["entailment"]["object"] == "https://example.org/x#Town"
    assert [len(j["axioms"]) for j in record["justifications"]] == [1, 3]
    (axiom,) = record["justifications"][0]["axioms"]
    assert axiom["file"] == str(mine)
    assert axiom["line"] == 11
    assert axiom["strength"] == 0.75
    assert axiom["subject"] == "https://example.org/x#Bakery"
    assert axiom["names"] == [
        "https://example.org/x#Bakery",
        "https://example.org/x#Town",
        SL + "indicates",
    ]


def test_turtle_can_be_reasoned_over(hermit: None, bakery: Justifications) -> None:
    sl = Namespace(SL)
    graph = Graph().parse(data=as_turtle(bakery), format="turtle", publicID="urn:why")
    ways = sorted(graph.subjects(RDF.type, sl.Justification), key=str)
    assert [len(list(graph.objects(way, sl.usesAxiom))) for way in ways] == [1, 3]
    assert {str(line) for line in graph.objects(None, sl.lineNumber)} >= {"11", "7"}
    stated = {axiom.text for axiom in split(graph)[1]}
    assert BAKERY | SQUARE <= stated | {"indicates of partOf implies indicates"}
    for note in graph.subjects(RDF.type, OWL.Axiom):
        subject, predicate, target = (
            graph.value(note, p)
            for p in (OWL.annotatedSource, OWL.annotatedProperty, OWL.annotatedTarget)
        )
        assert (subject, predicate, target) in graph


@pytest.mark.parametrize(
    ("question", "error", "message"),
    [
        ("Why?", InputError, "is not understood; ask 'House indicates Residential'"),
        ("", InputError, "is not understood"),
        ("Bakry indicates Town", UnknownNameError, "did you mean Bakery"),
        ("Bakery indicates https://example.org/x#Town", UnknownNameError, "there is no class"),
    ],
)
def test_bad_questions(mine: Path, question: str, error: type[Exception], message: str) -> None:
    with pytest.raises(error, match=message):
        why(question, mine)


def test_bad_input(mine: Path, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="No such file"):
        why("inconsistent", tmp_path / "none.ttl")
    with pytest.raises(InputError, match="at least 1"):
        why("inconsistent", mine, limit=0)
    (tmp_path / "bad.ttl").write_text("\n:a :b")
    with pytest.raises(OntologySyntaxError, match=r"bad\.ttl: line 2"):
        why("inconsistent", tmp_path / "bad.ttl")


def test_names_that_mean_several_things(tmp_path: Path) -> None:
    path = tmp_path / "two.ttl"
    prefixes = ONTOLOGY.partition("<https://example.org/x>")[0]
    path.write_text(
        f"{prefixes}<urn:a#Hut> a owl:Class .\n<urn:b#Hut> a owl:Class .\n:C a owl:Class ."
    )
    with pytest.raises(InputError, match="may mean <urn:a#Hut>, <urn:b#Hut>"):
        why("Hut is a C", path)
