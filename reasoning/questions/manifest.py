"""Read a manifest of competency questions: Turtle in OWLunit's vocabulary, or short YAML."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from pyoxigraph import BlankNode, Literal, NamedNode, Quad, RdfFormat

from symboslam.errors import InputError
from symboslam.reasoning.questions import model, rdf
from symboslam.reasoning.questions import vocabulary as v
from symboslam.reasoning.questions.expected import parse_literal, read_expected, result_set
from symboslam.reasoning.questions.model import Expected, Query, Question, Term
from symboslam.reasoning.questions.places import Lines, file_of, find_file, find_ontology
from symboslam.reasoning.questions.query import check_syntax
from symboslam.reasoning.vocabulary import SL, local_name

YAML_ENDINGS = (".yml", ".yaml")
_KINDS = {
    v.QUESTION: model.QUESTION,
    v.INFERENCE: model.INFERENCE,
    v.PROVOCATION: model.PROVOCATION,
    v.ANNOTATION: model.ANNOTATION,
}
_REGIMES = (v.SIMPLE, v.RDFS_REGIME, v.OWL_DIRECT)


def default_manifest() -> Path:
    """The manifest of the package's own questions."""
    from importlib.resources import files

    return Path(str(files("symboslam.competency_questions") / "manifest.ttl"))


def load_manifest(path: str | Path) -> list[Question]:
    """All questions of a manifest and of those that it imports, in their order.

    Everything that they name is looked for, and all queries and expected answers are parsed.

    Raises:
        InputError: a file is missing or does not parse, or something is said wrongly; names the
            file and the line.
    """
    path = Path(path)
    if path.suffix.lower() in YAML_ENDINGS:
        from symboslam.reasoning.questions.yaml_manifest import load_yaml

        questions = load_yaml(path)
    else:
        questions = list(_read_all(path, set()))
    if not questions:
        raise InputError(f"{path}: line 1: no competency question in it")
    seen: dict[str, Question] = {}
    for question in questions:
        if (other := seen.setdefault(question.id, question)) is not question:
            raise InputError(
                f"{question.manifest}: line {question.line}: the identifier {question.id!r} is "
                f"taken: {other.manifest}, line {other.line}"
            )
    return questions


def _read_all(path: Path, seen: set[Path]) -> Iterator[Question]:
    if path.resolve() in seen:
        return
    seen.add(path.resolve())
    part = _Part(path)
    yield from part.questions()
    for other in part.parts():
        if other.suffix.lower() in YAML_ENDINGS:
            yield from load_manifest(other)
        else:
            yield from _read_all(other, seen)


class _Part:
    """One manifest file.

    Raises:
        InputError: it cannot be read or does not parse.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        text = rdf.read_text(path)
        self.lines = Lines(path, text)
        self.quads = rdf.parse_quads(text.encode(), path, RdfFormat.TURTLE)
        self.said: dict[Term, dict[str, list[Term]]] = {}
        for quad in self.quads:
            about = self.said.setdefault(quad.subject, {})
            about.setdefault(quad.predicate.value, []).append(quad.object)
        self.document = NamedNode(path.resolve().as_uri())
        self.suites = [s for s in self.said if NamedNode(v.SUITE) in self._all(s, v.TYPE)]
        self.suite_of = {c: s for s in self.suites for c in self._all(s, v.HAS_TEST_CASE)}

    def parts(self) -> list[Path]:
        """The manifests that this one imports, and test cases that are files of their own."""
        found: list[Path] = []
        for subject in self.said:
            links = [*self._all(subject, v.IMPORTS)]
            if subject == self.document:
                links += filter(_is_manifest, self._all(subject, v.SEE_ALSO))
            if subject in self.suites:
                links += filter(self._is_elsewhere, self._all(subject, v.HAS_TEST_CASE))
            for link in links:
                if not isinstance(link, NamedNode):
                    line = self.lines.of_text(_plain(link))
                    raise self.lines.error(line, "a manifest is imported by its IRI: <...>")
                document, _, name = link.value.partition("#")
                if document == self.document.value and name:
                    line = self.lines.of_iri(link.value)
                    raise self.lines.error(line, f"there is no test case {name!r}")
                found.append(find_file(document, "manifest", self.lines))
        return found

    def questions(self) -> Iterator[Question]:
        """The test cases, in the order in which they first appear."""
        for subject in self.said:
            kinds = [_KINDS[k.value] for k in self._all(subject, v.TYPE)
                     if isinstance(k, NamedNode) and k.value in _KINDS]  # fmt: skip
            if kinds and not (subject in self.suite_of and self._is_elsewhere(subject)):
                yield self._question(subject, kinds[0])

    def _is_elsewhere(self, case: Term) -> bool:
        """Whether a suite's test case is another file: here, at most its kind is said."""
        return not self.said.get(case, {}).keys() - {v.TYPE}

    def _refuse_slips(self, subject: Term) -> None:
        """Refuse a property that looks like a known one: ignored, the question would pass."""
        from difflib import get_close_matches

        for predicate in self.said.get(subject, {}):
            if predicate in v.KNOWN or not predicate.startswith((v.OWLUNIT, SL)):
                continue
            for meant in get_close_matches(predicate, v.KNOWN, n=1, cutoff=0.9):
                line = self.lines.of_iri(predicate)
                problem = f"there is no property {local_name(predicate)!r}"
                raise self.lines.error(line, f"{problem}; did you mean {local_name(meant)}?")

    def _question(self, subject: Term, kind: str) -> Question:
        self._refuse_slips(subject)
        line = self._line(subject)
        own = NamedNode(subject.value) if isinstance(subject, NamedNode) else None
        identifier = self._one(subject, v.IDENTIFIER) or (
            own and local_name(own.value).removesuffix(".ttl")
        )
        if not identifier:
            raise self.lines.error(line, "a question needs a dcterms:identifier")
        text = self._one(subject, v.HAS_QUESTION) or self._one(subject, v.TITLE)
        text = text or self._one(subject, v.LABEL) or self._one(subject, v.DESCRIPTION)
        group = self._inherited(subject, v.SUBJECT)
        suite = self.suite_of.get(subject)
        if not group and suite is not None:
            group = [Literal(self._one(suite, v.TITLE) or self._one(suite, v.LABEL))]
        regime = self._regime(subject, kind)
        for reasoner in self._all(subject, v.HAS_REASONER):
            if not (isinstance(reasoner, NamedNode) and reasoner.value == v.HERMIT):
                raise self.lines.error(line, f"{identifier}: the only reasoner is owlunit:HermiT")
        query = self._query(subject, identifier, kind, line)
        shapes = self._files(subject, v.HAS_SHAPES, "shapes file")
        data = self._files(subject, v.HAS_DATA, "data file")
        if kind == model.PROVOCATION and not data:
            raise self.lines.error(line, f"{identifier}: an error provocation needs input data")
        return Question(
            id=identifier,
            text=text or identifier,
            kind=kind,
            group=_plain(group[0]) if group else "",
            query=query,
            expected=self._expected(subject, identifier, line) if query else None,
            data=tuple(data),
            ontologies=tuple(
                find_ontology(iri, self.lines)
                for iri in self._iris(subject, v.TESTS_ONTOLOGY, "ontology")
            ),
            regime=regime,
            columns=tuple(_plain(c).lstrip("?") for c in self._all(subject, v.COMPARES_COLUMN)),
            known_failing=self._one(subject, v.KNOWN_FAILING),
            shapes=tuple(shapes),
            manifest=self.path,
            line=line,
        )

    def _regime(self, subject: Term, kind: str) -> str:
        default = v.OWL_DIRECT if kind in (model.INFERENCE, model.PROVOCATION) else v.SIMPLE
        stated = self._all(subject, v.ENTAILMENT_REGIME)
        if not stated and default == v.SIMPLE:
            stated = self._inherited(subject, v.ENTAILMENT_REGIME)
        if not stated:
            return default
        regime = _plain(stated[0])
        if regime not in _REGIMES:
            known = ", ".join(f"ent:{local_name(r)}" for r in _REGIMES)
            line = self.lines.of_iri(regime)
            raise self.lines.error(
                line, f"<{regime}> is no known entailment regime; known: {known}"
            )
        return regime

    def _query(self, subject: Term, identifier: str, kind: str, line: int) -> Query | None:
        stated = self._all(subject, v.HAS_QUERY)
        if len(stated) > 1:
            raise self.lines.error(line, f"{identifier}: more than one query")
        if not stated:
            if kind == model.QUESTION:
                problem = f"{identifier}: a competency question needs owlunit:hasSPARQLUnitTest"
                raise self.lines.error(line, problem)
            return None
        (where,) = stated
        if isinstance(where, Literal):
            first = self.lines.of_text(where.value)
            query = Query(where.value, self.path, first, inline=True)
        elif isinstance(where, NamedNode):
            file = find_file(where.value, "query", self.lines)
            query = Query(rdf.read_text(file), file)
        else:
            raise self.lines.error(line, f"{identifier}: a query is a file or a text")
        check_syntax(query)
        return query

    def _expected(self, subject: Term, identifier: str, line: int) -> Expected | None:
        stated = self._all(subject, v.HAS_EXPECTED)
        if len(stated) > 1:
            raise self.lines.error(line, f"{identifier}: more than one expected result")
        if not stated:
            return None
        (where,) = stated
        if isinstance(where, Literal):
            return parse_literal(where.value, self.path, self.lines.of_text(where.value))
        if isinstance(where, NamedNode) and where not in self.said:
            return read_expected(find_file(where.value, "expected result", self.lines))
        if isinstance(where, NamedNode | BlankNode):
            found = result_set(self.quads, self.path, where)
            if found is not None:
                return found
        raise self.lines.error(line, f"{identifier}: the expected result is no rs:ResultSet")

    def _files(self, subject: Term, prop: str, what: str) -> list[Path]:
        return [find_file(iri, what, self.lines) for iri in self._iris(subject, prop, what)]

    def _iris(self, subject: Term, prop: str, what: str) -> list[str]:
        found = []
        for term in self._inherited(subject, prop):
            if not isinstance(term, NamedNode):
                line = self.lines.of_text(_plain(term))
                raise self.lines.error(line, f"the {what} {_plain(term)!r} has to be an IRI: <...>")
            found.append(term.value)
        return found

    def _inherited(self, subject: Term, prop: str) -> Sequence[Term]:
        """What a question says, or else its suite, or else the manifest."""
        suite = self.suite_of.get(subject)
        return (
            self._all(subject, prop)
            or (self._all(suite, prop) if suite is not None else ())
            or self._all(self.document, prop)
        )

    def _all(self, subject: Term, prop: str) -> Sequence[Term]:
        return self.said.get(subject, {}).get(prop, ())

    def _one(self, subject: Term, prop: str) -> str:
        found = self._all(subject, prop)
        english = [t for t in found if isinstance(t, Literal) and t.language in (None, "en")]
        return _plain((english or found)[0]).strip() if found else ""

    def _line(self, subject: Term) -> int:
        if isinstance(subject, NamedNode):
            return self.lines.of_iri(subject.value)
        text = self._one(subject, v.HAS_QUESTION) or self._one(subject, v.IDENTIFIER)
        return self.lines.of_text(text) if text else 1


def _is_manifest(link: Term) -> bool:
    """Whether something to see is a manifest beside this one, and not a page to read."""
    path = file_of(link.value) if isinstance(link, NamedNode) else None
    return path is not None and path.suffix.lower() in (".ttl", *YAML_ENDINGS)


def _plain(term: Term) -> str:
    return term.value if isinstance(term, Literal | NamedNode | BlankNode) else str(term)


def quads_in(data: model.Data) -> list[Quad]:
    """The statements of a question's input data.

    Raises:
        InputError: it cannot be read or does not parse.
    """
    if isinstance(data, Path):
        return rdf.read_quads(data)
    text = data.text.encode()
    return rdf.parse_quads(text, data.file, RdfFormat.TURTLE, first_line=data.line)
