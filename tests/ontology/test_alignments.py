"""The alignments: every link leads somewhere, old names still work, and no feature is added."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest
from rdflib import OWL, RDF, RDFS, SKOS, Graph, Literal, Namespace, URIRef

from symboslam.errors import ReasonerError
from symboslam.reasoning.axioms import split
from symboslam.reasoning.hermit import Hermit, find_java
from symboslam.reasoning.knowledge import Feature, Knowledge
from symboslam.reasoning.sources import bundled_files, read_bundled

FOLDER = Path(__file__).resolve().parents[2] / "ontology"
SHARED = Path(os.environ.get("SYMBOSLAM_SHARED", Path(__file__).resolve().parents[3] / "shared"))
SL = Namespace("https://w3id.org/symboslam#")
OLD = Namespace("http://www.semanticweb.org/brandonio/ontologies/2022/1/SymboSLAM#")
O4M = Namespace("http://www.semanticweb.org/swarmShepherdingOntology/Onto4MAT#")

LOGICAL = (OWL.equivalentClass, RDFS.subClassOf, RDFS.subPropertyOf)
MAPPINGS = (
    SKOS.exactMatch, SKOS.closeMatch, SKOS.broadMatch, SKOS.narrowMatch, SKOS.relatedMatch,
)  # fmt: skip
NAMES = (
    "cora envo geosparql iso-5087-2 linkedgeodata owl-time prov-o sosa-ssn symboslam-2022 wikidata"
).split()
TARGETS = {
    "envo": r"http://purl\.obolibrary\.org/obo/ENVO_\d{8}",
    "linkedgeodata": r"http://linkedgeodata\.org/ontology/[A-Z][A-Za-z]+",
    "iso-5087-2": r"https://w3id\.org/citydata/part2/v1/[A-Z][A-Za-z]+",
    "wikidata": r"http://www\.wikidata\.org/entity/Q[1-9]\d*",
}
"""Alignment with another vocabulary -> the form of its IRIs."""
OTHER_NAMES = {
    "House": "House",
    "StopLight": "TrafficLight",
    "TrafficLight": "TrafficLight",
    "Hydrant": "FireHydrant",
    "SwingSet": "Swingset",
    "Cow": "Cattle",
    "Bush": "Shrub",
    "Building": "UnspecifiedBuilding",
}
"""Local name in the ontology of 2022 -> name of the feature."""
NO_FEATURES = "Airport Bathroom Fence Garage Laundry Residential StaticObjects Team Vehicle".split()


@pytest.fixture(scope="module")
def alignments() -> dict[str, Graph]:
    return {name: Graph().parse(FOLDER / "alignments" / f"{name}.ttl") for name in NAMES}


@pytest.fixture(scope="module")
def closure() -> Graph:
    """Every module, upstream and alignment in one graph."""
    graph = Graph()
    for pattern in ("*.ttl", "upstream/*.ttl", "alignments/*.ttl"):
        for path in FOLDER.glob(pattern):
            graph.parse(path)
    return graph


@pytest.fixture(scope="module")
def knowledge() -> Knowledge:
    """Reasoned anew where there is a reasoner, since the bundled result may be older."""
    try:
        find_java()
    except ReasonerError:
        pytest.skip("no Java runtime")
    return Knowledge.load(cache=False)


def links(graph: Graph) -> list[tuple[URIRef, URIRef, URIRef]]:
    """(subject, relation, object) of each link between two names."""
    return [
        (s, p, o)
        for p in (*LOGICAL, *MAPPINGS)
        for s, o in graph.subject_objects(p)
        if isinstance(s, URIRef) and isinstance(o, URIRef) and isinstance(p, URIRef)
    ]


@pytest.mark.parametrize("name", NAMES)
def test_every_link_starts_at_a_term_that_is_declared(
    name: str, alignments: dict[str, Graph], closure: Graph
) -> None:
    found = links(alignments[name])
    assert len(found) >= 4
    for subject, relation, target in found:
        assert (subject, RDF.type, None) in closure, f"{name}: {subject} is not declared"
        if relation in LOGICAL:
            assert (target, RDF.type, None) in closure, f"{name}: {target} is not declared"


@pytest.mark.parametrize("name", TARGETS)
def test_targets_have_the_form_of_their_vocabulary(name: str, alignments: dict[str, Graph]) -> None:
    targets = {str(o) for _, _, o in links(alignments[name]) if not o.startswith(SL)}
    assert targets
    assert [t for t in sorted(targets) if not re.fullmatch(TARGETS[name], t)] == []


def test_mappings_say_one_thing_of_a_pair(closure: Graph) -> None:
    """SKOS: what matches exactly is neither broader, narrower nor only related."""
    said: dict[tuple[URIRef, URIRef], set[URIRef]] = {}
    for subject, relation, target in links(closure):
        if relation in MAPPINGS:
            said.setdefault((subject, target), set()).add(relation)
    assert len(said) > 250
    assert {pair: relations for pair, relations in said.items() if len(relations) > 1} == {}


def test_no_item_of_wikidata_is_exactly_two_things(alignments: dict[str, Graph]) -> None:
    exact = list(alignments["wikidata"].subject_objects(SKOS.exactMatch))
    assert len(exact) > 40
    assert len({target for _, target in exact}) == len(exact)


def test_features_mapped_exactly_to_linkedgeodata_have_tags(
    alignments: dict[str, Graph], closure: Graph
) -> None:
    """Both sides stand for a tag; a place or a group has none and is named here."""
    exact = {str(s) for s in alignments["linkedgeodata"].subjects(SKOS.exactMatch)}
    tagged = {name for name in exact if (URIRef(name), SL.osmTag, None) in closure}
    assert len(tagged) > 100
    others = "Airport Building GolfCourse Marina Office Park Shop".split()
    assert exact - tagged == {str(SL[name]) for name in others}


def test_the_150_classes_of_2022(alignments: dict[str, Graph]) -> None:
    graph = alignments["symboslam-2022"]
    classes = {c for c in graph.subjects(RDF.type, OWL.Class) if str(c).startswith(OLD)}
    assert len(classes) == 150
    for one in classes:
        equal = list(graph.objects(one, OWL.equivalentClass))
        mapped = [o for p in MAPPINGS for o in graph.objects(one, p)]
        assert len(equal) == 1 or (not equal and mapped), one
        if not equal:  # then it says why
            assert any(isinstance(o, Literal) for o in graph.objects(one, RDFS.comment)), one
    assert list(graph.subject_objects(RDFS.subClassOf)) == []


def test_the_classes_of_2022_are_those_of_the_original(alignments: dict[str, Graph]) -> None:
    original = SHARED / "upstream" / "SymboSLAM.owl"
    if not original.is_file():
        pytest.skip(f"{original} is not here")
    text = original.read_text(encoding="utf-8")
    declared = set(re.findall(r'<Declaration>\s*<Class IRI="#?([^"]+)"/>', text))
    names = {iri.rsplit("#", 1)[-1] for iri in declared}
    ours = alignments["symboslam-2022"].subjects(RDF.type, OWL.Class)
    assert names == {str(c).removeprefix(OLD) for c in ours}


def test_of_the_alignments_only_the_old_names_are_loaded() -> None:
    deeper = {name for name in bundled_files() if "/" in name}
    assert deeper == {"alignments/symboslam-2022.ttl"}


@pytest.mark.parametrize(("old", "name"), OTHER_NAMES.items())
def test_old_iris_and_names_find_the_feature(old: str, name: str, knowledge: Knowledge) -> None:
    assert knowledge.get_feature(str(OLD[old])).name == name
    assert knowledge.get_feature(old).name == name


@pytest.mark.parametrize("old", NO_FEATURES)
def test_what_is_only_mapped_is_no_feature(old: str, knowledge: Knowledge) -> None:
    assert knowledge.find_feature(str(OLD[old])) is None


def test_each_detector_class_of_the_original_keeps_its_name(
    knowledge: Knowledge, alignments: dict[str, Graph]
) -> None:
    classes = {str(c).removeprefix(OLD) for c in alignments["symboslam-2022"].subjects()}
    labels = {f.detector_label: f for f in knowledge.features if f.detector_label}
    kept = {label for label in labels if label in classes}
    assert len(kept) == 48
    for label in kept:
        assert knowledge.get_feature(str(OLD[label])) == labels[label]


@pytest.mark.slow
def test_old_names_add_nothing(knowledge: Knowledge) -> None:
    """The table with and without the alignment differs in the features' other names only."""
    from symboslam.reasoning.extract import extract
    from symboslam.reasoning.loading import reason

    read = read_bundled()
    old = Graph().parse(FOLDER / "alignments" / "symboslam-2022.ttl")
    assert len(old) > 700
    before = {triple for triple in read.graph if str(triple[0]).startswith(OLD)}
    read.graph -= old
    assert not any(triple in read.graph for triple in before)
    plain = extract(reason(read))

    def without_aliases(features: tuple[Feature, ...]) -> list[tuple[object, ...]]:
        return [(f.name, f.iri, f.static, f.osm_tags, f.kinds, f.site) for f in features]

    assert without_aliases(plain.features) == without_aliases(knowledge.features)
    assert plain.environments == knowledge.environments
    assert plain.indications == knowledge.indications
    assert plain.schemes == knowledge.schemes
    for measure, table in plain.proximities.items():
        assert (table == knowledge.proximities[measure]).all(), measure


@pytest.fixture(scope="module")
def hermit() -> Hermit:
    try:
        find_java()
    except ReasonerError:
        pytest.skip("no Java runtime")
    return Hermit()


def test_the_whole_closure_is_consistent_and_bridges_hold(hermit: Hermit, closure: Graph) -> None:
    declared, axioms = split(closure)
    hierarchy = hermit.classify([*declared, *(t for a in axioms for t in a.triples)])
    assert hierarchy is not None
    assert not hierarchy.unsatisfiable

    def above(name: URIRef) -> set[str]:
        reached, waiting = set[str](), [str(name)]
        while waiting:
            one = waiting.pop()
            if one not in reached:
                reached.add(one)
                waiting += [*hierarchy.parents.get(one, ()), *hierarchy.equals.get(one, ())]
        return reached

    prov = "http://www.w3.org/ns/prov#"
    cora = Namespace("http://www.semanticweb.org/ontologies/2013/7/CORA.owl#")
    robot = above(cora.Robot)
    assert "http://purl.org/ieee1872-owl/cora-bare#Robot" in robot
    assert "http://www.w3.org/ns/sosa/Platform" in robot
    assert {str(O4M.Agent), prov + "Agent", "http://www.opengis.net/ont/geosparql#Feature"} <= robot
    assert prov + "Person" in above(SL.Operator)
    assert prov + "SoftwareAgent" in above(SL.ControlAgent)
    assert prov + "SoftwareAgent" not in robot
    for finding in (SL.LandmarkObservation, SL.SegmentClassification):
        assert above(finding) & {prov + "Activity", prov + "Entity"} == {prov + "Activity"}
    for result in (SL.Detection, SL.EnvironmentDistribution):
        assert above(result) & {prov + "Activity", prov + "Entity"} == {prov + "Entity"}
    house = above(OLD.House)
    assert {str(SL.House), "http://purl.obolibrary.org/obo/ENVO_00000073"} <= house
    assert not house & {str(SL.Place), str(SL.Environment), str(O4M.Environment)}
    assert str(O4M.Environment) in above(SL.Residential)
