"""Findings of an earlier scan, which are known and fail nothing.

A finding is known if the baseline has one with the same code, variant and elements, wherever in the
file and in whatever words; each of the baseline stands for one. What the ontology accepted then is
no part of the baseline: without the acceptance it counts.
"""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from symboslam.errors import InputError
from symboslam.reasoning.pitfalls.model import Occurrence, Report, Result, Status

Key = tuple[str, str, tuple[str, ...]]
"""Code, variant and sorted elements."""


@dataclass(frozen=True)
class Baseline:
    """What an earlier scan found.

    Attributes:
        path: the report.
        findings: how often each was found.
    """

    path: Path
    findings: Counter[Key]


def read_baseline(path: Path) -> Baseline:
    """The findings in an earlier report, in JSON or SARIF.

    Raises:
        InputError: the file cannot be read, or is no such report.
    """
    try:
        document = json.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise InputError(f"{path}: cannot read the baseline: {error.strerror}") from None
    except (ValueError, RecursionError) as error:
        raise InputError(f"{path}: the baseline is no JSON: {error}") from None
    try:
        findings = Counter(_sarif(document) if "runs" in document else _json(document))
    except (AttributeError, KeyError, TypeError, ValueError):
        raise InputError(
            f"{path}: the baseline is no report of this command: "
            "write one with --format json or --format sarif"
        ) from None
    return Baseline(path, findings)


def _key(code: str, variant: str, elements: Iterable[str]) -> Key:
    elements = tuple(elements)
    if not all(isinstance(text, str) for text in (code, variant, *elements)):
        raise TypeError
    return code, variant, tuple(sorted(map(str, elements)))  # URIRef is not equal to str


def _json(document: dict[str, Any]) -> Iterator[Key]:
    for pitfall in document["pitfalls"]:
        for found in pitfall["affected"]:
            if found["accepted"] is None:
                yield _key(pitfall["code"], found["variant"], found["elements"])


def _sarif(document: dict[str, Any]) -> Iterator[Key]:
    from symboslam.reasoning.pitfalls.report_sarif import TOOL

    for run in document["runs"]:
        if run["tool"]["driver"]["name"] != TOOL:
            raise ValueError
        for found in run["results"]:
            if all(s["kind"] == "external" for s in found["suppressions"]):
                more = found["properties"]
                yield _key(found["ruleId"], more["variant"], more["elements"])


def apply(report: Report, baseline: Baseline) -> Report:
    """The report with what the baseline has marked as known.

    A note says how many findings of the baseline are gone.
    """
    left = baseline.findings.copy()
    results = [_mark(result, left) for result in report.results]
    for result in results:
        left.subtract(_of(result, o) for o in result.occurrences if o.accepted is not None)
    checked = {r.pitfall.code for r in results if r.status is Status.CHECKED}
    gone = sum(max(0, number) for (code, _, _), number in left.items() if code in checked)
    notes = report.notes
    if gone:
        what = "finding of the baseline is" if gone == 1 else "findings of the baseline are"
        notes += (f"{baseline.path}: {gone} {what} no longer found",)
    return replace(report, results=results, notes=notes, compared=True)


def _of(result: Result, o: Occurrence) -> Key:
    return _key(result.pitfall.code, o.finding.variant, o.finding.elements)


def _mark(result: Result, left: Counter[Key]) -> Result:
    def one(o: Occurrence) -> Occurrence:
        key = _of(result, o)
        if o.accepted is not None or left[key] < 1:
            return o
        left[key] -= 1
        return replace(o, known=True)

    return replace(result, occurrences=tuple(map(one, result.occurrences)))
