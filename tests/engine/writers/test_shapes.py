"""Written maps conform to the shapes; maps that lack or contradict something do not."""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from rdflib import Graph

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.frame import Frame
from symboslam.engine.landmarks import ReadReport
from symboslam.engine.writers import write_map
from symboslam.engine.writers.rdf_files import read_graph
from symboslam.errors import InputError, MissingExtraError

pytest.importorskip("pyshacl", reason="pySHACL comes with symboslam[shapes]")
from symboslam.engine.validate import validate_map

Make = Callable[..., EnvironmentMap]
PREFIXES = """
PREFIX sl: <https://w3id.org/symboslam#>
PREFIX geo: <http://www.opengis.net/ont/geosparql#>
PREFIX sosa: <http://www.w3.org/ns/sosa/>
PREFIX prov: <http://www.w3.org/ns/prov#>
PREFIX dcterms: <http://purl.org/dc/terms/>
PREFIX owl: <http://www.w3.org/2002/07/owl#>
PREFIX xsd: <http://www.w3.org/2001/XMLSchema#>
PREFIX m: <https://example.org/town/>
PREFIX landmark: <https://example.org/town/landmark/>
PREFIX observation: <https://example.org/town/observation/>
PREFIX segment: <https://example.org/town/segment/>
PREFIX classification: <https://example.org/town/classification/>
"""


@pytest.mark.parametrize("ending", ["ttl", "nq"])
@pytest.mark.parametrize("reasons", [0, 2, 8])
def test_written_maps_conform(
    town: EnvironmentMap, tmp_path: Path, ending: str, reasons: int
) -> None:
    target = tmp_path / f"map.{ending}"
    write_map(town, target, reasons=reasons)
    assert str(validate_map(target)) == "The map conforms to the shapes."


def test_maps_with_agents_and_times_conform(make_town: Make, tmp_path: Path) -> None:
    times = np.array(["2024-05-01T10:00:00Z", None, "2024", None, None], object)
    agents = np.array(["robot 1", "é", None, None, None], object)
    report = ReadReport(attribution="© Contributors")
    found = make_town(Frame.around(9.52, 47.14), time=times, agent=agents, report=report)
    write_map(found, tmp_path / "map.ttl")
    assert validate_map(tmp_path / "map.ttl").conforms


def test_empty_map_conforms(empty: EnvironmentMap, tmp_path: Path) -> None:
    write_map(empty, tmp_path / "map.ttl")
    assert validate_map(tmp_path / "map.ttl").conforms


@pytest.fixture(scope="module")
def turtle(make_town: Make, tmp_path_factory: pytest.TempPathFactory) -> Path:
    target = tmp_path_factory.mktemp("shapes") / "map.ttl"
    write_map(make_town(), target, base="https://example.org/town/", reasons=2)
    return target


BROKEN = {
    "landmark without a class": (
        "DELETE DATA { landmark:n0 sl:featureClass sl:House }",
        "Exactly one class of features is needed",
    ),
    "landmark with two classes": (
        "INSERT DATA { landmark:n0 sl:featureClass sl:Shop }",
        "Exactly one class of features is needed",
    ),
    "landmark of a class that is no feature": (
        "DELETE DATA { landmark:n0 sl:featureClass sl:House } ;"
        "INSERT DATA { landmark:n0 sl:featureClass sl:Residential }",
        "is no subclass of sl:Feature",
    ),
    "landmark of a class that nobody observed": (
        "DELETE DATA { landmark:n0 sl:featureClass sl:House } ;"
        "INSERT DATA { landmark:n0 sl:featureClass sl:Shop }",
        "None of the landmark's observations found the class",
    ),
    "landmark without geometry": (
        "DELETE WHERE { landmark:n0 geo:hasGeometry ?g }",
        "Exactly one geometry is needed",
    ),
    "geometry without a coordinate system": (
        "DELETE { ?g geo:asWKT ?w } INSERT { ?g geo:asWKT 'POINT (1 2)'^^geo:wktLiteral }"
        "WHERE { landmark:n0 geo:hasGeometry ?g . ?g geo:asWKT ?w }",
        "A geometry is a geo:Geometry with one geo:wktLiteral that has the IRI",
    ),
    "landmark without observation": (
        "DELETE WHERE { observation:n0 ?p ?o }",
        "A landmark needs at least one observation",
    ),
    "confidence of 0": (
        "DELETE { ?r sl:confidence ?c } INSERT { ?r sl:confidence 0.0 }"
        "WHERE { observation:n0 sosa:hasResult ?r . ?r sl:confidence ?c }",
        "above 0 and at most 1",
    ),
    "confidence above 1": (
        "DELETE { ?r sl:confidence ?c } INSERT { ?r sl:confidence 1.5 }"
        "WHERE { observation:n0 sosa:hasResult ?r . ?r sl:confidence ?c }",
        "above 0 and at most 1",
    ),
    "time that is none": (
        "INSERT DATA { observation:n0 sosa:resultTime 'yesterday' }",
        "one xsd:dateTime",
    ),
    "landmarks that are not counted": (
        "DELETE { ?s sl:landmarkCount ?n } INSERT { ?s sl:landmarkCount 6 }"
        "WHERE { ?s a sl:LandmarkSet ; sl:landmarkCount ?n }",
        "says that it has 6 landmarks, but there are 5",
    ),
    "segment with two environments": (
        "INSERT DATA { segment:0-0-0 sl:environment sl:NonUrban }",
        "at most one environment",
    ),
    "segment with an environment that is not considered": (
        "DELETE DATA { segment:0-0-0 sl:environment sl:Residential } ;"
        "INSERT DATA { segment:0-0-0 sl:environment sl:Military }",
        "environment of a segment must be one that its map considers",
    ),
    "segment without its classification": (
        "DELETE WHERE { classification:0-0-0 ?p ?o }",
        "needs a classification that says why",
    ),
    "segment of two maps": (
        "INSERT DATA { m:other a sl:EnvironmentMap . segment:0-0-0 dcterms:isPartOf m:other }",
        "belongs to exactly one map",
    ),
    "probabilities that do not add up": (
        "DELETE { ?n sl:probability 0.7 } INSERT { ?n sl:probability 0.69999 }"
        "WHERE { ?n sl:probability 0.7 }",
        "add up to 0.99999",
    ),
    "probability below 0": (
        "DELETE { ?n sl:probability 0.1 } INSERT { ?n sl:probability '-0.1'^^xsd:decimal }"
        "WHERE { ?n sl:probability 0.1 }",
        "xsd:decimal from 0 to 1",
    ),
    "probability as text": (
        "DELETE { ?n sl:probability 0.7 } INSERT { ?n sl:probability '0.7' }"
        "WHERE { ?n sl:probability 0.7 }",
        "xsd:decimal from 0 to 1",
    ),
    "share as text": (
        "DELETE { ?n sl:share 0.6 } INSERT { ?n sl:share 'much' } WHERE { ?n sl:share 0.6 }",
        "one share, an xsd:decimal",
    ),
    "distribution that lacks an environment": (
        "DELETE { ?d sl:hasProbability ?n } WHERE { classification:0-1-1 sosa:hasResult ?d ."
        "?d sl:hasProbability ?n . ?n sl:environment sl:Commercial }",
        "The distribution lacks https://w3id.org/symboslam#Commercial",
    ),
    "distribution with an environment twice": (
        "INSERT { ?d sl:hasProbability [ a sl:EnvironmentProbability ;"
        "  sl:environment sl:Commercial ; sl:probability 0.0 ] }"
        "WHERE { classification:0-1-1 sosa:hasResult ?d }",
        "has https://w3id.org/symboslam#Commercial more than once",
    ),
    "contributions that do not add up": (
        "DELETE { ?n sl:share 0.6 } INSERT { ?n sl:share 0.5 } WHERE { ?n sl:share 0.6 }",
        "add up to 0.60, but its probability is 0.7",
    ),
    "contribution without a count": (
        "DELETE { ?n sl:count ?c } WHERE { ?n a sl:Contribution ; sl:share 0.6 ; sl:count ?c }",
        "says how many landmarks it comes from",
    ),
    "map without a run": (
        "DELETE DATA { m:map prov:wasGeneratedBy m:run }",
        "A map was generated by exactly one run",
    ),
    "run without landmarks": (
        "DELETE DATA { m:run prov:used m:landmarks }",
        "used exactly one set of landmarks",
    ),
    "run without ontology": (
        "DELETE DATA { m:run prov:used m:ontology }",
        "used exactly one ontology source",
    ),
    "ontology without its hash": (
        "DELETE { m:ontology sl:sha256 ?h } INSERT { m:ontology sl:sha256 'new' }"
        "WHERE { m:ontology sl:sha256 ?h }",
        "SHA-256 of its content",
    ),
    "software without a version": (
        "DELETE { ?a owl:versionInfo ?v } WHERE { ?a owl:versionInfo ?v }",
        "Software has a version",
    ),
}


@pytest.mark.parametrize("name", BROKEN)
def test_broken_maps_are_reported(turtle: Path, name: str) -> None:
    update, message = BROKEN[name]
    graph = read_graph(turtle)
    before = set(graph)
    graph.update(PREFIXES + update)
    assert set(graph) != before, "the update must change something"
    report = validate_map(graph)
    assert not report.conforms
    assert message in str(report)


def test_the_report_names_the_node_and_the_value(turtle: Path) -> None:
    graph = read_graph(turtle)
    graph.update(PREFIXES + "INSERT DATA { observation:n0 sosa:resultTime 'yesterday' }")
    (violation,) = validate_map(graph).violations
    assert violation.node == "https://example.org/town/observation/n0"
    assert violation.value == "yesterday"
    assert violation.path == "http://www.w3.org/ns/sosa/resultTime"
    assert all(part in str(violation) for part in (violation.node, violation.path, "yesterday"))


def test_the_report_says_where_a_node_without_a_name_is(turtle: Path) -> None:
    graph = read_graph(turtle)
    update, _ = BROKEN["confidence above 1"]
    graph.update(PREFIXES + update)
    (violation,) = validate_map(graph).violations
    assert violation.within == "https://example.org/town/observation/n0"
    assert str(violation).startswith("https://example.org/town/observation/n0 (a part of it")
    assert str(validate_map(graph)).startswith("1 violation:\n")


def test_paths_of_several_steps_are_written_as_in_sparql(turtle: Path) -> None:
    graph = read_graph(turtle)
    graph.update(PREFIXES + "DELETE WHERE { observation:n0 ?p ?o }")
    paths = {violation.path for violation in validate_map(graph).violations}
    assert "^http://www.w3.org/ns/sosa/hasFeatureOfInterest" in paths


def test_shapes_of_ones_own(turtle: Path, tmp_path: Path) -> None:
    mine = tmp_path / "mine.ttl"
    prefixes = PREFIXES.replace("PREFIX", "@prefix").replace(">\n", "> .\n")
    mine.write_text(
        prefixes + "@prefix sh: <http://www.w3.org/ns/shacl#> .\n"
        "m:Few a sh:NodeShape ; sh:targetClass sl:LandmarkSet ; sh:property [\n"
        "  sh:path sl:landmarkCount ; sh:maxInclusive 4 ; sh:message 'Too many.'@en ] ."
    )
    (violation,) = validate_map(turtle, mine).violations
    assert (violation.message, violation.value) == ("Too many.", "5")
    mine.write_text(mine.read_text().replace("sh:maxInclusive 4", "sh:minLength 'few'"))
    with pytest.raises(InputError, match=r"mine\.ttl: no usable shapes"):
        validate_map(turtle, mine)
    with pytest.raises(InputError, match="holds no SHACL shapes"):
        validate_map(turtle, turtle)


def test_files_that_cannot_be_validated(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"files that end in \.ttl, \.nt, \.nq"):
        validate_map(tmp_path / "map.geojson")
    with pytest.raises(InputError, match="cannot be read"):
        validate_map(tmp_path / "missing.ttl")
    (tmp_path / "broken.ttl").write_text("<a> <b>")
    with pytest.raises(InputError, match="does not parse"):
        validate_map(tmp_path / "broken.ttl")


def test_without_pyshacl_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pyshacl", None)
    with pytest.raises(MissingExtraError, match=r"symboslam\[shapes\]"):
        validate_map(Graph())
