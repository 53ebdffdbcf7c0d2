"""P06: classes that are, over any number of steps, below themselves."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping, Sequence

from rdflib import RDFS, URIRef

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
    code="P06",
    title="Including cycles in a class hierarchy",
    severity=Severity.CRITICAL,
    affects=("class",),
    categories=("N2", "S4"),
    description="A class is below another one and, perhaps over several steps, above it as well. "
    "To a reasoner all classes of such a cycle are one and the same.",
    remedy="Remove one subclass axiom of the cycle; say owl:equivalentClass if the classes are "
    "meant to be the same.",
)

_SHOWN = 8

Above = Mapping[URIRef, Sequence[URIRef]]


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Sets of classes that are all below one another, by asserted named superclasses.

    One finding a set. The axioms are those of a shortest cycle, which goes through a statement of
    a given file if there is one.
    A class stated to be below itself says nothing and is no cycle (P24 has it).
    """
    above = _above(ontology)
    for component in sorted(_components(above)):
        cycle = _shortest(above, component, _given(ontology, above, component))
        names = [local_name(c) for c in [*cycle, cycle[0]]]
        if len(names) > _SHOWN:
            names = [*names[: _SHOWN - 2], f"{len(names) - _SHOWN + 1} more", names[-1]]
        message = " below ".join(names)
        if len(component) > len(cycle):
            message += f"; {len(component)} classes in all are below one another"
        steps = zip(cycle, [*cycle[1:], cycle[0]], strict=True)
        yield Finding(
            tuple(component),
            message,
            tuple((one, RDFS.subClassOf, other) for one, other in steps),
        )


def _above(ontology: Ontology) -> dict[URIRef, list[URIRef]]:
    return {
        c: sorted(other for other in others if other != c)
        for c, others in sorted(ontology.superclasses.items())
    }


def _components(above: Above) -> Iterator[list[URIRef]]:
    """The strongly connected components of two or more classes (Tarjan's algorithm)."""
    index: dict[URIRef, int] = {}
    low: dict[URIRef, int] = {}
    stack: list[URIRef] = []
    on_stack: set[URIRef] = set()
    for start in above:
        if start in index:
            continue
        path = [(start, iter(above[start]))]
        index[start] = low[start] = len(index)
        stack.append(start)
        on_stack.add(start)
        while path:
            node, others = path[-1]
            other = next(others, None)
            if other is None:
                path.pop()
                if path:
                    below = path[-1][0]
                    low[below] = min(low[below], low[node])
                if low[node] == index[node]:
                    component = [stack.pop()]
                    while component[-1] != node:
                        component.append(stack.pop())
                    on_stack.difference_update(component)
                    if len(component) > 1:
                        yield sorted(component)
            elif other not in index:
                index[other] = low[other] = len(index)
                stack.append(other)
                on_stack.add(other)
                path.append((other, iter(above.get(other, ()))))
            elif other in on_stack:
                low[node] = min(low[node], index[other])


def _given(ontology: Ontology, above: Above, component: Sequence[URIRef]) -> list[URIRef]:
    """Where a cycle begins: with a statement of a given file, else with the first class."""
    members = {*component}
    for one in component:
        for other in above.get(one, ()):
            if other in members and ontology.is_given((one, RDFS.subClassOf, other)):
                return [one, other]
    return [component[0]]


def _shortest(above: Above, component: Sequence[URIRef], start: Sequence[URIRef]) -> list[URIRef]:
    """A shortest way up from the end of ``start`` to where ``start`` begins."""
    members = {*component}
    came: dict[URIRef, URIRef] = {}
    waiting = deque([start[-1]])
    while start[0] not in came and waiting:
        node = waiting.popleft()
        for other in above.get(node, ()):
            if other in members and other not in came:
                came[other] = node
                waiting.append(other)
    cycle = [came[start[0]]]
    while cycle[-1] != start[-1]:
        cycle.append(came[cycle[-1]])
    return [*start[:-1], *cycle[::-1]]


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """As OOPS! does: it finds cycles only where no class has a superclass of a superclass.

    Its loop over the superclasses of a class fails when they have superclasses of their own that
    are new to it; it then gives up the pitfall and reports none. So it finds cycles of two classes
    and little else. Groups are of classes each of which is directly above or below all others.

    Raises:
        NotCheckedError: where OOPS! would have given up.
    """
    above = _above(ontology)
    in_cycle = [c for c in ontology.classes if _found_by_oops(above, c)]
    groups: list[list[URIRef]] = []
    for one in in_cycle:
        fitting = [
            group
            for group in groups
            if all(c in above.get(one, ()) or one in above.get(c, ()) for c in group)
        ]
        for group in fitting:
            group.append(one)
        if not fitting:
            groups.append([one])
    for group in groups:
        names = ", ".join(map(local_name, group))
        yield Finding(tuple(group), f"classes in a cycle: {names}")


def _found_by_oops(above: Above, one: URIRef) -> bool:
    known = dict.fromkeys(above.get(one, ()))
    for other in list(known):
        new = [c for c in above.get(other, ()) if c not in known]
        known.update(dict.fromkeys(new))
        if one.lower() in {c.lower() for c in known}:
            return True
        if new:
            raise NotCheckedError(
                "OOPS! itself stops here without saying so: its loop over the superclasses of "
                f"{local_name(one)} fails because {local_name(other)} has superclasses as well"
            )
    return False
