"""What a scan found as one HTML page that needs nothing else, with filters but no scripts."""

from __future__ import annotations

from collections.abc import Container, Iterable
from html import escape

from symboslam.reasoning.pitfalls.model import Occurrence, Report, Result, Severity, Status
from symboslam.reasoning.pitfalls.report import (
    counts,
    number,
    place,
    shared_mends,
    subject,
    summary,
)

_STYLE = """
:root { color-scheme: light dark; --ink: #1d2733; --soft: #5b6875; --paper: #fbfcfd;
  --card: #fff; --line: #dde3e9; --code: #f2f5f8; --critical: #b3261e; --important: #9a5b00;
  --minor: #2b5fa8; --advisory: #6b4fa0; --good: #1a7f4b }
@media (prefers-color-scheme: dark) { :root { --ink: #e3e8ee; --soft: #9aa7b4; --paper: #12171d;
  --card: #1a2129; --line: #2d3742; --code: #141a21; --critical: #ff7b6b; --important: #e0b341;
  --minor: #7fb2f0; --advisory: #b9a1ec; --good: #4cc38a } }
* { box-sizing: border-box }
body { margin: 0; font: 16px/1.5 system-ui, sans-serif; color: var(--ink);
  background: var(--paper) }
main { max-width: 72rem; margin: 0 auto; padding: 2rem 1rem 4rem }
h1 { font-size: 1.7rem; margin: 0 0 .3rem; overflow-wrap: anywhere }
h2 { font-size: 1.15rem; margin: 2.2rem 0 .6rem }
a { color: inherit }
.soft { color: var(--soft); font-size: .85rem }
.tiles { display: flex; flex-wrap: wrap; gap: .6rem; margin: 1.2rem 0 }
.tile { background: var(--card); border: 1px solid var(--line); border-radius: .4rem;
  padding: .5rem .9rem; min-width: 6.5rem }
.tile b { display: block; font-size: 1.5rem; line-height: 1.2 }
.alarm { border-left: .3rem solid var(--critical); padding: .4rem .8rem; background: var(--card) }
fieldset { border: 0; padding: 0; margin: .3rem 0; display: flex; flex-wrap: wrap; gap: .2rem 1rem;
  font-size: .9rem }
legend { float: left; width: 5rem; color: var(--soft) }
label { white-space: nowrap }
.wide { overflow-x: auto }
table { border-collapse: collapse; font-size: .85rem; width: 100% }
th, td { text-align: left; padding: .3rem .9rem .3rem 0; border-bottom: 1px solid var(--line);
  vertical-align: top; overflow-wrap: anywhere }
th { color: var(--soft); font-weight: 600 }
table + table { margin-top: 1rem }
td:nth-child(1) { min-width: 4rem }
details td:nth-child(1) { width: 18% } details td:nth-child(2) { width: 22% }
details { background: var(--card); border: 1px solid var(--line); border-radius: .4rem;
  margin: .4rem 0 }
summary { cursor: pointer; padding: .55rem .8rem; display: flex; gap: .7rem;
  align-items: baseline; list-style: none }
summary::-webkit-details-marker { display: none }
summary::before { content: "\\25b8"; color: var(--soft) }
details[open] > summary::before { content: "\\25be" }
summary .text { flex: 1 }
summary code { color: var(--soft); font-size: .8rem }
.inside { padding: 0 .8rem .8rem; overflow-x: auto }
.axiom { font: .8rem ui-monospace, monospace; background: var(--code); padding: .1rem .3rem;
  border-radius: .2rem }
.severity { font-size: .75rem; font-weight: 600; min-width: 5.5rem; white-space: nowrap }
.critical .severity, .tile.critical b, .errored .status { color: var(--critical) }
.important .severity, .tile.important b { color: var(--important) }
.minor .severity, .tile.minor b { color: var(--minor) }
.advisory .severity, .tile.advisory b { color: var(--advisory) }
.errored .status { font-weight: 700 }
.clean .status { color: var(--good) }
"""

_KINDS = (*map(str, Severity), "advisory")
_STATES = {
    "found": "found",
    "settled": "accepted or known",
    "clean": "checked, nothing found",
    "not-checked": "not checked",
    "errored": "errored",
}


def render(report: Report) -> str:
    """The report as a page: the counts, filters, all pitfalls in a table, and the findings."""
    kinds = [kind for kind in _KINDS if any(_kind(r) == kind for r in report.results)]
    states = [state for state in _STATES if any(_state(r) == state for r in report.results)]
    hide = "".join(
        f"body:has(#f-{name}:not(:checked)) .row.{name} {{ display: none }}\n"
        for name in (*kinds, *states)
    )
    title = f"Pitfalls of {escape(report.ontology)}"
    parts = [
        "<!DOCTYPE html>",
        '<html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        f"<title>{title}</title><style>{_STYLE}{hide}</style></head><body><main>",
        f"<h1>{title}</h1>",
        f'<p class="soft">{escape(summary(report))}<br>{escape(", ".join(report.files))}</p>',
        *_alarms(report),
        _tiles(report),
        _filter("severity", {kind: kind for kind in kinds}),
        _filter("status", {state: _STATES[state] for state in states}),
    ]
    found = [result for result in report.results if result.occurrences]
    found.sort(key=lambda r: (_KINDS.index(_kind(r)), r.pitfall.code))
    if found:
        parts.append("<section><h2>Findings</h2>")
        parts += map(_pitfall, found)
        parts.append("</section>")
    parts.append('<section><h2>All pitfalls</h2><div class="wide">')
    parts.append(_table(("code", "pitfall", "severity", "status"), map(_row, report.results)))
    parts.append("</div></section>")
    if report.notes:
        notes = "".join(f"<li>{escape(note)}</li>" for note in report.notes)
        parts.append(f"<section><h2>Notes</h2><ul>{notes}</ul></section>")
    parts.append("</main></body></html>")
    return "\n".join(parts) + "\n"


def _kind(result: Result) -> str:
    return "advisory" if result.pitfall.advisory else str(result.pitfall.severity)


def _state(result: Result) -> str:
    if result.status is Status.CHECKED:
        return "found" if result.counting else "settled" if result.occurrences else "clean"
    return "errored" if result.status is Status.ERRORED else "not-checked"


def _classes(result: Result) -> str:
    return f"row {_kind(result)} {_state(result)}"


def _alarms(report: Report) -> Iterable[str]:
    if report.settings.strict_oops:
        yield '<p class="soft">By OOPS!\'s own rules, its defects included.</p>'
    if report.out_of_time:
        yield '<p class="alarm">The time limit was reached: not everything was checked.</p>'
    for result in report.results:
        if result.status is Status.ERRORED:
            what = f"{result.pitfall.code} was not checked: {result.reason}"
            yield f'<p class="alarm">{escape(what)}</p>'


def _tiles(report: Report) -> str:
    tiles = "".join(
        f'<div class="tile {name}"><b>{many}</b>{name}</div>'
        for name, many in counts(report).items()
        if many or name in tuple(Severity)
    )
    return f'<div class="tiles">{tiles}</div>'


def _filter(legend: str, names: dict[str, str]) -> str:
    boxes = "".join(
        f'<label><input type="checkbox" id="f-{name}" checked> {escape(text)}</label>'
        for name, text in names.items()
    )
    return f"<fieldset><legend>{legend}</legend>{boxes}</fieldset>"


def _table(head: Iterable[str], rows: Iterable[str]) -> str:
    cells = "".join(f"<th>{name}</th>" for name in head)
    return f"<table><tr>{cells}</tr>{''.join(rows)}</table>"


def _row(result: Result) -> str:
    pitfall = result.pitfall
    status = _STATES[_state(result)]
    if result.occurrences:
        status = f"{len(result.counting)} {status}" if result.counting else status
    elif result.reason:
        status += f": {result.reason}"
    title = escape(pitfall.title)
    if result.occurrences:
        title = f'<a href="#{pitfall.code}">{title}</a>'
    return (
        f'<tr class="{_classes(result)}"><td>{pitfall.code}</td><td>{title}</td>'
        f'<td class="severity">{_severity(result)}</td>'
        f'<td class="status">{escape(status)}</td></tr>'
    )


def _severity(result: Result) -> str:
    return f"{result.pitfall.severity}{' (advisory)' if result.pitfall.advisory else ''}"


def _pitfall(result: Result) -> str:
    pitfall, counting = result.pitfall, result.counting
    rest = [o for o in result.occurrences if not o.counts]
    parts = [
        f'<details class="{_classes(result)}" id="{pitfall.code}"{" open" if counting else ""}>',
        f'<summary><span class="severity">{_severity(result)}</span>',
        f'<span class="text">{escape(pitfall.title)}</span>',
        f'<span class="soft">{number(result)}</span><code>{pitfall.code}</code></summary>',
        f'<div class="inside"><p>{escape(pitfall.description)}</p>',
        f"<p><b>Mend:</b> {escape(pitfall.remedy)}</p>",
    ]
    shared = shared_mends(result)
    for mend, variants in shared.items():
        parts.append(f"<p><b>{f'Mend {variants}'.rstrip()}:</b> {escape(mend)}</p>")
    if counting:
        rows = (_finding(o, _what(o, shared)) for o in counting)
        parts.append(_table(("element", "place", "what"), rows))
    if rest:
        rows = (_finding(o, escape(_why(o))) for o in rest)
        parts.append(_table(("element", "place", "accepted or known, because"), rows))
    parts.append("</div></details>")
    return "".join(parts)


def _finding(o: Occurrence, last: str) -> str:
    full = escape(", ".join(o.finding.elements or (o.iri,)))
    return (
        f'<tr><td title="{full}">{escape(subject(o))}</td><td>{escape(place(o))}</td>'
        f"<td>{last}</td></tr>"
    )


def _what(o: Occurrence, shared: Container[str]) -> str:
    parts = [escape(o.finding.message)]
    if o.finding.variant:
        parts.append(f'<span class="soft">{escape(o.finding.variant)}</span>')
    if o.axiom:
        parts.append(f'<span class="axiom">{escape(o.axiom)}</span>')
    if o.finding.mend and o.finding.mend not in shared:
        parts.append(f"<b>Mend:</b> {escape(o.finding.mend)}")
    return "<br>".join(parts)


def _why(o: Occurrence) -> str:
    return "in the baseline" if o.accepted is None else f"accepted: {o.accepted}"
