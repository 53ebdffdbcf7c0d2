"""The bundled ontology in the store: one graph as asserted, one with what follows from it."""

from __future__ import annotations

import asyncio
import json
from typing import TYPE_CHECKING

from symboslam.reasoning.vocabulary import OWL_NAMESPACE
from symboslam.service.store._base import Document, Formats, Query, Store
from symboslam.service.vocabulary import (
    INFERENCES_GRAPH,
    N_TRIPLES,
    ONTOLOGY_GRAPH,
    PREFIXES,
    RDFS,
    SOLUTIONS,
    TURTLE,
)

if TYPE_CHECKING:
    import pyoxigraph

_CLOSURE = """
CONSTRUCT { ?x ?p ?z } WHERE {
  { VALUES ?p { rdfs:subClassOf } ?x rdfs:subClassOf+ ?z . ?z a owl:Class }
  UNION { VALUES ?p { rdfs:subPropertyOf } ?x rdfs:subPropertyOf+ ?z }
  UNION { VALUES ?p { rdf:type } ?x a/rdfs:subClassOf+ ?z . ?z a owl:Class }
  FILTER (isIRI(?x) && isIRI(?z) && ?x != ?z)
  MINUS { ?x ?p ?z }
}"""
"""What RDFS says of subclasses, subproperties and instances. (MINUS: NOT EXISTS is quadratic.)"""

_DEFINED = """
SELECT ?class ?environment WHERE {
  ?class owl:equivalentClass/owl:intersectionOf/rdf:rest*/rdf:first ?restriction .
  ?restriction owl:onProperty sl:indicates ; owl:someValuesFrom ?environment
  FILTER (isIRI(?class) && isIRI(?environment))
}"""
"""The class of the features that indicate an environment."""

_MARK = f'<{INFERENCES_GRAPH}> <{OWL_NAMESPACE}versionInfo> "sha256 {{}}" .'


async def seed(store: Store) -> bool:
    """Put the bundled ontology into a store unless it is there; whether that was needed.

    A statement in the second graph says which version it is. It is written last, with that graph,
    so that a start that was cut short is made good by the next one.
    """
    from symboslam.reasoning.sources import closure_hash

    mark = _MARK.format(await asyncio.to_thread(closure_hash))
    if await store.has_graph(ONTOLOGY_GRAPH) and await _holds(store, mark):
        return False
    asserted, inferred = await asyncio.to_thread(_documents, mark)
    await store.replace_graph(ONTOLOGY_GRAPH, asserted)
    await store.replace_graph(INFERENCES_GRAPH, [inferred])
    return True


async def _holds(store: Store, mark: str) -> bool:
    formats = Formats(next(iter(SOLUTIONS)), next(iter(SOLUTIONS)), None)
    text = f"ASK {{ GRAPH <{INFERENCES_GRAPH}> {{ {mark} }} }}"
    answer = await store.query(Query(text, INFERENCES_GRAPH, formats))
    if isinstance(answer.body, bytes):
        return json.loads(answer.body).get("boolean") is True
    with answer.body as file:
        return json.load(file).get("boolean") is True


def _documents(mark: str) -> tuple[list[Document], Document]:
    """The modules of the bundled ontology, and the graph of what follows, with a mark in it."""
    import pyoxigraph

    from symboslam.reasoning.sources import closure_files
    from symboslam.reasoning.vocabulary import DOCUMENTS

    asserted = [
        Document(TURTLE, file.read_bytes(), DOCUMENTS + name.removesuffix(".ttl"))
        for name, file in closure_files().items()
    ]
    # In memory, because it is nobody's business until it is complete.
    scratch = pyoxigraph.Store()
    for document in asserted:
        scratch.load(document.data, pyoxigraph.RdfFormat.TURTLE, base_iri=document.base)
    known = {quad.triple for quad in scratch}
    found = _indicated(scratch)
    for triple in found:
        scratch.add(pyoxigraph.Quad(triple.subject, triple.predicate, triple.object))
    follows = scratch.query(_CLOSURE, prefixes=PREFIXES)
    assert isinstance(follows, pyoxigraph.QueryTriples)
    inferred = {*found, *follows} - known
    data = pyoxigraph.serialize(inferred, format=pyoxigraph.RdfFormat.N_TRIPLES)
    assert data is not None
    data += f"{mark}\n".encode()
    return asserted, Document(N_TRIPLES, data, INFERENCES_GRAPH)


def _indicated(scratch: pyoxigraph.Store) -> list[pyoxigraph.Triple]:
    """``sl:House rdfs:subClassOf sl:ResidentialFeature``, and so on.

    The reasoner found what each feature indicates when the ontology was bundled; the defined
    classes of features say what that makes of them.
    """
    import pyoxigraph

    from symboslam.reasoning.knowledge import Knowledge

    knowledge = Knowledge.load()
    environments = {e.iri: e.name for e in knowledge.environments}
    solutions = scratch.query(_DEFINED, prefixes=PREFIXES)
    assert isinstance(solutions, pyoxigraph.QuerySolutions)
    defined = {environments.get(s["environment"].value): s["class"] for s in solutions}
    iris = {feature.name: feature.iri for feature in knowledge.features}
    below = pyoxigraph.NamedNode(RDFS + "subClassOf")
    return [
        pyoxigraph.Triple(pyoxigraph.NamedNode(iris[i.feature]), below, defined[i.environment])
        for i in knowledge.indications
        if i.environment in defined
    ]
