"""Equivalence over several steps does not depend on how it is written."""

from __future__ import annotations

from itertools import permutations
from pathlib import Path
from typing import Any

import pytest
from rdflib import OWL, URIRef

from symboslam.reasoning.pitfalls.equivalence import Equivalences, stated_inverses
from symboslam.reasoning.pitfalls.model import Status
from symboslam.reasoning.pitfalls.scan import load, scan_pitfalls
from tests.reasoning.pitfalls.conftest import PREFIXES

BASE = "https://example.org/o#"


def ontology(tmp_path: Path, body: str) -> Any:
    path = tmp_path / "ontology.ttl"
    path.write_text(PREFIXES + body)
    return load([path], True, True)


def names(nodes: Any) -> Any:
    return [str(node).removeprefix(BASE) for node in nodes]


@pytest.mark.parametrize(
    ("code", "axiom", "terms", "found"),
    [
        ("P02", "EquivalentClasses", ("A", "B", "C"), [("A", "B"), ("A", "C")]),
        ("P27", "EquivalentObjectProperties", ("p", "m", "q"), [("p", "q")]),
        ("P31", "EquivalentClasses", ("Dog", "Aaa", "Animal"), [("Animal", "Dog")]),
    ],
)
def test_order_in_an_axiom(
    tmp_path: Path, code: str, axiom: str, terms: tuple[str, ...], found: list[tuple[str, str]]
) -> None:
    for order in permutations(terms):
        path = tmp_path / "ontology.ofn"
        path.write_text(
            f"Prefix(:=<{BASE}>)\nOntology(<https://example.org/o>\n"
            "ObjectPropertyDomain(:p :X)\nObjectPropertyDomain(:q :Y)\n"
            f"{axiom}({' '.join(':' + term for term in order)}))\n"
        )
        report = scan_pitfalls([path], codes=[code])
        result = next(r for r in report.results if r.pitfall.code == code)
        if result.status is Status.NOT_CHECKED and "WordNet" in result.reason:
            pytest.skip(result.reason)
        assert [tuple(names(o.finding.elements)) for o in result.occurrences] == found
        assert {o.place.line for o in result.occurrences} == {5}


def test_groups_and_ways(tmp_path: Path) -> None:
    body = (
        ":A owl:equivalentClass :B . :C owl:equivalentClass :B, :D . :X owl:equivalentClass :Y . "
        ":X owl:equivalentClass owl:Thing . :A owl:equivalentClass owl:Thing ."
    )
    known = Equivalences(ontology(tmp_path, body), OWL.equivalentClass)
    assert [names(group) for group in known.groups()] == [["A", "B", "C", "D"], ["X", "Y"]]
    a, b, d, x = (URIRef(BASE + name) for name in "ABDX")
    assert known.together(a, d)
    assert not known.together(a, x)
    steps = known.between(d, a)
    assert [(*names((s,)), *names((o,))) for s, _, o in steps] == [
        ("C", "D"), ("C", "B"), ("A", "B"),
    ]  # fmt: skip
    assert known.between(a, b) == ((a, OWL.equivalentClass, b),)


def test_a_long_way_is_cut_short(tmp_path: Path) -> None:
    body = " ".join(f":C{i:02} owl:equivalentClass :C{i + 1:02} ." for i in range(40))
    known = Equivalences(ontology(tmp_path, body), OWL.equivalentClass)
    steps = known.between(URIRef(BASE + "C40"), URIRef(BASE + "C00"))
    assert names(o for _, _, o in steps) == [f"C{i:02}" for i in range(40, 20, -1)]


def test_stated_inverses(tmp_path: Path) -> None:
    body = (
        ":p owl:inverseOf :q . :r owl:equivalentProperty [ owl:inverseOf :s ] . "
        ":t rdfs:subPropertyOf [ owl:inverseOf :u ] . [ owl:inverseOf :w ] "
        "owl:equivalentProperty :v . :x owl:inverseOf owl:topObjectProperty ."
    )
    found = sorted(stated_inverses(ontology(tmp_path, body)))
    assert [names((one, other)) for one, other, _ in found] == [["p", "q"], ["r", "s"], ["v", "w"]]
    predicates = [axiom[1] for _, _, axiom in found]
    assert predicates == [OWL.inverseOf, OWL.equivalentProperty, OWL.equivalentProperty]


def test_one_finding_for_each_that_differs(scan_text: Any) -> None:
    body = "".join(
        f":p{i} a owl:ObjectProperty ; owl:equivalentProperty :p{i + 1} ; "
        f"rdfs:domain :{'B' if i in (3, 17) else 'A'} .\n"
        for i in range(10, 40)
    )
    report = scan_text(body, codes=["P27"])
    (found,) = next(r for r in report.results if r.pitfall.code == "P27").occurrences
    assert names(found.finding.elements) == ["p10", "p17"]
    assert found.finding.message == (
        "p10 and p17 are stated to be equivalent, but their domains differ (A but B)"
    )
    assert found.place.line == 16  # p16 is equivalent to p17, the last step of the way
    assert len(found.finding.axioms) == 7
