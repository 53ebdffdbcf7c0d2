"""What maps take of memory and of the store: bounded, named, and not for others to write."""

from __future__ import annotations

import asyncio
import gc
from typing import Any, cast

import pytest

from symboslam.service.maps import maps as maps_module
from symboslam.service.maps.maps import Maps
from tests.service.conftest import ADMIN, Service
from tests.service.test_maps import at, get, make, send

TURTLE = {**ADMIN, "Content-Type": "text/turtle"}
MAP = "https://w3id.org/symboslam/map/"


def maps_of(service: Service) -> Maps:
    return cast(Maps, service.app.state.maps)


def test_what_was_read_is_kept_within_bounds(shared: Service) -> None:
    which = make(shared)
    send(shared, which, *(at("House", 10 * i, 10) for i in range(5)))
    for limit in range(1, 30):
        assert len(get(shared, f"{which}/landmarks", limit=limit)["features"]) == min(limit, 5)
    cache: dict[str, Any] = maps_of(shared)._running[which]._cache
    assert len(cache) == 4
    assert len(get(shared, f"{which}/landmarks", limit=3)["features"]) == 3
    send(shared, which, at("House", 300, 300))
    assert len(get(shared, f"{which}/landmarks", limit=29)["features"]) == 6


def test_maps_that_nobody_uses_leave_memory(
    shared: Service, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(maps_module, "MOST_OPEN", 2)
    found = [make(shared, name=f"map {i}") for i in range(5)]
    for i, which in enumerate(found):
        assert send(shared, which, at("House", 10 + i, 10)).json()["new"] == 1
    gc.collect()
    assert len(set(found) & set(maps_of(shared)._running.keys())) <= 2
    for i, which in enumerate(found):
        answer = get(shared, f"{which}/landmarks")
        assert answer["features"][0]["geometry"]["coordinates"] == [10 + i, 10]
    listed = {each["id"]: each["name"] for each in get(shared, "")}
    assert [listed[which] for which in found] == [f"map {i}" for i in range(5)]


def test_a_map_in_use_is_one(shared: Service, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(maps_module, "MOST_OPEN", 1)
    first, second = make(shared), make(shared)
    maps = maps_of(shared)
    loop = asyncio.new_event_loop()
    used = loop.run_until_complete(maps.open(first))
    get(shared, second)
    gc.collect()
    assert loop.run_until_complete(maps.open(first)) is used
    loop.close()


def test_the_store_knows_the_map_by_its_name(shared: Service) -> None:
    which = make(shared, name='Vaduz "old town"')
    query = f"SELECT ?n {{ GRAPH ?g {{ <{MAP}{which}/map> <http://purl.org/dc/terms/title> ?n }} }}"
    assert shared.values(query) == [['Vaduz "old town"']]
    send(shared, which, at("House", 10, 10))
    assert shared.values(query) == [['Vaduz "old town"']]


@pytest.mark.parametrize("method", ["PUT", "POST", "DELETE"])
def test_graphs_of_maps_are_not_written(shared: Service, method: str) -> None:
    which = make(shared)
    graph = {"graph": f"{MAP}{which}/segments"}
    response = shared.client.request(
        method, "/graphs", params=graph, headers=TURTLE, content="<urn:a> <urn:b> 1 ."
    )
    assert response.status_code == 409
    assert response.json()["type"].endswith("#graph-of-a-map")
    assert which in response.json()["detail"]
    other = {"graph": f"{MAP}none-such/segments"}
    statuses = [
        shared.client.request(name, "/graphs", params=other, headers=TURTLE, content=text)
        for name, text in (("PUT", "<urn:a> <urn:b> 1 ."), ("DELETE", None))
    ]
    assert [each.status_code for each in statuses] == [201, 204]
