"""The bundled ontology in the store: one graph as asserted, one with what follows from it."""

from __future__ import annotations

import asyncio
from pathlib import Path
from typing import TYPE_CHECKING

from symboslam.service.store._base import Document, Store
from symboslam.service.vocabulary import INFERENCES_GRAPH, ONTOLOGY_GRAPH, PREFIXES, RDFS

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


async def seed(store: Store, marker: Path) -> bool:
    """Put the bundled ontology into a store unless it is there; whether that was needed.

    Args:
        store: the store.
        marker: a file that says which version is there. It is written last, so that a start
            that was cut short is made good by the next one.
    """
    from symboslam.reasoning.sources import closure_hash

    digest = await asyncio.to_thread(closure_hash)
    if marker.is_file() and marker.read_text().strip() == digest and await _is_there(store):
        return False
    asserted, inferred = await asyncio.to_thread(_documents)
    await store.replace_graph(ONTOLOGY_GRAPH, asserted)
    await store.replace_graph(INFERENCES_GRAPH, [inferred])
    temporary = marker.with_suffix(".part")
    temporary.write_text(digest + "\n")
    temporary.replace(marker)
    return True


async def _is_there(store: Store) -> bool:
    return await store.has_graph(ONTOLOGY_GRAPH) and await store.has_graph(INFERENCES_GRAPH)


def _documents() -> tuple[list[Document], Document]:
    """The modules of the bundled ontology, and the graph of what follows."""
    import pyoxigraph

    from symboslam.reasoning.sources import closure_files
    from symboslam.reasoning.vocabulary import DOCUMENTS

    asserted = [
        Document("text/turtle", file.read_bytes(), DOCUMENTS + name.removesuffix(".ttl"))
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
    return asserted, Document("application/n-triples", data, INFERENCES_GRAPH)


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
