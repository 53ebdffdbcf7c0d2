"""What counts as the same answer, and how a difference is told."""

from __future__ import annotations

import pytest
from pyoxigraph import BlankNode, Literal, NamedNode, Triple

from symboslam.reasoning.questions.compare import difference, shorten, show
from symboslam.reasoning.questions.model import Contains, RowCount, Table, Term, Triples

XSD = "http://www.w3.org/2001/XMLSchema#"
A, B, C = (NamedNode(f"https://example.org/{name}") for name in "abc")


def number(text: str, kind: str = "decimal") -> Literal:
    return Literal(text, datatype=NamedNode(XSD + kind))


def table(*rows: tuple[Term | None, ...], columns: str = "xyz", lexical: bool = False) -> Table:
    width = len(rows[0]) if rows else len(columns)
    return Table(tuple(columns[:width]), tuple(rows), lexical)


def test_rows_are_a_bag() -> None:
    assert not difference(table((A,), (B,), (A,)), table((A,), (A,), (B,)))
    text = difference(table((A,), (B,), (A,)), table((B,), (B,), (A,)))
    assert text.splitlines() == [
        "missing 1 row:",
        "  x=<https://example.org/a>",
        "unexpected 1 row:",
        "  x=<https://example.org/b>",
    ]


def test_order_counts_only_if_asked_for() -> None:
    one, other = table((A,), (B,)), table((B,), (A,))
    assert not difference(one, other)
    text = difference(one, other, ordered=True, prefixes={"e": "https://example.org/"})
    assert text == "the order differs at row 1: expected x=e:a; got x=e:b"
    assert not difference(one, one, ordered=True)


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        (number("1", "integer"), number("1.0"), True),
        (number("1e0", "double"), number("1", "int"), True),
        (number("0.3"), number("0.30000000000000004", "double"), True),
        (number("0.3"), number("0.300001"), False),
        (number("1000000000"), number("1000000001"), True),  # 1e-9 of it
        (number("1000000000"), number("1000000010"), False),
        (number("0"), number("1e-10", "double"), True),
        (number("0"), number("1e-8", "double"), False),
        (Literal("1"), number("1"), False),
        (Literal("1"), Literal("1.0"), False),
        (number("NaN", "double"), number("NaN", "double"), True),
        (number("INF", "double"), number("-INF", "double"), False),
        (Literal("a", language="en"), Literal("a", language="EN"), True),
        (Literal("a", language="en"), Literal("a"), False),
        (Literal("a"), Literal("a", datatype=NamedNode(XSD + "string")), True),
        (number("true", "boolean"), number("1", "boolean"), True),
        (BlankNode("a"), BlankNode("b"), True),
        (BlankNode("a"), A, False),
        (None, None, True),
        (None, Literal(""), False),
        (A, Literal(A.value), False),
    ],
)
def test_terms(one: Term | None, other: Term | None, same: bool) -> None:
    assert bool(difference(table((one,)), table((other,)))) is not same
    assert bool(difference(table((other,)), table((one,)))) is not same


@pytest.mark.parametrize(
    ("cell", "term", "same"),
    [
        ("house", Literal("house", language="en"), True),
        ("0.90", number("0.9"), True),
        ("0.9", Literal("0.90"), True),
        (A.value, A, True),
        ("https://example.org/", A, False),
        ("2024-01-01", number("2024-01-01", "date"), True),
        ("1_0", number("10"), False),
    ],
)
def test_text_only_answers(cell: str, term: Term, same: bool) -> None:
    expected = table((Literal(cell),), lexical=True)
    assert bool(difference(expected, table((term,)))) is not same


def test_no_value_and_an_empty_text_look_alike_in_csv() -> None:
    assert not difference(table((None,), lexical=True), table((Literal(""),)))
    assert not difference(table((None,), lexical=True), table((None,)))


def test_tolerance_pairs_each_row_once() -> None:
    one = table((number("1"),), (number("1.0000000001"),))
    assert not difference(one, table((number("1.0000000002"),), (number("1"),)))
    text = difference(one, table((number("1"),), (number("2"),)))
    assert text.splitlines() == [
        "missing 1 row:", "  x=1.0000000001", "unexpected 1 row:", "  x=2",
    ]  # fmt: skip


def test_chosen_columns() -> None:
    expected = table((A, B), columns="xy")
    answer = table((C, A, B), columns="zxy")
    assert difference(expected, answer) == "the query has a column that is not expected: z"
    assert not difference(expected, answer, columns=["x", "y"])
    assert not difference(expected, answer, columns=["y"])
    text = difference(expected, answer, columns=["y", "w"])
    assert text == "the expected answer has no column w"
    text = difference(answer, expected)
    assert text == "the query has no column z"
    # Columns are matched by name, not by place.
    assert not difference(table((A, B), columns="xy"), table((B, A), columns="yx"))


def test_chosen_columns_keep_duplicates() -> None:
    answer = table((A, B), (A, C))
    assert not difference(table((A,), (A,)), answer, columns=["x"])
    assert "unexpected 1 row" in difference(table((A,)), answer, columns=["x"])


def test_long_differences_are_cut() -> None:
    rows = tuple((number(str(i), "integer"),) for i in range(9))
    lines = difference(Table(("x",), rows), Table(("x",), ())).splitlines()
    assert lines[0] == "missing 9 rows:"
    assert lines[1:6] == [f"  x={i}" for i in range(5)]
    assert lines[6:] == ["  ... and 4 more"]


def test_kinds_of_answers() -> None:
    assert not difference(True, True)
    assert difference(True, False) == "expected true, got false"
    assert difference(True, table()) == "expected true, but the query gives a table"
    assert difference(table(), False) == "expected a table, but the query gives false"
    assert difference(Triples(()), table()) == "expected a graph, but the query gives a table"


@pytest.mark.parametrize(
    ("least", "most", "text"),
    [
        (1, None, ""),
        (2, 2, ""),
        (None, 2, ""),
        (3, None, "expected at least 3 rows, got 2"),
        (None, 1, "expected at most 1 row, got 2"),
        (5, 5, "expected exactly 5 rows, got 2"),
        (0, 0, "expected exactly 0 rows, got 2"),
    ],
)
def test_counts(least: int | None, most: int | None, text: str) -> None:
    assert difference(RowCount(least, most), table((A,), (B,))) == text


def test_contains() -> None:
    answer = table((A, number("1.0")), (B, Literal("two", language="en")))
    assert not difference(Contains(((("y", Literal("1")),),)), answer)
    assert not difference(Contains(((("x", Literal(B.value)), ("y", Literal("two"))),)), answer)
    text = difference(Contains(((("x", Literal(A.value)), ("y", Literal("two"))),)), answer)
    assert text.startswith("missing 1 row:\n")
    assert difference(Contains(((("w", Literal("1")),),)), answer) == "the query has no column w"


def test_graphs_are_compared_up_to_the_names_of_anonymous_nodes() -> None:
    def graph(one: str, other: str, end: NamedNode) -> Triples:
        first, second = BlankNode(one), BlankNode(other)
        return Triples((Triple(A, B, first), Triple(first, B, second), Triple(second, B, end)))

    assert not difference(graph("p", "q", C), graph("q", "p", C))
    text = difference(graph("p", "q", C), graph("p", "q", A), prefixes={"": "https://example.org/"})
    assert "missing" in text
    assert "[] :b :c" in text


def test_words_for_terms() -> None:
    prefixes = {"e": "https://example.org/", "eh": "https://example.org/h#"}
    assert shorten("https://example.org/h#x", prefixes) == "eh:x"
    assert shorten("https://example.org/h/x", prefixes) == "<https://example.org/h/x>"
    assert shorten("https://example.org/", prefixes) == "<https://example.org/>"
    assert show(Literal("a", language="en"), {}) == '"a"@en'
    assert show(number("0.90"), {}) == "0.90"
    assert show(number("2024-01-01", "date"), {"xsd": XSD}) == '"2024-01-01"^^xsd:date'
    assert show(None, {}) == "(none)"
