"""Keywords of Robot Framework, called as Robot Framework calls them."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace

import pytest

from symboslam.errors import UnknownNameError
from symboslam.reasoning.questions.keywords import Keywords, Skipped


@pytest.fixture
def library(farm: Path) -> Iterator[Keywords]:
    keywords = Keywords(str(farm / "manifest.ttl"), reasoner="no")
    yield keywords
    keywords.end_suite(None, None)


def test_every_keyword_has_words_and_a_description() -> None:
    found = {
        method.robot_name: method
        for _, method in inspect.getmembers(Keywords, inspect.isfunction)
        if hasattr(method, "robot_name")
    }
    assert len(found) > 12
    for name, method in found.items():
        assert method.__doc__, name
        given = list(inspect.signature(method).parameters)[1:]
        embedded = [part.split("}")[0] for part in name.split("${")[1:]]
        assert given[: len(embedded)] == embedded, name
    assert all(hasattr(Skipped, name) for name in ("ROBOT_SKIP_EXECUTION", "ROBOT_SUPPRESS_NAME"))


def test_questions(library: Keywords) -> None:
    assert library.ask_question("heavy") == "passed"
    library.the_answer_should_be_as_expected()
    library.the_answer_should_have_rows("3")
    library.the_answer_should_mention(":dolly", "80")
    with pytest.raises(AssertionError, match="the answer has 3 rows"):
        library.the_answer_should_have_rows("4")
    with pytest.raises(AssertionError, match=r"no row mentions :bella, 80"):
        library.the_answer_should_mention(":bella", "80")
    library.the_question_should_pass("all")
    with pytest.raises(Skipped, match="food is not modelled yet"):
        library.the_question_should_pass("eats")
    with pytest.raises(Skipped, match="it needs the reasoner"):
        library.the_question_should_pass("both")
    with pytest.raises(UnknownNameError, match="no question 'none'"):
        library.ask_question("none")
    library.all_questions_about_should_pass("Animals")
    with pytest.raises(UnknownNameError, match="no question is about 'plants'"):
        library.all_questions_about_should_pass("plants")


def test_failures(library: Keywords, tmp_path: Path) -> None:
    with pytest.raises(AssertionError, match="no question has been asked"):
        library.the_answer_should_be_as_expected()
    path = tmp_path / "q.yml"
    path.write_text("questions: [{id: a, group: g, query: 'ASK {}', expect: false}]")
    assert library.load_the_questions(str(path)) == 1
    with pytest.raises(AssertionError, match=r"failed: a\nexpected false, got true"):
        library.the_question_should_pass("a")
    with pytest.raises(AssertionError, match="a: expected false, got true"):
        library.all_questions_about_should_pass("g")


def test_a_test_for_each_question(farm: Path) -> None:
    made: list[tuple[str, list[str], list[str]]] = []

    def create(name: str, tags: list[str]) -> SimpleNamespace:
        steps: list[str] = []
        made.append((name, tags, steps))
        return SimpleNamespace(body=SimpleNamespace(create_keyword=lambda name: steps.append(name)))

    suite = SimpleNamespace(tests=SimpleNamespace(create=create))
    Keywords(str(farm / "manifest.ttl")).start_suite(suite, None)
    assert made == []
    Keywords(str(farm / "manifest.ttl"), each="yes").start_suite(suite, None)
    assert len(made) == 7
    assert made[0] == (
        "heavy: Which animal is how heavy, the heaviest first?",
        ["animals"],
        ['The question "heavy" should pass'],
    )


def test_features() -> None:
    library = Keywords(reasoner="no")
    library.load_the_ontology()
    library.should_indicate("House", "residential")
    library.should_not_indicate("House", "Industrial")
    library.should_stay("House")
    library.should_move("Cat")
    with pytest.raises(AssertionError, match="House indicates Residential with strength"):
        library.should_indicate_with_strength("House", "Residential", "0.123")
    with pytest.raises(AssertionError, match="House does not indicate Industrial"):
        library.should_indicate_with_strength("House", "Industrial", "1")
    with pytest.raises(AssertionError, match="House does not indicate Industrial"):
        library.should_indicate("House", "Industrial")
    with pytest.raises(AssertionError, match="House indicates Residential"):
        library.should_not_indicate("House", "Residential")
    with pytest.raises(AssertionError, match="Cat is dynamic"):
        library.should_stay("Cat")
    with pytest.raises(AssertionError, match="House is static"):
        library.should_move("House")
    with pytest.raises(UnknownNameError):
        library.should_stay("Hosue")


def test_data(hermit: None, farm: Path) -> None:
    library, ontology = Keywords(), str(farm / "farm.ttl")
    library.data_should_be_refused(str(farm / "bad-herd.ttl"), ontology)
    library.data_should_be_accepted(str(farm / "herd.ttl"), ontology)
    with pytest.raises(AssertionError, match="the data is not refused"):
        library.data_should_be_refused(str(farm / "herd.ttl"), ontology)
    with pytest.raises(AssertionError, match="ontology and data contradict each other"):
        library.data_should_be_accepted(str(farm / "bad-herd.ttl"), ontology)
    with pytest.raises(Skipped):
        Keywords(reasoner="no").data_should_be_refused(str(farm / "herd.ttl"))
