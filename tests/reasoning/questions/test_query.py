"""Queries: what is refused, which terms they look for, whether order counts."""

from __future__ import annotations

from pathlib import Path

import pytest

from symboslam.errors import InputError
from symboslam.reasoning.questions.manifest import default_manifest, load_manifest
from symboslam.reasoning.questions.model import Query
from symboslam.reasoning.questions.query import (
    _names,
    check_syntax,
    close_to,
    is_ordered,
    prefixes_of,
    terms_of,
    unknown_terms,
)

X = "https://example.org/x#"
HEAD = f"PREFIX : <{X}> PREFIX geof: <http://www.opengis.net/def/function/geosparql/>\n"


def query(text: str, line: int = 1) -> Query:
    return Query(HEAD + text, Path("asked.rq"), line)


def names(text: str) -> set[str]:
    found = terms_of(query(text))
    assert found is not None
    return {name.removeprefix(X) for name in found}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("SELECT ?x {\n ?x a :C ", "asked.rq: line 3: it is not SPARQL: "),
        ("ASK {\n\n ?x foo:bar 1 }", "asked.rq: line 4: the prefix foo: is not declared (foo:bar)"),
        ("SELEC ?x {}", "asked.rq: line 2: it is not SPARQL: "),
        ("SELECT ?x {} ?y", "asked.rq: line 2: it is not SPARQL: "),
        ("INSERT DATA { :a :b :c }", "asked.rq: line 2: it is not SPARQL: "),
        ("", "asked.rq: line 2: it is not SPARQL: "),
        ("ASK { ?s :p 'foo:bar',\n x: }", "asked.rq: line 3: the prefix x: is not declared (x:)"),
        (
            "SELECT * {\n service <https://example.org/sparql> { ?s ?p ?o } }",
            "asked.rq: line 3: SERVICE asks another server",
        ),
    ],
)
def test_refused(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        check_syntax(query(text))
    assert str(caught.value).startswith(message)
    assert "\n" not in str(caught.value)


def test_lines_count_from_where_the_query_starts() -> None:
    with pytest.raises(InputError, match=r"^asked\.rq: line 42: "):
        check_syntax(query("ASK { ?x foo:bar 1 }", line=41))


@pytest.mark.parametrize(
    "text",
    [
        "ASK { ?x :says 'SERVICE <x>' } # SERVICE",
        "ASK { ?service :SERVICE ?x . ?x :p <https://example.org/service> }",
        "PREFIX geo: <http://www.opengis.net/ont/geosparql#> "
        "ASK { ?x geo:asWKT ?w FILTER(geof:sfWithin(?w, ?w)) }",
    ],
)
def test_accepted(text: str) -> None:
    check_syntax(query(text))


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("SELECT * { ?x a :C ; :p :i , 'text'^^:dt }", {"C", "p", "i"}),
        ("SELECT * { ?x :a/^:b*|:d|!(:c) ?y . ?x (:e|:f)+ ?z }", set("abcdef")),
        ("SELECT * { VALUES (?x ?y) { (:a UNDEF) (:b 3) } }", {"a", "b"}),
        ("SELECT * { GRAPH :g { ?s :p ?o } }", {"g", "p"}),
        ("SELECT * { ?s :p ?o FILTER(?o IN (:a, :b) || ?s != :c || :d = ?o) }", set("pabcd")),
        ("SELECT * { ?s :p ?o FILTER(geof:distance(?o, ?o, :unit) < 3) }", {"p"}),
        ("SELECT * { ?s :p ?o FILTER(datatype(?o) = :dt) }", {"p"}),
        ("SELECT * { ?s :p ?o FILTER NOT EXISTS { ?s :q :a } }", set("pqa")),
        (
            "SELECT * { ?s :p ?o FILTER EXISTS { VALUES ?s { :a } GRAPH :g { ?s :q 1 } } }",
            set("pqag"),
        ),
        ("SELECT * { ?s :p ?o OPTIONAL { ?s :q ?a } MINUS { ?s :r ?b } }", set("pqr")),
        ("SELECT * { { ?s :p ?o } UNION { SELECT ?s { ?s :q ?o } } }", set("pq")),
        ("SELECT (COUNT(?s) AS ?n) { ?s :p ?o BIND(:made AS ?m) } GROUP BY ?o", {"p"}),
        ("CONSTRUCT { ?s :made :up } WHERE { ?s :p ?o }", {"p"}),
        ("DESCRIBE :a", {"a"}),
        ("ASK { ?s rdf:type owl:Class ; rdfs:label ?l }", set()),
    ],
)
def test_terms(text: str, expected: set[str]) -> None:
    common = (
        "PREFIX owl: <http://www.w3.org/2002/07/owl#> "
        "PREFIX rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> "
        "PREFIX rdfs: <http://www.w3.org/2000/01/rdf-schema#> "
    )
    assert names(common + text) == expected
    # The quick look sees at least what the thorough one sees.
    assert {X + name for name in expected} <= set(_names(query(common + text)))


def test_the_quick_look_never_misses_a_term() -> None:
    """On all queries of the project, and on odd spellings."""
    asked = [q.query for q in load_manifest(default_manifest()) if q.query]
    assert len(asked) > 80
    odd = [
        "SELECT*{?s :p ?o;:q :r}",
        "ASK { ?s :p ?o . _:b :q 'a:b'@en,:r }",
        "ASK { ?s :a%20b :c\\,d ; :e.f :g. }",
        "ASK { ?s :p ?o FILTER(?o<3 && 4>?o || ?o = :a) }",
        'ASK { ?s :p """a \\""" :no <no>""" , :q }',
        "ASK { ?s :p 'it' , :q # :no <no> ' \n , :r }",
    ]
    for one in [*asked, *map(query, odd)]:
        found = terms_of(one)
        assert found is not None, one.text
        assert found <= set(_names(one)), one.text


def test_unknown_terms() -> None:
    asked = query("SELECT * { ?s :p :a FILTER(geof:sfWithin(?s, :b)) }")
    assert unknown_terms(asked, {X + "p", X + "a"}) == []
    assert unknown_terms(asked, {X + "p"}) == [X + "a"]
    relative = Query("BASE <https://example.org/> ASK { ?s <x#p> <x#a> }", Path("asked.rq"))
    assert unknown_terms(relative, {X + "p"}) == [X + "a"]


def test_close_to() -> None:
    known = [X + "Residential", X + "residentialZone", "https://example.org/other/residential"]
    close = ["https://example.org/other/residential", X + "Residential", X + "residentialZone"]
    assert close_to(X + "Residental", known) == close
    assert close_to(X + "Zebra", known) == []


@pytest.mark.parametrize(
    ("text", "ordered"),
    [
        ("SELECT ?x { ?x :p ?y } ORDER BY ?y", True),
        ("SELECT ?x { ?x :p ?y } order\n by DESC(?y) LIMIT 3", True),
        ("SELECT ?x { ?x :p ?y } ORDER BY ?y VALUES ?x { :a }", True),
        ("SELECT ?x { { SELECT ?x { ?x :p ?y } ORDER BY ?y LIMIT 1 } }", False),
        ("SELECT ?x { ?x :p 'ORDER BY' } # ORDER BY ?x", False),
        ("SELECT ?x { ?x :p '}' } LIMIT 2", False),
    ],
)
def test_order(text: str, ordered: bool) -> None:
    assert is_ordered(query(text)) is ordered


def test_prefixes() -> None:
    text = f"# PREFIX : <{X}wrong#>\nPREFIX e: <https://example.org/> ASK {{}}"
    found = prefixes_of(Query(f"PREFIX : <{X}>\n{text}", Path("asked.rq"), prefixes=(("z", X),)))
    assert found == {"": X, "e": "https://example.org/", "z": X}
