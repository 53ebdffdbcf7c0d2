"""Whether two class expressions, or two lists of domains, say the same."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from rdflib import RDFS, URIRef

from symboslam.reasoning.pitfalls.groups import oops_equal_all, oops_same, same, same_all
from symboslam.reasoning.pitfalls.model import Settings, Status
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.pitfalls.scan import load
from tests.reasoning.pitfalls.conftest import PREFIXES

P, Q = (URIRef("https://example.org/o#" + name) for name in "pq")
SOME = "[ owl:onProperty :r ; owl:someValuesFrom "

SAME = {
    "one class": (":A", ":A", ""),
    "stated the other way round": (":A", ":B", ":B owl:equivalentClass :A ."),
    "sameAs": (":A", ":B", ":A owl:sameAs :B ."),
    "over a third": (":A", ":B", ":A owl:equivalentClass :C . :B owl:equivalentClass :C ."),
    "or in another order": ("[owl:unionOf (:A :B)]", "[owl:unionOf (:B :A)]", ""),
    "and in another order": ("[owl:intersectionOf (:A :B)]", "[owl:intersectionOf (:B :A)]", ""),
    "several mean their intersection": (":A, :B", "[owl:intersectionOf (:B :A)]", ""),
    "nested": (
        "[owl:unionOf (:A [owl:unionOf (:B :C)])]",
        "[owl:unionOf ([owl:unionOf (:C :A)] :B)]",
        "",
    ),
    "of one": ("[owl:unionOf (:A)]", ":A", ""),
    "parts that are equivalent": (f"{SOME} :A ]", f"{SOME} :B ]", ":A owl:equivalentClass :B ."),
    "a definition": (
        ":A",
        "[owl:unionOf (:C :B)]",
        ":A owl:equivalentClass [owl:unionOf (:B :C)].",
    ),
    "a definition without an axiom": (":A", "[owl:unionOf (:C :B)]", ":A owl:unionOf (:B :C) ."),
    "a disjoint union": (":A", "[owl:unionOf (:C :B)]", ":A owl:disjointUnionOf (:B :C) ."),
    "two with like definitions": (
        ":A",
        ":B",
        f":A owl:equivalentClass {SOME} :C ] . :B owl:equivalentClass {SOME} :D ] . "
        ":C owl:equivalentClass :D .",
    ),
    "owl:Thing adds nothing": (":A, owl:Thing", ":A", ""),
    "qualified by owl:Thing": (
        "[owl:onProperty :r ; owl:minCardinality 1]",
        "[owl:onProperty :r ; owl:minQualifiedCardinality 1 ; owl:onClass owl:Thing]",
        "",
    ),
    "one or more, and some": (
        "[owl:onProperty :r ; owl:minCardinality 1]",
        "[owl:onProperty :r ; owl:someValuesFrom owl:Thing]",
        "",
    ),
    "one or more of a class, and some": (
        "[owl:onProperty :r ; owl:onClass :A ; owl:minQualifiedCardinality 1]",
        f"{SOME} :A ]",
        "",
    ),
    "one or more values": (
        "[owl:onProperty :r ; owl:minQualifiedCardinality 1 ; owl:onDataRange rdfs:Literal]",
        "[owl:onProperty :r ; owl:someValuesFrom rdfs:Literal]",
        "",
    ),
    "none or more": ("[owl:onProperty :r ; owl:minCardinality 0]", "owl:Thing", ""),
    "a number of another datatype": (
        '[owl:onProperty :r ; owl:maxCardinality "2"^^xsd:nonNegativeInteger]',
        "[owl:onProperty :r ; owl:maxCardinality 02]",
        "",
    ),
    "values in another order": ('[owl:oneOf ("a" "b")]', '[owl:oneOf ("b" "a")]', ""),
    "facets in another order": (
        "[owl:onDatatype xsd:int; owl:withRestrictions ([xsd:minInclusive 1][xsd:maxInclusive 2])]",
        "[owl:onDatatype xsd:int; owl:withRestrictions ([xsd:maxInclusive 2][xsd:minInclusive 1])]",
        "",
    ),
}
DIFFERENT = {
    "two classes": (":A", ":B", ""),
    "and for or": ("[owl:unionOf (:A :B)]", "[owl:intersectionOf (:A :B)]", ""),
    "a part of it": ("[owl:unionOf (:A :B)]", "[owl:unionOf (:A :C)]", ""),
    "some for only": (f"{SOME} :A ]", "[owl:onProperty :r ; owl:allValuesFrom :A ]", ""),
    "another property": (f"{SOME} :A ]", "[owl:onProperty :s ; owl:someValuesFrom :A ]", ""),
    "a subclass": (":A", ":B", ":A rdfs:subClassOf :B ."),
    "not": (":A", "[owl:complementOf :A]", ""),
    "two empty nodes": ("[]", "[]", ""),
    "union with everything": (":A", "[owl:unionOf (:A owl:Thing)]", ""),
    "one or more of another class": (
        "[owl:onProperty :r ; owl:onClass :A ; owl:minQualifiedCardinality 1]",
        f"{SOME} :B ]",
        "",
    ),
    "two or more, and some": (
        "[owl:onProperty :r ; owl:onClass :A ; owl:minQualifiedCardinality 2]",
        f"{SOME} :A ]",
        "",
    ),
    "one at most, and some": (
        "[owl:onProperty :r ; owl:maxCardinality 1]",
        "[owl:onProperty :r ; owl:someValuesFrom owl:Thing]",
        "",
    ),
    "ten and one": (
        "[owl:onProperty :r ; owl:minCardinality 10]",
        "[owl:onProperty :r ; owl:minCardinality 1]",
        "",
    ),
    "another number": (
        "[owl:onProperty :r ; owl:minCardinality 1]",
        "[owl:onProperty :r ; owl:minCardinality 2]",
        "",
    ),
}


def ends(tmp_path: Path, one: str, other: str, more: str) -> tuple[Ontology, Any, Any]:
    path = tmp_path / "ontology.ttl"
    path.write_text(f"{PREFIXES}:p rdfs:domain {one} .\n:q rdfs:domain {other} .\n{more}\n")
    ontology = load([path], True, True)
    return ontology, ontology.objects(P, RDFS.domain), ontology.objects(Q, RDFS.domain)


@pytest.mark.parametrize("name", SAME)
def test_same(tmp_path: Path, name: str) -> None:
    ontology, ones, others = ends(tmp_path, *SAME[name])
    assert same_all(ontology, ones, others)
    assert same_all(ontology, others, ones)
    if len(ones) == len(others) == 1:
        assert same(ontology, ones[0], others[0])


@pytest.mark.parametrize("name", DIFFERENT)
def test_different(tmp_path: Path, name: str) -> None:
    ontology, ones, others = ends(tmp_path, *DIFFERENT[name])
    assert not same_all(ontology, ones, others)
    assert not same(ontology, ones[0], others[0])


OOPS_EQUAL = {
    "or in another order": ("[owl:unionOf (:A :B)]", "[owl:unionOf (:B :A)]", True),
    "or of others": ("[owl:unionOf (:A :B)]", "[owl:unionOf (:B :C)]", False),
    "or of more": ("[owl:unionOf (:A :B)]", "[owl:unionOf (:B :A :C)]", False),
    "and never": ("[owl:intersectionOf (:A :B)]", "[owl:intersectionOf (:A :B)]", False),
    "some": (f"{SOME} :A ]", f"{SOME} :A ]", True),
    "some of another": (f"{SOME} :A ]", f"{SOME} :B ]", False),
    "some for only": (f"{SOME} :A ]", "[owl:onProperty :r ; owl:allValuesFrom :A ]", False),
    "another property": (f"{SOME} :A ]", "[owl:onProperty :s ; owl:someValuesFrom :A ]", False),
    "a value": (
        "[owl:onProperty :r ; owl:hasValue :x]",
        "[owl:onProperty :r ; owl:hasValue :x]",
        True,
    ),
    "a number": (
        "[owl:onProperty :r ; owl:cardinality 1]",
        "[owl:onProperty :r ; owl:cardinality 2]",
        False,
    ),
    "several in another order": (":A, :B", ":B, :A", True),
    "fewer": (":A, :B", ":A", False),
}


@pytest.mark.parametrize("name", OOPS_EQUAL)
def test_oops_equal(tmp_path: Path, name: str) -> None:
    one, other, equal = OOPS_EQUAL[name]
    ontology, ones, others = ends(tmp_path, one, other, "")
    assert oops_equal_all(ontology, ones, others) is equal


def test_oops_same(tmp_path: Path) -> None:
    ontology, ones, others = ends(tmp_path, ":A", ":B", ":B owl:equivalentClass :A .")
    assert oops_same(ontology, ones, others)
    assert oops_same(ontology, others, ones)
    ontology, ones, others = ends(tmp_path, ":A, :B", ":A, :B", "")
    assert not oops_same(ontology, ones, others)
    ontology, ones, others = ends(tmp_path, "[owl:unionOf (:A)]", ":A", "")
    assert not oops_same(ontology, ones, others)


def test_where_oops_stops_at_several_domains(scan_text: Any) -> None:
    body = (
        ":p a owl:ObjectProperty ; rdfs:domain [ a owl:Class ; owl:unionOf (:A :B) ] , "
        "[ a owl:Class ; owl:unionOf (:B :A) ] . :A a owl:Class . :B a owl:Class ."
    )
    report = scan_text(body, Settings(strict_oops=True), codes=["P19"])
    result = next(r for r in report.results if r.pitfall.code == "P19")
    assert result.status is Status.NOT_CHECKED
    assert result.reason.startswith("OOPS! itself stops here without saying so: ")


def test_message_and_mend_of_several_domains(scan_text: Any) -> None:
    body = (
        ":p a owl:ObjectProperty ; rdfs:domain :B ;\n  rdfs:domain :A .\n"
        ":A a owl:Class ; rdfs:subClassOf :B . :B a owl:Class ."
    )
    report = scan_text(body, codes=["P19"])
    (found,) = next(r for r in report.results if r.pitfall.code == "P19").occurrences
    assert found.place.line == 11
    assert found.finding.message == (
        "p has 2 domains, and whatever it joins belongs to all of them: A and B"
    )
    assert found.finding.mend == "Remove A if any B will do, else B, which adds nothing."
