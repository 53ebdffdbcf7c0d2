"""P20: labels and comments that are empty, equal or swapped."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from rdflib import RDFS, Literal, URIRef
from rdflib.term import Node

from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.names import normal_label
from symboslam.reasoning.pitfalls.ontology import Ontology

PITFALL = Pitfall(
    code="P20",
    title="Misusing ontology annotations",
    severity=Severity.MINOR,
    affects=("class", "object property", "datatype property"),
    categories=("N7",),
    description="A label or a comment does not say what it is there for: it is empty, the comment "
    "only repeats the label, or the two are swapped.",
    remedy="Put a short name into the label, and into the comment what the term means.",
)

_LONG = 4
"""Words from which on a label can be a swapped comment."""


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Empty labels and comments; comments that repeat a label; a comment swapped with a label.

    They count as swapped if in one language every label is longer than every comment and one
    label is a text of at least four words.
    """
    for term in dict.fromkeys(ontology.terms):
        if not ontology.deprecated(term):
            labels = _literals(ontology, term, RDFS.label)
            comments = _literals(ontology, term, RDFS.comment)
            fault = _empty(term, labels, comments) or _fault(term, labels, comments)
            if fault:
                yield fault


def _literals(ontology: Ontology, term: URIRef, predicate: URIRef) -> list[Literal]:
    found = [x for x in ontology.objects(term, predicate) if isinstance(x, Literal)]
    return sorted(found, key=lambda x: (x.language or "", str(x)))


def _empty(term: URIRef, labels: Iterable[Literal], comments: Iterable[Literal]) -> Finding | None:
    for kind, predicate, texts in (
        ("label", RDFS.label, labels),
        ("comment", RDFS.comment, comments),
    ):
        for text in texts:
            if not text.strip():
                mend = f"Fill the {kind} in or take it away"
                return Finding((term,), f"a {kind} is empty", ((term, predicate, text),), mend)
    return None


def _fault(term: URIRef, labels: list[Literal], comments: list[Literal]) -> Finding | None:
    for language in sorted({(x.language or "") for x in labels}):
        here = [x for x in labels if (x.language or "") == language]
        there = [x for x in comments if (x.language or "") == language]
        for comment in there:
            for label in here:
                axioms: tuple[Triple, ...] = (
                    (term, RDFS.comment, comment),
                    (term, RDFS.label, label),
                )
                if normal_label(label).rstrip(".") == normal_label(comment).rstrip("."):
                    message = f'the comment only repeats the label "{label}"'
                    mend = "Say in the comment what the term means"
                    return Finding((term,), message, axioms, mend)
        if here and there:
            short, long = max(there, key=_words), max(here, key=_words)
            if _words(long) >= _LONG and _words(min(here, key=_words)) > _words(short):
                message = (
                    f"the label has {_words(long)} words and the comment only {_words(short)}: "
                    "they seem to be swapped"
                )
                axioms = ((term, RDFS.label, long), (term, RDFS.comment, short))
                return Finding((term,), message, axioms, "Swap the label and the comment")
    return None


def _words(text: Node) -> int:
    return len(str(text).split())


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """As OOPS! does: one label and one comment, of whatever language, are compared.

    A label of more words than the comment counts, be it two against one. OOPS! takes whichever
    label comes first in memory, this the first by language.
    """
    for term in dict.fromkeys(ontology.terms):
        labels = _literals(ontology, term, RDFS.label)
        comments = _literals(ontology, term, RDFS.comment)
        if not (labels and comments):
            continue
        label, comment = labels[0], comments[0]
        if not label or not comment:
            message = "the label or the comment is empty"
        elif _oops_words(label) > _oops_words(comment):
            message = "the label has more words than the comment"
        elif label.lower() == comment.lower():
            message = "the label and the comment are the same"
        else:
            continue
        axioms = ((term, RDFS.comment, comment), (term, RDFS.label, label))
        yield Finding((term,), message, axioms)


def _oops_words(text: str) -> int:
    """Java's number of parts between spaces: empty ones at the end do not count."""
    return len(text.rstrip(" ").split(" ")) if text.strip(" ") else 0
