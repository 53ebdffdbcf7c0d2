"""P08: a term without a label or without a comment."""

from __future__ import annotations

from collections.abc import Iterator

from rdflib import DCTERMS, RDFS, SKOS, Literal, URIRef
from rdflib.term import Node

from symboslam.reasoning.pitfalls.model import Finding, Pitfall, Settings, Severity
from symboslam.reasoning.pitfalls.ontology import Ontology

PITFALL = Pitfall(
    code="P08",
    title="Missing annotations",
    severity=Severity.MINOR,
    affects=("class", "object property", "datatype property"),
    categories=("N6", "N7"),
    description="A term has no name for people, or nothing that says what it means, so that its "
    "users have to guess.",
    remedy="Give the term a name with rdfs:label or skos:prefLabel, and say what it means with "
    "rdfs:comment or skos:definition.",
    variants={
        "P08-A": "Missing annotations - Label & Comment",
        "P08-C": "Missing annotations - Comment",
        "P08-L": "Missing annotations - Label",
    },
)

_LABEL = "a label (rdfs:label or skos:prefLabel)"
_COMMENT = "a comment (rdfs:comment, skos:definition or dcterms:description)"
_OBO_DEFINITION = URIRef("http://purl.obolibrary.org/obo/IAO_0000115")


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Terms that lack a name, a text on what they mean, or both; empty texts count as none."""
    for term in dict.fromkeys(ontology.terms):
        label = any(_text(value) for value in ontology.names(term))
        comments = ontology.comments(term) + ontology.objects(term, _OBO_DEFINITION)
        comment = any(_text(value) for value in comments)
        if (label and comment) or ontology.deprecated(term):
            continue
        if label:
            yield Finding(
                (term,),
                f"it lacks {_COMMENT}",
                mend="Say what the term means with rdfs:comment or skos:definition",
                variant="P08-C",
            )
        elif comment:
            yield Finding(
                (term,),
                f"it lacks {_LABEL}",
                mend="Name the term with rdfs:label or skos:prefLabel",
                variant="P08-L",
            )
        else:
            yield Finding((term,), f"it lacks {_LABEL} and {_COMMENT}", variant="P08-A")


def _text(value: Node) -> bool:
    """Whether it says something; a definition may be a resource of its own (SKOS allows it)."""
    return not isinstance(value, Literal) or bool(value.strip())


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """As OOPS! does: whatever is missing is P08-A, skos:prefLabel is no label, "" is a text.

    Neither dc:description nor OBO's definition counts, and deprecated terms do.
    """
    for term in dict.fromkeys(ontology.terms):
        said = (RDFS.comment, SKOS.definition, DCTERMS.description)
        missing = [
            *([] if ontology.labels(term) else ["rdfs:label"]),
            *([] if any(ontology.objects(term, p) for p in said) else ["rdfs:comment"]),
        ]
        if missing:
            yield Finding((term,), f"it lacks {' and '.join(missing)}", variant="P08-A")
