"""Axioms in words, and which of them have a say in a name."""

from __future__ import annotations

import pytest
from rdflib import OWL, RDF, Graph, URIRef

from symboslam.reasoning.axioms import Words, split
from symboslam.reasoning.locality import module

PREFIXES = """@prefix : <https://example.org/x#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
:p a owl:ObjectProperty . :q a owl:ObjectProperty . :note a owl:AnnotationProperty .
:size a owl:DatatypeProperty .
"""
SOME = "[ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom {} ]"


def graph_of(text: str) -> Graph:
    graph = Graph()
    graph.parse(data=PREFIXES + text, format="turtle")
    return graph


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (":A rdfs:subClassOf :Bee .", "every A is a Bee"),
        (":A rdfs:subClassOf :Ant .", "every A is an Ant"),
        (f":A rdfs:subClassOf {SOME.format(':B')} .", "every A p some B"),
        (
            f":A rdfs:subClassOf [ a owl:Class ; owl:unionOf ( :B {SOME.format(':C')} ) ] .",
            "every A is B or (p some C)",
        ),
        (
            f":A owl:equivalentClass [ owl:intersectionOf ( :B {SOME.format(':C')} ) ] .",
            "A is the same as: B and (p some C)",
        ),
        (
            ":A rdfs:subClassOf [ a owl:Class ; owl:complementOf :B ] .",
            "every A is not B",
        ),
        (
            ":A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty [ owl:inverseOf :p ] ; "
            'owl:qualifiedCardinality "2"^^xsd:nonNegativeInteger ; owl:onClass :B ] .',
            "every A inverse of p exactly 2 B",
        ),
        (
            ":A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ; "
            'owl:maxCardinality "1"^^xsd:nonNegativeInteger ] .',
            "every A p max 1 Thing",
        ),
        (
            ":A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ; owl:allValuesFrom :B ] .",
            "every A p only B",
        ),
        (
            ":A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ; owl:hasValue :b ] .",
            "every A p the b",
        ),
        (
            ":A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ; owl:hasSelf true ] .",
            "every A p itself",
        ),
        (":A owl:equivalentClass [ owl:oneOf ( :b :c ) ] .", "A is the same as: one of b, c"),
        (":A owl:disjointWith :B .", "no A is a B"),
        (":A owl:disjointUnionOf ( :B :C ) .", "A is the disjoint union of B, C"),
        ("[] a owl:AllDisjointClasses ; owl:members ( :A :B :C ) .", "A, B, C are disjoint"),
        ("[] a owl:AllDifferent ; owl:distinctMembers ( :a :b ) .", "a, b are all different"),
        (":p rdfs:domain :A .", "whatever p something is an A"),
        (":p rdfs:range :A .", "whatever something p is an A"),
        (":p rdfs:subPropertyOf :q .", "p implies q"),
        (":p owl:inverseOf :q .", "p is the inverse of q"),
        (":p owl:propertyChainAxiom ( :p :q ) .", "p of q implies p"),
        (":p a owl:TransitiveProperty .", "p is transitive"),
        (":a a :A .", "a is an A"),
        (":a :p :b .", "a p b"),
        (":a :size 3 .", "a size 3"),
        (":a owl:sameAs :b .", "a is the same as b"),
    ],
)  # fmt: skip
def test_words(text: str, words: str) -> None:
    _, axioms = split(graph_of(text))
    assert [axiom.text for axiom in axioms] == [words]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("[] a owl:AllDisjointClasses ; owl:members ( :A :B :C :D :E ) .",
         "A, B, C and 2 more are disjoint"),
        ("[] a owl:AllDisjointClasses ; owl:members ( :A :B :C ) .", "A, B, C are disjoint"),
        (":A owl:disjointUnionOf ( :B :C :D :E ) .",
         "A is the disjoint union of B, C and 2 more"),
        (":p owl:propertyChainAxiom ( :p :q :p :q ) .", "p of q of p of 1 more implies p"),
        (":A rdfs:subClassOf [ owl:unionOf ( :B [ owl:intersectionOf ( :C :D ) ] :E ) ] .",
         "every A is B or 2 more"),
        (":A rdfs:subClassOf [ owl:complementOf [ owl:complementOf [ owl:complementOf :B ] ] ] .",
         "every A is not (not ...)"),
    ],
)  # fmt: skip
def test_words_cut_short(text: str, words: str) -> None:
    graph = graph_of(text)
    _, axioms = split(graph)
    short = Words(graph, limit=3)
    assert [short.axiom(axiom) for axiom in axioms] == [words]
    assert [short.axiom(axiom) for axiom in axioms] == [words]


def test_annotations_are_no_axioms() -> None:
    text = """
    <urn:o> a owl:Ontology ; owl:imports <urn:other> .
    :A a owl:Class ; rdfs:label "A" ; :note :B ; rdfs:subClassOf :B .
    :note rdfs:subPropertyOf rdfs:comment ; rdfs:range xsd:string .
    [] a owl:Axiom ; owl:annotatedSource :A ; owl:annotatedProperty rdfs:subClassOf ;
       owl:annotatedTarget :B ; rdfs:comment "why" .
    """
    declared, axioms = split(graph_of(text))
    assert [axiom.text for axiom in axioms] == ["every A is a B"]
    classes = {str(s) for s, _, o in declared if o == OWL.Class}
    assert classes == {"https://example.org/x#A", "https://example.org/x#B"}


def test_fillers_are_declared() -> None:
    declared, _ = split(graph_of(f":A rdfs:subClassOf {SOME.format(':B')} ."))
    assert (URIRef("https://example.org/x#B"), RDF.type, OWL.Class) in declared


def test_an_annotated_block_is_one_axiom() -> None:
    text = """
    _:d a owl:AllDisjointClasses ; owl:members ( :A :B ) .
    [] a owl:Axiom ; owl:annotatedSource _:d ; owl:annotatedProperty rdf:type ;
       owl:annotatedTarget owl:AllDisjointClasses ; rdfs:comment "why" .
    """
    _, axioms = split(graph_of(text))
    assert [axiom.text for axiom in axioms] == ["A, B are disjoint"]
    assert len(axioms[0].triples) == 6


def test_module() -> None:
    text = f"""
    :A rdfs:subClassOf :B .  :B rdfs:subClassOf {SOME.format(":C")} .  :C rdfs:subClassOf :D .
    :p rdfs:domain :E .  :q rdfs:domain :F .  :p rdfs:subPropertyOf :q .
    :D owl:disjointWith :G .  :G rdfs:subClassOf :A .
    :X rdfs:subClassOf :A .  [] a owl:AllDisjointClasses ; owl:members ( :B :X :Y ) .
    """
    _, axioms = split(graph_of(text))

    def of(*names: str) -> set[str]:
        return {a.text for a in module(axioms, [f"https://example.org/x#{n}" for n in names])}

    of_a = {
        "every A is a B",
        "every B p some C",
        "every C is a D",
        "whatever p something is an E",
        "p implies q",
        "whatever q something is a F",
    }
    assert of("A") == of_a
    assert of("D") == of("E") == set()
    assert of("G") == {*of_a, "every G is an A", "no D is a G"}
    assert of("X") == {*of_a, "every X is an A", "B, X, Y are disjoint"}
