"""Results as one HTML page that needs nothing else: groups, questions, queries and answers."""

from __future__ import annotations

from collections.abc import Mapping
from html import escape

from pyoxigraph import NamedNode

from symboslam.reasoning.questions.compare import show
from symboslam.reasoning.questions.model import (
    PASSED,
    STATUSES,
    Expected,
    Report,
    Result,
    Term,
)
from symboslam.reasoning.questions.query import prefixes_of
from symboslam.reasoning.questions.report import as_table, in_words, summary
from symboslam.reasoning.vocabulary import local_name

_ROWS = 200  # of an answer
_STYLE = """
:root { color-scheme: light dark; --ink: #1d2733; --soft: #5b6875; --paper: #fbfcfd;
  --card: #fff; --line: #dde3e9; --code: #f2f5f8; --passed: #1a7f4b; --failed: #c0392b;
  --known: #9a6700; --skipped: #5b6875; }
@media (prefers-color-scheme: dark) { :root { --ink: #e3e8ee; --soft: #9aa7b4; --paper: #12171d;
  --card: #1a2129; --line: #2d3742; --code: #141a21; --passed: #4cc38a; --failed: #ff7b6b;
  --known: #e0b341; --skipped: #9aa7b4; } }
* { box-sizing: border-box }
body { margin: 0; font: 16px/1.5 system-ui, sans-serif; color: var(--ink);
  background: var(--paper) }
main { max-width: 60rem; margin: 0 auto; padding: 2rem 1rem 4rem }
h1 { font-size: 1.7rem; margin: 0 0 .3rem }
h2 { font-size: 1.15rem; margin: 2.2rem 0 .6rem }
h2 small, .soft { color: var(--soft); font-weight: 400; font-size: .85rem }
.bar { display: flex; height: .5rem; border-radius: .25rem; overflow: hidden; margin: 1rem 0 }
details { background: var(--card); border: 1px solid var(--line); border-radius: .4rem;
  margin: .4rem 0 }
summary { cursor: pointer; padding: .55rem .8rem; display: flex; gap: .7rem;
  align-items: baseline; list-style: none }
summary::-webkit-details-marker { display: none }
summary .text { flex: 1 }
summary code { color: var(--soft); font-size: .8rem }
.inside { padding: 0 .8rem .8rem; overflow-x: auto }
.status { font-size: .75rem; font-weight: 600; min-width: 6.5rem }
.passed { color: var(--passed) } .failed, .broken { color: var(--failed) }
.known { color: var(--known) } .skipped { color: var(--skipped) }
.b-passed { background: var(--passed) } .b-failed, .b-broken { background: var(--failed) }
.b-known { background: var(--known) } .b-skipped { background: var(--skipped) }
pre { background: var(--code); padding: .7rem; border-radius: .3rem; overflow-x: auto;
  font-size: .82rem; margin: .5rem 0 }
table { border-collapse: collapse; font-size: .85rem }
th, td { text-align: left; padding: .25rem .9rem .25rem 0; border-bottom: 1px solid var(--line);
  vertical-align: top }
"""


def render(report: Report) -> str:
    """The report as a page."""
    total = max(1, len(report.results))
    bar = "".join(
        f'<i class="b-{_class(status)}" style="width:{100 * report.counts[status] / total:.2f}%">'
        "</i>"
        for status in STATUSES
        if report.counts[status]
    )
    parts = [
        "<!DOCTYPE html>",
        '<html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>{escape(report.title)}</title><style>{_STYLE}</style></head><body><main>",
        f"<h1>{escape(report.title)}</h1>",
        f'<p class="soft">{escape(summary(report))} in {report.seconds:.1f} s</p>',
        f'<div class="bar" role="img" aria-label="{escape(summary(report))}">{bar}</div>',
    ]
    for group, results in report.groups.items():
        passed = sum(result.status == PASSED for result in results)
        parts.append(
            f"<section><h2>{escape(group)} <small>{passed} of {len(results)} passed</small></h2>"
        )
        parts += (_question(result) for result in results)
        parts.append("</section>")
    parts.append("</main></body></html>")
    return "\n".join(parts) + "\n"


def _class(status: str) -> str:
    return status.split()[0]


def _question(result: Result) -> str:
    question = result.question
    parts = [
        f'<details id="{escape(question.id)}"{" open" if result.bad else ""}><summary>',
        f'<span class="status {_class(result.status)}">{escape(result.status)}</span>',
        f'<span class="text">{escape(question.text)}</span>',
        f'<code>{escape(question.id)}</code></summary><div class="inside">',
    ]
    if result.message:
        parts.append(f"<pre>{escape(result.message)}</pre>")
    facts = [question.kind, f"entailment: {local_name(question.regime)}"]
    facts += (f"ontology: {local_name(str(o))}" for o in question.ontologies)
    parts.append(f'<p class="soft">{escape("; ".join(facts))}</p>')
    if question.query is not None:
        parts.append(f"<pre>{escape(question.query.text.strip())}</pre>")
        prefixes = prefixes_of(question.query)
        parts.append(_answer("answer", result.answer, prefixes))
        if result.status != PASSED:
            parts.append(_answer("expected", question.expected, prefixes))
    parts.append("</div></details>")
    return "".join(parts)


def _answer(title: str, answer: Expected | None, prefixes: Mapping[str, str]) -> str:
    if answer is None:
        return ""
    table = as_table(answer)
    if table is None:
        return f'<p><span class="soft">{title}:</span> {escape(in_words(answer))}</p>'
    if not table.rows:
        return f'<p><span class="soft">{title}:</span> no rows</p>'
    head = "".join(f"<th>{escape(name)}</th>" for name in table.columns)
    body = "".join(
        "<tr>" + "".join(_cell(term, prefixes) for term in row) + "</tr>"
        for row in table.rows[:_ROWS]
    )
    more = len(table.rows) - _ROWS
    rest = f'<p class="soft">and {more} more rows</p>' if more > 0 else ""
    return f'<p class="soft">{title}</p><table><tr>{head}</tr>{body}</table>{rest}'


def _cell(term: Term | None, prefixes: Mapping[str, str]) -> str:
    full = f' title="{escape(term.value)}"' if isinstance(term, NamedNode) else ""
    return f"<td{full}>{escape(show(term, prefixes))}</td>"
