"""A query that is asked again is not parsed again, and is answered as ever."""

from __future__ import annotations

import pytest
from rdflib import Graph, Literal, URIRef
from rdflib.plugins.sparql import prepareQuery

from symboslam.engine.asked_often import AskedOften

DATA = "<urn:a> <urn:p> 1 . <urn:b> <urn:p> 2 ."
QUERY = "SELECT ?value { ?this <urn:p> ?value FILTER(?value < 3) }"


def test_parsed_once_and_answered_alike(monkeypatch: pytest.MonkeyPatch) -> None:
    plain = Graph().parse(data=DATA, format="turtle")
    often = AskedOften(plain)
    parsed: list[str] = []

    def counting(text: str, **options: object) -> object:
        parsed.append(text)
        return prepareQuery(text, **options)  # type: ignore[arg-type]

    monkeypatch.setattr("symboslam.engine.asked_often.prepareQuery", counting)
    for name, value in (("a", 1), ("b", 2), ("a", 1)):
        bound = {"this": URIRef(f"urn:{name}")}
        assert list(often.query(QUERY, initBindings=bound)) == [(Literal(value),)]
        assert list(plain.query(QUERY, initBindings=bound)) == [(Literal(value),)]
    assert list(often.query(QUERY.replace("3", "1"))) == []
    assert parsed == [QUERY, QUERY.replace("3", "1")]


def test_sees_what_is_added_later() -> None:
    plain = Graph().parse(data=DATA, format="turtle")
    often = AskedOften(plain)
    assert len(list(often.query(QUERY))) == 2
    plain.add((URIRef("urn:c"), URIRef("urn:p"), Literal(0)))
    assert len(list(often.query(QUERY))) == 3
    assert len(often) == 3
