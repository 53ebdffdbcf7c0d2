"""P14: "only" where "some" may be meant."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping

from rdflib import OWL, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.conditions import conditions, left_to_people, requires
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology, is_builtin
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P14",
    title='Misusing "owl:allValuesFrom"',
    severity=Severity.CRITICAL,
    affects=("class",),
    categories=("N2", "S4"),
    description="A class is said to have values of one kind only on a property, and nowhere "
    "that it "
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
    stated = {cls: list(conditions(ontology, cls)) for cls in ontology.classes}
    below: dict[Node, list[URIRef]] = defaultdict(list)
    requiring: dict[Node, set[Node]] = defaultdict(set)
    for cls, found in stated.items():
        for c in found:
            below[c.node].append(cls)
            if requires(ontology, c.node):
                for on in _with_above(ontology, ontology.objects(c.node, OWL.onProperty)):
                    requiring[on].add(cls)
    unknown = {n for n in below if isinstance(n, URIRef) and n not in ontology.kinds}
    left_alone = _all_below(below, {n for n in unknown if not is_builtin(n)})
    fine: dict[Node, set[Node]] = {}
    for cls, found in stated.items():
        if cls in left_alone or ontology.deprecated(cls):
            continue
        limited = {
            on: c
            for c in found
            if any(_limits(ontology, filler) for filler in _fillers(ontology, c.node))
            for on in ontology.objects(c.node, OWL.onProperty)
            if isinstance(on, URIRef) and OWL.DatatypeProperty not in ontology.kinds.get(on, ())
        }
        for on, c in sorted(limited.items()):
            if on not in fine:
                fine[on] = _all_below(below, requiring[on])
            if cls not in fine[on]:
                yield Finding(
                    (cls,),
                    f"what has no {local_name(on)} at all fits "
                    f'"{ontology.words.expression(c.node)}" too',
                    (c.axiom,),
                    f"Add that {local_name(cls)} has some {local_name(on)}, if that is meant.",
                )


def _all_below(below: Mapping[Node, list[URIRef]], classes: set[Node]) -> set[Node]:
    """The classes and all that is below them."""
    seen, waiting = set(classes), list(classes)
    while waiting:
        fresh = [c for c in below.get(waiting.pop(), ()) if c not in seen]
        seen.update(fresh)
        waiting += fresh
    return seen


def _with_above(ontology: Ontology, props: Iterable[Node]) -> set[Node]:
    """Properties, and those that they are below."""
    found: set[Node] = set()
    waiting = list(props)
    while waiting:
        prop = waiting.pop()
        if prop not in found:
            found.add(prop)
            waiting += ontology.superproperties.get(prop, ()) if isinstance(prop, URIRef) else ()
    return found


def _fillers(ontology: Ontology, node: Node) -> tuple[Node, ...]:
    return ontology.objects(node, OWL.allValuesFrom)


def _limits(ontology: Ontology, filler: Node) -> bool:
    """Whether a class says which values there may be, and not which there may not."""
    return filler not in (OWL.Nothing, OWL.Thing) and not (
        ontology.objects(filler, OWL.complementOf)
        or ontology.objects(filler, OWL.datatypeComplementOf)
    )


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! has no rule."""
    raise left_to_people()
