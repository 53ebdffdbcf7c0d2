"""What a scan found as Markdown: all pitfalls in a table, then each that was found.

It holds no date and no version, so that it changes only where the ontology or the rules do.
"""

from __future__ import annotations

from collections.abc import Container, Iterator

from symboslam.reasoning.pitfalls.model import Occurrence, Report, Result, Status
from symboslam.reasoning.pitfalls.report import (
    most_severe_first,
    number,
    place,
    severity,
    shared_mends,
    subject,
    summary,
)
from symboslam.reasoning.questions.report_md import inline


def render(report: Report) -> str:
    """The report as Markdown."""
    lines = [f"# Pitfalls of {inline(report.ontology)}", "", f"{summary(report)}.", ""]
    lines.append(f"Files: {', '.join(map(inline, report.files))}")
    if report.settings.strict_oops:
        lines += ["", "By OOPS!'s own rules, its defects included."]
    if report.out_of_time:
        lines += ["", "**The time limit was reached: not everything was checked.**"]
    lines += ["", *_overview(report)]
    if report.notes:
        lines += ["", "## Notes", "", *(f"- {inline(note)}" for note in report.notes)]
    for result in most_severe_first(report):
        lines += ["", *_pitfall(result)]
    return "\n".join(lines) + "\n"


def _row(*cells: str) -> str:
    return f"| {' | '.join(cells)} |"


def _overview(report: Report) -> Iterator[str]:
    yield _row("code", "pitfall", "severity", "status", "findings")
    yield _row("---", "---", "---", "---", "---:")
    for result in report.results:
        status = str(result.status)
        if result.status is not Status.CHECKED:
            bold = "**" if result.status is Status.ERRORED else ""
            status = f"{bold}{status}{bold}: {inline(result.reason)}"
        checked = result.status is Status.CHECKED
        yield _row(
            result.pitfall.code,
            inline(result.pitfall.title),
            severity(result),
            status,
            number(result) if checked else "",
        )


def _pitfall(result: Result) -> Iterator[str]:
    pitfall = result.pitfall
    yield f"## {pitfall.code}: {inline(pitfall.title)}"
    yield ""
    yield f"{severity(result).capitalize()}. {inline(pitfall.description)}"
    yield ""
    yield f"Mend: {inline(pitfall.remedy)}"
    shared = shared_mends(result)
    for mend, variants in shared.items():
        yield ""
        yield f"{f'Mend {variants}'.rstrip()}: {inline(mend)}"
    if result.counting:
        yield ""
        yield _row("element", "place", "what")
        yield _row("---", "---", "---")
        for o in result.counting:
            yield _row(inline(subject(o)), inline(place(o)), _what(o, shared))
    rest = [o for o in result.occurrences if not o.counts]
    if rest:
        yield ""
        yield _row("element", "place", "accepted or known, because")
        yield _row("---", "---", "---")
        for o in rest:
            why = "in the baseline" if o.accepted is None else o.accepted
            yield _row(inline(subject(o)), inline(place(o)), inline(why))


def _what(o: Occurrence, shared: Container[str]) -> str:
    parts = [inline(o.finding.message)]
    if o.finding.variant:
        parts.append(o.finding.variant)
    if o.axiom:
        parts.append(f"axiom: {inline(o.axiom)}")
    if o.finding.mend and o.finding.mend not in shared:
        parts.append(f"mend: {inline(o.finding.mend)}")
    return "<br>".join(parts)
