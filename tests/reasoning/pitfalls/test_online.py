"""Rules that ask the network, against a server on this machine; and that no other rule does."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable, Iterator
from http.server import BaseHTTPRequestHandler, HTTPServer
from pathlib import Path
from typing import Any

import pytest

from symboslam.reasoning.pitfalls import online
from symboslam.reasoning.pitfalls.model import Result, Settings, Status
from symboslam.reasoning.pitfalls.rules import p40
from symboslam.reasoning.pitfalls.scan import scan_pitfalls

OWL = "@prefix owl: <http://www.w3.org/2002/07/owl#> .\n"
TURTLE = OWL + "<#A> a owl:Class ."
PAGE = "<!DOCTYPE html><html><head><title>O</title></head></html>"


_CONNECT = socket.socket.connect


class Site:
    """A web site.

    Attributes:
        pages: path -> (status, media type, content), or a place to redirect to.
        asked: (path, Accept) of each request.
    """

    def __init__(self, port: int) -> None:
        self.root = f"http://127.0.0.1:{port}"
        self.pages: dict[str, tuple[int, str, str] | str] = {}
        self.asked: list[tuple[str, str]] = []


@pytest.fixture
def site() -> Iterator[Site]:
    class Handler(BaseHTTPRequestHandler):
        def do_GET(self) -> None:
            served.asked.append((self.path, self.headers["Accept"]))
            kind = "html" if self.headers["Accept"].startswith("text/html") else "rdf"
            page = served.pages.get(f"{self.path} {kind}", served.pages.get(self.path))
            if isinstance(page, str):
                self.send_response(303)
                self.send_header("Location", page)
                self.end_headers()
                return
            status, media_type, content = page or (404, "text/plain", "no")
            self.send_response(status)
            self.send_header("Content-Type", media_type)
            self.end_headers()
            self.wfile.write(content.encode())

        def log_message(self, *_: Any) -> None:
            pass

    server = HTTPServer(("127.0.0.1", 0), Handler)
    served = Site(server.server_port)
    thread = threading.Thread(target=server.serve_forever, args=(0.01,), daemon=True)
    thread.start()
    yield served
    server.shutdown()
    thread.join()
    server.server_close()


Check = Callable[..., Result]


@pytest.fixture
def check(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Check:
    """The result of one rule on a Turtle text; it can reach this machine only."""

    def connect(self: socket.socket, address: tuple[str, int]) -> None:
        assert address[0] == "127.0.0.1"
        _CONNECT(self, address)

    monkeypatch.setattr(socket.socket, "connect", connect)
    monkeypatch.setenv("no_proxy", "*")

    def call(code: str, text: str, **settings: Any) -> Result:
        path = tmp_path / "o.ttl"
        path.write_text(OWL + text, encoding="utf-8")
        given = Settings(**{"online": True, **settings})
        report = scan_pitfalls([path], given, codes=[code], strict_imports=False)
        return next(r for r in report.results if r.pitfall.code == code)

    return call


def affected(result: Result) -> list[str]:
    assert result.status is Status.CHECKED, result.reason
    return [o.finding.elements[0].rpartition("/")[2] for o in result.occurrences]


def ontology(site: Site, path: str = "/o") -> str:
    return f"<{site.root}{path}> a owl:Ontology ."


# P37


@pytest.mark.parametrize(
    "pages",
    [
        {"/o": (200, "text/turtle", TURTLE)},
        {"/o": (200, "text/plain", TURTLE)},
        {"/o": (200, "text/html; charset=utf-8", PAGE)},
        {"/o html": (200, "text/html", PAGE), "/o": (406, "text/plain", "")},
        {"/o": "/there", "/there": (200, "text/turtle", TURTLE)},
        {"/o": (200, "application/rdf+xml", '<rdf:RDF xmlns:rdf="http://www.w3.org/1999/02/22-rdf-'
                'syntax-ns#"><rdf:Description rdf:ID="a"><rdf:value>1</rdf:value>'
                "</rdf:Description></rdf:RDF>")},
    ],
)  # fmt: skip
def test_available(check: Check, site: Site, pages: Any) -> None:
    site.pages = pages
    result = check("P37", ontology(site))
    assert result.status is Status.CHECKED, result.reason
    assert not result.occurrences


@pytest.mark.parametrize(
    ("pages", "reason"),
    [
        ({}, "404 Not Found"),
        ({"/o": (410, "text/plain", "")}, "410 Gone"),
        ({"/o": (200, "text/turtle", "")}, "neither RDF nor HTML (text/turtle)"),
        ({"/o": (200, "application/pdf", "%PDF-1.4")}, "neither RDF nor HTML (application/pdf)"),
        ({"/o": (200, "text/turtle", "<a> <b")}, "neither RDF nor HTML"),
    ],
)
def test_not_available(check: Check, site: Site, pages: Any, reason: str) -> None:
    site.pages = pages
    (found,) = check("P37", ontology(site)).occurrences
    assert found.finding.elements == ()
    assert reason in found.finding.message
    assert found.place.line == 2


def test_both_kinds_are_asked_for(check: Check, site: Site) -> None:
    check("P37", ontology(site, "/o#x"))
    assert site.asked == [("/o", online.RDF), ("/o", online.HTML)]


@pytest.mark.parametrize("status", [403, 429, 500, 503])
def test_a_server_in_trouble_tells_nothing(check: Check, site: Site, status: int) -> None:
    site.pages["/o"] = (status, "text/plain", "")
    result = check("P37", ontology(site))
    assert result.status is Status.NOT_CHECKED
    assert f"{site.root}/o> could not be asked: {status}" in result.reason


def test_a_silent_server_beside_a_missing_page(check: Check, site: Site) -> None:
    site.pages["/o"] = (503, "text/plain", "")
    (found,) = check("P37", ontology(site) + ontology(site, "/p")).occurrences
    assert "/p>: 404" in found.finding.message
    assert "/o> could not be asked: 503" in found.finding.message


def test_slow_and_large_answers_tell_nothing(
    check: Check, site: Site, monkeypatch: pytest.MonkeyPatch
) -> None:
    site.pages["/o"] = (200, "text/turtle", TURTLE + "#" * 2000)
    monkeypatch.setattr(online, "BYTES", 1000)
    result = check("P37", ontology(site))
    assert result.status is Status.NOT_CHECKED
    assert "larger than" in result.reason
    monkeypatch.setattr(online, "BYTES", 1_000_000)
    monkeypatch.setattr(online, "SECONDS", 0.05)
    with socket.create_server(("127.0.0.1", 0)) as silent:  # accepts, but never answers
        port = silent.getsockname()[1]
        result = check("P37", f"<http://127.0.0.1:{port}/o> a owl:Ontology .")
    assert result.status is Status.NOT_CHECKED
    assert "no answer within" in result.reason


def test_nobody_there(check: Check) -> None:
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
    (found,) = check("P37", f"<http://127.0.0.1:{port}/o> a owl:Ontology .").occurrences
    assert "refused" in found.finding.message


@pytest.mark.parametrize(
    ("error", "is_known"),
    [(socket.EAI_NONAME, True), (socket.EAI_AGAIN, False)],
)
def test_unknown_host(
    check: Check, monkeypatch: pytest.MonkeyPatch, error: int, is_known: bool
) -> None:
    def resolve(*_: Any, **__: Any) -> None:
        raise socket.gaierror(error, "no such name")

    monkeypatch.setattr(socket, "getaddrinfo", resolve)
    result = check("P37", "<http://gone.invalid/o> a owl:Ontology .")
    assert result.status is (Status.CHECKED if is_known else Status.NOT_CHECKED)
    assert len(result.occurrences) == is_known


def test_only_the_web_is_asked(check: Check, site: Site, tmp_path: Path) -> None:
    secret = tmp_path / "secret.ttl"
    secret.write_text(TURTLE)
    for place in (secret.as_uri(), "ftp://127.0.0.1/o"):
        site.pages["/o"] = place
        (found,) = check("P37", ontology(site)).occurrences
        assert place in found.finding.message
    (found,) = check("P37", "<urn:x:o> a owl:Ontology .").occurrences
    assert "no address of the Web" in found.finding.message


def test_without_an_iri(check: Check) -> None:
    for text in ("[] a owl:Ontology .", "<> a owl:Ontology ."):
        result = check("P37", text)
        assert result.status is Status.NOT_CHECKED
        assert "no IRI" in result.reason


# P40

OWN = "<https://example.org/o> a owl:Ontology . <https://example.org/o#A> a owl:Class . "


def test_hash_namespace(check: Check, site: Site) -> None:
    site.pages["/ns"] = (200, "text/turtle", TURTLE)
    text = OWN + f"<{site.root}/ns#A> a owl:Class . <{site.root}/ns#B> a owl:ObjectProperty ."
    assert affected(check("P40", text)) == ["ns#B"]
    assert [path for path, _ in site.asked] == ["/ns"]


def test_slash_namespace(check: Check, site: Site) -> None:
    site.pages["/ns/"] = (200, "text/html", PAGE)
    site.pages["/ns/A"] = (200, "text/turtle", OWL + f"<{site.root}/ns/A> a owl:Class .")
    text = OWN + f"<{site.root}/ns/A> a owl:Class . <{site.root}/ns/B> a owl:Class ."
    assert affected(check("P40", text)) == ["B"]
    site.pages["/ns/"] = (200, "text/turtle", OWL + f"<{site.root}/ns/B> a owl:Class .")
    assert affected(check("P40", text)) == []


def test_too_many_terms(check: Check, site: Site, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(p40, "REQUESTS", 1)
    for name in "AB":
        content = OWL + f"<{site.root}/ns/{name}> a owl:Class ."
        site.pages[f"/ns/{name}"] = (200, "text/turtle", content)
    text = OWN + f"<{site.root}/ns/A> a owl:Class . <{site.root}/ns/B> a owl:Class ."
    result = check("P40", text)
    assert result.status is Status.NOT_CHECKED
    assert f"only 1 of 2 terms of <{site.root}/ns/> were looked up" in result.reason


def test_a_namespace_that_is_gone(check: Check, site: Site) -> None:
    assert affected(check("P40", OWN + f"<{site.root}/ns#A> a owl:Class .")) == ["ns#A"]
    assert affected(check("P40", OWN + f"<{site.root}/ns/A> a owl:Class .")) == ["A"]


def test_a_namespace_that_says_nothing(check: Check, site: Site) -> None:
    site.pages["/page"] = (200, "text/html", PAGE)
    site.pages["/ns"] = (200, "text/turtle", TURTLE)
    text = OWN + f"<{site.root}/page#A> a owl:Class ."
    result = check("P40", text)
    assert result.status is Status.NOT_CHECKED
    assert f"<{site.root}/page#> does not say what it defines" in result.reason
    (found,) = check("P40", text + f"<{site.root}/ns#B> a owl:Class .").occurrences
    assert str(found.finding.elements[0]) == f"{site.root}/ns#B"
    assert f"{site.root}/page#> does not say" in found.finding.message


def test_own_namespaces_are_not_asked(check: Check, site: Site) -> None:
    vann = "http://purl.org/vocab/vann/preferredNamespaceUri"
    texts = (
        f"<{site.root}/o> a owl:Ontology . <{site.root}/o#A> a owl:Class .",
        f"<{site.root}/o/> a owl:Ontology . <{site.root}/o/part/A> a owl:Class .",
        f"<{site.root}/o> a owl:Ontology ; <{vann}> '{site.root}/ns#' . "
        f"<{site.root}/o#A> a owl:Class . <{site.root}/ns#A> a owl:Class .",
        f"<https://example.org/o> a owl:Ontology . <{site.root}/ns#A> a owl:Class .",
        f"{OWN}<urn:x:A> a owl:Class . owl:Thing a owl:Class . <{site.root}/ns#i> a owl:Thing .",
    )
    for text in texts:
        assert affected(check("P40", text)) == []
    assert site.asked == []


def test_terms_of_an_import_that_was_read(check: Check, site: Site, tmp_path: Path) -> None:
    (tmp_path / "far.ttl").write_text(
        f"{OWL}<{site.root}/far> a owl:Ontology . <{site.root}/far#A> a owl:Class ."
    )
    text = OWN + f"<https://example.org/o> owl:imports <{site.root}/far> . "
    assert affected(check("P40", text + f"<{site.root}/far#A> a owl:Class .")) == []
    assert site.asked == []


# Without leave


@pytest.mark.parametrize("code", ["P37", "P40"])
@pytest.mark.parametrize("strict", [False, True])
def test_needs_leave(check: Check, site: Site, code: str, strict: bool) -> None:
    result = check(code, ontology(site), online=strict, strict_oops=strict)
    assert result.status is Status.NOT_CHECKED
    assert result.reason == "needs the network: --online" or strict
    assert site.asked == []


@pytest.mark.parametrize("strict", [False, True])
def test_no_rule_asks_the_network(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, strict: bool
) -> None:
    asked: list[Any] = []

    def refuse(*arguments: Any, **_: Any) -> None:
        asked.append(arguments)
        raise OSError("the network was asked")

    monkeypatch.setattr(socket.socket, "connect", refuse)
    monkeypatch.setattr(socket, "getaddrinfo", refuse)
    path = tmp_path / "o.ttl"
    path.write_text(
        OWL + "<https://example.org/o.owl> a owl:Ontology ; owl:imports <https://far.example/f> . "
        "<https://example.org/o#A> a owl:Class . <https://far.example/f#B> a owl:Class . "
        "<https://example.org/o#p> a owl:ObjectProperty ."
    )
    report = scan_pitfalls([path], Settings(strict_oops=strict), strict_imports=False)
    assert len(report.results) == 41
    assert asked == []
