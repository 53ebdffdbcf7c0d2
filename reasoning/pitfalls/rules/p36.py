"""P36: the ontology's IRI names a file format."""

from __future__ import annotations

import re
from collections.abc import Iterator

from rdflib import OWL, RDF, URIRef

from symboslam.reasoning.pitfalls.model import (
    Finding,
    NotCheckedError,
    Pitfall,
    Settings,
    Severity,
)
from symboslam.reasoning.pitfalls.ontology import Ontology

PITFALL = Pitfall(
    code="P36",
    title="URI contains file extension",
    severity=Severity.MINOR,
    affects=("ontology",),
    categories=("N51",),
    description="The ontology's IRI ends like the name of a file. An IRI should outlive the format "
    "that the ontology happens to be published in today.",
    remedy="Take an IRI without a file extension, and let the server send the format that is asked "
    "for.",
)

_EXTENSION = re.compile(
    r"\.(owl|owx|ofn|omn|obo|rdfs?|rdfxml|xml|ttl|turtle|n3|nt|nq|trig|trix|jsonld|json|html?)"
    r"[#/]?$",
    re.IGNORECASE,
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """IRIs of the ontologies in the given files that end in an extension, perhaps before a ``#``.

    An IRI that is only the place of the file (``file:``) is P39's affair.
    """
    for document in ontology.documents:
        subjects = document.graph.subjects(RDF.type, OWL.Ontology) if document.given else ()
        for iri in sorted({s for s in subjects if isinstance(s, URIRef)}):
            found = _EXTENSION.search(iri)
            if found and not iri.startswith("file:") and _has_path(iri):
                message = f"its IRI <{iri}> contains the file extension .{found[1]}"
                yield Finding((), message, ((iri, RDF.type, OWL.Ontology),))


def _has_path(iri: str) -> bool:
    """Whether the IRI is more than a host: ``http://example.owl`` has no extension."""
    _, _, rest = iri.partition("://")
    return not rest or "/" in rest.rstrip("/#")


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! asks this of the address that an ontology is loaded from, never of a file."""
    raise NotCheckedError("OOPS! looks at this only for an ontology that is given by its address")
    yield
