"""P05: inverse properties whose domains and ranges do not fit."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import OWL, URIRef

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.equivalence import stated_inverses
from symboslam.reasoning.pitfalls.groups import listed, oops_equal_all, same_all
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology, is_builtin
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P05",
    title="Defining wrong inverse relationships",
    severity=Severity.CRITICAL,
    affects=("object property",),
    categories=("N2", "S4"),
    description="Two properties are stated to be inverse although the domain of one is not the "
    "range of the other. What they join is then taken to be in both classes.",
    remedy="Remove the inverse if it is wrong; otherwise give the one property the domain that is "
    "the range of the other.",
    oops_group="notInverseRelationship",
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Pairs of properties that are stated to be inverse, where a domain is not the other's range.

    A domain or range that is not stated fits any. A pair is one finding, whichever way round it is
    stated.
    """
    pairs: dict[tuple[URIRef, URIRef], list[Triple]] = {}
    for one, other, axiom in stated_inverses(ontology):
        pairs.setdefault((min(one, other), max(one, other)), []).append(axiom)
    for (one, other), stated in sorted(pairs.items()):
        differ = []
        for from_, to in dict.fromkeys([(one, other), (other, one)]):
            domains, ranges = ontology.domains(from_), ontology.ranges(to)
            if domains and ranges and not same_all(ontology, domains, ranges):
                differ.append(
                    f"the domain of {local_name(from_)} ({listed(ontology, domains)}) is not the "
                    f"range of {local_name(to)} ({listed(ontology, ranges)})"
                )
        if differ:
            names = " and ".join(dict.fromkeys([local_name(one), local_name(other)]))
            yield Finding(
                tuple(dict.fromkeys([one, other])),
                f"{names}: stated to be inverse, but {' and '.join(differ)}",
                tuple(sorted(stated, key=lambda t: (t[1] != OWL.inverseOf, t))),
            )


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """As OOPS!: by the form of expressions alone, and the first wrong inverse of each property."""
    found: set[URIRef] = set()
    for one, other in sorted(_stated(ontology)):
        if one in found:
            continue
        ends = (
            (ontology.domains(one), ontology.ranges(other)),
            (ontology.ranges(one), ontology.domains(other)),
        )
        if any(a and b and not oops_equal_all(ontology, a, b) for a, b in ends):
            found.add(one)
            names = f"{local_name(one)} and {local_name(other)}"
            yield Finding((one, other), f"{names} are inverse, but domain and range do not fit")


def _stated(ontology: Ontology) -> Iterator[tuple[URIRef, URIRef]]:
    """What ``owl:inverseOf`` says of named properties."""
    for one, others in ontology.statements(OWL.inverseOf).items():
        for other in others:
            if not isinstance(one, URIRef) or not isinstance(other, URIRef):
                continue
            if not is_builtin(one) and not is_builtin(other):
                yield one, other
