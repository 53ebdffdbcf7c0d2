"""Maps in RDF: valid Turtle and N-Quads that say the same, in terms that are defined."""

from __future__ import annotations

import re
import warnings
from collections.abc import Callable
from datetime import UTC, datetime
from importlib.resources import files
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rdflib import RDF, RDFS, XSD, Dataset, Graph, Literal, Namespace, URIRef
from rdflib.compare import isomorphic

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.frame import Frame
from symboslam.engine.landmarks import ReadReport
from symboslam.engine.writers import write_map
from symboslam.engine.writers.rdf import base_of
from symboslam.engine.writers.rdf_files import read_graph
from symboslam.engine.writers.rdf_records import digits
from symboslam.engine.writers.rdf_syntax import NQuads, Turtle
from symboslam.errors import InputError

Make = Callable[..., EnvironmentMap]
BASE = "https://example.org/town/"
SL = Namespace("https://w3id.org/symboslam#")
GEO = Namespace("http://www.opengis.net/ont/geosparql#")
SOSA = Namespace("http://www.w3.org/ns/sosa/")
PROV = Namespace("http://www.w3.org/ns/prov#")
DCTERMS = Namespace("http://purl.org/dc/terms/")
WHEN = datetime(2026, 3, 1, 12, 30, tzinfo=UTC)


def graph_of(environment_map: EnvironmentMap, folder: Path, ending: str, **options: Any) -> Graph:
    options = {"base": BASE, "ended": WHEN, **options}
    write_map(environment_map, folder / f"map.{ending}", **options)
    return read_graph(folder / f"map.{ending}")


@pytest.fixture
def graph(make_town: Make, tmp_path: Path) -> Graph:
    return graph_of(make_town(Frame.around(9.52, 47.14)), tmp_path, "ttl", reasons=2)


def test_turtle_and_nquads_say_the_same(town: EnvironmentMap, tmp_path: Path) -> None:
    turtle, nquads = (graph_of(town, tmp_path, ending, reasons=2) for ending in ("ttl", "nq"))
    assert len(turtle) > 300
    assert isomorphic(turtle, nquads)


def test_nquads_have_a_graph_for_each_topic(town: EnvironmentMap, tmp_path: Path) -> None:
    write_map(town, tmp_path / "map.nq", base=BASE)
    lines = (tmp_path / "map.nq").read_text().splitlines()
    graphs = {line.rsplit(" ", 2)[1] for line in lines}
    topics = ("provenance", "landmarks", "segments", "terms")
    assert graphs == {f"<{BASE}{topic}>" for topic in topics}
    (house,) = (x for x in lines if x.startswith(f"<{BASE}landmark/n0> <{RDF.type}> <{SL.House}>"))
    assert house.endswith(f"<{BASE}landmarks> .")


@pytest.mark.parametrize("line", ["", '© "Contributors", ODbL 1.0'])
def test_rights(make_town: Make, tmp_path: Path, line: str) -> None:
    graph = graph_of(make_town(report=ReadReport(attribution=line)), tmp_path, "ttl")
    for name in ("map", "landmarks"):
        statements = list(graph.objects(URIRef(BASE + name), DCTERMS.rights))
        labels = [str(graph.value(statement, RDFS.label)) for statement in statements]
        assert labels == ([line] if line else [])


def test_landmarks(graph: Graph) -> None:
    house = URIRef(BASE + "landmark/n1")
    assert set(graph.objects(house, RDF.type)) == {SL.Landmark, GEO.Feature, SL.House}
    observation = graph.value(None, SOSA.hasFeatureOfInterest, house)
    assert graph.value(observation, SOSA.observedProperty) == SL.featureClass
    result = graph.value(observation, SOSA.hasResult)
    assert graph.value(result, SL.featureClass) == SL.House
    assert graph.value(result, SL.confidence) == Literal("0.9", datatype=XSD.decimal)
    tiny = graph.value(URIRef(BASE + "observation/n3"), SOSA.hasResult)
    assert str(graph.value(tiny, SL.confidence)) == "0.00001"  # xsd:decimal knows no exponent


def test_segments(graph: Graph) -> None:
    segment = URIRef(BASE + "segment/0-0-0")
    assert graph.value(segment, SL.environment) == SL.Residential
    assert graph.value(segment, SL.landmarkCount) == Literal(4)
    classification = graph.value(None, SOSA.hasFeatureOfInterest, segment)
    assert (classification, RDF.type, PROV.Entity) not in graph
    result = graph.value(classification, SOSA.hasResult)
    assert graph.value(result, PROV.wasGeneratedBy) == URIRef(BASE + "run")
    assert graph.value(classification, PROV.wasGeneratedBy) is None
    distribution = {
        graph.value(node, SL.environment): float(str(graph.value(node, SL.probability)))
        for node in graph.objects(result, SL.hasProbability)
    }
    assert distribution == {SL.Residential: 0.7, SL.Commercial: 0.1, SL.NonUrban: 0.2}
    shares = {
        (graph.value(node, SL.featureClass), graph.value(node, SL.environment)): float(
            str(graph.value(node, SL.share))
        )
        for node in graph.objects(classification, SL.hasContribution)
    }
    assert shares == {
        (SL.House, SL.Residential): 0.6,
        (SL.Tree, SL.Residential): 0.15,
        (SL.Tree, SL.NonUrban): 0.15,
        (None, SL.Residential): -0.05,
        (None, SL.Commercial): 0.1,
        (None, SL.NonUrban): 0.05,
    }


def test_unknown_segments_have_no_classification(graph: Graph) -> None:
    unknown = URIRef(BASE + "segment/0-1-0")
    assert (unknown, RDF.type, SL.Segment) in graph
    assert graph.value(unknown, SL.environment) is None
    assert graph.value(None, SOSA.hasFeatureOfInterest, unknown) is None


def test_lineage(graph: Graph) -> None:
    run = graph.value(URIRef(BASE + "map"), PROV.wasGeneratedBy)
    assert graph.value(run, PROV.endedAtTime) == Literal(WHEN)
    used = set(graph.objects(run, PROV.used))
    assert used == {URIRef(BASE + "landmarks"), URIRef(BASE + "ontology")}
    assert str(graph.value(URIRef(BASE + "ontology"), SL.sha256)) == "ab" * 32
    agent = graph.value(run, PROV.wasAssociatedWith)
    assert (agent, RDF.type, PROV.SoftwareAgent) in graph
    settings = {
        str(graph.value(node, SL.settingName)): graph.value(node, SL.settingValue)
        for node in graph.objects(run, SL.hasSetting)
    }
    assert settings == {
        "profile": Literal("default"),
        "threshold": Literal("0.95", datatype=XSD.decimal),
        "cells": Literal(2),
    }
    left = {
        (str(graph.value(node, SL.cause)), int(str(graph.value(node, SL["count"]))))
        for node in graph.objects(URIRef(BASE + "landmarks"), SL.leftOut)
    }
    assert left == {("not in the ontology", 2), ("outside the area", 1)}


def test_geometries_name_their_coordinate_system(make_town: Make, tmp_path: Path) -> None:
    metric = graph_of(make_town(), tmp_path, "ttl")
    texts = [str(o) for o in metric.objects(None, GEO.asWKT)]
    assert len(texts) == 5 + 4 + 1
    assert all(t.startswith("<https://w3id.org/symboslam/crs/local-metres> P") for t in texts)
    assert any(t.endswith(" POINT (-60.000 -60.000)") for t in texts)
    degrees = graph_of(make_town(Frame.around(9.52, 47.14)), tmp_path, "ttl")
    literals = list(degrees.objects(None, GEO.asWKT))
    crs84 = "<http://www.opengis.net/def/crs/OGC/1.3/CRS84> "
    assert all(str(o).startswith(crs84) for o in literals)
    assert {o.datatype for o in literals if isinstance(o, Literal)} == {GEO.wktLiteral}


def test_every_term_is_defined_in_the_ontology(graph: Graph) -> None:
    ontology = Graph()
    for name in ("core.ttl", "external.ttl", "map.ttl", "environments.ttl"):
        ontology.parse(data=(files("symboslam.ontology") / name).read_bytes(), format="turtle")
    defined = set(ontology.subjects(RDF.type))
    given = {SL[n] for n in ("House", "Shop", "Tree", "OpenGround", "source-judgement")}
    used = {t for triple in graph for t in triple if isinstance(t, URIRef) and t in SL} - given
    assert len(used) > 30
    assert used - defined == set()
    properties = {
        p
        for p in graph.predicates()
        if not str(p).startswith(
            (str(RDF), "http://www.w3.org/2000/01/", "http://www.w3.org/2002/07/")
        )
    }
    assert properties - defined == set()


def test_all_iris_are_absolute(town: EnvironmentMap, tmp_path: Path) -> None:
    write_map(town, tmp_path / "map.ttl")
    text = (tmp_path / "map.ttl").read_text()
    iris = re.findall(r"<([^<> ]*)>", text)
    assert len(iris) > 15
    assert all(re.match(r"https?://", iri) for iri in iris)


def test_equal_maps_give_equal_files(make_town: Make, tmp_path: Path) -> None:
    for ending in ("ttl", "nq"):
        texts = []
        for name in ("one", "two"):
            write_map(make_town(), tmp_path / f"{name}.{ending}", ended=None)
            texts.append((tmp_path / f"{name}.{ending}").read_text())
        assert texts[0] == texts[1]
        assert "endedAtTime" not in texts[0]
        write_map(make_town(), tmp_path / f"now.{ending}")
        now = (tmp_path / f"now.{ending}").read_text().splitlines()
        extra = [line for line in now if line not in texts[0].splitlines()]
        assert len(extra) == 1
        assert "endedAtTime" in extra[0]


def test_the_base_depends_on_the_content(make_town: Make) -> None:
    plain = base_of(make_town())
    assert re.fullmatch(r"https://w3id\.org/symboslam/map/[0-9a-f]{16}/", plain)
    confidence = np.array([1.0, 0.9, 0.5, 0.1, 0.7])
    others = [make_town(confidence=confidence), make_town(Frame.around(9.52, 47.14))]
    assert len({plain, *map(base_of, others)}) == 3


@pytest.mark.parametrize(
    ("base", "used"),
    [
        ("https://example.org/m", "https://example.org/m/"),
        ("https://example.org/m#", "https://example.org/m#"),
        (
            "urn:uuid:6e8bc430-9c3a-11d9-9669-0800200c9a66",
            "urn:uuid:6e8bc430-9c3a-11d9-9669-0800200c9a66/",
        ),
    ],
)
def test_a_base_of_ones_own(make_town: Make, base: str, used: str) -> None:
    assert base_of(make_town(), base) == used


@pytest.mark.parametrize("base", ["", "maps/1", "https://example.org/a b", "https://e.org/<x>"])
def test_a_base_that_is_no_absolute_iri_is_refused(
    make_town: Make, tmp_path: Path, base: str
) -> None:
    with pytest.raises(InputError, match="no absolute IRI"):
        write_map(make_town(), tmp_path / "map.ttl", base=base)
    assert list(tmp_path.iterdir()) == []


def test_agents_and_times(make_town: Make, tmp_path: Path) -> None:
    found = make_town(
        time=np.array(["2024-05-01T10:00:00+10:00", None, "May", "2024-05-01", ""], object),
        agent=np.array(["robot 1", "robot 1", None, "é", ""], object),
    )
    graph = graph_of(found, tmp_path, "nq")
    times = {str(s)[-2:]: o for s, o in graph.subject_objects(SOSA.resultTime)}
    assert times == {
        "n0": Literal("2024-05-01T10:00:00+10:00", datatype=XSD.dateTime),
        "n3": Literal("2024-05-01T00:00:00", datatype=XSD.dateTime),
    }
    assert str(graph.value(URIRef(BASE + "observation/n2"), DCTERMS.date)) == "May"
    robot = URIRef(BASE + "agent/robot%201")
    assert (robot, RDF.type, PROV.Agent) in graph
    assert len(list(graph.subjects(PROV.wasAssociatedWith, robot))) == 2
    assert (URIRef(BASE + "agent/%C3%A9"), RDF.type, PROV.Agent) in graph


@settings(deadline=None)
@given(st.text(), st.text())
def test_any_identifier_and_any_text_survive(name: str, text: str) -> None:
    about = URIRef("urn:about")
    found = []
    for syntax in (Turtle(BASE, {"landmark": BASE + "landmark/"}), NQuads(BASE, {})):
        predicate = syntax.iri(str(about))
        values: list[Any] = [syntax.text(text), [(predicate, [syntax.own("landmark", name)])]]
        statements = syntax.statements(
            "<urn:g>", syntax.own("landmark", name), [(predicate, values)]
        )
        form = "turtle" if isinstance(syntax, Turtle) else "nquads"
        dataset = Dataset()
        with warnings.catch_warnings():  # rdflib's parsers use what rdflib deprecates
            warnings.simplefilter("ignore", DeprecationWarning)
            dataset.parse(data=syntax.head() + statements, format=form)
        terms = {t for s, p, o, _ in dataset.quads() for t in (s, p, o)}
        assert Literal(text) in terms
        found.append({t for t in terms if isinstance(t, URIRef)})
    assert found[0] == found[1]
    (landmark,) = found[0] - {about}
    assert unquote(str(landmark).removeprefix(BASE + "landmark/")) == name


def test_identifiers_that_need_escaping(make_town: Make, tmp_path: Path) -> None:
    ids = ['a "b"', "node/1#2?x=%20", "tab\tline\nback\\", "ünï.", "-"]
    found = make_town(id=np.array(ids, object))
    for ending in ("ttl", "nq"):
        graph = graph_of(found, tmp_path, ending)
        landmarks = list(graph.subjects(RDF.type, SL.Landmark))
        assert [isinstance(node, URIRef) for node in landmarks] == [True] * 5
        assert {str(graph.value(node, DCTERMS.identifier)) for node in landmarks} == set(ids)


def test_half_a_surrogate_pair_does_not_break_the_file(make_town: Make, tmp_path: Path) -> None:
    found = make_town(id=np.array(["\udc80", "a", "b", "c", "d"], object))
    graph = graph_of(found, tmp_path, "ttl")
    identifiers = {str(o) for o in graph.objects(None, DCTERMS.identifier)}
    assert {"\ufffd", "a", "b", "c", "d"} <= identifiers


def test_empty_map(empty: EnvironmentMap, tmp_path: Path) -> None:
    graph = graph_of(empty, tmp_path, "nq")
    assert len(list(graph.subjects(RDF.type, SL.Segment))) == 4
    assert graph.value(URIRef(BASE + "landmarks"), SL.landmarkCount) == Literal(0)


def test_iris_of_vocabularies_are_made_valid() -> None:
    for syntax in (Turtle("urn:x:", {}), NQuads("urn:x:", {})):
        assert syntax.iri("http://example.org/a b<c>") == "<http://example.org/a%20b%3Cc%3E>"


@pytest.mark.parametrize(
    ("name", "term"),
    [
        ("a.b", "p:a.b"),
        ("a.", "<urn:p:a.>"),
        ("-a", "<urn:p:-a>"),
        ("0~", "<urn:p:0~>"),
        ("", "<urn:p:>"),
    ],
)
def test_names_that_turtle_cannot_abbreviate(name: str, term: str) -> None:
    assert Turtle("urn:x:", {"p": "urn:p:"}).iri("urn:p:" + name) == term


@pytest.mark.parametrize(("value", "text"), [(1.0, "1.0"), (1e-7, "0.0000001"), (0.1, "0.1")])
def test_decimals_have_no_exponent(value: float, text: str) -> None:
    assert digits(value) == text
