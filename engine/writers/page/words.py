"""Words for people: the plural of a label, and the readable end of an IRI."""

from __future__ import annotations

import re

_SAME = frozenset(
    "aircraft calming cattle deer equipment fish food gear ground housing information land parking "
    "police sheep tennis water".split()
)
_ODD = {"person": "people", "man": "men", "woman": "women", "child": "children", "mouse": "mice"}


def plural(label: str) -> str:
    """The plural of an English label in running text.

    >>> plural("House"), plural("Bus stop"), plural("Person"), plural("Sheep"), plural("C17")
    ('houses', 'bus stops', 'people', 'sheep', 'C17s')
    >>> plural("Factory"), plural("Bench"), plural("Soccer goals"), plural("Work of art")
    ('factories', 'benches', 'soccer goals', 'works of art')
    >>> plural("Cliff, cave or sinkhole"), plural("Book or music shop")
    ('cliffs, caves or sinkholes', 'book or music shops')
    """
    head, *tail = re.split(r"(?= (?:of|in|for|with) )", running(label), maxsplit=1)
    parts = re.split(r"(, | or )", head)
    alternatives = all(" " not in part for part in parts[2::2])  # else they share the last noun
    for i in range(0 if alternatives else len(parts) - 1, len(parts), 2):
        first, space, noun = parts[i].rpartition(" ")
        parts[i] = first + space + _many(noun)
    return "".join(parts + tail)


def _many(noun: str) -> str:
    lower = noun.lower()
    if lower in _SAME or re.search(r"[^saui]s$", lower):  # "goals", "works": many already
        return noun
    if lower in _ODD:
        return _ODD[lower]
    if lower.endswith(("s", "x", "z", "ch", "sh")):
        return noun + "es"
    if re.search(r"[^aeiou]y$", lower):
        return noun[:-1] + "ies"
    return noun + "s"


def running(label: str) -> str:
    """A label as it stands inside a sentence: ``House`` -> ``house``, ``ATM`` stays.

    >>> running("Office building"), running("ATM"), running("C17")
    ('office building', 'ATM', 'C17')
    """
    if len(label) > 1 and label[0].isupper() and label[1].islower():
        return label[0].lower() + label[1:]
    return label


def local_name(iri: str) -> str:
    """The readable end of an IRI; other text stays as it is.

    >>> local_name("https://w3id.org/symboslam#source-osm-wiki"), local_name("a survey, 2021")
    ('source-osm-wiki', 'a survey, 2021')
    """
    if re.match(r"[a-z][a-z0-9+.-]*:\S+$", iri):
        return re.split(r"[#/]", iri.rstrip("#/"))[-1] or iri
    return iri
