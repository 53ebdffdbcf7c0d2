"""Rules about whole files, and what one Turtle file after a common head cannot express."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from symboslam.reasoning.pitfalls.model import Result, Settings, Status
from symboslam.reasoning.pitfalls.scan import scan_pitfalls

RDF_XML = """<?xml version="1.0"?>
<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"
    xmlns:owl="http://www.w3.org/2002/07/owl#"
    xmlns:rdfs="http://www.w3.org/2000/01/rdf-schema#"{base}>
{body}
</rdf:RDF>
"""
BASE = ' xml:base="https://example.org/o"'
NS = "http://www.w3.org/2002/07/owl#"
OWL = f"@prefix owl: <{NS}> .\n"
NAMED = '<owl:Ontology rdf:about="https://example.org/o"/>'
CLASS = '<owl:Class rdf:about="https://example.org/o#A"/>'
STRICT = Settings(strict_oops=True)

Check = Callable[..., Result]


@pytest.fixture
def check(tmp_path: Path) -> Check:
    """The result of one rule on files, given as name -> text."""

    def call(code: str, files: dict[str, str], settings: Settings | None = None) -> Result:
        for name, text in files.items():
            (tmp_path / name).write_text(text, encoding="utf-8")
        paths = [tmp_path / name for name in files]
        report = scan_pitfalls(paths, settings, codes=[code], strict_imports=False)
        return next(r for r in report.results if r.pitfall.code == code)

    return call


def xml(body: str, base: str = "") -> dict[str, str]:
    return {"o.owl": RDF_XML.format(base=base, body=body)}


def messages(result: Result) -> list[str]:
    assert result.status is Status.CHECKED, result.reason
    return [o.finding.message for o in result.occurrences]


# P38


@pytest.mark.parametrize(
    ("files", "ours", "theirs"),
    [
        (xml(CLASS), 1, 1),
        (xml(NAMED + CLASS), 0, 0),
        (xml("<owl:Ontology/>" + CLASS), 0, 1),
        (xml("<owl:Ontology></owl:Ontology>" + CLASS), 0, 0),
        (xml(f"<Ontology xmlns=\"{NS}\" rdf:about=\"https://e.org/o\"/>"), 0, 1),
        ({"o.ttl": OWL + "<https://e.org/o#A> a owl:Class ."}, 1, 1),
        ({"o.ttl": OWL + "<https://e.org/o> a owl:Ontology ."}, 0, 1),
        ({"o.ttl": OWL + "<https://e.org/o> a owl:Ontology ; owl:versionInfo '1' ."}, 0, 0),
        ({"o.ttl": OWL + "<https://e.org/o> a owl:Ontology , owl:Thing ."}, 0, 0),
    ],
)  # fmt: skip
def test_no_ontology(check: Check, files: dict[str, str], ours: int, theirs: int) -> None:
    assert len(messages(check("P38", files))) == ours
    assert len(messages(check("P38", files, STRICT))) == theirs


def test_no_ontology_in_one_of_two(check: Check) -> None:
    files = {
        "a.ttl": OWL + "<https://e.org/a> a owl:Ontology ; owl:versionInfo '1' .",
        "b.ttl": OWL + "\n<https://e.org/a#B> a owl:Class .",
    }
    for settings in (None, STRICT):
        (found,) = check("P38", files, settings).occurrences
        assert "b.ttl declares no" in found.finding.message
    (found,) = check("P38", files).occurrences
    assert found.place.file.endswith("b.ttl")
    assert found.place.line == 3


def test_an_ontology_in_json_ld_and_owl_xml(check: Check) -> None:
    owl = "http://www.w3.org/2002/07/owl#"
    json = f'{{"@id": "https://e.org/o", "@type": "{owl}Ontology"}}'
    assert messages(check("P38", {"o.jsonld": json})) == []
    owl_xml = f'<Ontology xmlns="{owl}" ontologyIRI="https://e.org/o"></Ontology>'
    assert messages(check("P38", {"o.owx": owl_xml})) == []


# P36


def test_extension_in_rdf_xml(check: Check) -> None:
    body = '<owl:Ontology rdf:about="https://example.org/o.owl"/>' + CLASS
    (found,) = check("P36", xml(body)).occurrences
    assert found.finding.message.endswith("contains the file extension .owl")
    assert found.place.line == 5
    assert messages(check("P36", xml('<owl:Ontology rdf:about=""/>' + CLASS))) == []


def test_extension_is_not_for_oops(check: Check) -> None:
    result = check("P36", xml(NAMED), STRICT)
    assert result.status is Status.NOT_CHECKED
    assert "by its address" in result.reason


# P39


@pytest.mark.parametrize(
    ("files", "ours", "theirs"),
    [
        (xml("<owl:Ontology></owl:Ontology>" + CLASS), 1, 1),
        (xml('<owl:Ontology rdf:about=""/>' + CLASS), 1, 1),
        (xml('<owl:Ontology rdf:about=""/>' + CLASS, BASE), 0, 0),
        (xml('<owl:Ontology rdf:about=""/>' + CLASS, ' xml:base=""'), 1, 1),
        (xml(NAMED + '<owl:Class rdf:about="#A"/>'), 1, 0),
        (xml(NAMED + '<owl:Class rdf:ID="A"/>'), 1, 0),
        (xml(NAMED + '<owl:Class rdf:ID="A"/>', BASE), 0, 0),
        (xml(NAMED + CLASS), 0, 0),
        (xml(CLASS), 0, 1),
        ({"o.ttl": OWL + "<> a owl:Ontology ; owl:versionInfo '1' ."}, 1, 1),
        ({"o.ttl": "@base <https://e.org/o> .\n" + OWL + "<> a owl:Ontology ."}, 0, 1),
    ],
)
def test_ambiguous(check: Check, files: dict[str, str], ours: int, theirs: int) -> None:
    assert len(messages(check("P39", files))) == ours
    assert len(messages(check("P39", files, STRICT))) == theirs


def test_oops_fails_on_a_type_without_a_description(check: Check) -> None:
    typed = '<rdf:type rdf:resource="http://www.w3.org/2002/07/owl#Ontology"/>'
    described = '<rdf:Description rdf:about="{iri}">' + typed + "</rdf:Description>"
    for iri, count in (("https://example.org/o", 0), ("", 1)):
        assert len(messages(check("P39", xml(described.format(iri=iri)), STRICT))) == count
    body = f'<owl:Thing rdf:about="">{typed}</owl:Thing>'
    assert messages(check("P39", xml(body), STRICT)) == []
    assert messages(check("P38", xml(body), STRICT)) == []


def test_relative_names_are_listed(check: Check) -> None:
    body = "".join(f'<owl:Class rdf:about="#{name}"/>\n' for name in "ABCDE")
    (found,) = check("P39", xml(NAMED + body)).occurrences
    assert found.finding.message.endswith("o.owl: <#A>, <#B>, <#C> and 2 more")
    assert found.place.line == 5


def test_bundled_modules_have_no_text() -> None:
    report = scan_pitfalls(["https://w3id.org/symboslam/core"], STRICT, codes=["P38", "P39"])
    for result in report.results:
        if result.pitfall.code in ("P38", "P39"):
            assert result.status is Status.NOT_CHECKED
            assert "has none" in result.reason


# P41


def test_no_ontology_and_no_licence(check: Check) -> None:
    assert messages(check("P41", xml(CLASS))) == [
        "it declares no ontology, and so no licence of it"
    ]


def test_licence_of_an_ontology_without_an_iri(check: Check) -> None:
    licence = '<l:license xmlns:l="http://purl.org/dc/terms/">CC0</l:license>'
    assert len(messages(check("P41", xml("<owl:Ontology/>" + CLASS)))) == 1
    assert messages(check("P41", xml(f"<owl:Ontology>{licence}</owl:Ontology>"))) == []


# Imports that were not read

IMPORTS = "@prefix : <https://example.org/o#> .\n@prefix far: <https://far.example/f#> .\n"
IMPORTS += "@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .\n"
IMPORTS += OWL + "<https://example.org/o> a owl:Ontology ; owl:imports <https://far.example/f> .\n"


@pytest.mark.parametrize(
    ("code", "body", "is_known"),
    [
        ("P10", ":A a owl:Class . :B a owl:Class .", False),
        ("P10", ":A a owl:Class . :B a owl:Class ; owl:disjointWith :A .", True),
        ("P11", ":p a owl:ObjectProperty .", True),
        ("P11", ":p a owl:ObjectProperty ; rdfs:subPropertyOf far:p .", False),
        ("P11", ":p a owl:ObjectProperty ; rdfs:subPropertyOf :q . :q a owl:ObjectProperty ; "
         "owl:equivalentProperty far:p .", False),
        ("P11", "far:p a owl:ObjectProperty .", False),
        ("P13", ":p a owl:ObjectProperty .", True),
        ("P13", "far:p a owl:ObjectProperty .", False),
        ("P34", ":A a owl:Class ; rdfs:subClassOf far:A .", False),
        ("P34", ":A a owl:Class .", True),
        ("P35", ":p a owl:ObjectProperty ; rdfs:subPropertyOf far:p .", False),
        ("P35", ":p a owl:ObjectProperty .", True),
    ],
)  # fmt: skip
def test_unread_imports(check: Check, code: str, body: str, is_known: bool) -> None:
    result = check(code, {"o.ttl": IMPORTS + body})
    if is_known:
        assert result.status is Status.CHECKED, result.reason
    else:
        assert result.status is Status.NOT_CHECKED
        assert "<https://far.example/f>" in result.reason


# P13


def test_variants(scan_text: Any) -> None:
    body = """
:A a owl:Class . :B a owl:Class .
:p a owl:ObjectProperty ; rdfs:domain :A ; rdfs:range :B .
:q a owl:ObjectProperty ; rdfs:domain :B ; rdfs:range :A .
:r a owl:ObjectProperty ; rdfs:domain :B ; rdfs:range :B .
:s a owl:ObjectProperty .
:t a owl:ObjectProperty, owl:TransitiveProperty ; rdfs:domain :B ; rdfs:range :B .
"""
    ours = {"p q": "P13-Y", "r": "P13-S", "s": "P13-N", "t": "P13-N"}
    assert _variants(scan_text(body, codes=["P13"])) == sorted(ours.items())
    # r and t lead from and to the same class, and so each is the other's partner too
    theirs = [("p q", "P13-Y"), ("r t", "P13-Y"), ("s", "P13-N"), ("r", "P13-S")]
    assert _variants(scan_text(body, STRICT, codes=["P13"])) == sorted(theirs)


def _variants(report: Any) -> list[tuple[str, str]]:
    found = next(r for r in report.results if r.pitfall.code == "P13").occurrences
    return sorted(
        (" ".join(e.rpartition("#")[2] for e in o.finding.elements), o.finding.variant)
        for o in found
    )


# Where


def test_inside_of_an_expression_the_axiom_is_named(scan_text: Any) -> None:
    body = """:p a owl:ObjectProperty .
:A a owl:Class ;
    rdfs:subClassOf [ a owl:Class ; owl:unionOf ( [ a owl:Restriction ;
        owl:onProperty :p ; owl:someValuesFrom :X ] :A ) ] ."""
    report = scan_text(body, codes=["P34"])
    (found,) = next(r for r in report.results if r.pitfall.code == "P34").occurrences
    assert found.axiom == "every A is (p some X) or A"
    assert found.place.line == 12
