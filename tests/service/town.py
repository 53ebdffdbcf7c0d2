"""The sample town in a service: two maps of it and two overrides, as the service holds maps."""

from __future__ import annotations

import io
import random
from collections import defaultdict
from datetime import UTC, datetime, timedelta
from functools import cache
from typing import TYPE_CHECKING, Any

from symboslam.engine.classify import classify
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.readers import read_landmarks
from symboslam.engine.sample import sample_area
from symboslam.engine.writers.options import WriteOptions
from symboslam.engine.writers.rdf import write_nquads
from symboslam.reasoning.knowledge import Knowledge

if TYPE_CHECKING:
    from tests.service.conftest import Service

BASE = "https://w3id.org/symboslam/map/"
MADE = datetime(2026, 3, 2, 12, tzinfo=UTC)
AGENTS = ("robot-1", "robot-2", "robot-3")
TAKEN_BACK, IN_FORCE = "3-11-11", "3-11-10"
OVERRIDES = f"""
PREFIX sl: <https://w3id.org/symboslam#>
PREFIX prov: <http://www.w3.org/ns/prov#>
PREFIX rdfs: <http://www.w3.org/2000/01/rdf-schema#>
PREFIX xsd: <http://www.w3.org/2001/XMLSchema#>
PREFIX town: <{BASE}town/>
INSERT DATA {{ GRAPH town:overrides {{
  <{BASE}town/override/1> a sl:Override ; sl:madeBy <{BASE}town/operator/alice> ;
    sl:overriddenSegment <{BASE}town/segment/{IN_FORCE}> ;
    sl:replaces <{BASE}town/classification/{IN_FORCE}> ;
    sl:environmentGiven sl:CommunityFacility ; sl:overrideReason "It is the town hall." ;
    prov:generatedAtTime "2026-03-02T12:10:00Z"^^xsd:dateTime .
  <{BASE}town/override/2> a sl:Override ; sl:madeBy <{BASE}town/operator/alice> ;
    sl:overriddenSegment <{BASE}town/segment/{TAKEN_BACK}> ;
    sl:environmentGiven sl:Industrial ; sl:overrideReason "It smelt like a works." ;
    prov:generatedAtTime "2026-03-02T12:05:00Z"^^xsd:dateTime ;
    prov:invalidatedAtTime "2026-03-02T12:06:00Z"^^xsd:dateTime .
  <{BASE}town/operator/alice> a sl:Operator ; rdfs:label "Alice" .
}} }}"""


@cache
def document() -> dict[str, Any]:
    """The sample town as three robots saw it; its east was not looked at."""
    town = sample_area()
    chance = random.Random(7)
    start = datetime(2026, 3, 2, 10, tzinfo=UTC)
    for number, feature in enumerate(town["features"]):
        feature["properties"] |= {
            "agent": AGENTS[number % 3],
            "time": (start + timedelta(seconds=number)).isoformat(),
            "confidence": round(chance.uniform(0.5, 1.0), 3),
        }
    town["features"] += [
        {
            "type": "Feature", "id": f"ufo-{number}",
            "geometry": {"type": "Point", "coordinates": [149.1, -35.2]},
            "properties": {"class": "FlyingSaucer"},
        }
        for number in range(2)
    ]  # fmt: skip
    west, south, east, north = town["bbox"]
    middle = west + (east - west) * 0.875
    ring = [[west, south], [middle, south], [middle, north], [west, north], [west, south]]
    town["surveyed"] = {"type": "Polygon", "coordinates": [ring]}
    return town


@cache
def town_map(profile: str = "default") -> EnvironmentMap:
    """The town, classified."""
    knowledge = Knowledge.load()
    landmarks = read_landmarks(document(), knowledge)
    return classify(landmarks, knowledge, profile=profile)


def put(service: Service, name: str, environment_map: EnvironmentMap, **headers: str) -> None:
    """Put a map into the graphs below ``BASE`` + name."""
    stream = io.BytesIO()
    options = WriteOptions(reasons=8, base=f"{BASE}{name}/", ended=MADE)
    write_nquads(environment_map, stream, options)
    graphs: dict[str, list[str]] = defaultdict(list)
    for line in stream.getvalue().decode().splitlines():
        triple, graph = line.removesuffix("> .").rsplit(" <", 1)
        graphs[graph].append(triple + " .\n")
    assert len(graphs) == 4
    for graph, lines in graphs.items():
        response = service.client.put(
            "/graphs", params={"graph": graph}, content="".join(lines),
            headers={"Content-Type": "application/n-triples", **headers},
        )  # fmt: skip
        assert response.is_success, response.text
