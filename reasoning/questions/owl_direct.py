"""What HermiT says of an ontology and data: is it consistent, and what follows?

Only the locality module of the data is given to HermiT: by the axioms outside it nothing follows
about the individuals, and a contradiction never needs them. The class hierarchy is that of the
whole ontology and is made once; where classes are defined by their members it depends on the data
as well, and is made anew.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pyoxigraph import NamedNode, Quad, Triple

from symboslam.reasoning._base import Hierarchy, Realization, Reasoner
from symboslam.reasoning.axioms import Axiom, split
from symboslam.reasoning.axioms import Triple as Statement
from symboslam.reasoning.locality import module
from symboslam.reasoning.questions import vocabulary as v
from symboslam.reasoning.questions.rdf import graph_of
from symboslam.reasoning.vocabulary import NOTHING

if TYPE_CHECKING:
    from rdflib import Graph

_TYPE, _SUBCLASS = NamedNode(v.TYPE), NamedNode(v.SUBCLASS)
_EQUIVALENT, _NOTHING = NamedNode(v.EQUIVALENT_CLASS), NamedNode(NOTHING)


@dataclass(frozen=True)
class Logic:
    """The declarations and axioms of an ontology."""

    graph: Graph
    declared: frozenset[Statement]
    axioms: Sequence[Axiom]

    @classmethod
    def of(cls, graph: Graph) -> Logic:
        """The logic of a graph."""
        declared, axioms = split(graph)
        return cls(graph, frozenset(declared), axioms)

    def with_data(self, quads: Iterable[Quad]) -> Logic:
        """The ontology and data together."""
        graph = graph_of(quads)
        named = {term for triple in graph for term in triple}
        for statement in self.declared:  # they tell axioms from annotations
            if statement[0] in named:
                graph.add(statement)
        declared, axioms = split(graph)
        return Logic(graph, self.declared | declared, [*self.axioms, *axioms])

    def module(self) -> list[Statement]:
        """The triples that can make a contradiction, or say something about an individual."""
        axioms = module(self.axioms, [])
        return [*self.declared, *(triple for axiom in axioms for triple in axiom.triples)]

    def all(self) -> list[Statement]:
        """The triples of all declarations and axioms."""
        return [*self.declared, *(triple for axiom in self.axioms for triple in axiom.triples)]

    @property
    def has_members(self) -> bool:
        """Whether a class is described by individuals, so that these decide on subclasses."""
        from rdflib import OWL

        kinds = (OWL.hasValue, OWL.oneOf)
        return any(p in kinds for axiom in self.axioms for _, p, _ in axiom.triples)


def realize(logic: Logic, reasoner: Reasoner) -> Realization | None:
    """What follows about the individuals, or None if there is a contradiction.

    Raises:
        OntologyError: the axioms are outside OWL 2 DL.
        ReasonerError: the reasoner could not be run.
    """
    return reasoner.realize(logic.module())


def triples_of(hierarchy: Hierarchy, found: Realization) -> list[Triple]:
    """What follows, as triples.

    Args:
        hierarchy: the classes of the whole ontology.
        found: what follows about the individuals.
    """
    return [*_classes(hierarchy), *_individuals(hierarchy, found)]


def _classes(hierarchy: Hierarchy) -> Iterator[Triple]:
    for name in hierarchy.parents.keys() | hierarchy.equals.keys():
        one = NamedNode(name)
        for above in hierarchy.above(name) - {name}:
            yield Triple(one, _SUBCLASS, NamedNode(above))
        for equal in hierarchy.equals.get(name, frozenset()) - {name}:
            yield Triple(one, _EQUIVALENT, NamedNode(equal))
    for name in hierarchy.unsatisfiable:
        yield Triple(NamedNode(name), _SUBCLASS, _NOTHING)


def _individuals(hierarchy: Hierarchy, found: Realization) -> Iterator[Triple]:
    for individual, kinds in found.types.items():
        above = {k for kind in kinds for h in (hierarchy, found.hierarchy) for k in h.above(kind)}
        for kind in above:
            yield Triple(NamedNode(individual), _TYPE, NamedNode(kind))
    for one, prop, other in _values(found):
        yield Triple(NamedNode(one), NamedNode(prop), NamedNode(other))


def _values(found: Realization) -> set[tuple[str, str, str]]:
    """All object property values, those of properties above and of inverses included."""
    above: dict[str, set[tuple[str, bool]]] = {}
    for pairs, turned in ((found.properties, False), (found.inverses, True)):
        for lower, upper in pairs:
            above.setdefault(lower, set()).add((upper, turned))
    values = set(found.values)
    waiting = list(values)
    while waiting:
        one, prop, other = waiting.pop()
        for upper, turned in above.get(prop, ()):
            value = (other, upper, one) if turned else (one, upper, other)
            if value not in values:
                values.add(value)
                waiting.append(value)
    return values
