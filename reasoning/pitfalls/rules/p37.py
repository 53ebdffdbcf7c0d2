"""P37: nothing is found at the ontology's IRI."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import OWL, RDF, URIRef

from symboslam.reasoning.pitfalls.model import (
    Finding,
    NotCheckedError,
    Pitfall,
    Settings,
    Severity,
)
from symboslam.reasoning.pitfalls.online import HTML, Answer, fetch, gaps, require
from symboslam.reasoning.pitfalls.online import RDF as DATA
from symboslam.reasoning.pitfalls.ontology import Ontology

PITFALL = Pitfall(
    code="P37",
    title="Ontology not available on the Web",
    severity=Severity.CRITICAL,
    affects=("ontology",),
    categories=("N51", "N7"),
    description="At the ontology's IRI there is neither the ontology nor a page that describes it. "
    "Nobody who meets one of its terms can find out what it means.",
    remedy="Publish the ontology at its IRI, or let the IRI redirect to where it is (w3id.org and "
    "purl.org do so).",
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """IRIs of the ontologies in given files at which there is neither RDF nor HTML.

    If some IRIs could not be asked, the findings are kept, and every message ends with them.

    Raises:
        NotCheckedError: the network may not be asked, or an IRI could not be asked and nothing is
            wrong with the others.
    """
    require(settings)
    iris = sorted(
        {
            subject
            for document in ontology.documents
            if document.given
            for subject in document.graph.subjects(RDF.type, OWL.Ontology)
            if isinstance(subject, URIRef) and not subject.startswith("file:")
        }
    )
    if not iris:
        raise NotCheckedError("the ontology has no IRI that could be looked up")
    missing: list[Answer] = []
    silent: list[Answer] = []
    for iri in iris:
        if (problem := _problem(iri)) is not None:
            (missing if problem.final else silent).append(problem)
    unasked = gaps((f"<{p.iri}>", f"could not be asked: {p.problem}") for p in silent)
    if unasked and not missing:
        raise NotCheckedError(unasked)
    for problem in missing:
        message = f"neither the ontology nor a page about it is at <{problem.iri}>"
        message += f": {problem.problem}" if problem.problem else ""
        message += f" (not everything was checked: {unasked})" if unasked else ""
        yield Finding((), message, ((URIRef(problem.iri), RDF.type, OWL.Ontology),))


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! asks the address that an ontology is loaded from, never for a file."""
    raise NotCheckedError("OOPS! looks at this only for an ontology that is given by its address")
    yield


def _problem(iri: str) -> Answer | None:
    """Why there is nothing at an IRI; None if there is something."""
    data = fetch(iri, DATA)
    if data.is_page or data.graph():
        return None
    page = fetch(iri, HTML)
    if page.is_page:
        return None
    for answer in (data, page):
        if answer.problem and not answer.final:
            return answer
    what = data.problem or f"what is there is neither RDF nor HTML ({data.media_type})"
    return Answer(iri, problem=what, final=True)
