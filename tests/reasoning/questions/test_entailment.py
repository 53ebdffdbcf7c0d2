"""RDFS: rules by hand, and against owlrl on graphs made at random."""

from __future__ import annotations

import owlrl
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pyoxigraph import Quad, RdfFormat, Store, parse
from rdflib import RDF, RDFS, Graph, Literal, Namespace
from rdflib.compare import isomorphic

from symboslam.reasoning.questions.entailment import add_rdfs
from symboslam.reasoning.questions.rdf import graph_of, quads_of

X = Namespace("https://example.org/x#")
HEAD = f"@prefix : <{X}> . @prefix rdfs: <{RDFS}> . @prefix rdf: <{RDF}> .\n"
RULES = {
    "rdfs2": (":p rdfs:domain :C . :a :p 1 .", ":a a :C ."),
    "rdfs3": (":p rdfs:range :C . :a :p :b .", ":b a :C ."),
    "rdfs5": (
        ":p rdfs:subPropertyOf :q . :q rdfs:subPropertyOf :r .",
        ":p rdfs:subPropertyOf :r .",
    ),
    "rdfs7": (":p rdfs:subPropertyOf :q . :a :p 'x'@en .", ":a :q 'x'@en ."),
    "rdfs9": (":C rdfs:subClassOf :D . :a a :C .", ":a a :D ."),
    "rdfs11": (":C rdfs:subClassOf :D . :D rdfs:subClassOf :E .", ":C rdfs:subClassOf :E ."),
    "domain of a property above": (
        ":p rdfs:subPropertyOf :q . :q rdfs:domain :C . :C rdfs:subClassOf :D . :a :p :b .",
        ":a :q :b ; a :C , :D .",
    ),
    "a property above rdf:type": (
        ":kind rdfs:subPropertyOf rdf:type . :C rdfs:subClassOf :D . :a :kind :C .",
        ":a a :C , :D .",
    ),
    "a property above rdfs:subClassOf": (
        ":under rdfs:subPropertyOf rdfs:subClassOf . :C :under :D . :D :under :E . :a a :C .",
        ":C rdfs:subClassOf :D , :E . :D rdfs:subClassOf :E . :a a :D , :E .",
    ),
    "a literal has no class": (":p rdfs:range :C . :a :p 'b' .", ""),
    "anonymous": (":p rdfs:range :C . :a :p _:b .", "_:b a :C ."),
}


def quads(text: str) -> list[Quad]:
    return list(parse(HEAD + text, RdfFormat.TURTLE))


def closure(stated: list[Quad]) -> Store:
    store = Store()
    store.extend(stated)
    add_rdfs(store)
    return store


@pytest.mark.parametrize("rule", RULES)
def test_rules(rule: str) -> None:
    text, follows = RULES[rule]
    assert isomorphic(graph_of(closure(quads(text))), graph_of(quads(text + follows)))


def test_named_graphs_are_left_alone() -> None:
    store = Store()
    text = HEAD + ":C rdfs:subClassOf :D . :g { :a a :C }"
    store.extend(parse(text, RdfFormat.TRIG))
    add_rdfs(store)
    assert len(store) == 2


NAMES = st.sampled_from([X[name] for name in "abc"])
CLASSES = st.sampled_from([X[name] for name in "CDEF"])
PROPERTIES = st.sampled_from([X[name] for name in "pqr"])
STATEMENTS = st.one_of(
    st.tuples(CLASSES, st.just(RDFS.subClassOf), CLASSES),
    st.tuples(PROPERTIES, st.just(RDFS.subPropertyOf), PROPERTIES),
    st.tuples(PROPERTIES, st.sampled_from([RDFS.domain, RDFS.range]), CLASSES),
    st.tuples(NAMES, st.just(RDF.type), CLASSES),
    st.tuples(NAMES, PROPERTIES, NAMES | st.just(Literal("x"))),
)


@given(st.lists(STATEMENTS, max_size=14))
def test_as_owlrl_has_it(statements: list[tuple[object, ...]]) -> None:
    """All that owlrl finds about our names, but for what everything has."""
    graph = Graph()
    for statement in statements:
        graph.add(statement)  # type: ignore[arg-type]
    ours = set(graph_of(closure(quads_of(graph))))
    theirs = Graph() + graph
    owlrl.DeductiveClosure(owlrl.RDFS_Semantics).expand(theirs)
    relevant = {
        (s, p, o)
        for s, p, o in theirs
        if str(s).startswith(X)
        and (str(o).startswith(X) or isinstance(o, Literal))
        and not (p in (RDFS.subClassOf, RDFS.subPropertyOf) and s == o)  # reflexive
    }
    told = {t for t in ours if not (t[1] in (RDFS.subClassOf, RDFS.subPropertyOf) and t[0] == t[2])}
    assert told == relevant
