"""P17: a class that is an individual."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator

from rdflib import OWL, RDF, RDFS, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.conditions import left_to_people
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P17",
    title="Overspecializing a hierarchy",
    severity=Severity.IMPORTANT,
    affects=("class",),
    categories=("N1", "S4"),
    description="A hierarchy goes on below its last kinds: a class at its end stands for one "
    "thing, "
    "as if a city such as Madrid were a kind of city.",
    remedy="Make the class an individual of the class above it.",
    advisory=True,
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Classes at the end of a hierarchy whose only individual has their name.

    Without a superclass, no hierarchy has gone too far.
    """
    inner: set[Node] = set(ontology.statements(OWL.disjointUnionOf))
    for s, objects in ontology.statements(RDFS.subClassOf).items():
        inner.update(o for o in objects if o != s)
    individuals: dict[Node, list[Node]] = defaultdict(list)
    for individual, kinds in ontology.statements(RDF.type).items():
        for kind in kinds:
            individuals[kind].append(individual)
    for cls in ontology.classes:
        members = individuals.get(cls, [])
        if cls in inner or len(members) != 1 or not ontology.superclasses.get(cls):
            continue
        individual = members[0]
        same = isinstance(individual, URIRef) and _plain(individual) == _plain(cls)
        if same and not ontology.deprecated(cls):
            yield Finding(
                (cls,),
                f"its only individual, {local_name(str(individual))}, has its name: "
                "the class may stand for one thing",
                ((individual, RDF.type, cls),),
            )


def _plain(term: Node) -> str:
    return re.sub(r"[\W_]", "", local_name(str(term))).lower()


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! has no rule."""
    raise left_to_people()
