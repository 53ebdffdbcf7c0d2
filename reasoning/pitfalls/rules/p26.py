"""P26: symmetric properties with an inverse."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import OWL, URIRef

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P26",
    title="Defining inverse relationships for a symmetric one",
    severity=Severity.IMPORTANT,
    affects=("object property",),
    categories=("N1",),
    description="A symmetric property has another property as its inverse. It is its own inverse "
    "already, so the two say the same.",
    remedy="Remove the inverse, or the symmetry if it is wrong.",
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Symmetric properties that are stated to be the inverse of another named property.

    Its inverse as an anonymous expression is not another property; itself as its inverse is P25.
    """
    return _find(ontology, itself=False)


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """The same, but itself as its inverse counts."""
    return _find(ontology, itself=True)


def _find(ontology: Ontology, itself: bool) -> Iterator[Finding]:
    for prop in ontology.declared(OWL.SymmetricProperty):
        others = [
            other
            for other in ontology.inverses.get(prop, ())
            if isinstance(other, URIRef) and (itself or other != prop)
        ]
        if not others:
            continue
        names = " and ".join(map(local_name, others))
        both: list[Triple] = [
            t for o in others for t in ((prop, OWL.inverseOf, o), (o, OWL.inverseOf, prop))
        ]
        axioms = dict.fromkeys(t for t in both if t in ontology.graph)
        message = f"{local_name(prop)} is symmetric and yet has an inverse, {names}"
        yield Finding((prop,), message, tuple(axioms))
