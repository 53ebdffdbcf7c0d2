"""Each check finds what it is there for, and nothing where all is well."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from symboslam.errors import OntologySyntaxError
from symboslam.reasoning.check import Report, check_ontology
from symboslam.reasoning.classes import Classes
from symboslam.reasoning.extract import extract
from symboslam.reasoning.knowledge import Indication, Knowledge

Resource = Callable[[str], Path]


def found(report: Report, kind: str) -> set[str]:
    """The messages of one kind of finding, after the names of what they are about."""
    return {f"{f.subject}: {f.message}" for f in report.findings if f.kind == kind}


FINDINGS = Path(__file__).parents[1] / "resources" / "reasoning" / "findings.ttl"


@pytest.fixture(scope="module")
def report() -> Report:
    return check_ontology(FINDINGS)


EXPECTED = {
    "missing-import": {
        f"https://example.org/nowhere: {FINDINGS}: line 8: the import "
        "<https://example.org/nowhere> was not found beside the file"
    },
    "missing-strength": {
        "House: House indicates Cave: has several strengths",
        "Hut: Hut indicates Home: has no strength (1 is used)",
    },
    "missing-reason": {
        "House: House indicates Home: has no reason (rdfs:comment)",
        "Hut: Hut indicates Home: has no reason (rdfs:comment)",
    },
    "missing-source": {
        "House: House indicates Home: has no source (prov:wasDerivedFrom)",
        "Hut: Hut indicates Home: has no source (prov:wasDerivedFrom)",
    },
    "leads-nowhere": {"House: House indicates Cave, which belongs to no environment"},
    "indication-in-definition": {
        "Villa: indicates by definition; state it as rdfs:subClassOf to give it a strength"
    },
    "bad-colour": {"Home: the colour 'red' is not #rrggbb"},
    "unknown-term": {"reason: sl:reason is used, but nothing declares it"},
    "feature-without-indication": {
        "Shed: indicates no environment",
        "Villa: indicates no environment",
    },
    "neither-static-nor-dynamic": {"Hut: is neither static nor dynamic (static is assumed)"},
    "bad-osm-tag": {"Hut: the OSM tag 'hut' is not key=value"},
    "claimed-twice": {
        "building=hut: the OSM tag 'building=hut' is claimed by Hut, Shed",
        "house: the detector label 'house' is claimed by House, Hut",
    },
    "environment-without-indication": {"Moor: no feature indicates it"},
    "disagreement": {
        "Villa: HermiT infers that Villa indicates Moor, but no stated indication leads there"
    },
}


@pytest.mark.parametrize("kind", EXPECTED)
def test_findings(hermit: None, report: Report, kind: str) -> None:
    assert found(report, kind) == EXPECTED[kind]


def test_nothing_else_is_found(hermit: None, report: Report) -> None:
    assert {f.kind for f in report.findings} == EXPECTED.keys()
    assert not report.ok
    assert report.consistent
    assert (report.environments, report.features, report.indications, report.ways) == (2, 4, 3, 2)


def test_text(hermit: None, report: Report, resource: Resource) -> None:
    lines = str(report).splitlines()
    assert lines[0].endswith("findings.ttl")
    assert lines[1].endswith(
        "2 environments, 4 features, 3 stated indications, 2 feature-environment pairs"
    )
    assert lines[2:4] == ["consistent, and every class can have members", "19 findings"]
    assert "  feature-without-indication: Shed: indicates no environment" in lines
    clash = str(check_ontology(resource("invalid_unsatisfiable.ttl")))
    assert "these axioms clash:\n  every " in clash
    assert "1 finding\n" in clash
    assert str(Report("mine.ttl")).splitlines()[2:] == [
        "consistent, and every class can have members", "no findings"
    ]  # fmt: skip


@pytest.mark.proof
def test_bundled_ontology_is_clean(hermit: None) -> None:
    report = check_ontology()
    assert report.findings == ()
    assert report.ok
    assert report.environments == 8
    assert report.features >= 200
    assert report.indications >= 300


@pytest.mark.proof
def test_inconsistent(hermit: None, resource: Resource) -> None:
    report = check_ontology(resource("invalid_inconsistent.ttl"))
    assert not report.consistent
    assert report.unsatisfiable == ()
    assert "house1 is a Home" in report.clash
    assert [f.kind for f in report.findings] == ["clash"]


def test_unsatisfiable(hermit: None, resource: Resource) -> None:
    report = check_ontology([str(resource("invalid_unsatisfiable.ttl"))])
    assert report.consistent
    assert len(report.unsatisfiable) == 2
    assert "every House is a Home" in report.clash
    assert not report.ok


def test_bad_strength(hermit: None, resource: Resource) -> None:
    report = check_ontology(resource("invalid_strength.ttl"))
    assert found(report, "bad-strength") == {
        "House: House indicates Home: strength 1.5 is not in (0, 1]"
    }


@pytest.mark.parametrize("name", ["invalid_no_environments.ttl", "invalid_no_indications.ttl"])
def test_empty(hermit: None, resource: Resource, name: str) -> None:
    assert len(found(check_ontology(resource(name)), "empty")) == 1


def test_one_environment(hermit: None, resource: Resource) -> None:
    report = check_ontology(resource("rooms.owx"))
    assert found(report, "one-environment")
    assert found(report, "missing-source")
    assert not found(report, "missing-reason")


def test_syntax_errors_are_raised(resource: Resource) -> None:
    with pytest.raises(OntologySyntaxError):
        check_ontology(resource("invalid_syntax.ttl"))


def test_table_that_claims_too_much(
    hermit: None, resource: Resource, monkeypatch: pytest.MonkeyPatch
) -> None:
    """If the table held an indication that does not follow, the check would say so."""

    def extract_and_add(classes: Classes) -> Knowledge:
        knowledge = extract(classes)
        extra = Indication("Tower", "Home", 0.5, 0, ("Tower", "Home"))
        return replace(knowledge, indications=(*knowledge.indications, extra))

    monkeypatch.setattr("symboslam.reasoning.extract.extract", extract_and_add)
    assert found(check_ontology(resource("town.ttl")), "disagreement") == {
        "Tower: the table says that Tower indicates Home, but HermiT does not infer it"
    }


def test_odd_files(hermit: None, tmp_path: Path) -> None:
    """A circle of imports and a byte-order mark are findings with file and line."""
    text = FINDINGS.read_text().replace("https://example.org/nowhere", "urn:b")
    (tmp_path / "a.ttl").write_bytes(b"\xef\xbb\xbf" + text.encode())
    (tmp_path / "b.ttl").write_text(
        "@prefix owl: <http://www.w3.org/2002/07/owl#> .\n"
        "<urn:b> a owl:Ontology ; owl:imports <https://example.org/f> ."
    )
    report = check_ontology(tmp_path / "a.ttl")
    (mark,) = found(report, "byte-order-mark")
    assert "a.ttl: line 1: begins with a byte-order mark" in mark
    (circle,) = found(report, "cyclic-import")
    assert "a.ttl: line 8 imports b.ttl" in circle
    assert "b.ttl: line 2 imports a.ttl" in circle
    assert not found(report, "missing-import")
