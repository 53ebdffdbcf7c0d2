"""P12: properties of the same name that are not declared to be equivalent."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterator, Sequence

from rdflib import OWL, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.names import Relations, components, oops_name, squashed
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P12",
    title="Equivalent properties not explicitly declared",
    severity=Severity.IMPORTANT,
    affects=("object property", "datatype property"),
    categories=("N3", "N7", "S5"),
    description="Properties have the same name, but nothing says that they mean the same, so that "
    "what is stated with one is not found with the other.",
    remedy="Declare them with owl:equivalentProperty, drop one of them, or give them names that "
    "tell them apart.",
    oops_group="equivalentProperty",
)

_OF_DATA = "equivalentAttribute"


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Groups of properties whose names differ in case and punctuation at most.

    Properties of which one is above the other, that are inverse, that are equivalent, or that are
    disjoint, also by way of others, are no pair; neither are deprecated ones.
    """
    relations = Relations(
        components(ontology.equivalents),
        ontology.superproperties,
        _disjoint(ontology),
        ontology.inverses,
    )
    for props, group in _kinds(ontology):
        usable = [p for p in props if not ontology.deprecated(p)]
        yield from _alike(usable, lambda p: squashed(local_name(p)), relations, group)


def _disjoint(ontology: Ontology) -> Iterator[Sequence[Node]]:
    for s, objects in ontology.statements(OWL.propertyDisjointWith).items():
        for o in objects:
            yield s, o
    for s, objects in ontology.statements(OWL.members).items():
        if OWL.AllDisjointProperties in ontology.kinds.get(s, ()):
            for o in objects:
                yield ontology.members(o)


def _kinds(ontology: Ontology) -> list[tuple[Sequence[URIRef], str]]:
    return [(ontology.object_properties, ""), (ontology.datatype_properties, _OF_DATA)]


def _alike(
    props: Sequence[URIRef],
    name: Callable[[URIRef], str],
    relations: Relations,
    group: str,
) -> Iterator[Finding]:
    by_name: dict[str, list[URIRef]] = defaultdict(list)
    for prop in sorted({*props}):
        by_name[name(prop)].append(prop)
    groups = [same for key, same in sorted(by_name.items()) if key and len(same) > 1]
    for found in relations.unrelated(groups, str):
        if found:
            names = sorted({local_name(p) for p in found})
            called = f"are all called {names[0]}" if len(names) == 1 else "are named alike"
            first = "" if len(names) == 1 else f" ({', '.join(names)})"
            yield Finding(
                tuple(found),
                f"{len(found)} properties {called}{first} and not declared to be equivalent",
                oops_group=group,
            )


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """As OOPS! does: properties with an equivalent are left out, whatever it is.

    A property that is only the object of owl:equivalentProperty still is a pair with one that is
    neither subject nor object. Deprecated properties count.
    """
    stated = ontology.statements(OWL.equivalentProperty)
    targets = {o: 0 for objects in stated.values() for o in objects}
    relations = Relations(targets, ontology.superproperties)
    for props, group in _kinds(ontology):
        yield from _alike([p for p in props if p not in stated], _oops_key, relations, group)


def _oops_key(prop: URIRef) -> str:
    return re.sub(r"[^a-z0-9]", "", oops_name(prop).lower())
