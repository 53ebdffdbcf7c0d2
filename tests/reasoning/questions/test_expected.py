"""Expected answers in each format, and what is wrong with bad ones."""

from __future__ import annotations

from pathlib import Path

import pytest
from pyoxigraph import Literal, NamedNode

from symboslam.errors import InputError
from symboslam.reasoning.questions.compare import difference
from symboslam.reasoning.questions.expected import parse_literal, read_expected
from symboslam.reasoning.questions.model import Table, Triples

A = NamedNode("https://example.org/a")
DECIMAL = NamedNode("http://www.w3.org/2001/XMLSchema#decimal")
ROWS = Table(
    ("what", "how"), ((A, Literal("0.9", datatype=DECIMAL)), (Literal("two", language="en"), None))
)
JSON = """{"head": {"vars": ["what", "how"]}, "results": {"bindings": [
 {"what": {"type": "uri", "value": "https://example.org/a"},
  "how": {"type": "literal", "value": "0.9", "datatype": "http://www.w3.org/2001/XMLSchema#decimal"}},
 {"what": {"type": "literal", "value": "two", "xml:lang": "en"}}]}}"""
XML = """<?xml version="1.0"?>
<sparql xmlns="http://www.w3.org/2005/sparql-results#">
<head><variable name="what"/><variable name="how"/></head><results>
<result><binding name="what"><uri>https://example.org/a</uri></binding>
<binding name="how"><literal datatype="http://www.w3.org/2001/XMLSchema#decimal">0.9</literal></binding>
</result><result><binding name="what"><literal xml:lang="en">two</literal></binding></result>
</results></sparql>"""
TSV = '?what\t?how\n<https://example.org/a>\t0.9\n"two"@en\t\n'
CSV = "what,how\nhttps://example.org/a,0.90\ntwo,\n"
RS = """@prefix rs: <http://www.w3.org/2001/sw/DataAccess/tests/result-set#> .
[] a rs:ResultSet ; rs:resultVariable "what" , "how" ; rs:solution
  [ rs:index 2 ; rs:binding [ rs:variable "what" ; rs:value "two"@en ] ] ,
  [ rs:index 1 ; rs:binding [ rs:variable "what" ; rs:value <https://example.org/a> ] ,
                            [ rs:variable "how" ; rs:value 0.9 ] ] .
"""


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("e.srj", JSON), ("e.json", JSON), ("e.srx", XML), ("e.tsv", TSV), ("e.ttl", RS),
        ("e.tsv", TSV.replace("\n", "\r\n")), ("e.tsv", TSV.rstrip("\n") + "\n\n"),
        ("e.csv", CSV), ("e.csv", "\ufeff" + CSV.replace("\n", "\r\n")), ("e.tsv", "\ufeff" + TSV),
    ],
)  # fmt: skip
def test_formats(tmp_path: Path, name: str, text: str) -> None:
    path = tmp_path / name
    path.write_bytes(text.encode())
    found = read_expected(path)
    assert isinstance(found, Table)
    assert found.lexical == (path.suffix == ".csv")
    # The order of rows is kept (rs:index says it); that of columns does not matter.
    assert not difference(found, ROWS, ordered=True)


def test_csv_quotes(tmp_path: Path) -> None:
    path = tmp_path / "e.csv"
    path.write_text('a\n"one, ""two""\nthree"\n')
    found = read_expected(path)
    assert found == Table(("a",), ((Literal('one, "two"\nthree'),),), lexical=True)


@pytest.mark.parametrize("text", ["true", " true\n", "1", '{"head": {}, "boolean": true}'])
def test_yes_in_a_manifest(text: str) -> None:
    assert parse_literal(text, Path("m.ttl"), 1) is True


def test_no(tmp_path: Path) -> None:
    assert parse_literal("false", Path("m.ttl"), 1) is False
    path = tmp_path / "no.srx"
    path.write_text(
        '<sparql xmlns="http://www.w3.org/2005/sparql-results#"><head/>'
        "<boolean>false</boolean></sparql>"
    )
    assert read_expected(path) is False
    path = tmp_path / "no.ttl"
    path.write_text(RS.partition("\n")[0] + "\n[] a rs:ResultSet ; rs:boolean false .")
    assert read_expected(path) is False


def test_a_graph(tmp_path: Path) -> None:
    path = tmp_path / "g.ttl"
    path.write_text("<https://example.org/a> <https://example.org/b> [] , 1 .")
    found = read_expected(path)
    assert isinstance(found, Triples)
    assert len(found.triples) == 2


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("e.srj", '{"head": {},\n "results" }', "e.srj: line 2: "),
        ("e.srj", "[]", "e.srj: line 1: "),
        ("e.srx", "<sparql>\n<head>", "e.srx: line "),
        ("e.srx", '<?xml version="1.0"?>\n<!DOCTYPE x [<!ENTITY e SYSTEM "file:///etc/passwd">]>',
         "e.srx: line 2: a document type has no place in an answer"),
        ("e.tsv", "?a\t?b\n1\t2\n3\n", "e.tsv: line 3: 1 cells where the header has 2 columns"),
        ("e.tsv", "?a\nsl:House\n", "e.tsv: line 2: "),
        ("e.csv", "a,b\n1,2\n1,2,3\n", "e.csv: line 3: 3 cells where the header has 2 columns"),
        ("e.csv", "", "e.csv: line 1: there is no header"),
        ("e.csv", 'a\n"open\n', "e.csv: line 2: "),
        ("e.ttl", "<a> <b>\n c .", "e.ttl: line 2: "),
        ("e.ttl", RS.replace("rs:value 0.9", "rs:valeu 0.9"), "e.ttl: a binding of the result set"),
        ("e.doc", "", "e.doc: .doc is no known answer format; known: .srj"),
    ],
)  # fmt: skip
def test_bad_files(tmp_path: Path, name: str, text: str, message: str) -> None:
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(InputError) as caught:
        read_expected(path)
    assert str(caught.value).removeprefix(f"{tmp_path}/").startswith(message), str(caught.value)


def test_bad_literal() -> None:
    with pytest.raises(InputError, match=r"^m\.ttl: line 7: .* neither true, false, SPARQL JSON"):
        parse_literal("yes", Path("m.ttl"), 7)
    with pytest.raises(InputError, match=r"^m\.ttl: line 8: "):
        parse_literal('{"head":\n oops}', Path("m.ttl"), 7)


def test_missing(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="No such file"):
        read_expected(tmp_path / "e.tsv")
