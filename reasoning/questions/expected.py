"""Read expected answers: SPARQL JSON, XML, TSV, CSV, RDF result sets and graphs."""

from __future__ import annotations

import codecs
import csv
import io
import json
from collections.abc import Sequence
from pathlib import Path

from pyoxigraph import (
    BlankNode,
    Literal,
    NamedNode,
    Quad,
    QueryBoolean,
    QueryResultsFormat,
    parse_query_results,
)

from symboslam.errors import InputError
from symboslam.reasoning.questions import vocabulary as v
from symboslam.reasoning.questions.model import Answer, Table, Term, Triples
from symboslam.reasoning.questions.rdf import explain, read_bytes, read_quads

_RESULTS = {
    ".srj": QueryResultsFormat.JSON,
    ".json": QueryResultsFormat.JSON,
    ".srx": QueryResultsFormat.XML,
    ".xml": QueryResultsFormat.XML,
    ".tsv": QueryResultsFormat.TSV,
}
_GRAPHS = (".ttl", ".nt", ".rdf")
_RS = v.RESULT_SET


def read_expected(path: Path) -> Answer:
    """The expected answer that a file holds; its name tells the format.

    Raises:
        InputError: it cannot be read, does not parse, or is of no known format.
    """
    kind = path.suffix.lower()
    if kind in _GRAPHS:
        quads = read_quads(path, rename=False)
        found = result_set(quads, path)
        return Triples(tuple(quad.triple for quad in quads)) if found is None else found
    data = read_bytes(path).removeprefix(codecs.BOM_UTF8)  # spreadsheets write one
    if kind == ".csv":
        return _read_csv(path, data)
    if kind not in _RESULTS:
        known = ", ".join((*_RESULTS, ".csv", *_GRAPHS))
        raise InputError(f"{path}: {kind or 'no ending'} is no known answer format; known: {known}")
    if kind == ".xml" or kind == ".srx":
        _refuse_doctype(path, data)
    if kind == ".tsv":
        data = _tidy_tsv(path, data)
    return _parse(data, _RESULTS[kind], str(path), 1)


def parse_literal(text: str, file: Path, line: int) -> Answer:
    """The expected answer that a manifest holds itself: ``true``, ``false`` or SPARQL JSON.

    Raises:
        InputError: it is neither.
    """
    plain = text.strip()
    if plain in ("true", "false", "1", "0"):
        return plain in ("true", "1")
    if not plain.startswith("{"):
        raise InputError(
            f"{file}: line {line}: the expected answer is neither true, false, SPARQL JSON nor "
            f"a file: {plain[:60]!r}"
        )
    return _parse(text.encode(), QueryResultsFormat.JSON, str(file), line)


def _parse(data: bytes, kind: QueryResultsFormat, name: str, first: int) -> Answer:
    try:
        if kind == QueryResultsFormat.JSON:
            json.loads(data)  # says line and column
        found = parse_query_results(data, kind)
        if isinstance(found, QueryBoolean):
            return bool(found)
        columns = tuple(variable.value for variable in found.variables)
        return Table(columns, tuple(tuple(row[i] for i in range(len(columns))) for row in found))
    except json.JSONDecodeError as error:
        raise InputError(f"{name}: line {first + error.lineno - 1}: {error.msg}") from error
    except SyntaxError as error:
        line = first - 1 + (error.lineno or 1)
        raise InputError(f"{name}: line {line}: {explain(error)}") from error
    except (ValueError, UnicodeDecodeError) as error:
        raise InputError(f"{name}: line {first}: {error}") from error


def _refuse_doctype(path: Path, data: bytes) -> None:
    head, found, _ = data.partition(b"<!DOCTYPE")
    if found:
        line = head.count(b"\n") + 1
        raise InputError(f"{path}: line {line}: a document type has no place in an answer")


def _tidy_tsv(path: Path, data: bytes) -> bytes:
    """TSV with plain line ends and as many cells in each row as there are columns.

    Raises:
        InputError: a row has more or fewer cells than the first.
    """
    text = data.decode("utf-8", "replace").replace("\r\n", "\n").rstrip("\n")
    lines = text.split("\n")
    width = lines[0].count("\t")
    for number, line in enumerate(lines, 1):
        if line.count("\t") != width:
            cells = line.count("\t") + 1
            problem = f"{cells} cells where the header has {width + 1} columns"
            raise InputError(f"{path}: line {number}: {problem}")
    return (text + "\n").encode()


def _read_csv(path: Path, data: bytes) -> Table:
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise InputError(f"{path}: line {line}: it is not UTF-8 text") from error
    reader = csv.reader(io.StringIO(text, newline=""), strict=True)
    try:
        columns = tuple(name.strip().removeprefix("?") for name in next(reader, ()))
        if not columns:
            raise InputError(f"{path}: line 1: there is no header with the names of the columns")
        rows = []
        for cells in reader:
            if not cells and len(columns) > 1:
                continue  # an empty line
            if len(cells) != len(columns) and not (not cells and len(columns) == 1):
                problem = f"{len(cells)} cells where the header has {len(columns)} columns"
                raise InputError(f"{path}: line {reader.line_num}: {problem}")
            rows.append(tuple(_plain(cell) for cell in cells) or (None,))
    except csv.Error as error:
        raise InputError(f"{path}: line {reader.line_num}: {error}") from error
    return Table(columns, tuple(rows), lexical=True)


def _plain(cell: str) -> Term | None:
    if cell.startswith("_:"):
        return BlankNode()
    return Literal(cell) if cell else None


def result_set(
    quads: Sequence[Quad], file: Path, node: NamedNode | BlankNode | None = None
) -> Answer | None:
    """The answer that an ``rs:ResultSet`` describes, or None if there is none.

    Args:
        quads: the statements to look in.
        file: where they come from.
        node: the result set; None for any.

    Raises:
        InputError: a binding lacks its variable or value.
    """
    kinds = [
        q.subject for q in quads
        if q.predicate.value == v.TYPE and q.object == NamedNode(_RS + "ResultSet")
    ]  # fmt: skip
    if node is None and not kinds:
        return None
    start = node or kinds[0]
    said: dict[object, dict[str, list[Term]]] = {}
    for quad in quads:
        about = said.setdefault(quad.subject, {})
        about.setdefault(quad.predicate.value, []).append(quad.object)
    about = said.get(start, {})
    if value := about.get(_RS + "boolean"):
        return _text(value[0]) in ("true", "1")
    columns = tuple(_text(name) for name in about.get(_RS + "resultVariable", ()))
    if not columns and not about.get(_RS + "solution"):
        return None
    rows = []
    for solution in about.get(_RS + "solution", ()):
        row: dict[str, Term] = {}
        for binding in said.get(solution, {}).get(_RS + "binding", ()):
            parts = said.get(binding, {})
            try:
                row[_text(parts[_RS + "variable"][0])] = parts[_RS + "value"][0]
            except KeyError:
                problem = "a binding of the result set lacks its rs:variable or rs:value"
                raise InputError(f"{file}: {problem}") from None
        index = said.get(solution, {}).get(_RS + "index", [Literal(0)])
        rows.append((int(_text(index[0])), tuple(row.get(name) for name in columns)))
    rows.sort(key=lambda row: row[0])
    return Table(columns, tuple(row for _, row in rows))


def _text(term: Term) -> str:
    return term.value if isinstance(term, Literal | NamedNode | BlankNode) else str(term)
