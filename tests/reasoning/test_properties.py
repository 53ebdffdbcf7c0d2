"""What holds for every ontology: random ones, with the stated hierarchy as the inferred one."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from rdflib import OWL, RDF, RDFS, BNode, Graph, Literal, URIRef

from symboslam.reasoning import store
from symboslam.reasoning import vocabulary as v
from symboslam.reasoning._base import Hierarchy
from symboslam.reasoning.classes import Classes
from symboslam.reasoning.extract import extract
from symboslam.reasoning.knowledge import Knowledge
from symboslam.reasoning.proximity import MEASURES, Way
from symboslam.reasoning.statements import Statements
from symboslam.reasoning.taxonomy import Taxonomy

X = "https://example.org/x#"
Links = list[tuple[int, int]]


@dataclass
class Ontology:
    """A random ontology: ``(a, b)`` of two features or places means that a is below b."""

    features: int
    places: int
    environments: int  # the first places
    kinds: Links
    places_kinds: Links
    parts: Links
    indications: dict[tuple[int, int], float]

    def graph(self) -> Graph:
        graph = Graph()

        def restriction(prop: str, filler: str) -> BNode:
            node = BNode()
            graph.add((node, RDF.type, OWL.Restriction))
            graph.add((node, OWL.onProperty, URIRef(prop)))
            graph.add((node, OWL.someValuesFrom, URIRef(filler)))
            return node

        def below(name: str, parent: str | BNode) -> None:
            above = parent if isinstance(parent, BNode) else URIRef(parent)
            graph.add((URIRef(name), RDFS.subClassOf, above))

        below(v.STATIC_FEATURE, v.FEATURE)
        below(v.ENVIRONMENT, v.PLACE)
        for f in range(self.features):
            below(f"{X}F{f}", v.STATIC_FEATURE)
            graph.add((URIRef(f"{X}F{f}"), URIRef(v.DETECTOR_LABEL), Literal(f"F{f}")))
        for p in range(self.places):
            below(f"{X}P{p}", v.ENVIRONMENT if p < self.environments else v.PLACE)
        for low, high in self.kinds:
            below(f"{X}F{low}", f"{X}F{high}")
        for low, high in self.places_kinds:
            below(f"{X}P{low}", f"{X}P{high}")
        for low, high in self.parts:
            below(f"{X}P{low}", restriction(v.PART_OF, f"{X}P{high}"))
        for (f, p), strength in self.indications.items():
            node = restriction(v.INDICATES, f"{X}P{p}")
            below(f"{X}F{f}", node)
            axiom = BNode()
            graph.add((axiom, OWL.annotatedSource, URIRef(f"{X}F{f}")))
            graph.add((axiom, OWL.annotatedProperty, RDFS.subClassOf))
            graph.add((axiom, OWL.annotatedTarget, node))
            graph.add((axiom, URIRef(v.STRENGTH), Literal(strength)))
        return graph

    def knowledge(self) -> Knowledge:
        return extract(Classes(Statements(self.graph()), Hierarchy({}, {}, frozenset())))


@st.composite
def ontologies(draw: st.DrawFn) -> Ontology:
    features = draw(st.integers(1, 6))
    environments = draw(st.integers(1, 4))
    places = environments + draw(st.integers(0, 4))

    def links(low: int, first: int, high: int) -> st.SearchStrategy[Links]:
        pairs = [(a, b) for a in range(low, high) for b in range(first, a)]
        return st.lists(st.sampled_from(pairs), max_size=6, unique=True) if pairs else st.just([])

    targets = st.tuples(st.integers(0, features - 1), st.integers(0, places - 1))
    strengths = st.floats(0.01, 1.0)
    return Ontology(
        features,
        places,
        environments,
        draw(links(0, 0, features)),
        draw(links(environments, 0, places)),
        draw(links(environments, 0, places)),
        # One that surely leads to an environment, and others that may.
        {(0, 0): draw(strengths), **draw(st.dictionaries(targets, strengths, max_size=6))},
    )


@settings(max_examples=60, deadline=None)
@given(ontologies())
def test_ranges(ontology: Ontology) -> None:
    knowledge = ontology.knowledge()
    path = knowledge.proximity("path")
    assert path.shape == (ontology.features, ontology.environments)
    for measure in MEASURES:
        proximity = knowledge.proximity(measure)
        assert proximity.min() >= 0
        assert proximity.max() <= 1
        assert not proximity[path == 0].any()
        importance = knowledge.importance(measure)
        assert importance.min() >= 0
        assert importance.max() <= 1
        assert not importance[~proximity.any(axis=1)].any()
    assert (knowledge.proximity("wu_palmer")[path > 0] > 0).all()
    for (f, p), strength in ontology.indications.items():
        if p < ontology.environments:  # a direct link
            assert all(knowledge.proximity(m)[f, p] >= strength - 1e-12 for m in MEASURES)
            assert knowledge.direct()[f, p] == 1


@settings(max_examples=60, deadline=None)
@given(ontologies())
def test_table_agrees_with_the_ways(ontology: Ontology) -> None:
    knowledge = ontology.knowledge()
    rows = {f.name: i for i, f in enumerate(knowledge.features)}
    columns = {e.name: k for k, e in enumerate(knowledge.environments)}
    table = np.zeros_like(knowledge.proximity())
    for way in knowledge.indications:
        table[rows[way.feature], columns[way.environment]] = way.proximity
        assert len(way.path) == way.steps + 2
        assert len(way.axioms) == way.steps + 1
    np.testing.assert_array_equal(table, knowledge.proximity())
    again, _ = store.from_json(store.to_json(knowledge, {}), "")
    for measure in MEASURES:
        np.testing.assert_array_equal(again.proximity(measure), knowledge.proximity(measure))


@settings(max_examples=60, deadline=None)
@given(ontologies(), st.data())
def test_more_steps_never_raise_the_proximity(ontology: Ontology, data: st.DataObject) -> None:
    """A class put in between two classes, or two places, makes no feature nearer to anything."""
    before = ontology.knowledge().proximity()
    if data.draw(st.booleans()) and ontology.kinds:
        link = data.draw(st.sampled_from(ontology.kinds))
        ontology.kinds.remove(link)
        ontology.kinds += [(link[0], ontology.features), (ontology.features, link[1])]
        ontology.features += 1
    elif ontology.parts:
        link = data.draw(st.sampled_from(ontology.parts))
        ontology.parts.remove(link)
        ontology.parts += [(link[0], ontology.places), (ontology.places, link[1])]
        ontology.places += 1
    after = ontology.knowledge().proximity()
    assert (after[: len(before)] <= before + 1e-15).all()
    assert ((after[: len(before)] > 0) == (before > 0)).all()


@settings(max_examples=60, deadline=None)
@given(ontologies(), st.data())
def test_stronger_axioms_never_lower_the_proximity(ontology: Ontology, data: st.DataObject) -> None:
    before = ontology.knowledge()
    key = data.draw(st.sampled_from(sorted(ontology.indications)))
    ontology.indications[key] = data.draw(st.floats(ontology.indications[key], 1.0))
    after = ontology.knowledge()
    for measure in MEASURES:
        assert (after.proximity(measure) >= before.proximity(measure) - 1e-12).all()


@settings(deadline=None)
@given(st.integers(1, 8), st.integers(0, 8), st.integers(0, 8))
def test_chains(length: int, up: int, on: int) -> None:
    """Along one chain of classes every measure falls, or stays, from step to step."""
    names = [str(i) for i in range(9 + length)]
    chain = Taxonomy({a: frozenset([b]) for b, a in pairwise(names)}, "0")
    for factor in MEASURES.values():
        values = []
        for steps in range(up + on + 1):
            climbed, went = min(steps, up), max(0, steps - up)
            first, second = (tuple(reversed(names[8 - k : 9])) for k in (climbed, went))
            way = Way(first, second, chain, chain)
            assert way.steps == steps
            values.append(factor(way))
        assert values[0] == 1
        assert all(b <= a + 1e-12 for a, b in pairwise(values))


@given(
    st.dictionaries(
        st.sampled_from("abcdefg"), st.frozensets(st.sampled_from("abcdefgr"), max_size=3)
    )
)
def test_taxonomies_with_circles(parents: dict[str, frozenset[str]]) -> None:
    taxonomy = Taxonomy({**parents, "r": frozenset()}, "r")
    assert taxonomy.depth("r") == 1
    assert taxonomy.information("r") == 0
    for low in taxonomy.classes:
        ways = taxonomy.ways_up(low)
        assert ways[low] == (low,)
        assert "r" in ways
        for high, way in ways.items():
            assert (way[0], way[-1]) == (low, high)
            assert taxonomy.depth(high) <= taxonomy.depth(low)
            assert taxonomy.information(high) <= taxonomy.information(low)
            if low not in taxonomy.ways_up(high):
                assert taxonomy.depth(high) < taxonomy.depth(low)
