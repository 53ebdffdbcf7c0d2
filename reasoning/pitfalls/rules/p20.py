"""P20: labels and comments that are empty, equal or swapped."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence

from rdflib import DC, DCTERMS, RDFS, SKOS, Literal, URIRef

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
_LABELS = (RDFS.label, SKOS.prefLabel)
_COMMENTS = (RDFS.comment, SKOS.definition, DCTERMS.description, DC.description)
_KINDS = {
    RDFS.label: "label",
    SKOS.prefLabel: "label",
    RDFS.comment: "comment",
    SKOS.definition: "definition",
    DCTERMS.description: "description",
    DC.description: "description",
}
_Said = tuple[URIRef, URIRef, Literal]
"""A term, a predicate and a text."""


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Empty labels and comments; comments that repeat a label; a comment swapped with a label.

    A preferred label of SKOS counts as a label, and its definition or a description of Dublin Core
    as a comment. They count as swapped if in one language every label is longer than every comment
    and one label is a text of at least four words.
    """
    for term in dict.fromkeys(ontology.terms):
        if not ontology.deprecated(term):
            labels, comments = _said(ontology, term, _LABELS), _said(ontology, term, _COMMENTS)
            if fault := _empty(labels) or _empty(comments) or _fault(labels, comments):
                yield fault


def _said(ontology: Ontology, term: URIRef, predicates: Iterable[URIRef]) -> list[_Said]:
    return [(term, p, text) for p in predicates for text in _literals(ontology, term, p)]


def _literals(ontology: Ontology, term: URIRef, predicate: URIRef) -> list[Literal]:
    found = [x for x in ontology.objects(term, predicate) if isinstance(x, Literal)]
    return sorted(found, key=lambda x: (x.language or "", str(x)))


def _empty(said: Iterable[_Said]) -> Finding | None:
    for term, predicate, text in said:
        if not text.strip():
            kind = _KINDS[predicate]
            mend = f"Fill the {kind} in or take it away"
            return Finding((term,), f"a {kind} is empty", ((term, predicate, text),), mend)
    return None


def _fault(labels: Iterable[_Said], comments: Iterable[_Said]) -> Finding | None:
    """What is wrong in the first language in which anything is."""
    spoken: dict[str, tuple[list[_Said], list[_Said]]] = defaultdict(lambda: ([], []))
    for which, said in enumerate((labels, comments)):
        for one in said:
            spoken[(one[2].language or "").lower()][which].append(one)
    faults = (_repeated(*spoken[x]) or _swapped(*spoken[x]) for x in sorted(spoken))
    return next(filter(None, faults), None)


def _repeated(labels: Iterable[_Said], comments: Iterable[_Said]) -> Finding | None:
    known: dict[str, _Said] = {}
    for label in labels:
        known.setdefault(normal_label(label[2]).rstrip("."), label)
    for comment in comments:
        if same := known.get(normal_label(comment[2]).rstrip(".")):
            kind = _KINDS[comment[1]]
            message = f'the {kind} only repeats the label "{same[2]}"'
            mend = f"Say in the {kind} what the term means"
            return Finding((same[0],), message, (comment, same), mend)
    return None


def _swapped(labels: Sequence[_Said], comments: Sequence[_Said]) -> Finding | None:
    if not (labels and comments):
        return None
    long, short = max(labels, key=_length), max(comments, key=_length)
    if _length(long) < _LONG or _length(min(labels, key=_length)) <= _length(short):
        return None
    kind = _KINDS[short[1]]
    message = (
        f"the label has {_length(long)} words and the {kind} only {_length(short)}: "
        "they seem to be swapped"
    )
    return Finding((long[0],), message, (long, short), f"Swap the label and the {kind}")


def _length(said: _Said) -> int:
    return len(said[2].split())


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
