"""P35: what is used as a property is not declared as one."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import OWL, RDF, RDFS, URIRef

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology, is_builtin
from symboslam.reasoning.pitfalls.unread import not_read
from symboslam.reasoning.pitfalls.uses import (
    LIST,
    OBJECT,
    SUBJECT,
    SWRL,
    by_place,
    first_uses,
    is_of_rules,
    whole,
)
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P35",
    title="Untyped property",
    severity=Severity.IMPORTANT,
    affects=("object property", "datatype property"),
    categories=("N41",),
    description="Something is used as a property, but nothing declares it as one. Often it is a "
    "slip of the pen; and tools cannot know whether it takes things or values.",
    remedy="Declare it with owl:ObjectProperty, owl:DatatypeProperty or owl:AnnotationProperty, "
    "correct its name, or import the ontology that declares it.",
)

_JENA_TYPES = {
    RDF.Property, OWL.ObjectProperty, OWL.DatatypeProperty, OWL.AnnotationProperty,
    OWL.TransitiveProperty, OWL.SymmetricProperty, OWL.InverseFunctionalProperty,
    OWL.FunctionalProperty,
}  # fmt: skip
_DECLARED = _JENA_TYPES | {
    OWL.AsymmetricProperty, OWL.ReflexiveProperty, OWL.IrreflexiveProperty,
    OWL.OntologyProperty, OWL.DeprecatedProperty, RDFS.ContainerMembershipProperty,
}  # fmt: skip
_AS_OOPS = {
    RDFS.domain: SUBJECT,
    RDFS.range: SUBJECT,
    RDFS.subPropertyOf: SUBJECT | OBJECT,
    OWL.equivalentProperty: SUBJECT | OBJECT,
    OWL.propertyDisjointWith: SUBJECT | OBJECT,
    OWL.inverseOf: SUBJECT | OBJECT,
}
_USES = {
    **_AS_OOPS,
    OWL.onProperty: OBJECT,
    OWL.onProperties: LIST,
    OWL.propertyChainAxiom: SUBJECT | LIST,
    OWL.hasKey: LIST,
    OWL.assertionProperty: OBJECT,
    SWRL.propertyPredicate: OBJECT,
}


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Terms that stand where only a property can stand, and are not declared as one.

    Predicates count if they are in a namespace in which the given files declare terms; others, as
    those of Dublin Core, are customarily used without a declaration.
    """
    found = _predicates(ontology)
    found.update(first_uses(ontology, _USES, OWL.AllDisjointProperties, _DECLARED))
    if found and ontology.unread:
        raise not_read(ontology)
    for term in sorted(found):
        yield _finding(ontology, term, found[term])


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! looks neither inside of class expressions and lists nor at predicates."""
    uses = first_uses(ontology, _AS_OOPS, declared=_JENA_TYPES)
    for term in sorted(uses):
        yield _finding(ontology, term, uses[term])


def _predicates(ontology: Ontology) -> dict[URIRef, Triple]:
    """Predicates in namespaces of the ontology's own -> the first statement with it."""
    own = {
        _namespace(s)
        for document in ontology.documents
        if document.given
        for s, _, kind in document.graph.triples((None, RDF.type, None))
        if isinstance(s, URIRef) and (kind in _DECLARED or kind == OWL.Class)
    }
    return {
        p: min(ontology.graph.triples((None, p, None)), key=lambda t: by_place(ontology, t))
        for p in set(ontology.graph.predicates())
        if isinstance(p, URIRef)
        and not ontology.kinds.get(p, frozenset()) & _DECLARED
        and _namespace(p) in own
        and not (is_builtin(p) or is_of_rules(p))
    }


def _namespace(term: URIRef) -> str:
    return term.removesuffix(local_name(term))


def _finding(ontology: Ontology, term: URIRef, triple: Triple) -> Finding:
    message = f"is {_role(term, triple)}, but is not declared as a property"
    axiom = triple if is_of_rules(triple[1]) else whole(ontology, triple)
    return Finding((term,), message, (axiom,))


def _role(term: URIRef, triple: Triple) -> str:
    s, p, o = triple
    if p == term:
        return "used as a predicate"
    if p in (RDFS.domain, RDFS.range):
        return f"given a {local_name(str(p))}"
    if p == RDFS.subPropertyOf:
        other = o if s == term else s
        where = "below" if s == term else "above"
        name = local_name(str(other)) if isinstance(other, URIRef) else "another"
        return f"stated to be {where} the property {name}"
    if p == RDF.type:
        return "listed among disjoint properties"
    if is_of_rules(p):
        return "used as a property in a rule"
    return f"used as a property (with {local_name(str(p))})"
