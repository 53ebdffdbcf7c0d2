"""P15: "some not" where "not some" may be meant."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import OWL, URIRef

from symboslam.reasoning.pitfalls.conditions import conditions, left_to_people
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P15",
    title='Using "some not" in place of "not some"',
    severity=Severity.CRITICAL,
    affects=("class",),
    categories=("N2", "S4"),
    description="A class is said to have some value that is not of a kind, which leaves room for "
    "values that are. If none of that kind is meant, the negation belongs outside.",
    remedy='Write "not (property some Kind)" if no value of that kind is allowed.',
    advisory=True,
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Classes with "some not" and nothing else about the value: "some (this and not that)" is fine.

    A class that also says "only" or "not some" of the property has thought of it.
    """
    if not ontology.statements(OWL.complementOf):
        return
    for cls in ontology.classes:
        if ontology.deprecated(cls):
            continue
        stated = list(conditions(ontology, cls))
        limited = {
            on
            for condition in stated
            for inner in (condition.node, *ontology.objects(condition.node, OWL.complementOf))
            if inner is not condition.node or ontology.objects(inner, OWL.allValuesFrom)
            for on in ontology.objects(inner, OWL.onProperty)
        }
        for node, axiom in stated:
            for on in ontology.objects(node, OWL.onProperty):
                for filler in ontology.objects(node, OWL.someValuesFrom):
                    denied = ontology.objects(filler, OWL.complementOf)
                    if denied and on not in limited and isinstance(on, URIRef):
                        kind, prop = ontology.words.expression(denied[0]), local_name(on)
                        yield Finding(
                            (cls,),
                            f'"{ontology.words.expression(node)}" still lets it have {prop} {kind}',
                            (axiom,),
                            f'Write "not ({prop} some {kind})" if it may have no {kind}.',
                        )


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! has no rule."""
    raise left_to_people()
