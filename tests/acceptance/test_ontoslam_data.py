"""The questions about robots and maps run unchanged on OntoSLAM's own data, a real Turtlebot's map.

Each query of ``competency_questions/slam`` about instances is asked by our runner, through
``ontology/alignments/ontoslam-data.ttl`` and under RDFS. What it must answer is found here another
way: by queries in the data's own terms and spellings, run by rdflib without the ontology.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from rdflib.query import ResultRow

from symboslam.reasoning.questions.manifest import load_manifest
from symboslam.reasoning.questions.model import Result, Table
from symboslam.reasoning.questions.run import run

if TYPE_CHECKING:
    from rdflib import Graph

QUERIES = Path(__file__).parents[2] / "competency_questions" / "slam"
DATA = Path(__file__).parents[3] / "shared" / "data" / "ontoslam_abox" / "turtlebot_map_1713.ttl.gz"
PREFIXES = """
PREFIX os:   <http://github.com/Alex23013/slam-up/OntoSLAM.owl#>
PREFIX cora: <http://www.semanticweb.org/ontologies/2013/7/CORA.owl#>
PREFIX kn:   <http://knowrob.org/kb/knowrob.owl#>
"""

# Question -> the same in the published data's terms, and how many answers it must have.
OURS = {
    "p1": (
        """?part ?kind ?value WHERE {
            ?part a os:BasePart ; os:hasVisual ?visual . ?visual os:hasDimension ?node .
            ?node a ?kind ; os:hasValue ?value }""",
        0,  # only the environment has a visual
    ),
    "p2": (
        """?robot ?part WHERE {
            ?robot a cora:Robot ; os:hasModel ?model . ?model os:hasPart ?part .
            ?part a os:BasePart }""",
        1,
    ),
    "p3": ("?robot ?part WHERE { ?robot a cora:Robot . ?part a os:Sensor }", 0),  # no sensors
    "p4": (
        """?part ?position ?x ?y ?z WHERE {
            ?part a os:BasePart ; os:hasPosition ?position . ?position os:hasTranslation ?t .
            ?t cora:cartesianX ?x ; cora:cartesianY ?y ; cora:cartesianZ ?z }""",
        1,
    ),
    "p5": (
        """?position ?x ?y ?a ?b ?c ?d WHERE {
            ?position os:hasOrientation ?o ; os:hasTranslation ?t .
            ?t cora:cartesianX ?x ; cora:cartesianY ?y .
            ?o os:componentX ?a ; os:componentY ?b ; os:componentZ ?c ; os:componentW ?d }""",
        1,
    ),
    "p6": (
        """?robot ?stamp ?x ?y WHERE {
            ?robot os:hasModel ?model . ?model os:hasPosition ?position .
            ?position os:posAtTime ?time ; os:hasTranslation ?t .
            ?time os:hasStamp ?stamp . ?t cora:cartesianX ?x ; cora:cartesianY ?y }""",
        1,
    ),
    "p7": (
        """?position ?row ?column ?value WHERE {
            ?position os:hasProbability ?p . ?p os:hasMatrixValue ?matrix .
            ?cell os:belongs_to ?matrix ; os:componentRow ?row ; os:componentCol ?column ;
                  os:componentValue ?value }""",
        6,
    ),
    "map1": ("?object ?part WHERE { ?object kn:near ?part }", 0),  # nothing is near anything
    "map2": (
        """?object WHERE {
            ?object a os:AtomicPart ; os:hasPosition ?position . ?position os:hasProbability ?p .
            ?p os:hasNumberValue ?value FILTER (STR(?value) = "0") }""",
        2823,
    ),
    "map3": (
        """?place ?object WHERE {
            ?place a cora:Environment . ?joint os:hasParent ?place ; os:hasChild ?object }""",
        3084,
    ),
    "map4": (
        """?object ?x ?y WHERE {
            ?object a os:AtomicPart ; os:hasPosition ?position . ?position os:hasTranslation ?t .
            ?t cora:cartesianX ?x ; cora:cartesianY ?y }""",
        3084,
    ),
    "map5": (
        """?object ?stamp ?x ?y WHERE {
            ?object a os:AtomicPart ; os:hasPosition ?position .
            ?position os:posAtTime ?time ; os:hasTranslation ?t .
            ?time os:hasStamp ?stamp . ?t cora:cartesianX ?x ; cora:cartesianY ?y }""",
        3084,
    ),
    "map6": ("?object ?other WHERE { ?object kn:near ?other }", 0),
    "map7": (
        """?object ?value WHERE {
            ?object a os:AtomicPart ; os:hasPosition ?position . ?position os:hasProbability ?p .
            ?p os:hasNumberValue ?value }""",
        3084,
    ),
}


@pytest.fixture(scope="module")
def published() -> Graph:
    """The data as it was published."""
    if not DATA.exists():
        pytest.skip(f"OntoSLAM's data is not at {DATA}")
    import gzip

    from rdflib import Graph

    graph = Graph().parse(data=gzip.decompress(DATA.read_bytes()), format="turtle")
    assert len(graph) == 43_261
    return graph


@pytest.fixture(scope="module")
def answers(published: Graph, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Result]:
    """What our queries answer over it, by question."""
    manifest = tmp_path_factory.mktemp("turtlebot") / "manifest.ttl"
    questions = "\n".join(
        f"""<#{name}> a owlunit:CompetencyQuestionVerification ;
            owlunit:hasCompetencyQuestion "{name}?" ;
            owlunit:hasSPARQLUnitTest <{(QUERIES / f"slam-{name}.rq").as_uri()}> ."""
        for name in OURS
    )
    manifest.write_text(
        f"""@prefix owlunit: <https://w3id.org/OWLunit/ontology/> .
        @prefix sd:  <http://www.w3.org/ns/sparql-service-description#> .
        @prefix ent: <http://www.w3.org/ns/entailment/> .
        <> owlunit:testsOntology <https://w3id.org/symboslam/alignments/ontoslam-data> ;
           owlunit:hasInputData <{DATA.as_uri()}> ; sd:entailmentRegime ent:RDFS .
        {questions}"""
    )
    return {r.question.id: r for r in run(load_manifest(manifest)).results}


@pytest.mark.parametrize("name", OURS)
def test_same_answers_as_in_the_data_s_own_terms(
    published: Graph, answers: dict[str, Result], name: str
) -> None:
    query, count = OURS[name]
    rows = published.query(f"{PREFIXES} SELECT {query}")
    expected = [tuple(map(str, row)) for row in rows if isinstance(row, ResultRow)]
    assert len(expected) == count
    result = answers[name]
    assert result.status == "passed", result.message  # not broken: every term is known
    assert isinstance(result.answer, Table)
    found = [tuple(str(getattr(term, "value", term)) for term in row) for row in result.answer.rows]
    assert sorted(found) == sorted(expected)


def test_every_question_about_instances_is_asked() -> None:
    named = {f.stem.removeprefix("slam-") for f in QUERIES.glob("slam-[pm]*.rq")}
    assert named == set(OURS)
    assert len(named) == 14
