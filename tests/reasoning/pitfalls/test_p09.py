"""P09: competency questions whose terms the ontology does not know; P01, which nobody checks."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from symboslam.reasoning.pitfalls.model import Result, Settings, Status
from symboslam.reasoning.pitfalls.scan import scan_pitfalls

RESOURCES = Path(__file__).parent / "resources"
MANIFEST = Path(__file__).parents[3] / "competency_questions" / "manifest.ttl"
ADVISORY = ("P01", "P09", "P14", "P15", "P16", "P17", "P18", "P23")


def result(report: Any, code: str) -> Result:
    found: Result = next(r for r in report.results if r.pitfall.code == code)
    return found


def test_without_questions(scan_text: Any) -> None:
    found = result(scan_text(":A a owl:Class .", codes=["P09"]), "P09")
    assert found.status is Status.NOT_CHECKED
    assert found.reason == "give the competency questions: --questions MANIFEST"


def test_messages_name_the_questions(scan_text: Any) -> None:
    settings = Settings(questions=RESOURCES / "questions.ttl")
    found = result(scan_text(":A a owl:Class .", settings, codes=["P09"]), "P09")
    assert [o.finding.message for o in found.occurrences] == [
        "the ontology does not know Room, for which the questions ask: CQ1, CQ2",
        "the ontology does not know partOf, for which the question asks: CQ1",
    ]


def test_expected_answers_and_data_count_too(scan_text: Any, tmp_path: Path) -> None:
    (tmp_path / "data.ttl").write_text(
        "@prefix : <https://example.org/o#> . :hall a :A .", encoding="utf-8"
    )
    manifest = tmp_path / "manifest.ttl"
    manifest.write_text(
        """@prefix owlunit: <https://w3id.org/OWLunit/ontology/> .
        <#q> a owlunit:CompetencyQuestionVerification ; owlunit:hasInputData <data.ttl> ;
            owlunit:hasCompetencyQuestion "What is there?" ; owlunit:hasSPARQLUnitTest
              "PREFIX o: <https://example.org/o#> SELECT ?x WHERE { VALUES ?x { o:hall } }" ;
            owlunit:hasExpectedResult <answer.tsv> .""",
        encoding="utf-8",
    )
    answer = "?x\n<https://example.org/o#hall>\n<https://example.org/o#Attic>\n"
    (tmp_path / "answer.tsv").write_text(answer, encoding="utf-8")
    settings = Settings(questions=manifest)
    found = result(scan_text(":A a owl:Class .", settings, codes=["P09"]), "P09")
    assert [o.iri for o in found.occurrences] == ["https://example.org/o#Attic"]


def test_the_bundled_questions_ask_for_nothing_unknown() -> None:
    found = result(scan_pitfalls([], Settings(questions=MANIFEST), codes=["P09"]), "P09")
    assert found.status is Status.CHECKED
    assert not found.occurrences


@pytest.mark.parametrize("code", ADVISORY)
def test_oops_leaves_them_to_people(scan_text: Any, code: str) -> None:
    settings = Settings(strict_oops=True, questions=MANIFEST)
    found = result(scan_text(":A a owl:Class .", settings, codes=[code]), code)
    assert (found.status, found.reason) == (
        Status.NOT_CHECKED,
        "OOPS! leaves this one to people",
    )
    assert found.pitfall.advisory


def test_several_senses_are_left_to_people(scan_text: Any) -> None:
    found = result(scan_text(":Theatre a owl:Class .", codes=["P01"]), "P01")
    assert found.status is Status.NOT_CHECKED
    assert found.reason.startswith("left to people: ")
