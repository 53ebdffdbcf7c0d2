"""Reports: each format says what happened, whatever characters are in it."""

from __future__ import annotations

import json
from html.parser import HTMLParser
from pathlib import Path
from xml.etree import ElementTree

import pytest
from pyoxigraph import BlankNode, Literal, NamedNode, Triple

from symboslam.errors import InputError
from symboslam.reasoning.questions import model
from symboslam.reasoning.questions.model import (
    Answer,
    Contains,
    Expected,
    Query,
    Question,
    Report,
    Result,
    RowCount,
    Table,
    Triples,
)
from symboslam.reasoning.questions.report import FORMATS, render, summary

NASTY = 'a <b> & "c" | `d` *e* \x00\x1b ]]> </script>\nnew line'
A = NamedNode("https://example.org/a")
TABLE = Table(
    ("what", "how"),
    ((A, Literal("0.9")), (Literal(NASTY, language="en"), None), (BlankNode(), Literal("1"))),
)


def question(name: str, group: str = "", expected: Expected | None = None) -> Question:
    query = Query("PREFIX : <https://example.org/> SELECT * {}\n", Path("q.rq"))
    return Question(name, f"Is {name} {NASTY}?", group=group, query=query, expected=expected)


def result(
    name: str, status: str, message: str = "", *, group: str = "", answer: Answer | None = None,
    expected: Expected | None = None,
) -> Result:  # fmt: skip
    return Result(question(name, group, expected), status, 0.25, message, answer)


@pytest.fixture
def report() -> Report:
    """One result of each status, in two groups."""
    graph = Triples((Triple(A, A, BlankNode()),))
    return Report(
        f"Title {NASTY}",
        (
            result("p", model.PASSED, answer=TABLE, expected=TABLE, group="one & only"),
            result("f", model.FAILED, f"missing\n{NASTY}", answer=TABLE, expected=RowCount(1, 1)),
            result("k", model.KNOWN_FAILING, "not yet\nmissing", answer=graph, expected=graph),
            result("b", model.BROKEN, "unknown", expected=Contains(((("x", A),),))),
            result("s", model.SKIPPED, "no reasoner", expected=True, group="one & only"),
        ),
        seconds=1.5,
    )


def test_counts(report: Report) -> None:
    assert summary(report) == "1 passed, 1 failed, 1 known failing, 1 broken, 1 skipped"
    assert summary(Report("none")) == "no questions"
    assert not report.ok
    assert list(report.groups) == ["one & only", "competency questions"]
    assert [r.question.id for r in report.groups["one & only"]] == ["p", "s"]


def test_text(report: Report) -> None:
    lines = render(report, "text").split("\n")
    found = [line.split(":")[0].split() for line in lines if " Is " in line]
    assert found == [
        ["passed", "p"], ["skipped", "s"], ["failed", "f"], ["known", "failing", "k"],
        ["broken", "b"],
    ]  # fmt: skip
    assert "                unknown" in lines
    assert lines[-2].endswith("1 skipped in 1.5 s")


def test_json(report: Report) -> None:
    found = json.loads(render(report, "json"))
    assert found["counts"] == {
        "passed": 1, "failed": 1, "known failing": 1, "broken": 1, "skipped": 1, "total": 5,
    }  # fmt: skip
    first, second, third, fourth, fifth = found["results"]
    assert [r["id"] for r in found["results"]] == ["p", "f", "k", "b", "s"]
    assert first["question"] == f"Is p {NASTY}?"
    assert {"status", "group", "kind", "seconds", "message", "query"} <= set(first)
    assert first["answer"]["columns"] == ["what", "how"]
    assert first["answer"]["rows"][0] == ["<https://example.org/a>", '"0.9"']
    assert first["answer"]["rows"][2][0] == "_:"
    assert first["expected"] == first["answer"]
    assert second["expected"] == {"least": 1, "most": 1}
    assert third["answer"]["count"] == 1
    assert fourth["answer"] is None
    assert fifth["expected"] is True


def test_junit(report: Report) -> None:
    text = render(report, "junit")
    root = ElementTree.fromstring(text)
    assert root.tag == "testsuites"
    counts = {"tests": "5", "failures": "1", "errors": "1", "skipped": "2"}
    assert counts.items() <= root.attrib.items()
    suites = {suite.get("name"): suite for suite in root}
    assert suites["one & only"].get("tests") == "2"
    assert suites["one & only"].get("time") == "0.500"
    cases = {str(case.get("name"))[0]: case for case in root.iter("testcase")}
    assert {name: [child.tag for child in case] for name, case in cases.items()} == {
        "p": [], "f": ["failure"], "k": ["skipped"], "b": ["error"], "s": ["skipped"],
    }  # fmt: skip
    assert str(cases["f"][0].text).startswith("missing\na <b> &")
    assert cases["k"][0].get("message") == "known failing: not yet"
    assert all(case.get("classname") for case in cases.values())


def test_markdown(report: Report) -> None:
    lines = render(report, "md").split("\n")
    assert lines[0].startswith("# Title a \\<b\\> &")
    assert "## one & only" in lines
    row = next(line for line in lines if line.startswith("| \N{CHECK MARK} passed | p |"))
    assert row.replace("\\|", "").count("|") == 4
    cells = [line for line in lines if line.startswith('| "a ')]
    assert cells
    assert all(line.replace("\\|", "").count("|") == 3 for line in cells)


class Tags(HTMLParser):
    """Counts tags, and sees that they are closed."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: list[str] = []
        self.addresses: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.append(tag)
        self.addresses += [str(value) for name, value in attrs if name in ("src", "href")]
        if tag not in ("meta", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def test_html(report: Report) -> None:
    text = render(report, "html")
    tags = Tags()
    tags.feed(text)
    assert not tags.open
    assert tags.seen.count("details") == 5
    assert tags.seen.count("h2") == 2
    assert "script" not in tags.seen
    assert tags.addresses == []  # it needs nothing from elsewhere
    assert "@import" not in text
    assert "url(" not in text


def test_unknown_format(report: Report) -> None:
    assert len(FORMATS) == 5
    with pytest.raises(InputError, match="known formats are text, json, junit, md, html"):
        render(report, "pdf")


@pytest.mark.parametrize("form", FORMATS)
def test_nothing_to_report(form: str) -> None:
    assert render(Report("none"), form)
