"""Results as JUnit XML, which continuous integration servers read."""

from __future__ import annotations

import re
from collections.abc import Sequence
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from symboslam.reasoning.questions.model import (
    BROKEN,
    FAILED,
    KNOWN_FAILING,
    SKIPPED,
    Report,
    Result,
)

_NOT_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def render(report: Report) -> str:
    """The report as JUnit XML: a suite for each group, a case for each question.

    What failed is a failure, what is broken an error; what is known to fail or needs the reasoner
    is skipped.
    """
    root = Element("testsuites", _counts(report.results, report.seconds), name=clean(report.title))
    for group, results in report.groups.items():
        seconds = sum(result.seconds for result in results)
        suite = SubElement(root, "testsuite", _counts(results, seconds), name=clean(group))
        for result in results:
            question = result.question
            case = SubElement(
                suite,
                "testcase",
                classname=clean(group),
                name=clean(f"{question.id}: {question.text}"),
                time=f"{result.seconds:.3f}",
                file=clean(str(question.manifest)),
                line=str(question.line),
            )
            first = clean(result.message.partition("\n")[0])
            if result.status in (FAILED, BROKEN):
                kind = "failure" if result.status == FAILED else "error"
                told = SubElement(case, kind, message=first, type=result.status)
                told.text = clean(result.message)
            elif result.status in (KNOWN_FAILING, SKIPPED):
                known = "known failing: " if result.status == KNOWN_FAILING else ""
                SubElement(case, "skipped", message=known + first)
            elif result.message:
                SubElement(case, "system-out").text = clean(result.message)
    indent(root)
    text = tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n{text}\n'


def _counts(results: Sequence[Result], seconds: float) -> dict[str, str]:
    status = [result.status for result in results]
    return {
        "tests": str(len(status)),
        "failures": str(status.count(FAILED)),
        "errors": str(status.count(BROKEN)),
        "skipped": str(status.count(KNOWN_FAILING) + status.count(SKIPPED)),
        "time": f"{seconds:.3f}",
    }


def clean(text: str) -> str:
    """Text without the characters that XML cannot hold."""
    return _NOT_XML.sub("\N{REPLACEMENT CHARACTER}", text)
