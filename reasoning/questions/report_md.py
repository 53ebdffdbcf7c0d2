"""Results as Markdown: a table for each group, then every question with query and answer."""

from __future__ import annotations

import re
from collections.abc import Mapping

from symboslam.reasoning.questions.compare import show
from symboslam.reasoning.questions.model import PASSED, Expected, Report, Result
from symboslam.reasoning.questions.query import prefixes_of
from symboslam.reasoning.questions.report import as_table, in_words, summary

_MARKS = {"passed": "✓", "failed": "✗", "broken": "✗", "known failing": "!", "skipped": "–"}
_ROWS = 20  # of an answer


def render(report: Report) -> str:
    """The report as Markdown."""
    lines = [f"# {inline(report.title)}", "", f"{summary(report)}."]
    for group, results in report.groups.items():
        lines += ["", f"## {inline(group)}", "", "| | id | question |", "| --- | --- | --- |"]
        for result in results:
            mark = f"{_MARKS[result.status]} {result.status}"
            lines.append(f"| {mark} | {result.question.id} | {inline(result.question.text)} |")
        for result in results:
            lines += _question(result)
    return "\n".join(lines) + "\n"


def _question(result: Result) -> list[str]:
    question = result.question
    lines = ["", f"### {question.id}: {inline(question.text)}", ""]
    lines.append(f"{_MARKS[result.status]} {result.status}, {question.kind}")
    if result.message and (result.status != PASSED or question.known_failing):
        lines += ["", *_block(result.message, "text")]
    if question.query is None:
        return lines
    lines += ["", *_block(question.query.text.strip("\n"), "sparql")]
    prefixes = prefixes_of(question.query)
    answer = question.expected if result.answer is None else result.answer
    words = in_words(answer)
    lines += ["", f"Answer: {words}"] if words else ["", *_table(answer, prefixes)]
    return lines


def _table(answer: Expected | None, prefixes: Mapping[str, str]) -> list[str]:
    table = as_table(answer)
    if table is None:
        return []
    if not table.rows:
        return ["No rows."]
    lines = [f"| {' | '.join(table.columns)} |", "|" + " --- |" * len(table.columns)]
    for row in table.rows[:_ROWS]:
        lines.append(f"| {' | '.join(inline(show(term, prefixes)) for term in row)} |")
    if len(table.rows) > _ROWS:
        lines += ["", f"... {len(table.rows)} rows in all"]
    return lines


def inline(text: str) -> str:
    """Text that Markdown takes as it is, in one line."""
    return re.sub(r"([\\`*_\[\]<>|#])", r"\\\1", " ".join(text.split()))


def _block(text: str, language: str) -> list[str]:
    longest = max((len(found) for found in re.findall("`+", text)), default=0)
    fence = "`" * max(3, longest + 1)
    return [fence + language, text, fence]
