"""What a scan does around the rules: status, places, imports, acceptances, the time limit."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

import symboslam
from symboslam.errors import ImportsError, InputError, OntologyError
from symboslam.reasoning.pitfalls.model import Finding, NotCheckedError, Report, Settings, Status
from symboslam.reasoning.pitfalls.registry import CODES, choose, rule
from symboslam.reasoning.pitfalls.scan import scan_pitfalls

CYCLE = ":A a owl:Class ; rdfs:subClassOf :B .\n:B a owl:Class ; rdfs:subClassOf :A .\n"
ALIKE = ':A a owl:Class ; rdfs:label "a"@en .\n:B a owl:Class ; rdfs:label "a"@en .\n'


def of(report: Report, code: str) -> Any:
    return next(r for r in report.results if r.pitfall.code == code)


def test_all_codes_are_reported(scan_text: Any) -> None:
    report = scan_text(CYCLE, codes=["P06"])
    assert [r.pitfall.code for r in report.results] == list(CODES)
    assert of(report, "P06").status is Status.CHECKED
    assert {r.reason for r in report.results if r.pitfall.code != "P06"} == {"not selected"}


def test_choose() -> None:
    assert choose((), ()) == list(CODES)
    assert choose(("p6", "P04,11"), ()) == ["P04", "P06", "P11"]
    assert choose(("4", "5"), ("P05",)) == ["P04"]
    for wrong in ("P42", "P00", "", "P-1", "P4²"):
        with pytest.raises(InputError, match="P01 to P41"):
            choose((wrong,), ())


def test_pitfalls_say_what_they_are() -> None:
    for code in CODES:
        pitfall = rule(code).PITFALL
        assert pitfall.code == code
        assert pitfall.title
        assert pitfall.title == pitfall.title.strip(" .")
        for text in (pitfall.description, pitfall.remedy):
            assert text.endswith("."), code
        assert pitfall.affects
        assert set(pitfall.affects) <= {
            "class", "object property", "datatype property", "annotation property", "ontology",
        }  # fmt: skip
        assert all(variant.startswith(f"{code}-") for variant in pitfall.variants)
    severities = [rule(code).PITFALL.severity.value for code in CODES]
    assert [severities.count(s) for s in ("critical", "important", "minor")] == [15, 14, 12]
    advisory = [code for code in CODES if rule(code).PITFALL.advisory]
    assert advisory == ["P01", "P09", "P14", "P15", "P16", "P17", "P18", "P23"]


def test_a_crash_and_a_refusal_are_told(scan_text: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    def crash(*_: object) -> Iterator[Finding]:
        yield Finding(("https://example.org/o#A",), "is found before the crash")
        raise KeyError("A")

    def refuse(*_: object) -> Iterator[Finding]:
        raise NotCheckedError("it rains")
        yield

    monkeypatch.setattr(rule("P06"), "check", crash)
    monkeypatch.setattr(rule("P10"), "check", refuse)
    report = scan_text(CYCLE)
    assert (of(report, "P06").status, of(report, "P06").reason) == (Status.ERRORED, "KeyError: 'A'")
    assert of(report, "P06").occurrences == ()
    assert (of(report, "P10").status, of(report, "P10").reason) == (Status.NOT_CHECKED, "it rains")
    assert of(report, "P11").status is Status.CHECKED


def test_places_and_axioms(scan_text: Any) -> None:
    (one,) = of(scan_text(CYCLE), "P06").occurrences
    assert one.place.line == 10
    assert one.axiom == "every A is a B"
    assert one.iri == "https://example.org/o#A"
    assert all(type(element) is str for element in one.finding.elements)


def test_what_imports_do_is_not_reported(tmp_path: Path) -> None:
    head = (
        "@prefix owl: <http://www.w3.org/2002/07/owl#> .\n"
        "@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n@prefix : <urn:x#> .\n"
    )
    (tmp_path / "b.ttl").write_text(f"{head}<urn:b> a owl:Ontology .\n{CYCLE}")
    a = tmp_path / "a.ttl"
    a.write_text(f"{head}<urn:a> a owl:Ontology ; owl:imports <urn:b> .\n:C rdfs:subClassOf :A .")
    assert not of(scan_pitfalls([a]), "P06").occurrences
    assert of(scan_pitfalls([a], Settings(strict_oops=True)), "P06").occurrences
    assert {o.iri for o in of(scan_pitfalls([a]), "P34").occurrences} == {"urn:x#C"}
    a.write_text(
        f"{head}<urn:a> a owl:Ontology ; owl:imports <urn:b> .\n:A rdfs:subClassOf :C .\n"
        ":C a owl:Class ; rdfs:subClassOf :A ."
    )
    (one,) = of(scan_pitfalls([a]), "P06").occurrences  # ours has a part in it
    assert one.place.file == str(a)
    both = scan_pitfalls([a, tmp_path / "b.ttl"])
    assert len(both.files) == 2
    assert of(both, "P06").occurrences


def test_imports_that_are_not_read(tmp_path: Path) -> None:
    a = tmp_path / "a.ttl"
    a.write_text(
        "@prefix owl: <http://www.w3.org/2002/07/owl#> .\n"
        "<urn:a> a owl:Ontology ; owl:imports <urn:none> ."
    )
    with pytest.raises(ImportsError, match="line 2"):
        scan_pitfalls([a])
    for options in ({"strict_imports": False}, {"follow": False}):
        report = scan_pitfalls([a], **options)  # type: ignore[arg-type]
        assert any("urn:none" in note for note in report.notes)


@pytest.mark.parametrize(
    ("statement", "accepted"),
    [
        (':B sl:acceptedPitfall "P32: twins" .', True),
        (':A sl:acceptedPitfall "P32 : twins"@en .', True),
        ('<https://example.org/o> sl:acceptedPitfall "P32: twins" .', True),
        ("[] a owl:Axiom ; owl:annotatedSource :A ; owl:annotatedProperty rdfs:label ;"
         ' owl:annotatedTarget "a"@en ; sl:acceptedPitfall "P32: twins" .', True),
        ("[] a owl:Axiom ; owl:annotatedSource :A ; owl:annotatedProperty rdfs:label ;"
         ' owl:annotatedTarget "x"@en ; sl:acceptedPitfall "P32: twins" .', False),
        (':C sl:acceptedPitfall "P32: twins" .', False),
        (':A sl:acceptedPitfall "P33: twins" .', False),
        (':A sl:acceptedPitfall "P32" .', False),
        (':A sl:acceptedPitfall "P32:  " .', False),
        (':A sl:acceptedPitfall "twins" .', False),
        (':A sl:acceptedPitfall "P32-X: twins" .', False),
        ("<urn:other> a owl:Ontology . <https://example.org/p> sl:acceptedPitfall"
         ' "P32: twins" .', False),
    ],
)  # fmt: skip
def test_acceptance(scan_text: Any, statement: str, accepted: bool) -> None:
    report = scan_text(ALIKE + statement)
    (one,) = of(report, "P32").occurrences
    assert one.accepted == ("twins" if accepted else None)
    assert one.counts is not accepted
    notes = [note for note in report.notes if "accepts" in note]
    assert len(notes) == (not accepted)  # it is told that an acceptance has no effect, and where
    assert all("line 12" in note for note in notes)


def test_acceptance_of_a_variant(scan_text: Any) -> None:
    body = ":p a owl:ObjectProperty .\n:p sl:acceptedPitfall "
    for text, accepted in (('"P13-N: one way" .', True), ('"P13-S: one way" .', False)):
        (one,) = of(scan_text(body + text), "P13").occurrences
        assert (one.accepted == "one way") is accepted


def test_an_acceptance_of_what_was_not_looked_for_is_no_news(scan_text: Any) -> None:
    report = scan_text(ALIKE + ':A sl:acceptedPitfall "P32: twins" .', codes=["P06"])
    assert report.notes == ()


def test_time_limit(scan_text: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    def slow(*_: object) -> Iterator[Finding]:
        while True:
            try:
                time.sleep(0.05)
            except Exception:  # what some library might do
                pass
        yield

    monkeypatch.setattr(rule("P06"), "check", slow)
    report = scan_text(CYCLE, Settings(seconds=1))
    assert report.out_of_time
    assert of(report, "P05").status is Status.CHECKED
    for code in ("P06", "P07", "P41"):
        assert of(report, code).status is Status.NOT_CHECKED
        assert "time limit of 1 s" in of(report, code).reason


def test_in_a_thread(scan_text: Any) -> None:
    found: list[Report] = []
    thread = threading.Thread(target=lambda: found.append(scan_text(CYCLE)))
    thread.start()
    thread.join()
    assert of(found[0], "P06").occurrences


def test_bundled_modules_by_name() -> None:
    report = symboslam.scan_pitfalls(["https://w3id.org/symboslam/core"])
    assert report.files == ("core.ttl",)
    assert report.ontology == "https://w3id.org/symboslam/core"


def test_no_ontology(tmp_path: Path) -> None:
    path = tmp_path / "data.ttl"
    path.write_text("<urn:a> <urn:b> 1 .")
    with pytest.raises(OntologyError, match="is it an ontology"):
        scan_pitfalls([path])


def test_the_same_twice_and_in_any_order(scan_text: Any) -> None:
    lines = [line for line in (CYCLE + ALIKE).splitlines() if line]
    one, two = (scan_text("\n".join(order)) for order in (lines, reversed(lines)))

    def shape(report: Report) -> list[Any]:
        return [
            (r.pitfall.code, sorted((o.finding.elements, o.finding.message) for o in r.occurrences))
            for r in report.results
        ]

    assert shape(one) == shape(two)
