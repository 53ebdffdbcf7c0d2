"""P34: what is used as a class is not declared as one."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import OWL, RDF, RDFS, URIRef
from rdflib.term import Node

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.pitfalls.unread import not_read
from symboslam.reasoning.pitfalls.uses import (
    LIST,
    OBJECT,
    SUBJECT,
    SWRL,
    first_uses,
    is_of_rules,
    whole,
)
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P34",
    title="Untyped class",
    severity=Severity.IMPORTANT,
    affects=("class",),
    categories=("N41",),
    description="Something is used as a class, but nothing declares it as one. Often it is a slip "
    "of the pen; strict tools refuse the file, and others take the term for something else.",
    remedy="Declare it with owl:Class (a datatype with rdfs:Datatype), correct its name, or import "
    "the ontology that declares it.",
    oops_severity=Severity.MINOR,
)

_DECLARED = {OWL.Class, RDFS.Class, RDFS.Datatype, OWL.DeprecatedClass, OWL.DataRange}
_USES = {
    RDF.type: OBJECT,
    RDFS.domain: OBJECT,
    RDFS.range: OBJECT,
    RDFS.subClassOf: SUBJECT | OBJECT,
    OWL.equivalentClass: SUBJECT | OBJECT,
    OWL.disjointWith: SUBJECT | OBJECT,
    OWL.complementOf: SUBJECT | OBJECT,
    OWL.someValuesFrom: OBJECT,
    OWL.allValuesFrom: OBJECT,
    OWL.onClass: OBJECT,
    OWL.onDataRange: OBJECT,
    OWL.onDatatype: OBJECT,
    OWL.unionOf: SUBJECT | LIST,
    OWL.intersectionOf: SUBJECT | LIST,
    OWL.disjointUnionOf: SUBJECT | LIST,
    OWL.hasKey: SUBJECT,
    SWRL.classPredicate: OBJECT,
    SWRL.dataRange: OBJECT,
}
_AS_OOPS = (
    RDF.type, RDFS.domain, RDFS.range, RDFS.subClassOf, OWL.disjointWith, OWL.equivalentClass,
)  # fmt: skip
_JENA_TYPES = {OWL.Class, OWL.Restriction, RDFS.Class, RDFS.Datatype}


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Terms that stand where only a class or a datatype can stand, and are not declared as such.

    The terms of the language of rules (SWRL) need no declaration.
    """
    uses = first_uses(ontology, _USES, OWL.AllDisjointClasses, _DECLARED)
    found = {term: triple for term, triple in uses.items() if not is_of_rules(term)}
    if found and ontology.unread:
        raise not_read(ontology)
    for term in sorted(found):
        yield _finding(ontology, term, found[term])


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! does not look inside of class expressions.

    The library that it uses also takes for a class whatever something is stated of, if it is the
    domain or range of a property or made of others by union, intersection or complement.
    """
    ends = {
        o
        for side in (RDFS.domain, RDFS.range)
        for objects in ontology.statements(side).values()
        for o in objects
    }
    composed = (OWL.intersectionOf, OWL.unionOf, OWL.complementOf)
    subjects = set(ontology.graph.subjects())
    uses = first_uses(ontology, {p: _USES[p] for p in _AS_OOPS})
    for term in sorted(uses):
        is_class = term in subjects and (
            term in ends
            or ontology.kinds.get(term, frozenset()) & _JENA_TYPES
            or any(ontology.objects(term, p) for p in composed)
        )
        if not is_class:
            yield _finding(ontology, term, uses[term])


def _finding(ontology: Ontology, term: URIRef, triple: Triple) -> Finding:
    message = f"is {_role(term, triple)}, but is not declared as a class"
    axiom = triple if is_of_rules(triple[1]) else whole(ontology, triple)
    return Finding((term,), message, (axiom,))


def _role(term: Node, triple: Triple) -> str:
    s, p, _ = triple
    if p == RDF.type and triple[2] == OWL.AllDisjointClasses:
        return "listed among disjoint classes"
    if p == RDF.type:
        return f"the type of {local_name(str(s))}" if isinstance(s, URIRef) else "used as a type"
    if p in (RDFS.domain, RDFS.range) and isinstance(s, URIRef):
        return f"the {local_name(str(p))} of {local_name(str(s))}"
    if p == RDFS.subClassOf:
        return "stated to be below a class" if s == term else "stated to be above a class"
    if is_of_rules(p):
        return "used as a class in a rule"
    return f"used as a class (with {local_name(str(p))})"
