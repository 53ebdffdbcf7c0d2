"""P25: a property that is its own inverse."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import OWL

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
    """Object properties that are stated to be inverse of themselves, symmetric or not."""
    for prop in ontology.object_properties:
        if prop in ontology.objects(prop, OWL.inverseOf):
            name = local_name(prop)
            yield Finding(
                (prop,), f"{name} is the inverse of itself", ((prop, OWL.inverseOf, prop),)
            )
