"""P19: properties with several domains or ranges, which together mean their intersection."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise

from rdflib import RDFS, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.groups import listed, oops_equal, oops_same, same
from symboslam.reasoning.pitfalls.model import (
    Finding,
    NotCheckedError,
    Pitfall,
    Settings,
    Severity,
)
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P19",
    title="Defining multiple domains or ranges in properties",
    severity=Severity.CRITICAL,
    affects=("object property", "datatype property"),
    categories=("N2", "S4"),
    description="A property has several domains or ranges. They do not mean one or the other: "
    "whatever has the property belongs to all of them at once.",
    remedy="State one domain (or range): the union (owl:unionOf) if any of the classes will do, "
    "the intersection (owl:intersectionOf) if all are meant.",
)

_ENDS = ((RDFS.domain, "domains"), (RDFS.range, "ranges"))


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Object and datatype properties whose several domains, or ranges, are not all the same.

    Domains are one finding of a property, and ranges another. A class together with one above it
    is a finding as well: it does no harm, but mostly the union was meant.
    """
    for prop in dict.fromkeys(ontology.object_properties + ontology.datatype_properties):
        for predicate, word in _ENDS:
            values = _in_order(ontology, prop, predicate)
            if all(same(ontology, values[0], other) for other in values[1:]):
                continue
            axioms = [(prop, predicate, value) for value in [*values[1:], values[0]]]
            yield Finding(
                (prop,),
                f"{local_name(prop)} has {len(values)} {word}, and whatever it joins belongs to "
                f"all of them: {listed(ontology, values)}",
                tuple(axioms),
                mend=_mend(ontology, values),
            )


def _mend(ontology: Ontology, values: Sequence[Node]) -> str:
    """What to do about two of which one is below the other; empty for anything else."""
    if len(values) == 2:
        for upper, lower in (values, values[::-1]):
            if _is_above(ontology, upper, lower):
                above, below = map(ontology.words.expression, (upper, lower))
                return f"Remove {below} if any {above} will do, else {above}, which adds nothing."
    return ""


def _in_order(ontology: Ontology, prop: URIRef, predicate: URIRef) -> list[Node]:
    """The domains or ranges as they stand in the file."""

    def order(value: Node) -> tuple[str, int, str]:
        place = ontology.place((prop, predicate, value))
        text = ontology.words.expression(value)
        return (place.file, place.line or 0, text) if place else ("", 0, text)

    return sorted(ontology.objects(prop, predicate), key=order)


def _is_above(ontology: Ontology, upper: Node, lower: Node) -> bool:
    """Whether a named class is above another, over any number of steps."""
    waiting, seen = [lower], {lower}
    while waiting:
        node = waiting.pop()
        for other in ontology.superclasses.get(node, ()) if isinstance(node, URIRef) else ():
            if other not in seen:
                seen.add(other)
                waiting.append(other)
    return upper != lower and upper in seen


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """As OOPS!: one finding a property, and several ranges of a datatype property always are one.

    It compares neighbours in an order of its own, by the form of expressions and directly stated
    equivalences only.

    Raises:
        NotCheckedError: two expressions of like form are among them, which OOPS! does not survive.
    """
    for prop in ontology.object_properties:
        ends = [_in_order(ontology, prop, predicate) for predicate, _ in _ENDS]
        if any(_oops_differ(ontology, prop, values) for values in ends):
            yield _oops_finding(prop)
    for prop in ontology.datatype_properties:
        domains, ranges = (_in_order(ontology, prop, predicate) for predicate, _ in _ENDS)
        if _oops_differ(ontology, prop, domains) or len(ranges) > 1:
            yield _oops_finding(prop)


def _oops_finding(prop: URIRef) -> Finding:
    return Finding((prop,), f"{local_name(prop)} has several domains or ranges")


def _oops_differ(ontology: Ontology, prop: URIRef, values: Sequence[Node]) -> bool:
    for one, other in pairwise(values):
        if oops_equal(ontology, one, other):
            raise NotCheckedError(
                "OOPS! itself stops here without saying so: comparing the domains or ranges of "
                f"{local_name(prop)} it removes an item of a list that cannot be changed"
            )
        if not oops_same(ontology, [one], [other]):
            return True
    return False
