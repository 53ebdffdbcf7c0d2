"""Turtle: valid against the shapes, and what it says."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from rdflib import Graph

from symboslam.engine.slam.log import Mission
from symboslam.engine.slam.slam_map import SlamMap
from symboslam.engine.slam.writers import write_slam_map
from symboslam.errors import InputError
from symboslam.reasoning.knowledge import Knowledge

pytest.importorskip("pyshacl", reason="pySHACL comes with symboslam[shapes]")
from symboslam.engine.validate import validate_map

PREFIXES = """
PREFIX sl: <https://w3id.org/symboslam#>
PREFIX os: <http://github.com/Alex23013/slam-up/OntoSLAM.owl#>
PREFIX fr: <http://github.com/Alex23013/slam-up/FortesRey.owl#>
PREFIX dcterms: <http://purl.org/dc/terms/>
PREFIX rdfs: <http://www.w3.org/2000/01/rdf-schema#>
PREFIX prov: <http://www.w3.org/ns/prov#>
PREFIX m: <https://example.org/m/>
"""


def ask(path: Path, query: str) -> list[tuple[object, ...]]:
    rows = Graph().parse(path).query(PREFIXES + query)
    return sorted(tuple(cell.toPython() for cell in row) for row in rows)  # type: ignore[union-attr]


@pytest.fixture
def written(mission: Mission, slam_map: SlamMap, tmp_path: Path) -> Path:
    path = tmp_path / "a.ttl"
    write_slam_map(
        path, slam_map, mission, base="https://example.org/m", knowledge=Knowledge.load()
    )
    return path


def test_it_conforms(written: Path) -> None:
    assert str(validate_map(written)) == "The map conforms to the shapes."


def test_what_it_says(written: Path) -> None:
    assert ask(written, "SELECT ?n { m:map a sl:CollectiveMap ; sl:landmarkCount ?n }") == [(3,)]
    assert ask(written, "SELECT ?t { m:map rdfs:comment ?t }") == [("it was raining",)]
    assert ask(
        written,
        "SELECT ?l ?n { ?a a sl:EdgeAgent ; rdfs:label ?l . ?m prov:wasAttributedTo ?a ; "
        "a sl:AgentMap ; sl:landmarkCount ?n ; ^sl:mergedFrom m:map }",
    ) == [("Robot A", 3), ("é", 0)]
    poses = ask(
        written,
        "SELECT ?s ?x ?h { ?a rdfs:label 'Robot A' . ?t sl:trackOf ?a ; sl:hasTrackPose ?p . "
        "?p a sl:Keyframe ; fr:posAtTime/os:hasStamp ?s ; sl:heading ?h ; "
        "os:hasTranslation/fr:cartesianX ?x }",
    )
    values = np.array(poses, float)
    assert values == pytest.approx(
        np.array([[10, 1, 0], [11.5, 2.5, np.pi / 4], [12, 3, np.pi / 2]])
    )
    seen = ask(
        written,
        "SELECT ?id ?r ?b { ?e a sl:LandmarkMeasurement ; sl:constraintTo/^os:hasPosition ?l ; "
        "^sl:hasEdge ?g . ?l dcterms:identifier ?id . OPTIONAL { ?e sl:range ?r } "
        "OPTIONAL { ?e sl:bearing ?b } FILTER (bound(?r) && bound(?b)) }",
    )
    assert [(str(i), float(str(r)), float(str(b))) for i, r, b in seen] == [
        ("c1", 2, pytest.approx(np.pi / 2)), ("t1", 5, 0),
    ]  # fmt: skip
    kinds = ask(
        written, "SELECT ?id ?c { ?l dcterms:identifier ?id ; a sl:Landmark ; sl:featureClass ?c }"
    )
    assert [str(c).rpartition("#")[2] for _, c in kinds] == ["Car", "Tree", "Tree"]
    sigma = ask(
        written, "SELECT ?s { <https://example.org/m/position/t1> sl:standardDeviation ?s }"
    )
    assert float(str(sigma[0][0])) == pytest.approx(0.025**0.5)
    closure = ask(
        written,
        "SELECT ?r ?v { ?c a sl:LoopClosure ; sl:hasCovariance ?m . ?e os:belongs_to ?m ; "
        "os:componentRow ?r ; os:componentCol ?r ; os:componentValue ?v }",
    )
    assert [float(str(v)) for _, v in closure] == pytest.approx([0.01, 0.04, 0.25])


def test_one_robot_and_own_classes(mission: Mission, slam_map: SlamMap, tmp_path: Path) -> None:
    """Without an ontology classes are the map's own; a landmark that nobody saw is observed too."""
    path = tmp_path / "a.ttl"
    unseen = replace(
        slam_map,
        trajectories={"Robot A": slam_map.trajectories["Robot A"]},
        landmark_of={"Robot A": np.array([0, 2, -1, -1, -1])},
    )
    write_slam_map(path, unseen, replace(mission, classes=("Bush <1>", "Car")))
    assert validate_map(path).conforms
    assert ask(path, "SELECT ?n { ?m a sl:AgentMap ; sl:landmarkCount ?n }") == [(3,)]
    labels = ask(path, "SELECT DISTINCT ?l { ?x sl:featureClass ?c . ?c rdfs:label ?l }")
    assert labels == [("Bush <1>",), ("Car",)]


def test_maps_without_robots_conform(mission: Mission, slam_map: SlamMap, tmp_path: Path) -> None:
    path = tmp_path / "a.ttl"
    write_slam_map(path, replace(slam_map, trajectories={}), mission)
    assert validate_map(path).conforms
    first = path.read_text()
    write_slam_map(path, replace(slam_map, trajectories={}), mission)
    assert path.read_text() == first


def test_wrong_base(mission: Mission, slam_map: SlamMap, tmp_path: Path) -> None:
    with pytest.raises(InputError, match="is no absolute IRI"):
        write_slam_map(tmp_path / "a.ttl", slam_map, mission, base="m")
    assert not (tmp_path / "a.ttl").exists()
