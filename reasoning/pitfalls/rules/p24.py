"""P24: terms that occur in what defines them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rdflib import OWL, RDFS, BNode, URIRef
from rdflib.term import Node

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P24",
    title="Using recursive definitions",
    severity=Severity.IMPORTANT,
    affects=("class", "object property", "datatype property"),
    categories=("N1", "S4"),
    description="A term is used in its own definition: a class in an expression that it is "
    "equivalent to or below, a property in its own domain or range.",
    remedy="Define the term by other terms; if the axiom is a condition that members must meet "
    "and no definition, accept the finding with that reason.",
)

_CLASS = (OWL.equivalentClass, RDFS.subClassOf, OWL.disjointUnionOf)
_DIRECT = (OWL.unionOf, OWL.intersectionOf, OWL.complementOf, OWL.oneOf)
_PROPERTY = (RDFS.domain, RDFS.range, OWL.equivalentProperty, RDFS.subPropertyOf)
_WORDS = {
    RDFS.subClassOf: "what it is below",
    RDFS.domain: "its own domain",
    RDFS.range: "its own range",
    OWL.equivalentProperty: "what it is equivalent to",
    RDFS.subPropertyOf: "what it is below",
}


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Terms that occur in an expression of their own axioms, and terms stated of themselves.

    Equivalences count whichever way round they are stated. A property stated to be its own inverse
    is P25.
    """
    found: dict[URIRef, dict[URIRef, set[Triple]]] = {}
    for predicates, terms in (
        ((*_CLASS, *_DIRECT), {*ontology.classes}),
        (_PROPERTY, {*ontology.object_properties, *ontology.datatype_properties}),
    ):
        for predicate in predicates:
            for subject, objects in ontology.statements(predicate).items():
                for other in objects:
                    for term in _recursive(ontology, subject, predicate, other):
                        if term in terms:
                            triple = (subject, predicate, other)
                            found.setdefault(term, {}).setdefault(predicate, set()).add(triple)
    for term in dict.fromkeys(ontology.terms):
        for predicate, triples in found.get(term, {}).items():
            where = _WORDS.get(predicate, "what it is equivalent to")
            ordered = sorted(triples, key=lambda t: _order(ontology, t))
            yield Finding((term,), f"{local_name(term)} occurs in {where}", tuple(ordered))


def _recursive(
    ontology: Ontology, subject: Node, predicate: URIRef, other: Node
) -> Iterable[URIRef]:
    """Which named side of a statement occurs in the other one."""
    if isinstance(subject, URIRef):
        return [subject] if subject in _mentioned(ontology, other) else []
    if predicate == OWL.equivalentClass and isinstance(other, URIRef):
        return [other] if other in _mentioned(ontology, subject) else []
    return []


def _mentioned(ontology: Ontology, node: Node) -> set[URIRef]:
    return set(ontology.mentioned(node))


def _order(ontology: Ontology, triple: Triple) -> tuple[str, int, str]:
    place = ontology.place(triple)
    text = ontology.words.expression(triple[2])
    return (place.file, place.line or 0, text) if place else ("", 0, text)


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """As OOPS!: one finding a term, and a property that is its own inverse is one.

    It looks only into "some" and "only", "and", "or" and "not"; of classes only into restrictions
    of object properties. A class stated to be below itself is left out.
    """
    objects = {*ontology.object_properties}
    for term in ontology.classes:
        above = [o for o in ontology.objects(term, RDFS.subClassOf) if o != term]
        nodes = [*above, *ontology.objects(term, OWL.equivalentClass)]
        if term in _oops_terms(ontology, nodes, objects, classes=True):
            yield _oops_finding(term)
    for term in ontology.object_properties:
        nodes = [*ontology.domains(term), *ontology.ranges(term)]
        direct = {
            o
            for predicate in (OWL.equivalentProperty, OWL.inverseOf)
            for o in ontology.objects(term, predicate)
        }
        if term in direct or term in _oops_terms(ontology, nodes, objects):
            yield _oops_finding(term)
    for term in ontology.datatype_properties:
        nodes = [*ontology.domains(term)]
        direct = {*ontology.objects(term, OWL.equivalentProperty)}
        if term in direct or term in _oops_terms(ontology, nodes, None):
            yield _oops_finding(term)


def _oops_finding(term: URIRef) -> Finding:
    return Finding((term,), f"{local_name(term)} occurs in its own definition")


def _oops_terms(
    ontology: Ontology, nodes: Iterable[Node], only_of: set[URIRef] | None, classes: bool = False
) -> Iterator[Node]:
    """Classes, or properties of restrictions, as far as OOPS! looks into expressions.

    Args:
        ontology: where.
        nodes: the expressions.
        only_of: restrictions of other properties are left out; None for none.
        classes: the classes are wanted, not the properties.
    """
    waiting, seen = list(nodes), set[Node]()
    while waiting:
        node = waiting.pop()
        if node in seen:
            continue
        seen.add(node)
        if isinstance(node, URIRef) and classes:
            yield node
        if not isinstance(node, BNode):
            continue
        on = ontology.objects(node, OWL.onProperty)
        if on and only_of is not None and on[0] not in only_of:
            continue
        if on and not classes:
            yield on[0]
        for predicate in (OWL.someValuesFrom, OWL.allValuesFrom, OWL.complementOf):
            waiting += ontology.objects(node, predicate)
        for predicate in (OWL.unionOf, OWL.intersectionOf):
            for items in ontology.objects(node, predicate):
                waiting += ontology.members(items)
