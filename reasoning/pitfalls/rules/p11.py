"""P11: properties without a domain or a range."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator

from rdflib import OWL, RDF, RDFS, BNode, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology, is_builtin
from symboslam.reasoning.pitfalls.unread import is_of_unread, not_read

PITFALL = Pitfall(
    code="P11",
    title="Missing domain or range in properties",
    severity=Severity.IMPORTANT,
    affects=("object property", "datatype property"),
    categories=("N3", "N7", "S5"),
    description="A property does not say what kind of thing has it, or what kind of value it "
    "takes. Readers have to guess, and a reasoner infers nothing from its use.",
    remedy="State rdfs:domain and rdfs:range, or a super-property that has them; owl:Thing, if "
    "anything at all is meant.",
)

_OTHER = {RDFS.domain: RDFS.range, RDFS.range: RDFS.domain}
_Side = tuple[Node, URIRef]  # a property, and rdfs:domain or rdfs:range


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Properties with no domain or no range, own or inherited.

    A property inherits from its super-properties, from equivalent properties, and from its
    inverse, whose domain is its range; a symmetric property is its own inverse.
    """
    stated = {(s, side) for side in _OTHER for s in ontology.statements(side)}
    known = _spread(ontology, stated) if settings.inherit else stated
    lacking = [
        (prop, missing)
        for prop in _properties(ontology)
        if not ontology.deprecated(prop)
        and (missing := [side for side in _OTHER if (prop, side) not in known])
    ]
    if ontology.unread and lacking:
        unknown = _spread(ontology, {(p, side) for side in _OTHER for p in _unknown(ontology)})
        if any((prop, side) in unknown for prop, missing in lacking for side in missing):
            raise not_read(ontology)
    for prop, missing in lacking:
        words = "neither a domain nor a range" if len(missing) == 2 else "no domain"
        if missing == [RDFS.range]:
            words = "no range"
        above = ", and inherits none" if settings.inherit and _inherits(ontology, prop) else ""
        yield Finding((prop,), f"has {words}{above}")


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! looks at what is stated of the property itself only, and at deprecated ones too."""
    for prop in ontology.declared(OWL.ObjectProperty) + ontology.declared(OWL.DatatypeProperty):
        if not (ontology.domains(prop) and ontology.ranges(prop)):
            yield Finding((prop,), "lacks a domain or a range of its own")


def _properties(ontology: Ontology) -> list[URIRef]:
    """Each property once, though it may be declared as both kinds."""
    return list(dict.fromkeys([*ontology.object_properties, *ontology.datatype_properties]))


def _inherits(ontology: Ontology, prop: URIRef) -> bool:
    return any(
        prop in others
        for others in (
            ontology.statements(RDFS.subPropertyOf), ontology.equivalents, ontology.inverses,
        )
    )  # fmt: skip


def _unknown(ontology: Ontology) -> Iterable[Node]:
    """Properties that an import may say more of: such as are used here but not declared."""
    for p in {*ontology.inverses, *ontology.equivalents, *_objects(ontology)}:
        undeclared = not isinstance(p, BNode) and not is_builtin(p) and p not in ontology.kinds
        if undeclared:
            yield p
    yield from (p for p in _properties(ontology) if is_of_unread(ontology, p))


def _objects(ontology: Ontology) -> Iterator[Node]:
    for objects in ontology.statements(RDFS.subPropertyOf).values():
        yield from objects


def _spread(ontology: Ontology, start: set[_Side]) -> set[_Side]:
    """The sides in ``start`` and all that inherit from them."""
    below: dict[Node, list[Node]] = defaultdict(list)
    for s, objects in ontology.statements(RDFS.subPropertyOf).items():
        for o in objects:
            below[o].append(s)
    found, waiting = set(start), list(start)
    while waiting:
        prop, side = waiting.pop()
        heirs = [(p, side) for p in (*below[prop], *ontology.equivalents.get(prop, ()))]
        heirs += [(p, _OTHER[side]) for p in ontology.inverses.get(prop, ())]
        if OWL.SymmetricProperty in ontology.objects(prop, RDF.type):
            heirs.append((prop, _OTHER[side]))
        for heir in heirs:
            if heir not in found:
                found.add(heir)
                waiting.append(heir)
    return found
