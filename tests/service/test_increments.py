"""Increments of robots over HTTP: each once, in any order, kept; what is known of the robots."""

import json
import signal
import threading
import time
from pathlib import Path
from typing import Any

import httpx
import pytest

from tests.service.conftest import ADMIN, MakeService, Service, running
from tests.service.increments import increment
from tests.service.test_durability import serve
from tests.service.test_maps import make

JSON = {**ADMIN, "Content-Type": "application/json"}
NDJSON = {**ADMIN, "Content-Type": "application/x-ndjson"}


def post(client: httpx.Client, which: str, *sent: dict[str, Any]) -> httpx.Response:
    content = "\n".join(map(json.dumps, sent))
    return client.post(f"/v1/maps/{which}/increments", content=content, headers=NDJSON)


def fetch(client: httpx.Client, which: str, **parameters: Any) -> list[dict[str, Any]]:
    response = client.get(f"/v1/maps/{which}/increments", params=parameters)
    assert response.status_code == 200, response.text
    assert response.headers["content-type"].startswith("application/x-ndjson")
    return [json.loads(line) for line in response.text.splitlines()]


def robots(client: httpx.Client, which: str) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = client.get(f"/v1/maps/{which}/robots").json()
    return found


def test_each_is_taken_once_and_comes_in_order_of_arrival(shared: Service) -> None:
    which, client = make(shared), shared.client
    assert fetch(client, which) == robots(client, which) == []
    response = client.post(f"/v1/maps/{which}/increments", json=increment(), headers=JSON)
    assert response.status_code == 201
    assert response.json() == {"received": 1, "new": 1, "known": 0}
    response = post(client, which, increment(sequence=2), increment(), increment(sequence=1))
    assert (response.status_code, response.json()) == (201, {"received": 3, "new": 2, "known": 1})
    response = post(client, which, increment(sequence=1), increment(sequence=2))
    assert (response.status_code, response.json()["new"]) == (200, 0)
    found = fetch(client, which)
    assert [each["number"] for each in found] == [1, 2, 3]
    assert [each["increment"] for each in found] == [increment(sequence=n) for n in (0, 2, 1)]
    assert found[0]["received"] <= found[1]["received"]
    assert [each["number"] for each in fetch(client, which, after=1, limit=1)] == [2]
    assert fetch(client, which, after=3) == []
    assert client.get(f"/v1/maps/{which}").json()["revision"] == 0  # they are not landmarks


def test_numbers_may_be_written_in_another_way(shared: Service) -> None:
    which, client = make(shared), shared.client
    assert post(client, which, increment()).json()["new"] == 1
    same = {**increment(), "start": [1, 2, 0], "time": [0, 1]}
    assert post(client, which, dict(reversed(same.items()))).json()["known"] == 1


def test_another_content_under_the_same_name_is_refused(shared: Service) -> None:
    which, client = make(shared), shared.client
    post(client, which, increment())
    response = post(client, which, increment(sequence=1), increment(x=7.0))
    assert response.status_code == 409
    assert response.headers["content-type"] == "application/problem+json"
    assert "increment 0 of run 'a' of robot 'r1'" in response.json()["detail"]
    assert len(fetch(client, which)) == 1, "all or none"
    assert post(client, which, increment(sequence=3), increment(sequence=3, x=2)).status_code == 409
    assert post(client, which, increment(run="b", x=7.0)).status_code == 201


def test_numbers_far_ahead_are_refused(shared: Service) -> None:
    which, client = make(shared), shared.client
    response = post(client, which, increment(sequence=1000))
    assert response.status_code == 409
    assert response.json()["detail"].startswith(
        "increment 1000 of run 'a' of robot 'r1' cannot be: none has come yet, and at most 1000"
    )
    assert post(client, which, increment(sequence=999)).status_code == 201
    assert post(client, which, increment(run="b", sequence=1000)).status_code == 409
    assert post(client, which, increment(sequence=0), increment(sequence=5000)).status_code == 409
    assert len(fetch(client, which)) == 1, "all or none"
    assert post(client, which, increment(sequence=1999), increment(sequence=5)).status_code == 201
    assert robots(client, which)[0]["missing"] == [[0, 4], [6, 998], [1000, 1998]]


@pytest.mark.parametrize(
    ("content", "status", "said"),
    [
        ('{"robot": }', 422, "line 2 column 11"), ("[]", 422, "line 2: it is no JSON object"),
        ('{"robot": "a", "robot": "b"}', 422, "'robot' twice"),
        (json.dumps({**increment(), "time": [1, 1]}), 422, "line 2: time: row 1"),
        (json.dumps(increment(sequence=-1)), 422, "line 2: sequence is no whole number from 0"),
        (json.dumps({**increment(), "sequence": 1.5}), 422, "line 2: sequence is no whole number"),
        (b"\xff", 422, "line 2: it is not UTF-8"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said_with_its_line(
    shared: Service, content: str | bytes, status: int, said: str
) -> None:
    which = make(shared)
    body = json.dumps(increment()).encode() + b"\n"
    body += content if isinstance(content, bytes) else content.encode()
    url = f"/v1/maps/{which}/increments"
    assert shared.client.post(url, content=body, headers=JSON).status_code == 400
    response = shared.client.post(url, content=body, headers=NDJSON)
    assert response.status_code == status
    assert said in response.json()["detail"]
    assert fetch(shared.client, which) == []


def test_limits_and_rights(make_service: MakeService) -> None:
    service = make_service(max_body_bytes=20_000)
    which, client = make(service), service.client
    url = f"/v1/maps/{which}/increments"
    assert client.post(url, json=increment()).status_code == 401
    assert client.post(url, content=b"x" * 20_001, headers=NDJSON).status_code == 413
    text = client.post(url, content=b"x", headers={**ADMIN, "Content-Type": "text/plain"})
    assert text.status_code == 415
    assert (
        client.post("/v1/maps/none/increments", json=increment(), headers=JSON).status_code == 404
    )
    for path in ("none/increments", "none/robots"):
        assert client.get(f"/v1/maps/{path}").status_code == 404
    assert client.get(url, params={"wait": 26}).status_code == 422
    assert client.get(url, params={"before": 1}).status_code == 422


def test_one_who_waits_hears_at_once(shared: Service) -> None:
    which, client = make(shared), shared.client
    start = time.monotonic()
    assert fetch(client, which, wait=0.2) == []
    assert time.monotonic() - start >= 0.2
    found: list[Any] = []
    with httpx.Client(base_url=shared.url, timeout=60) as other:
        waiting = threading.Thread(target=lambda: found.extend(fetch(other, which, wait=25)))
        waiting.start()
        time.sleep(0.3)
        start = time.monotonic()
        post(client, which, increment())
        waiting.join()
    assert time.monotonic() - start < 5
    assert [each["number"] for each in found] == [1]


def test_a_service_that_stops_does_not_wait_for_those_who_wait(tmp_path: Path) -> None:
    said: list[httpx.Response] = []
    with running(data=tmp_path, admin_token="a-token-for-tests", bundled_ontology=False) as service:
        which = make(service)
        url = f"{service.url}/v1/maps/{which}/increments"
        waiting = threading.Thread(
            target=lambda: said.append(httpx.get(url, params={"wait": 25}, timeout=60))
        )
        waiting.start()
        time.sleep(0.5)
        start = time.monotonic()
    waiting.join()
    assert time.monotonic() - start < 8
    assert said[0].status_code == 503
    assert "Retry-After" in said[0].headers


def test_what_is_known_of_robots(shared: Service) -> None:
    which, client = make(shared), shared.client
    post(client, which, *(increment(sequence=n) for n in (0, 1, 4, 6)))
    post(client, which, *(increment("r2", "x", n, last=n == 2) for n in (2, 1)))
    one, two = robots(client, which)
    assert (one["robot"], one["run"], one["increments"], one["latest"]) == ("r1", "a", 4, 6)
    assert one["missing"] == [[2, 3], [5, 5]]
    assert (one["poses"], one["sightings"], one["finished"]) == (8, 4, False)
    assert 0 <= one["silent"] < 60
    assert one["began"] <= one["heard"]
    assert (two["missing"], two["finished"]) == ([[0, 0]], False)
    post(client, which, increment("r2", "x", 0))
    assert robots(client, which)[1]["finished"] is True


def test_a_map_takes_its_increments_with_it(shared: Service) -> None:
    which, other, client = make(shared), make(shared), shared.client
    post(client, which, increment())
    post(client, other, increment())
    assert client.delete(f"/v1/maps/{which}", headers=ADMIN).status_code == 204
    assert client.get(f"/v1/maps/{which}/increments").status_code == 404
    assert len(fetch(client, other)) == 1
    mailbox = shared.app.state.mailbox
    assert mailbox.read(which, 0, 9) == []


def test_acknowledged_increments_survive_kill_9(tmp_path: Path) -> None:
    acknowledged: set[tuple[str, int]] = set()
    with serve(tmp_path / "data", rate="none") as (process, client):
        wanted = {"name": "test", "bbox": [0, 0, 9, 9], "crs": "m"}
        which = client.post("/v1/maps", json=wanted, headers=ADMIN).json()["id"]

        def send(robot: str, url: str = str(client.base_url)) -> None:
            with httpx.Client(base_url=url, timeout=60) as mine:
                for n in range(100_000):
                    try:
                        post(mine, which, increment(robot, sequence=n)).raise_for_status()
                    except httpx.TransportError:
                        return
                    acknowledged.add((robot, n))

        threads = [threading.Thread(target=send, args=(f"r{n}",)) for n in range(3)]
        for thread in threads:
            thread.start()
        while len(acknowledged) < 60:
            time.sleep(0.002)
        process.send_signal(signal.SIGKILL)
        process.wait()
        for thread in threads:
            thread.join()
    with serve(tmp_path / "data", rate="none") as (_, client):
        found = fetch(client, which, limit=10_000)
        names = [(each["increment"]["robot"], each["increment"]["sequence"]) for each in found]
        assert len(set(names)) == len(names)
        assert acknowledged <= set(names)
        assert [each["number"] for each in found] == list(range(1, len(found) + 1))
