"""Maps over HTTP: what is sent is merged, classified, stated, explained, overridden, and kept."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
import time
from datetime import datetime
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pytest

from symboslam.engine.classify import classify
from symboslam.engine.readers import read_landmarks
from symboslam.engine.sample import sample_area
from symboslam.engine.validate import validate_map
from symboslam.reasoning.knowledge import Knowledge
from tests.service.conftest import ADMIN, MakeService, Service, running

NDJSON = {**ADMIN, "Content-Type": "application/x-ndjson"}
GEOJSON = {**ADMIN, "Content-Type": "application/geo+json"}
GRAPHS = ("landmarks", "segments", "terms", "provenance", "overrides")
SL = "PREFIX sl: <https://w3id.org/symboslam#> PREFIX prov: <http://www.w3.org/ns/prov#> "


@pytest.fixture(scope="module")
def town() -> dict[str, Any]:
    whole = sample_area(3, 1000.0)
    return {**whole, "features": whole["features"][::4]}


def make(service: Service, **given: Any) -> str:
    wanted = {"name": "test", "bbox": [0, 0, 600, 600], "crs": "m", **given}
    response = service.client.post("/v1/maps", json=wanted, headers=ADMIN)
    assert response.status_code == 201, response.text
    identifier: str = response.json()["id"]
    assert response.headers["Location"] == f"/v1/maps/{identifier}"
    return identifier


def send(
    service: Service, identifier: str, *observations: dict[str, Any], key: str | None = None,
    **parameters: Any,
) -> httpx.Response:  # fmt: skip
    headers = NDJSON if key is None else {**NDJSON, "Idempotency-Key": key}
    return service.client.post(
        f"/v1/maps/{identifier}/observations", params=parameters, headers=headers,
        content="\n".join(json.dumps(each) for each in observations),
    )  # fmt: skip


def get(service: Service, path: str, **parameters: Any) -> Any:
    response = service.client.get(f"/v1/maps/{path}".rstrip("/"), params=parameters)
    assert response.status_code == 200, response.text
    return response.json()


def at(name: str, x: float, y: float, **rest: Any) -> dict[str, Any]:
    return {"class": name, "coordinates": [x, y], **rest}


def push_town(service: Service, identifier: str, town: dict[str, Any], size: int = 150) -> int:
    features = town["features"]
    order = np.random.default_rng(1).permutation(len(features))
    for start in range(0, len(order), size):
        chosen = [features[i] for i in order[start : start + size].tolist()]
        response = service.client.post(
            f"/v1/maps/{identifier}/observations", headers=GEOJSON,
            json={"type": "FeatureCollection", "features": chosen},
        )  # fmt: skip
        assert response.status_code == 200, response.text
    return len(features)


def lines_of(service: Service, identifier: str, name: str) -> set[str]:
    base = get(service, identifier)["iri"].removesuffix("map")
    response = service.client.get(
        "/graphs", params={"graph": base + name}, headers={"Accept": "application/n-triples"}
    )
    if response.status_code == 404 and name == "overrides":
        return set()  # some stores know no empty graph
    assert response.status_code == 200, response.text
    return set(response.text.splitlines(keepends=True))


def graph_of(service: Service, identifier: str, tmp_path: Path) -> Path:
    file = tmp_path / "map.nt"
    text = "".join(line for name in GRAPHS for line in lines_of(service, identifier, name))
    file.write_text(text, encoding="utf-8")
    return file


def test_a_map_is_made_and_removed(shared: Service) -> None:
    identifier = make(shared, name="pond", surveyed={
        "type": "Polygon", "coordinates": [[[0, 0], [300, 0], [300, 600], [0, 600], [0, 0]]]
    })  # fmt: skip
    info = get(shared, identifier)
    assert info["name"] == "pond"
    assert info["landmarks"] == info["batches"] == info["revision"] == 0
    assert identifier in [each["id"] for each in get(shared, "")]
    segments = get(shared, f"{identifier}/segments")["features"]
    known = {f["properties"]["environment"] for f in segments}
    assert known == {"NonUrban", None}  # silence says something only where somebody looked
    base = info["iri"].removesuffix("map")
    assert shared.client.delete(f"/v1/maps/{identifier}", headers=ADMIN).status_code == 204
    assert shared.client.get(f"/v1/maps/{identifier}").status_code == 404
    for name in GRAPHS:
        assert shared.client.get("/graphs", params={"graph": base + name}).status_code == 404


@pytest.mark.parametrize(
    ("bbox", "crs"),
    [
        ([1, 1, 2, 2], None), ([149.1, -35.3, 149.2, -35.2], "EPSG:4326"), ([0, 5, 600, 700], "m"),
        ([149.1, -35.3, 0, 149.2, -35.2, 9], "OGC:CRS84"),
    ],
)  # fmt: skip
def test_the_box_comes_back_as_it_was_sent(
    shared: Service, bbox: list[float], crs: str | None
) -> None:
    identifier = make(shared, bbox=bbox, crs=crs)
    assert get(shared, identifier)["bbox"] == bbox
    assert [each["bbox"] for each in get(shared, "") if each["id"] == identifier] == [bbox]
    export = get(shared, f"{identifier}/export")
    west, south, *_, east, north = export["bbox"]
    assert west <= bbox[0] < bbox[len(bbox) // 2] <= east
    assert south <= bbox[1] < bbox[len(bbox) // 2 + 1] <= north


def test_a_box_in_another_system_comes_back_in_that_of_the_map(shared: Service) -> None:
    identifier = make(shared, bbox=[692_000, 6_096_000, 694_000, 6_098_000], crs="EPSG:32755")
    info = get(shared, identifier)
    assert info["crs"] == "OGC:CRS84"
    west, south, east, north = info["bbox"]
    assert 149.1 < west < east < 149.14
    assert -35.28 < south < north < -35.24


def test_observations_become_landmarks(shared: Service) -> None:
    identifier = make(shared)
    first = send(
        shared, identifier, at("House", 100, 100, confidence=0.5), at("House", 102, 100),
        at("Nonsense", 5, 5), at("House", 700, 5), agent="r2",
    )  # fmt: skip
    assert first.status_code == 200, first.text
    result = first.json()
    assert (result["received"], result["new"], result["merged"]) == (4, 1, 1)
    assert result["left_out"] == {"outside": 1, "unknown": {"Nonsense": 1}}
    landmarks = get(shared, f"{identifier}/landmarks")["features"]
    assert [f["properties"]["observations"] for f in landmarks] == [2]
    assert landmarks[0]["geometry"]["coordinates"] == [101.333, 100]
    assert landmarks[0]["properties"]["agent"] == "r2"
    assert get(shared, identifier)["left_out"] == {"unknown Nonsense": 1, "outside": 1}


def test_ids_are_those_of_an_agent(shared: Service) -> None:
    identifier = make(shared, bbox=[0, 0, 2000, 2000])
    for x in (100, 1100):
        result = send(shared, identifier, at("House", x, 100, id="1")).json()
        assert (result["new"], result["merged"]) == (1, 0)
        assert result["notes"] == [
            "an id does not say which landmark it is without an agent; name the agent of 1"
        ]
    landmarks = get(shared, f"{identifier}/landmarks")["features"]
    assert [f["geometry"]["coordinates"] for f in landmarks] == [[100, 100], [1100, 100]]
    assert [f["id"] for f in landmarks] == ["1", "L1"]
    both = [at("House", 102, 100, id="2"), at("House", 1102, 100, id="3", agent="r2")]
    mine = send(shared, identifier, *both, agent="r1").json()
    assert (mine["new"], mine["merged"], mine["notes"]) == (0, 2, [])
    moved = send(shared, identifier, at("House", 1104, 100, id="2"), agent="r1").json()
    assert moved["merged"] == 1
    landmarks = get(shared, f"{identifier}/landmarks")["features"]
    assert [f["properties"]["observations"] for f in landmarks] == [3, 2]


def test_ids_of_two_things_in_a_batch_are_told(shared: Service) -> None:
    batch = [
        at("House", 100, 100, id="near"), at("House", 104, 103, id="near"),  # 5 m
        at("House", 200, 100, id="far"), at("House", 204, 103.1, id="far"),
        at("House", 300, 100, id="kind"), at("Tree", 300, 100, id="kind"),
        at("House", 400, 100, id="theirs"), at("House", 400, 500, id="theirs", agent="r2"),
    ]  # fmt: skip
    notes = send(shared, make(shared), *batch, agent="r1").json()["notes"]
    assert notes == [
        "in one batch there are different classes, or places farther than 5 m apart, under the"
        " same id: far of r1, kind of r1"
    ]
    many = [at("House", 100 + 9 * i, y, id=str(i)) for i in range(7) for y in (100, 200)]
    notes = send(shared, make(shared), *many, agent="r1").json()["notes"]
    assert notes[0].endswith("0 of r1, 1 of r1, 2 of r1, 3 of r1, 4 of r1 and 2 more")


def test_a_batch_is_taken_once(shared: Service) -> None:
    identifier = make(shared)
    batch = [at("House", 100, 100), at("Tree", 300, 300)]
    one = send(shared, identifier, *batch, key="1", agent="r1")
    again = send(shared, identifier, *batch, key="1", agent="r1")
    assert one.json() == again.json()
    assert send(shared, identifier, *batch, key="1", agent="r2").json()["merged"] == 2
    assert send(shared, identifier, *batch).json()["revision"] == 3
    conflict = send(shared, identifier, batch[0], key="1", agent="r1")
    assert conflict.status_code == 409
    assert get(shared, identifier)["batches"] == 3
    landmarks = get(shared, f"{identifier}/landmarks")["features"]
    assert [f["properties"]["observations"] for f in landmarks] == [3, 3]


def test_sparql_sees_what_was_acknowledged(shared: Service) -> None:
    identifier = make(shared)
    base = get(shared, identifier)["iri"].removesuffix("map")
    for number in range(1, 6):
        send(shared, identifier, at("Factory", 100 * number, 300, id=str(number)), agent="r1")
        found = shared.values(
            f"{SL} SELECT ?l {{ GRAPH <{base}landmarks> {{ ?l a sl:Landmark }} }}"
        )
        assert len(found) == number
        stated = shared.values(
            f"{SL} SELECT ?s ?e {{ GRAPH <{base}segments> {{ ?s sl:environment ?e ; a sl:Segment }}"
            " } ORDER BY ?s"
        )
        told = {
            (f["properties"]["segment_id"], f["properties"]["environment"])
            for f in get(shared, f"{identifier}/segments")["features"]
            if f["properties"]["environment"]
        }
        assert {(s.rpartition("/")[2], e.rpartition("#")[2]) for s, e in stated} == told


def test_the_same_as_at_one_go(shared: Service, town: dict[str, Any], tmp_path: Path) -> None:
    """However it came about, a map is what classify makes of its landmarks; valid as stated."""
    identifier = make(
        shared, bbox=town["bbox"], crs=None, merge_radius=0, segmentation={"cells": 8}
    )
    count = push_town(shared, identifier, town)
    info = get(shared, identifier)
    landmarks = get(shared, f"{identifier}/landmarks")
    assert sum(f["properties"]["observations"] for f in landmarks["features"]) == count
    knowledge = Knowledge.load()
    read = read_landmarks(landmarks, knowledge, bbox=town["bbox"])
    whole = classify(read, knowledge, **info["settings"])
    told = {
        f["properties"]["segment_id"]: f["properties"]
        for f in get(shared, f"{identifier}/segments")["features"]
    }
    assert sorted(whole.segment_id.tolist()) == sorted(told)
    for i, name in enumerate(whole.segment_id.tolist()):
        assert told[name]["environment"] == whole.name_of(i)
        chances = [told[name]["probabilities"][e.name] for e in whole.environments]
        assert chances == pytest.approx(whole.probability[i].tolist(), abs=2e-4)
    file = graph_of(shared, identifier, tmp_path)
    assert validate_map(file).conforms, str(validate_map(file))
    base = info["iri"].removesuffix("map")
    sums = shared.values(
        f"{SL} PREFIX sosa: <http://www.w3.org/ns/sosa/> SELECT ?c (SUM(?p) AS ?all) {{ GRAPH"
        f" <{base}segments> {{ ?c sosa:hasResult/sl:hasProbability/sl:probability ?p }} }}"
        " GROUP BY ?c"
    )
    assert len(sums) == sum(p["environment"] is not None for p in told.values())
    assert {float(total) for _, total in sums} == {1.0}


def test_what_is_stated_later_is_what_is_stated_at_once(
    make_service: MakeService, town: dict[str, Any]
) -> None:
    """Differences that were sent to the store add up to all statements of the end."""
    service = make_service(rate="")
    identifier = make(service, bbox=town["bbox"], crs=None, segmentation={"cells": 12})
    push_town(service, identifier, town)
    grown = {name: lines_of(service, identifier, name) for name in GRAPHS}
    one = service.app.state.maps._running[identifier]
    anew = one._statements.everything(datetime.fromisoformat(one.record.changed), [])
    for name in GRAPHS:
        graph = {"graph": f"https://example.org/{name}"}
        service.client.put(
            "/graphs", params=graph, content=anew[name].encode(),
            headers={**ADMIN, "Content-Type": "application/n-triples"},
        ).raise_for_status()  # fmt: skip
        text = service.client.get(
            "/graphs", params=graph, headers={"Accept": "application/n-triples"}
        ).text
        fresh = set(text.splitlines(keepends=True))
        assert fresh - grown[name] == set()
        assert name == "terms" or grown[name] - fresh == set()  # what occurred stays explained


def test_explanations(shared: Service) -> None:
    identifier = make(shared)
    send(shared, identifier, *(at("House", 100 + 9 * i, 100) for i in range(6)))
    segment = next(
        f["properties"]["segment_id"]
        for f in get(shared, f"{identifier}/segments")["features"]
        if f["properties"]["environment"] == "Residential"
    )
    path = f"{identifier}/segments/{segment}/explanation"
    texts = [get(shared, path, length=n)["text"] for n in ("line", "paragraph", "full")]
    assert "\n" not in texts[0]
    assert len(texts[0]) < len(texts[1]) < len(texts[2])
    assert all("Residential" in text and "House" in text for text in texts)
    found = get(shared, path)
    for name, chance in found["probabilities"].items():
        parts = sum(r["contribution"].get(name, 0) for r in found["reasons"])
        assert parts == pytest.approx(chance, abs=1e-9)
    plain = shared.client.get(f"/v1/maps/{path}", headers={"Accept": "text/plain"})
    assert plain.text.strip() == found["text"]
    assert "Why not Military?" in get(shared, path, against="Military")["text"]
    marks = sum(mark["contribution"] for mark in found["landmarks"]) + found["ground"]
    assert marks + found["other_landmarks"]["contribution"] == pytest.approx(
        found["probabilities"]["Residential"], abs=1e-9
    )
    itself = shared.client.get(f"/v1/maps/{path}?against=Residential")
    assert itself.status_code == 422
    assert "is Residential itself" in itself.json()["detail"]
    assert shared.client.get(f"/v1/maps/{identifier}/segments/9-9-9/explanation").status_code == 404


def test_overrides_are_statements_of_their_own(shared: Service, tmp_path: Path) -> None:
    identifier = make(shared, segmentation={"cells": 8})
    send(shared, identifier, at("House", 100, 100))
    segment = get(shared, f"{identifier}/segments")["features"][0]["properties"]["segment_id"]
    path = f"/v1/maps/{identifier}/segments/{segment}/override"
    wanted = {"environment": "Military", "reason": "a fence", "operator": "Ada"}
    made = shared.client.put(path, json=wanted, headers=ADMIN)
    assert made.status_code == 200, made.text
    again = shared.client.put(path, json={**wanted, "environment": None}, headers=ADMIN)
    assert again.json()["environment"] is None
    shown = get(shared, f"{identifier}/segments")["features"][0]["properties"]
    assert shown["override"]["operator"] == "Ada"
    assert shown["environment"] is not None  # what was worked out stays
    text = get(shared, f"{identifier}/segments/{segment}/explanation", length="line")["text"]
    assert text.startswith("Ada says that it is unknown: a fence.")
    base = get(shared, identifier)["iri"].removesuffix("map")
    query = (
        f"{SL} SELECT ?who ?e ?undone {{ GRAPH <{base}overrides> {{ ?o a sl:Override ;"
        " sl:madeBy/<http://www.w3.org/2000/01/rdf-schema#label> ?who ."
        " OPTIONAL { ?o sl:environmentGiven ?e } OPTIONAL { ?o prov:invalidatedAtTime ?undone } } }"
    )
    assert sorted(map(len, shared.values(query))) == [1, 3]
    assert validate_map(graph_of(shared, identifier, tmp_path)).conforms
    assert shared.client.delete(path, headers=ADMIN).status_code == 204
    assert shared.client.delete(path, headers=ADMIN).status_code == 404
    assert "override" not in get(shared, f"{identifier}/segments")["features"][0]["properties"]
    history = get(shared, f"{identifier}/overrides")
    assert [each["undone"] is None for each in history] == [False, False]


@pytest.mark.parametrize("mark", ["\x85", "\u2028", "\u2029", '"', "\\"])
def test_a_text_may_have_what_some_take_for_the_end_of_a_line(shared: Service, mark: str) -> None:
    identifier = make(shared, segmentation={"cells": 8})
    send(shared, identifier, at("House", 100, 100) | {"agent": f"a{mark}b"})
    segment = get(shared, f"{identifier}/segments")["features"][0]["properties"]["segment_id"]
    path = f"/v1/maps/{identifier}/segments/{segment}/override"
    said = {"environment": "Military", "reason": f"a{mark}b", "operator": f"A{mark}da"}
    for _ in range(2):  # the second time the first is taken back
        made = shared.client.put(path, json=said, headers=ADMIN)
        assert made.status_code == 200, made.text
    base = get(shared, identifier)["iri"].removesuffix("map")
    query = f"{SL} SELECT ?why {{ GRAPH <{base}overrides> {{ ?o sl:overrideReason ?why }} }}"
    assert {row[0] for row in shared.values(query)} == {said["reason"]}


def test_an_override_outlives_its_segment(shared: Service, tmp_path: Path) -> None:
    identifier = make(shared, segmentation={"cells": 8})
    path = f"/v1/maps/{identifier}/segments/0-0-0/override"
    wanted = {"environment": "Military"}
    assert shared.client.put(path, json=wanted, headers=ADMIN).status_code == 200
    for x, name in ((30, "House"), (170, "Factory"), (100, "Tree")):
        send(shared, identifier, *(at(name, x + i, 30 + 10 * i) for i in range(6)))
    features = get(shared, f"{identifier}/segments")["features"]
    assert "0-0-0" not in {f["properties"]["segment_id"] for f in features}
    overridden = {f["properties"]["segment_id"] for f in features if "override" in f["properties"]}
    assert overridden
    assert all(int(name.split("-")[0]) > 0 for name in overridden)
    assert validate_map(graph_of(shared, identifier, tmp_path)).conforms


def test_files(shared: Service, town: dict[str, Any]) -> None:
    identifier = make(shared, bbox=town["bbox"], crs=None)
    push_town(shared, identifier, town, 1000)
    starts = {"geojson": b"{", "ttl": b"@prefix", "nq": b"<", "png": b"\x89PNG", "html": b"<!"}
    for name, start in starts.items():
        found = shared.client.get(f"/v1/maps/{identifier}/export", params={"format": name})
        assert found.status_code == 200
        assert found.content.lower().startswith(start.lower())


def test_a_job_makes_a_map_of_a_file(shared: Service, town: dict[str, Any]) -> None:
    started = shared.client.post(
        "/v1/jobs", params={"name": "town.geojson", "format": "geojson"}, headers=ADMIN,
        content=json.dumps(town),
    )  # fmt: skip
    assert started.status_code == 202, started.text
    job = started.json()
    while job["state"] == "running":
        time.sleep(0.05)
        job = shared.client.get(started.headers["Location"]).json()
    assert job["state"] == "done", job
    info = get(shared, job["map"])
    assert info["name"] == "town.geojson"
    assert info["landmarks"] == len(town["features"])
    bad = shared.client.post(
        "/v1/jobs", params={"name": "x", "format": "geojson"}, headers=ADMIN, content="{"
    ).json()
    while bad["state"] == "running":
        time.sleep(0.05)
        bad = shared.client.get(f"/v1/jobs/{bad['id']}").json()
    assert bad["state"] == "failed"
    assert "not valid JSON" in bad["problem"]
    listed = shared.client.get("/v1/jobs").json()
    assert [(each["id"], each["state"]) for each in listed[-2:]] == [
        (job["id"], "done"), (bad["id"], "failed")
    ]  # fmt: skip


def test_events(shared: Service) -> None:
    identifier = make(shared)
    got: list[tuple[str, Any]] = []
    connected = threading.Event()

    def watch(last: int | None, number: int) -> None:
        headers = {} if last is None else {"Last-Event-ID": str(last)}
        with httpx.Client(base_url=shared.url, timeout=30) as client:
            with client.stream("GET", f"/v1/maps/{identifier}/events", headers=headers) as response:
                assert response.headers["Content-Type"].startswith("text/event-stream")
                connected.set()
                kind = ""
                for line in response.iter_lines():
                    if line.startswith("event:"):
                        kind = line[6:].strip()
                    elif line.startswith("data:"):
                        got.append((kind, json.loads(line[5:])))
                        if len(got) == number:
                            return

    thread = threading.Thread(target=watch, args=(None, 2))
    thread.start()
    assert connected.wait(10)
    time.sleep(0.3)
    send(shared, identifier, at("House", 100, 100))
    send(shared, identifier, at("House", 500, 500))
    thread.join(10)
    assert [kind for kind, _ in got] == ["change", "change"]
    assert [data["revision"] for _, data in got] == [1, 2]
    assert any(s["environment"] == "Residential" for s in got[0][1]["segments"])
    got.clear()
    watch(1, 1)  # who comes back
    assert got[0][1]["revision"] == 2
    got.clear()
    watch(7, 1)  # who knows of a future that is not ours
    assert got[0][0] == "reset"
    got.clear()
    segment = get(shared, f"{identifier}/segments")["features"][0]["properties"]["segment_id"]
    path = f"/v1/maps/{identifier}/segments/{segment}/override"
    given = {"environment": "Industrial", "operator": "Ada"}
    assert shared.client.put(path, json=given, headers=ADMIN).is_success
    assert shared.client.delete(path, headers=ADMIN).is_success
    watch(2, 2)
    told = [(data["segment"], data["override"]) for _, data in got]
    assert [name for name, _ in told] == [segment, segment]
    assert [each["environment"].rpartition("#")[2] for _, each in told] == ["Industrial"] * 2
    assert [(each["operator"], each["undone"]) for _, each in told] == [
        ("Ada", False), ("Ada", True)
    ]  # fmt: skip


def test_maps_are_there_after_a_restart(
    make_service: MakeService, town: dict[str, Any], tmp_path: Path
) -> None:
    settings = {
        "data": tmp_path / "kept", "admin_token": ADMIN["Authorization"].split()[1],
        "bundled_ontology": False, "workers": 1, "rate": "",
    }  # fmt: skip
    with running(**settings) as service:
        identifier = make(service, bbox=town["bbox"], crs=None, segmentation={"cells": 12})
        push_town(service, identifier, town)
        path = f"/v1/maps/{identifier}/segments/0-0-0/override"
        before = get(service, identifier), get(service, f"{identifier}/segments")
        stated = {line for name in GRAPHS for line in lines_of(service, identifier, name)}
        service.client.put(path, json={"environment": "Military"}, headers=ADMIN)
    with running(**settings) as service:
        after = get(service, identifier), get(service, f"{identifier}/segments")
        assert {**after[0], "revision": 0, "changed": 0} == {
            **before[0], "revision": 0, "changed": 0,
        }  # fmt: skip
        for f, g in zip(before[1]["features"], after[1]["features"], strict=True):
            told = {k: v for k, v in g["properties"].items() if k != "override"}
            assert told == f["properties"]
        assert stated <= {line for name in GRAPHS for line in lines_of(service, identifier, name)}
        house = {"class": "House", "coordinates": [sum(town["bbox"][::2]) / 2,
                                                   sum(town["bbox"][1::2]) / 2]}  # fmt: skip
        assert send(service, identifier, house).status_code == 200


def test_what_a_killed_service_did_not_state(make_service: MakeService, tmp_path: Path) -> None:
    """Recorded and not yet stated: the store is brought up to date at the next start."""
    settings = {
        "data": tmp_path / "kept", "admin_token": ADMIN["Authorization"].split()[1],
        "bundled_ontology": False, "workers": 1,
    }  # fmt: skip
    with running(**settings) as service:
        identifier = make(service)
        send(service, identifier, at("House", 100, 100))
        base = get(service, identifier)["iri"].removesuffix("map")
        service.app.state.maps.records.stated(identifier, 0)
        service.update(f"DROP GRAPH <{base}landmarks>").raise_for_status()
    with running(**settings) as service:
        query = f"{SL} SELECT ?l {{ GRAPH <{base}landmarks> {{ ?l a sl:Landmark }} }}"
        for _ in range(100):
            if service.values(query):
                break
            time.sleep(0.05)
        assert len(service.values(query)) == 1


@pytest.mark.parametrize(
    ("wanted", "told"),
    [
        ({"bbox": [0, 0, 0, 600]}, "no area"),
        ({"crs": "EPSG:999999"}, "EPSG:999999"),
        ({"scheme": "nonsense"}, "nonsense"),
        ({"ontology": "http://example.org/none"}, "http://example.org/none"),
        ({"settings": {"nonsense": 1}}, "nonsense"),
        ({"settings": {"bandwidth": "wide"}}, "bandwidth"),
        ({"settings": {"bandwidth": -1}}, "bandwidth"),
        ({"segmentation": {"cells": 1000}}, "cells"),
        ({"segmentation": {"method": "branch"}}, "kept is cut by grid, not by 'branch'"),
        ({"colour": "red"}, "colour"),
        ({"surveyed": {"type": "Point", "coordinates": [1, 1]}}, "surveyed"),
    ],
)
def test_maps_that_cannot_be(shared: Service, wanted: dict[str, Any], told: str) -> None:
    before = get(shared, "")
    spec = {"name": "x", "bbox": [0, 0, 600, 600], "crs": "m", **wanted}
    response = shared.client.post("/v1/maps", json=spec, headers=ADMIN)
    assert response.status_code == 422, response.text
    assert response.headers["Content-Type"] == "application/problem+json"
    assert told in response.json()["detail"]
    assert get(shared, "") == before


def test_who_may_do_what(shared: Service) -> None:
    identifier = make(shared)
    for method, path in (
        ("POST", ""), ("POST", f"/{identifier}/observations"), ("DELETE", f"/{identifier}"),
        ("PUT", f"/{identifier}/segments/0-0-0/override"),
    ):  # fmt: skip
        body = {"name": "x", "bbox": [0, 0, 1, 1], "environment": None}
        assert shared.client.request(method, f"/v1/maps{path}", json=body).status_code == 401


def test_one_s_own_ontology(shared: Service) -> None:
    turtle = """
        @prefix sl: <https://w3id.org/symboslam#> . @prefix owl: <http://www.w3.org/2002/07/owl#> .
        @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> . @prefix : <https://example.org/r#> .
        <https://example.org/r> a owl:Ontology .
        sl:Environment a owl:Class . sl:Feature a owl:Class . sl:indicates a owl:ObjectProperty .
        :Kitchen a owl:Class ; rdfs:subClassOf sl:Environment ; rdfs:label "Kitchen"@en .
        :Bedroom a owl:Class ; rdfs:subClassOf sl:Environment ; rdfs:label "Bedroom"@en .
        :Stove a owl:Class ; rdfs:subClassOf sl:Feature , [ a owl:Restriction ;
          owl:onProperty sl:indicates ; owl:someValuesFrom :Kitchen ] ; rdfs:label "Stove"@en .
        :Bed a owl:Class ; rdfs:subClassOf sl:Feature , [ a owl:Restriction ;
          owl:onProperty sl:indicates ; owl:someValuesFrom :Bedroom ] ; rdfs:label "Bed"@en .
    """
    graph = {"graph": "https://example.org/rooms"}
    shared.client.put(
        "/graphs", params=graph, content=turtle, headers={**ADMIN, "Content-Type": "text/turtle"}
    ).raise_for_status()
    wanted = {"name": "flat", "bbox": [0, 0, 12, 12], "crs": "m", "ontology": graph["graph"],
              "merge_radius": 0.2}  # fmt: skip
    response = shared.client.post("/v1/maps", json=wanted, headers=ADMIN)
    if response.status_code == 503 and "Java" in response.text:
        pytest.skip("reasoning over an ontology of one's own needs Java")
    assert response.status_code == 201, response.text
    assert response.json()["environments"] == ["Bedroom", "Kitchen"]
    send(shared, response.json()["id"], at("Stove", 2, 2), at("Bed", 10, 10))
    features = get(shared, f"{response.json()['id']}/segments")["features"]
    assert {f["properties"]["environment"] for f in features} >= {"Kitchen", "Bedroom"}


def test_pushed_twice_is_pushed_once(shared: Service, town: dict[str, Any], tmp_path: Path) -> None:
    file = tmp_path / "town.geojson"
    file.write_text(json.dumps(town))
    environment = {**os.environ, "SYMBOSLAM_TOKEN": ADMIN["Authorization"].split()[1]}

    def run(*arguments: str) -> str:
        done = subprocess.run(
            [sys.executable, "-m", "symboslam", *arguments],
            env=environment, capture_output=True, text=True, timeout=120,
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
        return done.stdout

    told = run("push", str(file), "--to", shared.url, "--new", "pushed")
    identifier = next(m["id"] for m in get(shared, "") if m["name"] == "pushed")
    assert identifier in told
    before = get(shared, identifier)
    run("push", str(file), "--to", shared.url, "--map", identifier)
    assert get(shared, identifier) == before
    landmarks = get(shared, f"{identifier}/landmarks")["features"]
    assert sum(f["properties"]["observations"] for f in landmarks) == len(town["features"])
    answer = run("query", "--example", "maps", "--url", shared.url, "--format", "csv")
    assert identifier in answer


def test_maps_in_a_store_elsewhere(fuseki_url: str, tmp_path: Path) -> None:
    settings = {
        "data": tmp_path, "admin_token": ADMIN["Authorization"].split()[1], "workers": 1,
        "bundled_ontology": False, "store": fuseki_url,
    }  # fmt: skip
    with running(**settings) as service:
        identifier = make(service, segmentation={"cells": 6})
        for number in range(3):
            sent = send(service, identifier, at("House", 100 + 150 * number, 300), key=str(number))
            assert sent.status_code == 200, sent.text
        info = get(service, identifier)
        landmarks = lines_of(service, identifier, "landmarks")
        assert validate_map(graph_of(service, identifier, tmp_path)).conforms
    with running(**settings) as service:
        assert get(service, identifier) == info
        again = send(service, identifier, at("House", 400, 300), key="2")
        assert again.json()["revision"] == 3
        assert lines_of(service, identifier, "landmarks") == landmarks
        send(service, identifier, at("House", 401, 300))
        assert len(lines_of(service, identifier, "landmarks")) == len(landmarks)
