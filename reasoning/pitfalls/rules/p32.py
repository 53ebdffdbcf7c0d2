"""P32: classes with the same label."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping

from rdflib import RDFS, SKOS, Literal, URIRef
from rdflib.term import Node

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.names import (
    apart,
    components,
    normal_label,
    oops_groups,
    oops_name,
    oops_words,
)
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P32",
    title="Several classes with the same label",
    severity=Severity.MINOR,
    affects=("class",),
    categories=("N7",),
    description="Classes have the same name for people, who cannot tell which of them is meant.",
    remedy="Give them labels that tell them apart; if they mean the same, keep one with all "
    "labels, or declare them with owl:equivalentClass.",
    oops_group="sameLabel",
)

_SHOWN = 5
_OOPS_LANGUAGES = ("en", "es", "it", "de", "fr", "pt")


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Groups of classes with the same label in the same language.

    Labels are rdfs:label and skos:prefLabel, whatever their case, spaces and hyphens. Regions make
    no other language, and a label without a language is compared with those of all languages.
    Classes that are equivalent, also by way of others, may share a label; deprecated ones are left
    out.
    """
    part = components(ontology.equivalents)
    called: dict[str, dict[str, dict[URIRef, Triple]]] = defaultdict(lambda: defaultdict(dict))
    for cls in ontology.classes:
        if not ontology.deprecated(cls):
            for predicate in (SKOS.prefLabel, RDFS.label):
                for label in ontology.objects(cls, predicate):
                    if isinstance(label, Literal) and label.strip():
                        language = (label.language or "").lower().split("-")[0]
                        text = normal_label(label) or label.strip()
                        called[text][language][cls] = (cls, predicate, label)
    found: dict[tuple[URIRef, ...], tuple[str, dict[URIRef, Triple]]] = {}
    for _, by_language in sorted(called.items()):
        for language, triples in _compared(by_language, part):
            found.setdefault(tuple(sorted(triples)), (language, triples))
    for group, (language, triples) in sorted(found.items()):
        axioms = tuple(triples[cls] for cls in group)
        names = _names(group)
        shown = f" ({language})" if language else ""
        yield Finding(group, f'{names} have the same label "{axioms[0][2]}"{shown}', axioms)


def _compared(
    called: Mapping[str, Mapping[URIRef, Triple]], part: Mapping[Node, int]
) -> Iterator[tuple[str, dict[URIRef, Triple]]]:
    """The languages in which classes of one label clash, with these; "" for several languages.

    A class whose label has no language belongs to all of them, so that there is one group then.
    """
    anywhere = dict(called.get("", {}))
    many = {part.get(cls, cls) for cls in anywhere}
    clash: dict[str, Mapping[URIRef, Triple]] = {}
    for language, here in sorted(called.items()):
        if not anywhere:
            if apart(here, part):
                yield language, dict(here)
        elif len(many) > 1 or not many.issuperset(part.get(cls, cls) for cls in here):
            clash[language] = here
    if clash:
        merged = dict(anywhere)
        for here in clash.values():
            merged.update(here)
        yield "", merged


def _names(group: Iterable[URIRef]) -> str:
    names = [local_name(cls) for cls in group]
    if len(names) > _SHOWN:
        names = [*names[: _SHOWN - 1], f"{len(names) - _SHOWN + 1} others"]
    return ", ".join(names[:-1]) + " and " + names[-1]


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """As OOPS! does: six languages, rdfs:label alone, and nothing but the letters of a label.

    So "Zone 1"@en and "Zone 2"@en are the same, and labels without a language are never compared.
    """
    called: dict[tuple[str, ...], set[URIRef]] = defaultdict(set)
    for cls in ontology.classes:
        for label in ontology.labels(cls):
            language = label.language or "" if isinstance(label, Literal) else ""
            if language.lower().split("-")[0] in _OOPS_LANGUAGES:
                words = oops_words(f"{label}@{language}")
                called[tuple(word.lower() for word in words)].add(cls)
    labels: dict[URIRef, list[set[URIRef]]] = defaultdict(list)
    for same in called.values():
        for cls in same:
            labels[cls].append(same)

    def partners(cls: URIRef) -> set[URIRef]:
        return set().union(*labels[cls]) - {cls, *ontology.equivalents.get(cls, ())}

    tags = {cls: oops_name(cls) for cls in ontology.classes}
    for group in oops_groups(tags, partners):
        yield Finding(group, f"{_names(group)} have the same label")
