"""P16: a definition that is written as a mere condition."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import OWL, RDFS, BNode, URIRef

from symboslam.reasoning.pitfalls.conditions import left_to_people, parts
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology

PITFALL = Pitfall(
    code="P16",
    title="Using a primitive class in place of a defined one",
    severity=Severity.CRITICAL,
    affects=("class",),
    categories=("N3", "S5"),
    description="A class is only said to have what would define it, so that a reasoner puts "
    "nothing "
    "into it. Being in the class implies the conditions, but meeting them does not put "
    "anything in the class.",
    remedy="State the class to be equivalent (owl:equivalentClass) to the conditions, if "
    "whatever meets them belongs to it.",
    advisory=True,
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Classes below a kind *and* what is special about it, in one expression, that nothing defines.

    Separate superclasses are how conditions are usually stated; one intersection of a named class
    and restrictions has the form of a definition.
    """
    for cls in ontology.classes:
        if _defined(ontology, cls) or ontology.deprecated(cls):
            continue
        for node in ontology.objects(cls, RDFS.subClassOf):
            if isinstance(node, BNode) and ontology.objects(node, OWL.intersectionOf):
                inner = list(parts(ontology, node))
                named = [n for n in inner if isinstance(n, URIRef)]
                special = [n for n in inner if ontology.objects(n, OWL.onProperty)]
                if named and special:
                    words = ontology.words.expression(node)
                    yield Finding(
                        (cls,),
                        f'"{words}" looks like its definition, but puts nothing into the class',
                        ((cls, RDFS.subClassOf, node),),
                    )


def _defined(ontology: Ontology, cls: URIRef) -> bool:
    return bool(ontology.equivalents.get(cls)) or any(
        ontology.objects(cls, predicate)
        for predicate in (OWL.intersectionOf, OWL.unionOf, OWL.oneOf, OWL.disjointUnionOf)
    )


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! has no rule."""
    raise left_to_people()
