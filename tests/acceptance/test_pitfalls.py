"""``symboslam pitfalls`` as users run it, on good and on bad input."""

from __future__ import annotations

import json
import subprocess
import sys
import time
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
import yaml

ROOT = Path(__file__).parents[2]
HEAD = """@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix dcterms: <http://purl.org/dc/terms/> .
@prefix sl: <https://w3id.org/symboslam#> .
@prefix : <https://example.org/farm#> .
"""
SOUND = """<https://example.org/farm> a owl:Ontology ;
    dcterms:license <https://creativecommons.org/licenses/by/4.0/> .
:Cow a owl:Class ; rdfs:label "cow"@en ; rdfs:comment "A cow gives milk."@en ;
    rdfs:subClassOf :Animal ; owl:disjointWith :Hen .
:Hen a owl:Class ; rdfs:label "hen"@en ; rdfs:comment "A hen lays eggs."@en ;
    rdfs:subClassOf :Animal .
:Animal a owl:Class ; rdfs:label "animal"@en ; rdfs:comment "A living thing."@en .
"""
CYCLE = "\n:Animal rdfs:subClassOf :Cow .\n"
CODES = [f"P{number:02}" for number in range(1, 42)]


def write(folder: Path, text: str, name: str = "farm.ttl") -> Path:
    path = folder / name
    path.write_text(HEAD + text, encoding="utf-8")
    return path


def refused(result: Any, *words: str) -> None:
    assert result.code == 2, result
    assert "Traceback" not in result.err
    assert "internal error" not in result.err
    for word in words:
        assert word in result.err


def affected(out: str, code: str) -> list[Any]:
    found = json.loads(out)["pitfalls"]
    assert [p["code"] for p in found] == CODES
    listed: list[Any] = next(p for p in found if p["code"] == code)["affected"]
    return listed


# What it does


def test_a_sound_ontology(run: Any, tmp_path: Path) -> None:
    result = run("pitfalls", write(tmp_path, SOUND))
    assert result.code == 0, result.out
    assert "not checked" in result.out


def test_a_cycle(run: Any, tmp_path: Path) -> None:
    path = write(tmp_path, SOUND + CYCLE)
    result = run("pitfalls", path)
    assert result.code == 1
    assert "P06" in result.out
    assert f"{path}:" in result.out
    found = run("pitfalls", path, "--format", "json")
    (one,) = affected(found.out, "P06")
    assert set(one) >= {"iri", "file", "line", "message"}
    lines = path.read_text().splitlines()
    assert "rdfs:subClassOf" in lines[one["line"] - 1]


def test_exit_codes(run: Any, tmp_path: Path) -> None:
    path = write(tmp_path, SOUND + ":Misc a owl:Class ; rdfs:subClassOf :Animal .")
    assert run("pitfalls", path).code == 1  # P08 and P21 are minor
    assert run("pitfalls", path, "--fail-on", "important").code == 0
    assert run("pitfalls", path, "--ignore", "P08,P21").code == 0
    assert run("pitfalls", path, "--select", "p6").code == 0
    refused(run("pitfalls", path, "--select", "P42"), "P42", "P01 to P41")
    refused(run("pitfalls", path, "--format", "yaml"), "oops-rdf")
    refused(run("pitfalls", path, "--out", path), "overwrite")


def test_a_baseline(run: Any, tmp_path: Path) -> None:
    path, baseline = write(tmp_path, SOUND + CYCLE), tmp_path / "baseline.json"
    assert run("pitfalls", path, "--format", "json", "--out", baseline).code == 1
    assert run("pitfalls", path, "--baseline", baseline).code == 0
    write(tmp_path, "\n\n" + SOUND + CYCLE + ":Goat a owl:Class ; rdfs:subClassOf :Animal .")
    result = run("pitfalls", path, "--baseline", baseline)
    assert result.code == 1
    assert "Goat" in result.out
    refused(run("pitfalls", path, "--baseline", tmp_path / "none.json"), "none.json")
    (tmp_path / "none.json").write_text("[")
    refused(run("pitfalls", path, "--baseline", tmp_path / "none.json"), "none.json")


def test_an_accepted_pitfall(run: Any, tmp_path: Path) -> None:
    accepted = ':Animal sl:acceptedPitfall "P06: cows are all the animals that we have" .'
    path = write(tmp_path, SOUND + CYCLE + accepted)
    result = run("pitfalls", path, "--format", "json")
    assert result.code == 0
    (one,) = affected(result.out, "P06")
    assert one["accepted"] == "cows are all the animals that we have"
    path = write(tmp_path, SOUND + CYCLE + ':Animal sl:acceptedPitfall "P06" .')
    result = run("pitfalls", path)
    assert result.code == 1
    assert "accepts nothing" in result.out


@pytest.mark.parametrize(
    "form", ["text", "json", "md", "html", "sarif", "junit", "oops-rdf", "oops-xml"]
)
def test_formats(run: Any, tmp_path: Path, form: str) -> None:
    path, out = write(tmp_path, SOUND + CYCLE), tmp_path / "report"
    assert run("pitfalls", path, "--format", form, "--out", out).code == 1
    text = out.read_text(encoding="utf-8")
    assert "P06" in text
    if form in ("json", "sarif"):
        json.loads(text)
    if form in ("junit", "oops-rdf", "oops-xml"):
        ElementTree.fromstring(text)


def test_our_own_ontology(run: Any) -> None:
    refused(run("pitfalls"), "FILE")
    refused(run("pitfalls", ""), "FILE")
    result = run("pitfalls", "https://w3id.org/symboslam/symboslam", "--format", "json")
    assert result.code == 0, result.out[:3000]
    assert json.loads(result.out)["ontology"].startswith("https://w3id.org/symboslam")


def test_list(run: Any) -> None:
    result = run("pitfalls", "--list")
    assert result.code == 0
    assert all(code in result.out for code in CODES)


def test_from_any_folder_with_an_absolute_path(run_process: Any, tmp_path: Path) -> None:
    path = write(tmp_path, SOUND)
    assert run_process("pitfalls", path, cwd="/").code == 0


# The same in every syntax


def test_syntaxes(run: Any, tmp_path: Path) -> None:
    import pyhornedowl
    from rdflib import Graph

    graph = Graph().parse(write(tmp_path, SOUND + CYCLE))
    text = graph.serialize(format="xml")
    (tmp_path / "farm.owl").write_text(text)
    (tmp_path / "farm.jsonld").write_text(graph.serialize(format="json-ld"))
    (tmp_path / "farm.nt").write_text(graph.serialize(format="nt"))
    horned = pyhornedowl.open_ontology_from_string(text, serialization="rdf")
    (tmp_path / "farm.ofn").write_text(horned.save_to_string("ofn"))
    (tmp_path / "farm.owx").write_text(horned.save_to_string("owx"))
    found = {}
    for ending in ("ttl", "owl", "jsonld", "nt", "ofn", "owx"):
        result = run("pitfalls", tmp_path / f"farm.{ending}", "--format", "json")
        assert result.code == 1, (ending, result)
        report = json.loads(result.out)
        assert all(a["line"] for p in report["pitfalls"] for a in p["affected"]), ending
        found[ending] = {
            (p["code"], *sorted(a["elements"])) for p in report["pitfalls"] for a in p["affected"]
        }
    assert found["ttl"]
    assert {ending: codes for ending, codes in found.items() if codes != found["ttl"]} == {}


# Bad input


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("empty.ttl", "", ["empty.ttl", "line 1"]),
        ("empty.owl", "", ["empty.owl"]),
        ("data.ttl", "<urn:a> <urn:b> <urn:c> .", ["is it an ontology?"]),
        ("cut.ttl", HEAD + ":A a owl:Cla", ["cut.ttl", "line 6"]),
        (
            "cut.owl",
            '<?xml version="1.0"?>\n<rdf:RDF xmlns:rdf="urn:x">\n<a',
            ["cut.owl", "line 3"],
        ),
        ("cut.ofn", "Prefix(:=<urn:x#>)\nOntology(<urn:x>\nSubClassOf(:A", ["cut.ofn", "line 3"]),
        ("cut.jsonld", '{"@id": "urn:x",', ["cut.jsonld", "line 1"]),
        ("picture.ttl", "\x89PNG\r\n\x1a\n\x00\x00", ["picture.ttl"]),
        ("page.owl", "<html><body>404</body></html>", ["page.owl"]),
        (
            "page2.owl",
            '<html xmlns="http://www.w3.org/1999/xhtml"><head><title>404</title></head>'
            "<body><p>404</p></body></html>",
            ["is it an ontology?"],
        ),
    ],
)
def test_no_ontology(run: Any, tmp_path: Path, name: str, text: str, words: list[str]) -> None:
    path = tmp_path / name
    path.write_bytes(text.encode("latin-1"))
    refused(run("pitfalls", path), *words)


def test_no_file(run: Any, tmp_path: Path) -> None:
    refused(run("pitfalls", tmp_path / "none.ttl"), "none.ttl", "No such file")
    refused(run("pitfalls", tmp_path), str(tmp_path))
    refused(run("pitfalls", "/dev/zero"), "no file")
    (tmp_path / "loop.ttl").symlink_to(tmp_path / "loop.ttl")
    refused(run("pitfalls", tmp_path / "loop.ttl"), "link")
    path = write(tmp_path, SOUND)
    refused(run("pitfalls", path, "--questions", tmp_path / "none.ttl"), "none.ttl")


def test_a_byte_order_mark_is_no_harm(run: Any, tmp_path: Path) -> None:
    path = tmp_path / "bom.ttl"
    path.write_text(HEAD + SOUND, encoding="utf-8-sig")
    result = run("pitfalls", path, "--format", "json")
    assert result.code == 0
    assert any("byte-order mark" in note for note in json.loads(result.out)["notes"])


def test_an_import_that_is_not_there(run: Any, tmp_path: Path) -> None:
    text = SOUND + "<https://example.org/farm> owl:imports <https://example.org/barn> .\n"
    path = write(tmp_path, text + ":Cow rdfs:subClassOf <https://example.org/barn#Tenant> .")
    refused(run("pitfalls", path), "line 13", "https://example.org/barn", "--lenient-imports")
    for option in (["--lenient-imports"], ["--imports", "ignore"]):
        result = run("pitfalls", path, "--format", "json", *option)
        assert result.code == 0, result.out
        report = json.loads(result.out)
        untyped = next(p for p in report["pitfalls"] if p["code"] == "P34")
        assert untyped["status"] == "not checked"
        assert "https://example.org/barn" in untyped["reason"]
        assert any("https://example.org/barn" in note for note in report["notes"])


def test_imports_that_go_round(run: Any, tmp_path: Path) -> None:
    write(tmp_path, "<urn:b> a owl:Ontology ; owl:imports <urn:a> .", "b.ttl")
    path = write(tmp_path, SOUND + "<urn:a> a owl:Ontology ; owl:imports <urn:b> .", "a.ttl")
    refused(run("pitfalls", path), "circle", "--lenient-imports")
    assert run("pitfalls", path, "--lenient-imports", "--fail-on", "critical").code == 0


def test_findings_of_imports_are_not_ours(run: Any, tmp_path: Path) -> None:
    barn = "<urn:barn> a owl:Ontology . :Barn a owl:Class ; rdfs:subClassOf :Barn ."
    write(tmp_path, barn, "barn.ttl")
    text = SOUND + "<https://example.org/farm> owl:imports <urn:barn> .\n"
    path = write(tmp_path, text + ":Cow rdfs:subClassOf :Barn .")
    result = run("pitfalls", path, "--format", "json")
    assert result.code == 0, result.out
    assert all(not p["affected"] for p in json.loads(result.out)["pitfalls"])


def test_xml_bombs(run: Any, tmp_path: Path) -> None:
    levels = "".join(f'<!ENTITY e{n} "{"".join([f"&e{n - 1};"] * 10)}">' for n in range(1, 10))
    start = f'<?xml version="1.0"?><!DOCTYPE r [<!ENTITY e0 "lol">{levels}'
    for name, text in {
        "bomb.owl": start + "]><rdf:RDF xmlns:rdf='urn:x'>&e9;</rdf:RDF>",
        "outside.owl": '<?xml version="1.0"?><!DOCTYPE r [<!ENTITY e SYSTEM "file:///etc/passwd">]>'
        "<rdf:RDF xmlns:rdf='urn:x'>&e;</rdf:RDF>",
    }.items():
        path = tmp_path / name
        path.write_text(text)
        refused(run("pitfalls", path), name, "entit")


def test_time_limit(run_process: Any, tmp_path: Path) -> None:
    """A file that takes minutes to read ends at the limit, with a message and without a report."""
    classes = "".join(f':C{n} a owl:Class ; rdfs:label "{n}"@en .\n' for n in range(300_000))
    path, out = write(tmp_path, classes), tmp_path / "report.json"
    start = time.monotonic()
    result = run_process("pitfalls", path, "--seconds", 2, "--out", out)
    assert time.monotonic() - start < 60  # it would be far more
    refused(result, "time limit of 2 s")
    assert not out.exists()


def test_a_rule_that_crashes(run: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from symboslam.reasoning.pitfalls.registry import rule

    def crash(*_: object) -> None:
        raise ZeroDivisionError("by zero")

    monkeypatch.setattr(rule("P06"), "check", crash)
    result = run("pitfalls", write(tmp_path, SOUND + CYCLE), "--format", "json")
    assert result.code == 3
    crashed = next(p for p in json.loads(result.out)["pitfalls"] if p["code"] == "P06")
    assert crashed["status"] == "errored"
    assert "ZeroDivisionError" in crashed["reason"]


# How it is used in CI


def steps() -> list[dict[str, Any]]:
    action = yaml.safe_load((ROOT / "action.yml").read_text())
    assert action["runs"]["using"] == "composite"
    listed: list[dict[str, Any]] = action["runs"]["steps"]
    return listed


def action_scan(folder: Path, **inputs: str) -> subprocess.CompletedProcess[str]:
    """Run the scan step of ``action.yml`` as the runner does, without the network."""
    action = yaml.safe_load((ROOT / "action.yml").read_text())
    scan = next(step for step in steps() if step.get("name") == "Scan")
    assert scan["shell"] == "bash"
    values = {name: str(field.get("default", "")) for name, field in action["inputs"].items()}
    values.update({name.replace("_", "-"): value for name, value in inputs.items()})
    environment = {
        name: values[text.removeprefix("${{ inputs.").removesuffix(" }}")]
        for name, text in scan["env"].items()
    }
    script = folder / "step.sh"
    script.write_text(scan["run"])
    binary = Path(sys.executable).parent
    return subprocess.run(
        ["bash", "--noprofile", "--norc", "-eo", "pipefail", str(script)],
        cwd=folder, capture_output=True, text=True, check=False, timeout=120,
        env={"PATH": f"{binary}:/usr/bin:/bin", "GITHUB_STEP_SUMMARY": str(folder / "summary"),
             **environment},
    )  # fmt: skip


@pytest.mark.proof
def test_the_action(tmp_path: Path) -> None:
    (tmp_path / "my ontology").mkdir()
    write(tmp_path, SOUND + CYCLE)
    done = action_scan(tmp_path, files="*.ttl")
    assert done.returncode == 1, done.stderr
    assert "P06" in done.stdout
    assert "P06" in (tmp_path / "summary").read_text()
    sarif = json.loads((tmp_path / "pitfalls.sarif").read_text())
    (critical,) = [r for r in sarif["runs"][0]["results"] if r["ruleId"] == "P06"]
    location = critical["locations"][0]["physicalLocation"]
    assert location["artifactLocation"]["uri"] == "farm.ttl"
    assert location["region"]["startLine"] > 5
    write(tmp_path, SOUND)
    assert action_scan(tmp_path, files="farm.ttl").returncode == 0
    for nothing in ("none.ttl", "", " \n"):
        assert action_scan(tmp_path, files=nothing).returncode == 2
    write(tmp_path / "my ontology", SOUND, "the farm.ttl")
    assert action_scan(tmp_path, files="my ontology/*.ttl\n").returncode == 0
    options = "--ignore P22 --select P06"
    assert action_scan(tmp_path, files="**/the farm.ttl", options=options).returncode == 0


def test_inputs_of_the_action_reach_no_shell_as_code() -> None:
    for step in steps():
        assert "${{" not in step.get("run", "")


def test_the_hook(tmp_path: Path) -> None:
    (hook,) = yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text())
    write(tmp_path, SOUND + CYCLE)
    write(tmp_path, SOUND, "sound.ttl")
    entry = hook["entry"].split()
    command = [str(Path(sys.executable).parent / entry[0]), *entry[1:]]
    bad = subprocess.run([*command, "farm.ttl"], cwd=tmp_path, capture_output=True, check=False)
    good = subprocess.run([*command, "sound.ttl"], cwd=tmp_path, capture_output=True, check=False)
    assert (bad.returncode, good.returncode) == (1, 0)
    assert b"P06" in bad.stdout


def test_the_examples_in_the_document_are_the_files() -> None:
    page = (ROOT / "docs" / "pitfalls.md").read_text()
    assert "symboslam-pitfalls" in page
    for name in yaml.safe_load((ROOT / "action.yml").read_text())["inputs"]:
        assert f"`{name}`" in page
