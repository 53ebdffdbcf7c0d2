"""P30: classes with synonymous names that are not declared to be equivalent."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from typing import Any

from rdflib import OWL, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.names import (
    above,
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
    relations = _Relations(ontology)
    for sense, group in senses.items():
        if alike := _unrelated(group, words, relations):
            names = " and ".join(dict.fromkeys(f'"{words[cls]}"' for cls in alike))
            every = "both" if len(alike) == 2 else "all"
            yield Finding(alike, f"{names} {every} mean: {sense.definition()}")


def _unrelated(
    group: list[URIRef], words: dict[URIRef, str], relations: _Relations
) -> tuple[URIRef, ...]:
    """The classes that nothing relates to some other class of another word."""
    named: dict[str, list[URIRef]] = defaultdict(list)
    for cls in group:
        named[words[cls]].append(cls)
    return tuple(
        cls
        for cls in group
        if any(
            not relations.stated(cls, other)
            for word, others in named.items()
            if word != words[cls]
            for other in others
        )
    )


class _Relations:
    """What is declared between classes."""

    def __init__(self, ontology: Ontology) -> None:
        self._supers = ontology.superclasses
        self._part = components(ontology.equivalents)
        self._above: dict[URIRef, set[URIRef]] = {}
        self._disjoint = _disjoint(ontology)

    def stated(self, one: URIRef, two: URIRef) -> bool:
        """Whether two classes are equivalent, one is above the other, or they are disjoint."""
        if one in self._part and self._part[one] == self._part.get(two):
            return True
        first, second = self._ancestors(one), self._ancestors(two)
        if two in first or one in second:
            return True
        if not self._disjoint:
            return False
        left, right = self._groups(first), self._groups(second)
        return any(
            b != a for number in left.keys() & right for a in left[number] for b in right[number]
        )

    def _groups(self, classes: set[URIRef]) -> dict[int, set[URIRef]]:
        """Number of a group of disjoint classes -> those of the given classes that are in it."""
        found: dict[int, set[URIRef]] = defaultdict(set)
        for cls in classes:
            for number in self._disjoint.get(cls, ()):
                found[number].add(cls)
        return found

    def _ancestors(self, cls: URIRef) -> set[URIRef]:
        if cls not in self._above:
            self._above[cls] = above(cls, self._supers)
        return self._above[cls]


def _disjoint(ontology: Ontology) -> dict[Node, set[int]]:
    """Class -> the numbers of the groups of disjoint classes that it is in."""
    groups: list[list[Node]] = [
        [s, o]
        for predicate in (OWL.disjointWith, OWL.complementOf)
        for s, objects in ontology.statements(predicate).items()
        for o in objects
    ]
    for predicate in (OWL.members, OWL.disjointUnionOf):
        for s, objects in ontology.statements(predicate).items():
            if predicate == OWL.members and OWL.AllDisjointClasses not in ontology.kinds.get(s, ()):
                continue
            groups += [ontology.members(o) for o in objects]
    found: dict[Node, set[int]] = defaultdict(set)
    for number, group in enumerate(groups):
        for cls in group:
            found[cls].add(number)
    return found


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """As OOPS! does: names of one word only, however the classes are related.

    It looks up labels with their spaces taken out, so that names of several words are never found.
    """
    dictionary = wordnet(settings.wordnet)
    tags = {cls: oops_tag(ontology, cls) for cls in ontology.classes}
    named: dict[str, list[URIRef]] = defaultdict(list)
    for cls, tag in tags.items():
        named[tag.lower()].append(cls)
    partners = {
        cls: [
            other
            for synonym in dictionary.synonyms(tag) - {tag.lower()}
            for other in named.get(synonym, ())
            if other not in ontology.equivalents.get(cls, ())
        ]
        for cls, tag in tags.items()
    }
    for group in oops_groups(tags, partners):
        names = " and ".join(local_name(cls) for cls in group)
        yield Finding(group, f"{names} are synonyms")
