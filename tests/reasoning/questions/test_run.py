"""Asking: statuses, entailment, the four kinds, choosing questions."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

import pytest

from symboslam.errors import ImportsError, InputError, UnknownNameError
from symboslam.reasoning._base import Hierarchy, Realization, Reasoner
from symboslam.reasoning.axioms import Triple
from symboslam.reasoning.hermit import Hermit
from symboslam.reasoning.questions import model
from symboslam.reasoning.questions.manifest import load_manifest
from symboslam.reasoning.questions.model import Question, Report, Result, Table
from symboslam.reasoning.questions.run import choose, run, with_files

Load = Callable[..., list[Question]]
OWN = """@prefix : <https://example.org/x#> .
@prefix owl: <http://www.w3.org/2002/07/owl#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
:Cow a owl:Class ; rdfs:subClassOf :Animal . :Animal a owl:Class . :Barn a owl:Class .
:Cow owl:disjointWith :Barn .
:isIn a owl:ObjectProperty ; rdfs:domain :Animal .
"""


class Forbidden(Reasoner):
    """A reasoner that must not be asked."""

    def classify(self, triples: Iterable[Triple]) -> Hierarchy | None:
        raise AssertionError

    def realize(self, triples: Iterable[Triple]) -> Realization | None:
        raise AssertionError

    def clashes(
        self, candidates: Iterable[Iterable[Triple]], unsatisfiable: str | None = None
    ) -> list[bool]:
        raise AssertionError


class Counting(Hermit):
    """HermiT, with a list of what it was asked."""

    def __init__(self) -> None:
        super().__init__()
        self.runs: list[str] = []

    def _run(self, ontologies: Iterable[Iterable[Triple]], *actions: str) -> tuple[int, str]:
        self.runs.append(" ".join(actions))
        return super()._run(ontologies, *actions)


def by_id(report: Report) -> dict[str, Result]:
    return {result.question.id: result for result in report.results}


def ask(load: Load, query: str, more: str = "", **files: str) -> Result:
    """The result of one question about ``OWN``, without a reasoner."""
    questions = load(
        "<#q> a owlunit:CompetencyQuestionVerification ; owlunit:testsOntology <own.ttl> ; "
        f'{more}\n owlunit:hasSPARQLUnitTest "PREFIX : <https://example.org/x#> {query}" .',
        own_ttl=OWN,
        **files,
    )
    (result,) = run(questions, reasoner=Forbidden()).results
    return result


def test_the_farm(hermit: None, farm: Path) -> None:
    report = run(load_manifest(farm / "manifest.ttl"))
    found = by_id(report)
    assert {name: result.status for name, result in found.items()} == {
        "heavy": "passed",
        "all": "passed",
        "where": "known failing",
        "eats": "known failing",
        "grazed": "passed",
        "both": "passed",
        "labels": "passed",
    }
    assert report.ok
    assert report.counts == {"passed": 5, "known failing": 2}
    assert list(found) == [q.id for q in load_manifest(farm / "manifest.ttl")]
    assert found["eats"].message.splitlines() == [
        "food is not modelled yet",
        "neither ontology nor data knows :bela; close: :bella",
        "neither ontology nor data knows :eats",
    ]


def test_owlunit_examples(hermit: None, farm: Path) -> None:
    report = run(load_manifest(farm.parent / "owlunit" / "suite.ttl"))
    assert report.counts == {"passed": 3}


def test_failed(load: Load) -> None:
    result = ask(
        load,
        "SELECT ?c { ?c a <http://www.w3.org/2002/07/owl#Class> }",
        "owlunit:hasExpectedResult <e.csv> ;",
        e_csv="c\nhttps://example.org/x#Cow\nhttps://example.org/x#Hen\n",
    )
    assert result.status == "failed"
    assert result.bad
    assert result.message.splitlines() == [
        "missing 1 row:",
        '  c="https://example.org/x#Hen"',
        "unexpected 2 rows:",
        "  c=:Animal",
        "  c=:Barn",
    ]


def test_broken(load: Load) -> None:
    result = ask(load, "ASK { ?x a :Cwo }", "owlunit:hasExpectedResult false ;")
    assert (result.status, result.bad) == ("broken", True)
    assert result.message == "neither ontology nor data knows :Cwo; close: :Cow"


def test_terms_of_the_data_are_known(load: Load) -> None:
    more = "owlunit:hasExpectedResult true ; owlunit:hasInputData <d.ttl> ;"
    data = "<https://example.org/x#bob> <https://example.org/x#eats> 1 ."
    assert ask(load, "ASK { :bob :eats 1 }", more, d_ttl=data).status == "passed"


def test_known_failing_that_passes(load: Load) -> None:
    result = ask(load, "ASK {}", "owlunit:hasExpectedResult true ; sl:knownFailing 'not yet' ;")
    assert result.status == "passed"
    assert result.message == "it passes, though it is said to be failing: not yet"


def test_no_expected_answer(load: Load) -> None:
    result = ask(load, "SELECT ?c { ?c a <http://www.w3.org/2002/07/owl#Class> }")
    assert result.status == "passed"
    assert result.message == "no answer is expected in particular; 3 found"


def test_chosen_columns_and_order(load: Load) -> None:
    query = "SELECT ?c ?l { VALUES (?c ?l) { (2 'x') (1 'y') } } ORDER BY ?c"
    more = "owlunit:hasExpectedResult <e.csv> ;"
    assert ask(load, query, f"{more} sl:comparesColumn 'c' ;", e_csv="c\n1\n2\n").status == "passed"
    result = ask(load, query, f"{more} sl:comparesColumn 'c' ;", e_csv="c\n2\n1\n")
    assert result.message == 'the order differs at row 1: expected c="2"; got c=1'
    unordered = query.removesuffix(" ORDER BY ?c")
    assert (
        ask(load, unordered, f"{more} sl:comparesColumn 'c' ;", e_csv="c\n1\n2\n").status
        == "passed"
    )
    assert ask(load, query, more, e_csv="c\n1\n2\n").status == "failed"


@pytest.mark.parametrize(("regime", "answer"), [("Simple", "false"), ("RDFS", "true")])
def test_regimes_without_a_reasoner(load: Load, regime: str, answer: str) -> None:
    more = f"owlunit:hasExpectedResult {answer} ; owlunit:hasInputData <d.ttl> ; "
    more += f"sd:entailmentRegime ent:{regime} ;"
    data = "@prefix : <https://example.org/x#> . :bella :isIn :barn ."
    assert ask(load, "ASK { :bella a :Animal }", more, d_ttl=data).status == "passed"


def test_graphs_and_geosparql(load: Load) -> None:
    data = """@prefix : <https://example.org/x#> .
    @prefix geo: <http://www.opengis.net/ont/geosparql#> .
    :g { :in geo:asWKT "POINT(1 1)"^^geo:wktLiteral .
         :out geo:asWKT "POINT(5 5)"^^geo:wktLiteral }"""
    query = """PREFIX geo: <http://www.opengis.net/ont/geosparql#>
    PREFIX geof: <http://www.opengis.net/def/function/geosparql/>
    SELECT ?x { GRAPH :g { ?x geo:asWKT ?w } FILTER(geof:sfWithin(?w,
      'POLYGON((0 0,2 0,2 2,0 2,0 0))'^^geo:wktLiteral)) }""".replace("\n", " ")
    more = "owlunit:hasExpectedResult <e.csv> ; owlunit:hasInputData <d.trig> ;"
    result = ask(load, query, more, d_trig=data, e_csv="x\nhttps://example.org/x#in\n")
    assert (result.status, result.message) == ("passed", "")


def test_construct(load: Load) -> None:
    result = ask(
        load,
        "CONSTRUCT { ?c :under [] } "
        "WHERE { ?c <http://www.w3.org/2000/01/rdf-schema#subClassOf> ?d }",
        "owlunit:hasExpectedResult <e.ttl> ;",
        e_ttl="@prefix : <https://example.org/x#> . :Cow :under [] .",
    )
    assert (result.status, result.message) == ("passed", "")


# With the reasoner

VERIFY = """<> owlunit:testsOntology <own.ttl> .
<#kind> a owlunit:InferenceVerification ; owlunit:hasInputData <good.ttl> ;
    owlunit:hasSPARQLUnitTest "PREFIX : <https://example.org/x#> ASK { :bella a :Animal }" .
<#none> a owlunit:InferenceVerification ; owlunit:hasInputData <good.ttl> ;
    owlunit:hasSPARQLUnitTest "PREFIX : <https://example.org/x#> ASK { :bella a :Barn }" ;
    owlunit:hasExpectedResult false .
<#wrong> a owlunit:InferenceVerification ; owlunit:hasInputData <good.ttl> ;
    owlunit:hasSPARQLUnitTest "PREFIX : <https://example.org/x#> ASK { :bella a :Barn }" .
<#clash> a owlunit:InferenceVerification ; owlunit:hasInputData <bad.ttl> ;
    owlunit:hasSPARQLUnitTest "PREFIX : <https://example.org/x#> ASK { :bella a :Barn }" .
<#fine> a owlunit:InferenceVerification ; owlunit:hasInputData <good.ttl> .
<#refused> a owlunit:ErrorProvocation ; owlunit:hasInputData <bad.ttl> .
<#accepted> a owlunit:ErrorProvocation ; owlunit:hasInputData <good.ttl> .
<#self> a owlunit:ErrorProvocation ; owlunit:hasInputData <bad.ttl> ;
    owlunit:testsOntology <torn.ttl> .
<#rdfs> a owlunit:CompetencyQuestionVerification ; owlunit:hasInputData <bad.ttl> ;
    owlunit:hasSPARQLUnitTest "ASK {}" ; owlunit:hasExpectedResult true .
"""
FILES = {
    "own_ttl": OWN,
    "torn_ttl": OWN + ":x a :Cow , :Barn .",
    "good_ttl": "@prefix : <https://example.org/x#> . :bella a :Cow .",
    "bad_ttl": "@prefix : <https://example.org/x#> . :bella a :Cow , :Barn .",
}


def test_kinds(hermit: None, load: Load) -> None:
    reasoner = Counting()
    found = by_id(run(load(VERIFY, **FILES), reasoner=reasoner))
    assert {name: result.status for name, result in found.items()} == {
        "kind": "passed",
        "none": "passed",
        "wrong": "failed",
        "clash": "failed",
        "fine": "passed",
        "refused": "passed",
        "accepted": "failed",
        "self": "failed",
        "rdfs": "passed",
    }
    assert found["wrong"].message == "expected true, got false"
    assert found["clash"].message == "ontology and data contradict each other"
    assert found["accepted"].message.startswith("the data is not refused")
    assert found["self"].message.startswith("the ontology contradicts itself already")
    # What is asked twice is reasoned over once: two sets of data, the hierarchy, one provocation
    # with each data and ontology, and the ontologies alone (again after the one that clashes).
    kinds = sorted(reasoner.runs)
    assert kinds.count("-c -O -I -Y") == 2
    assert kinds.count("-c") == 1
    assert 4 <= kinds.count("-k") <= 6


def test_without_the_reasoner(load: Load) -> None:
    report = run(load(VERIFY, **FILES), reasoner=Forbidden(), reasoning=False)
    assert report.counts == {"skipped": 8, "passed": 1}
    assert report.ok
    assert by_id(report)["kind"].message == "it needs the reasoner"


def test_annotations(load: Load) -> None:
    pytest.importorskip("pyshacl", reason="needs the extra shapes")
    text = """<#default> a owlunit:AnnotationVerification ; owlunit:testsOntology <own.ttl> .
<#own> a owlunit:AnnotationVerification ; owlunit:testsOntology <own.ttl> ;
    owlunit:hasShapes <shapes.ttl> ."""
    shapes = """@prefix sh: <http://www.w3.org/ns/shacl#> .
    @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
    [] a sh:NodeShape ; sh:targetNode <https://example.org/x#Cow> ;
       sh:property [ sh:path rdfs:subClassOf ; sh:minCount 1 ] ."""
    found = by_id(run(load(text, own_ttl=OWN, shapes_ttl=shapes), reasoner=Forbidden()))
    assert found["own"].status == "passed"
    assert found["default"].status == "failed"
    lines = found["default"].message.splitlines()
    assert lines[0] == "8 violations:"  # a label and a definition for 3 classes and 1 property
    assert lines[1] == "  https://example.org/x#Animal: it has no definition"
    bad = load(text, own_ttl=OWN, shapes_ttl="<a> <b>\n .")
    with pytest.raises(InputError, match=r"shapes\.ttl: line \d"):
        run(bad, reasoner=Forbidden())


# Choosing, and other files


def test_choose(farm: Path) -> None:
    questions = load_manifest(farm / "questions.yml")

    def ids(*patterns: str) -> list[str]:
        return [question.id for question in choose(questions, patterns)]

    assert len(ids()) == 10
    assert ids("cq-c*") == ["cq-cow", "cq-count", "cq-contains"]
    assert ids("CQ-COW") == ["cq-cow"]
    assert ids("cq-co") == ["cq-cow", "cq-count", "cq-contains"]
    assert ids("data", "schema") == ["cq-cow", "cq-some"]
    with pytest.raises(UnknownNameError, match="no question fits 'cq-9\\*'; there are cq-cow, "):
        ids("cq-9*")


def test_other_ontology_and_more_data(farm: Path, tmp_path: Path) -> None:
    questions = choose(load_manifest(farm / "manifest.ttl"), ["heavy"])
    more = tmp_path / "more.ttl"
    more.write_text("@prefix : <https://example.org/farm#> . :hank :weight 1.5 .")
    (result,) = run(with_files(questions, data=[more])).results
    assert result.status == "failed"
    assert isinstance(result.answer, Table)
    assert len(result.answer.rows) == 4
    (result,) = run(with_files(questions, ["https://w3id.org/symboslam/core"])).results
    assert result.status == "passed"
    with pytest.raises(InputError, match="there is no such file"):
        with_files(questions, [tmp_path / "none.ttl"])


@pytest.mark.parametrize("file", ["own", "data"])
def test_bad_input_is_told_before_anything_is_asked(load: Load, file: str) -> None:
    text = """<#a> a owlunit:CompetencyQuestionVerification ; owlunit:hasSPARQLUnitTest "ASK {}" .
<#b> a owlunit:CompetencyQuestionVerification ; owlunit:hasSPARQLUnitTest "ASK {}" ;
    owlunit:testsOntology <own.ttl> ; owlunit:hasInputData <data.ttl> ."""
    files = {"own_ttl": OWN, "data_ttl": "", f"{file}_ttl": "<a>\n<b> ."}
    asked: list[str] = []
    with pytest.raises(Exception, match=rf"{file}\.ttl: line 2: "):
        run(load(text, **files), progress=lambda stage, share: asked.append(stage))
    assert asked == ["reading"]


def test_imports_are_strict_unless_told_otherwise(load: Load) -> None:
    text = """<#a> a owlunit:CompetencyQuestionVerification ; owlunit:hasSPARQLUnitTest "ASK {}" ;
    owlunit:testsOntology <own.ttl> ; owlunit:hasExpectedResult true ."""
    own = OWN + "<> a owl:Ontology ; owl:imports <https://example.org/gone> ."
    questions = load(text, own_ttl=own)
    with pytest.raises(
        ImportsError, match=r"own\.ttl: line \d+: the import <https://example.org/g"
    ):
        run(questions)
    assert run(questions, strict=False).ok


def test_progress(load: Load) -> None:
    told: list[tuple[str, float]] = []
    text = '<#a> a owlunit:CompetencyQuestionVerification ; owlunit:hasSPARQLUnitTest "ASK {}" .'
    run(load(text), progress=lambda stage, share: told.append((stage, share)))
    assert [stage for stage, _ in told] == ["reading", "a"]
    shares = [share for _, share in told]
    assert shares == sorted(shares)
    assert all(0 <= share <= 1 for share in shares)


def test_skipped_by_the_manifest(tmp_path: Path) -> None:
    path = tmp_path / "q.yml"
    path.write_text("questions: [{id: a, query: 'ASK { ?x a <http://e/X> }', skip: true}]")
    (result,) = run(load_manifest(path)).results
    assert (result.status, result.bad) == (model.SKIPPED, False)
