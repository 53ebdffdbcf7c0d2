"""P32: classes with the same label."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator

from rdflib import RDFS, SKOS, Literal, URIRef

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
    """Groups of classes with the same label in the same language, or in none.

    Labels are rdfs:label and skos:prefLabel, whatever their case, spaces and hyphens. Classes that
    are equivalent, also by way of others, may share a label; deprecated ones are left out.
    """
    part = components(ontology.equivalents)

    def related(one: URIRef, two: URIRef) -> bool:
        return one in part and part[one] == part.get(two)

    called: dict[tuple[str, str], dict[URIRef, Triple]] = defaultdict(dict)
    for cls in ontology.classes:
        if not ontology.deprecated(cls):
            for predicate in (SKOS.prefLabel, RDFS.label):
                for label in ontology.objects(cls, predicate):
                    if isinstance(label, Literal) and label.strip():
                        key = normal_label(label) or label.strip(), (label.language or "").lower()
                        called[key][cls] = (cls, predicate, label)
    found: dict[tuple[URIRef, ...], tuple[str, str]] = {}
    for key, triples in sorted(called.items()):
        group = tuple(apart(triples, related)) if len(triples) > 1 else ()
        if group and group not in found:
            found[group] = key
    for group, key in sorted(found.items()):
        language = f" ({key[1]})" if key[1] else ""
        axioms = tuple(called[key][cls] for cls in group)
        names = _names(group)
        yield Finding(group, f'{names} have the same label "{axioms[0][2]}"{language}', axioms)


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
    partners: dict[URIRef, set[URIRef]] = defaultdict(set)
    for same in called.values():
        for cls in same if len(same) > 1 else ():
            partners[cls] |= same - {cls, *ontology.equivalents.get(cls, ())}
    tags = {cls: oops_name(cls) for cls in ontology.classes}
    for group in oops_groups(tags, partners):
        yield Finding(group, f"{_names(group)} have the same label")
