"""The terms of ontology/map.ttl: each explained, and each of one kind across all modules."""

from __future__ import annotations

from collections import defaultdict
from importlib.resources import files

import pytest
from rdflib import OWL, RDF, RDFS, SKOS, Graph, Literal, Namespace, URIRef

SL = Namespace("https://w3id.org/symboslam#")
KINDS = (OWL.Class, OWL.ObjectProperty, OWL.DatatypeProperty, OWL.AnnotationProperty)


@pytest.fixture(scope="module")
def terms() -> Graph:
    return Graph().parse(
        data=(files("symboslam.ontology") / "map.ttl").read_bytes(), format="turtle"
    )


def test_every_term_has_a_label_and_a_definition(terms: Graph) -> None:
    own = {s for kind in KINDS for s in terms.subjects(RDF.type, kind) if str(s).startswith(SL)}
    assert len(own) > 35
    for term in own:
        for about in (RDFS.label, SKOS.definition):
            (text,) = terms.objects(term, about)
            assert isinstance(text, Literal)
            assert text.language == "en"
    labels = [str(terms.value(term, RDFS.label)) for term in own]
    assert len(set(labels)) == len(labels)


def test_no_term_is_of_two_kinds(terms: Graph) -> None:
    """OWL 2 DL allows no property to be both an annotation and something else."""
    kinds = defaultdict(set)
    modules = [f for f in files("symboslam.ontology").iterdir() if f.name.endswith(".ttl")]
    assert len(modules) > 5
    for module in modules:
        graph = Graph().parse(data=module.read_bytes(), format="turtle")
        for kind in KINDS:
            for term in graph.subjects(RDF.type, kind):
                if isinstance(term, URIRef):
                    kinds[term].add(kind)
    assert {term: found for term, found in kinds.items() if len(found) > 1} == {}


def test_own_classes_stand_apart_from_features_and_places(terms: Graph) -> None:
    """A landmark is no class of features: nothing here may reach the engine's table."""
    below = set(terms.objects(None, RDFS.subClassOf))
    assert below.isdisjoint({SL.Feature, SL.Place, SL.Environment, SL.StaticFeature})
