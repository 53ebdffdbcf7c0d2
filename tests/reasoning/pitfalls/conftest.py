"""What the tests of the pitfall scanner share: small ontologies, and the cases in ``cases``."""

from __future__ import annotations

import runpy
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

import pytest

from symboslam.reasoning.pitfalls.model import Report, Result, Settings
from symboslam.reasoning.pitfalls.scan import scan_pitfalls

CASES = Path(__file__).parent / "cases"

PREFIXES = """@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix skos: <http://www.w3.org/2004/02/skos/core#> .
@prefix dcterms: <http://purl.org/dc/terms/> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
@prefix sl: <https://w3id.org/symboslam#> .
@prefix : <https://example.org/o#> .
<https://example.org/o> a owl:Ontology .
"""
"""Nine lines; what a case states starts on line 10."""


class Case(NamedTuple):
    """An ontology with or without a pitfall.

    Attributes:
        code: of the pitfall.
        name: what is special about it.
        body: its statements in Turtle, after ``PREFIXES``.
        affected: the elements of each finding, by their local names.
        settings: how it is scanned.
    """

    code: str
    name: str
    body: str
    affected: frozenset[tuple[str, ...]]
    settings: Settings = Settings()


def cases() -> list[Case]:
    """All cases: POSITIVE, NEGATIVE and STRICT of the files in ``cases``.

    POSITIVE is name -> (body, list of the findings' elements), NEGATIVE is name -> body, STRICT is
    as POSITIVE and is scanned by OOPS!'s rules; OPTIONS is name -> other settings.
    """
    found = []
    for path in sorted(CASES.glob("p*.py")):
        code, module = path.stem.upper(), runpy.run_path(str(path))
        options: dict[str, dict[str, Any]] = module.get("OPTIONS", {})
        listed = {
            **module["POSITIVE"],
            **{name: (body, []) for name, body in module["NEGATIVE"].items()},
            **module.get("STRICT", {}),
        }
        for name, (body, affected) in listed.items():
            strict = name in module.get("STRICT", {})
            settings = Settings(strict_oops=strict, **options.get(name, {}))
            elements = frozenset(tuple(one) for one in affected)
            found.append(Case(code, name, body, elements, settings))
    return found


Scan = Callable[..., Report]


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    """A test with the argument ``case`` runs once for each case."""
    if "case" in metafunc.fixturenames:
        listed = cases()
        metafunc.parametrize("case", listed, ids=[f"{c.code}-{c.name}" for c in listed])


@pytest.fixture(scope="session")
def all_cases() -> Callable[[], list[Case]]:
    """All cases, read once."""
    return cache(cases)


@pytest.fixture
def scan_text(tmp_path: Path) -> Scan:
    """Scan a text after ``PREFIXES``."""

    def call(body: str, settings: Settings | None = None, **options: Any) -> Report:
        path = tmp_path / "ontology.ttl"
        path.write_text(PREFIXES + body, encoding="utf-8")
        return scan_pitfalls([path], settings, **options)

    return call


@pytest.fixture
def affected() -> Callable[[Result], frozenset[tuple[str, ...]]]:
    """The elements of each finding of a result, by their local names."""

    def call(result: Result) -> frozenset[tuple[str, ...]]:
        return frozenset(
            tuple(e.rpartition("#")[2] for e in o.finding.elements) for o in result.occurrences
        )

    return call
