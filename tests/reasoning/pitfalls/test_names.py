"""Names of terms fall into words, ours and OOPS!'s."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rdflib import Graph, URIRef

from symboslam.reasoning.pitfalls import names
from symboslam.reasoning.pitfalls.ontology import Document, Ontology
from symboslam.reasoning.sources import Sources


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("BedAndBreakfast", ["Bed", "And", "Breakfast"]),
        ("HTTPServer", ["HTTP", "Server"]),
        ("parseXML", ["parse", "XML"]),
        ("Http2Server", ["Http", "2", "Server"]),
        ("has-part_of town", ["has", "part", "of", "town"]),
        ("ÉcoleÉlémentaire", ["École", "Élémentaire"]),
        ("_x_", ["x"]),
        ("家", ["家"]),
        ("", []),
    ],
)
def test_tokens(name: str, words: list[str]) -> None:
    assert names.tokens(name) == words


@given(st.text())
def test_tokens_keep_all_letters(name: str) -> None:
    kept = [c for c in name if c.isalpha() or c.isdigit()]
    assert "".join(names.tokens(name)) == "".join(kept)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("BedAndBreakfast", ["Bed", "And", "Breakfast"]),
        ("HTTPServer", ["H", "T", "T", "P", "Server"]),
        ("has_part-of", ["has", "part-of"]),
        ("has-Part", ["has", "Part"]),
        ("_FooBar", ["Foo", "Bar"]),
        ("a_", ["a"]),
        ("Room2b", ["Roomb"]),
    ],
)
def test_oops_tokens(name: str, words: list[str]) -> None:
    assert names.oops_tokens(name) == words


@pytest.mark.parametrize(
    ("iri", "name"),
    [
        ("http://e.org/o#A", "A"),
        ("http://e.org/o#4Seasons", "Seasons"),
        ("http://e.org/o/a.b-c", "a.b-c"),
        ("http://e.org/o#", ""),
        ("http://e.org/o#a:b", "b"),
    ],
)
def test_oops_name(iri: str, name: str) -> None:
    assert names.oops_name(iri) == name


def test_oops_words_are_letters() -> None:
    assert names.oops_words("Zone 12, TVSet@en") == ["Zone", "TV", "Set", "en"]


def test_forms() -> None:
    assert names.phrase("RailwayLine_2") == "railway line 2"
    assert names.squashed("has-Part_Of") == "haspartof"
    assert names.normal_label("  Four_Seasons -  C++ ") == "four seasons c++"
    assert names.is_code("ENVO_00000428")
    assert not names.is_code("Area51")


def test_english() -> None:
    graph = Graph().parse(
        data="""@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
        @prefix : <http://e.org/o#> .
        :A rdfs:label "none", "river"@en, "rio"@pt . :B rdfs:label "none", "rio"@pt .
        :C rdfs:label "rio"@pt, " " . :E_0001 rdfs:label "big river"@en-GB ."""
    )
    ontology = Ontology(Sources(graph), [Document("o", graph, None, True)])
    found = [names.english(ontology, URIRef(f"http://e.org/o#{name}")) for name in "ABC"]
    assert found == ["river", "none", "C"]
    assert names.spoken(ontology, URIRef("http://e.org/o#E_0001")) == "big river"
    assert names.spoken(ontology, URIRef("http://e.org/o#A")) == "A"
    assert names.oops_tag(ontology, URIRef("http://e.org/o#E_0001")) == "BigRiver"
    assert names.oops_tag(ontology, URIRef("http://e.org/o#B")) == "B"


def test_apart_leaves_out_what_is_related_to_all() -> None:
    a, b, c = (URIRef(x) for x in "abc")
    assert names.apart([c, a, b], lambda x, y: c in (x, y)) == [a, b]
    assert names.apart([a, b], lambda x, y: True) == []


def test_graphs_with_cycles() -> None:
    a, b, c = (URIRef(x) for x in "abc")
    assert names.above(a, {a: [b], b: [a, c]}) == {a, b, c}
    part = names.components({a: [b], b: [a], c: []})
    assert part[a] == part[b] != part[c]


def test_groups_of_oops() -> None:
    a, b, c = (URIRef(x) for x in "abc")
    tags = {a: "A", b: "B", c: "C"}
    assert names.oops_groups(tags, {a: [b], b: [a, c], c: [b]}) == [(a, b), (b, c)]
