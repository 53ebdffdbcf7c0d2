"""Whole graphs over HTTP beyond W3C's tests: formats, bad input, traps."""

import pytest
from pyoxigraph import RdfFormat, parse

from tests.service.conftest import ADMIN, MakeService, Service
from tests.service.test_protocol import problem

G = {"graph": "http://example.org/g"}
TURTLE = {**ADMIN, "Content-Type": "text/turtle"}
RDF_XML = {**ADMIN, "Content-Type": "application/rdf+xml"}
TRIPLE = "<http://example.org/s> <http://example.org/p> 'größer' ."
XML = (
    '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-syntax-ns#" xmlns="http://example.org/">'
    '<rdf:Description rdf:about="http://example.org/s"><p>{}</p></rdf:Description></rdf:RDF>'
)
DOCUMENTS = {
    "text/turtle": TRIPLE,
    "application/n-triples": TRIPLE.replace("'", '"'),
    "application/rdf+xml": XML.format("größer"),
    "application/ld+json": '{"@id": "http://example.org/s", "http://example.org/p": "größer"}',
}


@pytest.mark.parametrize("kind", DOCUMENTS)
def test_formats_in(service: Service, kind: str) -> None:
    data = DOCUMENTS[kind].encode()
    headers = {**ADMIN, "Content-Type": kind}
    put = service.client.put("/graphs", params=G, content=data, headers=headers)
    assert put.status_code == 201
    assert service.values("SELECT ?g ?s ?p ?o { GRAPH ?g { ?s ?p ?o } }") == [
        ["http://example.org/g", "http://example.org/s", "http://example.org/p", "größer"]
    ]
    again = service.client.put("/graphs", params=G, content=data, headers=headers)
    assert again.status_code == 204


@pytest.mark.parametrize(
    "kind",
    [
        "text/turtle", "application/n-triples", "application/rdf+xml", "application/ld+json",
        "application/n-quads", "application/trig",
    ],
)  # fmt: skip
def test_formats_out(service: Service, kind: str) -> None:
    service.client.put("/graphs", params=G, content=TRIPLE, headers=TURTLE)
    response = service.client.get("/graphs", params=G, headers={"Accept": kind})
    assert response.headers["content-type"].partition(";")[0] == kind
    rdf_format = RdfFormat.from_media_type(kind)
    assert rdf_format is not None
    (quad,) = parse(response.content, rdf_format)
    assert quad.object.value == "größer"


def test_replacing_leaves_nothing(service: Service) -> None:
    service.client.put("/graphs", params=G, content=f"{TRIPLE} <urn:a> <urn:b> _:c .",
                       headers=TURTLE)  # fmt: skip
    service.client.put("/graphs", params=G, content="<urn:x> <urn:y> 'a\\n\"', _:c .",
                       headers=TURTLE)  # fmt: skip
    rows = service.values("SELECT ?s { GRAPH <http://example.org/g> { ?s ?p ?o } }")
    assert rows == [["urn:x"], ["urn:x"]]
    service.client.put("/graphs", params=G, content="", headers=TURTLE)
    assert service.client.get("/graphs", params=G).status_code == 200
    assert service.values("SELECT ?s { GRAPH <http://example.org/g> { ?s ?p ?o } }") == []


def test_blank_nodes_of_two_documents_are_two(service: Service) -> None:
    for _ in range(2):
        service.client.post("/graphs", params=G, content="_:a <urn:p> 1 .", headers=TURTLE)
    assert len(service.values("SELECT DISTINCT ?s { GRAPH ?g { ?s ?p ?o } }")) == 2


def test_relative_iris_are_resolved_against_the_graph(service: Service) -> None:
    service.client.put("/graphs", params=G, content="<x> <p> <> .", headers=TURTLE)
    rows = service.values("SELECT ?s ?o { GRAPH ?g { ?s ?p ?o } }")
    assert rows == [["http://example.org/x", "http://example.org/g"]]


def test_a_new_graph_gets_a_name(service: Service) -> None:
    response = service.client.post("/graphs", content=TRIPLE, headers=TURTLE)
    assert response.status_code == 201
    assert response.headers["location"].startswith(f"{service.url}/graphs/")
    assert "größer" in service.client.get(response.headers["location"]).text


def test_etag_and_head(service: Service) -> None:
    service.client.put("/graphs", params=G, content=TRIPLE, headers=TURTLE)
    tag = service.client.head("/graphs", params=G).headers["etag"]
    headers = {"If-None-Match": tag}
    assert service.client.get("/graphs", params=G, headers=headers).status_code == 304
    service.client.delete("/graphs", params=G, headers=ADMIN)
    assert service.client.get("/graphs", params=G, headers=headers).status_code == 404


@pytest.mark.parametrize(
    ("address", "name"),
    [
        ("/graphs", "no-graph-named"),
        ("/graphs?graph=relative", "not-an-iri"),
        ("/graphs?graph=", "not-an-iri"),
        ("/graphs?graph=urn:a&graph=urn:b", "repeated-parameter"),
        ("/graphs?graph=urn:a&default", "graph-named-twice"),
        ("/graphs/x?graph=urn:a", "graph-named-twice"),
        ("/graphs?default=urn:a", "wrong-parameter"),
    ],
)
def test_names_of_graphs(service: Service, address: str, name: str) -> None:
    problem(service.client.get(address), 400, name)


def test_other_methods(service: Service) -> None:
    for path in ("/graphs", "/graphs/x"):
        response = service.client.patch(path)
        problem(response, 405, "method-not-allowed")
        assert response.headers["allow"] == "GET, HEAD, POST, PUT, DELETE"


def test_not_acceptable(service: Service) -> None:
    response = service.client.get("/graphs?default", headers={"Accept": "text/csv"})
    problem(response, 406, "not-acceptable")


@pytest.mark.parametrize(
    "kind",
    ["text/plain", "application/n-quads", "application/trig", "text/turtle; charset=latin-1"],
)
def test_media_types_that_are_refused(service: Service, kind: str) -> None:
    headers = {**ADMIN, "Content-Type": kind}
    response = service.client.put("/graphs?default", content=TRIPLE, headers=headers)
    assert response.status_code == 415


ENTITIES = '<?xml version="1.0"?><!DOCTYPE x [{}]>'
BAD = {
    "not Turtle": ("text/turtle", b"<urn:a> <urn:b>\n 1 ,, ."),
    "not UTF-8": ("text/turtle", b"<urn:a> <urn:b>\n '\xff' ."),
    "not N-Triples": ("application/n-triples", b"<urn:a> <urn:b> 1 ."),
    "not JSON": ("application/ld+json", b"{"),
    "remote context": ("application/ld+json", b'{"@context": "http://127.0.0.1:9/", "a": 1}'),
    "named graph": (
        "application/ld+json", b'{"@id": "urn:g", "@graph": [{"@id": "urn:a", "urn:b": 1}]}',
    ),
    "not XML": ("application/rdf+xml", b"<rdf:RDF"),
    "entity": (
        "application/rdf+xml",
        (ENTITIES.format('<!ENTITY a "b">') + XML.format("&a;")).encode(),
    ),
    "file": (
        "application/rdf+xml",
        (ENTITIES.format('<!ENTITY a SYSTEM "file:///etc/passwd">') + XML.format("&a;")).encode(),
    ),
    "parameter entity": (
        "application/rdf+xml",
        (ENTITIES.format('<!ENTITY % a SYSTEM "http://127.0.0.1:9/"> %a;') + XML).encode(),
    ),
    "external DTD": (
        "application/rdf+xml",
        ('<!DOCTYPE x SYSTEM "http://127.0.0.1:9/">' + XML.format(1)).encode(),
    ),
    "billion laughs": (
        "application/rdf+xml",
        (
            ENTITIES.format(
                '<!ENTITY a0 "ha">'
                + "".join(f'<!ENTITY a{i} "{f"&a{i - 1};" * 10}">' for i in range(1, 12))
            )
            + XML.format("&a11;")
        ).encode(),
    ),
    "another encoding": (
        "application/rdf+xml",
        ('<?xml version="1.0" encoding="ISO-8859-1"?>' + XML.format(1)).encode(),
    ),
    "UTF-16": ("application/rdf+xml", XML.format(1).encode("utf-16")),
}  # fmt: skip


@pytest.mark.parametrize("method", ["PUT", "POST"])
@pytest.mark.parametrize("name", BAD)
def test_bad_graphs_leave_no_trace(service: Service, method: str, name: str) -> None:
    service.client.put("/graphs", params=G, content=TRIPLE, headers=TURTLE)
    kind, data = BAD[name]
    headers = {**ADMIN, "Content-Type": kind}
    response = service.client.request(method, "/graphs", params=G, content=data, headers=headers)
    members = problem(response, 400, "malformed-graph")
    assert "root:" not in response.text
    if name in ("not Turtle", "not UTF-8"):
        assert members["line"] == 2
    assert len(service.values("SELECT * { GRAPH ?g { ?s ?p ?o } }")) == 1


def test_multipart_is_all_or_nothing(service: Service) -> None:
    parts = {"a": ("a.ttl", TRIPLE, "text/turtle"), "b": ("b.ttl", "<urn:a> .", "text/turtle")}
    response = service.client.post("/graphs", params=G, files=parts, headers=ADMIN)
    problem(response, 400, "malformed-graph")
    assert service.values("SELECT * { GRAPH ?g { ?s ?p ?o } }") == []
    other = {"a": ("a.txt", TRIPLE, "text/plain")}
    response = service.client.post("/graphs", params=G, files=other, headers=ADMIN)
    problem(response, 415, "unsupported-media-type")
    broken = {**ADMIN, "Content-Type": "multipart/form-data; boundary=x"}
    response = service.client.post("/graphs", params=G, content="no parts", headers=broken)
    problem(response, 400, "malformed-multipart")
    put = service.client.put("/graphs", params=G, files=parts, headers=ADMIN)
    problem(put, 415, "unsupported-media-type")


def test_the_default_graph_is_never_the_union(make_service: MakeService) -> None:
    service = make_service()
    service.client.put("/graphs", params=G, content=TRIPLE, headers=TURTLE)
    assert not service.client.get("/graphs?default").text.count("größer")
    assert service.client.delete("/graphs?default", headers=ADMIN).status_code == 204
    assert service.client.get("/graphs", params=G).text.count("größer") == 1


def test_a_large_graph(make_service: MakeService) -> None:
    service = make_service(worker_memory=0)
    lines = "".join(f"<urn:s{i}> <urn:p> {i} .\n" for i in range(20_000))
    response = service.client.put("/graphs", params=G, content=lines, headers=TURTLE)
    assert response.status_code == 201
    got = service.client.get("/graphs", params=G, headers={"Accept": "application/n-triples"})
    assert got.text.count("\n") == 20_000
    assert not list(service.app.state.settings.data.glob("spool/*"))
