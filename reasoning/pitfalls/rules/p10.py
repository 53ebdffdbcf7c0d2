"""P10: no two classes are said to be disjoint."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

from rdflib import OWL, RDFS, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.pitfalls.unread import not_read

PITFALL = Pitfall(
    code="P10",
    title="Missing disjoint-ness",
    severity=Severity.IMPORTANT,
    affects=("ontology",),
    categories=("N4", "S5"),
    description="Nothing is said about which classes have no members in common. A reasoner then "
    "takes it as possible that one thing belongs to all of them, and finds few contradictions.",
    remedy="State which classes exclude each other, with owl:AllDisjointClasses or "
    "owl:disjointWith.",
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Sibling classes, but no disjointness in any form."""
    if not _siblings(ontology) or _disjointness(ontology):
        return
    if ontology.unread:
        raise not_read(ontology)
    yield Finding((), "it says of no two classes that they have no members in common")


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! counts classes only, siblings or not, and knows no owl:complementOf."""
    if len(ontology.declared(OWL.Class)) >= 2 and not _stated(ontology):
        yield Finding((), "it states no disjointness of classes")


def _siblings(ontology: Ontology) -> bool:
    """Whether two classes below the same one (or below none) are not equivalent."""
    below: dict[URIRef | None, set[Node]] = defaultdict(set)
    known = set(ontology.classes)
    for cls in ontology.classes:
        if ontology.deprecated(cls):
            continue
        equivalents = [e for e in ontology.equivalents.get(cls, ()) if isinstance(e, URIRef)]
        same = min([cls, *equivalents], key=str)
        above = [c for c in ontology.superclasses.get(cls, ()) if c != cls and c in known]
        for parent in above or (None,):
            below[parent].add(same)
    return any(len(children) > 1 for children in below.values())


def _stated(ontology: Ontology) -> bool:
    """Whether any axiom of disjointness is there."""
    return bool(
        ontology.statements(OWL.disjointWith)
        or ontology.statements(OWL.disjointUnionOf)
        or any(OWL.AllDisjointClasses in kinds for kinds in ontology.kinds.values())
    )


def _disjointness(ontology: Ontology) -> bool:
    """Whether it is stated in any form.

    A class can be stated to be below another's complement, or what several classes have in common
    to be owl:Nothing.
    """
    if _stated(ontology):
        return True
    complements = ontology.statements(OWL.complementOf)
    return (
        any(
            isinstance(s, URIRef) and (s in complements or o in complements)
            for predicate in (RDFS.subClassOf, OWL.equivalentClass)
            for s, objects in ontology.statements(predicate).items()
            for o in objects
        )
        or any(isinstance(s, URIRef) for s in complements)
        or any(
            _is_nothing(ontology, s) and any(len({*ontology.members(o)}) > 1 for o in objects)
            for s, objects in ontology.statements(OWL.intersectionOf).items()
        )
    )


def _is_nothing(ontology: Ontology, expression: Node) -> bool:
    """Whether an expression, or what it is equivalent to, is stated to be owl:Nothing."""
    return any(
        OWL.Nothing in (*ontology.objects(c, RDFS.subClassOf), *ontology.equivalents.get(c, ()))
        for c in (expression, *ontology.equivalents.get(expression, ()))
    )
