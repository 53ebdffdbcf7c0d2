"""What an earlier report has is known, wherever it has moved and however it is worded."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from rdflib import URIRef

from symboslam.errors import InputError
from symboslam.reasoning.pitfalls.baseline import apply, read_baseline
from symboslam.reasoning.pitfalls.model import (
    Finding,
    Occurrence,
    Pitfall,
    Report,
    Result,
    Settings,
    Severity,
    Status,
)
from symboslam.reasoning.pitfalls.report import render
from symboslam.reasoning.sources import Place

EX = "https://example.org/o#"
CYCLE = Pitfall("P06", "Cycles", Severity.CRITICAL, ("class",), ("N2",), "Bad.", "Mend it.")
NAMES = Pitfall("P22", "Names", Severity.MINOR, ("ontology",), ("N6",), "Bad.", "Mend it.")


def found(*names: str, line: int = 1, message: str = "wrong", **more: Any) -> Occurrence:
    variant = more.pop("variant", "")
    elements = tuple(URIRef(EX + name) for name in names)
    return Occurrence(Finding(elements, message, variant=variant), EX, Place("o.ttl", line), **more)


def report_of(*occurrences: Occurrence, pitfall: Pitfall = CYCLE) -> Report:
    results = (Result(pitfall, Status.CHECKED, "", occurrences),)
    return Report("https://example.org/o", ("o.ttl",), results, Settings())


def known(report: Report) -> list[bool]:
    return [o.known for result in report.results for o in result.occurrences]


@pytest.fixture(params=["json", "sarif"])
def against(request: pytest.FixtureRequest, tmp_path: Path) -> Any:
    """Compare a report with an earlier one, which is written and read in between."""

    def call(before: Report, now: Report) -> Report:
        path = tmp_path / f"baseline.{request.param}"
        path.write_text(render(before, request.param), encoding="utf-8")
        return apply(now, read_baseline(path))

    return call


def test_known_in_another_place_and_in_other_words(against: Any) -> None:
    now = report_of(found("B", "A", line=9, message="other words"), found("C"))
    compared = against(report_of(found("A", "B"), found("X")), now)
    assert known(compared) == [True, False]
    assert [o.finding.elements for o in compared.results[0].counting] == [(URIRef(EX + "C"),)]
    assert [note.partition(": ")[2] for note in compared.notes] == [
        "1 finding of the baseline is no longer found"
    ]


def test_a_report_against_itself_has_nothing_new(against: Any) -> None:
    report = report_of(found("A"), found("A"), found("B", variant="P06-X"), found())
    compared = against(report, report)
    assert known(compared) == [True] * 4
    assert not list(compared.failing(Severity.MINOR))
    assert compared.notes == ()
    again = against(compared, report)  # what was known stays so
    assert known(again) == [True] * 4


def test_elements_as_plain_text(against: Any) -> None:
    plain = Occurrence(Finding((EX + "A", EX + "B"), "wrong"), EX, Place("o.ttl", 1))
    assert known(against(report_of(plain), report_of(found("A", "B")))) == [True]
    assert known(against(report_of(found("A", "B")), report_of(plain))) == [True]


def test_each_of_the_baseline_stands_for_one(against: Any) -> None:
    assert known(against(report_of(found("A")), report_of(found("A"), found("A")))) == [True, False]


def test_other_code_variant_or_elements_are_new(against: Any) -> None:
    before = report_of(found("A", variant="P06-X"))
    assert known(against(before, report_of(found("A")))) == [False]
    assert known(against(before, report_of(found("A", "B", variant="P06-X")))) == [False]
    other = report_of(found("A", variant="P06-X"), pitfall=NAMES)
    assert known(against(before, other)) == [False]


def test_the_ontology_as_a_whole(against: Any) -> None:
    before = report_of(found(), pitfall=NAMES)
    assert known(against(before, report_of(found(line=5), pitfall=NAMES))) == [True]


def test_accepted_then_counts_without_the_acceptance(against: Any) -> None:
    before = report_of(found("A", accepted="for now"))
    assert known(against(before, report_of(found("A")))) == [False]


def test_accepted_now_is_not_known_and_not_gone(against: Any) -> None:
    compared = against(report_of(found("A")), report_of(found("A", accepted="for now")))
    assert known(compared) == [False]
    assert compared.notes == ()


def test_what_is_not_checked_now_is_not_gone(against: Any) -> None:
    skipped = Result(CYCLE, Status.NOT_CHECKED, "not selected")
    now = replace(report_of(), results=[skipped])
    assert against(report_of(found("A")), now).notes == ()


def test_errors_of_the_baseline_do_not_matter(against: Any) -> None:
    before = replace(report_of(), results=[Result(CYCLE, Status.ERRORED, "KeyError: 1")])
    assert known(against(before, report_of(found("A")))) == [False]


def test_missing_file(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"none\.json: cannot read the baseline: No such file"):
        read_baseline(tmp_path / "none.json")
    with pytest.raises(InputError, match="Is a directory"):
        read_baseline(tmp_path)


@pytest.mark.parametrize("data", [b"", b"{", b"\xff\xfe", b"P06\n", b"[" * 100_000])
def test_no_json(tmp_path: Path, data: bytes) -> None:
    path = tmp_path / "base.json"
    path.write_bytes(data)
    with pytest.raises(InputError, match=r"base\.json: the baseline is no JSON"):
        read_baseline(path)


ROW = {"variant": "", "elements": [EX + "A"], "accepted": None}


@pytest.mark.parametrize(
    "document",
    [
        [],
        3,
        None,
        {},
        {"pitfalls": {}, "other": 1, "runs": 3},
        {"pitfalls": 3},
        {"pitfalls": [3]},
        {"pitfalls": [{"code": "P06"}]},
        {"pitfalls": [{"code": "P06", "affected": [{}]}]},
        {"pitfalls": [{"code": 6, "affected": [ROW]}]},
        {"pitfalls": [{"code": "P06", "affected": [{**ROW, "elements": [1]}]}]},
        {"pitfalls": [{"code": "P06", "affected": [{**ROW, "elements": None}]}]},
        {"runs": [{}]},
        {"runs": [{"tool": {"driver": {"name": "another"}}, "results": []}]},
        {"runs": [{"tool": {"driver": {"name": "SymboSLAM pitfalls"}}, "results": [{}]}]},
    ],
)
def test_no_such_report(tmp_path: Path, document: Any) -> None:
    path = tmp_path / "base.json"
    path.write_text(json.dumps(document), encoding="utf-8")
    with pytest.raises(InputError, match=r"base\.json: the baseline is no report of this command"):
        read_baseline(path)


def test_byte_order_mark(tmp_path: Path) -> None:
    path = tmp_path / "base.json"
    path.write_text(render(report_of(found("A")), "json"), encoding="utf-8-sig")
    assert sum(read_baseline(path).findings.values()) == 1


def test_a_scan_against_its_own_report(scan_text: Any, tmp_path: Path) -> None:
    text = ":isA a owl:ObjectProperty . :is_a a owl:ObjectProperty ."
    before = scan_text(text, codes=["P03"])
    path = tmp_path / "base.json"
    path.write_text(render(before, "json"), encoding="utf-8")
    moved = scan_text("\n\n" + text, codes=["P03"])
    assert known(apply(moved, read_baseline(path))) == [True, True]
