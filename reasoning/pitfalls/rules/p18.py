"""P18: a domain or range that is too narrow."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator

from rdflib import OWL, RDFS, BNode, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.conditions import left_to_people
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P18",
    title="Overspecializing the domain or range",
    severity=Severity.IMPORTANT,
    affects=("object property", "datatype property"),
    categories=("N2", "S4"),
    description="A domain or range lists what there is today, or a single individual, in "
    "place of the "
    "class that holds them; it has to be mended with each new class.",
    remedy="State the class above as the domain or range.",
    advisory=True,
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Domains and ranges that are all subclasses of one class, or a single individual."""
    below: dict[Node, set[Node]] = defaultdict(set)
    for cls, supers in ontology.superclasses.items():
        for one in supers:
            if one != cls:
                below[one].add(cls)
    for prop in [*ontology.object_properties, *ontology.datatype_properties]:
        if ontology.deprecated(prop):
            continue
        for predicate, word in ((RDFS.domain, "domain"), (RDFS.range, "range")):
            for node in ontology.objects(prop, predicate):
                if isinstance(node, BNode) and (why := _narrow(ontology, node, below)):
                    yield Finding((prop,), f"its {word} is {why}", ((prop, predicate, node),))


def _narrow(ontology: Ontology, node: Node, below: dict[Node, set[Node]]) -> str:
    for items in ontology.objects(node, OWL.oneOf):
        members = ontology.members(items)
        if len(members) == 1 and isinstance(members[0], URIRef):
            return f"the single individual {local_name(members[0])}"
    for items in ontology.objects(node, OWL.unionOf):
        union = {*ontology.members(items)}
        first = next(iter(union), None)
        if len(union) > 1 and isinstance(first, URIRef):
            for one in sorted(ontology.superclasses.get(first, ()), key=str):
                if below.get(one) == union:
                    names = ontology.words.expression(node)
                    return f"{names}, which are all that is below {local_name(one)}"
    return ""


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! has no rule."""
    raise left_to_people()
