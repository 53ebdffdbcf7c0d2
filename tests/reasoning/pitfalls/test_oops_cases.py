"""A strict scan of OOPS!'s own test data says what OOPS! says, in OOPS!'s RDF.

What each case is about, and OOPS!'s answers, are its regression data (oeg-upm/OOPS, Apache-2.0).
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import NamedTuple

import pytest
from rdflib import RDF, Graph, Namespace, URIRef

from symboslam.reasoning.pitfalls.model import Settings, Status
from symboslam.reasoning.pitfalls.report import render
from symboslam.reasoning.pitfalls.scan import scan_pitfalls

SHARED = Path(os.environ.get("SYMBOSLAM_SHARED", Path(__file__).parents[4] / "shared"))
CASES = SHARED / "data" / "oops-cases"
NAMES = (
    "P02", "P04", "P05", "P07", "P10", "P10-A", "P11", "P13", "P20", "P22M1", "P22M2", "P25",
    "P27", "P29", "P31", "P33", "P35", "P36", "P39", "pizza",
)  # fmt: skip
OOPS = Namespace("http://oops.linkeddata.es/def#")
DEFECTS: dict[str, dict[str, str]] = {}
"""Case -> code -> the defect of OOPS! because of which the answers differ."""


class Answer(NamedTuple):
    """A pitfall in OOPS!'s RDF.

    Attributes:
        importance: ``MINOR`` and so on.
        number: of affected elements, by OOPS!'s count.
        elements: affected elements that are listed one by one.
        groups: others, each with the class of its group.
    """

    importance: str
    number: int
    elements: frozenset[str]
    groups: frozenset[tuple[str, frozenset[str]]]


def answers(graph: Graph) -> dict[str, Answer]:
    """Code and name -> what is said of a pitfall."""
    found = {}
    for pitfall in graph.objects(None, OOPS.hasPitfall):
        affected = {URIRef(str(o)) for o in graph.objects(pitfall, OOPS.hasAffectedElement)}
        kinds = {e: graph.value(e, RDF.type) for e in affected}
        groups = frozenset(
            (str(kind), frozenset(map(str, graph.objects(e, OOPS.hasAffectedElement))))
            for e, kind in kinds.items()
            if kind is not None
        )
        found[str(graph.value(pitfall, OOPS.hasCode))] = Answer(
            str(graph.value(pitfall, OOPS.hasImportanceLevel)),
            int(str(graph.value(pitfall, OOPS.hasNumberAffectedElements))),
            frozenset(str(e) for e, kind in kinds.items() if kind is None),
            groups,
        )
    return found


@pytest.mark.parametrize("name", NAMES)
def test_as_oops(name: str) -> None:
    if not CASES.is_dir():
        pytest.skip("the cases of OOPS! are not there: ../shared/data/oops-cases")
    expected = answers(Graph().parse(CASES / "expected" / f"{name}.ttl", format="turtle"))
    report = scan_pitfalls([CASES / "input" / f"{name}.owl"], Settings(strict_oops=True))
    assert [(r.pitfall.code, r.reason) for r in report.results if r.status is Status.ERRORED] == []
    unread = tuple(r.pitfall.code for r in report.results if "WordNet" in r.reason)
    found = answers(Graph().parse(data=render(report, "oops-rdf"), format="xml"))
    both = [code for code in found | expected if code[:3] not in unread]
    differ = {code for code in both if found.get(code) != expected.get(code)}
    defects = DEFECTS.get(name, {})
    assert {code: (found.get(code), expected.get(code)) for code in differ - {*defects}} == {}
    assert {code for code in defects if code in both and code not in differ} == set()


def test_all_cases_are_tested() -> None:
    if not CASES.is_dir():
        pytest.skip("the cases of OOPS! are not there: ../shared/data/oops-cases")
    assert sorted(NAMES) == sorted(path.stem for path in (CASES / "input").glob("*.owl"))
