"""The bundled ontology as data: every module, feature, indication, tag and zone is complete."""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path

import pytest
from rdflib import OWL, RDF, RDFS, XSD, Graph, Literal, Namespace, URIRef
from rdflib.collection import Collection
from rdflib.namespace import PROV, SKOS
from rdflib.term import Node

FOLDER = Path(__file__).resolve().parents[2] / "ontology"
SL = Namespace("https://w3id.org/symboslam#")

ENVIRONMENTS = (
    "Residential Commercial Industrial CommunityFacility ParksAndRecreation TransportAndServices "
    "NonUrban Military"
).split()
ZONES = {
    "Residential": "RZ1 RZ2 RZ3 RZ4 RZ5",
    "Commercial": "CZ1 CZ2 CZ3 CZ4 CZ5 CZ6",
    "Industrial": "IZ1 IZ2",
    "CommunityFacility": "CFZ",
    "ParksAndRecreation": "PRZ1 PRZ2",
    "TransportAndServices": "TSZ1 TSZ2",
    "NonUrban": "NUZ1 NUZ2 NUZ3 NUZ4 NUZ5",
}
DETECTOR_LABELS = (
    "Person Airplane Tree Tower Skyscraper Missile Plant LandVehicle Helicopter Car Building Bus "
    "Tank Table Boy Dog House Rifle Girl Bench OfficeBuilding Horse Train Bird Sheep Cat "
    "TrafficLight Billboard StopSign FireHydrant Bull Cattle ConvenienceStore Aircraft Kangaroo "
    "Bomb Apartment AttackHelicopter BasketballBackboard BasketballCourt BusStop C17 Factory "
    "FighterJet GasStation GasStationPump Humvee MissileLauncher Rotunda ShippingContainer Silo "
    "Slide SoccerGoals PowerSubstation Swingset Warehouse"
).split()
# Tags that map an area of land use and no thing that stands somewhere.
LAND_USE_KEYS = {"landuse", "landcover", "place"}
LAND_USE_TAGS = {
    "leisure=park",
    "leisure=garden",
    "leisure=nature_reserve",
    "natural=wood",
    "natural=scrub",
    "natural=grassland",
    "natural=water",
    "natural=beach",
}
WILDCARDS = {
    "shop",
    "office",
    "craft",
    "building",
    "sport",
    "playground",
    "healthcare",
    "traffic_sign",
    "traffic_calming",
    "advertising",
}

# A reason is quoted alone, so it must not begin with a word that points back.
PRONOUNS = {"It", "Its", "Others", "Such", "Their", "They", "These", "Those"}

Ontology = dict[str, Graph]


@pytest.fixture(scope="module")
def modules() -> Ontology:
    """Module name -> its graph, for the modules at the top of the folder."""
    found = {path.stem: Graph().parse(path) for path in sorted(FOLDER.glob("*.ttl"))}
    assert len(found) >= 6
    return found


@pytest.fixture(scope="module")
def merged(modules: Ontology) -> Graph:
    """All modules in one graph."""
    graph = Graph()
    for module in modules.values():
        graph += module
    return graph


def name(term: Node) -> str:
    """Local name of a term of ours."""
    return str(term).removeprefix(str(SL))


def below(graph: Graph, top: URIRef) -> set[URIRef]:
    """Named classes below ``top``, without it."""
    found = graph.transitive_subjects(RDFS.subClassOf, top)
    return {c for c in found if isinstance(c, URIRef)} - {top}


def restrictions(graph: Graph, subject: Node, along: URIRef) -> Iterator[tuple[Node, Node]]:
    """(restriction, filler) of each asserted ``subject subClassOf (along some filler)``."""
    for target in graph.objects(subject, RDFS.subClassOf):
        if (target, OWL.onProperty, along) in graph:
            filler = graph.value(target, OWL.someValuesFrom)
            assert filler is not None, f"{name(subject)}: restriction without filler"
            yield target, filler


def features(graph: Graph) -> set[URIRef]:
    """Classes of landmarks: those with a tag, a detector label or an indication."""
    return {
        c
        for c in below(graph, SL.Feature)
        if (c, SL.osmTag, None) in graph
        or (c, SL.detectorLabel, None) in graph
        or any(restrictions(graph, c, SL.indicates))
    }


def annotated(graph: Graph, subject: Node, target: Node) -> list[Node]:
    """The owl:Axiom nodes that annotate ``subject subClassOf target``."""
    return [
        axiom
        for axiom in graph.subjects(OWL.annotatedTarget, target)
        if (axiom, OWL.annotatedSource, subject) in graph
        and (axiom, OWL.annotatedProperty, RDFS.subClassOf) in graph
        and (axiom, RDF.type, OWL.Axiom) in graph
    ]


def words(graph: Graph, subject: Node, predicate: URIRef) -> str:
    """The one English text of a term; fails where there is none or more than one."""
    found = list(graph.objects(subject, predicate))
    assert len(found) == 1, f"{name(subject)}: {len(found)} values of {predicate}"
    text = found[0]
    assert isinstance(text, Literal)
    assert text.language == "en", f"{name(subject)}: {predicate} is not marked as English"
    assert str(text).strip() == str(text) != ""
    return str(text)


def environments_of(graph: Graph, place: Node) -> set[str]:
    """Environment types that a place is a kind of or a part of."""
    reached: set[str] = set()
    waiting, seen = [place], set[Node]()
    while waiting:
        one = waiting.pop()
        if one in seen:
            continue
        seen.add(one)
        if name(one) in ENVIRONMENTS:
            reached.add(name(one))
        waiting += [c for c in graph.objects(one, RDFS.subClassOf) if isinstance(c, URIRef)]
        waiting += [filler for _, filler in restrictions(graph, one, SL.partOf)]
    return reached


def test_every_class_and_property_has_a_label_and_a_definition(merged: Graph) -> None:
    kinds = (OWL.Class, OWL.ObjectProperty, OWL.AnnotationProperty)
    terms = {t for kind in kinds for t in merged.subjects(RDF.type, kind)}
    ours = {t for t in terms if str(t).startswith(SL)}
    assert len(ours) > 400
    for term in ours:
        words(merged, term, RDFS.label)
        assert words(merged, term, SKOS.definition).endswith("."), name(term)


def test_no_label_and_no_definition_is_used_twice(merged: Graph) -> None:
    classes = below(merged, SL.Feature) | below(merged, SL.Place)
    for predicate in (RDFS.label, SKOS.definition):
        uses = Counter(words(merged, c, predicate).lower() for c in classes)
        assert [text for text, count in uses.items() if count > 1] == []


def test_every_feature_indicates_a_place_with_strength_source_and_reason(merged: Graph) -> None:
    found = features(merged)
    assert len(found) > 300
    places = below(merged, SL.Place)
    for feature in found:
        links = list(restrictions(merged, feature, SL.indicates))
        assert links, f"{name(feature)} indicates nothing"
        assert len({filler for _, filler in links}) == len(links), name(feature)
        for restriction, place in links:
            where = f"{name(feature)} -> {name(place)}"
            assert place in places, where
            axioms = annotated(merged, feature, restriction)
            assert len(axioms) == 1, where
            strength = merged.value(axioms[0], SL.strength)
            assert isinstance(strength, Literal), where
            assert strength.datatype == XSD.decimal, where
            assert 0 < float(strength) <= 1, where
            source = merged.value(axioms[0], PROV.wasDerivedFrom)
            assert (source, RDF.type, PROV.Entity) in merged, where
            reason = words(merged, axioms[0], RDFS.comment)
            assert reason[0].isupper(), where
            assert reason.endswith("."), where
            assert 5 <= len(reason.split()) <= 30, where
            assert reason.split()[0] not in PRONOUNS, f"{where} does not stand alone: {reason}"


def test_every_annotated_axiom_is_asserted(merged: Graph) -> None:
    axioms = list(merged.subjects(RDF.type, OWL.Axiom))
    assert len(axioms) > 600
    for axiom in axioms:
        subject = merged.value(axiom, OWL.annotatedSource)
        target = merged.value(axiom, OWL.annotatedTarget)
        assert (subject, RDFS.subClassOf, target) in merged, subject


def test_no_reason_is_used_twice(merged: Graph) -> None:
    axioms = merged.subjects(RDF.type, OWL.Axiom)
    uses = Counter(words(merged, axiom, RDFS.comment) for axiom in axioms)
    assert [text for text, count in uses.items() if count > 1] == []


def test_sources_are_named_and_can_be_looked_up(merged: Graph) -> None:
    sources = set(merged.subjects(RDF.type, PROV.Entity))
    assert len(sources) >= 5
    assert sources == set(merged.objects(None, PROV.wasDerivedFrom))
    for source in sources:
        words(merged, source, RDFS.label)
        assert str(merged.value(source, RDFS.seeAlso)).startswith("http"), source


def test_every_feature_is_either_static_or_dynamic(merged: Graph) -> None:
    static, dynamic = below(merged, SL.StaticFeature), below(merged, SL.DynamicFeature)
    assert static
    assert dynamic
    assert static & dynamic == set()
    assert below(merged, SL.Feature) - static - dynamic == {SL.StaticFeature, SL.DynamicFeature}


def test_groups_only_sort(modules: Ontology) -> None:
    groups = modules["feature-groups"]
    assert len(below(groups, SL.StaticFeature)) > 20
    for predicate in (SL.osmTag, SL.detectorLabel, OWL.onProperty):
        assert list(groups.subject_objects(predicate)) == []


def test_the_detector_labels_are_the_56(merged: Graph) -> None:
    labels = [str(label) for label in merged.objects(None, SL.detectorLabel)]
    assert sorted(labels) == sorted(DETECTOR_LABELS)
    assert len(labels) == 56
    per_feature = Counter(merged.subjects(SL.detectorLabel, None))
    assert max(per_feature.values()) == 1


def test_at_least_150_further_features_carry_tags(merged: Graph) -> None:
    tagged = set(merged.subjects(SL.osmTag, None)) - set(merged.subjects(SL.detectorLabel, None))
    assert len(tagged) >= 150


def test_tags_are_well_formed_and_belong_to_one_class(merged: Graph) -> None:
    owners = defaultdict[str, list[str]](list)
    for feature, text in merged.subject_objects(SL.osmTag):
        owners[str(text)].append(name(feature))
    assert len(owners) > 800
    assert {tag: who for tag, who in owners.items() if len(who) > 1} == {}
    for tag in owners:
        key, equals, value = tag.partition("=")
        assert key.strip() == key != "", tag
        assert equals == "=", tag
        assert value.strip() == value != "", tag
        assert value == "*" or "*" not in value, tag
        assert key not in LAND_USE_KEYS, tag
        assert tag not in LAND_USE_TAGS, tag
    assert {f"{key}=*" for key in WILDCARDS} <= set(owners)


def test_environment_types(merged: Graph) -> None:
    types = {c for c in merged.subjects(RDFS.subClassOf, SL.Environment)}
    assert {name(c) for c in types} == set(ENVIRONMENTS)
    colours = [str(merged.value(c, SL.colour)) for c in types]
    assert len(set(colours)) == len(types)
    for colour in colours:
        assert colour[0] == "#"
        assert len(bytes.fromhex(colour[1:])) == 3
    disjoint = [set(Collection(merged, members)) for members in merged.objects(None, OWL.members)]
    assert types in disjoint


def test_schemes(merged: Graph) -> None:
    notations = {
        str(merged.value(scheme, SKOS.notation)): scheme
        for scheme in merged.subjects(RDF.type, SKOS.ConceptScheme)
    }
    assert set(notations) == {"all", "territory-plan"}
    members = {
        notation: {name(c) for c in merged.subjects(SKOS.inScheme, scheme)}
        for notation, scheme in notations.items()
    }
    assert members["all"] == set(ENVIRONMENTS)
    assert members["territory-plan"] == set(ENVIRONMENTS) - {"Military"}
    assert list(merged.subjects(SL.defaultScheme, Literal(True))) == [notations["all"]]


def test_plan_zones_are_complete(merged: Graph) -> None:
    zones = set(merged.subjects(SL.planZone, Literal(True)))
    assert {name(zone) for zone in zones} == set(" ".join(ZONES.values()).split())
    for environment, codes in ZONES.items():
        for code in codes.split():
            assert (SL[code], RDFS.subClassOf, SL[environment]) in merged
            label = words(merged, SL[code], RDFS.label)
            assert label.startswith(f"{code} "), label


def test_every_environment_has_a_defined_feature_class(merged: Graph) -> None:
    for environment in ENVIRONMENTS:
        definition = merged.value(SL[f"{environment}Feature"], OWL.equivalentClass)
        members = merged.value(definition, OWL.intersectionOf)
        assert members is not None
        parts = set(Collection(merged, members))
        assert SL.Feature in parts
        (restriction,) = parts - {SL.Feature}
        assert (restriction, OWL.onProperty, SL.indicates) in merged
        assert (restriction, OWL.someValuesFrom, SL[environment]) in merged


def test_every_place_leads_to_an_environment(modules: Ontology, merged: Graph) -> None:
    places = {c for c in modules["places"].subjects(RDF.type, OWL.Class) if isinstance(c, URIRef)}
    assert {"School", "Airport", "SoccerField"} <= {name(place) for place in places}
    for place in places:
        assert environments_of(merged, place), name(place)
    assert environments_of(merged, SL.Airport) == {"CommunityFacility", "TransportAndServices"}


def test_every_environment_is_indicated(merged: Graph) -> None:
    indicated: Counter[str] = Counter()
    for feature in features(merged):
        for _, place in restrictions(merged, feature, SL.indicates):
            indicated.update(environments_of(merged, place))
    assert set(indicated) == set(ENVIRONMENTS)
    assert min(indicated.values()) >= 10


def test_absence_points_to_open_country(merged: Graph) -> None:
    assert list(merged.subjects(SL.absenceFeature, Literal(True))) == [SL.OpenGround]
    ((_, place),) = restrictions(merged, SL.OpenGround, SL.indicates)
    assert place == SL.NonUrban


def test_no_feature_is_a_place(merged: Graph) -> None:
    assert below(merged, SL.Feature) & below(merged, SL.Place) == set()
    disjoint = {(SL.Feature, SL.Place), (SL.StaticFeature, SL.DynamicFeature)}
    for one, other in disjoint:
        assert (one, OWL.disjointWith, other) in merged or (other, OWL.disjointWith, one) in merged
