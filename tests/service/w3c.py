"""Read W3C's manifests of tests over HTTP, and replay one test."""

import os
from dataclasses import dataclass, field
from pathlib import Path

import httpx
import pytest
from rdflib import RDF, Graph, Namespace, URIRef
from rdflib.collection import Collection
from rdflib.compare import isomorphic
from rdflib.term import Node

SHARED = Path(os.environ.get("SYMBOSLAM_SHARED", Path(__file__).parents[3] / "shared"))
SUITES = SHARED / "data" / "w3c"
MF = Namespace("http://www.w3.org/2001/sw/DataAccess/tests/test-manifest#")
HT = Namespace("http://www.w3.org/2011/http#")
CNT = Namespace("http://www.w3.org/2011/content#")
UT = Namespace("http://www.w3.org/2009/sparql/tests/test-update#")
LABEL = URIRef("http://www.w3.org/2000/01/rdf-schema#label")

STATUS = {"OK": 200, "Created": 201, "NoContent": 204, "NotFound": 404}
FORMATS = {
    "boolean": {"application/sparql-results+json", "application/sparql-results+xml"},
    "tabular": {
        "application/sparql-results+json", "application/sparql-results+xml", "text/csv",
        "text/tab-separated-values",
    },
    "RDF": {"text/turtle", "application/rdf+xml", "application/n-triples"},
}  # fmt: skip


@dataclass
class Exchange:
    """A request of a test, and what is expected of its response."""

    method: str
    path: str
    headers: dict[str, str]
    body: bytes
    statuses: list[str]
    boolean: bool | None
    format: str | None
    location: str | None
    response_headers: dict[str, str]
    response_body: str | None


@dataclass
class Case:
    """A test: graphs that it needs, and exchanges in their order."""

    name: str
    graphs: dict[str, Path] = field(default_factory=dict)
    exchanges: list[Exchange] = field(default_factory=list)


def text(graph: Graph, node: Node | None, predicate: URIRef) -> str | None:
    value = graph.value(node, predicate) if node is not None else None
    return None if value is None else str(value)


def headers(graph: Graph, message: Node) -> dict[str, str]:
    head = graph.value(message, HT.headers)
    if head is None:
        return {}
    return {
        str(graph.value(item, HT.fieldName)): str(graph.value(item, HT.fieldValue))
        for item in Collection(graph, head)
    }


def exchange(graph: Graph, request: Node) -> Exchange:
    response = graph.value(request, HT.resp)
    assert response is not None
    body = graph.value(request, HT.body)
    encoding = text(graph, body, CNT.characterEncoding) or "UTF-8"
    boolean = graph.value(response, MF.expectedBoolean)
    return Exchange(
        method=str(graph.value(request, HT.methodName)),
        path=str(graph.value(request, HT.absolutePath)),
        headers=headers(graph, request),
        body=(text(graph, body, CNT.chars) or "").encode(encoding),
        statuses=[str(s).rpartition("#")[2] for s in graph.objects(response, MF.expectedStatus)],
        boolean=None if boolean is None else bool(boolean.toPython()),  # type: ignore[attr-defined]
        format=text(graph, response, MF.expectedFormat),
        location=text(graph, response, MF.expectedLocation),
        response_headers=headers(graph, response),
        response_body=text(graph, graph.value(response, HT.body), CNT.chars),
    )


def cases(suite: str, *names: str) -> list[Case]:
    """All tests that some manifests of a suite define, listed in them or not."""
    found = []
    for name in names:
        file = SUITES / suite / name
        if not file.is_file():
            return []
        graph = Graph().parse(file)
        kinds = (MF.ProtocolTest, MF.GraphStoreProtocolTest)
        for test in sorted((s for kind in kinds for s in graph.subjects(RDF.type, kind)), key=str):
            case = Case(str(test).rpartition("#")[2])
            for data in graph.objects(test, UT.graphData):
                path = str(graph.value(data, UT.graph)).rpartition("/")[2]
                case.graphs[str(graph.value(data, LABEL))] = file.parent / path
            action = graph.value(test, MF.action)
            requests = graph.value(action, HT.requests)
            assert requests is not None
            case.exchanges = [exchange(graph, r) for r in Collection(graph, requests)]
            assert case.exchanges
            found.append(case)
    return found


def require(suite: list[Case], count: int) -> None:
    """Skip where the manifests are not there; fail where they are not what they were."""
    if not suite:
        pytest.skip(f"the tests of W3C are not there: {SUITES}")
    assert len(suite) == count


def replay(case: Case, client: httpx.Client, old: str, new: str) -> None:
    """Send the requests of a test and compare the responses.

    Args:
        case: the test.
        client: sends them, with a token.
        old: beginning of the paths in the manifest.
        new: what stands in its place at our server.
    """
    variables: dict[str, str] = {}
    for step in case.exchanges:
        assert step.path.startswith(old)
        path, body = step.path.replace(old, new, 1), step.body
        for name, value in variables.items():
            path, body = path.replace(name, value), body.replace(name.encode(), value.encode())
        response = client.request(step.method, path, headers=step.headers, content=body)
        assert fits(response.status_code, step.statuses), (step, response.text)
        kind = response.headers.get("content-type", "").partition(";")[0]
        if step.format is not None:
            assert kind in FORMATS[step.format]
        if step.boolean is not None:
            assert response.json()["boolean"] is step.boolean
        if step.location is not None:
            variables[step.location] = response.headers["location"]
        for name, value in step.response_headers.items():
            assert response.headers[name] == value
        if step.response_body is not None:
            expected = Graph().parse(data=step.response_body, format=kind)
            assert isomorphic(Graph().parse(data=response.text, format=kind), expected)
        if step.method == "HEAD":
            assert not response.content


def fits(status: int, expected: list[str]) -> bool:
    """Whether a status is one of those, or of one of those classes."""
    return any(
        status == STATUS.get(name) or name == f"StatusCode{status // 100}xx" for name in expected
    )
