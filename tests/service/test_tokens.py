"""Queries that are looked at without being parsed."""

import pyoxigraph
import pytest

from symboslam.service.sparql.tokens import (
    DatasetConflictError,
    asks_for,
    has_dataset,
    is_stable,
    tokens,
    undeclared_prefixes,
    with_using,
)

PORT = "<http://127.0.0.1:9/x>"  # a port that Oxigraph never connects to

# Oxigraph runs each of these, or did when this was written.
ASKING = [
    f"SELECT * {{ SERVICE {PORT} {{ ?s ?p ?o }} }}",
    f"select * {{ service silent {PORT} {{ ?s ?p ?o }} }}",
    f"SELECT * {{ ?s ?p 1SERVICE{PORT}{{}} }}",
    f"SELECT * {{ ?s ?p trueSERVICE{PORT}{{}} }}",
    "PREFIX : <http://127.0.0.1:9/> SELECT * { SERVICE:x{} }",
    # "less than b:c", then a comment up to the end of the line; not an IRI and a long string.
    f"PREFIX b: <urn:b> SELECT * {{ FILTER(1<b:c#>'''\n||true) SERVICE {PORT} {{}} #'''\n}}",
    f'PREFIX b: <urn:b> SELECT * {{ FILTER(1<b:c#>"\n||true) SERVICE {PORT} {{}} #"\n}}',
    f"SELECT * {{ SERVICE#comment\n{PORT} {{}} }}",
    f"SELECT * {{ VALUES ?e {{ {PORT} }} SERVICE ?e {{ ?s ?p ?o }} }}",
]
HARMLESS = [
    "SELECT ?service { ?service ?p ?o }",
    "SELECT * { ?s <http://example.org/service#type> 'SERVICE' }",
    "PREFIX ex: <http://example.org/> SELECT * { ?s ex:service ?o } # SERVICE",
    "SELECT * { ?s ?p '''SERVICE { ''' , \"a \\\" SERVICE\" }",
    "SELECT * { ?s ?p 'x'@service }",
    "SELECT * { _:service ?p $service }",
    'SELECT * { ?s ?p ?o FILTER(?o < 3 && ?o > 2) } # a < b, "SERVICE"',
]


@pytest.mark.parametrize("query", ASKING)
def test_service_is_seen(query: str) -> None:
    pyoxigraph_takes_it(query)
    assert asks_for(query, "SERVICE")


@pytest.mark.parametrize("query", HARMLESS)
def test_service_as_a_mere_word_is_not(query: str) -> None:
    pyoxigraph_takes_it(query)
    assert not asks_for(query, "SERVICE")


def pyoxigraph_takes_it(query: str) -> None:
    try:
        list(pyoxigraph.Store().query(query))  # type: ignore[arg-type]
    except (OSError, RuntimeError):
        pass  # it would have asked


def test_doubtful_quotes_are_refused() -> None:
    assert asks_for("SELECT * { ?s <#a> 'SERVICE' }", "SERVICE")
    assert asks_for('SELECT * { ?s ?p "SERVICE }', "SERVICE")


def test_code_points_are_read_as_other_stores_than_oxigraph_do() -> None:
    assert asks_for(r"ASK { \u0053ERV\U00000049CE <http://example.org/> {} }", "SERVICE")
    assert asks_for(r'ASK { ?s ?p "\u0022 . SERVICE <urn:x> {} # " }', "SERVICE")
    assert asks_for(r"ASK { \u005Cu0053ERVICE <http://example.org/> {} }", "SERVICE")
    assert not asks_for(r"ASK { ?s ?p '\u0053ERVICE \u00e4' }", "SERVICE")
    assert asks_for(r"\u004COAD <http://example.org/>", "LOAD")


def test_load_is_seen() -> None:
    assert asks_for("LOAD <http://example.org/>", "LOAD")
    assert asks_for("CLEAR ALL;load silent <file:///etc/passwd>", "LOAD")
    assert not asks_for("INSERT DATA { <urn:load> <urn:p> 'LOAD <x>' }", "LOAD")


def test_dataset() -> None:
    assert has_dataset("ASK FROM NAMED <http://example.org/g> {}")
    assert not has_dataset("SELECT ?from { ?from <http://example.org/FROM> 'FROM' } # FROM")


def test_stable() -> None:
    assert is_stable("SELECT ?now { ?now ?p 'RAND()' }")
    for function in ("now()", "RAND()", "UUID()", "StrUuid()", "BNODE()"):
        assert not is_stable(f"SELECT ({function} AS ?x) {{}}")


def test_undeclared_prefixes() -> None:
    query = "PREFIX a: <urn:a> ASK { a:x b:y _:c FILTER(?x = 'd:e') . ?z a :f, <g:h> }"
    assert undeclared_prefixes(query) == ["b:", ":"]


def test_depth() -> None:
    assert [(t.text, t.depth) for t in tokens("a { b { <c> } '}' } d")] == [
        ("a", 0), ("{", 0), ("b", 1), ("{", 1), ("<c>", 2), ("}", 1), ("'}'", 1), ("}", 0),
        ("d", 0),
    ]  # fmt: skip


G, H = "http://example.org/g", "http://example.org/h"


@pytest.mark.parametrize(
    ("update", "expected"),
    [
        (
            "INSERT { ?s ?p 2 } WHERE { ?s ?p 1 }",
            f"INSERT {{ ?s ?p 2 }} USING <{G}> USING NAMED <{H}> WHERE {{ ?s ?p 1 }}",
        ),
        (
            "CLEAR ALL;\nDELETE WHERE { GRAPH ?g { ?s ?p '}' } } ; DELETE { ?s ?p 1 } WHERE {}",
            "CLEAR ALL;\nDELETE { GRAPH ?g { ?s ?p '}' } } "
            f"USING <{G}> USING NAMED <{H}> WHERE {{ GRAPH ?g {{ ?s ?p '}}' }} }} ; "
            f"DELETE {{ ?s ?p 1 }} USING <{G}> USING NAMED <{H}> WHERE {{}}",
        ),
        ("INSERT DATA { <urn:s> <urn:where> 'WHERE' }", None),
        (
            "DELETE { ?s ?p 1 } WHERE { SELECT ?s WHERE { ?s ?p 1 } }",
            f"DELETE {{ ?s ?p 1 }} USING <{G}> USING NAMED <{H}> "
            "WHERE { SELECT ?s WHERE { ?s ?p 1 } }",
        ),
        ("DELETE WHERE {", f"DELETE USING <{G}> USING NAMED <{H}> WHERE {{"),
    ],
)
def test_using(update: str, expected: str | None) -> None:
    assert with_using(update, (G,), (H,)) == (expected or update)
    assert with_using(update, (), ()) == update


@pytest.mark.parametrize("clause", ["WITH <urn:g> INSERT {}", "INSERT {} USING NAMED <urn:g>"])
def test_using_twice(clause: str) -> None:
    with pytest.raises(DatasetConflictError):
        with_using(f"{clause} WHERE {{}}", (G,), ())
