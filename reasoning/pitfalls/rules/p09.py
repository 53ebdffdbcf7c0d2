"""P09: what the competency questions ask for is missing."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator

from pyoxigraph import NamedNode
from rdflib import URIRef

from symboslam.reasoning.pitfalls.conditions import left_to_people
from symboslam.reasoning.pitfalls.model import (
    Finding,
    NotCheckedError,
    Pitfall,
    Settings,
    Severity,
)
from symboslam.reasoning.pitfalls.ontology import Ontology
from symboslam.reasoning.pitfalls.unread import is_of_unread
from symboslam.reasoning.questions.manifest import load_manifest, quads_in
from symboslam.reasoning.questions.model import Contains, Query, Question, Table, Triples
from symboslam.reasoning.vocabulary import local_name

PITFALL = Pitfall(
    code="P09",
    title="Missing domain information",
    severity=Severity.MINOR,
    affects=("ontology",),
    categories=("N5", "S5"),
    description="The ontology has no words for a part of what it has to answer, according to its "
    "requirements.",
    remedy="Add the term, or mend the question that uses it.",
    advisory=True,
)


_TOKEN = re.compile(
    r"""(?s)\"\"\".*?\"\"\"|'''.*?'''|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'"""
    r"""|<(?P<iri>[^<>"{}|^`\\\s]*)>|\#[^\n]*"""
    r"""|(?P<prefix>[\w.-]*):(?P<name>[\w%:-]+(?:\.[\w%:-]+)*)|[^\s]"""
)
_PREFIX = re.compile(r"(?im)^[^#\n\"]*?\bprefix\s+([\w.-]*):\s*<([^<>\s]*)>")


def check(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """Terms in the ontology's own namespace that questions ask for and the ontology does not know.

    What the questions' own data state is no business of the ontology.
    """
    if settings.questions is None:
        raise NotCheckedError("give the competency questions: --questions MANIFEST")
    own = _namespaces(ontology)
    known = {term for triple in ontology.graph for term in triple if isinstance(term, URIRef)}
    missing: dict[str, list[str]] = defaultdict(list)
    for question in load_manifest(settings.questions):
        asked = {iri for iri in _asked(question) if iri.startswith(own) and iri not in own}
        unknown = {iri for iri in asked if URIRef(iri) not in known}
        for iri in unknown - _in_data(question) if unknown else ():
            if not is_of_unread(ontology, URIRef(iri)):
                missing[iri].append(question.id)
    for iri, questions in sorted(missing.items()):
        names = ", ".join(questions)
        asks = "question asks" if len(questions) == 1 else "questions ask"
        yield Finding(
            (iri,), f"the ontology does not know {local_name(iri)}, for which the {asks}: {names}"
        )


def _namespaces(ontology: Ontology) -> tuple[str, ...]:
    """Namespaces below the ontology's IRI; if no term is in one, that of most terms."""
    counts: dict[str, int] = defaultdict(int)
    for term in ontology.terms:
        counts[str(term).removesuffix(local_name(term))] += 1
    stem = ontology.iri.rstrip("#/")
    own = [namespace for namespace in counts if namespace.rstrip("#/") == stem]
    most = sorted(counts, key=lambda n: (-counts[n], n))[:1]
    return tuple(sorted({*own, *most} - {""}))


def _asked(question: Question) -> set[str]:
    """The IRIs in a question's query and in its expected answer."""
    found = _in_query(question.query) if question.query else set()
    expected = question.expected
    rows: list[object] = []
    if isinstance(expected, Table):
        rows = [term for row in expected.rows for term in row]
    elif isinstance(expected, Contains):
        rows = [term for row in expected.rows for _, term in row]
    elif isinstance(expected, Triples):
        rows = [x for t in expected.triples for x in (t.subject, t.predicate, t.object)]
    return found | {term.value for term in rows if isinstance(term, NamedNode)}


def _in_query(query: Query) -> set[str]:
    prefixes = {**dict(query.prefixes), **dict(_PREFIX.findall(query.text))}
    declared = set(prefixes.values())
    found = set()
    for token in _TOKEN.finditer(query.text):
        if token["iri"]:
            found.add(token["iri"])
        elif token["name"] and token["prefix"] in prefixes:
            found.add(prefixes[token["prefix"]] + token["name"])
    return found - declared


def _in_data(question: Question) -> set[str]:
    return {
        term.value
        for data in question.data
        for quad in quads_in(data)
        for term in (quad.subject, quad.predicate, quad.object)
        if isinstance(term, NamedNode)
    }


def check_as_oops(ontology: Ontology, settings: Settings) -> Iterator[Finding]:
    """OOPS! has no rule."""
    raise left_to_people()
