"""Hostile clients: another one's simple query is answered, the server lives, memory is bounded.

How slow the other one's queries became is in the report of each test (``-rP`` shows it); only the
slow test asserts issue 5's bound, since a time says as much of the machine as of the service.
"""

import gzip
import json
import socket
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import closing, contextmanager
from urllib.parse import quote

import httpx
import pytest

from tests.service.conftest import ADMIN, TOKEN, UPDATE
from tests.service.serving import Served, serving

PAUSE = 0.05
SLOWEST = 1.0  # seconds; issue 5
WORKERS, QUICK, WORKER_MEMORY = 2, 2, 512 * 1024 * 1024
SERVER_MEMORY = 1024 * 1024 * 1024
MOST_MEMORY = SERVER_MEMORY + (WORKERS + QUICK) * WORKER_MEMORY
NODES = 150
SIMPLE = "SELECT ?o { GRAPH <urn:simple> { <urn:a> <urn:b> ?o } }"
MANY = " ".join(f"({i})" for i in range(300))
CROSS = " ".join(f"VALUES (?{name}) {{ {MANY} }}" for name in "abcde")
TRIPLES = "?a ?b ?c . ?d ?e ?f . ?g ?h ?i . ?j ?k ?l"
DOUBLED = " ".join(f"BIND(CONCAT(?s{i}, ?s{i}) AS ?s{i + 1})" for i in range(40))
DEEP = 20_000

QUERIES: dict[str, str | bytes] = {
    "cartesian product": f"SELECT (COUNT(*) AS ?n) {{ {CROSS} }}",
    "cartesian product of all triples": f"SELECT (COUNT(*) AS ?n) {{ {TRIPLES} }}",
    "rows without end": f"SELECT * {{ {CROSS} }}",
    "sorting a cartesian product": f"SELECT * {{ {TRIPLES} }} ORDER BY ?l ?a ?g LIMIT 5",
    "distinct rows of one": f"SELECT DISTINCT * {{ {TRIPLES} }}",
    "grouping one": f"SELECT ?a (GROUP_CONCAT(?l) AS ?x) {{ {TRIPLES} }} GROUP BY ?a",
    "joining all texts": f"SELECT (GROUP_CONCAT(CONCAT(STR(?a), STR(?d))) AS ?x) {{ {TRIPLES} }}",
    "a graph without end": f"CONSTRUCT {{ ?a ?b ?l . ?d ?e ?a }} WHERE {{ {TRIPLES} }}",
    "a hub described": "DESCRIBE ?a ?c { ?a ?b ?c . ?d ?e ?f }",
    "regular expression": "ASK { FILTER(REGEX('" + "a" * 9000 + "', '(a+)+$|(a|a)*b|"
    + "(a*)*" * 900
    + "'))}",
    "huge repetition": "ASK { FILTER(REGEX('aaa', '((((a{1000}){1000}){1000}){1000})b')) }",
    "alternating path": "SELECT (COUNT(*) AS ?n) { ?x (<urn:p>|<urn:q>)* ?y ."
    " ?y (<urn:p>|<urn:q>)* ?z . ?z (<urn:q>|^<urn:p>)* ?w }",
    "negated paths": "SELECT (COUNT(*) AS ?n) { ?x (!<urn:z>)* ?y . ?y (!<urn:y>)+ ?z ."
    " ?z (^!<urn:x>)* ?w }",
    "deep path": "SELECT * { ?s " + "(" * 60 + "<urn:p>" + ")*" * 60
    + " ?o . ?o <urn:q>* ?u . ?u <urn:p>* ?v }",
    "doubling texts": f"SELECT (STRLEN(?s40) AS ?n) {{ BIND('0123456789' AS ?s0) {DOUBLED} }}",
    "replacing": "SELECT (STRLEN(?y) AS ?n) { BIND(REPLACE('" + "a" * 3200
    + "', 'a', '" + "b" * 3200 + "') AS ?x) BIND(REPLACE(?x, 'b', '" + "c" * 999 + "') AS ?y) }",
    "huge VALUES": "SELECT * { VALUES ?x { " + "1 " * 300_000 + "} }",
    "huge IN": "SELECT * { ?s ?p ?o FILTER(?o IN (" + ",".join(map(str, range(90_000))) + ")) }",
    "nested groups": "SELECT * " + "{" * DEEP + "}" * DEEP,
    "nested brackets": "SELECT (" + "(" * DEEP + "1" + ")" * DEEP + " AS ?x) {}",
    "nested NOT EXISTS": "SELECT * { ?s ?p ?o " + "FILTER NOT EXISTS { ?s ?p ?o " * 400 + "}" * 401,
    "NOT EXISTS by the square": "SELECT (COUNT(*) AS ?n) { ?a ?b ?c . ?d ?e ?f FILTER NOT EXISTS {"
    " ?a ?e ?x . ?x ?b ?d . ?y ?z ?x } }",
    "nested OPTIONAL": "SELECT * { " + "OPTIONAL { ?a ?b ?c . ?c ?d ?e " * 30 + "}" * 31,
    "enormous number": "SELECT (1" + "0" * 100_000 + " * 1" + "0" * 100_000 + " AS ?x) {}",
    "exponent": "SELECT (1e999999999 * 1e999999999 AS ?x) {}",
    "SERVICE": "SELECT * { SERVICE <http://127.0.0.1:1/> { ?s ?p ?o } }",
    "SERVICE in disguise": "SELECT * { s\\u0045RVICE SILENT ?x { ?s ?p ?o } }",
    "NUL": "ASK {} \0\0",
    "a lone surrogate": "SELECT ('\\uD800' AS ?x) {}",
    "no text": b"ASK { <urn:\xff\xfe> ?p '\xc3\x28' }",
}  # fmt: skip
UPDATES: dict[str, str | bytes] = {
    "LOAD": "LOAD <http://127.0.0.1:1/>",
    "LOAD in disguise": "l\\u004fAD SILENT <file:///etc/passwd>",
    "nested groups": "INSERT { <urn:s> <urn:p> 1 } WHERE " + "{" * DEEP + "}" * DEEP,
    "nested brackets": "INSERT { <urn:s> <urn:p> ?x } WHERE { BIND(" + "(" * DEEP + "1" + ")" * DEEP
    + " AS ?x) }",
    "no text": b"INSERT DATA { <urn:\xff> <urn:p> 1 }",
    "SERVICE": "INSERT { ?s ?p ?o } WHERE { SERVICE <http://127.0.0.1:1/> { ?s ?p ?o } }",
}  # fmt: skip
BOMB = (
    '<!DOCTYPE x [<!ENTITY a "aaaaaaaaaa">'
    + "".join(
        f'<!ENTITY {b} "{f"&{a};" * 10}">' for a, b in zip("abcdefgh", "bcdefghi", strict=True)
    )
    + "]><rdf:RDF xmlns:rdf='http://www.w3.org/1999/02/22-rdf-syntax-ns#'>&i;</rdf:RDF>"
)
UPLOADS = {
    "XML entities": ("application/rdf+xml", BOMB.encode()),
    "XML from a file": (
        "application/rdf+xml",
        b'<!DOCTYPE x [<!ENTITY a SYSTEM "file:///etc/passwd">]><x>&a;</x>',
    ),
    "remote @context": ("application/ld+json", b'{"@context": "http://127.0.0.1:1/", "a": 1}'),
    "deep JSON-LD": ("application/ld+json", b'{"@id": "urn:a", "urn:b": ' + b"[" * 100_000),
    "deep Turtle": ("text/turtle", b"<urn:a> <urn:b> " + b"[ <urn:b> " * 200_000),
    "deep lists": ("text/turtle", b"<urn:a> <urn:b> " + b"( " * 200_000),
    "a name of 1 MB": ("application/n-triples", b"<urn:" + b"a" * 10**6 + b"> <urn:b> 1 ."),
    "no text": ("text/turtle", b"\xff\xfe\x00<urn:a>"),
    "a zip bomb": ("text/turtle", gzip.compress(b" " * 50_000_000)),
}  # fmt: skip


@pytest.fixture(scope="module")
def served(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Served]:
    """A server in a process of its own, as ``symboslam serve`` is."""
    settings = {
        "SYMBOSLAM_WORKERS": WORKERS, "SYMBOSLAM_QUICK_WORKERS": QUICK,
        "SYMBOSLAM_WORKER_MEMORY": WORKER_MEMORY, "SYMBOSLAM_QUERY_SECONDS": 1,
        "SYMBOSLAM_BODY_SECONDS": 3,
        "SYMBOSLAM_BUNDLED_ONTOLOGY": "false", "SYMBOSLAM_ADMIN_TOKEN": TOKEN,
    }  # fmt: skip
    with serving(tmp_path_factory.mktemp("hostile"), settings) as found:
        ring = "".join(
            f"<urn:{i}> <urn:p> <urn:{(i + 1) % NODES}> ; <urn:q> <urn:{i * 7 % NODES}>, <urn:hub>"
            f" . <urn:hub> <urn:r> <urn:{i}> .\n"
            for i in range(NODES)
        )
        data = f"INSERT DATA {{ {ring} GRAPH <urn:simple> {{ <urn:a> <urn:b> 42 }} }}"
        with httpx.Client(base_url=found.url) as client:
            client.post("/sparql", content=data, headers=UPDATE).raise_for_status()
        yield found


class Victim:
    """A client without a token, at the same address, that asks something simple all the time."""

    def __init__(self, served: Served) -> None:
        self._served, self._stop = served, threading.Event()
        self.seconds: list[float] = []
        self.failures: list[str] = []
        self.most_memory = 0
        self._thread = threading.Thread(target=self._run)

    def __enter__(self) -> "Victim":
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._stop.set()
        self._thread.join()

    def _run(self) -> None:
        with httpx.Client(base_url=self._served.url, timeout=60) as client:
            while not self._stop.is_set():
                start = time.perf_counter()
                try:
                    response = client.get("/sparql", params={"query": SIMPLE})
                    if response.status_code != 200 or '"42"' not in response.text:
                        self.failures.append(response.text[:300])
                except httpx.HTTPError as error:
                    self.failures.append(repr(error))
                self.seconds.append(time.perf_counter() - start)
                self.most_memory = max(self.most_memory, self._served.memory())
                self._stop.wait(PAUSE)

    def check(self, bound: float | None = None) -> None:
        """What must hold for it, and for the server."""
        assert self.seconds, "it never asked"
        assert not self.failures, self.failures[:3]
        assert self._served.alive
        assert self.most_memory < MOST_MEMORY
        worst = max(self.seconds)
        print(  # noqa: T201
            f"{len(self.seconds)} simple queries, the slowest {worst:.3f} s;"
            f" at most {self.most_memory / 2**20:.0f} MiB"
        )
        if bound is not None:
            assert worst < bound


@contextmanager
def a_victim(served: Served) -> Iterator[Victim]:
    with Victim(served) as victim:
        while len(victim.seconds) < 3:  # it is at it
            time.sleep(0.01)
        yield victim


def ask(url: str, text: str | bytes, headers: dict[str, str]) -> int:
    with httpx.Client(base_url=url, timeout=60) as client:
        return client.post("/sparql", content=text, headers=headers).status_code


HEADERS = {"Content-Type": "application/sparql-query"}
REFUSED = (200, 204, 400, 403, 413, 422, 429, 503, 504)


def updates(served: Served) -> dict[str, int]:
    return {f"update: {name}": ask(served.url, text, UPDATE) for name, text in UPDATES.items()}


def one_by_one(served: Served) -> dict[str, int]:
    found = {name: ask(served.url, text, HEADERS) for name, text in QUERIES.items()}
    return found | updates(served)


def at_once(served: Served) -> dict[str, int]:
    with ThreadPoolExecutor(len(QUERIES)) as pool:
        asked = {
            name: pool.submit(ask, served.url, text, HEADERS) for name, text in QUERIES.items()
        }
        return {name: future.result() for name, future in asked.items()} | updates(served)


def test_there_are_twenty() -> None:
    assert len(QUERIES) >= 20


@pytest.mark.parametrize("how", [pytest.param(one_by_one, marks=pytest.mark.slow), at_once])
def test_queries(served: Served, how: Callable[[Served], dict[str, int]]) -> None:
    with a_victim(served) as victim:
        found = how(served)
    victim.check()
    assert set(found.values()) <= set(REFUSED), found
    assert 504 in found.values(), "nothing took long: these are not hostile"


@pytest.mark.slow
def test_no_query_slows_another_client_down(served: Served) -> None:
    for name, text in QUERIES.items():
        with a_victim(served) as victim:
            assert ask(served.url, text, HEADERS) in REFUSED, name
        victim.check(SLOWEST)


@pytest.mark.parametrize("name", UPLOADS)
def test_uploads(served: Served, name: str) -> None:
    kind, body = UPLOADS[name]
    headers = {**ADMIN, "Content-Type": kind}
    if name == "a zip bomb":
        headers["Content-Encoding"] = "gzip"
    with a_victim(served) as victim, httpx.Client(base_url=served.url, timeout=60) as client:
        response = client.put("/graphs", params={"graph": "urn:x"}, content=body, headers=headers)
        assert 201 <= response.status_code < 500, response.text
        client.delete("/graphs", params={"graph": "urn:x"}, headers=ADMIN)
    victim.check()


def test_a_deep_geojson_and_a_long_id(served: Served) -> None:
    with a_victim(served) as victim, httpx.Client(base_url=served.url, timeout=60) as client:
        area = {"name": "a", "bbox": [1, 1, 2, 2]}
        made = client.post("/v1/maps", json=area, headers=ADMIN).json()["id"]
        url = f"/v1/maps/{made}/observations"
        deep = b'{"type": "FeatureCollection", "features": [' + b"[" * 100_000
        far = b'{"coordinates": [1' + b"0" * 400 + b', 1], "class": "House"}'
        long = json.dumps({"id": "a" * 10**6, "coordinates": [1, 1], "class": "House"}).encode()
        for kind, body in (("geo+json", deep), ("x-ndjson", far), ("x-ndjson", long)):
            headers = {**ADMIN, "Content-Type": f"application/{kind}"}
            response = client.post(url, content=body, headers=headers)
            assert response.status_code == 422, response.text[:300]
        assert client.get(f"/v1/maps/{made}").json()["landmarks"] == 0
        assert client.get(f"/v1/maps/{'a' * 60_000}").status_code == 404
    victim.check()


def address(served: Served) -> tuple[str, int]:
    host, _, port = served.url.removeprefix("http://").partition(":")
    return host, int(port)


def test_headers(served: Served) -> None:
    many = "".join(f"X-{i}: {i}\r\n" for i in range(20_000))
    for head in (f"X: {'a' * 10**6}\r\n", many, "X: a\r\n b\r\n\0\r\n"):
        with a_victim(served) as victim, socket.create_connection(address(served)) as connection:
            try:
                connection.sendall(f"GET / HTTP/1.1\r\nHost: a\r\n{head}\r\n".encode())
                got = connection.recv(100)
            except ConnectionError:
                got = b""  # it hung up before all was sent
            assert got == b"" or got.startswith(b"HTTP/1.1 400")
        victim.check()


def test_thousands_of_connections(served: Served) -> None:
    connections = []
    with a_victim(served) as victim:
        for number in range(2000):
            connection = socket.create_connection(address(served))
            if number % 2:
                connection.sendall(b"POST /sparql HTTP/1.1\r\nHost: a\r\nContent-Le")
            connections.append(connection)
        for each in connections:
            each.close()
    victim.check()


def test_slow_bodies(served: Served) -> None:
    head = (
        "POST /sparql HTTP/1.1\r\nHost: a\r\nContent-Type: application/sparql-query\r\n"
        "Content-Length: 1000\r\n\r\nA"
    )
    with a_victim(served) as victim:
        connections = [socket.create_connection(address(served)) for _ in range(100)]
        for each in connections:
            each.sendall(head.encode())
        for each in connections:
            with closing(each):
                each.settimeout(60)
                assert each.recv(20).startswith(b"HTTP/1.1 408")
    victim.check()


def test_an_address_of_1_mb(served: Served) -> None:
    with a_victim(served) as victim, socket.create_connection(address(served)) as connection:
        try:
            connection.sendall(f"GET /v1/maps/{quote('a' * 10**6)} HTTP/1.1\r\n".encode())
            got = connection.recv(20)
        except ConnectionError:
            got = b""
        assert got == b"" or got.startswith(b"HTTP/1.1 400")
    victim.check()
