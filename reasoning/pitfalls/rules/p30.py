"""P30: classes with synonymous names that are not declared to be equivalent."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence
from functools import cache
from typing import Any

from rdflib import OWL, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.names import (
    Relations,
    components,
    english,
    oops_groups,
    oops_tag,
    phrase,
)
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.pitfalls.wordnet import wordnet
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P30",
    title="Equivalent classes not explicitly declared",
    severity=Severity.IMPORTANT,
    affects=("class",),
    categories=("N3",),
    description="The names of classes are synonyms, by WordNet, but nothing says that the classes "
    "are equivalent, so that what is stated of one is not found with the other.",
    remedy="If they mean the same, declare them with owl:equivalentClass or keep only one; if "
    "not, give them names that tell them apart, or declare them disjoint.",
    oops_group="equivalentClass",
)


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Groups of classes whose names are different words for the same.

    They are if one sense is the first in WordNet, that is the usual one, of all their names: part
    and role, say, are synonyms in a theatre only. A pair counts unless it is declared what one is
    to the other: equivalent, above or disjoint, also by way of other classes. Deprecated classes
    are left out.
    """
    dictionary = wordnet(settings.wordnet)
    words: dict[URIRef, str] = {}
    senses: dict[Any, list[URIRef]] = defaultdict(list)
    for cls in ontology.classes:
        if not ontology.deprecated(cls):
            words[cls] = phrase(english(ontology, cls))
            for sense in dictionary.synsets(words[cls])[:1]:
                senses[sense].append(cls)
    relations = Relations(
        components(ontology.equivalents), ontology.superclasses, _disjoint(ontology)
    )
    groups = relations.unrelated(list(senses.values()), words.__getitem__)
    for sense, alike in zip(senses, groups, strict=True):
        if alike:
            names = " and ".join(dict.fromkeys(f'"{words[cls]}"' for cls in alike))
            every = "both" if len(alike) == 2 else "all"
            yield Finding(tuple(alike), f"{names} {every} mean: {sense.definition()}")


def _disjoint(ontology: Ontology) -> Iterator[Sequence[Node]]:
    """The groups of disjoint classes."""
    for predicate in (OWL.disjointWith, OWL.complementOf):
        for s, objects in ontology.statements(predicate).items():
            for o in objects:
                yield s, o
    for predicate in (OWL.members, OWL.disjointUnionOf):
        for s, objects in ontology.statements(predicate).items():
            if predicate == OWL.disjointUnionOf or OWL.AllDisjointClasses in ontology.kinds.get(
                s, ()
            ):
                for o in objects:
                    yield ontology.members(o)


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """As OOPS! does: names of one word only, however the classes are related.

    It looks up labels with their spaces taken out, so that names of several words are never found.
    """
    dictionary = wordnet(settings.wordnet)
    tags = {cls: oops_tag(ontology, cls) for cls in ontology.classes}
    named: dict[str, set[URIRef]] = defaultdict(set)
    for cls, tag in tags.items():
        named[tag.lower()].add(cls)

    @cache
    def synonyms(tag: str) -> set[URIRef]:
        words = dictionary.synonyms(tag) - {tag.lower()}
        return set().union(*(named.get(word, ()) for word in words))

    def partners(cls: URIRef) -> set[URIRef]:
        found, equivalents = synonyms(tags[cls]), ontology.equivalents.get(cls, ())
        return found.difference(equivalents) if equivalents else found

    for group in oops_groups(tags, partners):
        names = " and ".join(local_name(cls) for cls in group)
        yield Finding(group, f"{names} are synonyms")
