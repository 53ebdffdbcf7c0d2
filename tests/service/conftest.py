"""A service to ask: real servers, each in a thread of its own."""

import socket
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

pytest.importorskip("fastapi", reason="needs symboslam[service]")
pytest.importorskip("httpx", reason="needs the dev extra")
pytest.importorskip("uvicorn", reason="needs symboslam[service]")

import httpx

from symboslam.service.app import create_app
from symboslam.service.server import Server
from symboslam.service.settings import Settings
from tests.service.fuseki import fuseki

if TYPE_CHECKING:
    from fastapi import FastAPI

TOKEN = "a-token-for-tests"
ADMIN = {"Authorization": f"Bearer {TOKEN}"}
UPDATE = {**ADMIN, "Content-Type": "application/sparql-update"}
QUERY = {"Content-Type": "application/sparql-query"}


@dataclass
class Service:
    """A service that runs.

    Attributes:
        url: its address.
        app: what it serves.
        client: asks it, without a token.
    """

    url: str
    app: "FastAPI"
    client: httpx.Client

    def ask(self, query: str, **parameters: Any) -> httpx.Response:
        """Ask a query by GET."""
        return self.client.get("/sparql", params={"query": query, **parameters})

    def update(self, text: str) -> httpx.Response:
        """Send an update as the administrator."""
        return self.client.post("/sparql", content=text, headers=UPDATE)

    def values(self, query: str) -> list[list[str]]:
        """The values of a query's solutions, in their order."""
        response = self.ask(query)
        assert response.status_code == 200, response.text
        return [[b["value"] for b in s.values()] for s in response.json()["results"]["bindings"]]


@contextmanager
def running(**given: Any) -> Iterator[Service]:
    """A service with some settings."""
    settings = Settings(**given)
    app = create_app(settings)
    with socket.socket(proto=socket.IPPROTO_TCP) as listening:
        listening.bind(("127.0.0.1", 0))
        url = f"http://127.0.0.1:{listening.getsockname()[1]}"
        server = Server(app, settings)
        thread = threading.Thread(target=server.run, args=([listening],))
        thread.start()
        try:
            while not server.started:
                assert thread.is_alive(), "the server did not start"
                time.sleep(0.005)
            with httpx.Client(base_url=url, timeout=60) as client:
                yield Service(url, app, client)
        finally:
            server.should_exit = True
            thread.join()


MakeService = Callable[..., Service]


@pytest.fixture
def make_service(tmp_path: Path) -> Iterator[MakeService]:
    """Starts a service of the test's own, without the ontology, with settings that it names."""
    with ExitStack() as stack:

        def make(**given: Any) -> Service:
            chosen = {
                "data": tmp_path / "data", "admin_token": TOKEN, "bundled_ontology": False,
                "workers": 1, "quick_workers": 0, **given,
            }  # fmt: skip
            return stack.enter_context(running(**chosen))

        yield make


@pytest.fixture(scope="session")
def shared_service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    """A service for all tests that do not mind each other, with a plain default graph."""
    with running(
        data=tmp_path_factory.mktemp("shared"), admin_token=TOKEN, bundled_ontology=False,
        union_default_graph=False, workers=2, max_body_bytes=100_000, max_query_bytes=10_000,
        cors_origins="https://maps.example, https://other.example",
    ) as service:  # fmt: skip
        yield service


@pytest.fixture(scope="module")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    """A service for the maps of a module's tests."""
    with running(
        data=tmp_path_factory.mktemp("maps"), admin_token=TOKEN, bundled_ontology=False,
        workers=1, rate="",
    ) as service:  # fmt: skip
        yield service


@pytest.fixture
def service(shared_service: Service) -> Service:
    """The shared service, emptied."""
    shared_service.update("DROP ALL").raise_for_status()
    return shared_service


@pytest.fixture(scope="session")
def fuseki_url(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """A store elsewhere, for tests that empty it first; skips where there is none."""
    with fuseki(tmp_path_factory.mktemp("fuseki")) as url:
        yield url


@pytest.fixture(scope="session")
def with_ontology(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    """A fresh service as ``symboslam serve --read-only`` starts it."""
    with running(data=tmp_path_factory.mktemp("ontology"), workers=2, read_only=True) as service:
        yield service
