"""Whether two class expressions, or two lists of domains or ranges, say the same."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from weakref import WeakKeyDictionary

from rdflib import OWL, RDFS, XSD, BNode, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.ontology import Ontology

_AND, _OR = "and", "or"
_JUNCTIONS = {OWL.intersectionOf: _AND, OWL.unionOf: _OR, OWL.disjointUnionOf: _OR}
_SETS = (OWL.oneOf, OWL.withRestrictions)
_PARTS = (
    OWL.complementOf, OWL.datatypeComplementOf, OWL.inverseOf,
    OWL.onProperty, OWL.onClass, OWL.onDataRange, OWL.onDatatype,
    OWL.someValuesFrom, OWL.allValuesFrom, OWL.hasValue, OWL.hasSelf,
    OWL.minCardinality, OWL.maxCardinality, OWL.cardinality,
    OWL.minQualifiedCardinality, OWL.maxQualifiedCardinality, OWL.qualifiedCardinality,
    XSD.minInclusive, XSD.minExclusive, XSD.maxInclusive, XSD.maxExclusive,
    XSD.length, XSD.minLength, XSD.maxLength, XSD.pattern,
    XSD.totalDigits, XSD.fractionDigits,
)  # fmt: skip
_UNQUALIFIED = {
    OWL.minQualifiedCardinality: OWL.minCardinality,
    OWL.maxQualifiedCardinality: OWL.maxCardinality,
    OWL.qualifiedCardinality: OWL.cardinality,
}
_COUNTS = (OWL.minCardinality, OWL.maxCardinality, OWL.cardinality)
_DEFINING = (*_JUNCTIONS, OWL.complementOf, OWL.oneOf)
_ROUNDS = 5

_Shape = tuple[str, object]


class _Groups:
    """Numbers for expressions; what says the same has the same number.

    An expression's shape is made of the numbers of its parts. Equivalences that are stated join
    numbers, which makes more shapes alike, hence the rounds.
    """

    def __init__(self, ontology: Ontology) -> None:
        self._ontology = ontology
        self._numbers: dict[_Shape, int] = {}
        self._shapes: list[_Shape] = []
        self._above: list[int] = []
        self._known: dict[Node, int] = {}
        self._forms: dict[Node, list[tuple[URIRef, list[Node]]]] = {}
        for predicate in (*_JUNCTIONS, *_SETS, *_PARTS):
            lists = predicate in _JUNCTIONS or predicate in _SETS
            for node, objects in ontology.statements(predicate).items():
                for found in objects:
                    parts = ontology.members(found) if lists else [found]
                    self._forms.setdefault(node, []).append((predicate, parts))
        for _ in range(_ROUNDS):
            joined = [self._join(one, other) for one, other in self._stated()]
            self._known.clear()
            if not any(joined):
                break

    def _stated(self) -> Iterator[tuple[int, int]]:
        for predicate in (OWL.equivalentClass, OWL.sameAs):
            for subject, objects in self._ontology.statements(predicate).items():
                for other in objects:
                    yield self.number(subject), self.number(other)
        for predicate in _DEFINING:  # such as ":A owl:unionOf (:B :C)"
            for subject in self._ontology.statements(predicate):
                if isinstance(subject, URIRef):
                    yield self.number(subject), self._defined(subject)

    def _defined(self, subject: Node) -> int:
        for part in self._parts(subject):
            self.number(part)
        return self._expression(subject)

    def _root(self, number: int) -> int:
        while self._above[number] != number:
            self._above[number] = self._above[self._above[number]]
            number = self._above[number]
        return number

    def _join(self, one: int, other: int) -> bool:
        one, other = self._root(one), self._root(other)
        self._above[max(one, other)] = min(one, other)
        return one != other

    def _number_of(self, shape: _Shape) -> int:
        if shape not in self._numbers:
            self._numbers[shape] = len(self._shapes)
            self._above.append(len(self._shapes))
            self._shapes.append(shape)
        return self._root(self._numbers[shape])

    def number(self, node: Node) -> int:
        """The number of an expression; its parts are numbered first."""
        waiting, entered = [node], set[Node]()
        while waiting:
            top = waiting[-1]
            if top in self._known or not isinstance(top, BNode):
                waiting.pop()
            elif top in entered:
                self._known[top] = self._expression(waiting.pop())
            else:
                entered.add(top)
                waiting += [part for part in self._parts(top) if part not in entered]
        return self._atom(node)

    def _atom(self, node: Node) -> int:
        if node in self._known:
            return self._root(self._known[node])
        return self._number_of(("node", node))

    def _parts(self, node: Node) -> Iterator[Node]:
        for _, parts in self._forms.get(node, ()):
            yield from parts

    def _expression(self, node: Node) -> int:
        """The number of an expression whose parts have theirs."""
        found: dict[URIRef, object] = {}
        thing = self._atom(OWL.Thing)
        value: object
        for predicate, parts in self._forms.get(node, ()):
            numbers = [self._atom(part) for part in parts]
            predicate = _UNQUALIFIED.get(predicate, predicate)
            if predicate in _JUNCTIONS:
                return self.junction(_JUNCTIONS[predicate], numbers)
            if predicate in _SETS:
                value = frozenset(numbers)
            elif predicate in _COUNTS:
                value = _count(parts[0])
            elif parts == [RDFS.Literal] and predicate in (OWL.onDataRange, OWL.someValuesFrom):
                value = thing  # whatever the property joins, and no less
            else:
                value = numbers[0]
            # Said twice it is no OWL, and like nothing else.
            found[predicate] = frozenset((found[predicate], value)) if predicate in found else value
        if not found:
            return self._number_of(("node", node))
        return self._restriction(found, thing)

    def _restriction(self, found: dict[URIRef, object], thing: int) -> int:
        """The number of a restriction or another form; "min 1" is "some", "min 0" is anything."""
        on = [found[p] for p in (OWL.onClass, OWL.onDataRange) if found.get(p, thing) != thing]
        parts = {p: value for p, value in found.items() if p not in (OWL.onClass, OWL.onDataRange)}
        least = parts.get(OWL.minCardinality)
        if least == "0":
            return thing
        if least == "1":
            del parts[OWL.minCardinality]
            parts[OWL.someValuesFrom] = on[0] if on else thing
        elif on:
            parts[OWL.onClass] = on[0]
        return self._number_of(("parts", frozenset(parts.items())))

    def junction(self, kind: str, numbers: Iterable[int]) -> int:
        """The number of "this and that", or of "this or that"."""
        found: set[int] = set()
        for number in map(self._root, numbers):
            shape, items = self._shapes[number]
            inner = items if shape == kind and isinstance(items, frozenset) else {number}
            found |= {self._root(item) for item in inner}
        thing = self._number_of(("node", OWL.Thing))
        if kind == _AND:
            found -= {thing}
        elif thing in found:
            return thing
        if not found:
            return thing if kind == _AND else self._number_of(("node", OWL.Nothing))
        return found.pop() if len(found) == 1 else self._number_of((kind, frozenset(found)))


def _count(value: Node) -> str:
    """A cardinality, whatever its datatype."""
    return str(value).strip().lstrip("+0") or "0"


_groups: WeakKeyDictionary[Ontology, _Groups] = WeakKeyDictionary()


def _of(ontology: Ontology) -> _Groups:
    if ontology not in _groups:
        _groups[ontology] = _Groups(ontology)
    return _groups[ontology]


def same(ontology: Ontology, one: Node, other: Node) -> bool:
    """Whether two class expressions or data ranges say the same as far as it is stated.

    They are the same term, stated to be equivalent (``owl:equivalentClass`` or ``owl:sameAs``, in
    either direction, over several steps), or made alike of parts that are the same; the order of
    what "and", "or" and "one of" join does not matter. It is no reasoner.
    """
    groups = _of(ontology)
    return groups.number(one) == groups.number(other)


def same_all(ontology: Ontology, ones: Iterable[Node], others: Iterable[Node]) -> bool:
    """Whether two lists of domains or ranges say the same.

    Several domains mean their intersection. None means ``owl:Thing``: ask first whether there are
    any.
    """
    return meaning(ontology, ones) == meaning(ontology, others)


def meaning(ontology: Ontology, nodes: Iterable[Node]) -> int:
    """A number for a list of domains or ranges, which those that say the same have too."""
    groups = _of(ontology)
    return groups.junction(_AND, [groups.number(node) for node in nodes])


def oops_equal(ontology: Ontology, one: Node, other: Node) -> bool:
    """As OOPS! compares two expressions: by their form, without equivalences.

    It takes no two intersections for equal, and knows restrictions with someValuesFrom,
    allValuesFrom, hasValue and unqualified cardinalities.
    """
    if isinstance(one, URIRef) or isinstance(other, URIRef):
        return one == other
    unions = [ontology.objects(node, OWL.unionOf) for node in (one, other)]
    if all(unions):
        first, second = (ontology.members(items[0]) for items in unions)
        return len({*first}) == len({*second}) and _oops_match(ontology, first, second)
    if all(ontology.objects(node, OWL.intersectionOf) for node in (one, other)):
        return False
    properties = [ontology.objects(node, OWL.onProperty) for node in (one, other)]
    if not all(properties) or properties[0] != properties[1]:
        return False
    for predicate in (OWL.someValuesFrom, OWL.allValuesFrom):
        fillers = [ontology.objects(node, predicate) for node in (one, other)]
        if all(fillers):
            return oops_equal(ontology, fillers[0][0], fillers[1][0])
    for predicate in (OWL.minCardinality, OWL.maxCardinality, OWL.cardinality, OWL.hasValue):
        values = [ontology.objects(node, predicate) for node in (one, other)]
        if all(values):
            return values[0] == values[1]
    return False


def _oops_match(ontology: Ontology, ones: Sequence[Node], others: Sequence[Node]) -> bool:
    left = list(others)
    for one in ones:
        match = next((n for n, other in enumerate(left) if oops_equal(ontology, one, other)), None)
        if match is None:
            return False
        del left[match]
    return True


def oops_equal_all(ontology: Ontology, ones: Sequence[Node], others: Sequence[Node]) -> bool:
    """As OOPS! compares two lists of domains or ranges: one by one, in any order."""
    return len(ones) == len(others) and _oops_match(ontology, ones, others)


def oops_same(ontology: Ontology, ones: Sequence[Node], others: Sequence[Node]) -> bool:
    """Whether OOPS! takes two lists for the same or equivalent.

    It does where either has a single item, an IRI, and they are equal or directly stated to be
    equivalent.
    """
    if len(ones) != 1 or len(others) != 1:
        return False
    one, other = ones[0], others[0]
    if not isinstance(one, URIRef) or not isinstance(other, URIRef):
        return False
    return (
        one == other
        or other in ontology.objects(one, OWL.equivalentClass)
        or one in ontology.objects(other, OWL.equivalentClass)
    )


def listed(ontology: Ontology, nodes: Iterable[Node]) -> str:
    """Domains or ranges in words, in the order of the alphabet."""
    return " and ".join(sorted(map(ontology.words.expression, nodes)))


def unlike_ends(ontology: Ontology, kind: URIRef) -> Iterator[URIRef]:
    """The properties with a characteristic whose domain and range are stated and not the same.

    Args:
        ontology: where.
        kind: the characteristic, such as ``owl:SymmetricProperty``.
    """
    for prop in ontology.declared(kind):
        domains, ranges = ontology.domains(prop), ontology.ranges(prop)
        if domains and ranges and not same_all(ontology, domains, ranges):
            yield prop


def oops_unlike_ends(ontology: Ontology, kind: URIRef) -> Iterator[URIRef]:
    """As ``unlike_ends``, by OOPS!'s comparison, and of declared object properties only."""
    for prop in ontology.object_properties:
        domains, ranges = ontology.domains(prop), ontology.ranges(prop)
        if kind not in ontology.kinds[prop] or not domains or not ranges:
            continue
        equal = oops_equal_all(ontology, domains, ranges)
        if not equal and not oops_same(ontology, domains, ranges):
            yield prop
