"""The end of a server in good order: a true process, and event streams."""

import asyncio
import contextlib
import signal
import threading
import time
from collections.abc import AsyncIterator
from pathlib import Path

import httpx
import pytest
from fastapi.responses import StreamingResponse

from tests.service.conftest import UPDATE, MakeService
from tests.service.test_durability import count, serve
from tests.service.test_limits import KILLER

GRACE = 60


class Asking(threading.Thread):
    """Somebody who asks the killer, and what they get."""

    def __init__(self, client: httpx.Client) -> None:
        super().__init__()
        self._url = client.base_url
        self.response: httpx.Response | None = None
        self.start()

    def run(self) -> None:
        url = self._url.join("/sparql")
        with contextlib.suppress(httpx.RemoteProtocolError):
            self.response = httpx.get(url, params={"query": KILLER}, timeout=60)


def running(client: httpx.Client) -> int:
    """How many queries run, by the server's own figures."""
    for line in client.get("/metrics").text.splitlines():
        if line.startswith("symboslam_queries_running "):
            return int(float(line.split()[1]))
    raise AssertionError("no such figure")


def started(client: httpx.Client) -> Asking:
    asking = Asking(client)
    while not running(client):
        time.sleep(0.005)
    return asking


def test_what_runs_may_end(tmp_path: Path) -> None:
    with serve(tmp_path, query_seconds="2") as (process, client):
        text = "INSERT DATA { GRAPH <urn:g> { <urn:s> <urn:p> 1 } }"
        assert client.post("/sparql", content=text, headers=UPDATE).status_code == 204
        asking = started(client)
        process.send_signal(signal.SIGTERM)
        out, err = process.communicate(timeout=GRACE)
        asking.join()
        assert (process.returncode, out.strip(), err) == (0, "stopped", "")
        assert asking.response is not None
        assert asking.response.status_code == 504  # the query's own limit, which it reached
    with serve(tmp_path) as (_, client):
        assert count(client) == 1


def test_what_takes_too_long_is_told(tmp_path: Path) -> None:
    with serve(tmp_path, query_seconds="1000", stop_seconds="1") as (process, client):
        asking = started(client)
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=GRACE)
        asking.join()
        assert process.returncode == 0
        assert asking.response is not None
        assert asking.response.status_code == 503
        assert asking.response.json()["type"].endswith("#stopping")


def test_a_service_that_stops_soon_is_not_ready(tmp_path: Path) -> None:
    with serve(tmp_path, drain_seconds="1000") as (process, client):
        assert client.get("/readyz").status_code == 200
        process.send_signal(signal.SIGTERM)
        while (ready := client.get("/readyz")).status_code == 200:
            time.sleep(0.01)
        assert ready.status_code == 503
        assert ready.json()["type"].endswith("#stopping")
        assert client.get("/healthz").status_code == 200
        assert client.get("/sparql?query=ASK+%7B%7D").status_code == 200
        process.send_signal(signal.SIGINT)  # enough
        process.communicate(timeout=GRACE)
        assert process.returncode == 0


def test_nobody_is_let_in_after_the_signal(tmp_path: Path) -> None:
    with serve(tmp_path, query_seconds="1000", stop_seconds="1000") as (process, client):
        asking = started(client)
        process.send_signal(signal.SIGTERM)
        url = client.base_url.join("/healthz")
        with contextlib.suppress(httpx.ConnectError):
            while True:
                httpx.get(url)
        with pytest.raises(httpx.ConnectError):
            httpx.get(url)
        process.kill()
        asking.join()
        assert asking.response is None


def test_event_streams_flow_and_end(make_service: MakeService) -> None:
    service = make_service()
    more = threading.Event()

    async def events() -> AsyncIterator[str]:
        yield "data: one\n\n"
        while not more.is_set():
            await asyncio.sleep(0.01)
        yield "data: two\n\n"
        await asyncio.sleep(1000)

    async def stream() -> StreamingResponse:
        return StreamingResponse(events(), media_type="text/event-stream")

    service.app.add_api_route("/events", stream)
    lifecycle = service.app.state.lifecycle
    with service.client.stream("GET", "/events", headers={"Accept-Encoding": "gzip"}) as response:
        assert "content-encoding" not in response.headers
        lines = response.iter_lines()
        assert next(lines) == "data: one"  # though nothing else has been sent yet
        more.set()
        assert [next(lines), next(lines)] == ["", "data: two"]
        (task,) = lifecycle.streams
        task.get_loop().call_soon_threadsafe(lifecycle.end)
        assert list(lines) == [""]  # an end, not a break
    while lifecycle.streams:  # the response ends a moment earlier
        time.sleep(0.005)
