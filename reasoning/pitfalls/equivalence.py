"""What is stated to be equivalent or inverse, directly or by way of other terms."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping

from rdflib import OWL, Literal, URIRef
from rdflib.term import Node

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.names import components
from symboslam.reasoning.pitfalls.ontology import Ontology, is_builtin

_STEPS = 20


class Equivalences:
    """What is stated to be equivalent, directly or over several steps.

    Terms of the languages themselves join nothing: two classes that are both said to be
    ``owl:Nothing`` are empty, and no names for each other.

    Args:
        ontology: where.
        predicate: ``owl:equivalentClass`` or ``owl:equivalentProperty``.
        joins: which of the statements count; all of them if left out.
    """

    def __init__(
        self,
        ontology: Ontology,
        predicate: URIRef,
        joins: Callable[[Node, Node], bool] = lambda one, other: True,
    ) -> None:
        self._next: dict[Node, dict[Node, list[Triple]]] = defaultdict(lambda: defaultdict(list))
        for s, objects in ontology.statements(predicate).items():
            for o in objects:
                if s == o or isinstance(o, Literal) or is_builtin(s) or is_builtin(o):
                    continue
                if joins(s, o):
                    self._next[s][o].append((s, predicate, o))
                    self._next[o][s].append((s, predicate, o))
        self._part = components({node: [*others] for node, others in self._next.items()})

    def together(self, one: Node, other: Node) -> bool:
        """Whether two terms or expressions are equivalent."""
        return one == other or (one in self._part and self._part[one] == self._part.get(other))

    def groups(self) -> list[list[URIRef]]:
        """The terms that are equivalent to each other: by name, two or more a group."""
        found: dict[int, list[URIRef]] = defaultdict(list)
        for node in self._part:
            if isinstance(node, URIRef):
                found[self._part[node]].append(node)
        return sorted(sorted(group) for group in found.values() if len(group) > 1)

    def between(self, one: Node, other: Node) -> tuple[Triple, ...]:
        """What is stated of two terms, else what leads from one to the other."""
        direct = self._next[one].get(other)
        return tuple(sorted(direct)) if direct else self.axioms(self.ways(other), one)

    def ways(self, start: Node) -> dict[Node, Node]:
        """Each term of a group -> the next one on its shortest way to ``start``."""
        found, step = {start: start}, [start]
        while step:
            ahead = []
            for node in step:
                for other in sorted(self._next.get(node, ()), key=str):
                    if other not in found:
                        found[other] = node
                        ahead.append(other)
            step = ahead
        return found

    def axioms(self, ways: Mapping[Node, Node], end: Node) -> tuple[Triple, ...]:
        """What is stated on the way from ``end``, as far as ``_STEPS`` steps."""
        stated: list[Triple] = []
        for _ in range(_STEPS):
            if ways[end] != end:
                stated += sorted(self._next[end][ways[end]])
            end = ways[end]
        return tuple(stated)


def stated_inverses(ontology: Ontology) -> Iterator[tuple[URIRef, URIRef, Triple]]:
    """Pairs of properties that are stated to be inverse, each with the triple that says so.

    It is ``owl:inverseOf``, or that one is equivalent to the inverse of the other.
    """
    for one, others in ontology.statements(OWL.inverseOf).items():
        named = [o for o in others if isinstance(o, URIRef) and not is_builtin(o)]
        if isinstance(one, URIRef):
            if not is_builtin(one):
                yield from ((one, other, (one, OWL.inverseOf, other)) for other in named)
            continue
        for prop in ontology.equivalents.get(one, ()):
            if isinstance(prop, URIRef) and not is_builtin(prop):
                stated = (prop, OWL.equivalentProperty, one)
                axiom = stated if stated in ontology.graph else (one, stated[1], prop)
                yield from ((prop, other, axiom) for other in named)
