"""Formats, places of errors, and files that mean harm."""

from __future__ import annotations

import codecs
from collections.abc import Callable
from pathlib import Path

import pytest
from rdflib import OWL, RDF, BNode, Graph, Literal, URIRef
from rdflib.compare import isomorphic

from symboslam.errors import OntologySyntaxError
from symboslam.reasoning.parsing import parse

PREFIXES = b"""@prefix : <https://example.org/x#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
"""
XML_HEAD = (
    b'<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#"'
    b' xmlns:e="https://example.org/x#">'
)


@pytest.fixture
def town(resource: Callable[[str], Path]) -> Graph:
    graph = Graph()
    graph.parse(resource("town.ttl"))
    return graph


@pytest.mark.parametrize(
    ("language", "name"),
    [
        ("turtle", "town.ttl"),
        ("turtle", "town.owl"),
        ("turtle", "town"),
        ("xml", "town.owl"),
        ("xml", "town.rdf"),
        ("xml", "town.xml"),
        ("nt", "town.nt"),
        ("nt", "town.owl"),
        ("n3", "town.n3"),
        ("json-ld", "town.jsonld"),
        ("json-ld", "town.json"),
        ("json-ld", "town.owl"),
    ],
)
def test_formats(town: Graph, language: str, name: str) -> None:
    data = town.serialize(format=language, encoding="utf-8")
    assert isomorphic(parse(name, data), town)


@pytest.mark.parametrize("name", ["town.ttl", "town.json", "town.ofn", "town.nt", "town.rdf"])
@pytest.mark.parametrize("language", ["turtle", "xml", "nt", "json-ld"])
def test_content_wins_where_it_is_plain(town: Graph, language: str, name: str) -> None:
    data = town.serialize(format=language, encoding="utf-8")
    assert isomorphic(parse(name, data), town)


@pytest.mark.parametrize("name", ["a.ofn", "a.fss", "a.owl", "a.ttl", "a.json", "a.omn"])
def test_functional_syntax(name: str) -> None:
    data = b"# by hand\n\nPrefix(:=<urn:x#>)\nOntology(<urn:x>\nDeclaration(Class(:A)))"
    graph = parse(name, data)
    triple = URIRef("urn:x#A"), RDF.type, OWL.Class
    assert graph.lines[triple] == 5


@pytest.mark.parametrize("name", ["a.ttl", "a.n3", "a.owl"])
def test_turtle_may_begin_with_an_anonymous_node(name: str) -> None:
    assert len(parse(name, b"[ <urn:p> <urn:o> ] .")) == 1


def test_many_comments_take_no_time() -> None:
    assert not parse("a.owl", b"#\n \n" * 200_000)


@pytest.mark.parametrize("language", ["turtle", "xml", "nt", "json-ld"])
def test_anonymous_nodes_of_two_files_stay_apart(town: Graph, language: str) -> None:
    data = town.serialize(format=language, encoding="utf-8")
    both = parse("a.owl", data) + parse("b.owl", data)
    named = [t for t in town if isinstance(t[0], URIRef) and isinstance(t[2], URIRef)]
    literal = [t for t in town if isinstance(t[0], URIRef) and isinstance(t[2], Literal)]
    assert len(both) == 2 * len(town) - len(named) - len(literal)


def test_byte_order_mark(town: Graph) -> None:
    for language in ("turtle", "json-ld", "xml"):
        data = codecs.BOM_UTF8 + town.serialize(format=language, encoding="utf-8")
        assert isomorphic(parse("town.owl", data), town)


def test_owl_xml(resource: Callable[[str], Path]) -> None:
    graph = parse("rooms.owx", resource("rooms.owx").read_bytes())
    stove, strength = URIRef("https://example.org/owx#Stove"), "https://w3id.org/symboslam#strength"
    assert (stove, None, None) in graph
    assert [float(str(o)) for o in graph.objects(None, URIRef(strength))] == [0.75]
    again = graph + parse("rooms.owx", resource("rooms.owx").read_bytes())
    assert len(list(again.objects(None, URIRef(strength)))) == 2
    assert Literal("Stoves are for cooking.", lang="en") in set(graph.objects())


@pytest.mark.parametrize(
    ("name", "data", "message"),
    [
        ("a.ttl", PREFIXES + b":A a owl:Class\n:B a owl:Class .\n", "a.ttl: line 6: "),
        ("a.ttl", PREFIXES + b":A a x:B .\n", 'a.ttl: line 5: Prefix "x:" not bound'),
        ("a.nt", b"<urn:a> <urn:b> <urn:c> .\nfoo bar .\n", "a.nt: line 2: "),
        ("a.rdf", XML_HEAD + b"\n<e:A>\n</rdf:RDF>", "a.rdf: line 3: mismatched tag"),
        ("a.rdf", XML_HEAD + b'\n<e:A rdf:ID="1 2"/>\n</rdf:RDF>', "a.rdf: line 2: rdf:ID"),
        ("a.rdf", b"<?xml version='1.0'?>\n", "a.rdf: line 2: no element found"),
        ("a.jsonld", b'{"@id": "urn:a",\n  "b" 1}', "a.jsonld: line 2: "),
        ("a.ttl", b"# fine\n# \xff\n", "a.ttl: line 2: it is not UTF-8"),
        ("a.owl", b"Prefix(:=<urn:a>)\nOntology(", "a.owl: line 2: the file ends in the middle"),
        ("a.owl", b"Prefix: : <urn:a>\nOntology: <urn:b>", "Manchester syntax is not supported"),
        ("a.omn", b"", "Manchester syntax is not supported"),
        ("a.obo", b"format-version: 1.2", "OBO format is not supported"),
        ("a.ttl", PREFIXES + b"<urn:a b> a owl:Class .", "<urn:a b> is not an IRI"),
        (
            "a.owx",
            b'<Ontology xmlns="http://www.w3.org/2002/07/owl#" ontologyIRI="urn:a">\n'
            b'<Declaration><Class abbreviatedIRI="x:A"/></Declaration></Ontology>',
            "a.owx: line 2: the prefix x: is not declared",
        ),
        ("a.png", b"\x89PNG\r\n\x1a\n\x00\x00", "a.png: line 1: it is not UTF-8"),
    ],
)
def test_errors_name_file_and_line(name: str, data: bytes, message: str) -> None:
    with pytest.raises(OntologySyntaxError) as caught:
        parse(name, data)
    assert message in str(caught.value)
    assert str(caught.value).startswith(name)


@pytest.mark.parametrize("name", ["invalid_syntax.ttl", "invalid_syntax.owl"])
def test_invalid_files(resource: Callable[[str], Path], name: str) -> None:
    with pytest.raises(OntologySyntaxError, match=r"line \d"):
        parse(name, resource(name).read_bytes())


@pytest.mark.parametrize(
    "declaration",
    [
        b'<!ENTITY x SYSTEM "%s">',
        b'<!ENTITY %% p SYSTEM "%s"> %%p;',
        b'<!ENTITY x PUBLIC "y" "%s">',
    ],
)
def test_external_entities_are_refused(tmp_path: Path, declaration: bytes) -> None:
    secret = tmp_path / "secret.txt"
    secret.write_text("the secret")
    data = (
        b"<!DOCTYPE r [\n" + declaration % secret.as_uri().encode() + b"]>\n" + XML_HEAD
        + b'<e:A rdf:about="urn:a"><e:p>&x;</e:p></e:A></rdf:RDF>'
    )  # fmt: skip
    with pytest.raises(OntologySyntaxError, match="line 2: the external XML entity") as caught:
        parse("a.owl", data)
    assert "the secret" not in str(caught.value)


def test_external_document_type_is_not_fetched(tmp_path: Path) -> None:
    secret = tmp_path / "a.dtd"
    secret.write_text('<!ENTITY x "the secret">')
    data = (
        b'<!DOCTYPE r SYSTEM "' + secret.as_uri().encode() + b'">' + XML_HEAD
        + b'<e:A rdf:about="urn:a"><e:p>&x;</e:p></e:A></rdf:RDF>'
    )  # fmt: skip
    assert "the secret" not in parse("a.owl", data).serialize()


@pytest.mark.parametrize("where", [b"<e:p>&l9;</e:p>", b'<e:p rdf:resource="&l9;"/>'])
def test_billion_laughs(where: bytes) -> None:
    entities = b'<!ENTITY l0 "lololololol">' + b"".join(
        b'<!ENTITY l%d "%s">' % (i, b"&l%d;" % (i - 1) * 10) for i in range(1, 10)
    )
    data = (
        b"<!DOCTYPE r [" + entities + b"]>" + XML_HEAD
        + b'<e:A rdf:about="urn:a">' + where + b"</e:A></rdf:RDF>"
    )  # fmt: skip
    with pytest.raises(OntologySyntaxError, match=r"explode|amplification"):
        parse("a.owl", data)


def test_many_large_entities() -> None:
    entity = b'<!ENTITY x "%s">' % (b"x" * 100_000)
    data = (
        b"<!DOCTYPE r [" + entity + b"]>" + XML_HEAD
        + b'<e:A rdf:about="urn:a"><e:p>' + b"&x;" * 10_000 + b"</e:p></e:A></rdf:RDF>"
    )  # fmt: skip
    with pytest.raises(OntologySyntaxError, match=r"explode|amplification"):
        parse("a.owl", data)


def test_usual_entities_are_read() -> None:
    """Protégé declares namespaces as entities."""
    data = (
        b'<?xml version="1.0"?>\n<!DOCTYPE rdf:RDF [ <!ENTITY x "https://example.org/x#" > ]>\n'
        + XML_HEAD + b'<e:A rdf:about="&x;a"/></rdf:RDF>'
    )  # fmt: skip
    assert (URIRef("https://example.org/x#a"), None, None) in parse("a.owl", data)


@pytest.mark.parametrize(
    "context",
    [
        b'"https://example.org/context"',
        b'[{}, "https://example.org/context"]',
        b'{"@import": "https://example.org/context"}',
    ],
)
@pytest.mark.parametrize("frame", [b'{"@context": %s}', b'{"@graph": [{"@context": %s}]}'])
def test_remote_contexts_are_not_fetched(context: bytes, frame: bytes) -> None:
    with pytest.raises(OntologySyntaxError, match="remote JSON-LD context"):
        parse("a.jsonld", frame % context)


@pytest.mark.parametrize(
    "data",
    [
        PREFIXES + b":A rdfs:subClassOf " + b"[ :p " * 3000 + b":B" + b"]" * 3000 + b" .",
        PREFIXES + b":A rdfs:subClassOf " + b"(" * 3000 + b")" * 3000 + b" .",
    ],
)
def test_deep_turtle(data: bytes) -> None:
    with pytest.raises(OntologySyntaxError, match="nested too deeply"):
        parse("a.ttl", data)


def test_deep_json() -> None:
    with pytest.raises(OntologySyntaxError, match="nested too deeply"):
        parse("a.jsonld", b'{"a":' * 5000 + b"1" + b"}" * 5000)


def test_deep_chain_of_triples() -> None:
    step = b"_:n%d <http://www.w3.org/2002/07/owl#complementOf> _:n%d ."
    lines = (step % (i, i + 1) for i in range(5000))
    with pytest.raises(OntologySyntaxError, match="nested too deeply"):
        parse("a.nt", b"\n".join(lines))


def test_anonymous_individuals_may_be_linked_as_they_like() -> None:
    lines = (b"_:n%d <urn:p> _:n%d ." % (i, i + 1) for i in range(5000))
    assert len(parse("a.nt", b"\n".join(lines))) == 5000
    data = PREFIXES + b"_:a :knows _:b . _:b :knows _:a . _:c :knows _:c ."
    assert len(parse("a.ttl", data)) == 3


def test_odd_values_are_kept_in_silence(capfd: pytest.CaptureFixture[str]) -> None:
    data = PREFIXES + b':a :p "2020-13-45"^^<http://www.w3.org/2001/XMLSchema#date> , "x" .'
    assert len(parse("a.ttl", data)) == 2
    assert capfd.readouterr() == ("", "")


def test_the_line_of_what_is_no_iri() -> None:
    with pytest.raises(OntologySyntaxError, match=r"line 7: .* is not an IRI"):
        parse("a.ttl", PREFIXES + b"\n:a\n  :p <urn:a\x01b> .")


def test_long_lists_are_fine() -> None:
    members = b" ".join(b":C%d" % i for i in range(3000))
    data = PREFIXES + b"[] a owl:AllDisjointClasses ; owl:members ( " + members + b" ) ."
    assert len(parse("a.ttl", data)) == 6002


def test_endless_list() -> None:
    data = PREFIXES + (
        b":A rdfs:subClassOf _:x . _:x owl:intersectionOf _:l . _:l rdf:first :A ; rdf:rest _:l ."
    )
    with pytest.raises(OntologySyntaxError, match="contains itself"):
        parse("a.ttl", data)


def test_endless_expression() -> None:
    data = (
        PREFIXES + b":A rdfs:subClassOf _:x . _:x owl:complementOf _:y . _:y owl:complementOf _:x ."
    )
    with pytest.raises(OntologySyntaxError, match="contains itself"):
        parse("a.ttl", data)


def test_line_of_an_error_after_steps_back() -> None:
    """rdflib's parser counts a line again whenever it steps back over it."""
    blank = b"# words\n" * 40
    data = (
        b"@prefix : <urn:x#> .\n:a :b :c ;\n\n\n  :d ( :e\n\n :f ) .\n"
        + blank
        + b":a :b ;;; nonsense .\n"
    )
    with pytest.raises(OntologySyntaxError, match=r"a\.ttl: line 48: "):
        parse("a.ttl", data)


@pytest.mark.parametrize(
    "end", ["@@", ":b :c (1 2", ':b :c "text', ":b :c [ :d", ":b", ":b :c <urn:x"]
)
def test_truncated_turtle_has_a_line(end: str) -> None:
    data = f"@prefix : <urn:x#> .\n:a :b :c .\n:a {end}\n".encode()
    with pytest.raises(OntologySyntaxError, match=r"a\.ttl: line [23]: \w") as caught:
        parse("a.ttl", data)
    assert "index out of range" not in str(caught.value)


JSON_LD = b"""{
  "@context": {"e": "urn:e#", "owl": "http://www.w3.org/2002/07/owl#", "@base": "http://b.org/x",
    "sub": {"@id": "http://www.w3.org/2000/01/rdf-schema#subClassOf", "@type": "@id"}, "id": "@id"},
  "@graph": [
    {"@type": "owl:Class", "sub": [{"@id": "urn:e#B"}, {"@type": "owl:Restriction"}],
     "@id": "urn:e#A"},
    {
      "@id": "urn:e#B", "@type": "owl:Class",
      "sub": {"@id": "_:b", "@type": "owl:Class"}},
    {"id": "y", "@type": "owl:Class",
     "sub": "urn:e#C"}
  ]
}"""


def test_lines_of_json_ld() -> None:
    graph = parse("a.jsonld", JSON_LD)
    lines = sorted((str(s), graph.lines[s, p, o]) for s, p, o in graph if isinstance(s, URIRef))
    assert lines == [
        ("http://b.org/y", 10), ("http://b.org/y", 11),
        ("urn:e#A", 5), ("urn:e#A", 5), ("urn:e#A", 6),  # a value without place: that of "@id"
        ("urn:e#B", 8), ("urn:e#B", 8),
    ]  # fmt: skip
    assert sorted(graph.lines[t] for t in graph if isinstance(t[0], BNode)) == [5, 9]


def test_prefixes_of_json_ld() -> None:
    data = b"""{"@context": {"e": "http://e.org/"}, "@graph": [
      {"@id": "e:A", "@type": "e:T"},
      {"@context": {"f": "http://f.org/"}, "@id": "f:A", "@type": "e:T"},
      {"@context": {"g": "http://g.org/"}, "@id": "g:A", "@type": "e:T"},
      {"@context": {"g": "http://h.org/"}, "@id": "g:A", "@type": "e:T"}]}"""
    graph = parse("a.jsonld", data)
    assert {str(s): graph.lines.get((s, p, o)) for s, p, o in graph} == {
        "http://e.org/A": 2,
        "http://f.org/A": 3,
        "http://g.org/A": None,  # one prefix, two meanings: who knows
        "http://h.org/A": None,
    }


def test_lines_of_expanded_json_ld(town: Graph) -> None:
    graph = parse("a.jsonld", town.serialize(format="json-ld", encoding="utf-8"))
    assert not [t for t in graph if t not in graph.lines]
    text = town.serialize(format="json-ld").splitlines()
    for (s, _, o), line in graph.lines.items():
        assert not isinstance(s, URIRef) or any(str(t) in text[line - 1] for t in (s, o))
