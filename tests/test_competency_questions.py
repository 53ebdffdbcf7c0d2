"""The competency questions are complete and well-formed, and the ontology answers all of them."""

from __future__ import annotations

import contextlib
import importlib.util
import re
import sys
from collections import Counter
from functools import cache
from pathlib import Path
from types import ModuleType

import pytest
from pyoxigraph import Literal, NamedNode

import symboslam
from symboslam.reasoning.hermit import Hermit
from symboslam.reasoning.questions import model
from symboslam.reasoning.questions.dataset import Datasets
from symboslam.reasoning.questions.manifest import default_manifest, load_manifest
from symboslam.reasoning.questions.model import InlineData, Question, Result, Table
from symboslam.reasoning.questions.run import run, with_files
from symboslam.reasoning.sources import CLOSURE

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "competency_questions"
PARTS = ("environment", "maps", "slam", "swarm", "inference", "errors")
QUESTIONS = load_manifest(FOLDER / "manifest.ttl")
BY_ID = {question.id: question for question in QUESTIONS}
PROVOCATIONS = [question for question in QUESTIONS if question.kind == model.PROVOCATION]
SL = "https://w3id.org/symboslam#"


def part_of(question: Question) -> str:
    return question.manifest.resolve().parent.name


# What they are


def test_there_are_enough() -> None:
    kinds = Counter(question.kind for question in QUESTIONS)
    assert len(QUESTIONS) >= 80
    assert kinds[model.INFERENCE] >= 10
    assert kinds[model.PROVOCATION] >= 10
    assert sum(part_of(question) == "environment" for question in QUESTIONS) >= 36


def test_every_part_is_asked() -> None:
    assert tuple(dict.fromkeys(map(part_of, QUESTIONS))) == PARTS
    folders = {manifest.parent.name for manifest in FOLDER.glob("*/manifest.ttl")}
    assert folders == set(PARTS)


def test_the_package_has_the_same_manifest() -> None:
    assert default_manifest().resolve() == (FOLDER / "manifest.ttl").resolve()


def test_questions_are_short_questions_asked_once() -> None:
    texts = [question.text for question in QUESTIONS]
    assert [t for t in texts if not (t.endswith("?") and t[0].isupper())] == []
    assert [t for t in texts if len(t) > 125] == []
    assert [t for t, n in Counter(texts).items() if n > 1] == []


def test_every_question_belongs_to_a_group_and_has_an_answer() -> None:
    assert [q.id for q in QUESTIONS if not q.group] == []
    assert [q.id for q in QUESTIONS if q.query is not None and q.expected is None] == []


@pytest.mark.parametrize("part", PARTS)
def test_no_file_is_left_over(part: str) -> None:
    named = set(re.findall(r"<([\w./-]+)>", (FOLDER / part / "manifest.ttl").read_text("utf-8")))
    files = {file.name for file in (FOLDER / part).iterdir()} - {"manifest.ttl"}
    assert files
    assert files - named == set()


def test_a_query_begins_with_its_question() -> None:
    files = [q for q in QUESTIONS if q.query is not None and not q.query.inline]
    assert len(files) > 100
    wrong = [q.id for q in files if q.query and q.query.text.splitlines()[0] != f"# {q.text}"]
    assert wrong == []


def test_answers_are_short() -> None:
    tables = {q.id: len(q.expected.rows) for q in QUESTIONS if isinstance(q.expected, Table)}
    assert {name: rows for name, rows in tables.items() if rows > 35} == {}


def test_an_error_file_ends_with_the_triple_that_it_names() -> None:
    assert PROVOCATIONS
    for question in PROVOCATIONS:
        lines = data_of(question).splitlines()
        assert lines[0] == f"# {question.text}", question.id
        assert f"# Bad triple: {lines[-1]}" in lines, question.id


def test_the_requirements_page_is_fresh() -> None:
    page = (FOLDER / "requirements.md").read_text(encoding="utf-8")
    assert glossary().rewrite(page, QUESTIONS) == page, "run scripts/glossary.py"


def test_the_glossary_counts_words_and_answers() -> None:
    script = glossary()
    order = sorted({"bus", "bus stop", "body", "share"} - script.EVERYDAY, key=lambda w: -len(w))
    pattern = script.make_pattern(order)
    assert script.words_of("Which bus stops share bodies?", order, pattern) == {"bus stop", "body"}
    assert script.words_of("Busy buses", order, pattern) == {"bus"}
    assert set(script.iris_of(BY_ID["env-01"])) == {SL + "Residential"}


# What the ontology answers


def data_of(question: Question) -> str:
    (file,) = question.data
    assert isinstance(file, Path)
    return file.read_text(encoding="utf-8")


def without_bad_triple(question: Question) -> Question:
    """The same data less their last line, to be consistent."""
    (file,) = question.data
    assert isinstance(file, Path)
    good = data_of(question).rstrip().rpartition("\n")[0]
    return Question(
        id=f"{question.id} mended",
        text="Are the data without the bad triple consistent?",
        kind=model.INFERENCE,
        data=(InlineData(good, file, 1),),
        ontologies=question.ontologies,
    )


@cache
def results(reasoning: bool) -> dict[str, Result]:
    """The questions that need a reasoner, or the others, in one run: nothing is loaded twice."""
    asked = [question for question in QUESTIONS if question.needs_reasoner == reasoning]
    report = run(asked, reasoning=reasoning)
    return {result.question.id: result for result in report.results}


@pytest.mark.parametrize(
    "name",
    [pytest.param(q.id, marks=[pytest.mark.proof] if q.needs_reasoner else []) for q in QUESTIONS],
)
def test_the_ontology_answers(name: str) -> None:
    result = results(BY_ID[name].needs_reasoner)[name]
    assert result.status == model.PASSED, result.message


@cache
def mended() -> dict[str, bool]:
    """Whether the provocations without their bad triples are consistent, by one start of Java."""
    questions = [without_bad_triple(question) for question in PROVOCATIONS]
    with contextlib.closing(Datasets(Hermit())) as datasets:
        clashing = Hermit().all_clashes([datasets.logic(q).module() for q in questions])
    return {q.id: not clash for q, clash in zip(PROVOCATIONS, clashing, strict=True)}


@pytest.mark.proof
@pytest.mark.parametrize("name", [question.id for question in PROVOCATIONS])
def test_only_the_named_triple_is_refused(name: str) -> None:
    assert mended()[name]


# The same answers from the table that the engine uses, without SPARQL


@pytest.fixture(scope="module")
def points() -> dict[str, dict[str, float]]:
    """Class of the detector -> environment -> strength of a direct link, 0 for a longer way."""
    knowledge = symboslam.Knowledge.load()
    detector = {f.name for f in knowledge.features if f.detector_label}
    found: dict[str, dict[str, float]] = {name: {} for name in detector}
    for way in knowledge.indications:
        if way.feature in detector:
            found[way.feature][way.environment] = 0 if way.steps else way.strength
    return found


def rows(question: str) -> list[tuple[str, ...]]:
    """The rows of an expected answer as text, with local names."""
    table = BY_ID[question].expected
    assert isinstance(table, Table)
    return [
        tuple(t.value.removeprefix(SL) for t in row if isinstance(t, NamedNode | Literal))
        for row in table.rows
    ]


@pytest.mark.parametrize(
    ("question", "both", "not_this"),
    [
        ("env-18", {"Commercial"}, "Industrial"),
        ("env-19", {"Industrial"}, "Commercial"),
        ("env-20", {"Commercial", "Industrial"}, ""),
        ("env-21", {"Residential", "CommunityFacility"}, ""),
        ("env-23", {"ParksAndRecreation", "NonUrban"}, ""),
    ],
)
def test_the_engine_tells_types_apart_alike(
    points: dict[str, dict[str, float]], question: str, both: set[str], not_this: str
) -> None:
    expected = sorted(f for f, e in points.items() if both <= set(e) and not_this not in e)
    if question == "env-20":  # strengths are compared, so by direct links only
        expected = [f for f in expected if all(points[f][e] for e in both)]
    assert sorted(row[0] for row in rows(question)) == expected


def test_the_engine_counts_alike(points: dict[str, dict[str, float]]) -> None:
    counted = Counter(e for environments in points.values() for e in environments)
    told = {kind.removesuffix("Feature"): int(number) for kind, number in rows("inf-08")}
    assert told == counted


def test_the_engine_knows_the_same_things_that_stay() -> None:
    features = [f for f in symboslam.Knowledge.load().features if f.detector_label]
    static = sum(f.static for f in features)
    told = {kind: int(number) for kind, number in rows("env-29")}
    assert told == {"StaticFeature": static, "DynamicFeature": len(features) - static}


def test_the_engine_has_the_same_strengths(points: dict[str, dict[str, float]]) -> None:
    """env-26 asks for the strongest direct link to each type."""
    types = {environment for found in points.values() for environment in found}
    best = {e: max(found.get(e, 0) for found in points.values()) for e in types}
    assert {e: float(strength) for e, strength in rows("env-26")} == pytest.approx(best)


@cache
def glossary() -> ModuleType:
    spec = importlib.util.spec_from_file_location(
        "glossary_script", ROOT / "scripts" / "glossary.py"
    )
    assert spec
    assert spec.loader
    module = sys.modules[spec.name] = importlib.util.module_from_spec(spec)  # for dataclasses
    spec.loader.exec_module(module)
    return module


def test_the_answers_hold_for_all_modules_together() -> None:
    """Each part names the modules that it is about; what others add must not change an answer."""
    whole = with_files(QUESTIONS, ontologies=[CLOSURE])
    report = run(whole, reasoning=False)
    asked = [result for result in report.results if result.status != model.SKIPPED]
    assert len(asked) >= 150
    assert [(r.question.id, r.message) for r in asked if r.status != model.PASSED] == []
