"""Read questions in the short YAML form: prefixes, data, and questions with what they expect.

The keys are those of rdf-construct's ``cq-test``; docs/competency-questions.md lists them with the
ones that are added here.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NoReturn

from pyoxigraph import Literal, RdfFormat

from symboslam.reasoning.questions import rdf
from symboslam.reasoning.questions import vocabulary as v
from symboslam.reasoning.questions.expected import read_expected
from symboslam.reasoning.questions.model import (
    Contains,
    Data,
    Expected,
    InlineData,
    Query,
    Question,
    RowCount,
    Table,
    Term,
)
from symboslam.reasoning.questions.places import Lines, find_ontology
from symboslam.reasoning.questions.query import check_syntax
from symboslam.reasoning.questions.yaml_tree import Node, read_tree
from symboslam.reasoning.vocabulary import DOCUMENTS

_COMMON = {
    "owl": "http://www.w3.org/2002/07/owl#",
    "rdf": "http://www.w3.org/1999/02/22-rdf-syntax-ns#",
    "rdfs": v.RDFS_NAMESPACE,
    "skos": "http://www.w3.org/2004/02/skos/core#",
    "xsd": v.XSD_NAMESPACE,
}
_REGIMES = {"simple": v.SIMPLE, "rdfs": v.RDFS_REGIME, "owl-direct": v.OWL_DIRECT}
_TOP = {"version", "name", "description", "prefixes", "data", "ontology", "regime", "questions"}
_QUESTION = {
    "id", "name", "question", "description", "tags", "group", "query", "query_file", "expect",
    "skip", "skip_reason", "known_failing", "columns", "regime", "data",
}  # fmt: skip
_EXPECT = {
    "boolean", "has_results", "no_results", "count", "min", "min_results", "max", "max_results",
    "values", "results", "contains", "file",
}  # fmt: skip


def load_yaml(path: Path) -> list[Question]:
    """The questions of a YAML file.

    Raises:
        InputError: it does not parse, something is missing or unknown; names the line.
    """
    return _File(path).questions()


class _File:
    def __init__(self, path: Path) -> None:
        self.path = path
        text = rdf.read_text(path)
        self.lines = Lines(path, text)
        self.top = read_tree(text, self.lines)
        if not isinstance(self.top.value, Mapping):
            self._refuse(self.top, "a mapping with the key 'questions' is expected")
        self._check_keys(self.top, _TOP, "manifest")
        given = self._mapping(self.top, "prefixes")
        self.prefixes = {**_COMMON, **{str(k): str(n.value) for k, n in given.items()}}

    def questions(self) -> list[Question]:
        """All questions."""
        ontologies = tuple(
            find_ontology(self._iri(node), self.lines) for node in self._list(self.top, "ontology")
        )
        data = self._data(self.top)
        regime = self._regime(self.top, v.SIMPLE)
        return [
            self._question(node, ontologies, data, regime)
            for node in self._list(self.top, "questions")
        ]

    def _question(
        self, node: Node, ontologies: tuple[str | Path, ...], data: tuple[Data, ...], regime: str
    ) -> Question:
        if not isinstance(node.value, Mapping):
            self._refuse(node, "a question is a mapping with id, query and expect")
        self._check_keys(node, _QUESTION, "question")
        identifier = self._text(node, "id")
        if not identifier:
            self._refuse(node, "a question needs an id")
        tags = [str(tag.value) for tag in self._list(node, "tags")]
        known_failing = node.get("known_failing")
        skip = node.get("skip")
        reason = self._text(node, "skip_reason") or "it is marked to be skipped"
        failing = str(known_failing.value) if known_failing and known_failing.value else ""
        question = self._text(node, "question") or self._text(node, "name")
        return Question(
            id=identifier,
            text=question or self._text(node, "description") or identifier,
            group=self._text(node, "group") or (tags[0] if tags else self._text(self.top, "name")),
            query=self._query(node, identifier),
            expected=self._expected(node.get("expect")),
            data=(*data, *self._data(node)),
            ontologies=ontologies,
            regime=self._regime(node, regime),
            columns=tuple(str(c.value).lstrip("?") for c in self._list(node, "columns")),
            known_failing=failing,
            skip=reason if skip and skip.value else "",
            manifest=self.path,
            line=node.line,
        )

    def _query(self, node: Node, identifier: str) -> Query:
        inline, file = node.get("query"), node.get("query_file")
        prefixes = tuple(sorted(self.prefixes.items()))
        if inline is not None and file is None:
            query = Query(str(inline.value), self.path, inline.line, prefixes, inline=True)
        elif file is not None and inline is None:
            found = self._file(file, "query")
            query = Query(rdf.read_text(found), found, 1, prefixes)
        else:
            self._refuse(node, f"{identifier}: either query or query_file is needed")
        check_syntax(query)
        return query

    def _data(self, node: Node) -> tuple[Data, ...]:
        stated = node.get("data")
        if stated is None:
            return ()
        if not isinstance(stated.value, Mapping):
            return tuple(self._file(file, "data file") for file in self._list(node, "data"))
        self._check_keys(stated, {"inline", "files"}, "data")
        files = tuple(self._file(file, "data file") for file in self._list(stated, "files"))
        inline = stated.get("inline")
        if inline is None:
            return files
        # Prefixes go before the first line, so that the lines in messages stay right.
        known = " ".join(f"@prefix {name}: <{iri}> ." for name, iri in self.prefixes.items())
        found = InlineData(f"{known} {inline.value}", self.path, inline.line)
        text = found.text.encode()
        rdf.parse_quads(text, self.path, RdfFormat.TURTLE, first_line=found.line)
        return (found, *files)

    def _expected(self, node: Node | None) -> Expected | None:
        if node is None or node.value is None:
            return None
        if isinstance(node.value, bool):
            return node.value
        if node.value == "has_results":
            return RowCount(least=1)
        if node.value == "no_results":
            return RowCount(most=0)
        if not isinstance(node.value, Mapping) or not node.value:
            known = "true, false, has_results, no_results or a mapping"
            self._refuse(node, f"expect: {node.plain()!r} is not one of {known}")
        self._check_keys(node, _EXPECT, "expect")
        for key in ("values", "results", "contains"):
            if node.get(key) is not None:
                found = [self._row(row) for row in self._list(node, key)]
                return Contains(tuple(found)) if key == "contains" else self._table(found)
        if (file := node.get("file")) is not None:
            return read_expected(self._file(file, "expected result"))
        for key in ("boolean", "has_results", "no_results"):
            if (given := node.get(key)) is not None:
                if not isinstance(given.value, bool):
                    self._refuse(given, f"expect: {key} is true or false")
                if key == "boolean":
                    return given.value
                some = given.value is (key == "has_results")
                return RowCount(least=1) if some else RowCount(most=0)
        count = self._number(node, "count")
        least = self._number(node, "min", "min_results")
        most = self._number(node, "max", "max_results")
        return RowCount(least if count is None else count, most if count is None else count)

    def _number(self, node: Node, *keys: str) -> int | None:
        for key in keys:
            if (given := node.get(key)) is not None:
                if not isinstance(given.value, int) or isinstance(given.value, bool):
                    self._refuse(given, f"expect: {key} is a whole number")
                return int(given.value)
        return None

    def _row(self, node: Node) -> tuple[tuple[str, Term], ...]:
        if not isinstance(node.value, Mapping):
            self._refuse(node, "an expected row is a mapping from column to value")
        return tuple(
            (str(name).lstrip("?"), Literal(self._lexical(cell.value)))
            for name, cell in node.value.items()
        )

    def _table(self, rows: Sequence[tuple[tuple[str, Term], ...]]) -> Expected:
        columns = tuple(dict.fromkeys(name for row in rows for name, _ in row))
        if not columns:
            return RowCount(most=0)
        table = tuple(tuple(dict(row).get(name) for name in columns) for row in rows)
        return Table(columns, table, lexical=True)

    def _lexical(self, value: object) -> str:
        """The text of a value; a name with a prefix becomes an IRI."""
        if isinstance(value, bool):
            return str(value).lower()
        text = str(value)
        prefix, colon, name = text.partition(":")
        if colon and prefix in self.prefixes and name and not set(name) & set(" /"):
            return self.prefixes[prefix] + name
        return text

    def _regime(self, node: Node, default: str) -> str:
        given = node.get("regime")
        if given is None:
            return default
        regime = _REGIMES.get(str(given.value).casefold())
        if regime is None:
            self._refuse(given, f"regime: {given.value!r} is not one of simple, rdfs, owl-direct")
        return regime

    def _file(self, node: Node, what: str) -> Path:
        path = self.path.parent / str(node.value)
        if not path.is_file():
            self._refuse(node, f"the {what} {node.value} does not exist")
        return path

    def _iri(self, node: Node) -> str:
        text = str(node.value)
        if text.startswith(DOCUMENTS) or "://" in text:
            return text
        return self._file(node, "ontology").resolve().as_uri()

    def _list(self, node: Node, key: str) -> list[Node]:
        given = node.get(key)
        if given is None or given.value is None:
            return []
        return given.value if isinstance(given.value, list) else [given]

    def _mapping(self, node: Node, key: str) -> Mapping[str, Node]:
        given = node.get(key)
        if given is None or given.value is None:
            return {}
        if not isinstance(given.value, Mapping):
            self._refuse(given, f"{key} is a mapping")
        return given.value

    def _text(self, node: Node, key: str) -> str:
        given = node.get(key)
        return "" if given is None or given.value is None else str(given.value).strip()

    def _check_keys(self, node: Node, known: set[str], what: str) -> None:
        from difflib import get_close_matches

        for key, value in node.value.items():
            if key not in known:
                close = get_close_matches(str(key), known, n=1)
                hint = f"; is {close[0]!r} meant?" if close else ""
                self._refuse(value, f"{what}: the key {key!r} is not known{hint}")

    def _refuse(self, node: Node, problem: str) -> NoReturn:
        raise self.lines.error(node.line, problem)
