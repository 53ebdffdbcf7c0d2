"""Comparison with upstream: what is found, what vanished or changed, and what is refused."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path

import pytest
from typer.testing import CliRunner

from symboslam.errors import InputError, OntologySyntaxError, SymboSlamError
from symboslam.reasoning import fidelity
from symboslam.reasoning.fidelity import Comparison, Finding, Status, Term, compare, reused_terms
from symboslam.reasoning.fidelity_report import as_json, as_markdown, as_text

UPSTREAM = Path(__file__).resolve().parents[3] / "shared" / "upstream"
O4M = "http://www.semanticweb.org/swarmShepherdingOntology/Onto4MAT#"
OS = "http://github.com/Alex23013/slam-up/OntoSLAM.owl#"
DOCUMENT = "http://swarmshepherding.net/swarmontologies/Onto4MAT.owl"

TERMS = [
    Term(O4M + "Agent", "o4m:Agent", "class", "upstream/onto4mat.ttl", DOCUMENT, "Agent"),
    Term(O4M + "Team", "o4m:Team", "class", "upstream/onto4mat.ttl", DOCUMENT, "Team"),
    Term(O4M + "hasSpeed", "o4m:hasSpeed", "data property", "upstream/onto4mat.ttl", DOCUMENT),
    Term(OS + "Position", "os:Position", "class", "upstream/ontoslam.ttl", "urn:os"),
    Term(OS + "Thing", "os:Thing", "class", "upstream/ontoslam.ttl", "urn:os"),
    Term(
        OS + "hasStamp",
        "os:hasStamp",
        "data property",
        "upstream/ontoslam.ttl",
        "urn:os",
        data_only=True,
    ),
]
TURTLE = f"""
@prefix o4m: <{O4M}> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
"""
UNEXPANDED = f"""<?xml version="1.0"?>
<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"
  xmlns:rdfs="http://www.w3.org/2000/01/rdf-schema#" xmlns:owl="http://www.w3.org/2002/07/owl#"
  xmlns="{OS}" xmlns:OS="{OS}">
  <owl:Class rdf:about="OS:Position"><rdfs:subClassOf rdf:resource="OS:Thing"/></owl:Class>
</rdf:RDF>
"""


@pytest.fixture
def few_terms(monkeypatch: pytest.MonkeyPatch) -> None:
    """Six terms in place of all."""
    monkeypatch.setattr(fidelity, "reused_terms", lambda: TERMS)


def by_name(found: Comparison) -> dict[str, Finding]:
    return {finding.term.name: finding for finding in found.findings}


def write(folder: Path, name: str, text: str) -> None:
    path = folder / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


def test_our_modules_reuse_what_they_should() -> None:
    terms = reused_terms()
    assert len({term.iri for term in terms}) == len(terms)
    modules = Counter(term.module for term in terms)
    assert modules["upstream/onto4mat.ttl"] == 60 + 56 + 14
    if "alignments/symboslam-2022.ttl" in modules:
        assert modules["alignments/symboslam-2022.ttl"] == 150
    covering = next(term for term in terms if term.iri == O4M + "IndividualCovering")
    assert covering.name == "o4m:IndividualCovering"
    assert covering.label == "IndividualContainment"
    assert covering.kind == "class"
    assert covering.document == DOCUMENT
    control = next(term for term in terms if term.iri == O4M + "agentControlsAgent")
    assert control.kind == "object property"
    assert next(term for term in terms if term.iri == O4M + "xLocation").label == ""


@pytest.mark.usefixtures("few_terms")
def test_everything_as_it_was(tmp_path: Path) -> None:
    write(tmp_path, "deep/er/team.ttl", TURTLE + """
        o4m:Agent a owl:Class ; rdfs:label "Agent" .
        o4m:Team a rdfs:Class ; rdfs:label "Team"@en , "Gruppe"@de .
        o4m:hasSpeed a owl:DatatypeProperty .
    """)  # fmt: skip
    write(tmp_path, "slam.owl", UNEXPANDED)
    write(tmp_path, "README.md", "no ontology")
    found = compare(tmp_path)
    assert found.ok
    assert found.files == ("deep/er/team.ttl", "slam.owl")
    assert found.counts == {
        "present": 5, "changed label": 0, "changed kind": 0, "vanished": 0,
        "in upstream data only": 1, "upstream not supplied": 0,
    }  # fmt: skip
    position = by_name(found)["os:Position"]
    assert position.files == ("slam.owl",)
    assert position.literally == "OS:Position"
    assert position.note == "found under unexpanded IRI OS:Position"
    assert by_name(found)["os:Thing"].note == (
        "used there, but not declared; found under unexpanded IRI OS:Thing"
    )
    assert by_name(found)["o4m:Team"].literally == ""
    assert by_name(found)["os:hasStamp"].status is Status.DATA_ONLY


@pytest.mark.usefixtures("few_terms")
def test_what_changed(tmp_path: Path) -> None:
    write(tmp_path, "team.ttl", TURTLE + """
        o4m:Agent a owl:Class ; rdfs:label "Actor" ; owl:deprecated true .
        o4m:hasSpeed a owl:ObjectProperty ; rdfs:domain o4m:Agent .
    """)  # fmt: skip
    write(tmp_path, "slam.owl", UNEXPANDED.replace("OS:Position", "OS:Place"))
    found = compare(tmp_path)
    assert not found.ok
    assert [(f.term.name, f.status, f.note) for f in found.findings[:4]] == [
        ("o4m:Team", Status.VANISHED, ""),
        ("os:Position", Status.VANISHED, ""),
        ("o4m:hasSpeed", Status.OTHER_KIND, "was data property, is object property"),
        ("o4m:Agent", Status.RELABELLED, "was labelled 'Agent', is 'Actor'; deprecated there"),
    ]


@pytest.mark.usefixtures("few_terms")
@pytest.mark.parametrize(
    ("label", "note"),
    [
        ("", "was labelled 'Agent', is nothing"),
        ('; rdfs:label "agent"', "was labelled 'Agent', is 'agent'"),
    ],
)
def test_labels_that_went_or_changed_case(tmp_path: Path, label: str, note: str) -> None:
    write(tmp_path, "team.ttl", f"{TURTLE} o4m:Agent a owl:Class {label} .")
    assert by_name(compare(tmp_path))["o4m:Agent"].note == note


@pytest.mark.usefixtures("few_terms")
def test_a_label_where_there_was_none(tmp_path: Path) -> None:
    text = f'{TURTLE} o4m:hasSpeed a owl:DatatypeProperty ; rdfs:label "speed" .'
    write(tmp_path, "team.ttl", text)
    found = by_name(compare(tmp_path))["o4m:hasSpeed"]
    assert (found.status, found.note) == (Status.RELABELLED, "was labelled nothing, is 'speed'")


@pytest.mark.usefixtures("few_terms")
def test_an_ontology_that_was_not_supplied_is_not_missed(tmp_path: Path) -> None:
    write(tmp_path, "slam.owl", UNEXPANDED)
    found = compare(tmp_path)
    assert found.ok
    assert by_name(found)["o4m:Team"].status is Status.NOT_SUPPLIED
    assert "upstream/onto4mat.ttl: no file holds any of its 3 terms" in as_text(found)
    # It was supplied if a file says that it is that ontology, even if all terms are gone.
    write(tmp_path, "team.ttl", f"{TURTLE} <{DOCUMENT}> a owl:Ontology .")
    found = compare(tmp_path)
    assert not found.ok
    assert by_name(found)["o4m:Team"].status is Status.VANISHED


@pytest.mark.usefixtures("few_terms")
def test_where_nothing_is_left_all_has_vanished(tmp_path: Path) -> None:
    write(tmp_path, "other.ttl", f"{TURTLE} <urn:x> a owl:Class .")
    found = compare(tmp_path)
    assert not found.ok
    assert found.counts["vanished"] == 5


@pytest.mark.usefixtures("few_terms")
def test_all_files_are_one_upstream(tmp_path: Path) -> None:
    write(tmp_path, "a.ttl", f"{TURTLE} o4m:hasSpeed rdfs:domain o4m:Agent .")
    write(tmp_path, "b.ttl", f'{TURTLE} o4m:Agent a owl:Class ; rdfs:label "Agent" .')
    write(tmp_path, "c.ttl", f'{TURTLE} o4m:Agent a owl:Class ; rdfs:label "Agent" .')
    found = by_name(compare(tmp_path))
    assert found["o4m:Agent"].status is Status.PRESENT
    assert found["o4m:Agent"].files == ("b.ttl", "c.ttl")  # a.ttl only uses it
    assert found["o4m:hasSpeed"].files == ("a.ttl",)


@pytest.mark.usefixtures("few_terms")
def test_reports(tmp_path: Path) -> None:
    write(tmp_path, "team|1.ttl", TURTLE + """
        o4m:Agent a owl:Class ; rdfs:label "Agent" . o4m:Team a owl:Class ; rdfs:label "Group" .
    """)  # fmt: skip
    found = compare(tmp_path)
    text = as_text(found).splitlines()
    assert text[:2] == [
        f"6 reused terms, 1 upstream file in {tmp_path}: 1 present, 1 changed label, 1 vanished, "
        "3 upstream not supplied",
        "  team|1.ttl",
    ]
    assert text[3:9] == [
        "vanished (1)",
        "  o4m:hasSpeed  reused in upstream/onto4mat.ttl",
        "",
        "changed label (1)",
        "  o4m:Team  team|1.ttl  was labelled 'Team', is 'Group'",
        "",
    ]
    row = f"| changed label | [o4m:Team]({O4M}Team) | upstream/onto4mat.ttl | team\\|1.ttl | was labelled 'Team', is 'Group' |"  # noqa: E501
    assert row in as_markdown(found).splitlines()
    data = json.loads(as_json(found))
    assert data["ok"] is False
    assert data["files"] == ["team|1.ttl"]
    assert data["counts"]["vanished"] == 1
    assert data["terms"][1] == {
        "iri": O4M + "Team",
        "name": "o4m:Team",
        "kind": "class",
        "status": "changed label",
        "module": "upstream/onto4mat.ttl",
        "files": ["team|1.ttl"],
        "unexpanded_iri": None,
        "upstream_label": "Team",
        "note": "was labelled 'Team', is 'Group'",
    }


def test_no_such_folder_and_none_of_the_files_an_ontology(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="nowhere: no such folder"):
        compare(tmp_path / "nowhere")
    write(tmp_path, "catalog-v001.xml", "<catalog/>")
    with pytest.raises(InputError, match="no ontology file in it or below it"):
        compare(tmp_path)
    with pytest.raises(InputError, match=r"xml: is a file; give the folder"):
        compare(tmp_path / "catalog-v001.xml")


def test_a_syntax_error_names_file_and_line(tmp_path: Path) -> None:
    write(tmp_path, "good.ttl", TURTLE)
    write(tmp_path, "sub/bad.ttl", "@prefix : <urn:x:> .\n:a :b ;;; :c .\n")
    with pytest.raises(OntologySyntaxError, match=r"sub/bad\.ttl: line 2: "):
        compare(tmp_path)
    (tmp_path / "sub/bad.ttl").unlink()
    write(tmp_path, "bad.owl", '<?xml version="1.0"?>\n<rdf:RDF xmlns:rdf="urn:x">\n</rdf:RDX>')
    with pytest.raises(OntologySyntaxError, match=r"bad\.owl: line 3: "):
        compare(tmp_path)


# Through the command line.


def run(*arguments: str) -> tuple[int, str]:
    from symboslam.cli.main import app

    result = CliRunner().invoke(app, ["ontology", "compare", *arguments])
    if isinstance(result.exception, SymboSlamError):
        return result.exception.exit_code, str(result.exception)
    return result.exit_code, result.output


def test_exit_codes(tmp_path: Path) -> None:
    assert run("--upstream", str(tmp_path / "nowhere"))[0] == 2
    assert run("--upstream", str(tmp_path))[0] == 2
    assert run()[0] == 2
    write(tmp_path, "team.ttl", f'{TURTLE} o4m:Agent a owl:Class ; rdfs:label "Actor" .')
    code, out = run("--upstream", str(tmp_path))
    assert code == 1
    assert "o4m:Agent  team.ttl  was labelled 'Agent', is 'Actor'" in out
    assert run("--upstream", str(tmp_path), "--format", "html")[0] == 2
    write(tmp_path, "bad.ttl", "a b\n")
    code, out = run("--upstream", str(tmp_path))
    assert code == 2
    assert "bad.ttl: line 1" in out


needs_upstream = pytest.mark.skipif(
    not UPSTREAM.is_dir(), reason=f"the published upstream files are not in {UPSTREAM}"
)


@needs_upstream
def test_the_published_files_have_all_that_we_reuse() -> None:
    code, out = run("--upstream", str(UPSTREAM), "--format", "json")
    data = json.loads(out)
    assert [t["name"] for t in data["terms"] if t["status"] not in ("present",)] == [
        "os:belongs_to", "os:hasChild", "os:hasStamp", "os:has_resolution",
    ]  # fmt: skip
    assert data["counts"]["in upstream data only"] == 4
    assert code == 0
    terms = {t["name"]: t for t in data["terms"]}
    assert terms["o4m:agentInflunencedByIndividualAction"]["files"] == ["Onto4MAT.owl"]
    assert terms["os:Position"]["files"] == ["ontoSLAM.owl"]
    assert terms["os:Position"]["unexpanded_iri"] == "OS:Position"
    assert terms["fr:posAtTime"]["unexpanded_iri"] == "FR:posAtTime"
    assert "not declared" in terms["os:Thing"]["note"]
    assert terms["old:House"]["files"] == ["SymboSLAM.owl"]
    assert run("--upstream", str(UPSTREAM), "--format", "md")[1].count("\n| present |") == sum(
        t["status"] == "present" for t in data["terms"]
    )


@needs_upstream
def test_a_changed_copy_of_a_published_file_is_found_out(tmp_path: Path) -> None:
    text = (UPSTREAM / "Onto4MAT.owl").read_text(encoding="utf-8")
    changed = text.replace("#teamHasSyncMech", "#teamHasSynchronisation")
    changed = changed.replace("IndividualContainment</rdfs:label>", "Watching</rdfs:label>")
    assert changed.count("Watching") == 1
    write(tmp_path, "Onto4MAT.owl", changed)
    found = compare(tmp_path)
    assert [(f.term.name, f.status) for f in found.findings if f.status in fidelity.CHANGES] == [
        ("o4m:teamHasSyncMech", Status.VANISHED),
        ("o4m:IndividualCovering", Status.RELABELLED),
    ]
