"""P13: object properties without an inverse."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping, Sequence

from rdflib import OWL, RDF, BNode, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.groups import oops_equal_all, same_all
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.pitfalls.unread import is_of_unread, not_read
from symboslam.reasoning.vocabulary import local_name

_TITLE = "Inverse relationships not explicitly declared"

PITFALL = Pitfall(
    code="P13",
    title=_TITLE,
    severity=Severity.MINOR,
    affects=("object property",),
    categories=("N3", "N7", "S5"),
    description="A relation can be followed in one direction only: no property is stated to be its "
    "inverse, and it is not symmetric.",
    remedy="Declare the inverse, and state owl:inverseOf between the two; a relation that holds "
    "both ways is an owl:SymmetricProperty.",
    variants={
        "P13-Y": f"{_TITLE} - With Suggestion",
        "P13-N": f"{_TITLE} - No Suggestion",
        "P13-S": f"{_TITLE} - Symmetric or Transitive?",
    },
)

_Key = tuple[frozenset[Node], frozenset[Node]]
_NO_HINT = {
    OWL.AsymmetricProperty, OWL.IrreflexiveProperty, OWL.TransitiveProperty,
    OWL.FunctionalProperty, OWL.InverseFunctionalProperty,
}  # fmt: skip


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Object properties of which no inverse is stated; each is in one finding.

    Two that run between the same classes in opposite directions are a pair (P13-Y). One that runs
    from a class to itself may be symmetric or transitive (P13-S), unless its characteristics say
    otherwise. All others are P13-N.
    """
    lacking = [p for p in ontology.object_properties if not _is_settled(ontology, p)]
    if any(is_of_unread(ontology, p) for p in lacking):
        raise not_read(ontology)
    loops = {p for p in lacking if _is_loop(ontology, p, same_all)}
    representative = _representatives(ontology)
    partners: dict[URIRef, URIRef] = {}
    pool = _Pool(ontology, [p for p in lacking if p not in loops], representative)
    for prop in lacking:
        if prop not in loops and prop not in partners and (other := pool.match(prop, same_all)):
            partners |= {prop: other, other: prop}
            pool.remove(prop)
            pool.remove(other)
    for prop in lacking:
        if other := partners.get(prop):
            if prop < other:
                one, two = local_name(prop), local_name(other)
                yield Finding(
                    (prop, other),
                    f"{one} and {two} lead from and to the same classes in opposite directions, "
                    "but neither has an inverse",
                    mend=f"State that {one} is owl:inverseOf {two}, if it is.",
                    variant="P13-Y",
                )
        elif prop in loops and not ontology.kinds[prop] & _NO_HINT:
            yield Finding(
                (prop,),
                "has no inverse, and leads from a class to the same class",
                mend="State owl:inverseOf, or that it is an owl:SymmetricProperty, if it is.",
                variant="P13-S",
            )
        else:
            yield Finding((prop,), "has no inverse and is not symmetric", variant="P13-N")


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! hints at symmetry and transitivity besides, even where there is an inverse.

    It does not count the inverses of equivalent properties, nor those that a property names itself
    unless they are declared. It suggests one property as partner of several others, and never one
    whose IRI is a part of the other's.
    """
    props = ontology.declared(OWL.ObjectProperty)
    declared, stated = set(props), ontology.statements(OWL.inverseOf)
    has = {o for objects in stated.values() for o in objects}
    has |= {s for s, objects in stated.items() if not declared.isdisjoint(objects)}
    lacking = [p for p in props if p not in has and OWL.SymmetricProperty not in ontology.kinds[p]]
    suggested: set[URIRef] = set()
    pool = _Pool(ontology, lacking, {})
    for prop in lacking:
        other = pool.match(prop, oops_equal_all, lambda one, two: two not in one)
        if other:
            pool.remove(prop)
            suggested |= {prop, other}
            names = f"{local_name(prop)} and {local_name(other)}"
            yield Finding((prop, other), f"{names} could be inverses", variant="P13-Y")
    for prop in lacking:
        if prop not in suggested:
            yield Finding((prop,), "has no inverse and is not symmetric", variant="P13-N")
    known = {OWL.SymmetricProperty, OWL.TransitiveProperty, OWL.FunctionalProperty}
    for prop in props:
        if not ontology.kinds[prop] & known and _is_loop(ontology, prop, oops_equal_all):
            yield Finding((prop,), "could be symmetric or transitive", variant="P13-S")


_Equal = Callable[[Ontology, Sequence[Node], Sequence[Node]], bool]


class _Pool:
    """Properties that could be somebody's inverse, by the names in their domains and ranges."""

    def __init__(
        self, ontology: Ontology, props: list[URIRef], representative: Mapping[Node, Node]
    ) -> None:
        self._ontology, self._representative = ontology, representative
        self._keys: dict[URIRef, _Key] = {}
        self._by: dict[_Key, dict[URIRef, None]] = defaultdict(dict)
        for prop in props:
            domains, ranges = ontology.domains(prop), ontology.ranges(prop)
            if domains and ranges:
                self._keys[prop] = self._names(domains), self._names(ranges)
                self._by[self._keys[prop]][prop] = None

    def _names(self, nodes: Sequence[Node]) -> frozenset[Node]:
        found = (name for node in nodes for name in self._ontology.mentioned(node))
        return frozenset(self._representative.get(name, name) for name in found)

    def match(
        self,
        prop: URIRef,
        equal: _Equal,
        allowed: Callable[[URIRef, URIRef], bool] = lambda one, two: True,
    ) -> URIRef | None:
        """The first property that runs the other way."""
        if prop not in self._keys:
            return None
        domain_names, range_names = self._keys[prop]
        domains, ranges = self._ontology.domains(prop), self._ontology.ranges(prop)
        for other in self._by.get((range_names, domain_names), ()):
            if (
                other != prop
                and allowed(prop, other)
                and equal(self._ontology, domains, self._ontology.ranges(other))
                and equal(self._ontology, ranges, self._ontology.domains(other))
            ):
                return other
        return None

    def remove(self, prop: URIRef) -> None:
        """A property is taken."""
        self._by[self._keys[prop]].pop(prop, None)


def _is_settled(ontology: Ontology, prop: URIRef) -> bool:
    """Whether a property needs no inverse: it or an equivalent one has one or is symmetric."""
    if ontology.deprecated(prop):
        return True
    for same in (prop, *ontology.equivalents.get(prop, ())):
        if OWL.SymmetricProperty in ontology.objects(same, RDF.type):
            return True
        if isinstance(same, BNode) and ontology.objects(same, OWL.inverseOf):
            return True  # equivalent to the inverse of another
        for inverse in ontology.inverses.get(same, ()):
            if isinstance(inverse, URIRef) or ontology.equivalents.get(inverse):
                return True
    return False


def _is_loop(ontology: Ontology, prop: URIRef, equal: _Equal) -> bool:
    domains, ranges = ontology.domains(prop), ontology.ranges(prop)
    return bool(domains and ranges) and equal(ontology, domains, ranges)


def _representatives(ontology: Ontology) -> Mapping[Node, Node]:
    """Class -> the first by name of those that are stated to be equivalent to it."""
    found: dict[Node, Node] = {}
    for cls in sorted((c for c in ontology.equivalents if isinstance(c, URIRef)), key=str):
        waiting = [cls] if cls not in found else []
        while waiting:
            one = waiting.pop()
            found[one] = cls
            others = ontology.equivalents.get(one, ())
            waiting += [o for o in others if isinstance(o, URIRef) and o not in found]
    return found
