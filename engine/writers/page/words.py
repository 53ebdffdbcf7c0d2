"""Words for people: the plural of a label, and the readable end of an IRI."""

from __future__ import annotations

import re

_SAME = {"sheep", "cattle", "aircraft", "parking", "housing", "fish", "deer", "ground", "land"}
_ODD = {"person": "people", "man": "men", "woman": "women", "child": "children", "mouse": "mice"}


def plural(label: str) -> str:
    """The plural of an English label in running text.

    >>> plural("House"), plural("Bus stop"), plural("Person"), plural("Sheep"), plural("C17")
    ('houses', 'bus stops', 'people', 'sheep', 'C17s')
    >>> plural("Factory"), plural("Bench"), plural("Soccer goals"), plural("Piece of artwork")
    ('factories', 'benches', 'soccer goals', 'pieces of artwork')
    """
    text = running(label)
    head, joint, tail = text.partition(" of ")
    first, space, noun = head.rpartition(" ")
    lower = noun.lower()
    if lower in _SAME or re.search(r"[^saui]s$", lower):  # "goals", "works": many already
        many = noun
    elif lower in _ODD:
        many = _ODD[lower]
    elif lower.endswith(("s", "x", "z", "ch", "sh")):
        many = noun + "es"
    elif re.search(r"[^aeiou]y$", lower):
        many = noun[:-1] + "ies"
    else:
        many = noun + "s"
    return first + space + many + joint + tail


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
