"""Queries and updates over HTTP beyond W3C's tests: formats, errors, caches, authorisation."""

import gzip
import json

import httpx
import pytest
from pyoxigraph import RdfFormat, parse

from tests.service.conftest import ADMIN, QUERY, UPDATE, MakeService, Service

DATA = (
    "INSERT DATA { <http://example.org/s> <http://example.org/p> 'größer', 2 ."
    " GRAPH <http://example.org/g> { <http://example.org/s> <http://example.org/p> 3 } }"
)
SELECT = "SELECT ?o { <http://example.org/s> ?p ?o } ORDER BY ?o"
CONSTRUCT = "CONSTRUCT WHERE { ?s ?p ?o }"


def problem(response: httpx.Response, status: int, name: str) -> dict[str, object]:
    """The members of a problem, checked."""
    assert response.status_code == status, response.text
    assert response.headers["content-type"] == "application/problem+json"
    members: dict[str, object] = response.json()
    assert members["status"] == status
    assert members["type"] == f"https://w3id.org/symboslam/problems#{name}"
    assert members["title"]
    assert members["detail"]
    assert "Traceback" not in response.text
    return members


@pytest.mark.parametrize(
    ("accept", "content_type"),
    [
        ("application/sparql-results+json", "application/sparql-results+json"),
        ("application/sparql-results+xml", "application/sparql-results+xml"),
        ("application/json", "application/json"),
        ("application/xml", "application/xml"),
        ("text/csv", "text/csv; charset=utf-8"),
        ("text/tab-separated-values", "text/tab-separated-values; charset=utf-8"),
        ("*/*", "application/sparql-results+json"),
        ("text/html, text/csv;q=0.5", "text/csv; charset=utf-8"),
    ],
)
def test_formats_of_tables(service: Service, accept: str, content_type: str) -> None:
    service.update(DATA)
    response = service.client.get("/sparql", params={"query": SELECT}, headers={"Accept": accept})
    assert response.status_code == 200
    assert response.headers["content-type"] == content_type
    assert "größer" in response.content.decode()
    asked = service.client.get("/sparql", params={"query": "ASK {}"}, headers={"Accept": accept})
    assert asked.headers["content-type"] == content_type
    assert "true" in asked.text


@pytest.mark.parametrize(
    ("accept", "content_type"),
    [
        ("text/turtle", "text/turtle; charset=utf-8"),
        ("application/n-triples", "application/n-triples"),
        ("application/rdf+xml", "application/rdf+xml"),
        ("application/ld+json", "application/ld+json"),
        ("application/n-quads", "application/n-quads"),
        ("application/trig", "application/trig"),
        ("application/json", "application/json"),
        ("application/xml", "application/xml"),
        ("*/*", "text/turtle; charset=utf-8"),
    ],
)
def test_formats_of_graphs(service: Service, accept: str, content_type: str) -> None:
    service.update(DATA)
    for query in (CONSTRUCT, "DESCRIBE <http://example.org/s>"):
        response = service.client.get(
            "/sparql", params={"query": query}, headers={"Accept": accept}
        )
        assert response.status_code == 200
        assert response.headers["content-type"] == content_type
        rdf_format = RdfFormat.from_media_type(accept) if accept != "*/*" else RdfFormat.TURTLE
        assert rdf_format is not None
        assert len(list(parse(response.content, rdf_format))) == 2


@pytest.mark.parametrize(
    ("query", "accept"),
    [(SELECT, "text/turtle"), ("ASK {}", "text/html"), (CONSTRUCT, "text/csv"), ("ASK {}", "x")],
)
def test_not_acceptable(service: Service, query: str, accept: str) -> None:
    response = service.client.get("/sparql", params={"query": query}, headers={"Accept": accept})
    problem(response, 406, "not-acceptable")


def test_malformed_queries_have_line_and_column(service: Service) -> None:
    members = problem(service.ask("SELECT * {\n  ?s ?p }"), 400, "malformed-query")
    assert (members["line"], members["column"]) == (2, 10)
    members = problem(service.update("CLEAR ALL ;\nCLEAR XYZ"), 400, "malformed-query")
    assert members["line"] == 2
    members = problem(service.ask("ASK { x:y a ?z }"), 400, "malformed-query")
    assert "the prefix x: is not declared" in str(members["detail"])


@pytest.mark.parametrize("name", ["query", "default", "default-graph-uri"])
def test_undefined_bytes(service: Service, name: str) -> None:
    problem(service.client.get(f"/sparql?query=ASK+%7B%7D&{name}=%FF"), 400, "not-utf-8")


def test_repeated_parameters(service: Service) -> None:
    response = service.client.get("/sparql?query=ASK+%7B%7D&query=ASK+%7B%7D")
    assert problem(response, 400, "repeated-parameter")["parameter"] == "query"
    response = service.client.post("/sparql?query=ASK+%7B%7D", content="ASK {}", headers=QUERY)
    problem(response, 400, "repeated-parameter")
    response = service.client.post("/sparql?query=ASK+%7B%7D", data={"query": "ASK {}"})
    problem(response, 400, "repeated-parameter")
    response = service.client.post("/sparql", data={"query": "ASK {}", "update": "CLEAR ALL"})
    problem(response, 400, "query-and-update")
    problem(service.client.post("/sparql", data={"x": "y"}), 400, "nothing-asked")
    problem(service.client.post("/sparql?query=ASK+%7B%7D", data={"x": "y"}), 400, "nothing-asked")
    problem(service.client.get("/sparql?update=CLEAR+ALL"), 400, "update-by-get")


def test_parameters_of_the_other_operation(service: Service) -> None:
    problem(service.ask("ASK {}", **{"using-graph-uri": "urn:g"}), 400, "wrong-parameter")
    response = service.client.post(
        "/sparql?default-graph-uri=urn:g", content="CLEAR ALL", headers=UPDATE
    )
    problem(response, 400, "wrong-parameter")


@pytest.mark.parametrize("iri", ["relative", "", "http://example.org/a b", "urn:<>"])
def test_graphs_are_absolute_iris(service: Service, iri: str) -> None:
    problem(service.ask("ASK {}", **{"default-graph-uri": iri}), 400, "not-an-iri")


@pytest.mark.parametrize("method", ["PUT", "DELETE", "PATCH"])
def test_other_methods(service: Service, method: str) -> None:
    for path in ("/sparql", "/sparql/"):
        response = service.client.request(method, path)
        problem(response, 405, "method-not-allowed")
        assert response.headers["allow"] == "GET, HEAD, POST"


def test_other_paths(service: Service) -> None:
    problem(service.client.get("/nothing"), 404, "not-found")


@pytest.mark.parametrize(
    "content_type", [None, "text/plain", "application/json", "multipart/form-data", ";;;"]
)
def test_other_media_types(service: Service, content_type: str | None) -> None:
    headers = {"Content-Type": content_type} if content_type else {}
    response = service.client.post("/sparql", content="ASK {}", headers=headers)
    problem(response, 415, "unsupported-media-type")
    assert "application/sparql-query" in response.headers["accept-post"]


def test_other_encodings(service: Service) -> None:
    kind = "application/sparql-query"
    latin = {"Content-Type": f"{kind}; charset=latin-1"}
    problem(service.client.post("/sparql", content="ASK {}", headers=latin), 415, "not-utf-8")
    problem(
        service.client.post("/sparql", content=b"ASK {} #\xff", headers=QUERY), 400, "not-utf-8"
    )
    utf8 = {"Content-Type": f'{kind}; charset="UTF-8"'}
    assert service.client.post("/sparql", content="ASK {}", headers=utf8).status_code == 200
    packed = {**QUERY, "Content-Encoding": "gzip"}
    response = service.client.post("/sparql", content=gzip.compress(b"ASK {}"), headers=packed)
    problem(response, 415, "content-encoding")


def test_sizes(service: Service) -> None:
    long = "ASK {} #" + "x" * 10_000
    problem(service.ask(long), 413, "query-too-large")
    problem(service.client.post("/sparql", data={"query": long}), 413, "query-too-large")
    problem(service.client.post("/sparql", content=long, headers=QUERY), 413, "body-too-large")
    problem(service.update("#" + "x" * 100_000), 413, "body-too-large")
    pieces = (b"x" * 10_000 for _ in range(11))  # a length that nobody says before
    response = service.client.post("/sparql", content=pieces, headers=UPDATE)
    problem(response, 413, "body-too-large")


@pytest.mark.parametrize(
    ("headers", "status", "name"),
    [
        ({}, 401, "token-missing"),
        ({"Authorization": "Basic YTpi"}, 401, "token-missing"),
        ({"Authorization": "Bearer"}, 401, "token-missing"),
        ({"Authorization": "Bearer wrong"}, 401, "token-invalid"),
        ({"Authorization": "Bearer \xe9"}, 401, "token-invalid"),
    ],
)
def test_writing_needs_the_token(
    service: Service, headers: dict[str, str], status: int, name: str
) -> None:
    raw = {k.encode(): v.encode("latin-1") for k, v in headers.items()}
    kind = {b"Content-Type": b"application/sparql-update"}
    direct = service.client.post("/sparql", content=DATA, headers={**raw, **kind})
    problem(direct, status, name)
    assert direct.headers["www-authenticate"].startswith("Bearer")
    problem(service.client.post("/sparql", data={"update": DATA}, headers=raw), status, name)
    turtle = {**raw, b"Content-Type": b"text/turtle"}
    for method in ("PUT", "POST", "DELETE"):
        response = service.client.request(method, "/graphs?default", content="", headers=turtle)
        problem(response, status, name)
    assert service.values(SELECT) == []


def test_nobody_writes_without_a_token_in_the_settings(with_ontology: Service) -> None:
    problem(with_ontology.update("CLEAR ALL"), 403, "read-only")
    response = with_ontology.client.delete("/graphs?default", headers=ADMIN)
    problem(response, 403, "read-only")


def test_an_update_is_seen_by_the_next_query(service: Service) -> None:
    for number in range(20):
        response = service.update(f"INSERT DATA {{ <urn:s> <urn:p> {number} }}")
        assert response.status_code == 204
        (row,) = service.values("SELECT (COUNT(*) AS ?n) { <urn:s> <urn:p> ?o }")
        assert row == [str(number + 1)]


def test_an_update_is_all_or_nothing(service: Service) -> None:
    response = service.update("INSERT DATA { <urn:s> <urn:p> 1 } ; DROP GRAPH <urn:missing>")
    problem(response, 400, "malformed-query")
    assert not service.ask("ASK { <urn:s> ?p ?o }").json()["boolean"]


@pytest.mark.parametrize("keyword", ["LOAD", "load silent", "CLEAR ALL; LOAD"])
@pytest.mark.parametrize("address", ["file:///etc/passwd", "http://127.0.0.1:9/"])
def test_load_is_refused(service: Service, keyword: str, address: str) -> None:
    service.update(DATA)
    problem(service.update(f"{keyword} <{address}>"), 403, "load-refused")
    assert service.values(SELECT)


def test_files_are_not_loaded_even_if_load_is_allowed(make_service: MakeService) -> None:
    service = make_service(allow_load=True)
    response = service.update("LOAD <file:///etc/hostname> INTO GRAPH <urn:g>")
    assert response.status_code >= 400
    assert service.values("SELECT * { GRAPH <urn:g> { ?s ?p ?o } }") == []


def test_service_is_refused(service: Service) -> None:
    problem(service.ask("ASK { SERVICE <http://127.0.0.1:9/> {} }"), 403, "service-refused")
    update = "INSERT { ?s ?p ?o } WHERE { SERVICE <http://127.0.0.1:9/> { ?s ?p ?o } }"
    problem(service.update(update), 403, "service-refused")


def test_union_default_graph_is_a_setting(make_service: MakeService, service: Service) -> None:
    service.update(DATA)
    assert len(service.values(SELECT)) == 2
    union = make_service()
    union.update(DATA)
    assert len(union.values(SELECT)) == 3
    only = "SELECT ?o FROM <http://example.org/g> { ?s ?p ?o }"
    assert union.values(only) == service.values(only) == [["3"]]
    named = "SELECT ?o FROM NAMED <http://example.org/g> { ?s ?p ?o }"
    assert union.values(named) == service.values(named) == []
    response = union.ask("SELECT ?o { ?s ?p ?o }", **{"default-graph-uri": "http://example.org/g"})
    assert len(response.json()["results"]["bindings"]) == 1


def test_etag(service: Service) -> None:
    service.update(DATA)
    first = service.ask(SELECT)
    again = service.client.get(
        "/sparql", params={"query": SELECT}, headers={"If-None-Match": first.headers["etag"]}
    )
    assert (again.status_code, again.content) == (304, b"")
    assert again.headers["etag"] == first.headers["etag"]
    other = service.client.get(
        "/sparql", params={"query": SELECT},
        headers={"If-None-Match": first.headers["etag"], "Accept": "text/csv"},
    )  # fmt: skip
    assert other.status_code == 200
    service.update("INSERT DATA { <urn:s> <urn:p> 1 }")
    changed = service.client.get(
        "/sparql", params={"query": SELECT}, headers={"If-None-Match": first.headers["etag"]}
    )
    assert changed.status_code == 200
    assert "etag" not in service.ask("SELECT (RAND() AS ?x) {}").headers


def test_head(service: Service) -> None:
    service.update(DATA)
    got = service.ask(SELECT)
    head = service.client.head("/sparql", params={"query": SELECT})
    assert head.status_code == 200
    assert head.content == b""
    for name in ("content-type", "content-length", "etag"):
        assert head.headers[name] == got.headers[name]
    assert service.client.head("/sparql", params={"query": "ASK {"}).status_code == 400


@pytest.mark.parametrize("rows", [1, 30_000])
def test_gzip(service: Service, rows: int) -> None:
    service.update(f"INSERT DATA {{ <urn:s> <urn:p> {', '.join(map(str, range(200)))} }}")
    query = f"SELECT ?a ?b {{ ?s ?p ?a . ?t ?q ?b }} ORDER BY ?a ?b LIMIT {rows}"
    plain = service.client.get(
        "/sparql", params={"query": query}, headers={"Accept-Encoding": "identity"}
    )
    assert "content-encoding" not in plain.headers
    packed = service.client.get(
        "/sparql", params={"query": query}, headers={"Accept-Encoding": "gzip"}
    )
    assert packed.headers["content-encoding"] == "gzip"
    assert packed.json() == plain.json()
    assert len(packed.json()["results"]["bindings"]) == rows
    assert int(plain.headers["content-length"]) == len(plain.content)


def test_cors(service: Service, with_ontology: Service) -> None:
    origin = {"Origin": "https://maps.example"}
    response = service.client.get("/sparql", params={"query": "ASK {}"}, headers=origin)
    assert response.headers["access-control-allow-origin"] == "https://maps.example"
    asked = service.client.options(
        "/sparql",
        headers={
            **origin, "Access-Control-Request-Method": "POST",
            "Access-Control-Request-Headers": "authorization",
        },
    )  # fmt: skip
    assert asked.status_code == 200
    for other in (
        service.client.get("/healthz", headers={"Origin": "https://evil.example"}),
        with_ontology.client.get("/healthz", headers=origin),
    ):
        assert "access-control-allow-origin" not in other.headers


def test_base_iri_is_the_public_address(make_service: MakeService) -> None:
    service = make_service(public_url="https://maps.example/robots/")
    assert service.values("SELECT (STR(<x>) AS ?x) {}") == [["https://maps.example/robots/x"]]


def test_a_host_that_is_none(service: Service) -> None:
    response = service.client.get("/sparql?query=ASK+%7B%7D", headers={"Host": "a b<>"})
    assert response.status_code < 500


def test_health(service: Service) -> None:
    assert service.client.get("/healthz").json() == {"status": "alive"}
    assert service.client.get("/readyz").json() == {"status": "ready"}
    assert "sparql" in service.client.get("/").text


def test_openapi(service: Service) -> None:
    paths = json.loads(service.client.get("/openapi.json").text)["paths"]
    assert {"/sparql", "/graphs", "/healthz", "/readyz"} <= set(paths)
    assert set(paths["/graphs"]) == {"get", "put", "post", "delete"}
