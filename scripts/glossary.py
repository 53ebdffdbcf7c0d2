"""Rewrite what is counted in competency_questions/requirements.md: its questions and its glossary.

    python scripts/glossary.py [--check]

A term is a word that the ontology uses as a label. For each the glossary says in how many questions
it occurs, and in how many expected answers it stands. Everything outside the markers is left alone.
"""

from __future__ import annotations

import re
import sys
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from pyoxigraph import Literal, NamedNode, RdfFormat, parse

from symboslam.reasoning.questions.manifest import load_manifest
from symboslam.reasoning.questions.model import Contains, Question, Table, Triples

ROOT = Path(__file__).resolve().parents[1]
FOLDER = ROOT / "competency_questions"
PAGE = FOLDER / "requirements.md"
MODULES = ("*.ttl", "upstream/*.ttl")
RDF_TYPE = "http://www.w3.org/1999/02/22-rdf-syntax-ns#type"
LABEL = "http://www.w3.org/2000/01/rdf-schema#label"
OWL = "http://www.w3.org/2002/07/owl#"
KINDS = {
    OWL + "Class": "class",
    OWL + "ObjectProperty": "property",
    OWL + "DatatypeProperty": "property",
    OWL + "AnnotationProperty": "property",
}
# Labels that are everyday English too, so that a question that has the word need not mean the term.
EVERYDAY = {
    "about", "answers", "cause", "considers", "count", "date", "depth", "description", "in", "near",
    "part", "plane", "range", "share", "source", "state", "steps", "thing", "title", "used", "way",
}  # fmt: skip


@dataclass
class Word:
    """A label and what bears it."""

    kinds: set[str] = field(default_factory=set)
    questions: int = 0
    answers: int = 0


def read_labels() -> tuple[dict[str, Word], dict[str, str]]:
    """The words of the ontology, and for each IRI of a term the word."""
    labels: dict[str, str] = {}
    kinds: dict[str, str] = {}
    files = [file for pattern in MODULES for file in sorted((ROOT / "ontology").glob(pattern))]
    for file in files:
        for quad in parse(path=str(file), format=RdfFormat.TURTLE):
            if not isinstance(quad.subject, NamedNode):
                continue
            subject = quad.subject.value
            if quad.predicate.value == LABEL and isinstance(quad.object, Literal):
                labels[subject] = re.sub(r" \(.*\)$", "", quad.object.value).lower()
            elif quad.predicate.value == RDF_TYPE and quad.object.value in KINDS:
                kinds[subject] = KINDS[quad.object.value]
    words: dict[str, Word] = defaultdict(Word)
    for iri, kind in kinds.items():
        if iri in labels:
            words[labels[iri]].kinds.add(kind)
    return dict(words), {iri: labels[iri] for iri in kinds if iri in labels}


def make_pattern(words: Iterable[str]) -> re.Pattern[str]:
    """A pattern that finds the words in a text, the longest first, in the singular or plural."""
    forms: list[str] = []
    for word in sorted(set(words) - EVERYDAY, key=lambda w: (-len(w), w)):
        stem = re.escape(word)
        plural = (
            rf"(?:{stem}|{re.escape(word[:-1])}ies)" if word.endswith("y") else f"{stem}(?:e?s)?"
        )
        forms.append(f"(?P<w{len(forms)}>{plural})")
    return re.compile(rf"(?<![\w-])(?:{'|'.join(forms)})(?![\w-])")


def words_of(text: str, order: list[str], pattern: re.Pattern[str]) -> set[str]:
    """The words that occur in a text."""
    return {order[int(str(m.lastgroup)[1:])] for m in pattern.finditer(text.lower())}


def iris_of(question: Question) -> Iterator[str]:
    """IRIs in the expected answer."""
    expected = question.expected
    if isinstance(expected, Table):
        terms = [term for row in expected.rows for term in row]
    elif isinstance(expected, Contains):
        terms = [term for row in expected.rows for _, term in row]
    elif isinstance(expected, Triples):
        terms = [t for triple in expected.triples for t in (triple.subject, triple.object)]
    else:
        terms = []
    yield from (term.value for term in terms if isinstance(term, NamedNode))


def tell_glossary(questions: list[Question]) -> str:
    """The glossary as Markdown."""
    words, word_of = read_labels()
    order = sorted(set(words) - EVERYDAY, key=lambda w: (-len(w), w))
    pattern = make_pattern(words)
    objects: Counter[str] = Counter()
    for question in questions:
        for word in words_of(question.text, order, pattern):
            words[word].questions += 1
        found = set(iris_of(question))
        for word in {word_of[iri] for iri in found if iri in word_of}:
            words[word].answers += 1
        objects.update(iri for iri in found if iri not in word_of)
    used = {w: x for w, x in words.items() if x.questions or x.answers}
    ranked = sorted(used, key=lambda w: (-used[w].questions - used[w].answers, w))
    often = [w for w in ranked if used[w].questions + used[w].answers > 2]
    rest = sorted(set(ranked) - set(often))
    named = [i for i, n in sorted(objects.items(), key=lambda p: (-p[1], p[0])) if n > 2]
    lines = [
        f"{len(used)} of {len(words)} terms of the ontology occur in the {len(questions)} "
        "questions or in their answers.",
        "",
        "| term | kind | questions | answers |",
        "| --- | --- | ---: | ---: |",
        *(f"| {w} | {', '.join(sorted(used[w].kinds))} | {used[w].questions} | {used[w].answers} |"
          for w in often),
        "",
        f"Once or twice: {', '.join(rest)}.",
        "",
        f"Objects: the answers name {len(objects)} individuals, "
        "those of the example data included. In three answers or more:",
        "",
        "| object | answers |",
        "| --- | ---: |",
        *(f"| {tell_iri(iri)} | {objects[iri]} |" for iri in named),
    ]  # fmt: skip
    return "\n".join(lines)


def tell_iri(iri: str) -> str:
    """The last part of an IRI, as code."""
    return f"`{re.split(r'[#/]', iri.rstrip('#/'))[-1]}`"


def tell_questions(questions: list[Question]) -> str:
    """All questions by part and group, each with a link to its query or data."""
    lines: list[str] = []
    part = group = ""
    for question in questions:
        folder = question.manifest.resolve().parent
        if folder.name != part:
            part, group = folder.name, ""
            number = sum(q.manifest.resolve().parent == folder for q in questions)
            lines += ["", f"### {title_of(question.manifest)} ({number})"]
        if question.group != group:
            group = question.group
            lines += ["", f"**{group}**", ""]
        lines.append(f"- [{question.id}]({target_of(question)}) {question.text}")
    return "\n".join(lines).strip()


def title_of(manifest: Path) -> str:
    """The title of a manifest."""
    found = re.search(r'<>\s+dcterms:title\s+"([^"]+)"', manifest.read_text(encoding="utf-8"))
    return found[1] if found else manifest.parent.name


def target_of(question: Question) -> str:
    """The file to look into, relative to the page."""
    file = question.manifest
    if question.query and not question.query.inline:
        file = question.query.file
    elif question.query is None and question.data and isinstance(question.data[0], Path):
        file = question.data[0]
    return file.resolve().relative_to(FOLDER).as_posix()


def rewrite(page: str, questions: list[Question]) -> str:
    """The page with what stands between its markers made anew."""
    made = {"questions": tell_questions(questions), "glossary": tell_glossary(questions)}
    for name, text in made.items():
        begin, end = f"<!-- {name}: begin -->\n", f"<!-- {name}: end -->"
        if page.count(begin) != 1 or page.count(end) != 1:
            raise SystemExit(f"{PAGE}: needs the two markers of {name} once each")
        head, _, tail = page.partition(begin)
        page = head + begin + text + "\n" + end + tail.partition(end)[2]
    return page


def main(arguments: list[str]) -> int:
    """Rewrite the page, or with ``--check`` only say whether it is as it would be written."""
    old = PAGE.read_text(encoding="utf-8")
    new = rewrite(old, load_manifest(FOLDER / "manifest.ttl"))
    if "--check" in arguments:
        if old != new:
            print(f"{PAGE} is out of date: run scripts/glossary.py", file=sys.stderr)
        return int(old != new)
    PAGE.write_text(new, encoding="utf-8")
    print(f"wrote {PAGE}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
