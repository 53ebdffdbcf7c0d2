"""Limits: a killer query costs only itself, and nothing else brings the service down."""

import time
from collections.abc import Iterator
from contextlib import closing
from http.client import HTTPConnection
from urllib.parse import urlencode

import pytest

from symboslam.service.store.oxigraph import OxigraphStore
from tests.service.conftest import TOKEN, UPDATE, MakeService, Service, running
from tests.service.test_protocol import problem

NUMBERS = " ".join(f"({i})" for i in range(300))
# 300 to the fifth power rows: days.
KILLER = (
    "SELECT (COUNT(*) AS ?n) { "
    + " ".join(f"VALUES (?{name}) {{ {NUMBERS} }}" for name in "abcde")
    + " }"
)
KILLER_ROWS = KILLER.replace("(COUNT(*) AS ?n)", "*")
KILLER_GRAPH = KILLER.replace("SELECT (COUNT(*) AS ?n)", "CONSTRUCT { [] <urn:p> ?b } WHERE")
QUICK = "SELECT (1 AS ?x) {}"
LONG = 1000.0  # seconds that no test waits for


@pytest.fixture(scope="module")
def limited(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Service]:
    """A service with a short time limit."""
    with running(
        data=tmp_path_factory.mktemp("limited"), admin_token=TOKEN, bundled_ontology=False,
        workers=1, query_seconds=2,
    ) as service:  # fmt: skip
        yield service


def store(service: Service) -> OxigraphStore:
    found = service.app.state.store
    assert isinstance(found, OxigraphStore)
    return found


def wait_until_busy(service: Service, workers: int) -> None:
    while store(service).busy != workers:
        time.sleep(0.005)


class Killer:
    """A client that has sent the killer and not read the answer."""

    def __init__(self, service: Service, **headers: str) -> None:
        host, _, port = service.url.removeprefix("http://").partition(":")
        self.connection = HTTPConnection(host, int(port))
        self.connection.request("GET", "/sparql?" + urlencode({"query": KILLER}), headers=headers)

    def close(self) -> None:
        self.connection.close()


def test_a_killer_query_costs_only_itself(make_service: MakeService) -> None:
    service = make_service(workers=2, query_seconds=3)
    before = store(service).workers
    with closing(Killer(service)) as killer:
        wait_until_busy(service, 1)
        for _ in range(5):
            assert service.values(QUICK) == [["1"]]
        assert store(service).busy == 1, "the killer had ended before the others were answered"
        response = killer.connection.getresponse()
        assert response.status == 504
        assert response.headers["content-type"] == "application/problem+json"
        assert b"query-timeout" in response.read()
    wait_until_busy(service, 0)
    after = store(service).workers
    assert len(after) == 2
    assert len(set(before) & set(after)) == 1, "one worker was replaced, the other was left alone"


def test_a_killed_worker_is_replaced(make_service: MakeService) -> None:
    service = make_service(workers=1, query_seconds=0.5)
    for number in range(3):
        problem(service.ask(KILLER), 504, "query-timeout")
        service.update(f"INSERT DATA {{ <urn:s> <urn:p> {number} }}").raise_for_status()
        assert len(service.values("SELECT * { ?s ?p ?o }")) == number + 1


def test_the_query_of_a_client_that_leaves_is_stopped(make_service: MakeService) -> None:
    service = make_service(workers=1, query_seconds=LONG, queue_seconds=LONG)
    with closing(Killer(service)):
        wait_until_busy(service, 1)
    assert service.values(QUICK) == [["1"]]


def test_one_too_many_is_turned_away(make_service: MakeService) -> None:
    service = make_service(workers=1, query_seconds=LONG, queue_length=0)
    with closing(Killer(service)):
        wait_until_busy(service, 1)
        response = service.ask(QUICK)
        problem(response, 503, "too-busy")
        assert int(response.headers["retry-after"]) > 0
        assert service.client.get("/healthz").status_code == 200
        problem(service.update("CLEAR ALL"), 503, "too-busy")


def test_nobody_waits_for_ever(make_service: MakeService) -> None:
    service = make_service(workers=1, query_seconds=LONG, queue_length=1, queue_seconds=0.1)
    with closing(Killer(service)):
        wait_until_busy(service, 1)
        problem(service.ask(QUICK), 503, "too-busy")


def test_a_service_stops_while_a_killer_runs(make_service: MakeService) -> None:
    service = make_service(workers=1, query_seconds=LONG)
    killer = Killer(service)
    wait_until_busy(service, 1)
    killer.close()  # and the end of the test stops the service


@pytest.mark.parametrize("accept", ["text/csv", "application/sparql-results+json"])
@pytest.mark.parametrize("encoding", ["identity", "gzip"])
def test_a_result_that_is_too_large(make_service: MakeService, accept: str, encoding: str) -> None:
    service = make_service(max_result_bytes=1_000_000)
    headers = {"Accept": accept, "Accept-Encoding": encoding}
    response = service.client.get("/sparql", params={"query": KILLER_ROWS}, headers=headers)
    problem(response, 422, "result-too-large")
    assert not list(service.app.state.settings.data.glob("spool/*"))
    assert service.values(QUICK) == [["1"]]


@pytest.mark.parametrize("accept", ["text/turtle", "application/n-triples", "application/rdf+xml"])
def test_a_graph_that_is_too_large(make_service: MakeService, accept: str) -> None:
    service = make_service(max_result_bytes=2_000)
    headers = {"Accept": accept}
    response = service.client.get("/sparql", params={"query": KILLER_GRAPH}, headers=headers)
    problem(response, 422, "result-too-large")


def test_a_query_that_needs_too_much_memory(make_service: MakeService) -> None:
    service = make_service(worker_memory=400_000_000, query_seconds=LONG)
    sorting = KILLER_ROWS + " ORDER BY ?a ?b ?c ?d ?e"
    problem(service.ask(sorting), 422, "query-too-complex")
    assert service.values(QUICK) == [["1"]]


DEEP = 60_000
HOSTILE = {
    "parentheses": "SELECT ({}1{} AS ?x) {{}}".format("(" * DEEP, ")" * DEEP),
    "groups": "SELECT * {}{}".format("{" * DEEP, "}" * DEEP),
    "negations": "SELECT ({}1 AS ?x) {{}}".format("!" * DEEP),
    "sums": "SELECT (1{} AS ?x) {{}}".format("+1" * DEEP),
    "paths": "SELECT * {{ ?s {}<urn:p>{} ?o }}".format("(" * DEEP, ")*" * DEEP),
    "unions": "SELECT * {{ {{}} {} }}".format("UNION {} " * DEEP),
    "a large text": f"SELECT ('{'x' * 900_000}' AS ?x) {{}}",
    "null bytes": "ASK {}\0\0",
    "lone surrogate": "SELECT ('\\uD800' AS ?x) {}",
    "regex": "ASK { FILTER(REGEX('" + "a" * 5000 + "', '" + "(a*)*" * 2000 + "b')) }",
    "repetition": "ASK { FILTER(REGEX('aaa', '((((a{1000}){1000}){1000}){1000})b')) }",
    "replacement": "SELECT (STRLEN(REPLACE('" + "a" * 1000 + "', '', 'b')) AS ?n) {}",
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_queries(limited: Service, name: str) -> None:
    response = limited.client.post("/sparql", data={"query": HOSTILE[name]})
    assert response.status_code in (200, 400, 422, 504)
    assert limited.values(QUICK) == [["1"]]


@pytest.mark.parametrize("name", ["parentheses", "groups", "negations", "sums", "paths"])
def test_hostile_updates(limited: Service, name: str) -> None:
    where = HOSTILE[name].replace("SELECT", "INSERT { <urn:s> <urn:p> 1 } WHERE { SELECT", 1) + "}"
    response = limited.update(where)
    assert response.status_code in (204, 400, 422, 504)
    assert limited.values(QUICK) == [["1"]]


BOMB = "INSERT { GRAPH <urn:bomb> { <urn:a> <urn:b> ?n } } WHERE { " + KILLER + " }"


def test_an_update_that_takes_too_long_is_stopped(limited: Service) -> None:
    response = limited.client.post("/sparql", content=BOMB, headers=UPDATE)
    problem(response, 504, "query-timeout")
    small = "INSERT { GRAPH <urn:small> { <urn:a> <urn:b> ?n } } WHERE { BIND(1 AS ?n) }"
    assert limited.client.post("/sparql", content=small, headers=UPDATE).status_code == 204
    assert limited.values("SELECT ?g { GRAPH ?g { <urn:a> <urn:b> ?n } }") == [["urn:small"]]
    assert not list(store(limited)._settings.data.glob("spool/*.store"))
