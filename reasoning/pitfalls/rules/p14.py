"""P14: "only" where "some" may be meant."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import OWL, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.conditions import above, conditions, left_to_people, requires
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology, is_builtin
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P14",
    title='Misusing "owl:allValuesFrom"',
    severity=Severity.CRITICAL,
    affects=("class",),
    categories=(
        "N2",
        "S4",
    ),
    description="A class is said to have values of one kind only on a property, and nowhere that it "
    "has any: what has no value at all fits too.",
    remedy="Add that there is a value (owl:someValuesFrom or a cardinality of at least 1), if "
    "that is meant.",
    advisory=True,
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Classes with "only" on an object property, and no superclass that requires a value.

    "Only nothing" and "only not ..." say that something is missing, and so need no value. A class
    below one that nothing is known of is left alone.
    """
    if not ontology.statements(OWL.allValuesFrom):
        return
    for cls in ontology.classes:
        found = {
            on: (c.node, c.axiom)
            for c in conditions(ontology, cls)
            for on in ontology.objects(c.node, OWL.onProperty)
            if any(_limits(ontology, filler) for filler in _fillers(ontology, c.node))
            and OWL.DatatypeProperty not in ontology.kinds.get(on, ())
        }
        if not found or ontology.deprecated(cls):
            continue
        classes = above(ontology, cls)
        if any(c not in ontology.kinds and not is_builtin(c) for c in classes):
            continue
        required = _required(ontology, classes)
        for on in sorted(found.keys() - required, key=str):
            node, axiom = found[on]
            if isinstance(on, URIRef):
                yield Finding(
                    (cls,),
                    f"what has no {local_name(on)} at all fits "
                    f'"{ontology.words.expression(node)}" too',
                    (axiom,),
                    f"Add that {local_name(cls)} has some {local_name(on)}, if that is meant.",
                )


def _fillers(ontology: Ontology, node: Node) -> tuple[Node, ...]:
    return ontology.objects(node, OWL.allValuesFrom)


def _limits(ontology: Ontology, filler: Node) -> bool:
    """Whether a class says which values there may be, and not which there may not."""
    return filler not in (OWL.Nothing, OWL.Thing) and not (
        ontology.objects(filler, OWL.complementOf)
        or ontology.objects(filler, OWL.datatypeComplementOf)
    )


def _required(ontology: Ontology, classes: list[URIRef]) -> set[Node]:
    """The properties of which the classes, or properties above, have to have a value."""
    found: set[Node] = set()
    waiting = [
        on
        for cls in classes
        for c in conditions(ontology, cls)
        if requires(ontology, c.node)
        for on in ontology.objects(c.node, OWL.onProperty)
    ]
    while waiting:
        prop = waiting.pop()
        if prop not in found:
            found.add(prop)
            waiting += ontology.superproperties.get(prop, ()) if isinstance(prop, URIRef) else ()
    return found


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! has no rule."""
    raise left_to_people()
