"""What a class is said to be: the parts of its superclasses and of its definitions."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

from rdflib import OWL, RDFS, BNode, Literal, URIRef
from rdflib.term import Node

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.model import NotCheckedError
from symboslam.reasoning.pitfalls.ontology import Ontology

LEFT_TO_PEOPLE = "OOPS! leaves this one to people"

_AT_LEAST = (
    OWL.minCardinality, OWL.minQualifiedCardinality, OWL.cardinality, OWL.qualifiedCardinality,
)  # fmt: skip
_EXISTING = (OWL.someValuesFrom, OWL.hasValue, OWL.hasSelf)


class Condition(NamedTuple):
    """A part of what a class is said to be.

    Attributes:
        node: a class or an expression that is no intersection.
        axiom: the statement about the class that has it.
    """

    node: Node
    axiom: Triple


def left_to_people() -> NotCheckedError:
    """Why OOPS! does not look for a pitfall."""
    return NotCheckedError(LEFT_TO_PEOPLE)


def conditions(ontology: Ontology, cls: URIRef) -> Iterator[Condition]:
    """All parts of a class's superclasses and definitions, those of intersections one by one."""
    axioms: list[tuple[Node, Triple]] = []
    for predicate in (RDFS.subClassOf, OWL.equivalentClass):
        axioms += [(o, (cls, predicate, o)) for o in ontology.objects(cls, predicate)]
    axioms += [
        (s, (s, OWL.equivalentClass, cls))
        for s in ontology.equivalents.get(cls, ())
        if cls in ontology.objects(s, OWL.equivalentClass)
    ]
    for items in ontology.objects(cls, OWL.intersectionOf):
        axioms += [(n, (cls, OWL.intersectionOf, items)) for n in ontology.members(items)]
    for node, axiom in axioms:
        yield from (Condition(part, axiom) for part in parts(ontology, node))


def parts(ontology: Ontology, node: Node) -> Iterator[Node]:
    """The members of an intersection, and of those in it; else the expression itself."""
    waiting, seen = [node], {node}
    while waiting:
        node = waiting.pop()
        lists = ontology.objects(node, OWL.intersectionOf) if isinstance(node, BNode) else ()
        if not lists:
            yield node
        for items in lists:
            fresh = [m for m in ontology.members(items) if m not in seen]
            seen.update(fresh)
            waiting += fresh


def requires(ontology: Ontology, restriction: Node) -> bool:
    """Whether a restriction says that there is at least one value."""
    if any(ontology.objects(restriction, p) for p in _EXISTING):
        return True
    return any(
        isinstance(n, Literal) and str(n).strip() not in ("0", "00")
        for p in _AT_LEAST
        for n in ontology.objects(restriction, p)
    )
