"""P26: symmetric properties with an inverse."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator

from rdflib import OWL, URIRef

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.equivalence import stated_inverses
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

    To be equivalent to the inverse of another says the same. An anonymous inverse is not another
    property; itself as its inverse is P25.
    """
    return _find(ontology, [s for s in stated_inverses(ontology) if s[0] != s[1]])


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """The same by owl:inverseOf alone, but itself as its inverse counts."""
    return _find(ontology, [s for s in stated_inverses(ontology) if s[2][1] == OWL.inverseOf])


def _find(ontology: Ontology, stated: Iterable[tuple[URIRef, URIRef, Triple]]) -> Iterator[Finding]:
    found: dict[URIRef, dict[URIRef, list[Triple]]] = defaultdict(lambda: defaultdict(list))
    for one, other, axiom in stated:
        for prop, inverse in {(one, other), (other, one)}:
            found[prop][inverse].append(axiom)
    for prop in ontology.declared(OWL.SymmetricProperty):
        if prop in found:
            names = " and ".join(map(local_name, sorted(found[prop])))
            axioms = [axiom for _, said in sorted(found[prop].items()) for axiom in sorted(said)]
            message = f"{local_name(prop)} is symmetric and yet has an inverse, {names}"
            yield Finding((prop,), message, (*axioms,))
