"""The short YAML form."""

from __future__ import annotations

from pathlib import Path

import pytest

from symboslam.errors import InputError
from symboslam.reasoning.questions import model
from symboslam.reasoning.questions import vocabulary as v
from symboslam.reasoning.questions.manifest import load_manifest
from symboslam.reasoning.questions.model import Contains, RowCount, Table
from symboslam.reasoning.questions.run import run

HEAD = "prefixes:\n  : https://example.org/x#\n".replace("  :", '  "":')


def load(tmp_path: Path, text: str) -> list[model.Question]:
    path = tmp_path / "questions.yml"
    path.write_text(text, encoding="utf-8")
    return load_manifest(path)


def expected(tmp_path: Path, text: str) -> object:
    query = "SELECT * { ?s ?p ?o }"
    (one,) = load(tmp_path, f"questions:\n- id: a\n  query: {query!r}\n  expect: {text}\n")
    return one.expected


def test_the_farm(farm: Path) -> None:
    report = run(load_manifest(farm / "questions.yml"), reasoning=False)
    status = {r.question.id: (r.status, r.message) for r in report.results}
    assert status.pop("cq-skipped") == ("skipped", "nobody knows")
    assert set(status.values()) == {("passed", "")}
    assert len(status) == 9


def test_what_a_question_has(farm: Path) -> None:
    found = {question.id: question for question in load_manifest(farm / "questions.yml")}
    cow = found["cq-cow"]
    assert (cow.text, cow.group, cow.line) == ("Cows are declared", "schema", 13)
    assert cow.ontologies == (farm / "farm.ttl",)
    assert [type(data) for data in cow.data] == [model.InlineData, type(farm)]
    assert found["cq-horse"].text == "cq-horse"
    assert found["cq-horse"].group == "Farm questions"


@pytest.mark.parametrize(
    ("text", "meaning"),
    [
        ("true", True),
        ("false", False),
        ("{boolean: false}", False),
        ("has_results", RowCount(least=1)),
        ("no_results", RowCount(most=0)),
        ("{has_results: true}", RowCount(least=1)),
        ("{has_results: false}", RowCount(most=0)),
        ("{no_results: true}", RowCount(most=0)),
        ("{count: 3}", RowCount(3, 3)),
        ("{count: 0}", RowCount(0, 0)),
        ("{min: 1, max: 2}", RowCount(1, 2)),
        ("{min_results: 1}", RowCount(1, None)),
        ("{max_results: 2}", RowCount(None, 2)),
        ("{results: []}", RowCount(most=0)),
        ("null", None),
    ],
)
def test_expectations(tmp_path: Path, text: str, meaning: object) -> None:
    assert expected(tmp_path, text) == meaning


def test_expected_rows(tmp_path: Path) -> None:
    rows = "[{s: 'owl:Thing', o: 2.50}, {s: 'http://e/x', o: true}, {s: 'a: b'}]"
    found = expected(tmp_path, f"{{values: {rows}}}")
    assert isinstance(found, Table)
    assert found.lexical
    assert found.columns == ("s", "o")
    texts = [[getattr(term, "value", None) for term in row] for row in found.rows]
    assert texts == [
        ["http://www.w3.org/2002/07/owl#Thing", "2.5"], ["http://e/x", "true"], ["a: b", None],
    ]  # fmt: skip
    found = expected(tmp_path, f"{{contains: {rows}}}")
    assert isinstance(found, Contains)
    assert len(found.rows) == 3


def test_what_is_added_to_the_form(tmp_path: Path) -> None:
    (tmp_path / "d.ttl").write_text("")
    (one,) = load(
        tmp_path,
        "regime: rdfs\nontology: [https://w3id.org/symboslam/core]\nquestions:\n"
        "- {id: a, query: 'ASK {}', group: g, data: d.ttl, regime: OWL-Direct,\n"
        "   columns: [x, '?y'], known_failing: why}\n",
    )
    assert one.ontologies == ("https://w3id.org/symboslam/core",)
    assert (one.group, one.data, one.regime) == ("g", (tmp_path / "d.ttl",), v.OWL_DIRECT)
    assert (one.columns, one.known_failing) == (("x", "y"), "why")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("questions: [", "line 1: it is not YAML: "),
        ("a: 1\n\tb: 2", "line 2: it is not YAML: "),
        ("", "line 1: no competency question in it"),
        ("questions: []", "line 1: no competency question in it"),
        ("- a\n- b", "line 1: a mapping with the key 'questions' is expected"),
        (
            "question: []",
            "line 1: manifest: the key 'question' is not known; is 'questions' meant?",
        ),
        ("questions:\n- id: a\n  querry: x", "line 3: question: the key 'querry' is not known; is"),
        ("questions:\n- id: a\n  id: b", "line 3: the key 'id' is given twice"),
        ("questions:\n- query: ASK {}", "line 2: a question needs an id"),
        ("questions:\n- just text", "line 2: a question is a mapping"),
        ("questions:\n- id: a", "line 2: a: either query or query_file is needed"),
        ("questions:\n- id: a\n  query_file: no.rq", "line 3: the query no.rq does not exist"),
        (
            "questions:\n- {id: a, query: 'ASK {}'}\n- {id: a, query: 'ASK {}'}",
            "line 3: the identif",
        ),
        ("data:\n  files: [no.ttl]\nquestions: []", "line 2: the data file no.ttl does not exist"),
        ("data:\n  inline: |\n    <a> <b> <c> .\n    <a> .\nquestions: []", "line 4: "),
        (
            "data:\n  online: x\nquestions: []",
            "line 2: data: the key 'online' is not known; is 'inl",
        ),
        ("ontology: no.ttl\nquestions: []", "line 1: the ontology no.ttl does not exist"),
        ("regime: rdf\nquestions: []", "line 1: regime: 'rdf' is not one of simple, rdfs, owl-dir"),
        (
            "questions:\n- id: a\n  query: |\n    ASK {\n      ?x foo:p 1\n    }",
            "line 5: the prefix foo: is not declared (foo:p)",
        ),
        ("questions:\n- id: a\n  query: ASK {} ?", "line 3: it is not SPARQL: "),
        (
            "questions:\n- {id: a, query: 'ASK {}', expect: yess}",
            "line 2: expect: 'yess' is not one",
        ),
        ("questions:\n- {id: a, query: 'ASK {}', expect: {}}", "line 2: expect: {} is not one of"),
        (
            "questions:\n- {id: a, query: 'ASK {}', expect: {cuont: 1}}",
            "line 2: expect: the key 'cu",
        ),
        (
            "questions:\n- {id: a, query: 'ASK {}', expect: {count: many}}",
            "line 2: expect: count is",
        ),
        (
            "questions:\n- {id: a, query: 'ASK {}', expect: {results: [1]}}",
            "line 2: an expected row",
        ),
        ("a: &a [x, x]\nb: &b [*a, *a]\n", "line 1: manifest: the key 'a' is not known"),
        ("questions: !!python/object/apply:os.system ['true']", "line 1: a question is a mapping"),
    ],
)
def test_bad(tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        load(tmp_path, text)
    said = str(caught.value)
    assert said.startswith(f"{tmp_path}/questions.yml: {message}"), said


def test_aliases_that_explode(tmp_path: Path) -> None:
    lines = ["name: &l0 [x, x, x, x, x, x, x, x, x, x]"]
    lines += [f"k{i}: &l{i} [{', '.join([f'*l{i - 1}'] * 10)}]" for i in range(1, 9)]
    with pytest.raises(InputError, match="grows by its aliases"):
        load(tmp_path, "\n".join(lines))
