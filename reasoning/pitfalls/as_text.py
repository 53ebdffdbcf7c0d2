"""What OOPS! reads off the text of a file by searching it for certain spellings (P38, P39)."""

from __future__ import annotations

import re

from symboslam.reasoning.pitfalls.model import NotCheckedError
from symboslam.reasoning.pitfalls.ontology import Document

_ELEMENTS = ('<owl:Ontology rdf:about="', '<Ontology rdf:about="')
_TYPED = '<rdf:type rdf:resource="http://www.w3.org/2002/07/owl#Ontology"/>'
_DESCRIPTION = '<rdf:Description rdf:about="'
_TURTLE = [
    re.compile(word + r"\s+owl:Ontology\s*" + end)
    for end in (";", ",")
    for word in ("a", "rdf:type")
]
_BROKEN = "(OOPS! fails here)"
"""Stands for an IRI where OOPS! gives up, and so reports nothing."""


def text_of(document: Document) -> str:
    """The text of a file.

    Raises:
        NotCheckedError: it is a bundled module, which has no file.
    """
    if document.path is None:
        raise NotCheckedError(f"OOPS! searches the text of a file, and {document.name} has none")
    return document.path.read_text(encoding="utf-8", errors="replace")


def ontology_iri(text: str) -> str | None:
    """The IRI of the ontology as OOPS! finds it: empty without an IRI, None without an ontology."""
    for start in _ELEMENTS:
        if start in text:
            return text.partition(start)[2].partition('"')[0]
    if _TYPED in text:
        _, found, iri = text.partition(_TYPED)[0].rpartition(_DESCRIPTION)
        return iri.partition('"')[0] if found else _BROKEN
    for pattern in _TURTLE:
        if found_at := pattern.search(text):
            subject = text[: found_at.start()].rpartition("<")[2]
            return subject.partition(">")[0] if ">" in subject else _BROKEN
    return "" if "<owl:Ontology>" in text else None


def base(text: str) -> str:
    """The value of the first ``xml:base``; empty if there is none."""
    return text.partition('xml:base="')[2].partition('"')[0]
