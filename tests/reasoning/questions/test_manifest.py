"""Manifests in Turtle: what they can say, and how bad ones are refused."""

from __future__ import annotations

import gzip
from collections.abc import Callable
from pathlib import Path

import pytest
from pyoxigraph import Literal

from symboslam.errors import InputError
from symboslam.reasoning.questions import model
from symboslam.reasoning.questions import vocabulary as v
from symboslam.reasoning.questions.manifest import default_manifest, load_manifest
from symboslam.reasoning.questions.model import Question, Table
from symboslam.reasoning.questions.rdf import read_quads

Load = Callable[..., list[Question]]
OWLUNIT = Path(__file__).parents[2] / "resources" / "questions" / "owlunit"
ASK = 'owlunit:hasSPARQLUnitTest "ASK { ?s ?p ?o }"'


def test_everything_that_a_question_can_say(load: Load, tmp_path: Path) -> None:
    (found,) = load(
        """<#q1> a owlunit:CompetencyQuestionVerification ;
    dcterms:identifier "one" ;
    owlunit:hasCompetencyQuestion "Was ist da?"@de , "What is there?"@en ;
    dcterms:subject "things" ;
    owlunit:hasSPARQLUnitTest <ask.rq> ;
    owlunit:hasExpectedResult <answer.csv> ;
    owlunit:hasInputData <data.ttl> , <more.nt> ;
    owlunit:testsOntology <own.ttl> , <https://w3id.org/symboslam/core> ;
    sd:entailmentRegime ent:RDFS ;
    sl:comparesColumn "s" , "?p" ;
    sl:knownFailing "not yet" .
""",
        ask_rq="SELECT * { ?s ?p ?o }",
        answer_csv="s,p\na,b\n",
        data_ttl="",
        more_nt="",
        own_ttl="",
    )
    assert found.id == "one"
    assert found.text == "What is there?"
    assert found.kind == model.QUESTION
    assert found.group == "things"
    assert found.query is not None
    assert found.query.file.name == "ask.rq"
    assert found.expected == Table(("s", "p"), ((Literal("a"), Literal("b")),), lexical=True)
    assert found.data == (tmp_path / "data.ttl", tmp_path / "more.nt")
    assert found.ontologies == (tmp_path / "own.ttl", "https://w3id.org/symboslam/core")
    assert found.regime == v.RDFS_REGIME
    assert found.columns == ("s", "p")
    assert found.known_failing == "not yet"
    assert (found.manifest.name, found.line) == ("manifest.ttl", 10)
    assert not found.needs_reasoner


def test_what_the_manifest_says_holds_for_its_questions(load: Load, tmp_path: Path) -> None:
    one, two, three = load(
        f"""<> owlunit:hasInputData <a.ttl> ; dcterms:subject "all" ; sd:entailmentRegime ent:RDFS .
<#one> a owlunit:CompetencyQuestionVerification ; {ASK} .
<#two> a owlunit:CompetencyQuestionVerification ; {ASK} ;
    owlunit:hasInputData <b.ttl> ; dcterms:subject "own" ; sd:entailmentRegime ent:Simple .
<#three> a owlunit:InferenceVerification ; {ASK} .
""",
        a_ttl="",
        b_ttl="",
    )
    assert (one.data, one.group, one.regime) == ((tmp_path / "a.ttl",), "all", v.RDFS_REGIME)
    assert (two.data, two.group, two.regime) == ((tmp_path / "b.ttl",), "own", v.SIMPLE)
    assert (three.regime, three.needs_reasoner) == (v.OWL_DIRECT, True)


def test_parts(load: Load, prefixes: str, tmp_path: Path) -> None:
    (tmp_path / "part").mkdir()
    part = f"{prefixes}<> owl:imports <../manifest.ttl> .\n<#b> a owlunit:ErrorProvocation ; "
    part += "owlunit:hasInputData <d.ttl> ."
    (tmp_path / "part" / "manifest.ttl").write_text(part)
    (tmp_path / "part" / "d.ttl").write_text("")
    found = load(
        f"""<> owl:imports <part/manifest.ttl> ;
    rdfs:seeAlso <short.yml> , <readme.md> , <https://example.org/page> .
<#a> a owlunit:CompetencyQuestionVerification ; {ASK} .
""",
        readme_md="Not a manifest.",
        short_yml="questions: [{id: c, query: 'ASK {}', expect: true}]",
    )
    assert [q.id for q in found] == ["a", "b", "c"]
    assert found[1].data == (tmp_path / "part" / "d.ttl",)


def test_suites(load: Load) -> None:
    one, two = load(
        f"""<#suite> a owlunit:TestSuite ; dcterms:title "Suite" ; owlunit:hasTestCase <#one> ;
    owlunit:hasInputData <a.ttl> .
<#one> a owlunit:CompetencyQuestionVerification ; {ASK} .
<#two> a owlunit:CompetencyQuestionVerification ; {ASK} .
""",
        a_ttl="",
    )
    assert (one.group, len(one.data)) == ("Suite", 1)
    assert (two.group, two.data) == ("", ())


def test_as_owlunit_lays_it_out() -> None:
    found = load_manifest(OWLUNIT / "suite.ttl")
    assert [q.id for q in found] == ["borrowed", "member", "closed"]
    assert [q.kind for q in found] == [model.QUESTION, model.INFERENCE, model.PROVOCATION]
    assert all(q.ontologies == (OWLUNIT / "library.ttl",) for q in found)
    assert isinstance(found[0].expected, Table)
    assert len(found[0].expected.rows) == 2


def test_our_own() -> None:
    assert len(load_manifest(default_manifest())) >= 80


CASE = "<#q> a owlunit:CompetencyQuestionVerification ; "


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("\n<#q> a owlunit:", "line 11: "),
        ("", "line 1: no competency question in it"),
        (
            f"{CASE}\n  owlunit:hasSPARQLUnitTest <q/none.rq> .",
            "line 11: the query q/none.rq does ",
        ),
        (
            f"{CASE}{ASK} ;\n\n owlunit:hasInputData <no.ttl> .",
            "line 12: the data file no.ttl does",
        ),
        (
            f"{CASE}{ASK} ; owlunit:hasExpectedResult <no.tsv> .",
            "line 10: the expected result no.t",
        ),
        (f"{CASE}{ASK} ;\n owlunit:testsOntology <no.owl> .", "line 11: the ontology no.owl does "),
        (
            f"{CASE}{ASK} ;\n owlunit:testsOntology <https://w3id.org/symboslam/none> .",
            "line 11: there is no bundled document <https://w3id.org/symboslam/none>",
        ),
        (
            f"{CASE}{ASK} ;\n owlunit:testsOntology <https://example.org/far.owl> .",
            "line 11: the ontology <https://example.org/far.owl> is not fetched from the network",
        ),
        (
            f'{CASE}{ASK} ;\n owlunit:hasInputData "d.ttl" .',
            "line 11: the data file 'd.ttl' has to",
        ),
        ("\n<> owl:imports <part.ttl> .", "line 11: the manifest part.ttl does not exist"),
        (
            "<#s> a owlunit:TestSuite ; owlunit:hasTestCase <#none> .",
            "line 10: there is no test cas",
        ),
        (
            f"{CASE} dcterms:subject 'x' .",
            "line 10: q: a competency question needs owlunit:hasSPAR",
        ),
        (f"{CASE}{ASK}, 'ASK {{}}' .", "line 10: q: more than one query"),
        (
            f"{CASE}{ASK} ; owlunit:hasExpectedResult true, false .",
            "line 10: q: more than one expec",
        ),
        (
            f'{CASE}{ASK} ; owlunit:hasExpectedResult "no" .',
            "line 10: the expected answer is neither",
        ),
        (
            f"{CASE}{ASK} ; owlunit:hasExpectedResult [] .",
            "line 10: q: the expected result is no rs",
        ),
        (
            f"{CASE}{ASK} ; owlunit:hasReasoner owlunit:ELK .",
            "line 10: q: the only reasoner is owl",
        ),
        (
            f"{CASE}{ASK} ;\n sd:entailmentRegime ent:RIF .",
            "line 11: <http://www.w3.org/ns/entailme",
        ),
        ("<#e> a owlunit:ErrorProvocation .", "line 10: e: an error provocation needs input data"),
        (
            f'{CASE}\n owlunit:hasSPARQLUnitTest """\nASK {{\n x:y }}""" .',
            "line 13: the prefix x: is not declared (x:y)",
        ),
        (
            f"<#a> a owlunit:CompetencyQuestionVerification ; {ASK} ; dcterms:identifier 'q' .\n"
            f"{CASE}{ASK} .",
            "line 11: the identifier 'q' is taken: ",
        ),
    ],
)
def test_bad_manifests(load: Load, tmp_path: Path, text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        load(text)
    assert str(caught.value).startswith(f"{tmp_path}/manifest.ttl: {message}"), str(caught.value)


def test_bad_query_file(load: Load, tmp_path: Path) -> None:
    with pytest.raises(InputError) as caught:
        load(f"{CASE} owlunit:hasSPARQLUnitTest <q.rq> .", q_rq="SELECT ?x\nWHER { }")
    assert str(caught.value).startswith(f"{tmp_path}/q.rq: line 2: it is not SPARQL: ")


@pytest.mark.parametrize("name", ["manifest.ttl", "questions.yml"])
def test_unreadable(prefixes: str, tmp_path: Path, name: str) -> None:
    path = tmp_path / name
    with pytest.raises(InputError, match="No such file"):
        load_manifest(path)
    path.mkdir()
    with pytest.raises(InputError, match="directory"):
        load_manifest(path)
    path.rmdir()
    path.write_bytes(b"\xef\xbb\xbf" + prefixes.encode())
    with pytest.raises(InputError, match="line 1: it starts with a byte-order mark"):
        load_manifest(path)
    path.write_bytes(b"# fine\n# not\xff\n")
    with pytest.raises(InputError, match="line 2: it is not UTF-8"):
        load_manifest(path)


# Data


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("d.ttl", "@prefix : <https://example.org/> . :a :b :c ."),
        ("d.nt", "<https://example.org/a> <https://example.org/b> <https://example.org/c> ."),
        ("d.nq", "<https://example.org/a> <https://example.org/b> <https://example.org/c> ."),
        ("d.trig", "@prefix : <https://example.org/> . { :a :b :c }"),
        ("d.rdf", '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" '
         'xmlns:e="https://example.org/"><rdf:Description rdf:about="https://example.org/a">'
         '<e:b rdf:resource="https://example.org/c"/></rdf:Description></rdf:RDF>'),
        ("d.jsonld", '{"@id": "https://example.org/a", '
         '"https://example.org/b": {"@id": "https://example.org/c"}}'),
    ],
)  # fmt: skip
def test_data_formats(tmp_path: Path, name: str, text: str) -> None:
    (tmp_path / name).write_text(text)
    with gzip.open(tmp_path / f"{name}.gz", "wt") as packed:
        packed.write(text)
    expected = "<https://example.org/a> <https://example.org/b> <https://example.org/c>"
    for path in (tmp_path / name, tmp_path / f"{name}.gz"):
        assert [str(quad.triple) for quad in read_quads(path)] == [expected]


@pytest.mark.parametrize(
    ("name", "data", "message"),
    [
        ("d.ttl", b"<a> <b> .\n", "line 1: "),
        ("d.ttl", b"<a> <b> <c> .\n<a> <b> x:y .\n", "line 2: "),
        ("d.ttl", b"\xef\xbb\xbf<a> <b> <c> .", "line 1: it starts with a byte-order mark"),
        ("d.nt", b"<a> <b> <c> .", "line 1: "),
        ("d.rdf", b'<!DOCTYPE x [\n<!ENTITY e SYSTEM "file:///etc/passwd">]><x>&e;</x>',
         "line 2: the external XML entity 'e' is refused"),
        ("d.jsonld", b'{"@context": "https://example.org/c"}', "a remote JSON-LD context is not"),
        ("d.json", b'{"@id":\n oops}', "line 2: "),
        ("d.ttl.gz", b"not packed", "it cannot be unpacked: "),
        ("d.ttl.gz", gzip.compress(b"<a> <b> <c> .", mtime=0)[:-9], "it cannot be unpacked: "),
        ("d.ttl.gz", gzip.compress(b"<a> <b>\n .", mtime=0), "line 2: "),
        ("d.csv", b"", ".csv is no known RDF format; known: .ttl"),
        ("d", b"", "no ending is no known RDF format"),
    ],
)  # fmt: skip
def test_bad_data(tmp_path: Path, name: str, data: bytes, message: str) -> None:
    (tmp_path / name).write_bytes(data)
    with pytest.raises(InputError) as caught:
        read_quads(tmp_path / name)
    said = str(caught.value)
    assert said.startswith(str(tmp_path / name.removesuffix(".gz"))), said
    assert f": {message}" in said, said


def test_anonymous_nodes_of_two_files_stay_apart(tmp_path: Path) -> None:
    path = tmp_path / "d.ttl"
    path.write_text("_:a <https://example.org/b> 1 .")
    one, other = read_quads(path), read_quads(path)
    assert one[0].subject != other[0].subject


def test_a_property_spelt_wrongly_is_no_pass(load: Load) -> None:
    with pytest.raises(InputError, match=r"line \d+: .*did you mean hasExpectedResult\?"):
        load(f"""<#q> a owlunit:CompetencyQuestionVerification ; dcterms:identifier "q" ;
    owlunit:hasCompetencyQuestion "Is it?" ; {ASK} ;
    owlunit:hasExpectedResutl false ; owlunit:testsOntology <https://w3id.org/symboslam/core> .
""")
