"""A server under load that is killed again and again: nothing lost, nothing twice, nothing half."""

import random
import signal
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from shutil import copytree, rmtree
from typing import Any

import httpx
import pytest

from tests.service.conftest import ADMIN, UPDATE
from tests.service.kept import graphs_of, half_written, same
from tests.service.test_durability import serve

pytestmark = pytest.mark.proof

SIDE = 900.0
CLASSES = ("House", "Factory", "BusStop", "Tree", "ConvenienceStore", "Warehouse")
ENVIRONMENTS = ("Residential", "Industrial", "Commercial", None)


@dataclass
class Batch:
    """Observations that are sent under one key.

    Attributes:
        map: the map.
        key: its Idempotency-Key.
        features: what is sent.
        result: what the service said when it took them; None: nothing was heard.
    """

    map: str
    key: str
    features: list[dict[str, Any]]
    result: dict[str, Any] | None = None

    def send(self, client: httpx.Client) -> dict[str, Any]:
        """Send it; the result of a batch that was taken."""
        response = client.post(
            f"/v1/maps/{self.map}/observations",
            json={"type": "FeatureCollection", "features": self.features},
            headers={**ADMIN, "Content-Type": "application/geo+json", "Idempotency-Key": self.key},
        )
        response.raise_for_status()
        return dict(response.json())


@dataclass
class Load:
    """What clients send, and what they were told.

    Attributes:
        maps: ids of the maps.
        batches: all that were sent.
        inserted: numbers that were sent by SPARQL updates.
        acknowledged: those of them that were acknowledged.
        overrides: ids of overrides that were acknowledged, with their map.
    """

    maps: list[str]
    chance: random.Random
    batches: list[Batch] = field(default_factory=list)
    inserted: list[int] = field(default_factory=list)
    acknowledged: set[int] = field(default_factory=set)
    overrides: list[tuple[str, str]] = field(default_factory=list)

    @property
    def heard(self) -> int:
        """How many batches were acknowledged."""
        return sum(batch.result is not None for batch in self.batches)

    def feed(self, client: httpx.Client, number: int) -> None:
        """One client's next batch."""
        chance, key = self.chance, f"client-{number}-{len(self.batches)}-{time.monotonic_ns()}"
        features = [
            {
                "type": "Feature",
                "geometry": {
                    "type": "Point",
                    # To the millimetre, and within the box.
                    "coordinates": [round(chance.uniform(1, SIDE - 1), 3) for _ in range(2)],
                },
                "properties": {
                    "class": chance.choice(CLASSES),
                    "confidence": round(chance.uniform(0.3, 1), 2),
                },
            }
            for _ in range(chance.randint(1, 12))
        ]
        batch = Batch(chance.choice(self.maps), key, features)
        self.batches.append(batch)
        batch.result = batch.send(client)

    def insert(self, client: httpx.Client) -> None:
        """A SPARQL update of two statements, which are there together or not at all."""
        n = len(self.inserted)
        self.inserted.append(n)
        text = f"INSERT DATA {{ GRAPH <urn:log> {{ <urn:{n}> <urn:p> {n} ; <urn:q> {n} }} }}"
        client.post("/sparql", content=text, headers=UPDATE).raise_for_status()
        self.acknowledged.add(n)

    def override(self, client: httpx.Client) -> None:
        """An operator's statement about some segment."""
        which = self.chance.choice(self.maps)
        found = client.get(f"/v1/maps/{which}/segments").raise_for_status().json()["features"]
        segment = self.chance.choice(found)["properties"]["segment_id"]
        response = client.put(
            f"/v1/maps/{which}/segments/{segment}/override", headers=ADMIN,
            json={"environment": self.chance.choice(ENVIRONMENTS), "reason": "I was there."},
        )  # fmt: skip
        if response.status_code != 404:  # it was split meanwhile
            self.overrides.append((which, response.raise_for_status().json()["id"]))

    def run(self, url: str) -> tuple[threading.Event, list[threading.Thread]]:
        """Clients that go on until they are told to stop, or until nobody answers."""
        stop = threading.Event()

        def go_on(number: int) -> None:
            with httpx.Client(base_url=url, timeout=60) as client:
                while not stop.is_set():
                    try:
                        if number < 3:
                            self.feed(client, number)
                        elif number == 3:
                            self.insert(client)
                        else:
                            self.override(client)
                    except httpx.TransportError:
                        return

        threads = [threading.Thread(target=go_on, args=(n,)) for n in range(5)]
        for thread in threads:
            thread.start()
        return stop, threads


def make_map(client: httpx.Client, number: int) -> str:
    wanted = {
        "name": f"map {number}", "bbox": [0, 0, SIDE, SIDE], "crs": "m",
        "segmentation": {"cells": 8, "threshold": 0.6},
    }  # fmt: skip
    return str(client.post("/v1/maps", json=wanted, headers=ADMIN).raise_for_status().json()["id"])


def observed(client: httpx.Client, which: str) -> int:
    found = client.get(f"/v1/maps/{which}/landmarks").raise_for_status().json()["features"]
    return sum(each["properties"]["observations"] for each in found)


def kills(number: int) -> Iterator[tuple[int, float]]:
    """When servers are killed: after so many more batches were acknowledged, and some seconds.

    Some die while they catch up with what the one before has left.
    """
    chance = random.Random(number)
    for n in range(number):
        yield 0 if n % 5 == 1 else chance.randint(1, 20), chance.uniform(0.0, 0.1)


@pytest.mark.parametrize(
    "number", [3, pytest.param(50, marks=[pytest.mark.slow, pytest.mark.timeout(1200)])]
)
def test_killed_under_load(tmp_path: Path, number: int) -> None:
    data, settings = tmp_path / "data", {"rate": "none", "workers": "2"}
    with serve(data, **settings) as (process, client):
        load = Load([make_map(client, n) for n in range(3)], random.Random(number))
    for batches, seconds in kills(number):
        with serve(data, **settings) as (process, client):
            for which in load.maps:
                assert half_written(client, which) == []
            stop, threads = load.run(str(client.base_url))
            until = load.heard + batches
            while load.heard < until and all(thread.is_alive() for thread in threads):
                time.sleep(0.005)
            time.sleep(seconds)
            assert all(thread.is_alive() for thread in threads)
            process.send_signal(signal.SIGKILL)
            process.wait()
            stop.set()
            for thread in threads:
                thread.join()
    assert number < load.heard < len(load.batches), "nothing was cut short: this shows little"
    with serve(data, **settings) as (process, client):
        before = {which: observed(client, which) for which in load.maps}
        info = {which: client.get(f"/v1/maps/{which}").json() for which in load.maps}
        landed = dict.fromkeys(load.maps, 0)
        for batch in load.batches:
            result = batch.send(client)
            if batch.result is not None:
                assert result == batch.result
            if result["revision"] <= info[batch.map]["revision"]:
                landed[batch.map] += len(batch.features)
            else:
                assert batch.result is None, "an acknowledged batch was lost"
        assert before == landed
        for which in load.maps:
            sent = [batch for batch in load.batches if batch.map == which]
            assert observed(client, which) == sum(len(batch.features) for batch in sent)
            assert client.get(f"/v1/maps/{which}").json()["batches"] == len(sent)
            assert half_written(client, which) == []
        check_updates(client, load)
        check_overrides(client, load)
        stated = {which: graphs_of(client, which) for which in load.maps}
        process.send_signal(signal.SIGKILL)
        process.wait()
    anew = tmp_path / "anew"
    copytree(data, anew)
    rmtree(anew / "store")
    with serve(anew, **settings) as (_, client):
        for which in load.maps:
            while not graphs_of(client, which)["provenance"]:
                time.sleep(0.1)  # it is stated in the background; the test's time limit ends this
            assert same(graphs_of(client, which), stated[which])


def check_updates(client: httpx.Client, load: Load) -> None:
    """Each acknowledged update is there, and each that is there is whole."""
    query = "SELECT ?p (STR(?o) AS ?n) { GRAPH <urn:log> { ?s ?p ?o } }"
    rows = client.get("/sparql", params={"query": query}).json()["results"]["bindings"]
    p, q = (
        {int(row["n"]["value"]) for row in rows if row["p"]["value"] == name}
        for name in ("urn:p", "urn:q")
    )
    assert p == q
    assert load.acknowledged
    assert load.acknowledged <= p <= set(load.inserted)


def check_overrides(client: httpx.Client, load: Load) -> None:
    """Each acknowledged override is on record, and the store states all that are."""
    assert load.overrides
    for which in load.maps:
        found = client.get(f"/v1/maps/{which}/overrides").json()
        known = {each["id"] for each in found}
        assert {name for place, name in load.overrides if place == which} <= known
        query = (
            "PREFIX sl: <https://w3id.org/symboslam#> SELECT ?o { GRAPH "
            f"<https://w3id.org/symboslam/map/{which}/overrides> {{ ?o a sl:Override }} }}"
        )
        rows = client.get("/sparql", params={"query": query}).json()["results"]["bindings"]
        assert {row["o"]["value"].rpartition("/")[2] for row in rows} == known


def test_killed_while_maps_are_removed(tmp_path: Path) -> None:
    """Each map is there and whole, or gone and with it all its graphs."""
    data, settings, chance = tmp_path / "data", {"rate": "none"}, random.Random(1)
    with serve(data, **settings) as (process, client):
        maps = [make_map(client, n) for n in range(10)]
        load = Load(maps, chance)
        for _ in range(20):
            load.feed(client, 0)
        process.send_signal(signal.SIGKILL)
    gone: set[str] = set()
    for _ in range(2):
        with serve(data, **settings) as (process, client):
            left = [which for which in maps if which not in gone]
            count = len(gone) + chance.randint(2, 3)

            def remove(url: str, left: list[str] = left) -> None:
                with httpx.Client(base_url=url, timeout=60) as other:
                    for which in left:
                        try:
                            other.delete(f"/v1/maps/{which}", headers=ADMIN).raise_for_status()
                        except httpx.TransportError:
                            return
                        gone.add(which)

            removing = threading.Thread(target=remove, args=(str(client.base_url),))
            removing.start()
            while len(gone) < count:
                assert removing.is_alive()
            time.sleep(chance.uniform(0, 0.02))
            process.send_signal(signal.SIGKILL)
            process.wait()
            removing.join()
        with serve(data, **settings) as (_, client):
            for which in maps:
                if client.get(f"/v1/maps/{which}").status_code == 404:
                    assert not any(graphs_of(client, which).values())
                    gone.add(which)
                else:
                    assert which not in gone
                    while not graphs_of(client, which)["provenance"]:
                        time.sleep(0.05)  # it is stated in the background
                    assert half_written(client, which) == []
    assert gone < set(maps)
