"""P40: terms in a namespace of others that does not know them."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field

from rdflib import OWL, RDF, RDFS, Graph, URIRef

from symboslam.reasoning.pitfalls.model import (
    Finding,
    NotCheckedError,
    Pitfall,
    Settings,
    Severity,
)
from symboslam.reasoning.pitfalls.online import RDF as DATA
from symboslam.reasoning.pitfalls.online import fetch, require
from symboslam.reasoning.pitfalls.ontology import Ontology, is_builtin
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P40",
    title="Namespace hijacking",
    severity=Severity.CRITICAL,
    affects=("class", "object property", "datatype property"),
    categories=("N51",),
    description="A term is declared in the namespace of somebody else, who does not define it. "
    "Looking it up leads to nothing, and its meaning is not the declarer's to decide.",
    remedy="Define terms of your own in a namespace of your own; correct the name if a term of "
    "theirs is meant.",
)

REQUESTS = 50
"""How many terms of a namespace are looked up one by one, if its document does not list them."""

_KINDS = {
    OWL.Class, RDFS.Class, OWL.ObjectProperty, OWL.DatatypeProperty, OWL.AnnotationProperty,
    RDF.Property, RDFS.Datatype,
}  # fmt: skip
_PREFERRED = URIRef("http://purl.org/vocab/vann/preferredNamespaceUri")


@dataclass
class _Found:
    """What asking a namespace for its terms came to."""

    undefined: list[URIRef] = field(default_factory=list)
    unasked: str = ""


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Terms declared in given files, in foreign namespaces whose documents do not define them.

    Raises:
        NotCheckedError: the network may not be asked, or a namespace does not answer and nothing
            is wrong in the others. If something is, its message names the silent ones.
    """
    require(settings)
    results = {space: _ask(space, terms) for space, terms in sorted(_foreign(ontology).items())}
    unasked = "; ".join(result.unasked for result in results.values() if result.unasked)
    if unasked and not any(result.undefined for result in results.values()):
        raise NotCheckedError(unasked)
    for space, result in results.items():
        for term in result.undefined:
            message = f"is declared here, but <{space}> does not define it"
            message += f" (not all could be asked: {unasked})" if unasked else ""
            yield Finding((term,), message)


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! asks a web service for it, and only for an ontology with an address."""
    raise NotCheckedError("OOPS! looks at this only for an ontology that is given by its address")
    yield


def _foreign(ontology: Ontology) -> dict[str, list[URIRef]]:
    """Namespace -> the terms that given files declare in it and no other file does.

    Own namespaces are those that begin with the IRI of an ontology in a given file, the one that
    it prefers (``vann:preferredNamespaceUri``), and if no term is in those, that with the most.
    """
    mine: set[URIRef] = set()
    known: set[URIRef] = set()
    own: set[str] = set()
    for document in ontology.documents:
        declared = {
            s
            for s, kind in document.graph.subject_objects(RDF.type)
            if kind in _KINDS and isinstance(s, URIRef)
        }
        if not document.given:
            known |= declared
            continue
        mine |= declared
        for iri in document.graph.subjects(RDF.type, OWL.Ontology):
            own.add(str(iri).rstrip("#/"))
            own.update(str(o).rstrip("#/") for o in document.graph.objects(iri, _PREFERRED))
    spaces: dict[str, list[URIRef]] = defaultdict(list)
    for term in sorted(mine):
        spaces[_namespace(term)].append(term)
    counts = Counter({space: len(terms) for space, terms in spaces.items()})
    if not any(_is_own(space, own) for space in spaces):
        own.update(space.rstrip("#/") for space, _ in counts.most_common(1))
    return {
        space: foreign
        for space, terms in spaces.items()
        if space.startswith(("http://", "https://"))
        and not _is_own(space, own)
        and (foreign := [t for t in terms if t not in known and not is_builtin(t)])
    }


def _is_own(space: str, own: set[str]) -> bool:
    return any(f"{space.rstrip('#/')}/".startswith(f"{stem}/") for stem in own)


def _namespace(term: URIRef) -> str:
    return term.removesuffix(local_name(term))


def _ask(space: str, terms: list[URIRef]) -> _Found:
    """Which of the terms a namespace does not define."""
    answer = fetch(space, DATA)
    graph = answer.graph()
    left = [term for term in terms if not _defines(graph, term)]
    if not left:
        return _Found()
    if space.endswith("#"):  # the document of the namespace is that of its terms
        if graph or answer.final:
            return _Found(left)
        why = answer.problem or "what is there is no RDF"
        return _Found(unasked=f"<{space}> does not say what it defines: {why}")
    found = _Found()
    for term in left[:REQUESTS]:
        one = fetch(term, DATA)
        described = one.graph()
        if _defines(described, term):
            continue
        if described or one.final:
            found.undefined.append(term)
        else:
            why = one.problem or "what is there is no RDF"
            found.unasked = f"<{term}> could not be looked up: {why}"
    if len(left) > REQUESTS:
        found.unasked = f"only {REQUESTS} of {len(left)} terms of <{space}> were looked up"
    return found


def _defines(graph: Graph | None, term: URIRef) -> bool:
    return graph is not None and (term, None, None) in graph
