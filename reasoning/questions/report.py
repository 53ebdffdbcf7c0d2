"""Write the results of a run: the formats, and what they share."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

from pyoxigraph import BlankNode, Literal

from symboslam.errors import InputError
from symboslam.reasoning.questions.model import (
    STATUSES,
    Contains,
    Expected,
    Report,
    RowCount,
    Table,
    Term,
    Triples,
)

FORMATS = ("text", "json", "junit", "md", "html")


def render(report: Report, form: str) -> str:
    """The report in one of ``FORMATS``.

    Raises:
        InputError: there is no such format.
    """
    if form not in FORMATS:
        raise InputError(f"--format {form}: known formats are {', '.join(FORMATS)}")
    module = import_module(f"symboslam.reasoning.questions.report_{form}")
    write: Callable[[Report], str] = module.render
    return write(report)


def summary(report: Report) -> str:
    """The counts in words: ``78 passed, 1 failed``."""
    found = [f"{report.counts[status]} {status}" for status in STATUSES if report.counts[status]]
    return ", ".join(found) or "no questions"


def plain(term: Term | None) -> str:
    """A term in N-Triples, ``_:`` for an anonymous node; empty for none."""
    if term is None:
        return ""
    return "_:" if isinstance(term, BlankNode) else str(term)


def record(answer: Expected | None, most: int | None = None) -> Any:
    """An answer, or what is expected of it, in JSON's terms.

    Args:
        answer: the answer.
        most: rows to list at most; None for all.
    """
    if answer is None or isinstance(answer, bool):
        return answer
    if isinstance(answer, RowCount):
        return {"least": answer.least, "most": answer.most}
    if isinstance(answer, Contains):
        return {"contains": [{n: _lexical(t) for n, t in row} for row in answer.rows]}
    if isinstance(answer, Triples):
        return {"triples": sorted(map(str, answer.triples))[:most], "count": len(answer.triples)}
    show = _lexical if answer.lexical else plain
    rows = [[show(term) for term in row] for row in answer.rows[:most]]
    return {"columns": list(answer.columns), "rows": rows, "count": len(answer.rows)}


def _lexical(term: Term | None) -> str:
    return term.value if isinstance(term, Literal) else plain(term)


def in_words(expected: Expected | None) -> str:
    """What is expected, where it is no table or graph."""
    if expected is None:
        return "any answer"
    if isinstance(expected, bool):
        return str(expected).lower()
    if isinstance(expected, RowCount):
        if expected.least == expected.most:
            return f"exactly {expected.least} rows"
        parts = []
        if expected.least is not None:
            parts.append(f"at least {expected.least} rows")
        if expected.most is not None:
            parts.append(f"at most {expected.most} rows")
        return " and ".join(parts) or "any answer"
    if isinstance(expected, Contains):
        return f"among others {len(expected.rows)} rows"
    return ""


def as_table(answer: Expected | None) -> Table | None:
    """Columns and rows of an answer, triples included; None where there are none."""
    if isinstance(answer, Table):
        return answer
    if isinstance(answer, Triples):
        rows = sorted(((t.subject, t.predicate, t.object) for t in answer.triples), key=str)
        return Table(("subject", "predicate", "object"), tuple(rows))
    return None
