"""``symboslam query`` and ``push`` against a small service of the test's own."""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from dataclasses import dataclass, field
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import pytest

from symboslam.cli.client import Client, _seconds
from symboslam.engine.readers import read_landmarks
from symboslam.errors import InputError, ServiceError
from symboslam.reasoning.knowledge import Knowledge
from symboslam.service.examples import get_example

JSON_ANSWER = {
    "head": {"vars": ["what", "share"]},
    "results": {"bindings": [
        {
            "what": {"type": "uri", "value": "https://w3id.org/symboslam#House"},
            "share": {
                "type": "literal", "value": "0.5",
                "datatype": "http://www.w3.org/2001/XMLSchema#decimal",
            },
        },
        {"what": {"type": "literal", "value": "\x1b[31mred"}},
    ]},
}  # fmt: skip


@dataclass
class Fake:
    """A service that notes what it is sent.

    Attributes:
        url: its address.
        requests: path, headers and body of each request.
        answers: status, headers and body to give next, before the usual ones.
        batches: idempotency key -> the landmarks that came with it.
    """

    url: str = ""
    requests: list[tuple[str, dict[str, str], bytes]] = field(default_factory=list)
    answers: list[tuple[int, dict[str, str], bytes]] = field(default_factory=list)
    batches: dict[str, list[Any]] = field(default_factory=dict)

    def answer(
        self, path: str, headers: dict[str, str], body: bytes
    ) -> tuple[int, dict[str, str], bytes]:
        self.requests.append((path, headers, body))
        if self.answers:
            return self.answers.pop(0)
        if path.endswith("/sparql"):
            kind = headers["Accept"].partition(",")[0]
            answer = json.dumps(JSON_ANSWER) if "json" in kind else "what,share\r\nHouse,0.5\r\n"
            return 200, {"Content-Type": kind}, answer.encode()
        if path.endswith("/v1/maps"):
            return 201, {"Location": "/maps/m1"}, b'{"id": "m1"}'
        if path.endswith("/observations"):
            key, sent = headers["Idempotency-Key"], json.loads(body)["features"]
            new = 0 if key in self.batches else len(sent)
            self.batches[key] = sent
            said = {"batch": key, "received": len(sent), "new": new, "merged": 0, "left_out": {}}
            return 200, {}, json.dumps(said).encode()
        return 404, {}, b'{"detail": "nothing here"}'


@pytest.fixture
def fake() -> Iterator[Fake]:
    """A service that runs for one test."""
    found = Fake()

    class Handler(BaseHTTPRequestHandler):
        def do_POST(self) -> None:
            body = self.rfile.read(int(self.headers["Content-Length"]))
            status, headers, answer = found.answer(self.path, dict(self.headers), body)
            self.send_response(status)
            for name, value in headers.items():
                self.send_header(name, value)
            self.end_headers()
            self.wfile.write(answer)

        def log_message(self, format: str, *args: Any) -> None:
            """Nobody wants to read that."""

    server = ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    found.url = f"http://127.0.0.1:{server.server_port}"
    thread = threading.Thread(target=server.serve_forever, args=(0.01,))
    thread.start()
    yield found
    server.shutdown()
    thread.join()
    server.server_close()


@pytest.fixture
def csv(tmp_path: Path) -> Path:
    """Seven landmarks in metres, one of a class that nobody knows."""
    path = tmp_path / "seen.csv"
    lines = [f"House,{10 * i},{5 * i},0.{i + 1}" for i in range(6)]
    path.write_text("\n".join(["class,x,y,confidence", *lines, "FlyingSaucer,1,1,1"]) + "\n")
    return path


def problem(status: int, detail: str, **headers: str) -> tuple[int, dict[str, str], bytes]:
    return status, headers, json.dumps({"detail": detail, "status": status}).encode()


def test_a_piped_answer_is_csv_as_it_came(run: Any, fake: Fake) -> None:
    done = run("query", "SELECT *", "--url", fake.url)
    assert (done.code, done.out) == (0, "what,share\r\nHouse,0.5\r\n")
    path, headers, body = fake.requests[0]
    assert (path, body) == ("/sparql", b"SELECT *")
    assert headers["Content-Type"].startswith("application/sparql-query")
    assert headers["Accept"].startswith("text/csv")
    assert "Authorization" not in headers


def test_a_table_is_for_people(run: Any, fake: Fake) -> None:
    done = run("query", "SELECT *", "--url", fake.url + "/sparql", "--format", "table")
    assert done.code == 0
    assert "sl:House" in done.out
    assert "\x1b" not in done.out
    assert "\ufffd[31mred" in done.out
    assert "2 answers" in done.err
    fake.answers.append((200, {"Content-Type": "application/sparql-results+json"},
                         b'{"head": {}, "boolean": true}'))  # fmt: skip
    assert run("query", "ASK", "--url", fake.url, "--format", "table").out == "yes\n"


@pytest.mark.parametrize(
    ("name", "kind"),
    [("json", "application/sparql-results+json"), ("tsv", "text/tab-separated-values"),
     ("xml", "application/sparql-results+xml"), ("turtle", "text/turtle"),
     ("ntriples", "application/n-triples"), ("jsonld", "application/ld+json"),
     ("rdfxml", "application/rdf+xml")],
)  # fmt: skip
def test_the_format_is_asked_for(run: Any, fake: Fake, name: str, kind: str) -> None:
    assert run("query", "SELECT *", "--url", fake.url, "--format", name).code == 0
    assert fake.requests[0][1]["Accept"].startswith(kind)


def test_queries_come_from_files_examples_and_standard_input(
    run: Any, run_process: Any, fake: Fake, tmp_path: Path
) -> None:
    (tmp_path / "mine.rq").write_text("SELECT ?ä", "utf-8")
    assert run("query", "--file", tmp_path / "mine.rq", "--url", fake.url).code == 0
    assert run("query", "--example", "near", "--url", fake.url).code == 0
    assert run_process("query", "-", "--url", fake.url, stdin="ASK {}").code == 0
    assert [body.decode() for _, _, body in fake.requests] == [
        "SELECT ?ä", get_example("near").query, "ASK {}",
    ]  # fmt: skip
    for wrong in ((), ("ASK {}", "--example", "near"), ("--example", "nothing"),
                  ("--file", tmp_path / "none.rq")):  # fmt: skip
        assert run("query", *wrong, "--url", fake.url).code == 2
    listed = run("query", "--list")
    assert "what-is-here" in listed.out
    assert len(fake.requests) == 3


def test_the_token_goes_along_but_not_to_somebody_else(
    run: Any, fake: Fake, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("SYMBOSLAM_TOKEN", "secret")
    assert run("query", "ASK {}", "--url", fake.url).code == 0
    assert fake.requests[0][1]["Authorization"] == "Bearer secret"
    fake.answers.append((307, {"Location": fake.url + "/elsewhere"}, b""))
    done = run("query", "ASK {}", "--url", fake.url)
    assert done.code == 2
    assert f"leads to {fake.url}/elsewhere" in done.err
    assert len(fake.requests) == 2
    bad = run("query", "ASK {}", "--url", fake.url, "--token", "a\nb")
    assert bad.code == 2
    assert "token" in bad.err


@pytest.mark.parametrize(
    ("answer", "code", "said"),
    [(problem(400, "line 1, column 7: expected"), 2, "symboslam: line 1, column 7: expected"),
     (problem(401, "no token"), 2, "no token"),
     (problem(503, "too many queries", **{"Retry-After": "1"}), 3, "too many queries"),
     (problem(504, "the query took too long"), 3, "took too long"),
     ((502, {}, b"<html>"), 3, "HTTP status 502"),
     (problem(400, "a\x1b[2Jb"), 2, "a [2Jb")],
)  # fmt: skip
def test_errors_have_the_detail_and_a_code(
    run: Any, fake: Fake, answer: Any, code: int, said: str
) -> None:
    fake.answers.append(answer)
    done = run("query", "SELECT", "--url", fake.url)
    assert done.code == code
    assert said in done.err
    assert done.out == ""
    assert len(fake.requests) == 1


def test_nobody_there(run: Any, fake: Fake) -> None:
    done = run("query", "ASK {}", "--url", "http://127.0.0.1:9")
    assert done.code == 3
    assert "cannot be reached" in done.err
    for wrong in ("file:///etc/passwd", "127.0.0.1:8080", "http://"):
        assert run("query", "ASK {}", "--url", wrong).code == 2


def test_pushes_all_to_a_new_map(run: Any, fake: Fake, csv: Path) -> None:
    done = run("push", csv, "--to", fake.url, "--new", "Ten", "--crs", "m", "--batch", 4,
               "--agent", "robot-1")  # fmt: skip
    assert done.code == 0, done.err
    assert done.out == f"{fake.url}/maps/m1\n"
    assert "sent 6 landmarks: 6 new, 0 merged" in done.err
    assert "1 not sent" in done.err
    made = json.loads(fake.requests[0][2])
    assert made["name"] == "Ten"
    assert made["crs"] == "m"
    west, south, east, north = made["bbox"]
    assert west <= 0 < 50 <= east
    assert south <= 0 < 25 <= north
    assert [len(sent) for sent in fake.batches.values()] == [4, 2]
    paths = {path for path, _, _ in fake.requests[1:]}
    assert paths == {"/v1/maps/m1/observations"}
    first = next(iter(fake.batches.values()))[0]
    assert first["geometry"]["coordinates"] == [0.0, 0.0]
    assert first["properties"] == {"class": "House", "confidence": 0.1, "agent": "robot-1"}


def test_what_is_sent_is_what_was_read(run: Any, fake: Fake, tmp_path: Path) -> None:
    """Longitude and latitude, time and agent go through and are read back as they were."""
    given = {
        "type": "FeatureCollection", "bbox": [149.0, -35.3, 149.1, -35.2],
        "features": [
            {
                "type": "Feature", "id": "a",
                "geometry": {"type": "Point", "coordinates": [149.05, -35.25]},
                "properties": {"tags": {"building": "barn"}, "time": "2026-03-02T10:00:00+00:00",
                               "agent": "robot-2", "confidence": 0.75},
            }
        ],
    }  # fmt: skip
    path = tmp_path / "one.geojson"
    path.write_text(json.dumps(given))
    done = run("push", path, "--to", fake.url, "--map", "m 1", "--agent", "other")
    assert done.code == 0, done.err
    sent = fake.requests[0]
    assert sent[0] == "/v1/maps/m%201/observations"
    assert sent[1]["Content-Type"] == "application/geo+json"
    knowledge = Knowledge.load()
    again = read_landmarks(json.loads(sent[2]), knowledge)
    assert knowledge.features[again.feature[0]].name == "Barn"
    x, y = again.frame.from_metres(again.x, again.y)
    assert (float(x[0]), float(y[0])) == pytest.approx((149.05, -35.25), abs=1e-9)
    assert again.agent is not None
    assert again.time is not None
    assert (again.id[0], again.agent[0], again.time[0]) == (
        "a", "robot-2", "2026-03-02T10:00:00+00:00",
    )  # fmt: skip
    assert again.confidence[0] == 0.75


def test_a_repeated_push_changes_nothing(run: Any, fake: Fake, csv: Path) -> None:
    arguments = ("push", csv, "--to", fake.url, "--map", "m1", "--crs", "m", "--batch", 4)
    assert "6 new" in run(*arguments).err
    keys = list(fake.batches)
    assert "0 new" in run(*arguments).err
    assert list(fake.batches) == keys
    csv.write_text(csv.read_text().replace("House,50", "House,51"))
    assert "2 new" in run(*arguments).err, "the second batch is another one now"


def test_waits_where_the_service_says_so(run: Any, fake: Fake, csv: Path) -> None:
    fake.answers += [
        problem(429, "slowly", **{"Retry-After": "0"}),
        problem(503, "busy", **{"Retry-After": "0"}),
    ]
    done = run("push", csv, "--to", fake.url, "--map", "m1", "--crs", "m")
    assert done.code == 0
    assert len(fake.requests) == 3
    assert len({body for _, _, body in fake.requests}) == 1


def test_gives_up_at_last(fake: Fake) -> None:
    waited: list[float] = []
    client = Client(fake.url, None, 10, waited.append)
    fake.answers = [problem(503, "never", **{"Retry-After": "7"})] * 50
    with pytest.raises(ServiceError, match="never"):
        client.post("/x", b"", {}, patient=True)
    assert set(waited) == {7.0}
    fake.answers = [problem(429, "too much", **{"Retry-After": "0"})] * 50
    with pytest.raises(InputError, match="too much"):
        client.post("/x", b"", {}, patient=True)


@pytest.mark.parametrize(
    ("header", "seconds"),
    [(None, 1), ("3", 3), ("-1", 0), ("1e9", 120), ("soon", 1),
     ("Wed, 21 Oct 2015 07:28:00 GMT", 0), ("Wed, 21 Oct 2099 07:28:00 GMT", 120)],
)  # fmt: skip
def test_retry_after_is_seconds_or_a_date(header: str | None, seconds: float) -> None:
    assert _seconds(header) == seconds


@pytest.mark.parametrize(
    ("arguments", "said"),
    [((), "give --map ID"), (("--map", "a", "--new", "b"), "give --map ID")],
)
def test_one_map_is_meant(run: Any, fake: Fake, csv: Path, arguments: Any, said: str) -> None:
    done = run("push", csv, "--to", fake.url, *arguments)
    assert done.code == 2
    assert said in done.err


def test_a_wrong_file_makes_no_map(run: Any, fake: Fake, tmp_path: Path) -> None:
    bad = tmp_path / "bad.geojson"
    bad.write_text("{")
    assert run("push", bad, "--to", fake.url, "--new", "Bad").code == 2
    assert fake.requests == []


def test_another_kind_of_service(run: Any, fake: Fake, csv: Path) -> None:
    fake.answers.append((200, {}, b"<html>hello"))
    done = run("push", csv, "--to", fake.url, "--new", "x", "--crs", "m")
    assert done.code == 3
    assert "no SymboSLAM service" in done.err
