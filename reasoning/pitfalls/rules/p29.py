"""P29: transitive properties whose domain and range differ."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import OWL, RDF

from symboslam.reasoning.pitfalls.groups import listed, oops_unlike_ends, unlike_ends
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P29",
    title="Defining wrong transitive relationships",
    severity=Severity.CRITICAL,
    affects=("object property",),
    categories=("N2",),
    description="A property is transitive although its domain and range differ. What is in the "
    "middle of two steps is then taken to be in both classes.",
    remedy="Remove the characteristic, or state the same class as domain and as range.",
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Transitive properties with both a domain and a range, which are not the same."""
    for prop in unlike_ends(ontology, OWL.TransitiveProperty):
        domains, ranges = (
            listed(ontology, ends) for ends in (ontology.domains(prop), ontology.ranges(prop))
        )
        yield Finding(
            (prop,),
            f"{local_name(prop)} is transitive, but goes from {domains} to {ranges}",
            ((prop, RDF.type, OWL.TransitiveProperty),),
        )


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """The same by OOPS!'s comparison, which knows directly stated equivalences only."""
    for prop in oops_unlike_ends(ontology, OWL.TransitiveProperty):
        name = local_name(prop)
        yield Finding((prop,), f"{name} is transitive, but its domain and range differ")
