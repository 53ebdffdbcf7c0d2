"""P04: classes and properties that have nothing to do with the rest of the ontology."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rdflib import OWL, RDF, RDFS, SKOS, BNode, Literal, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology, is_builtin
from symboslam.reasoning.pitfalls.uses import SWRL
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P04",
    title="Creating unconnected ontology elements",
    severity=Severity.MINOR,
    affects=("class", "object property", "datatype property"),
    categories=("N4", "N5", "S5"),
    description="A class or a property stands alone: no axiom relates it to anything else in the "
    "ontology, and nothing uses it.",
    remedy="Place it in the hierarchy or relate it to other terms, or remove it.",
)

_AXIOMS = (
    RDFS.subClassOf, OWL.disjointWith, OWL.disjointUnionOf, OWL.complementOf, OWL.unionOf,
    OWL.intersectionOf, OWL.oneOf, OWL.hasKey, OWL.someValuesFrom, OWL.allValuesFrom, OWL.onClass,
    OWL.onProperty, OWL.hasValue, RDFS.domain, RDFS.range, RDFS.subPropertyOf, OWL.inverseOf,
    OWL.propertyDisjointWith, OWL.propertyChainAxiom, OWL.assertionProperty, OWL.sourceIndividual,
    OWL.targetIndividual, SKOS.exactMatch, SKOS.closeMatch, SKOS.broadMatch, SKOS.narrowMatch,
    SKOS.relatedMatch, SWRL.classPredicate, SWRL.propertyPredicate, SWRL.dataRange,
)  # fmt: skip
"""What they say relates the terms on both sides to something."""
_EQUIVALENCES = (OWL.equivalentClass, OWL.equivalentProperty, OWL.sameAs)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Terms that no axiom relates to another term of an ontology, and that nothing uses.

    Anything but annotations relates: a superclass or subclass, disjointness, a part in an
    expression or a rule, a domain or range, an individual of a class, a value of a property, and a
    match of SKOS. No relation is one to the languages' own terms (``owl:Thing``, ``xsd:string``)
    or to itself; nor is an equivalence between two names, unless the other one is related.
    Deprecated terms may stand alone, and so may terms that are defined (``rdfs:isDefinedBy``) in an
    ontology that is not there: it may relate them.
    """
    related = _related(ontology)
    _spread(ontology, related)
    here = {str(s).rstrip("#/") for s, kinds in ontology.kinds.items() if OWL.Ontology in kinds}
    for term in dict.fromkeys(ontology.terms):
        if term in related or ontology.deprecated(term) or _is_elsewhere(ontology, term, here):
            continue
        name = local_name(term)
        yield Finding((term,), f"nothing relates {name} to the rest of the ontology")


def _is_elsewhere(ontology: Ontology, term: Node, here: set[str]) -> bool:
    """Whether a term is said to be defined in another ontology than those ``here``."""
    origins = {str(origin).rstrip("#/") for origin in ontology.objects(term, RDFS.isDefinedBy)}
    return bool(origins) and here.isdisjoint(origins)


def _related(ontology: Ontology) -> set[Node]:
    related: set[Node] = set()
    for predicate in (*_AXIOMS, *ontology.object_properties, *ontology.datatype_properties):
        for subject, objects in ontology.statements(predicate).items():
            others = [o for o in objects if o != subject and _counts(o)]
            if others or not is_builtin(predicate):
                related |= {subject, *others}
    for predicate in _EQUIVALENCES:
        for subject, objects in ontology.statements(predicate).items():
            if any(isinstance(o, BNode) for o in objects):
                related.add(subject)
    for predicate in (*ontology.object_properties, *ontology.datatype_properties):
        if ontology.statements(predicate):
            related.add(predicate)
    for items in ontology.statements(RDF.first).values():
        related.update(items)
    for subject, kinds in ontology.statements(RDF.type).items():
        used = [kind for kind in kinds if not is_builtin(kind)]
        related |= {subject, *used} if used else set()
    return related


def _counts(term: Node) -> bool:
    return not isinstance(term, Literal) and not is_builtin(term)


def _spread(ontology: Ontology, related: set[Node]) -> None:
    """Relate what is equivalent to something related."""
    names: dict[Node, set[Node]] = {}
    for predicate in _EQUIVALENCES:
        for subject, objects in ontology.statements(predicate).items():
            for other in objects:
                names.setdefault(subject, set()).add(other)
                names.setdefault(other, set()).add(subject)
    waiting = [term for term in names if term in related]
    while waiting:
        for other in names.get(waiting.pop(), ()):
            if other not in related:
                related.add(other)
                waiting.append(other)


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Classes only, and less relates them.

    A class is related by a domain, a range of an object property, an expression of "some", "only",
    "not", "and" and "or", a superclass, an anonymous subclass, or an equivalent class that is
    related. So the top of a hierarchy is found.
    """
    involved = _involved(ontology)
    below = {c for c in ontology.classes if not _is_root(ontology, c)}
    anonymous = {
        o
        for s, objects in ontology.statements(RDFS.subClassOf).items()
        if isinstance(s, BNode)
        for o in objects
    }
    connected: set[Node] = set()
    for term in ontology.classes:
        equivalents = ontology.objects(term, OWL.equivalentClass)
        complex_ = term in anonymous or any(isinstance(e, BNode) for e in equivalents)
        if term in involved or term in below or complex_:
            connected.add(term)
    known = connected | {e for c in connected for e in ontology.objects(c, OWL.equivalentClass)}
    for term in ontology.classes:
        equivalents = ontology.objects(term, OWL.equivalentClass)
        if term not in known and connected.isdisjoint(equivalents):
            name = local_name(term)
            yield Finding((term,), f"nothing relates {name} to the rest of the ontology")


def _is_root(ontology: Ontology, term: Node) -> bool:
    above = ontology.objects(term, RDFS.subClassOf)
    return all(c in (OWL.Thing, RDFS.Resource, term) for c in above)


def _involved(ontology: Ontology) -> set[Node]:
    """The classes of domains, ranges and expressions, as far as OOPS! looks into them."""
    ends: set[Node] = set()
    for prop in ontology.object_properties:
        ends.update(ontology.domains(prop) + ontology.ranges(prop))
    for prop in ontology.datatype_properties:
        ends.update(ontology.domains(prop))
    axioms: list[Node] = []
    for term in ontology.classes:
        axioms += ontology.objects(term, RDFS.subClassOf)
        axioms += ontology.objects(term, OWL.equivalentClass)
    ends.update(_operands(ontology, axioms))
    found = set(ends)
    for node in ends:
        for predicate in (OWL.unionOf, OWL.intersectionOf):
            for items in ontology.objects(node, predicate):
                found.update(ontology.members(items))
    return found


def _operands(ontology: Ontology, axioms: Iterable[Node]) -> Iterator[Node]:
    waiting, seen = list(axioms), set[Node]()
    while waiting:
        node = waiting.pop()
        if node in seen:
            continue
        seen.add(node)
        for part in _parts(ontology, node):
            if isinstance(part, URIRef):
                yield part
            else:
                waiting.append(part)


def _parts(ontology: Ontology, node: Node) -> Iterable[Node]:
    if on := ontology.objects(node, OWL.onProperty):
        if OWL.ObjectProperty not in ontology.kinds.get(on[0], ()):
            return ()
        fillers = (OWL.allValuesFrom, OWL.someValuesFrom)
        return [o for predicate in fillers for o in ontology.objects(node, predicate)]
    if complement := ontology.objects(node, OWL.complementOf):
        return complement
    for predicate in (OWL.intersectionOf, OWL.unionOf):
        if lists := ontology.objects(node, predicate):
            return ontology.members(lists[0])
    return ()
