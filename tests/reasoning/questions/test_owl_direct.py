"""What HermiT says about individuals, and how it becomes triples."""

from __future__ import annotations

from pyoxigraph import NamedNode, RdfFormat, parse
from rdflib import Graph

from symboslam.reasoning.axioms import split
from symboslam.reasoning.hermit import Hermit
from symboslam.reasoning.questions.owl_direct import Logic, realize, triples_of

X = "https://example.org/x#"
HEAD = f"""@prefix : <{X}> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
"""
OWN = """
:Animal a owl:Class . :Cow a owl:Class ; rdfs:subClassOf :Animal . :Bull a owl:Class .
:Ox a owl:Class ; owl:equivalentClass :Bull . :Barn a owl:Class .
:Grazed a owl:Class ; owl:equivalentClass
  [ a owl:Restriction ; owl:onProperty :holds ; owl:someValuesFrom :Animal ] .
:isIn a owl:ObjectProperty , owl:TransitiveProperty .
:holds a owl:ObjectProperty ; owl:inverseOf :isIn .
:sleepsIn a owl:ObjectProperty ; rdfs:subPropertyOf :isIn .
:owns a owl:ObjectProperty ; owl:propertyChainAxiom ( :leases :holds ) .
:leases a owl:ObjectProperty .
:knows a owl:ObjectProperty , owl:SymmetricProperty .
:Ghost a owl:Class ; rdfs:subClassOf :Cow , [ a owl:Class ; owl:complementOf :Cow ] .
:Unrelated a owl:Class ; rdfs:subClassOf :Other . :Other a owl:Class .
"""
DATA = """
:bella a :Cow ; :sleepsIn :stall ; :knows :otto . :stall :isIn :barn . :barn a :Barn .
:otto a :Ox . :farmer :leases :barn .
"""


def logic(text: str) -> Logic:
    graph = Graph()
    graph.parse(data=HEAD + text, format="turtle")
    return Logic.of(graph)


def test_realize(hermit: None) -> None:
    graph = Graph()
    graph.parse(data=HEAD + OWN + DATA, format="turtle")
    declared, axioms = split(graph)
    found = Hermit().realize([*declared, *(t for a in axioms for t in a.triples)])
    assert found is not None
    assert found.hierarchy.unsatisfiable == {X + "Ghost"}
    assert found.types[X + "bella"] == {X + "Cow"}
    assert found.types[X + "barn"] == {X + "Barn", X + "Grazed"}
    assert found.types[X + "stall"] == {X + "Grazed"}
    assert X + "farmer" not in found.types
    assert (X + "stall", X + "isIn", X + "barn") in found.values
    assert (X + "sleepsIn", X + "isIn") in found.properties
    assert {(X + "holds", X + "isIn"), (X + "isIn", X + "holds")} <= found.inverses
    clash = Graph()
    clash.parse(data=HEAD + OWN + ":x a :Ghost .", format="turtle")
    declared, axioms = split(clash)
    assert Hermit().realize([*declared, *(t for a in axioms for t in a.triples)]) is None


def test_triples(hermit: None) -> None:
    own = logic(OWN)
    both = own.with_data(parse(HEAD + DATA, RdfFormat.TURTLE))
    hermit_ = Hermit()
    hierarchy, found = hermit_.classify(own.all()), realize(both, hermit_)
    assert hierarchy is not None
    assert found is not None
    triples = {
        tuple(term.value.removeprefix(X) for term in (t.subject, t.predicate, t.object))
        for t in triples_of(hierarchy, found)
        if isinstance(t.subject, NamedNode) and isinstance(t.object, NamedNode)
    }
    told = {(s, p.rpartition("#")[2], o.rpartition("#")[2]) for s, p, o in triples}
    assert {
        ("bella", "type", "Animal"),
        ("otto", "type", "Bull"),
        ("barn", "type", "Grazed"),
        ("bella", "isIn", "stall"),
        ("bella", "isIn", "barn"),
        ("barn", "holds", "bella"),
        ("farmer", "owns", "bella"),
        ("otto", "knows", "bella"),
        ("Cow", "subClassOf", "Animal"),
        ("Ox", "equivalentClass", "Bull"),
        ("Ox", "subClassOf", "Bull"),
        ("Ghost", "subClassOf", "Nothing"),
        ("Unrelated", "subClassOf", "Other"),
    } <= told
    assert ("bella", "type", "Bull") not in told
    assert ("bella", "owns", "barn") not in told


def test_only_the_module_of_the_data_is_reasoned_over() -> None:
    both = logic(OWN).with_data(parse(HEAD + DATA, RdfFormat.TURTLE))
    named = {
        str(term) for triple in both.module() if triple not in both.declared for term in triple
    }
    assert X + "Grazed" in named
    assert X + "Unrelated" not in named
    assert X + "Ghost" not in named


def test_members_of_classes() -> None:
    assert not logic(OWN).has_members
    assert logic(OWN + ":Two owl:equivalentClass [ owl:oneOf ( :a :b ) ] .").has_members
    restriction = "[ a owl:Restriction ; owl:onProperty :isIn ; owl:hasValue :barn ]"
    assert logic(OWN + f":InBarn owl:equivalentClass {restriction} .").has_members
