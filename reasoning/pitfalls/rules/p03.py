"""P03: a property called "is" in place of subClassOf, type or sameAs."""

from __future__ import annotations

from collections.abc import Iterator

from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P03",
    title='Creating the relationship "is" instead of using "rdfs:subClassOf", "rdf:type" or '
    '"owl:sameAs"',
    severity=Severity.CRITICAL,
    affects=("object property",),
    categories=("N1", "N2"),
    description="A property of one's own says what the language has words for: that a class is "
    "below another, that an individual belongs to a class, or that two names are of one thing. "
    "No reasoner understands it.",
    remedy="Use rdfs:subClassOf between classes, rdf:type from an individual to its class, "
    "owl:sameAs between individuals.",
)

_NAMES = ("is", "isa", "is-a", "is_a")


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Object properties called is, isA, is-a or is_a, in whatever case."""
    for prop in ontology.object_properties:
        name = local_name(prop)
        if name.lower() in _NAMES:
            yield Finding((prop,), f"{name} says what the language itself can say")
