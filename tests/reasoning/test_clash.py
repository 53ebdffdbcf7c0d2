"""Ontologies that contradict themselves are refused with the axioms that clash."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from rdflib import Graph

from symboslam.errors import InconsistentOntologyError
from symboslam.reasoning import clash
from symboslam.reasoning.axioms import split
from symboslam.reasoning.hermit import Hermit
from symboslam.reasoning.knowledge import Knowledge

Resource = Callable[[str], Path]
PREFIXES = """@prefix : <https://example.org/x#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
"""


def test_unsatisfiable_class(hermit: None, resource: Resource) -> None:
    with pytest.raises(InconsistentOntologyError) as caught:
        Knowledge.load(resource("invalid_unsatisfiable.ttl"))
    error = caught.value
    assert error.classes == ("https://example.org/x#Bungalow", "https://example.org/x#House")
    # House indicates Home, so it is a Feature by the domain of indicates as well as by Building;
    # either is a smallest explanation.
    assert {
        "every House is a Home",
        "every Home is an Environment",
        "no Feature is a Place",
    } <= set(error.axioms)
    assert len(error.axioms) in (6, 7)
    assert not any("Tower" in axiom or "Bungalow" in axiom for axiom in error.axioms)
    assert str(error).startswith(
        "2 classes can have no members (Bungalow, House); for House these axioms clash:\n  every "
    )


@pytest.mark.proof
def test_inconsistent_ontology(hermit: None, resource: Resource) -> None:
    with pytest.raises(InconsistentOntologyError) as caught:
        Knowledge.load(resource("invalid_inconsistent.ttl"))
    error = caught.value
    assert error.classes == ()
    assert {"house1 is a House", "house1 is a Home", "no Feature is a Place"} <= set(error.axioms)
    assert not any("tree1" in axiom for axiom in error.axioms)
    assert str(error).startswith("the ontology is inconsistent; these axioms clash:\n  every ")


def _explain(text: str, unsatisfiable: str | None) -> set[str]:
    graph = Graph()
    graph.parse(data=PREFIXES + text, format="turtle")
    declared, axioms = split(graph)
    return {a.text for a in clash.explain(Hermit(), declared, axioms, unsatisfiable)}


def test_large_ontology(hermit: None) -> None:
    """A clash by disjointness among 300 classes is reduced to the few axioms behind it."""
    text = "".join(f":C{i} a owl:Class ; rdfs:subClassOf :C{i // 2} .\n" for i in range(2, 300))
    text += (
        ":C1 a owl:Class . :C4 owl:disjointWith :C5 . :Bad rdfs:subClassOf :C17 , :C11 .\n"
        ":C100 rdfs:subClassOf [ owl:onProperty :p ; owl:someValuesFrom :C200 ] .\n"
        ":p a owl:ObjectProperty ; rdfs:domain :C1 .\n"
    )
    assert _explain(text, "https://example.org/x#Bad") == {
        "every Bad is a C17",
        "every Bad is a C11",
        "every C17 is a C8",
        "every C8 is a C4",
        "every C11 is a C5",
        "no C4 is a C5",
    }


def test_clash_of_cardinalities(hermit: None) -> None:
    text = """
    :p a owl:ObjectProperty , owl:FunctionalProperty ; rdfs:range :R . :R a owl:Class .
    :A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom :B ] ,
                       [ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom :C ] ,
                       [ a owl:Restriction ; owl:onProperty :p ; owl:allValuesFrom :D ] .
    [] a owl:AllDisjointClasses ; owl:members ( :B :C :E ) .
    """
    assert _explain(text, "https://example.org/x#A") == {
        "p has at most one value",
        "every A p some B",
        "every A p some C",
        "B, C, E are disjoint",
    }


def test_clash_of_individuals(hermit: None) -> None:
    text = """
    :p a owl:ObjectProperty , owl:FunctionalProperty .
    :q a owl:ObjectProperty ; rdfs:subPropertyOf :p .
    :x :p :y . :x :q :z . :x :q :y .
    [] a owl:AllDifferent ; owl:distinctMembers ( :y :z ) .
    :other a :Thing .
    """
    found = _explain(text, None)
    assert {"p has at most one value", "q implies p", "x q z", "y, z are all different"} <= found
    assert len(found) == 5  # and one of x p y, x q y


def test_no_time_left(hermit: None, resource: Resource) -> None:
    """Without time to shrink it, the module is named: more than the fewest, yet not everything."""
    text = ":A rdfs:subClassOf :B , :C , :D . :B owl:disjointWith :C . :E rdfs:subClassOf :A ."
    graph = Graph()
    graph.parse(data=PREFIXES + text, format="turtle")
    declared, axioms = split(graph)
    bad = "https://example.org/x#A"
    found = {a.text for a in clash.explain(Hermit(), declared, axioms, bad, seconds=0)}
    assert found == {"every A is a B", "every A is a C", "every A is a D", "no B is a C"}
