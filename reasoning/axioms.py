"""Axioms of a graph: which triples make one, what it says in words, what it can have a say in."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property

from rdflib import OWL, RDF, RDFS, BNode, Graph, URIRef
from rdflib.term import Node

from symboslam.reasoning.vocabulary import OWL_NAMESPACE, RDF_NAMESPACE, local_name

Triple = tuple[Node, Node, Node]

_BUILTIN = (OWL_NAMESPACE, RDF_NAMESPACE, str(RDFS))

_DECLARATIONS: dict[Node, URIRef] = {
    OWL.Class: OWL.Class,
    RDFS.Class: OWL.Class,
    OWL.ObjectProperty: OWL.ObjectProperty,
    OWL.DatatypeProperty: OWL.DatatypeProperty,
    OWL.NamedIndividual: OWL.NamedIndividual,
    RDFS.Datatype: RDFS.Datatype,
}
_CLASS_AXIOMS = (RDFS.subClassOf, OWL.equivalentClass, OWL.disjointWith)
_PROPERTY_AXIOMS = (
    RDFS.domain, RDFS.range, RDFS.subPropertyOf, OWL.inverseOf, OWL.equivalentProperty,
    OWL.propertyDisjointWith, OWL.propertyChainAxiom,
)  # fmt: skip
_OTHER_AXIOMS = (OWL.sameAs, OWL.differentFrom, OWL.disjointUnionOf, OWL.hasKey)
_CHARACTERISTICS: dict[Node, str] = {
    OWL.FunctionalProperty: "has at most one value",
    OWL.InverseFunctionalProperty: "belongs to at most one thing",
    OWL.TransitiveProperty: "is transitive",
    OWL.SymmetricProperty: "is symmetric",
    OWL.AsymmetricProperty: "is asymmetric",
    OWL.ReflexiveProperty: "is reflexive",
    OWL.IrreflexiveProperty: "is irreflexive",
}
_CARDINALITIES = {
    OWL.minCardinality: "min",
    OWL.minQualifiedCardinality: "min",
    OWL.maxCardinality: "max",
    OWL.maxQualifiedCardinality: "max",
    OWL.cardinality: "exactly",
    OWL.qualifiedCardinality: "exactly",
}
_FACETS = {
    "minInclusive": ">=",
    "minExclusive": ">",
    "maxInclusive": "<=",
    "maxExclusive": "<",
}
SYMMETRIC = (
    OWL.equivalentClass, OWL.disjointWith, OWL.inverseOf, OWL.equivalentProperty,
    OWL.propertyDisjointWith, OWL.sameAs, OWL.differentFrom,
)  # fmt: skip
"""Predicates whose axioms say the same with their sides changed over."""
_BLOCKS = (
    OWL.AllDisjointClasses, OWL.AllDisjointProperties, OWL.AllDifferent,
    OWL.NegativePropertyAssertion,
)  # fmt: skip


@dataclass(frozen=True)
class Axiom:
    """One logical statement.

    Attributes:
        subject, predicate, object: the triple that stands for it.
        triples: all its triples, those of anonymous expressions included.
        graph: where it comes from.
    """

    subject: Node
    predicate: Node
    object: Node
    triples: frozenset[Triple]
    graph: Graph = field(compare=False, repr=False)

    @cached_property
    def signature(self) -> frozenset[URIRef]:
        """Names of classes, properties and individuals in it."""
        terms = {term for triple in self.triples for term in triple if isinstance(term, URIRef)}
        return frozenset(term for term in terms if not str(term).startswith(_BUILTIN))

    @cached_property
    def text(self) -> str:
        """The axiom in words."""
        return Words(self.graph).axiom(self)


def split(graph: Graph) -> tuple[set[Triple], list[Axiom]]:
    """The declarations and the logical axioms of a graph; annotations and imports are left out.

    A property that is declared as neither object nor data property is an annotation, and a name
    used as a class counts as declared.
    """
    objects = set(graph.subjects(RDF.type, OWL.ObjectProperty))
    data = set(graph.subjects(RDF.type, OWL.DatatypeProperty))
    for kind in _CHARACTERISTICS:
        objects.update(set(graph.subjects(RDF.type, kind)) - data)
    annotations = set(graph.subjects(RDF.type, OWL.AnnotationProperty))
    individual = (objects | data) - annotations
    expressions = {o for _, p, o in graph if isinstance(o, BNode) and p != OWL.annotatedSource}
    declared: set[Triple] = {(p, RDF.type, OWL.ObjectProperty) for p in objects}
    axioms = []
    for s, p, o in sorted(graph, key=_order):
        if isinstance(s, BNode) and s in expressions:
            continue  # a part of another axiom
        if p == RDF.type and o in _DECLARATIONS and isinstance(s, URIRef):
            declared.add((s, RDF.type, _DECLARATIONS[o]))
        elif p == RDF.type and (o in _BLOCKS or o in _CHARACTERISTICS or _is_class(o)):
            axioms.append(_axiom(graph, (s, p, o), s, o))
        elif p in _CLASS_AXIOMS or p == OWL.disjointUnionOf:
            declared.update((n, RDF.type, OWL.Class) for n in (s, o) if isinstance(n, URIRef))
            axioms.append(_axiom(graph, (s, p, o), s, o))
        elif p in individual or p in _OTHER_AXIOMS or (p in _PROPERTY_AXIOMS and s in individual):
            axioms.append(_axiom(graph, (s, p, o), o))
    for p in (OWL.someValuesFrom, OWL.allValuesFrom):
        for s, o in graph.subject_objects(p):
            if isinstance(o, URIRef) and graph.value(s, OWL.onProperty) in objects:
                declared.add((o, RDF.type, OWL.Class))
    return {t for t in declared if not str(t[0]).startswith(_BUILTIN)}, axioms


def _order(triple: Triple) -> tuple[str, ...]:
    return tuple(str(term) for term in triple)


def _is_class(kind: Node) -> bool:
    """Whether ``something a kind`` says something about an individual."""
    if isinstance(kind, BNode):
        return True
    return not str(kind).startswith(_BUILTIN) or kind == OWL.Nothing


def _axiom(graph: Graph, head: Triple, *nodes: Node) -> Axiom:
    return Axiom(*head, frozenset({head, *_closure(graph, nodes)}), graph)


def _closure(graph: Graph, nodes: Iterable[Node]) -> Iterator[Triple]:
    """The triples of anonymous nodes and of all anonymous nodes that they lead to."""
    waiting, seen = [n for n in nodes if isinstance(n, BNode)], set[Node]()
    while waiting:
        node = waiting.pop()
        if node in seen or (node, RDF.type, OWL.Axiom) in graph:
            continue
        seen.add(node)
        for triple in graph.triples((node, None, None)):
            yield triple
            if isinstance(triple[2], BNode):
                waiting.append(triple[2])


class Words:
    """Renders class expressions and axioms in words.

    Args:
        graph: holds the expressions.
        name: how a class or property is called; its local name by default.
        limit: parts after which a text is cut short: the rest of a list is counted ("A, B and 97
            more"), deeper expressions are "...". All is said by default. The graph must stay as it
            is, for lists are counted once.
    """

    def __init__(
        self, graph: Graph, name: Callable[[str], str] = local_name, limit: int | None = None
    ) -> None:
        self.graph, self.name, self.limit = graph, name, limit
        self._left = 0
        self._counted: dict[Node, tuple[list[Node], int]] = {}

    def members(self, node: Node | None) -> list[Node]:
        """The items of an RDF list; a list that leads back to itself ends there."""
        found: list[Node] = []
        seen: set[Node | None] = {None}
        while node not in seen and (node, RDF.first, None) in self.graph:
            seen.add(node)
            found += [item for item in [self.graph.value(node, RDF.first)] if item is not None]
            node = self.graph.value(node, RDF.rest)
        return found

    def expression(self, node: Node) -> str:
        """A class expression, such as ``Feature and indicates some Residential``."""
        self._left = self.limit or 0
        return self._say(node)

    def _listed(self, node: Node, separator: str, say: Callable[[Node], str]) -> str:
        """The items of a list in words; the rest is counted where the limit is reached."""
        if self.limit is None:
            return separator.join(map(say, self.members(node)))
        if node not in self._counted:
            members = self.members(node)
            self._counted[node] = members[: self.limit], len(members)
        members, number = self._counted[node]
        said: list[str] = []
        for member in members:
            if self._left <= 0:
                break
            said.append(say(member))
        if len(said) == number:
            return separator.join(said)
        last = " and " if separator == ", " else separator
        return last.join(filter(None, (separator.join(said), f"{number - len(said)} more")))

    def _say(self, node: Node) -> str:
        self._left -= 1
        if not isinstance(node, BNode):
            return self.name(str(node)) if isinstance(node, URIRef) else str(node)
        if self.limit is not None and self._left < 0:
            return "..."
        value = self.graph.value
        for connective, word in ((OWL.intersectionOf, " and "), (OWL.unionOf, " or ")):
            if (members := value(node, connective)) is not None:
                return self._listed(members, word, self._inner)
        if (negated := value(node, OWL.complementOf)) is not None:
            return f"not {self._inner(negated)}"
        if (single := value(node, OWL.oneOf)) is not None:
            return "one of " + self._listed(single, ", ", self._say)
        if (inverse := value(node, OWL.inverseOf)) is not None:
            return f"inverse of {self._say(inverse)}"
        if (datatype := value(node, OWL.onDatatype)) is not None:
            return f"{self._say(datatype)} {self._facets(node)}"
        on = value(node, OWL.onProperty)
        if on is None:
            return "something"
        where = self._say(on)
        for constraint, word in (
            (OWL.someValuesFrom, "some"), (OWL.allValuesFrom, "only"), (OWL.hasValue, "the"),
        ):  # fmt: skip
            if (filler := value(node, constraint)) is not None:
                return f"{where} {word} {self._inner(filler)}"
        filler = value(node, OWL.onClass) or value(node, OWL.onDataRange) or OWL.Thing
        for constraint, word in _CARDINALITIES.items():
            if (number := value(node, constraint)) is not None:
                return f"{where} {word} {number} {self._inner(filler)}"
        return f"{where} itself"

    def _facets(self, node: Node) -> str:
        """What a datatype restriction demands, such as ``>= 18``."""
        found = []
        for item in self.members(self.graph.value(node, OWL.withRestrictions)):
            for _, facet, limit in self.graph.triples((item, None, None)):
                word = _FACETS.get(local_name(str(facet)), local_name(str(facet)))
                found.append(f"{word} {limit}")
        return " and ".join(sorted(found))

    def _inner(self, node: Node) -> str:
        text = self._say(node)
        return f"({text})" if " " in text and isinstance(node, BNode) else text

    def _denial(self, node: Node) -> str:
        """A negative property assertion."""
        value = self.graph.value
        target = value(node, OWL.targetIndividual) or value(node, OWL.targetValue)
        parts = (value(node, OWL.sourceIndividual), value(node, OWL.assertionProperty), target)
        one, along, other = ("something" if n is None else self._say(n) for n in parts)
        return f"it is not so that {one} {along} {other}"

    def axiom(self, axiom: Axiom) -> str:
        """An axiom as a short sentence."""
        s, p, o = axiom.subject, axiom.predicate, axiom.object
        self._left = self.limit or 0
        say = self._say
        if p == RDF.type and o in _CHARACTERISTICS:
            return f"{say(s)} {_CHARACTERISTICS[o]}"
        if p == RDF.type and o in _BLOCKS:
            listed = self.graph.value(s, OWL.members) or self.graph.value(s, OWL.distinctMembers)
            if o == OWL.NegativePropertyAssertion:
                return self._denial(s)
            names = "" if listed is None else self._listed(listed, ", ", say)
            return f"{names} are {'all different' if o == OWL.AllDifferent else 'disjoint'}"
        if p == OWL.propertyChainAxiom:
            return f"{self._listed(o, ' of ', say)} implies {say(s)}"
        if p == OWL.hasKey:
            return f"{say(s)} is told apart by {self._listed(o, ', ', say)}"
        if p == OWL.disjointUnionOf:
            return f"{say(s)} is the disjoint union of {self._listed(o, ', ', say)}"
        if p == RDFS.subClassOf and isinstance(o, BNode):
            is_restriction = (o, OWL.onProperty, None) in self.graph
            return f"every {say(s)} {'' if is_restriction else 'is '}{say(o)}"
        form = {
            RDF.type: "{} is {}",
            RDFS.subClassOf: "every {} is {}",
            OWL.equivalentClass: "{} is the same as: {}",
            OWL.disjointWith: "no {} is {}",
            RDFS.domain: "whatever {} something is {}",
            RDFS.range: "whatever something {} is {}",
            RDFS.subPropertyOf: "{} implies {}",
            OWL.inverseOf: "{} is the inverse of {}",
            OWL.equivalentProperty: "{} is the same as {}",
            OWL.propertyDisjointWith: "{} and {} are disjoint",
            OWL.sameAs: "{} is the same as {}",
            OWL.differentFrom: "{} is not {}",
        }.get(URIRef(str(p)), "{} " + self.name(str(p)) + " {}")
        return form.format(say(s), article(say(o)) if form.endswith("is {}") else say(o))


def article(name: str) -> str:
    """A name with ``a`` or ``an`` before it; expressions of several words stay as they are."""
    if " " in name:
        return name
    return f"{'an' if name[:1].upper() in 'AEIOU' else 'a'} {name}"
