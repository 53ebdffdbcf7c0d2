"""P33: property chains of a single property."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import OWL, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P33",
    title="Creating a property chain with just one property",
    severity=Severity.MINOR,
    affects=("object property",),
    categories=("N1",),
    description="A property chain that has a single property, or none, where a chain joins two "
    "or more.",
    remedy="Say rdfs:subPropertyOf if one property is meant to imply the other, or complete the "
    "chain.",
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Properties with a chain of fewer than two properties; each chain is a finding.

    An inverse, as an anonymous expression, is a property of a chain.
    """
    for prop, chain, members in _short(ontology):
        name = local_name(prop)
        if members:
            only = _name(ontology, members[0])
            message = f"the chain of {name} has just one property, {only}"
            mend = f"Say that {only} is a sub-property of {name}, or complete the chain."
        else:
            message, mend = f"the chain of {name} has no property", ""
        yield Finding((prop,), message, ((prop, OWL.propertyChainAxiom, chain),), mend=mend)


def _short(ontology: Ontology) -> Iterator[tuple[URIRef, Node, list[Node]]]:
    for prop, chains in ontology.statements(OWL.propertyChainAxiom).items():
        for chain in chains:
            members = ontology.members(chain)
            if isinstance(prop, URIRef) and len(members) < 2:
                yield prop, chain, members


def _name(ontology: Ontology, prop: Node) -> str:
    if isinstance(prop, URIRef):
        return local_name(prop)
    inverse = next(iter(ontology.objects(prop, OWL.inverseOf)), None)
    return "an expression" if inverse is None else f"the inverse of {local_name(str(inverse))}"


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """As OOPS!: one finding a property, and an inverse is not looked for."""
    found = {
        prop
        for prop, _, members in _short(ontology)
        if all(isinstance(member, URIRef) for member in members)
    }
    for prop in sorted(found):
        name = local_name(prop)
        yield Finding((prop,), f"the chain of {name} has just one property")
