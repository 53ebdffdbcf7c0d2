"""P25: a property that is its own inverse."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import OWL, BNode
from rdflib.term import Node

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.equivalence import Equivalences
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P25",
    title="Defining a relationship as inverse to itself",
    severity=Severity.IMPORTANT,
    affects=("object property",),
    categories=("N1",),
    description="A property is stated to be the inverse of itself, where OWL can say that it is "
    "symmetric.",
    remedy="Declare the property as owl:SymmetricProperty and remove the inverse.",
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Object properties that are stated to be inverse of themselves, symmetric or not.

    To be equivalent to one's own inverse says the same, also over several steps.
    """
    known = Equivalences(ontology, OWL.equivalentProperty)
    own: dict[Node, list[Triple]] = {}
    for inverse, props in ontology.statements(OWL.inverseOf).items():
        for prop in props:
            if inverse == prop:
                own.setdefault(prop, []).insert(0, (prop, OWL.inverseOf, prop))
            elif isinstance(inverse, BNode) and known.together(inverse, prop):
                own.setdefault(prop, []).extend(known.between(prop, inverse))
    for prop in ontology.object_properties:
        if prop in own:
            yield Finding((prop,), f"{local_name(prop)} is the inverse of itself", (*own[prop],))


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """The same, as far as owl:inverseOf says it."""
    for prop in ontology.object_properties:
        if prop in ontology.objects(prop, OWL.inverseOf):
            message = f"{local_name(prop)} is the inverse of itself"
            yield Finding((prop,), message, ((prop, OWL.inverseOf, prop),))
