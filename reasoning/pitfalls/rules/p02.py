"""P02: synonyms as classes of their own, stated to be equivalent."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import OWL, RDFS, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.equivalence import Equivalences
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology, is_builtin
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P02",
    title="Creating synonyms as classes",
    severity=Severity.MINOR,
    affects=("class",),
    categories=("N1", "N7", "S6"),
    description="Two classes of one namespace are stated to be equivalent: one concept has got "
    "two classes because it has two names.",
    remedy="Keep one of the classes and give it the other name as a further label.",
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Named classes of one namespace that are stated to be equivalent.

    Of those that are equivalent, directly or by way of each other, each is a finding together with
    the first, whichever way round and however often it is stated. Deprecated classes are left out,
    as their equivalences say what to use in their place, and datatypes.
    """

    def joins(one: Node, other: Node) -> bool:
        return _alike(one, other) and not any(
            ontology.deprecated(term) or RDFS.Datatype in ontology.kinds.get(term, ())
            for term in (one, other)
        )

    known = Equivalences(ontology, OWL.equivalentClass, joins)
    for one, *others in known.groups():
        ways = known.ways(one)
        for other in others:
            first, second = local_name(one), local_name(other)
            yield Finding(
                (one, other),
                f"{first} and {second} are two classes for one concept",
                known.axioms(ways, other),
                mend=f"Keep one of {first} and {second}, with the other name as a further label.",
            )


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """The same by statement: each is a finding about its subject alone, deprecated or not."""
    for one, other in sorted(_stated(ontology)):
        if one in ontology.kinds:
            message = f"{local_name(one)} and {local_name(other)} are two classes for one concept"
            yield Finding((one,), message, ((one, OWL.equivalentClass, other),))


def _stated(ontology: Ontology) -> Iterator[tuple[URIRef, URIRef]]:
    for one, others in ontology.statements(OWL.equivalentClass).items():
        for other in others:
            if isinstance(one, URIRef) and isinstance(other, URIRef) and _alike(one, other):
                yield one, other


def _alike(one: Node, other: Node) -> bool:
    """Whether two terms are of one namespace, with names that differ by more than case."""
    if not isinstance(one, URIRef) or not isinstance(other, URIRef) or is_builtin(one):
        return False
    same_namespace = _namespace(one) == _namespace(other)
    return same_namespace and local_name(one).lower() != local_name(other).lower()


def _namespace(iri: str) -> str:
    return iri.rstrip("/").removesuffix(local_name(iri))
