"""A store elsewhere: what goes wrong between us and it, and what our clients see of it."""

import asyncio
import os
import subprocess
import sys
import threading
from base64 import b64encode
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import pytest
from pydantic import ValidationError

from symboslam.errors import StoreError
from symboslam.service.settings import Settings
from symboslam.service.store import endpoint, remote
from symboslam.service.store._base import (
    Document,
    Formats,
    NotAcceptableError,
    Query,
    QueryError,
    TimeLimitError,
)
from symboslam.service.store.remote import RemoteStore
from tests.service.conftest import ADMIN, TOKEN, MakeService
from tests.service.fuseki import UNION
from tests.service.test_protocol import problem

JSON = "application/sparql-results+json"
NO = b'{"head": {}, "boolean": false}'
ASK = Query("ASK {}", "http://example.org/", Formats(JSON, JSON, None))


@dataclass
class Reply:
    """What a server sends.

    Attributes:
        status: of HTTP.
        kind: its media type.
        body: what comes, which may be less than is announced.
        headers: further headers.
        wait: what it waits for in the middle of the body.
    """

    status: int = 200
    kind: str = JSON
    body: bytes = NO
    headers: dict[str, str] = field(default_factory=dict)
    wait: threading.Event | None = None


def configured(**given: Any) -> Settings:
    return Settings(**given)


class Elsewhere(ThreadingHTTPServer):
    """A server that answers every path as it is told.

    Attributes:
        replies: what it sends, by path.
        seen: paths and headers of all requests.
    """

    def __init__(self, port: int = 0) -> None:
        self.replies: dict[str, Reply] = {}
        self.seen: list[tuple[str, dict[str, str]]] = []
        super().__init__(("127.0.0.1", port), _Handler)
        self.url = f"http://127.0.0.1:{self.server_port}"

    def paths(self) -> list[str]:
        return [path for path, _ in self.seen]


class _Handler(BaseHTTPRequestHandler):
    server: Elsewhere

    def _answer(self) -> None:
        self.rfile.read(int(self.headers.get("content-length", 0)))
        path = self.path.partition("?")[0]
        self.server.seen.append((path, dict(self.headers.items())))
        reply = self.server.replies.get(path, Reply())
        self.send_response(reply.status)
        self.send_header("Content-Type", reply.kind)
        self.send_header("Content-Length", str(len(reply.body)))
        for name, value in reply.headers.items():
            self.send_header(name, value)
        self.end_headers()
        if reply.wait is not None:
            self.wfile.flush()
            reply.wait.wait()
        else:
            self.wfile.write(reply.body)

    do_GET = do_POST = do_PUT = _answer

    def log_message(self, *_: object) -> None:
        """Nothing."""


@contextmanager
def serving(server: Elsewhere) -> Iterator[Elsewhere]:
    thread = threading.Thread(target=server.serve_forever, args=(0.01,))
    thread.start()
    try:
        yield server
    finally:
        server.shutdown()
        server.server_close()
        thread.join()


@pytest.fixture
def elsewhere() -> Iterator[Elsewhere]:
    with serving(Elsewhere()) as server:
        yield server


Do = Callable[[Any], Any]


@contextmanager
def connected(server: Elsewhere, folder: Path, **given: Any) -> Iterator[tuple[RemoteStore, Do]]:
    """A store at a server, started, and what runs its methods."""
    with asyncio.Runner() as runner:
        store = RemoteStore(configured(data=folder, store=f"{server.url}/ds/sparql", **given))
        runner.run(store.start())
        try:
            yield store, runner.run
        finally:
            runner.run(store.stop())


HTML = "text/html"
TRACE = b"boom\n\tat java.lang.Thread.run\n"


@pytest.mark.parametrize(
    ("reply", "error", "said"),
    [
        (Reply(401), StoreError, "SYMBOSLAM_STORE_USER"),
        (Reply(403), StoreError, "SYMBOSLAM_STORE_USER"),
        (Reply(404, HTML, b"<html>nothing</html>"), StoreError, "status 404"),
        (Reply(500, "text/plain", TRACE), StoreError, "status 500: boom"),
        (Reply(503, "text/plain", b"overloaded"), StoreError, "status 503: overloaded"),
        (Reply(503, "text/plain", b"Query timed out\n"), TimeLimitError, "by the store"),
        (Reply(400, "text/plain", b"Parse error: x at line 7, column 2."), QueryError, "x"),
        (Reply(400, "text/plain", b" " * 9000 + b"line"), QueryError, "malformed"),
        (Reply(400, HTML, b"<html>bad</html>"), QueryError, "malformed"),
        (Reply(406), NotAcceptableError, "formats"),
        (Reply(200, HTML, b"<html>Welcome</html>"), StoreError, "no SPARQL endpoint"),
        (Reply(302, headers={"Location": "/trap"}), StoreError, "elsewhere, at /trap"),
        (Reply(headers={"Content-Encoding": "gzip"}), StoreError, "broke off"),
    ],
)
def test_failures(
    elsewhere: Elsewhere, tmp_path: Path, reply: Reply, error: type[StoreError], said: str
) -> None:
    with connected(elsewhere, tmp_path, store_password="hidden", store_user="me") as (store, do):
        elsewhere.replies["/ds/sparql"] = reply
        with pytest.raises(error, match=said) as caught:
            do(store.query(ASK))
        assert caught.type is error
        for hidden in ("java.lang", "html>", "hidden"):
            assert hidden not in str(caught.value)
        assert "/trap" not in elsewhere.paths()
        del elsewhere.replies["/ds/sparql"]
        do(store.query(ASK))
        assert store.ready


def test_half_a_result_is_none(elsewhere: Elsewhere, tmp_path: Path) -> None:
    with connected(elsewhere, tmp_path) as (store, do):
        elsewhere.replies["/ds/sparql"] = Reply(headers={"Content-Length": "1000"})
        with pytest.raises(StoreError, match="broke off"):
            do(store.query(ASK))
        elsewhere.replies["/ds/sparql"] = Reply(body=NO[:10])
        with pytest.raises(StoreError, match="JSON"):
            do(store.has_graph("urn:g"))


def test_a_store_that_is_slow(elsewhere: Elsewhere, tmp_path: Path) -> None:
    wait = threading.Event()
    try:
        with connected(elsewhere, tmp_path, query_seconds=0.3) as (store, do):
            slow = Reply(wait=wait)
            elsewhere.replies.update({"/ds/sparql": slow, "/ds/update": slow})
            with pytest.raises(TimeLimitError):
                do(store.query(ASK))
            with pytest.raises(StoreError, match="perhaps it will"):
                do(store.update("CLEAR ALL", "http://example.org/"))
    finally:
        wait.set()


def test_credentials(elsewhere: Elsewhere, tmp_path: Path) -> None:
    basic = "Basic " + b64encode(b"me:secret").decode()
    user: dict[str, Any] = {"store_user": "me", "store_password": "secret"}
    cases: list[tuple[dict[str, Any], str | None]] = [
        ({}, None), (user, basic), ({"store_token": "abc"}, "Bearer abc"),
    ]  # fmt: skip
    for given, expected in cases:
        elsewhere.seen.clear()
        with connected(elsewhere, tmp_path, **given) as (store, do):
            do(store.update("CLEAR ALL", "http://example.org/"))
            do(store.replace_graph("urn:g", [Document("text/turtle", b"", "urn:g")]))
        assert {"/ds/sparql", "/ds/update", "/ds/data"} == set(elsewhere.paths())
        assert {headers.get("Authorization") for _, headers in elsewhere.seen} == {expected}
    assert "secret" not in repr(configured(**user))


def test_it_comes_back(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(endpoint, "_PROBE_SECONDS", 0.02)
    with serving(Elsewhere()) as first, connected(first, tmp_path) as (store, do):
        first.replies["/ds/sparql"] = Reply(503)
        with pytest.raises(StoreError):
            do(store.query(ASK))
        assert not store.ready
        do(asyncio.sleep(0.1))
        assert not store.ready
        del first.replies["/ds/sparql"]
        while not store.ready:  # nobody asks anything
            do(asyncio.sleep(0.01))


def test_where_it_takes_updates_has_to_be_known(elsewhere: Elsewhere, tmp_path: Path) -> None:
    with asyncio.Runner() as runner:
        settings = configured(data=tmp_path, store=f"{elsewhere.url}/repositories/maps")
        store = RemoteStore(settings)
        runner.run(store.start())
        assert not runner.run(store.has_graph("urn:g"))
        with pytest.raises(StoreError, match="SYMBOSLAM_STORE_UPDATE"):
            runner.run(store.update("CLEAR ALL", "http://example.org/"))
        runner.run(store.stop())


@pytest.mark.parametrize(
    "url",
    ["ftp://example.org/", "http://me:secret@example.org/ds", "http://example.org/?x", "store"],
)
def test_addresses_that_are_refused(url: str) -> None:
    with pytest.raises(ValidationError):
        configured(store=url)


def test_empty_settings_are_none() -> None:
    settings = configured(store="", store_update="", store_user="", store_token="")
    assert (settings.store, settings.store_update, settings.store_user) == (None, None, None)
    assert settings.store_token is None


# Over HTTP, with Fuseki behind


def test_what_clients_see(make_service: MakeService, fuseki_url: str) -> None:
    service = make_service(store=fuseki_url, store_union_graphs=UNION)
    service.update("DROP ALL").raise_for_status()
    data = "INSERT DATA { GRAPH <urn:g> { <urn:a> <urn:p> 'größer' } }"
    assert service.update(data).status_code == 204
    assert service.values("SELECT ?g ?o { ?s ?p ?o GRAPH ?g { ?s ?p ?o } }") == [
        ["urn:g", "größer"]
    ]
    for address in ("/sparql?query=ASK%7B%7D", "/graphs?graph=urn:g", "/sparql"):
        response = service.client.get(address, headers={"If-None-Match": "*"})
        assert response.status_code == 200
        assert "etag" not in response.headers, "somebody else may write there"
        head = service.client.head(address)
        assert (head.status_code, head.content) == (200, b"")
    members = problem(service.ask("ASK {\n ?s"), 400, "malformed-query")
    assert members["line"] == 2
    missing = service.client.get("/graphs?graph=urn:none")
    assert "urn:none" in str(problem(missing, 404, "missing-graph")["detail"])
    assert service.client.get("/readyz").status_code == 200
    described = service.client.get("/sparql", headers={"Accept": "application/n-triples"}).text
    assert "<urn:g>" in described


def test_a_large_graph_there_and_back(make_service: MakeService, fuseki_url: str) -> None:
    service = make_service(store=fuseki_url)
    lines = "".join(f"<urn:s{i}> <urn:p> {i} .\n" for i in range(20_000))
    headers = {**ADMIN, "Content-Type": "text/turtle"}
    put = service.client.put("/graphs?graph=urn:large", content=lines, headers=headers)
    assert put.status_code in (201, 204)
    got = service.client.get("/graphs?graph=urn:large", headers={"Accept": "application/n-triples"})
    assert got.text.count("\n") == 20_000
    assert not list(service.app.state.settings.data.glob("spool/*"))
    assert service.client.delete("/graphs?graph=urn:large", headers=ADMIN).status_code == 204


def test_too_many_graphs_to_name(
    make_service: MakeService, fuseki_url: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    service = make_service(store=fuseki_url, store_union_graphs=UNION)
    service.update("DROP ALL").raise_for_status()
    data = "INSERT DATA { GRAPH <urn:g> { <urn:a> <urn:p> 1 } GRAPH <urn:h> { <urn:a> <urn:p> 2 } }"
    service.update(data).raise_for_status()
    monkeypatch.setattr(remote, "_MOST_GRAPHS", 1)
    problem(service.ask("SELECT * { GRAPH ?g { ?s ?p ?o } }"), 503, "store-unavailable")
    assert len(service.values("SELECT * { ?s ?p ?o }")) == 2
    monkeypatch.setattr(remote, "_MOST_GRAPHS", 2)
    assert len(service.values("SELECT * { GRAPH ?g { ?s ?p ?o } }")) == 2


def test_a_store_that_has_gone(elsewhere: Elsewhere, make_service: MakeService) -> None:
    service = make_service(store=f"{elsewhere.url}/ds/sparql")
    assert service.ask("ASK {}").json() == {"head": {}, "boolean": False}
    elsewhere.replies["/ds/sparql"] = Reply(503)
    problem(service.ask("ASK {}"), 503, "store-unavailable")
    problem(service.client.get("/readyz"), 503, "not-ready")
    assert service.client.get("/healthz").status_code == 200


def test_serve_says_what_keeps_it_from_starting(elsewhere: Elsewhere, tmp_path: Path) -> None:
    def refused(url: str) -> str:
        command = [sys.executable, "-m", "symboslam", "serve", "--data", str(tmp_path)]
        environment = {**os.environ, "SYMBOSLAM_STORE": url, "SYMBOSLAM_ADMIN_TOKEN": TOKEN}
        done = subprocess.run(
            [*command, "--port", "0"], check=False, text=True, capture_output=True,
            env=environment, timeout=60,
        )  # fmt: skip
        assert (done.returncode, done.stdout) == (2, "")
        assert done.stderr.count("\n") == 1, done.stderr
        return done.stderr

    nobody = "http://127.0.0.1:9/ds/sparql"  # the port "discard", at which nobody listens
    assert f"{nobody}: the store cannot be reached" in refused(nobody)
    elsewhere.replies["/page"] = Reply(kind="text/html")
    assert "no SPARQL endpoint" in refused(f"{elsewhere.url}/page")
    elsewhere.replies["/ds/data"] = Reply(401)  # it takes queries, but not our ontology
    assert "SYMBOSLAM_STORE_USER" in refused(f"{elsewhere.url}/ds/sparql")
    assert "SYMBOSLAM_STORE: " in refused("ftp://example.org/")
