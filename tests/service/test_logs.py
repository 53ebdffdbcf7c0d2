"""The log: a line for each request, with its id, and without anything secret."""

import io
import json
import logging
import signal
import socket
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from symboslam.service.logs import JsonFormatter, TextFormatter
from tests.service.conftest import ADMIN, TOKEN, MakeService, Service
from tests.service.test_auth import bearer, make
from tests.service.test_durability import serve
from tests.service.test_protocol import problem

Lines = Callable[[], list[dict[str, Any]]]


@pytest.fixture
def lines() -> Iterator[Lines]:
    """What has been logged as JSON, in this process."""
    stream = io.StringIO()
    handler = logging.StreamHandler(stream)
    handler.setFormatter(JsonFormatter())
    logger = logging.getLogger("symboslam")
    level = logger.level
    logger.addHandler(handler)
    logger.setLevel(logging.INFO)
    yield lambda: [json.loads(line) for line in stream.getvalue().splitlines()]
    logger.removeHandler(handler)
    logger.setLevel(level)


def wait_for(lines: Lines, count: int) -> list[dict[str, Any]]:
    """A line is written after the response is sent."""
    while len(found := lines()) < count:
        pass
    return found


def test_a_line_for_each_request(make_service: MakeService, lines: Lines) -> None:
    service = make_service()
    graph = service.client.get("/graphs?default")
    made = make(service, "update")
    turtle = {**bearer(made["token"]), "Content-Type": "text/turtle"}
    service.client.put("/graphs/a%C3%A9?x=y", content="<urn:s> <urn:p> 1 .", headers=turtle)
    service.client.get("/nothing%0Aforged")
    service.client.request("TRACE", "/healthz")
    read, _, put, missing, traced = wait_for(lines, 5)
    assert read["route"] == read["path"] == "/graphs"
    assert (read["method"], read["status"]) == ("GET", 200)
    assert read["bytes"] == int(graph.headers["content-length"]) > 0
    assert read["client"] == "127.0.0.1"
    assert 0 < read["seconds"] < 60
    assert "token" not in read
    assert (put["path"], put["route"]) == ("/graphs/a%C3%A9", "/graphs/{path:path}")
    assert put["token"] == made["id"]
    assert (missing["status"], missing["route"]) == (404, "none")
    assert (traced["status"], traced["method"]) == (405, "TRACE")
    assert missing["path"] == "/nothing%0Aforged"
    assert missing["bytes"] > 0
    assert len({line["request_id"] for line in (read, put, missing)}) == 3


def test_neither_tokens_nor_queries_are_logged(make_service: MakeService, lines: Lines) -> None:
    service = make_service()
    secret = make(service, "query")["token"]
    headers = bearer(secret)
    service.client.get("/sparql", params={"query": "ASK { <urn:hidden> ?p ?o }"}, headers=headers)
    service.client.post("/sparql", data={"query": "ASK { <urn:hidden> ?p ?o"}, headers=ADMIN)
    service.client.get("/sparql?query=hidden&access_token=hidden", headers=bearer("wrong-hidden"))
    text = json.dumps(wait_for(lines, 4))
    assert "hidden" not in text
    assert secret.split("_", 2)[2] not in text
    assert TOKEN not in text


@pytest.mark.parametrize("sent", ["abc-123", "00-4bf92f3577b34da6a3ce929d0e0e4736-01", "a" * 128])
def test_a_request_id_is_taken_over(make_service: MakeService, lines: Lines, sent: str) -> None:
    service = make_service()
    response = service.client.get("/nothing", headers={"X-Request-ID": sent})
    assert response.headers["x-request-id"] == sent
    assert problem(response, 404, "not-found")["request_id"] == sent
    assert wait_for(lines, 1)[0]["request_id"] == sent


@pytest.mark.parametrize("sent", ["", "a b", "a" * 129, "<script>", '{"a":1}', "\xe9"])
def test_a_bad_request_id_is_not(service: Service, sent: str) -> None:
    raw = {b"X-Request-ID": sent.encode("latin-1")}
    response = service.client.get("/nothing", headers=raw)
    given = response.headers["x-request-id"]
    assert given != sent
    assert len(given) == 32
    assert problem(response, 404, "not-found")["request_id"] == given


def test_a_defect_is_logged_and_not_told(make_service: MakeService, lines: Lines) -> None:
    origin = "https://maps.example"
    service = make_service(cors_origins=origin)

    async def defect() -> None:
        raise ZeroDivisionError("a secret of ours")

    service.app.add_api_route("/defect", defect)
    response = service.client.get("/defect", headers={"Origin": origin})
    identifier = problem(response, 500, "internal-error")["request_id"]
    assert "secret" not in response.text
    assert response.headers["access-control-allow-origin"] == origin

    def ours() -> list[dict[str, Any]]:  # not those of servers that other tests have stopped
        return [line for line in lines() if line.get("request_id") == identifier]

    told, request = sorted(wait_for(ours, 2), key=lambda line: str(line["level"]))
    assert told["level"] == "error"
    assert "ZeroDivisionError: a secret of ours" in told["traceback"]
    assert told["request_id"] == request["request_id"] == identifier
    assert request["status"] == 500


def test_a_client_that_leaves_is_no_defect(make_service: MakeService, lines: Lines) -> None:
    service = make_service()
    port = service.client.base_url.port or 0
    with socket.create_connection(("127.0.0.1", port)) as connection:
        head = b"POST /sparql HTTP/1.1\r\nHost: x\r\nContent-Type: application/sparql-query\r\n"
        connection.sendall(head + b"Content-Length: 9\r\n\r\nASK")
    (line,) = wait_for(lines, 1)
    assert (line["status"], line["message"]) == (499, "request")


def record(**fields: object) -> logging.LogRecord:
    made = logging.LogRecord("a.b", logging.WARNING, "", 0, "said %s", ("so",), None)
    made.created = 0.25
    made.fields = fields
    return made


def test_the_forms_of_a_line() -> None:
    assert json.loads(JsonFormatter().format(record(status=200, token=None, path='a"\n'))) == {
        "time": "1970-01-01T00:00:00.250Z", "level": "warning", "logger": "a.b",
        "message": "said so", "status": 200, "path": 'a"\n',
    }  # fmt: skip
    assert "\n" not in JsonFormatter().format(record(path="\n"))
    text = TextFormatter().format(record(status=200, token=None))
    assert text == "1970-01-01T00:00:00.250Z warning said so status=200"


@pytest.mark.parametrize("form", ["", "json", "text", "none"])
def test_the_log_of_a_server(tmp_path: Path, form: str) -> None:
    with serve(tmp_path, log=form) as (process, client):
        client.get("/healthz", headers={"X-Request-ID": "mine"})
        # uvicorn's own: what is not HTTP.
        with socket.create_connection((client.base_url.host, client.base_url.port or 0)) as raw:
            raw.sendall(b"nonsense\r\n\r\n")
            assert raw.recv(1000).startswith(b"HTTP/1.1 400")
        process.send_signal(signal.SIGTERM)
        out, err = process.communicate(timeout=60)
    assert (process.returncode, out.strip()) == (0, "stopped")
    found = err.splitlines()
    if form == "none":
        assert found == []
    elif form == "text":
        assert "request method=GET path=/healthz" in found[0]
        assert "request_id=mine" in found[0]
        assert "Invalid HTTP request" in found[1]
    else:  # standard error is no terminal
        request, uvicorn = map(json.loads, found)
        assert request["request_id"] == "mine"
        assert (uvicorn["logger"], uvicorn["level"]) == ("uvicorn.error", "warning")
