"""P38: a file does not declare which ontology it is."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import OWL, RDF

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.as_text import ontology_iri, text_of
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Document, Ontology
from symboslam.reasoning.pitfalls.uses import by_place

PITFALL = Pitfall(
    code="P38",
    title="No OWL ontology declaration",
    severity=Severity.IMPORTANT,
    affects=("ontology",),
    categories=("N41", "N51", "N8"),
    description="The file has no owl:Ontology. There is then nothing that a version, a licence, an "
    "author or an import could be stated of, and nobody can import the ontology by its name.",
    remedy="Declare it: <https://example.org/my-ontology> a owl:Ontology.",
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Given files without an ``owl:Ontology``, in whatever way it may be written."""
    given = [document for document in ontology.documents if document.given]
    for document in given:
        if (None, RDF.type, OWL.Ontology) not in document.graph:
            place = _first(ontology, document) if len(given) > 1 else ()
            yield Finding((), f"{document.name} declares no owl:Ontology", place)


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! searches the text of the file for some spellings of the declaration only."""
    for document in ontology.documents:
        if document.given and ontology_iri(text_of(document)) is None:
            yield Finding((), f"{document.name} declares no owl:Ontology that OOPS! finds")


def _first(ontology: Ontology, document: Document) -> tuple[Triple, ...]:
    """The first statement of a file, so that the finding is placed in it."""
    here = [t for t in document.graph if (at := ontology.place(t)) and at.file == document.name]
    return (min(here, key=lambda t: by_place(ontology, t)),) if here else ()
