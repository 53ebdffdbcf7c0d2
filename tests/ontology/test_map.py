"""The map module: it stands below the vocabularies of others, and what follows from it is right."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from rdflib import OWL, RDF, RDFS, SKOS, Graph, Namespace, URIRef
from rdflib.namespace import GEO, PROV, SOSA, TIME

from symboslam.errors import ReasonerError
from symboslam.reasoning.axioms import Triple, split
from symboslam.reasoning.hermit import Hermit, find_java

FOLDER = Path(__file__).parents[2] / "ontology"
MODULES = ("core", "external", "map", "upstream/ontoslam", "upstream/onto4mat")

SL = Namespace("https://w3id.org/symboslam#")
OS = Namespace("http://github.com/Alex23013/slam-up/OntoSLAM.owl#")
FR = Namespace("http://github.com/Alex23013/slam-up/FortesRey.owl#")
ISRO = Namespace("http://github.com/Alex23013/slam-up/ISRO.owl#")
CORA = Namespace("http://www.semanticweb.org/ontologies/2013/7/CORA.owl#")
KN = Namespace("http://knowrob.org/kb/knowrob.owl#")
O4M = Namespace("http://www.semanticweb.org/swarmShepherdingOntology/Onto4MAT#")
PREFIXES = {
    "sl": SL, "os": OS, "fr": FR, "isro": ISRO, "cora": CORA, "kn": KN, "o4m": O4M, "owl": OWL,
    "prov": PROV, "geo": GEO, "sosa": SOSA, "time": TIME, "e": "https://example.org/",
    "dcterms": "http://purl.org/dc/terms/",
}  # fmt: skip
HEAD = "".join(f"PREFIX {p}: <{n}>\n" for p, n in PREFIXES.items())

# Two rovers, what each saw, the graph of the first, and the map that their maps became.
TEAM = """
e:rover1 a cora:Robot ; os:inEnvironment e:town . e:rover2 a cora:Robot ; os:inEnvironment e:town .
e:track1 a sl:AgentTrack ; sl:trackOf e:rover1 ; sl:hasTrackPose e:p1 , e:p2 .
e:track2 a sl:AgentTrack ; sl:trackOf e:rover2 ; sl:hasTrackPose e:q1 .
e:p1 fr:posAtTime e:t1 . e:p2 os:hasProbability e:prob . e:prob os:hasMatrixValue e:cov .
e:graph1 a sl:PoseGraph ; sl:hasEdge e:odometry , e:loop , e:measurement .
e:odometry a sl:OdometryConstraint ; sl:constraintFrom e:p1 ; sl:constraintTo e:p2 .
e:loop a sl:InterAgentLoopClosure ; sl:constraintFrom e:p2 ; sl:constraintTo e:q1 .
e:measurement a sl:LandmarkMeasurement ; sl:constraintFrom e:p2 ; sl:constraintTo e:there ;
    sl:bearing 0.3 ; sl:range 12.5 ; sl:measuredBy e:seen .
e:seen a sl:LandmarkObservation ; sosa:hasFeatureOfInterest e:house ; sl:observedFrom e:p2 .
e:house a sl:Landmark ; os:hasPosition e:there ; sl:mergedInto e:theHouse .
e:house prov:wasAttributedTo e:rover1 .
e:map1 a sl:AgentMap ; prov:wasAttributedTo e:rover1 ; sl:builtFrom e:graph1 .
e:map2 a sl:AgentMap ; prov:wasAttributedTo e:rover2 .
e:whole a sl:CollectiveMap ; sl:mergedFrom e:map1 , e:map2 .
e:s1 a sl:Segment ; sl:adjacentTo e:s2 .
e:rover1 owl:differentFrom e:rover2 . e:p1 owl:differentFrom e:p2 . e:s1 owl:differentFrom e:s2 .
"""


@pytest.fixture(scope="module")
def module() -> Graph:
    return Graph().parse(FOLDER / "map.ttl")


@pytest.fixture(scope="module")
def merged() -> Graph:
    graph = Graph()
    for name in MODULES:
        graph.parse(FOLDER / f"{name}.ttl")
    return graph


@pytest.fixture(scope="module")
def hermit() -> Hermit:
    try:
        find_java()
    except ReasonerError:
        pytest.skip("no Java: pip install 'symboslam[reasoner]'")
    return Hermit()


def triples(graph: Graph) -> list[Triple]:
    declarations, axioms = split(graph)
    return [*declarations, *(t for axiom in axioms for t in axiom.triples)]


def facts(text: str) -> Graph:
    return Graph().parse(data=HEAD + text, format="turtle")


def consistent(hermit: Hermit, *graphs: Graph) -> bool:
    """Whether the axioms of some graphs can all hold."""
    together = Graph()
    for graph in graphs:
        together += graph
    return not hermit.clashes([triples(together)])[0]


def test_no_term_of_others_is_declared_here(module: Graph) -> None:
    kinds = (OWL.Class, OWL.ObjectProperty, OWL.DatatypeProperty, OWL.AnnotationProperty)
    found = {s for kind in kinds for s in module.subjects(RDF.type, kind)}
    assert {t for t in found if isinstance(t, URIRef) and t not in SL} == set()


def test_every_term_of_others_is_explained() -> None:
    external = Graph().parse(FOLDER / "external.ttl")
    terms = {s for s in external.subjects(RDFS.label, None) if isinstance(s, URIRef)}
    assert len(terms) > 75
    assert {t for t in terms if t in SL} == {SL.acceptedPitfall}  # any module may need it
    terms.remove(SL.acceptedPitfall)
    for term in terms:
        for about in (RDFS.label, SKOS.definition, RDFS.isDefinedBy):
            assert len(list(external.objects(term, about))) == 1, term
        assert str(term).startswith(str(external.value(term, RDFS.isDefinedBy))), term
        assert external.value(term, RDF.type) in (
            OWL.Class, OWL.ObjectProperty, OWL.DatatypeProperty, OWL.AnnotationProperty,
        )  # fmt: skip
    definitions = [str(o) for o in external.objects(None, SKOS.definition)]
    assert len(set(definitions)) == len(definitions)


def test_every_term_of_others_that_map_uses_is_declared(merged: Graph, module: Graph) -> None:
    """Prefixes of other vocabularies; those of OWL and XML Schema are built in."""
    theirs = re.compile("|".join(re.escape(str(n)) for p, n in PREFIXES.items() if p != "owl"))
    used = {t for s in module for t in s if isinstance(t, URIRef) and theirs.match(t)}
    assert len(used) > 100
    assert {t for t in used if (t, RDF.type, None) not in merged} == set()


@pytest.mark.parametrize(
    ("term", "wider"),
    [
        (SL.Place, KN.SpaceRegion),
        (SL.Place, CORA.Environment),
        (SL.Place, O4M.Environment),
        (SL.Landmark, OS.Part),
        (SL.Landmark, GEO.Feature),
        (SL.Landmark, SOSA.FeatureOfInterest),
        (SL.Segment, GEO.SpatialObject),
        (SL.Keyframe, OS.Position),
        (SL.LandmarkPosition, OS.Position),
        (SL.InterAgentLoopClosure, SL.Constraint),
        (SL.CollectiveMap, PROV.Entity),
        (SL.MapMerging, PROV.Activity),
        (SL.CoordinateSystem, CORA.CoordinateSystem),
        (SL.LandmarkObservation, SOSA.Observation),
        (SL.Detection, PROV.Entity),
        (SL.EnvironmentDistribution, PROV.Entity),
        (CORA.Robot, PROV.Agent),
        (O4M.Swarm, O4M.Team),
        (O4M.Artificial, PROV.Agent),
        (ISRO.TimePoint, TIME.Instant),
    ],
)  # fmt: skip
def test_classes_stand_below_those_of_others(merged: Graph, term: URIRef, wider: URIRef) -> None:
    assert wider in set(merged.transitive_objects(term, RDFS.subClassOf))


def test_all_classes_can_have_members(hermit: Hermit, merged: Graph) -> None:
    found = hermit.classify(triples(merged))
    assert found is not None
    assert found.unsatisfiable == frozenset()
    assert str(SL.Feature) not in found.above(str(SL.Landmark))


INFERRED = [
    "e:p1 sl:poseOf e:rover1",
    "e:q1 sl:poseOf e:rover2",
    "e:p1 sl:onTrack e:track1",
    "e:graph1 sl:hasVertex e:p1",
    "e:graph1 sl:hasVertex e:q1",
    "e:graph1 sl:hasVertex e:there",
    "e:graph1 dcterms:hasPart e:odometry",
    "e:p2 sl:hasCovariance e:cov",
    "e:p2 sl:hasObservation e:seen",
    "e:p1 time:hasTime e:t1",
    "e:whole sl:contributedBy e:rover2",
    "e:theHouse sl:contributedBy e:rover1",
    "e:whole prov:wasInfluencedBy e:map1",
    "e:theHouse sl:mergedFrom e:house",
    "e:s2 sl:adjacentTo e:s1",
    "e:s2 geo:sfTouches e:s1",
    "e:town os:hasAgent e:rover1",
]
NOT_INFERRED = [
    "e:q1 sl:poseOf e:rover1",
    "e:graph1 sl:hasVertex e:house",
    "e:map1 sl:contributedBy e:rover1",
    "e:p1 sl:hasCovariance e:cov",
    "e:s1 geo:sfWithin e:s2",
]


@pytest.mark.parametrize(
    ("fact", "follows"), [(f, True) for f in INFERRED] + [(f, False) for f in NOT_INFERRED]
)
def test_what_follows(hermit: Hermit, merged: Graph, fact: str, follows: bool) -> None:
    """A fact follows if its denial makes the ontology inconsistent."""
    source, prop, target = fact.split()
    denial = facts(
        f"[] a owl:NegativePropertyAssertion ; owl:sourceIndividual {source} ;"
        f" owl:assertionProperty {prop} ; owl:targetIndividual {target} ."
    )
    assert consistent(hermit, merged, facts(TEAM), denial) != follows


def test_a_merged_landmark_is_no_map(hermit: Hermit, merged: Graph) -> None:
    """Who contributed is told of landmarks as well as of maps."""
    assert consistent(hermit, merged, facts(TEAM), facts("e:theHouse a sl:Landmark ."))


@pytest.mark.parametrize(
    "data",
    [
        "e:p1 a sl:LandmarkPosition .",
        "e:measurement a sl:LoopClosure .",
        "e:measurement2 a sl:LandmarkMeasurement ; sl:constraintTo e:q1 .",
        "e:odometry sl:constraintFrom e:p2 .",
        "e:track1 sl:trackOf e:rover2 .",
        "e:whole a sl:AgentMap .",
        "e:house a sl:Segment .",
        "e:house a sl:LandmarkSet .",
        "e:s1 sl:adjacentTo e:s1 .",
        "e:rover1 a sl:Pose .",
        "e:measurement sl:range 13.0 .",
    ],
)
def test_nonsense_is_refused(hermit: Hermit, merged: Graph, data: str) -> None:
    assert not consistent(hermit, merged, facts(TEAM), facts(data))


def test_a_team_in_one_environment_is_consistent(hermit: Hermit, merged: Graph) -> None:
    assert consistent(hermit, merged, facts(TEAM))
