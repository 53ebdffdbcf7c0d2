"""Cycles of classes: deep hierarchies, long cycles, and where OOPS! stops without a word."""

from __future__ import annotations

from typing import Any

import pytest
from rdflib import RDFS

from symboslam.reasoning.pitfalls.model import Settings, Status

CHAIN = ":A rdfs:subClassOf :B . :B rdfs:subClassOf :C . :C rdfs:subClassOf :D . :D a owl:Class . "
CYCLE = "\n:X a owl:Class ; rdfs:subClassOf :Y .\n:Y a owl:Class ; rdfs:subClassOf :X .\n"
DECLARED = ":A a owl:Class . :B a owl:Class . :C a owl:Class . "


def p06(report: Any) -> Any:
    return next(r for r in report.results if r.pitfall.code == "P06")


def test_chain_and_cycle(scan_text: Any) -> None:
    body = CHAIN + DECLARED + CYCLE
    ours = p06(scan_text(body, codes=["P06"]))
    assert ours.status is Status.CHECKED
    (found,) = ours.occurrences
    assert found.finding.message == "X below Y below X"
    assert [p for _, p, _ in found.finding.axioms] == [RDFS.subClassOf] * 2
    assert found.place.line == 11

    strict = p06(scan_text(body, Settings(strict_oops=True), codes=["P06"]))
    assert strict.status is Status.NOT_CHECKED
    assert strict.occurrences == ()
    assert strict.reason == (
        "OOPS! itself stops here without saying so: its loop over the superclasses of A fails "
        "because B has superclasses as well"
    )


def test_cycle_alone_is_checked_strictly(scan_text: Any) -> None:
    strict = p06(scan_text(CYCLE, Settings(strict_oops=True), codes=["P06"]))
    assert strict.status is Status.CHECKED
    assert len(strict.occurrences) == 1


def test_shortest_cycle(scan_text: Any) -> None:
    body = (
        ":A a owl:Class ; rdfs:subClassOf :B . :B rdfs:subClassOf :C . "
        ":C rdfs:subClassOf :A, :D . :D rdfs:subClassOf :B ."
    )
    (found,) = p06(scan_text(body, codes=["P06"])).occurrences
    assert found.finding.message == (
        "A below B below C below A; 4 classes in all are below one another"
    )
    assert len(found.finding.axioms) == 3


@pytest.mark.parametrize("length", [4_000, pytest.param(20_000, marks=pytest.mark.slow)])
def test_deep_chain_and_long_cycle(scan_text: Any, length: int) -> None:
    steps = "\n".join(f":C{n:05} rdfs:subClassOf :C{n + 1:05} ." for n in range(length))
    start = ":C00000 a owl:Class .\n"
    chain = p06(scan_text(start + steps, codes=["P06"]))
    assert (chain.status, chain.occurrences) == (Status.CHECKED, ())
    closed = p06(
        scan_text(f"{start}{steps}\n:C{length:05} rdfs:subClassOf :C00000 .", codes=["P06"])
    )
    (found,) = closed.occurrences
    assert len(found.finding.axioms) == length + 1
    assert found.finding.message.endswith(f"C00005 below {length - 5} more below C00000")
