"""Accounts as RDF: they tell what the JSON does, conform to the shapes, and do not collide."""

from __future__ import annotations

import json
import re
from typing import Any

import pytest
from rdflib import DCTERMS, OWL, RDF, Graph, Namespace
from rdflib.term import Node

from symboslam.engine.account import full_account
from symboslam.engine.account_formats import as_json
from symboslam.engine.account_rdf import as_turtle
from symboslam.engine.classify import classify
from symboslam.engine.counterfactual import counterfactuals
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.readers import read_landmarks
from symboslam.engine.sample import sample_area
from symboslam.reasoning.knowledge import Knowledge

SL = Namespace("https://w3id.org/symboslam#")
GEO = Namespace("http://www.opengis.net/ont/geosparql#")


class Told:
    """One account as JSON and as RDF."""

    def __init__(self, found: EnvironmentMap) -> None:
        name = next(
            str(found.segment_id[i])
            for i in range(len(found))
            if found.label[i] >= 0
            and found.landmark_count[i] > 8
            and {bool(c.removed) for c in counterfactuals(found, str(found.segment_id[i]))}
            == {True, False}
        )
        account = full_account(found, name, counterfactual=True, listed=3)
        self.json = json.loads(as_json(account))
        self.graph = Graph().parse(data=as_turtle(account, {}), format="turtle")
        (self.node,) = self.graph.subjects(RDF.type, SL.SegmentExplanation)

    def number(self, node: Node, predicate: Any) -> Any:
        """A number, in twelve digits."""
        return pytest.approx(float(str(self.graph.value(node, predicate))), abs=1e-11)

    def text(self, node: Node, predicate: Any) -> str:
        """A text, or the name of one of our classes."""
        return str(self.graph.value(node, predicate) or "").removeprefix(str(SL))

    def nodes(self, link: Any) -> dict[frozenset[str], Node]:
        """Identifiers -> the node that the explanation links to."""
        return {
            frozenset(map(str, self.graph.objects(node, DCTERMS.identifier))): node
            for node in self.graph.objects(self.node, link)
        }

    def place(self, node: Node) -> Any:
        """Where something stands."""
        (wkt,) = self.graph.objects(node, SL.standsAt / GEO.asWKT)
        parts = re.fullmatch(r"<(.+)> POINT \((.+) (.+)\)", str(wkt))
        assert parts
        assert parts[1] == self.json["crs"]
        return [pytest.approx(float(number), abs=1e-8) for number in parts.groups()[1:]]


@pytest.fixture(scope="module", params=["default", "paper"])
def told(request: pytest.FixtureRequest) -> Told:
    knowledge = Knowledge.load()
    marks = read_landmarks(sample_area(7, 1000.0), knowledge)
    return Told(classify(marks, knowledge, profile=request.param, cells=4))


def test_it_conforms_to_the_shapes(told: Told) -> None:
    pytest.importorskip("pyshacl", reason="pySHACL comes with symboslam[shapes]")
    from symboslam.engine.validate import validate_map

    assert str(validate_map(told.graph)) == "The map conforms to the shapes."


def test_the_comparison_is_told(told: Told) -> None:
    (comparison,) = told.graph.objects(told.node, SL.hasComparison)
    assert told.text(told.node, SL.runnerUp) == told.json["runner_up"]
    assert told.text(comparison, SL.environment) == told.json["against"]["environment"]
    assert told.json["difference"] == told.number(comparison, SL.lead)
    found = {
        told.text(node, SL.featureClass): node
        for node in told.graph.objects(comparison, SL.hasDifference)
    }
    for each in told.json["differences"]:
        node = found.pop(each["feature"])
        assert each["count"] == told.number(node, SL["count"])
        assert each["winner"] == told.number(node, SL.winnerShare)
        assert each["other"] == told.number(node, SL.otherShare)
        assert each["difference"] == told.number(node, SL.difference)
    assert not found


def test_landmarks_are_told(told: Told) -> None:
    found, own = told.nodes(SL.hasLandmarkContribution), SL.ownShare
    if told.json["counted"]:
        own = SL.countShare
    assert len(told.json["landmarks"]) == 3
    for each in told.json["landmarks"]:
        node = found[frozenset([each["id"]])]
        assert each["feature"] == told.text(node, SL.featureClass)
        assert each["contribution"] == told.number(node, SL.share)
        assert each["own"] == told.number(node, own)
        assert each["pairs"] == told.number(node, SL.pairShare)
        assert each["without"] == told.number(node, SL.probabilityWithout)
        assert each["position"] == told.place(node)
    rest = told.json["other_landmarks"]
    unlisted = {
        int(str(told.graph.value(node, SL["count"]))): told.number(node, SL.share)
        for node in told.graph.objects(told.node, SL.hasLandmarkContribution)
        if not told.graph.value(node, DCTERMS.identifier)
    }
    said = {rest["count"]: rest["contribution"], 0: told.json["ground"]}
    assert unlisted == {count: part for count, part in said.items() if part}


def test_pairs_are_told(told: Told) -> None:
    found = told.nodes(SL.hasPairContribution)
    assert len(told.json["pairs"]) == 3
    for each in told.json["pairs"]:
        node = found.pop(frozenset([each["first"], each["second"]]))
        assert each["contribution"] == told.number(node, SL.share)
    assert told.json["other_pairs"] == told.number(found.pop(frozenset()), SL.share)
    assert not found


def test_counterfactuals_are_told(told: Told) -> None:
    found = list(told.graph.objects(told.node, SL.hasCounterfactual))
    assert len(found) == len(told.json["counterfactuals"])
    for each in told.json["counterfactuals"]:
        ids = {name for taken in each["without"] for name in taken["ids"]}
        added = each["plus"] and (each["plus"]["feature"], each["plus"]["count"])
        (node,) = (
            node
            for node in found
            if ids == {str(i) for i in told.graph.objects(node, SL.removes / DCTERMS.identifier)}
            and added == _added(told, node)
        )
        assert each["environment"] == told.text(node, SL.environment)
        assert each["probability"] == told.number(node, SL.probability)
        assert each["tried"] == told.number(node, SL.tries)
        for plus in told.graph.objects(node, SL.adds):
            assert each["place"] == told.place(plus)


def _added(told: Told, change: Node) -> tuple[str, int] | None:
    node = told.graph.value(change, SL.adds)
    if node is None:
        return None
    return told.text(node, SL.featureClass), int(str(told.graph.value(node, SL["count"])))


def test_indications_are_told(told: Told) -> None:
    found = {
        (told.text(node, OWL.annotatedSource), told.text(node, SL.environment)): node
        for node in told.graph.objects(told.node, SL.hasJustification / SL.justifies)
    }
    for each in told.json["indications"]:
        node = found.pop((each["feature"], each["environment"]))
        assert each["strength"] == told.number(node, SL.strength)
        assert each["steps"] == told.number(node, SL.steps)
        assert " > ".join(each["path"]) == told.text(node, SL.way)
        assert each["source"] == told.text(node, DCTERMS.source)
    assert not found


def test_explanations_in_one_graph_do_not_collide(knowledge: Knowledge, landmarks_at: Any) -> None:
    rows = [("House", 20, 20), ("House", 30, 20), ("Shop", 120, 200), ("Shop", 130, 200)]
    found = classify(landmarks_at(rows), knowledge, cells=2, absence=0.0)
    names = [str(n) for n, label in zip(found.segment_id, found.label, strict=True) if label >= 0]
    accounts = [(name, full_account(found, name)) for name in names]
    accounts += [(name, full_account(found, name, listed=1)) for name in names]
    texts = [
        as_turtle(account, {}, length, f"https://example.org/map/segment/{name}")
        for name, account in accounts
        for length in ("line", "full")
    ]
    graph = Graph()
    for text in [*texts, texts[0]]:  # the same again is the same
        graph.parse(data=text, format="turtle")
    nodes = set(graph.subjects(RDF.type, SL.SegmentExplanation))
    assert len(nodes) == len(texts) >= 4
    for node in nodes:
        (segment,) = graph.objects(node, SL.explains)
        assert str(node).startswith(f"{segment}/explanation/")
        (name,) = graph.objects(node, DCTERMS.identifier)
        assert str(segment).endswith(f"/{name}")


def test_a_segment_without_an_iri_is_not_pointed_to(
    knowledge: Knowledge, landmarks_at: Any
) -> None:
    found = classify(landmarks_at([("House", 20, 20)]), knowledge, cells=1)
    graph = Graph().parse(data=as_turtle(full_account(found, "0-0-0"), {}), format="turtle")
    (node,) = graph.subjects(RDF.type, SL.SegmentExplanation)
    assert str(node).startswith("https://w3id.org/symboslam/explanation/0-0-0/")
    assert (node, SL.explains, None) not in graph
