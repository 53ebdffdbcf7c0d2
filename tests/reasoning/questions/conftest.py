"""What the tests of competency questions share."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from symboslam.reasoning.questions.manifest import load_manifest
from symboslam.reasoning.questions.model import Question

QUESTIONS = Path(__file__).parents[2] / "resources" / "questions"

PREFIXES = """@prefix owlunit: <https://w3id.org/OWLunit/ontology/> .
@prefix dcterms: <http://purl.org/dc/terms/> .
@prefix owl:     <http://www.w3.org/2002/07/owl#> .
@prefix rdfs:    <http://www.w3.org/2000/01/rdf-schema#> .
@prefix sl:      <https://w3id.org/symboslam#> .
@prefix sd:      <http://www.w3.org/ns/sparql-service-description#> .
@prefix ent:     <http://www.w3.org/ns/entailment/> .
@prefix rs:      <http://www.w3.org/2001/sw/DataAccess/tests/result-set#> .
@prefix :        <https://example.org/x#> .
"""
"""Nine lines; what a test writes starts on line 10."""

Write = Callable[..., Path]
Load = Callable[..., list[Question]]


@pytest.fixture
def prefixes() -> str:
    """The prefixes that ``load`` puts before a manifest."""
    return PREFIXES


@pytest.fixture
def farm() -> Path:
    """The folder of the small ontology about a farm."""
    return QUESTIONS / "farm"


@pytest.fixture
def write(tmp_path: Path) -> Write:
    """Write files into one folder; returns the last one."""

    def call(**files: str) -> Path:
        path = tmp_path
        for name, text in files.items():
            stem, _, ending = name.rpartition("_")
            path = tmp_path / f"{stem}.{ending}"
            path.write_text(text, encoding="utf-8")
        return path

    return call


@pytest.fixture
def load(write: Write) -> Load:
    """The questions of a manifest made of prefixes and ``text``, beside other files."""

    def call(text: str, **files: str) -> list[Question]:
        write(**files)
        return load_manifest(write(manifest_ttl=PREFIXES + text))

    return call
