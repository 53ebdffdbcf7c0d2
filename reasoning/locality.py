"""Modules: the part of an ontology that can have a say in a given set of names.

Syntactic bottom-locality: an axiom is local to a signature if it holds whatever the signature's
names mean as soon as all other names are empty. What is entailed about the signature follows from
the axioms that are not local, so a clash can be explained without the rest (B. Cuenca Grau,
I. Horrocks, Y. Kazakov, U. Sattler: Modular reuse of ontologies, JAIR 31, 2008).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rdflib import OWL, RDF, RDFS, XSD, BNode, Graph, Literal, URIRef
from rdflib.collection import Collection
from rdflib.term import Node

from symboslam.reasoning.axioms import Axiom

_MIN = (OWL.minCardinality, OWL.minQualifiedCardinality, OWL.cardinality, OWL.qualifiedCardinality)
_MAX = (OWL.maxCardinality, OWL.maxQualifiedCardinality)
_ONE_PROPERTY = (RDFS.domain, RDFS.range, RDFS.subPropertyOf)
_CHARACTERISTICS = (
    OWL.FunctionalProperty, OWL.InverseFunctionalProperty, OWL.TransitiveProperty,
    OWL.SymmetricProperty, OWL.AsymmetricProperty, OWL.IrreflexiveProperty,
)  # fmt: skip


def module(axioms: Sequence[Axiom], names: Iterable[str]) -> list[Axiom]:
    """The axioms that can have a say in ``names``, in their given order."""
    known = {URIRef(name) for name in names}
    chosen: set[int] = set()
    grown = True
    while grown:
        grown = False
        for i, axiom in enumerate(axioms):
            if i not in chosen and not _Locality(axiom.graph, known).is_local(axiom):
                chosen.add(i)
                known |= axiom.signature
                grown = True
    return [axiom for i, axiom in enumerate(axioms) if i in chosen]


class _Locality:
    """Decides locality; ``known`` are the names that may mean something."""

    def __init__(self, graph: Graph, known: set[URIRef]) -> None:
        self.graph, self.known = graph, known

    def is_local(self, axiom: Axiom) -> bool:
        s, p, o = axiom.subject, axiom.predicate, axiom.object
        if p == RDFS.subClassOf:
            return self.is_empty(s) or self.is_everything(o)
        if p == OWL.equivalentClass:
            both_empty = self.is_empty(s) and self.is_empty(o)
            return both_empty or (self.is_everything(s) and self.is_everything(o))
        if p == OWL.disjointWith:
            return self.is_empty(s) or self.is_empty(o)
        if p == OWL.disjointUnionOf:
            return self.is_empty(s) and all(self.is_empty(m) for m in self._members(o))
        if p == RDF.type and o in (OWL.AllDisjointClasses, OWL.AllDisjointProperties):
            members = self._members(self.graph.value(s, OWL.members))
            empty = self.is_empty if o == OWL.AllDisjointClasses else self.is_unknown
            return sum(not empty(member) for member in members) <= 1
        if p in _ONE_PROPERTY or (p == RDF.type and o in _CHARACTERISTICS):
            return self.is_unknown(s)
        if p == OWL.propertyChainAxiom:
            return any(self.is_unknown(member) for member in self._members(o))
        if p in (OWL.inverseOf, OWL.equivalentProperty):
            return self.is_unknown(s) and self.is_unknown(o)
        if p == OWL.propertyDisjointWith:
            return self.is_unknown(s) or self.is_unknown(o)
        return False

    def is_unknown(self, prop: Node) -> bool:
        """Whether a property holds between no two things."""
        if isinstance(prop, BNode):
            inverse = self.graph.value(prop, OWL.inverseOf)
            return inverse is not None and self.is_unknown(inverse)
        return prop not in self.known and not str(prop).startswith(str(OWL))

    def is_empty(self, node: Node) -> bool:
        """Whether a class expression has no members."""
        if not isinstance(node, BNode):
            datatype = str(node).startswith((str(XSD), str(RDFS), str(RDF), str(OWL)))
            return node == OWL.Nothing or not (datatype or node in self.known)
        value = self.graph.value
        if (members := value(node, OWL.intersectionOf)) is not None:
            return any(self.is_empty(m) for m in self._members(members))
        if (members := value(node, OWL.unionOf)) is not None:
            return all(self.is_empty(m) for m in self._members(members))
        if (negated := value(node, OWL.complementOf)) is not None:
            return self.is_everything(negated)
        prop = value(node, OWL.onProperty)
        if prop is None:
            return False
        if (filler := value(node, OWL.someValuesFrom)) is not None:
            return self.is_unknown(prop) or self.is_empty(filler)
        if any((node, p, None) in self.graph for p in (OWL.hasValue, OWL.hasSelf)):
            return self.is_unknown(prop)
        return self._least(node) > 0 and (self.is_unknown(prop) or self._filler_is_empty(node))

    def is_everything(self, node: Node) -> bool:
        """Whether everything is a member of a class expression."""
        if not isinstance(node, BNode):
            return node == OWL.Thing
        value = self.graph.value
        if (members := value(node, OWL.intersectionOf)) is not None:
            return all(self.is_everything(m) for m in self._members(members))
        if (members := value(node, OWL.unionOf)) is not None:
            return any(self.is_everything(m) for m in self._members(members))
        if (negated := value(node, OWL.complementOf)) is not None:
            return self.is_empty(negated)
        prop = value(node, OWL.onProperty)
        if prop is None:
            return False
        if (filler := value(node, OWL.allValuesFrom)) is not None:
            return self.is_unknown(prop) or self.is_everything(filler)
        if any((node, p, None) in self.graph for p in _MAX):
            return self.is_unknown(prop) or self._filler_is_empty(node)
        return False

    def _members(self, node: Node | None) -> list[Node]:
        return [] if node is None else list(Collection(self.graph, node))

    def _least(self, node: Node) -> int:
        """The least number of values that a cardinality restriction asks for."""
        numbers = [self.graph.value(node, p) for p in _MIN]
        return max((int(n) for n in numbers if isinstance(n, Literal)), default=0)

    def _filler_is_empty(self, node: Node) -> bool:
        filler = self.graph.value(node, OWL.onClass)
        return filler is not None and self.is_empty(filler)
