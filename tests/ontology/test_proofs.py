"""Proofs about the ontology as a whole, each with a broken variant that it must refuse.

Two reasoners (HermiT; ELK through ROBOT), the OWL API's profile checker and ROBOT's report. What is
proved: OWL 2 DL; consistent, and every class can have members, also with three robots, two
operators and a swarm in one environment, and beside W3C's axioms about PROV-O and SOSA; what the 56
detector classes indicate; that no feature is a place.
"""

from __future__ import annotations

import csv
import json
import os
import subprocess
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest
from rdflib import OWL, PROV, RDF, RDFS, BNode, Graph, Namespace, URIRef
from rdflib.collection import Collection

from symboslam.errors import ReasonerError
from symboslam.reasoning import vocabulary as v
from symboslam.reasoning._base import Hierarchy
from symboslam.reasoning.axioms import split
from symboslam.reasoning.hermit import Hermit, find_java
from symboslam.reasoning.knowledge import Knowledge
from symboslam.reasoning.sources import CLOSURE, read_closure

pytestmark = pytest.mark.proof

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "ontology"
CATALOG = FOLDER / "catalog-v001.xml"
SWARM = FOLDER / "examples" / "swarm.ttl"
DATA = [SWARM, *(ROOT / "competency_questions" / "data" / f"{n}.ttl" for n in ("slam", "town"))]
GOLDEN = Path(__file__).parent / "resources" / "detector-environments.json"
PARTS = (".", "upstream", "alignments", "examples")
MODULES = sorted(path for part in PARTS for path in (FOLDER / part).glob("*.ttl"))
SL = Namespace(v.SL)
O4M = Namespace("http://www.semanticweb.org/swarmShepherdingOntology/Onto4MAT#")
OS = Namespace("http://github.com/Alex23013/slam-up/OntoSLAM.owl#")
CORA = Namespace("http://www.semanticweb.org/ontologies/2013/7/CORA.owl#")
KINDS = (OWL.Class, OWL.ObjectProperty, OWL.DatatypeProperty, OWL.AnnotationProperty)
DETECTOR = v.DOCUMENTS + "features-detector"

Conclusions = dict[str, list[str]]


# What is asked.


def classify(graph: Graph) -> Hierarchy | None:
    """What HermiT says of a graph; None if it is inconsistent."""
    declared, axioms = split(graph)
    return Hermit().classify([*declared, *(t for axiom in axioms for t in axiom.triples)])


def conclusions(graph: Graph, above: Callable[[str], Iterable[str]]) -> Conclusions:
    """Detector label -> the classes such as ``ResidentialFeature`` above its feature."""
    types = graph.subjects(RDFS.subClassOf, SL.Environment)
    views = {f"{c}Feature" for c in types if isinstance(c, URIRef)}
    assert len(views) == 8
    return {
        str(label): sorted(v.local_name(c) for c in views & set(above(str(feature))))
        for feature, label in graph.subject_objects(SL.detectorLabel)
    }


def features(graph: Graph) -> set[str]:
    """All named classes that are stated to be features."""
    below = graph.transitive_subjects(RDFS.subClassOf, SL.Feature)
    return {str(c) for c in below if isinstance(c, URIRef)}


def features_that_are_places(graph: Graph, hierarchy: Hierarchy) -> set[str]:
    """Features that follow to be a place or an environment, or nothing at all."""
    places = {v.PLACE, v.ENVIRONMENT}
    return {
        v.local_name(feature)
        for feature in features(graph)
        if places & hierarchy.above(feature) or feature in hierarchy.unsatisfiable
    }


def robot(*arguments: str | Path) -> subprocess.CompletedProcess[str]:
    """Run ROBOT; skips the test where it cannot be run."""
    command = [str(ROOT / "scripts" / "robot"), *map(str, arguments)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode == 3:
        # CI has Java and Maven: a proof that is not made there is no proof.
        (pytest.fail if os.environ.get("CI") else pytest.skip)(done.stderr.strip())
    return done


def profile_violations(source: Path, out: Path) -> list[str]:
    """Why a file and what it imports are not OWL 2 DL; empty if they are."""
    arguments = ("--profile", "DL", "--input", source, "--output", out)
    done = robot("--catalog", CATALOG, "validate-profile", *arguments)
    lines = out.read_text().splitlines() if out.exists() else []
    assert (done.returncode == 0) == (len(lines) == 1), done.stdout + done.stderr
    return lines[1:]


def report_errors(source: Path, out: Path) -> list[str]:
    """The rules of ROBOT's report that are broken at level ERROR, with their subjects."""
    done = robot("report", "--input", source, "--output", out, "--print", "0", "--fail-on", "none")
    assert done.returncode == 0, done.stdout + done.stderr
    with out.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file, delimiter="\t"))
    assert rows, "the report is empty"
    return [f"{row['Rule Name']}: {row['Subject']}" for row in rows if row["Level"] == "ERROR"]


def elk(source: Path, out: Path) -> Callable[[str], set[str]]:
    """The superclasses that ELK infers of a class, as a function."""
    done = robot(
        "reason", "--reasoner", "ELK", "--input", source, "--output", out,
        "--create-new-ontology", "true", "--include-indirect", "true",
        "--axiom-generators", "SubClass",
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    found = Graph().parse(out)
    return lambda name: {str(c) for c in found.objects(URIRef(name), RDFS.subClassOf)}


# What is looked at.


@pytest.fixture(scope="module")
def java() -> None:
    try:
        find_java()
    except ReasonerError as error:
        pytest.skip(str(error))


@pytest.fixture(scope="module")
def closure() -> Graph:
    return read_closure([CLOSURE]).graph


@pytest.fixture(scope="module")
def hierarchy(closure: Graph, java: None) -> Hierarchy:
    found = classify(closure)
    assert found is not None, "the ontology is inconsistent"
    return found


@pytest.fixture
def detector() -> Graph:
    """The detector's module with what it imports: small, so that breaking it is quick."""
    graph = Graph()
    graph += read_closure([DETECTOR]).graph
    return graph


@pytest.fixture(scope="module")
def merged(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The whole closure in one file, merged by ROBOT."""
    out = tmp_path_factory.mktemp("robot") / "merged.owl"
    source = FOLDER / "symboslam.ttl"
    done = robot("--catalog", CATALOG, "merge", "--input", source, "--output", out)
    assert done.returncode == 0, done.stdout + done.stderr
    return out


def write(graph: Graph, folder: Path) -> Path:
    """A graph as a file, without the imports that it has merged already."""
    graph.remove((None, OWL.imports, None))
    path = folder / "broken.ttl"
    graph.serialize(path, format="turtle")
    return path


def test_the_closure_is_every_module() -> None:
    read = {path.relative_to(FOLDER).as_posix() for path in MODULES if path.parts[-2] != "examples"}
    assert len(read) > 30
    stated = {str(o) for o in read_closure([CLOSURE]).graph.objects(None, OWL.imports)}
    assert {f"{i.removeprefix(v.DOCUMENTS)}.ttl" for i in (*stated, CLOSURE)} == read


# (a) OWL 2 DL.


@pytest.mark.robot
@pytest.mark.parametrize("path", [FOLDER / "symboslam.ttl", SWARM], ids=lambda path: path.stem)
def test_the_whole_is_owl_2_dl(path: Path, tmp_path: Path) -> None:
    assert profile_violations(path, tmp_path / "profile.txt")[:3] == []


def declarations(graph: Graph) -> set[tuple[URIRef, URIRef]]:
    """(term, kind) of every class and property that is declared."""
    return {(s, k) for k in KINDS for s in graph.subjects(RDF.type, k) if isinstance(s, URIRef)}


def undeclared(modules: dict[URIRef, Graph]) -> dict[str, set[str]]:
    """Module -> terms that it uses and some module declares, but none that it imports does."""
    declared = {name: declarations(graph) for name, graph in modules.items()}
    everywhere = set().union(*declared.values())
    found = {}
    for name, graph in modules.items():
        reached, waiting = set[URIRef](), [name]
        while waiting:
            if (one := waiting.pop()) not in reached:
                reached.add(one)
                waiting += [URIRef(str(i)) for i in modules[one].objects(one, OWL.imports)]
        used = {t for triple in graph for t in triple}
        missing = everywhere - set().union(*(declared[one] for one in reached))
        if terms := {str(term) for term, _ in missing if term in used}:
            found[v.local_name(name)] = terms
    return found


def test_every_module_declares_or_imports_what_it_uses() -> None:
    """A part of an OWL 2 DL ontology is then OWL 2 DL too."""
    modules = {}
    for path in MODULES:
        graph = Graph().parse(path)
        (document,) = graph.subjects(RDF.type, OWL.Ontology)
        modules[URIRef(str(document))] = graph
    assert sum(map(len, map(declarations, modules.values()))) > 800
    assert undeclared(modules) == {}
    homes = URIRef(v.DOCUMENTS + "features-osm-homes")
    modules[homes].remove((homes, OWL.imports, None))
    assert str(SL.Residential) in undeclared(modules)["features-osm-homes"]


@pytest.mark.robot
@pytest.mark.slow
@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.stem)
def test_every_module_is_owl_2_dl_to_the_owl_api(path: Path, tmp_path: Path) -> None:
    assert profile_violations(path, tmp_path / "profile.txt")[:3] == []


@pytest.mark.robot
@pytest.mark.parametrize(
    ("triple", "says"),
    [
        ((SL.indicates, RDF.type, OWL.FunctionalProperty), "non-simple property"),
        ((SL.strength, RDF.type, OWL.ObjectProperty), "strength"),
        ((SL.House, RDFS.subClassOf, SL.NowhereDeclared), "undeclared class"),
    ],
)
def test_what_is_not_owl_2_dl_is_found(
    detector: Graph, tmp_path: Path, triple: tuple[URIRef, URIRef, URIRef], says: str
) -> None:
    detector.add(triple)
    lines = profile_violations(write(detector, tmp_path), tmp_path / "profile.txt")
    assert any(says.lower() in line.lower() for line in lines), lines[:3]


# (b) Consistent, and every class can have members.


def test_the_closure_is_consistent_and_every_class_can_have_members(hierarchy: Hierarchy) -> None:
    assert hierarchy.unsatisfiable == frozenset()
    assert len(hierarchy.parents) > 600


def test_a_house_that_is_a_residential_area_cannot_be(detector: Graph, java: None) -> None:
    detector.add((SL.House, RDFS.subClassOf, SL.Residential))
    found = classify(detector)
    assert found is not None
    assert found.unsatisfiable == {str(SL.House)}


@pytest.fixture(scope="module")
def swarm() -> Graph:
    return read_closure([CLOSURE, SWARM]).graph


def test_a_swarm_in_one_environment_is_consistent(swarm: Graph, java: None) -> None:
    robots = set(swarm.subjects(RDF.type, CORA.AutonomousRobot))
    operators = set(swarm.subjects(RDF.type, SL.Operator))
    teams = set(swarm.subjects(RDF.type, O4M.Swarm))
    assert (len(robots), len(operators), len(teams)) == (3, 2, 1)
    (site,) = set(swarm.subjects(OS.hasAgent, None))
    assert robots | operators <= set(swarm.objects(site, OS.hasAgent))
    different = swarm.value(None, RDF.type, OWL.AllDifferent)
    assert different is not None
    members = swarm.value(different, OWL.distinctMembers) or swarm.value(different, OWL.members)
    assert members is not None
    assert robots | operators | teams <= set(Collection(swarm, members))
    found = classify(swarm)
    assert found is not None, "the swarm contradicts the ontology"
    assert found.unsatisfiable == frozenset()


def test_one_agent_for_each_environment_would_be_inconsistent(java: None) -> None:
    """OntoSLAM as published: its ``hasAgent`` is functional."""
    team, ontoslam = v.DOCUMENTS + "team", v.DOCUMENTS + "upstream/ontoslam"
    graph = Graph()
    graph += read_closure([team, ontoslam, SWARM]).graph
    assert classify(graph) is not None
    graph.add((OS.hasAgent, RDF.type, OWL.FunctionalProperty))
    assert classify(graph) is None


# What our modules leave out: PROV-O's domains and ranges, sensors as in W3C's mapping of SOSA,
# and SOSA read strictly, since its own domains and ranges are only hints.
W3C = """
PREFIX rdfs: <http://www.w3.org/2000/01/rdf-schema#>
PREFIX prov: <http://www.w3.org/ns/prov#>
PREFIX sosa: <http://www.w3.org/ns/sosa/>
prov:used rdfs:domain prov:Activity ; rdfs:range prov:Entity .
prov:wasGeneratedBy rdfs:domain prov:Entity ; rdfs:range prov:Activity .
prov:wasAssociatedWith rdfs:domain prov:Activity ; rdfs:range prov:Agent .
prov:wasAttributedTo rdfs:domain prov:Entity ; rdfs:range prov:Agent .
prov:wasInformedBy rdfs:domain prov:Activity ; rdfs:range prov:Activity .
prov:startedAtTime rdfs:domain prov:Activity .
prov:endedAtTime rdfs:domain prov:Activity .
prov:generatedAtTime rdfs:domain prov:Entity .
prov:invalidatedAtTime rdfs:domain prov:Entity .
sosa:Sensor rdfs:subClassOf prov:Agent , prov:Entity .
sosa:hasFeatureOfInterest rdfs:domain sosa:Observation ; rdfs:range sosa:FeatureOfInterest .
sosa:hasResult rdfs:domain sosa:Observation ; rdfs:range sosa:Result .
sosa:madeBySensor rdfs:range sosa:Sensor .
"""


def beside_w3c(data: Path) -> Graph:
    """Some data with the alignment to PROV-O, all that this imports, and the axioms above."""
    graph = Graph()
    graph += read_closure([v.DOCUMENTS + "alignments/prov-o", data]).graph
    return graph.parse(data=W3C, format="turtle")


@pytest.mark.parametrize("data", DATA, ids=lambda path: path.stem)
def test_data_are_consistent_beside_prov_o_and_sosa(data: Path, java: None) -> None:
    found = classify(beside_w3c(data))
    assert found is not None, "the data contradict PROV-O or SOSA"
    assert found.unsatisfiable == frozenset()


@pytest.mark.parametrize(
    ("kind", "statement"),
    [
        (SL.LandmarkObservation, PROV.wasAttributedTo),
        (SL.SegmentClassification, PROV.wasGeneratedBy),
    ],
)
def test_an_observation_is_not_told_of_as_an_entity(
    kind: URIRef, statement: URIRef, java: None
) -> None:
    graph = beside_w3c(DATA[-1])
    graph.add((next(graph.subjects(RDF.type, kind)), statement, BNode()))
    assert classify(graph) is None


@pytest.mark.parametrize("kind", [SL.LandmarkObservation, SL.SegmentClassification])
def test_an_observation_that_is_an_entity_cannot_be(kind: URIRef, java: None) -> None:
    """As it was once declared."""
    graph = Graph()
    graph += read_closure([v.DOCUMENTS + "alignments/prov-o"]).graph
    graph.add((kind, RDFS.subClassOf, PROV.Entity))
    found = classify(graph)
    assert found is not None
    assert found.unsatisfiable == {str(kind)}


# (c) What the engine relies on.


@pytest.fixture(scope="module")
def golden() -> Conclusions:
    found: Conclusions = json.loads(GOLDEN.read_text(encoding="utf-8"))
    assert len(found) == 56
    assert all(found.values()), "a detector class indicates nothing"
    return found


def test_hermit_infers_the_environments_of_the_56(
    closure: Graph, hierarchy: Hierarchy, golden: Conclusions
) -> None:
    """``scripts/detector_environments.py`` writes the file anew after a wanted change."""
    assert conclusions(closure, hierarchy.above) == golden


def test_the_table_of_knowledge_says_the_same(golden: Conclusions) -> None:
    knowledge = Knowledge.load()
    table = {
        feature.detector_label: sorted(
            f"{i.environment}Feature" for i in knowledge.indications_of(feature.name)
        )
        for feature in knowledge.features
        if feature.detector_label
    }
    assert table == golden


@pytest.mark.parametrize(
    ("label", "without", "lost"),
    [
        # A house has one indication; a court comes to recreation land by part-of alone.
        ("House", "indication", "ResidentialFeature"),
        ("BasketballCourt", "chain", "ParksAndRecreationFeature"),
    ],
)
def test_a_lost_axiom_changes_the_conclusions(
    detector: Graph, golden: Conclusions, java: None, label: str, without: str, lost: str
) -> None:
    if without == "chain":
        detector.remove((SL.indicates, OWL.propertyChainAxiom, None))
    else:
        for node in list(detector.objects(SL[label], RDFS.subClassOf)):
            if isinstance(node, BNode):
                detector.remove((SL[label], RDFS.subClassOf, node))
    found = classify(detector)
    assert found is not None
    changed = conclusions(detector, found.above)
    assert lost in golden[label]
    assert lost not in changed[label]


# (d) No feature is a place.


def test_no_feature_is_a_place(closure: Graph, hierarchy: Hierarchy) -> None:
    assert len(features(closure)) > 400
    assert features_that_are_places(closure, hierarchy) == set()


@pytest.mark.parametrize("disjoint", [True, False])
def test_a_feature_that_is_a_place_is_found(detector: Graph, java: None, disjoint: bool) -> None:
    """By its having no members, and also where features and places were not said to differ."""
    detector.add((SL.House, RDFS.subClassOf, SL.Residential))
    if not disjoint:
        detector.remove((SL.Feature, OWL.disjointWith, None))
        detector.remove((None, OWL.disjointWith, SL.Feature))
    found = classify(detector)
    assert found is not None
    assert bool(found.unsatisfiable) == disjoint
    assert features_that_are_places(detector, found) == {"House"}


# (e) ROBOT's report.


@pytest.mark.robot
def test_robots_report_has_no_error(merged: Path, tmp_path: Path) -> None:
    assert report_errors(merged, tmp_path / "report.tsv") == []


@pytest.mark.robot
def test_a_class_without_a_label_is_an_error(detector: Graph, tmp_path: Path) -> None:
    detector.remove((SL.House, RDFS.label, None))
    found = report_errors(write(detector, tmp_path), tmp_path / "report.tsv")
    assert [line.partition(":")[0] for line in found] == ["missing_label"]
    assert found[0].endswith("House")


# (f) A second reasoner.


@pytest.mark.robot
def test_elk_agrees_about_the_56(
    closure: Graph, merged: Path, golden: Conclusions, tmp_path: Path
) -> None:
    """These conclusions are within OWL 2 EL, which is all that ELK knows."""
    assert conclusions(closure, elk(merged, tmp_path / "elk.ttl")) == golden


@pytest.mark.robot
def test_elk_would_notice_a_lost_axiom(
    detector: Graph, golden: Conclusions, tmp_path: Path
) -> None:
    detector.remove((SL.indicates, OWL.propertyChainAxiom, None))
    found = conclusions(detector, elk(write(detector, tmp_path), tmp_path / "elk.ttl"))
    assert found["House"] == golden["House"]
    assert found["BasketballCourt"] != golden["BasketballCourt"]
