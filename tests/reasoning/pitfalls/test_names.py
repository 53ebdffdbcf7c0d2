"""Names of terms fall into words, ours and OOPS!'s."""

from __future__ import annotations

from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st
from rdflib import Graph, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls import names
from symboslam.reasoning.pitfalls.model import NotCheckedError
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


def test_apart_is_all_or_nothing() -> None:
    a, b, c = (URIRef(x) for x in "abc")
    assert names.apart([c, a, b], {a: 1, b: 1}) == [a, b, c]
    assert names.apart([a, b], {}) == [a, b]
    assert names.apart([b, a], {a: 1, b: 1}) == []


def test_graphs_with_cycles() -> None:
    a, b, c = (URIRef(x) for x in "abc")
    assert [{*part} for part in names.strong([a], {a: [b], b: [a, c]})] == [{c}, {a, b}]
    part = names.components({a: [b], b: [a], c: []})
    assert part[a] == part[b] != part[c]


_TERMS = [URIRef(f"t{n}") for n in range(8)]
_GRAPHS = st.dictionaries(st.sampled_from(_TERMS), st.lists(st.sampled_from(_TERMS), max_size=3))


@pytest.mark.parametrize("bits", [3, 4096])
@given(
    steps=_GRAPHS,
    part=st.dictionaries(st.sampled_from(_TERMS), st.integers(0, 2)),
    disjoint=st.lists(st.lists(st.sampled_from(_TERMS), max_size=4), max_size=3),
    pairs=_GRAPHS,
    groups=st.lists(st.lists(st.sampled_from(_TERMS), unique=True, max_size=6), max_size=3),
    words=st.lists(st.integers(0, 3), min_size=8, max_size=8),
)
def test_relations_are_those_of_every_two_terms(
    bits: int,
    steps: dict[URIRef, list[URIRef]],
    part: dict[Node, int],
    disjoint: list[list[URIRef]],
    pairs: dict[URIRef, list[URIRef]],
    groups: list[list[URIRef]],
    words: list[int],
) -> None:
    word = dict(zip(_TERMS, map(str, words), strict=True))
    above = {t: {other for found in names.strong([t], steps) for other in found} for t in _TERMS}

    def related(one: URIRef, two: URIRef) -> bool:
        return (
            (one in part and part[one] == part.get(two))
            or one in above[two]
            or two in above[one]
            or two in pairs.get(one, ())
            or any(
                x != y
                for terms in disjoint
                for x in above[one].intersection(terms)
                for y in above[two].intersection(terms)
            )
        )

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(names, "_BITS", bits)
        found = names.Relations(part, steps, disjoint, pairs).unrelated(groups, word.__getitem__)
    assert found == [
        [a for a in group if any(word[a] != word[b] and not related(a, b) for b in group)]
        for group in groups
    ]


def test_many_related_terms_are_no_pairs() -> None:
    """Each way to be related, with so many terms that a look at every two would take minutes."""
    terms = [URIRef(f"t{n:05}") for n in range(20_000)]
    chain: dict[Node, list[Node]] = {a: [b] for a, b in pairwise(terms)}
    for relations in (
        names.Relations(names.components(chain), {}),
        names.Relations({}, chain),
        names.Relations({}, {}, [terms]),
    ):
        assert relations.unrelated([terms], str) == [[]]
    assert names.Relations({}, {}, [terms[1:]]).unrelated([terms], str) == [terms]


def test_groups_of_oops() -> None:
    a, b, c = (URIRef(x) for x in "abc")
    tags = {a: "A", b: "B", c: "C"}
    pairs = {a: {b}, b: {a, c}, c: {b}}
    assert names.oops_groups(tags, pairs.__getitem__) == [(a, b), (b, c)]


@given(
    pairs=st.fixed_dictionaries({t: st.sets(st.sampled_from(_TERMS)) for t in _TERMS}),
    tags=st.fixed_dictionaries({t: st.sampled_from("ABCDE") for t in _TERMS}),
)
def test_groups_of_oops_come_pair_by_pair(
    pairs: dict[URIRef, set[URIRef]], tags: dict[URIRef, str]
) -> None:
    groups: dict[str, set[URIRef]] = {}
    for term in sorted(pairs):
        for other in sorted(pairs[term]):
            if tags[other] not in groups:
                groups.setdefault(tags[term], set()).update((term, other))
    found = names.oops_groups(tags, pairs.__getitem__)
    assert found == [tuple(sorted(group)) for group in groups.values()]


def test_groups_of_oops_may_be_too_large(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(names, "_LARGEST", 20)
    terms = {*_TERMS}
    with pytest.raises(NotCheckedError, match="more than 20 terms"):
        names.oops_groups({t: str(t) for t in _TERMS}, lambda t: terms - {t})
