"""Each pitfall is found where it is and only there, and nothing unrelated changes that."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from symboslam.reasoning.pitfalls.model import Occurrence, Result, Status
from symboslam.reasoning.pitfalls.registry import CODES

ELSEWHERE = {
    "P01": "left to people, never checked",
    "P09": "needs a manifest: test_p09.py",
    "P37": "needs a server: test_online.py",
    "P38": "needs a file without the head of the cases: test_documents.py",
    "P40": "needs a server: test_online.py",
}
"""Pitfalls whose cases are not in the folder."""

WHOLE = ("P10", "P22")
"""Pitfalls of an ontology as a whole: another class can be what makes the difference."""


def result(report: Any, code: str) -> Result:
    found: Result = next(r for r in report.results if r.pitfall.code == code)
    return found


def test_found(case: Any, scan_text: Any, affected: Callable[[Result], frozenset[Any]]) -> None:
    found = result(scan_text(case.body, case.settings, codes=[case.code]), case.code)
    if found.status is Status.NOT_CHECKED and "WordNet" in found.reason:
        pytest.skip(found.reason)
    assert found.status is Status.CHECKED, found.reason
    assert affected(found) == case.affected
    for occurrence in found.occurrences:
        assert occurrence.place.line is not None
        assert occurrence.place.line >= 9
        assert not occurrence.finding.message.endswith(".")


def test_two_cases_each(all_cases: Callable[[], list[Any]]) -> None:
    ours = [case for case in all_cases() if not case.settings.strict_oops]
    positive = Counter(case.code for case in ours if case.affected)
    negative = Counter(case.code for case in ours if not case.affected)
    here = [code for code in CODES if code not in ELSEWHERE]
    assert {code: positive[code] for code in here if positive[code] < 2} == {}
    assert {code: negative[code] for code in here if negative[code] < 2} == {}


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(at=st.integers(0, 9999), name=st.text("abcdefghijklmnop", min_size=4, max_size=9))
def test_an_unrelated_class_changes_no_other_finding(
    all_cases: Callable[[], list[Any]], scan_text: Any, at: int, name: str
) -> None:
    case, name = all_cases()[at % len(all_cases())], f"Zq{name}"
    new = f"https://example.org/o#{name}"
    unrelated = f'\n<{new}> a owl:Class ; rdfs:label "{name}"@en ; rdfs:comment "One {name}."@en .'
    before = scan_text(case.body, replace(case.settings, online=False))
    after = scan_text(case.body + unrelated, replace(case.settings, online=False))
    for one, two in zip(before.results, after.results, strict=True):
        assert one.status is two.status
        if one.pitfall.code not in WHOLE:
            others = [o for o in two.occurrences if new not in o.finding.elements]
            assert [told(o) for o in others] == [told(o) for o in one.occurrences]


def told(o: Occurrence) -> tuple[Any, ...]:
    """What a reader is told; anonymous nodes have other names each time."""
    return o.finding.elements, o.finding.message, o.finding.mend, o.axiom, o.place
