"""Compare the answer to a question with the expected one, and say in what they differ."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from math import isclose, isfinite

from pyoxigraph import BlankNode, CanonicalizationAlgorithm, Dataset, Literal, NamedNode, Quad

from symboslam.reasoning.questions import vocabulary as v
from symboslam.reasoning.questions.model import (
    Answer,
    Contains,
    Expected,
    RowCount,
    Table,
    Term,
    Triples,
)

TOLERANCE = 1e-9
_SHOWN = 5  # rows of a difference that a message lists
_NUMBERS = {
    v.XSD_NAMESPACE + name
    for name in (
        "integer", "decimal", "double", "float", "int", "long", "short", "byte",
        "nonNegativeInteger", "positiveInteger", "nonPositiveInteger", "negativeInteger",
        "unsignedInt", "unsignedLong", "unsignedShort", "unsignedByte",
    )
}  # fmt: skip

Key = tuple[object, ...]
Row = tuple[Term | None, ...]


def difference(
    expected: Expected,
    answer: Answer,
    *,
    columns: Sequence[str] = (),
    ordered: bool = False,
    prefixes: Mapping[str, str] | None = None,
) -> str:
    """In what an answer differs from the expected one; empty if it does not.

    Rows are compared as bags: duplicates count. Numbers are compared by value, anonymous nodes
    only by being anonymous.

    Args:
        expected: the right answer.
        answer: the answer of the query.
        columns: the columns that count; empty for all.
        ordered: the order of the rows counts.
        prefixes: to shorten IRIs in the message with.
    """
    shown = prefixes or {}
    if isinstance(expected, RowCount):
        return _count_difference(expected, answer)
    if isinstance(expected, Contains):
        return _lacks(expected, answer, shown)
    if type(expected) is not type(answer):
        return f"expected {_kind(expected)}, but the query gives {_kind(answer)}"
    if isinstance(expected, Table) and isinstance(answer, Table):
        return _table_difference(expected, answer, tuple(columns), ordered, shown)
    if isinstance(expected, Triples) and isinstance(answer, Triples):
        return _graph_difference(expected, answer, shown)
    return "" if expected == answer else f"expected {_kind(expected)}, got {_kind(answer)}"


def _kind(answer: object) -> str:
    if isinstance(answer, bool):
        return str(answer).lower()
    return "a table" if isinstance(answer, Table) else "a graph"


def size(answer: Answer) -> int:
    """Number of rows or triples; 1 for true, 0 for false."""
    if isinstance(answer, Table):
        return len(answer.rows)
    return len(answer.triples) if isinstance(answer, Triples) else int(answer)


def _count_difference(expected: RowCount, answer: Answer) -> str:
    found = size(answer)
    if expected.least is not None and found < expected.least:
        bound = "exactly" if expected.least == expected.most else "at least"
        return f"expected {bound} {_rows(expected.least)}, got {found}"
    if expected.most is not None and found > expected.most:
        bound = "exactly" if expected.least == expected.most else "at most"
        return f"expected {bound} {_rows(expected.most)}, got {found}"
    return ""


def _rows(number: int) -> str:
    return "1 row" if number == 1 else f"{number} rows"


def _lacks(expected: Contains, answer: Answer, prefixes: Mapping[str, str]) -> str:
    if not isinstance(answer, Table):
        return f"expected rows, but the query gives {_kind(answer)}"
    unknown = {name for row in expected.rows for name, _ in row} - set(answer.columns)
    if unknown:
        return f"the query has no column {', '.join(sorted(unknown))}"
    missing = []
    for row in expected.rows:
        places = [answer.columns.index(name) for name, _ in row]
        wanted = tuple(term for _, term in row)
        given = (tuple(found[i] for i in places) for found in answer.rows)
        if not any(_same(wanted, one, lexical=True) for one in given):
            cells = (f"{name}={show(term, prefixes)}" for name, term in row)
            missing.append(", ".join(cells))
    return _listed("missing", missing)


def _table_difference(
    expected: Table,
    answer: Table,
    columns: tuple[str, ...],
    ordered: bool,
    prefixes: Mapping[str, str],
) -> str:
    chosen = columns or expected.columns
    for table, name in ((expected, "expected answer"), (answer, "query")):
        if lacking := sorted(set(chosen) - set(table.columns)):
            return f"the {name} has no column {', '.join(lacking)}"
    if not columns and (more := sorted(set(answer.columns) - set(expected.columns))):
        return f"the query has a column that is not expected: {', '.join(more)}"
    wanted, given = _project(expected, chosen), _project(answer, chosen)
    lexical = expected.lexical or answer.lexical

    def lines(rows: Iterable[Row]) -> list[str]:
        texts = [
            ", ".join(f"{c}={show(t, prefixes)}" for c, t in zip(chosen, row, strict=True))
            for row in rows
        ]
        return texts if ordered else sorted(texts)

    missing, unexpected = _bag_difference(wanted, given, lexical)
    parts = [_listed("missing", lines(missing)), _listed("unexpected", lines(unexpected))]
    text = "\n".join(part for part in parts if part)
    if not text and ordered:
        for number, (one, other) in enumerate(zip(wanted, given, strict=True), 1):
            if not _same(one, other, lexical=lexical):
                there, here = lines([one, other])
                return f"the order differs at row {number}: expected {there}; got {here}"
    return text


def _project(table: Table, columns: Sequence[str]) -> list[Row]:
    places = [table.columns.index(name) for name in columns]
    return [tuple(row[i] for i in places) for row in table.rows]


def _bag_difference(
    wanted: Sequence[Row], given: Sequence[Row], lexical: bool
) -> tuple[list[Row], list[Row]]:
    """Rows of each side that have no partner on the other."""
    spare = Counter(_row_key(row, lexical) for row in given)
    missing = []
    for row in wanted:
        key = _row_key(row, lexical)
        if spare[key]:
            spare[key] -= 1
        else:
            missing.append(row)
    unexpected = []
    for row in reversed(given):  # of equal rows the last ones are the surplus
        key = _row_key(row, lexical)
        if spare[key]:
            spare[key] -= 1
            unexpected.append(row)
    unexpected.reverse()
    # What is left differs, except for numbers that are equal within the tolerance.
    for row in list(missing):
        partner = next((u for u in unexpected if _same(row, u, lexical=lexical)), None)
        if partner is not None:
            missing.remove(row)
            unexpected.remove(partner)
    return missing, unexpected


def _row_key(row: Row, lexical: bool) -> Key:
    return tuple(_key(term, lexical) for term in row)


def _key(term: Term | None, lexical: bool) -> Key:
    """Equal for terms that are the same; numbers are by value."""
    if term is None:
        return ("",)
    if isinstance(term, BlankNode):
        return ("_:",)
    if (number := _number(term, lexical)) is not None:
        return ("number", number)
    if isinstance(term, Literal):
        if lexical:
            # An empty text and no value look alike in CSV.
            return ("text", term.value) if term.value else ("",)
        if term.datatype.value == v.XSD_NAMESPACE + "boolean":
            return ("boolean", term.value in ("true", "1"))
        return ("literal", term.value, (term.language or "").lower(), term.datatype.value)
    if isinstance(term, NamedNode):
        return ("text" if lexical else "iri", term.value)
    return ("triple", str(term))


def _number(term: Term, lexical: bool) -> float | None:
    if not isinstance(term, Literal) or "_" in term.value:
        return None
    if not lexical and term.datatype.value not in _NUMBERS:
        return None
    try:
        number = float(term.value)
    except ValueError:
        return None
    return number if isfinite(number) else None


def _same(one: Row, other: Row, *, lexical: bool) -> bool:
    for a, b in zip(one, other, strict=True):
        first, second = _key(a, lexical), _key(b, lexical)
        if first == second:
            continue
        if first[0] != "number" or second[0] != "number":
            return False
        x, y = float(str(first[1])), float(str(second[1]))
        if not isclose(x, y, rel_tol=TOLERANCE, abs_tol=TOLERANCE):
            return False
    return True


def _graph_difference(expected: Triples, answer: Triples, prefixes: Mapping[str, str]) -> str:
    wanted, given = _canonical(expected), _canonical(answer)

    def lines(triples: Iterable[Quad]) -> list[str]:
        parts = ((q.subject, q.predicate, q.object) for q in triples)
        return sorted(" ".join(show(term, prefixes) for term in part) for part in parts)

    missing, unexpected = lines(wanted - given), lines(given - wanted)
    texts = (_listed("missing", missing, "triple"), _listed("unexpected", unexpected, "triple"))
    return "\n".join(text for text in texts if text)


def _canonical(graph: Triples) -> set[Quad]:
    """Triples whose anonymous nodes have names that depend on their surroundings only."""
    dataset = Dataset(Quad(t.subject, t.predicate, t.object) for t in graph.triples)
    dataset.canonicalize(CanonicalizationAlgorithm.RDFC_1_0)
    return set(dataset)


def _listed(title: str, lines: Sequence[str], noun: str = "row") -> str:
    if not lines:
        return ""
    number = f"{len(lines)} {noun}{'' if len(lines) == 1 else 's'}"
    shown = [f"  {line}" for line in lines[:_SHOWN]]
    if len(lines) > _SHOWN:
        shown.append(f"  ... and {len(lines) - _SHOWN} more")
    return "\n".join((f"{title} {number}:", *shown))


def show(term: Term | None, prefixes: Mapping[str, str]) -> str:
    """A term in Turtle, with prefixes where they fit; numbers and plain texts as they are."""
    if term is None:
        return "(none)"
    if isinstance(term, NamedNode):
        return shorten(term.value, prefixes)
    if isinstance(term, Literal):
        if term.datatype.value in _NUMBERS or term.datatype.value.endswith("#boolean"):
            return term.value
        text = f'"{term.value}"'
        if term.language:
            return f"{text}@{term.language}"
        plain = term.datatype.value == v.XSD_NAMESPACE + "string"
        return text if plain else f"{text}^^{shorten(term.datatype.value, prefixes)}"
    return "[]" if isinstance(term, BlankNode) else str(term)


def shorten(iri: str, prefixes: Mapping[str, str]) -> str:
    """An IRI with the longest prefix that fits, else in angle brackets."""
    fitting = [(space, name) for name, space in prefixes.items() if space and iri.startswith(space)]
    if fitting:
        space, name = max(fitting, key=lambda pair: len(pair[0]))
        rest = iri[len(space) :]
        if rest and "/" not in rest and "#" not in rest:
            return f"{name}:{rest}"
    return f"<{iri}>"
