"""P39: the IRIs of the ontology depend on where its file is."""

from __future__ import annotations

import re
from collections.abc import Iterator

from rdflib import OWL, RDF, RDFS, URIRef
from rdflib.term import Node

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.as_text import base, ontology_iri, text_of
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology, is_builtin
from symboslam.reasoning.pitfalls.uses import by_place

PITFALL = Pitfall(
    code="P39",
    title="Ambiguous namespace",
    severity=Severity.CRITICAL,
    affects=("ontology",),
    categories=("N51",),
    description="The ontology has neither an IRI of its own nor a base for its names, so that they "
    "begin with the place of the file. Each copy of the file then speaks of other things.",
    remedy="Give the ontology an absolute IRI, and state a base (xml:base, @base) or write the "
    "names in full.",
)

_SCHEME = re.compile(r"(?!file:)[A-Za-z][A-Za-z0-9+.-]*:")
_LINKS = (RDFS.seeAlso, RDFS.isDefinedBy, OWL.imports)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Given files with relative IRIs that no base completes, and ontologies without an IRI.

    Our parsers complete such IRIs with ``file:///`` and the name of the file.
    """
    for document in ontology.documents:
        if not document.given:
            continue
        found: dict[Node, Triple] = {}
        relative = [triple for triple in document.graph if any(_named(triple))]
        for triple in sorted(relative, key=lambda t: by_place(ontology, t)):
            for term in _named(triple):
                found.setdefault(term, triple)
        subjects = set(document.graph.subjects(RDF.type, OWL.Ontology))
        if found:
            names = [_shown(term) for term in found]
            more = f" and {len(names) - 3} more" if len(names) > 4 else ""
            listed = ", ".join(names[: 3 if more else 4])
            message = "it has no base for its relative IRIs, so they change with the place of "
            message += f"{document.name}: {listed}{more}"
            yield Finding((), message, (next(iter(found.values())),))
        elif subjects and not any(isinstance(s, URIRef) for s in subjects):
            triples = [(s, RDF.type, OWL.Ontology) for s in subjects]
            first = min(triples, key=lambda t: by_place(ontology, t))
            yield Finding((), "its owl:Ontology has no IRI", (first,))


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! searches the text for xml:base and for the ontology's IRI, never at other IRIs."""
    for document in ontology.documents:
        if document.given:
            text = text_of(document)
            if not base(text) and not ontology_iri(text):
                yield Finding((), f"{document.name} has neither an ontology IRI nor an xml:base")


def _named(triple: Triple) -> Iterator[Node]:
    """The relative IRIs in a triple that name something; links to other documents do not."""
    s, p, o = triple
    for term in (s, p, o) if is_builtin(p) and p not in _LINKS else (s, p):
        if isinstance(term, URIRef) and not _SCHEME.match(term):
            yield term


def _shown(term: Node) -> str:
    """An IRI as it stands in the file."""
    name, hash_, fragment = str(term).removeprefix("file:///").partition("#")
    return f"<{hash_}{fragment}>" if hash_ else f"<{name}>"
