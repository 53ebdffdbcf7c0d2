"""What a scan found as text: by pitfall, then what was not looked for, then the counts."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator

from symboslam.reasoning.pitfalls.model import NOT_SELECTED, Occurrence, Report, Result, Status
from symboslam.reasoning.pitfalls.report import (
    most_severe_first,
    place,
    severity,
    shared_mends,
    subject,
    summary,
)

_CONTROL = re.compile("[\x00-\x1f\x7f-\x9f]")  # what a terminal obeys


def render(report: Report) -> str:
    """The report as text."""
    lines = [f"{report.ontology} ({', '.join(report.files)})"]
    for result in most_severe_first(report):
        lines += ["", *_pitfall(result)]
    lines += ["", *_unchecked(report)]
    lines += (f"note: {note}" for note in report.notes)
    lines.append(summary(report))
    return "\n".join(map(_line, lines)) + "\n"


def _line(text: str) -> str:
    """Text in one line, indented as before, with nothing that a terminal would obey."""
    words = " ".join(text.split())
    indent = len(text) - len(text.lstrip(" "))
    return " " * indent + _CONTROL.sub("\N{REPLACEMENT CHARACTER}", words)


def _pitfall(result: Result) -> Iterator[str]:
    pitfall = result.pitfall
    yield f"{pitfall.code} {pitfall.title} ({severity(result)})"
    shared = shared_mends(result)
    for o in result.counting:
        yield from _occurrence(o, o.finding.mend not in shared)
    for mend, variants in shared.items():
        yield f"  {f'Mend {variants}'.rstrip()}: {mend}"
    if any(not o.finding.mend for o in result.counting):
        yield f"  Mend: {pitfall.remedy}"
    accepted = Counter(o.accepted for o in result.occurrences if o.accepted is not None)
    for reason, number in accepted.items():
        yield f"  {number} accepted: {reason}"
    if known := sum(o.known and o.accepted is None for o in result.occurrences):
        yield f"  {known} known, in the baseline"


def _occurrence(o: Occurrence, with_mend: bool) -> Iterator[str]:
    variant = f" [{o.finding.variant}]" if o.finding.variant else ""
    yield f"  {place(o)}: {subject(o)}: {o.finding.message}{variant}"
    if o.axiom:
        yield f"      axiom: {o.axiom}"
    if o.finding.mend and with_mend:
        yield f"      mend: {o.finding.mend}"


def _unchecked(report: Report) -> Iterator[str]:
    """Pitfalls that were not looked for, those with the same reason in one line."""
    reasons: dict[str, list[str]] = {}
    for result in report.results:
        if result.status is Status.ERRORED:
            yield (
                f"ERRORED: {result.pitfall.code} {result.pitfall.title} "
                f"({severity(result)}) was NOT checked: {result.reason}"
            )
        elif result.status is Status.NOT_CHECKED:
            reasons.setdefault(result.reason, []).append(result.pitfall.code)
    for reason, codes in reasons.items():
        which = f"{len(codes)} others" if reason == NOT_SELECTED else ", ".join(codes)
        yield f"not checked: {which}: {reason}"
    if report.out_of_time:
        yield "OUT OF TIME: not everything was checked"
