"""P41: nothing says under which licence the ontology is."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import DC, DCTERMS, OWL, RDF, Literal, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.model import (
    Finding,
    NotCheckedError,
    Pitfall,
    Settings,
    Severity,
)
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.pitfalls.uses import by_place

PITFALL = Pitfall(
    code="P41",
    title="No license declared",
    severity=Severity.IMPORTANT,
    affects=("ontology",),
    categories=("N8",),
    description="The ontology does not state a licence. Whoever wants to use it cannot know "
    "whether they may.",
    remedy="State it of the ontology, as in: dcterms:license "
    "<https://creativecommons.org/licenses/by/4.0/>.",
)

_LICENCES = (
    DCTERMS.license,
    DCTERMS.rights,
    DC.rights,
    URIRef(f"{DC}license"),
    URIRef("http://creativecommons.org/ns#license"),
    URIRef("https://creativecommons.org/ns#license"),
    URIRef("http://schema.org/license"),
    URIRef("https://schema.org/license"),
    URIRef("http://www.w3.org/1999/xhtml/vocab#license"),
    URIRef("http://usefulinc.com/ns/doap#license"),
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Ontologies in the given files without a licence, by any of the usual properties."""
    declared = {
        subject
        for document in ontology.documents
        if document.given
        for subject in document.graph.subjects(RDF.type, OWL.Ontology)
    }
    if not declared:
        yield Finding((), "it declares no ontology, and so no licence of it")
    triples = [(subject, RDF.type, OWL.Ontology) for subject in declared]
    for triple in sorted(triples, key=lambda t: by_place(ontology, t)):
        if not _has_licence(ontology, triple[0]):
            name = f"<{triple[0]}>" if isinstance(triple[0], URIRef) else "the ontology"
            yield Finding((), f"{name} states no licence", (triple,))


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! asks a web service that is gone, and then reports nothing."""
    raise NotCheckedError("OOPS! asks a web service that is gone; offline it never finds this")
    yield


def _has_licence(ontology: Ontology, subject: Node) -> bool:
    return any(
        not isinstance(value, Literal) or str(value).strip()
        for predicate in _LICENCES
        for value in ontology.objects(subject, predicate)
    )
