"""P40: terms in a namespace of others that does not know them."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from rdflib import DC, DCTERMS, OWL, RDF, RDFS, SKOS, VANN, XSD, Graph, Literal, URIRef
from rdflib.namespace import DefinedNamespace
from rdflib.term import Node

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.model import (
    Finding,
    NotCheckedError,
    Pitfall,
    Settings,
    Severity,
)
from symboslam.reasoning.pitfalls.online import RDF as DATA
from symboslam.reasoning.pitfalls.online import Answer, fetch, gaps, require
from symboslam.reasoning.pitfalls.ontology import Ontology, is_builtin
from symboslam.reasoning.pitfalls.uses import LIST, OBJECT, SUBJECT, by_place, whole
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P40",
    title="Namespace hijacking",
    severity=Severity.CRITICAL,
    affects=("class", "object property", "datatype property"),
    categories=("N51",),
    description="A term is declared or used in the namespace of somebody else, who does not define "
    "it. Looking it up leads to nothing, and its meaning is theirs to decide.",
    remedy="Define terms of your own in a namespace of your own; correct the name if a term of "
    "theirs is meant.",
)

REQUESTS = 50
"""How many terms of a namespace are looked up one by one, if its document does not list them."""

_KINDS = {
    OWL.Class, RDFS.Class, OWL.DeprecatedClass, RDFS.Datatype, OWL.DataRange, RDF.Property,
    OWL.ObjectProperty, OWL.DatatypeProperty, OWL.AnnotationProperty, OWL.OntologyProperty,
    OWL.DeprecatedProperty, OWL.FunctionalProperty, OWL.InverseFunctionalProperty,
    OWL.TransitiveProperty, OWL.SymmetricProperty, OWL.AsymmetricProperty, OWL.ReflexiveProperty,
    OWL.IrreflexiveProperty,
}  # fmt: skip
_POSITIONS = {
    RDF.type: OBJECT,
    **dict.fromkeys(
        (
            RDFS.subClassOf, RDFS.subPropertyOf, RDFS.domain, RDFS.range, OWL.equivalentClass,
            OWL.equivalentProperty, OWL.disjointWith, OWL.propertyDisjointWith, OWL.inverseOf,
            OWL.complementOf, OWL.datatypeComplementOf,
        ),
        SUBJECT | OBJECT,
    ),
    **dict.fromkeys(
        (
            OWL.onProperty, OWL.someValuesFrom, OWL.allValuesFrom, OWL.onClass, OWL.onDataRange,
            OWL.onDatatype, OWL.assertionProperty, OWL.annotatedProperty,
        ),
        OBJECT,
    ),
    **dict.fromkeys(
        (
            OWL.unionOf, OWL.intersectionOf, OWL.disjointUnionOf, OWL.hasKey,
            OWL.propertyChainAxiom, OWL.onProperties,
        ),
        SUBJECT | LIST,
    ),
}  # fmt: skip
"""Where classes, datatypes and properties stand in the statements of the language."""
_BLOCKS = {OWL.AllDisjointClasses, OWL.AllDisjointProperties}

_CLOSED: dict[str, tuple[str, type[DefinedNamespace]]] = {
    str(namespace): (name, namespace)
    for name, namespace in (
        ("OWL", OWL), ("RDF", RDF), ("RDF Schema", RDFS), ("XML Schema", XSD), ("SKOS", SKOS),
    )
}  # fmt: skip
"""Namespaces of W3C's standards: nothing is added to them, so that there is no need to ask."""
_DEFINED: dict[str, type[DefinedNamespace]] = {
    **{space: namespace for space, (_, namespace) in _CLOSED.items()},
    **{str(namespace): namespace for namespace in (DC, DCTERMS, VANN)},
}
"""Namespaces that are known to define some terms; of those for metadata, others are asked for."""
_MISSING_IN_RDFLIB = {
    str(XSD) + "anyType", str(XSD) + "anySimpleType", str(XSD) + "anyAtomicType",
    str(RDF) + "dirLangString", str(RDF) + "reifies",
}  # fmt: skip


@dataclass(frozen=True)
class _Use:
    """What a term does in the given files, in words, and where; its declaration by default."""

    how: str = "is declared here"
    axioms: tuple[Triple, ...] = ()


@dataclass
class _Found:
    """What asking the namespaces for their terms came to.

    Attributes:
        undefined: term -> how that is known, in words.
        unasked: what could not be asked, and what came of it.
    """

    undefined: dict[URIRef, str] = field(default_factory=dict)
    unasked: list[tuple[str, str]] = field(default_factory=list)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Terms that given files declare or use, in foreign namespaces that do not define them.

    A use is as a type, a predicate, a datatype, or in an axiom about classes or properties. What
    OWL, RDF, RDF Schema, XML Schema and SKOS define is known without a request, and so are the
    usual terms of Dublin Core and VANN. If something could not be asked, the findings are kept, and
    every message ends with it.

    Raises:
        NotCheckedError: the network may not be asked, or a namespace could not be asked and nothing
            is wrong in the others.
    """
    require(settings)
    uses = _foreign(ontology)
    spaces: dict[str, list[URIRef]] = defaultdict(list)
    for term in sorted(uses):
        spaces[_namespace(term)].append(term)
    found = _Found()
    for space, terms in sorted(spaces.items()):
        _ask(space, terms, found)
    unasked = gaps(found.unasked)
    if unasked and not found.undefined:
        raise NotCheckedError(unasked)
    for term, why in found.undefined.items():
        message = f"{uses[term].how}, but {why}"
        message += f" (not everything was checked: {unasked})" if unasked else ""
        yield Finding((term,), message, uses[term].axioms)


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! asks a web service for it, and only for an ontology with an address."""
    raise NotCheckedError("OOPS! looks at this only for an ontology that is given by its address")
    yield


# Which terms


def _foreign(ontology: Ontology) -> dict[URIRef, _Use]:
    """The terms of others that given files declare or use, and that may not be defined.

    Left out is what imports declare.
    """
    declared: list[set[URIRef]] = [set(), set()]  # by imports, by given files
    for document in ontology.documents:
        for s, kind in document.graph.subject_objects(RDF.type):
            if kind in _KINDS and isinstance(s, URIRef):
                declared[document.given].add(s)
    imported, here = declared
    used = _used(ontology)
    own = _own(ontology, here, used)

    def is_foreign(term: URIRef) -> bool:
        space = _namespace(term)
        if not space.startswith(("http://", "https://")) or _is_own(space, own):
            return False
        if space in _CLOSED:
            return not _is_known(term)
        return not (term in imported or is_builtin(term) or _is_known(term))

    found = {term: _Use() for term in here if is_foreign(term)}
    for term, triple in used.items():
        if term not in found and is_foreign(term):
            found[term] = _Use(_how(term, triple), (whole(ontology, triple),))
    return found


def _used(ontology: Ontology) -> dict[URIRef, Triple]:
    """Term -> the first statement of a given file in which it stands for a class or property.

    Terms that are known to be defined are left out.
    """
    found: dict[URIRef, tuple[tuple[bool, str, int, str], Triple]] = {}
    for triple in ontology.graph:
        if not ontology.is_given(triple):
            continue
        for term in _terms(ontology, triple):
            if isinstance(term, URIRef) and not _is_known(term):
                rank = by_place(ontology, triple)
                if term not in found or rank < found[term][0]:
                    found[term] = (rank, triple)
    return {term: triple for term, (_, triple) in found.items()}


def _terms(ontology: Ontology, triple: Triple) -> Iterator[Node]:
    s, p, o = triple
    yield p
    if isinstance(o, Literal):
        if o.datatype:
            yield o.datatype
        return
    which = _POSITIONS.get(p, 0) if isinstance(p, URIRef) else 0
    if p == OWL.members and ontology.kinds.get(s, frozenset()) & _BLOCKS:
        which = LIST
    if which & SUBJECT:
        yield s
    if which & OBJECT:
        yield o
    if which & LIST:
        yield from ontology.members(o)


def _how(term: URIRef, triple: Triple) -> str:
    s, p, o = triple
    if p == term:
        return "is used as a predicate"
    if p == RDF.type:
        named = isinstance(s, URIRef)
        return f"is used as the type of {local_name(str(s))}" if named else "is used as a type"
    if isinstance(o, Literal):
        return "is used as a datatype"
    return f"is used with {local_name(str(p))}"


def _own(ontology: Ontology, here: set[URIRef], used: Mapping[URIRef, Triple]) -> set[str]:
    """How own namespaces begin, without the ``#`` or ``/`` at the end.

    With the IRI of an ontology in a given file, or as it prefers (``vann:preferredNamespaceUri``),
    or with that of a document above it: ``/farm#`` if the ontology is ``/farm/core``. If nothing is
    in those, then own is the namespace with the most declared terms, or subjects.
    """
    heads: set[Node] = set()
    preferred: set[Node] = set()
    subjects: set[URIRef] = set()
    for document in ontology.documents:
        if document.given:
            heads.update(document.graph.subjects(RDF.type, OWL.Ontology))
            subjects |= {s for s in document.graph.subjects() if isinstance(s, URIRef)}
    for head in heads:
        preferred.update(ontology.objects(head, VANN.preferredNamespaceUri))
    own = {str(name).rstrip("#/") for name in heads | preferred}
    terms = here | used.keys() | (subjects - heads)
    spaces = {_namespace(term) for term in terms}
    above = {space[:-1] for space in spaces if space.endswith("#")}
    own |= {stem for stem in above if any(str(head).startswith(f"{stem}/") for head in heads)}
    if not any(_is_own(space, own) for space in spaces):
        named = map(_namespace, sorted(here or subjects - heads))
        counts = Counter(space for space in named if space not in _CLOSED)
        own |= {space.rstrip("#/") for space, _ in counts.most_common(1)}
    return own


def _is_own(space: str, own: set[str]) -> bool:
    return any(f"{space.rstrip('#/')}/".startswith(f"{stem}/") for stem in own)


def _namespace(term: URIRef) -> str:
    return term.removesuffix(local_name(term))


def _is_known(term: URIRef) -> bool:
    """Whether it is known without asking that its namespace defines a term."""
    namespace = _DEFINED.get(_namespace(term))
    name = local_name(term)
    return bool(name and namespace and name in namespace) or str(term) in _MISSING_IN_RDFLIB


# Asking


def _ask(space: str, terms: list[URIRef], found: _Found) -> None:
    """Note which of the terms a namespace does not define, and what could not be told."""
    if space in _CLOSED:
        name, _ = _CLOSED[space]
        found.undefined.update(dict.fromkeys(terms, f"{name} has no such term"))
        return
    answer = fetch(space, DATA)
    graph = answer.graph()
    left = [term for term in terms if not _defines(graph, term)]
    if not left:
        return
    if space.endswith("#"):  # the document of the namespace is that of its terms
        if graph or answer.final:
            found.undefined.update(dict.fromkeys(left, _why(answer)))
        else:
            found.unasked.append(_gap(answer))
        return
    if not (answer.final or answer.heard):  # nor would its terms be heard of
        found.unasked.append(_gap(answer))
        return
    for term in left[:REQUESTS]:
        one = fetch(term, DATA)
        described = one.graph()
        if _defines(described, term):
            continue
        if described or one.final:
            found.undefined[term] = _why(one)
        else:
            found.unasked.append(_gap(one))
            if not one.heard:
                return
    if len(left) > REQUESTS:
        which = f"only {REQUESTS} of {len(left)} terms of <{space}>"
        found.unasked.append((which, "were looked up"))


def _defines(graph: Graph | None, term: URIRef) -> bool:
    return graph is not None and (term, None, None) in graph


def _why(answer: Answer) -> str:
    """Why a term is taken as undefined."""
    if answer.content is None:
        return f"<{answer.iri}> {answer.outcome}"
    return f"what is at <{answer.iri}> does not define it"


def _gap(answer: Answer) -> tuple[str, str]:
    """What does not tell whether a term is defined, and why."""
    what = answer.outcome if answer.content is None else "could not be read as RDF"
    return f"<{answer.iri}>", what
