"""What a scan found as JUnit XML, which continuous integration servers read."""

from __future__ import annotations

from collections.abc import Sequence
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from symboslam.reasoning.pitfalls.model import Report, Result, Severity, Status
from symboslam.reasoning.pitfalls.report import place, subject


def render(report: Report) -> str:
    """The report as JUnit XML: a suite for each severity, a case for each pitfall.

    A pitfall that was found is a failure, a rule that crashed an error, and what was not looked for
    is skipped. Advisory, accepted and known findings fail nothing and are in the case's output.
    """
    root = Element("testsuites", _counts(report.results), name=f"pitfalls of {report.ontology}")
    for level in Severity:
        results = [result for result in report.results if result.pitfall.severity is level]
        suite = SubElement(root, "testsuite", _counts(results), name=f"{level} pitfalls")
        for result in results:
            _case(suite, result)
    indent(root)
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{tostring(root, encoding="unicode")}\n'


def _case(suite: Element, result: Result) -> None:
    pitfall = result.pitfall
    case = SubElement(
        suite,
        "testcase",
        classname=f"pitfalls.{pitfall.severity}",
        name=f"{pitfall.code}: {pitfall.title}",
    )
    if result.status is Status.ERRORED:
        SubElement(case, "error", message=result.reason, type="errored").text = result.reason
    elif result.status is Status.NOT_CHECKED:
        SubElement(case, "skipped", message=result.reason)
    elif _fails(result):
        first = result.counting[0].place
        case.set("file", first.file)
        if first.line is not None:
            case.set("line", str(first.line))
        number = len(result.counting)
        message = (
            f"{number} finding{'s' if number > 1 else ''}: {result.counting[0].finding.message}"
        )
        told = SubElement(case, "failure", message=message, type=str(pitfall.severity))
        told.text = "\n".join([*_lines(result, True), pitfall.remedy])
    quiet = (
        [*_lines(result, False)]
        if _fails(result)
        else [*_lines(result, True), *_lines(result, False)]
    )
    if quiet:
        SubElement(case, "system-out").text = "\n".join(quiet)


def _lines(result: Result, counting: bool) -> list[str]:
    lines = []
    for o in result.occurrences:
        if o.counts is counting:
            why = "known: " if o.known else "advisory: " if result.pitfall.advisory else ""
            why = why if o.accepted is None else f"accepted ({o.accepted}): "
            lines.append(f"{why}{place(o)}: {subject(o)}: {o.finding.message}")
    return lines


def _fails(result: Result) -> bool:
    return bool(result.counting) and not result.pitfall.advisory


def _counts(results: Sequence[Result]) -> dict[str, str]:
    status = [result.status for result in results]
    return {
        "tests": str(len(status)),
        "failures": str(sum(map(_fails, results))),
        "errors": str(status.count(Status.ERRORED)),
        "skipped": str(status.count(Status.NOT_CHECKED)),
    }
