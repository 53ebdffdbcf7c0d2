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


class Names:
    """What DNS knows.

    Attributes:
        known: hosts that are found, on this machine.
        error: what it says of the others.
        asked: hosts that were asked for.
    """

    def __init__(self) -> None:
        self.known: list[str] = []
        self.error: int = socket.EAI_NONAME
        self.asked: list[str] = []


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
    online._names_are_found.cache_clear()

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


@pytest.fixture
def names(monkeypatch: pytest.MonkeyPatch) -> Names:
    """Stands in for DNS."""
    given = Names()

    def resolve(host: str, port: int, *_: Any, **__: Any) -> list[Any]:
        given.asked.append(host)
        if host not in given.known:
            raise socket.gaierror(given.error, "Name or service not known")
        return [(socket.AF_INET, socket.SOCK_STREAM, 6, "", ("127.0.0.1", port))]

    monkeypatch.setattr(socket, "getaddrinfo", resolve)
    return given


HOSTS = "<http://gone.invalid/o> a owl:Ontology . <http://gone.example/p> a owl:Ontology ."


def test_unknown_host(check: Check, names: Names) -> None:
    names.known = [online.WELL_KNOWN]
    first, second = check("P37", HOSTS).occurrences
    assert "gone.example/p>: Name or service not known" in first.finding.message
    assert "gone.invalid/o>: Name or service not known" in second.finding.message
    assert names.asked.count(online.WELL_KNOWN) == 1


def test_a_host_that_may_be_known(check: Check, names: Names) -> None:
    names.known, names.error = [online.WELL_KNOWN], socket.EAI_AGAIN
    result = check("P37", HOSTS)
    assert result.status is Status.NOT_CHECKED
    assert online.WELL_KNOWN not in names.asked


@pytest.mark.parametrize("code", ["P37", "P40"])
@pytest.mark.parametrize("error", [socket.EAI_NONAME, socket.EAI_AGAIN])
def test_no_network(check: Check, names: Names, code: str, error: int) -> None:
    names.error = error
    text = f"{HOSTS} <http://gone.example/p#A> a owl:Class . "
    text += "<http://xmlns.com/foaf/0.1/Person> a owl:Class . <http://far.invalid/#A> a owl:Class ."
    result = check(code, text)
    assert result.status is Status.NOT_CHECKED
    assert "Name or service not known" in result.reason
    host = "gone.invalid/o" if code == "P37" else "xmlns.com/foaf/0.1/"
    assert f"<http://{host}> could not be" in result.reason
    assert ("www.w3.org is not found either" in result.reason) is (error == socket.EAI_NONAME)
    assert names.asked.count(online.WELL_KNOWN) == (error == socket.EAI_NONAME)


@pytest.mark.parametrize("failing", ["found", "answering"])
def test_a_broken_proxy_tells_nothing(
    check: Check, names: Names, monkeypatch: pytest.MonkeyPatch, failing: str
) -> None:
    names.known = [online.WELL_KNOWN, *(["proxy.invalid"] if failing == "answering" else [])]
    monkeypatch.delenv("no_proxy")
    with socket.create_server(("127.0.0.1", 0)) as server:
        port = server.getsockname()[1]
    monkeypatch.setenv("http_proxy", f"http://proxy.invalid:{port}")
    result = check("P37", "<http://there.example/o> a owl:Ontology .")
    assert result.status is Status.NOT_CHECKED
    assert "proxy" in result.reason
    assert "there.example" not in names.asked


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


def message(result: Result) -> str:
    (found,) = result.occurrences
    return found.finding.message


def test_the_message_says_why(check: Check, site: Site, names: Names) -> None:
    names.known = ["127.0.0.1", online.WELL_KNOWN]
    site.pages["/ns"] = site.pages["/far/B"] = (200, "text/turtle", TURTLE)
    for term, why in {
        f"{site.root}/ns#B": f"what is at <{site.root}/ns#> does not define it",
        f"{site.root}/far/B": f"what is at <{site.root}/far/B> does not define it",
        f"{site.root}/gone#A": f"<{site.root}/gone#> answers 404 Not Found",
        f"{site.root}/gone/A": f"<{site.root}/gone/A> answers 404 Not Found",
        "http://gone.invalid/o#A": "<http://gone.invalid/o#> leads nowhere: Name or service not "
        "known",
    }.items():
        found = check("P40", f"{OWN} <{term}> a owl:Class .")
        assert message(found) == f"is declared here, but {why}"


def test_a_silent_host_is_asked_once(check: Check, site: Site, names: Names) -> None:
    terms = "".join(f"<http://far.invalid/{name}> a owl:Class . " for name in "ABC")
    result = check("P40", OWN + terms)
    assert result.status is Status.NOT_CHECKED
    assert result.reason.startswith("<http://far.invalid/> could not be looked at: Name or ser")
    assert names.asked == ["far.invalid", online.WELL_KNOWN]


def test_a_host_that_falls_silent_is_left_alone(check: Check, site: Site, names: Names) -> None:
    names.known = ["127.0.0.1"]
    site.pages["/ns/A"] = "http://far.invalid/A"
    terms = "".join(f"<{site.root}/ns/{name}> a owl:Class . " for name in "AB")
    result = check("P40", OWN + terms)
    assert result.status is Status.NOT_CHECKED
    assert [path for path, _ in site.asked] == ["/ns/", "/ns/A"]


def test_every_gap_is_told(check: Check, site: Site) -> None:
    for name in "AB":
        site.pages[f"/ns/{name}"] = (503, "text/plain", "")
    terms = "".join(f"<{site.root}/ns/{name}> a owl:Class . " for name in "ABC")
    assert message(check("P40", OWN + terms)) == (
        f"is declared here, but <{site.root}/ns/C> answers 404 Not Found (not everything was "
        f"checked: <{site.root}/ns/A>, <{site.root}/ns/B> could not be looked at: 503 "
        "Service Unavailable)"
    )


PREFIXES = """
@prefix : <https://example.org/o#> .
@prefix rdf: <http://www.w3.org/1999/02/22-rdf-syntax-ns#> .
@prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> .
@prefix xsd: <http://www.w3.org/2001/XMLSchema#> .
@prefix skos: <http://www.w3.org/2004/02/skos/core#> .
@prefix dcterms: <http://purl.org/dc/terms/> .
"""


@pytest.mark.parametrize(
    ("text", "how"),
    [
        (":x a far:B .", "is used as the type of x"),
        ("[] a far:B .", "is used as a type"),
        ("far:B rdfs:subClassOf :A .", "is used with subClassOf"),
        (":A rdfs:subClassOf far:B .", "is used with subClassOf"),
        (":A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty :p ; owl:someValuesFrom far:B ] "
         ".", "is used with someValuesFrom"),
        (":A rdfs:subClassOf [ a owl:Restriction ; owl:onProperty far:B ; owl:someValuesFrom :A ] "
         ".", "is used with onProperty"),
        (":A owl:equivalentClass [ a owl:Class ; owl:unionOf ( :A far:B ) ] .",
         "is used with unionOf"),
        ("[] a owl:AllDisjointClasses ; owl:members ( :A far:B ) .", "is used with members"),
        (":p rdfs:domain far:B .", "is used with domain"),
        (":p rdfs:range far:B .", "is used with range"),
        (":p rdfs:subPropertyOf far:B .", "is used with subPropertyOf"),
        (":p owl:propertyChainAxiom ( :p far:B ) .", "is used with propertyChainAxiom"),
        (":x far:B :y .", "is used as a predicate"),
        (":x :p '1'^^far:B .", "is used as a datatype"),
        (":x a far:B . far:B a owl:Class .", "is declared here"),
    ],
)  # fmt: skip
def test_terms_that_are_only_used(check: Check, site: Site, text: str, how: str) -> None:
    site.pages["/far"] = (200, "text/turtle", OWL + "<#A> a owl:Class .")
    prefixes = f"{PREFIXES}@prefix far: <{site.root}/far#> .\n{OWN} :p a owl:ObjectProperty .\n"
    result = check("P40", f"{prefixes}{text}")
    assert message(result) == f"{how}, but what is at <{site.root}/far#> does not define it"
    (found,) = result.occurrences
    assert found.finding.elements == (f"{site.root}/far#B",)
    if "subClassOf [" in text:
        assert found.axiom.startswith("every A ")
    assert found.place.line == f"{OWL}{prefixes}".count("\n") + 1
    assert affected(check("P40", f"{prefixes}{text.replace('far:B', 'far:A')}")) == []
    assert [path for path, _ in site.asked] == ["/far", "/far"]


def test_individuals_are_not_asked_for(check: Check, site: Site) -> None:
    text = f"<{site.root}/far#i> a :A ; owl:sameAs <{site.root}/far#j> . [] a owl:AllDifferent ; "
    text += f"owl:members ( :x <{site.root}/far#k> ) . :x :p <{site.root}/far#l> . "
    text += f":A owl:equivalentClass [ owl:oneOf ( <{site.root}/far#m> ) ] ."
    assert affected(check("P40", PREFIXES + OWN + text)) == []
    assert site.asked == []


def test_uses_in_imports_are_theirs(check: Check, site: Site, tmp_path: Path) -> None:
    (tmp_path / "far.ttl").write_text(
        f"{OWL}<https://example.org/far> a owl:Ontology . <https://example.org/far#x> a "
        f"<{site.root}/ns#B>, owl:Foo ."
    )
    text = OWN + "<https://example.org/o> owl:imports <https://example.org/far> ."
    assert affected(check("P40", text)) == []
    assert site.asked == []


@pytest.mark.parametrize(
    ("text", "term", "why"),
    [
        ("rdfs:Bogus a owl:Class .", "rdf-schema#Bogus", "is declared here, but RDF Schema"),
        ("owl:Foo a owl:Class .", "owl#Foo", "is declared here, but OWL"),
        (":x a owl:Foo .", "owl#Foo", "is used as the type of x, but OWL"),
        (":B rdfs:subclassOf :A .", "rdf-schema#subclassOf", "is used as a predicate, but RDF Sch"),
        (":x rdf:typ :A .", "22-rdf-syntax-ns#typ", "is used as a predicate, but RDF has"),
        (":x rdf:_1x :A .", "22-rdf-syntax-ns#_1x", "is used as a predicate, but RDF has"),
        (":x rdfs:label '1'^^xsd:intger .", "XMLSchema#intger", "is used as a datatype, but XML S"),
        (":p rdfs:range xsd:Integer .", "XMLSchema#Integer", "is used with range, but XML Schema"),
        (":A skos:prefLable 'a' .", "core#prefLable", "is used as a predicate, but SKOS has"),
    ],
)
def test_made_up_terms_of_the_standards(check: Check, text: str, term: str, why: str) -> None:
    result = check("P40", PREFIXES + OWN + text)
    assert affected(result) == [term]
    assert message(result).startswith(why)
    assert message(result).endswith(" has no such term")


def test_made_up_terms_are_nobodys_own(check: Check) -> None:
    head = "<https://example.org/o> a owl:Ontology ."
    result = check("P40", f"{PREFIXES}{head} rdfs:Bogus a owl:Class .")
    assert affected(result) == ["rdf-schema#Bogus"]


def test_terms_of_the_standards(check: Check, names: Names) -> None:
    text = """:A a rdfs:Class, skos:Concept ; skos:prefLabel 'a'@en ; rdfs:seeAlso :x ;
        dcterms:title 'a'^^rdf:PlainLiteral ; rdf:_1 :x ; :p '1'^^xsd:int, 'x:y'^^xsd:anyURI .
    :p a owl:DatatypeProperty, owl:FunctionalProperty ; rdfs:range xsd:anySimpleType, owl:real ;
        rdfs:subPropertyOf owl:topDataProperty . :d a rdfs:Datatype ; owl:equivalentClass [
        a rdfs:Datatype ; owl:onDatatype xsd:decimal ;
        owl:withRestrictions ( [ xsd:minInclusive 0.5 ] [ xsd:pattern '.*' ] ) ] .
    dcterms:title a owl:AnnotationProperty ."""
    assert affected(check("P40", PREFIXES + OWN + text)) == []
    assert names.asked == []


def test_made_up_terms_beside_a_silent_host(check: Check, names: Names) -> None:
    text = f"{PREFIXES}{OWN} rdfs:Bogus a owl:Class . :x dcterms:made :y ."
    assert message(check("P40", text)) == (
        "is declared here, but RDF Schema has no such term (not everything was checked: "
        "<http://purl.org/dc/terms/> could not be looked at: Name or service not known, and "
        "www.w3.org is not found either)"
    )


def test_own_terms_without_an_ontology_of_that_name(check: Check, site: Site) -> None:
    prefix = f"{PREFIXES}@prefix far: <{site.root}/far#> ."
    head = "<https://example.org/else> a owl:Ontology ."
    assert affected(check("P40", f"{prefix}{head} :x a :A .")) == []
    assert site.asked == []
    assert affected(check("P40", f"{prefix}{head} :x a far:B .")) == ["far#B"]
    head = "<https://example.org/o> a owl:Ontology ."
    assert affected(check("P40", f"{prefix}{head} far:B rdfs:subClassOf :C .")) == ["far#B"]


def test_a_namespace_that_says_nothing(check: Check, site: Site) -> None:
    site.pages["/page"] = (200, "text/html", PAGE)
    site.pages["/ns"] = (200, "text/turtle", TURTLE)
    text = OWN + f"<{site.root}/page#A> a owl:Class ."
    result = check("P40", text)
    assert result.status is Status.NOT_CHECKED
    assert result.reason == f"<{site.root}/page#> could not be read as RDF"
    (found,) = check("P40", text + f"<{site.root}/ns#B> a owl:Class .").occurrences
    assert str(found.finding.elements[0]) == f"{site.root}/ns#B"
    assert f"(not everything was checked: <{site.root}/page#> could not be read as RDF)" in (
        found.finding.message
    )


def test_own_namespaces_are_not_asked(check: Check, site: Site) -> None:
    vann = "http://purl.org/vocab/vann/preferredNamespaceUri"
    texts = (
        f"<{site.root}/o> a owl:Ontology . <{site.root}/o#A> a owl:Class .",
        f"<{site.root}/o/> a owl:Ontology . <{site.root}/o/part/A> a owl:Class .",
        f"<{site.root}/o> a owl:Ontology ; <{vann}> '{site.root}/ns#' . "
        f"<{site.root}/o#A> a owl:Class . <{site.root}/ns#A> a owl:Class .",
        f"<https://example.org/o> a owl:Ontology . <{site.root}/ns#A> a owl:Class .",
        f"<{site.root}/ns/core> a owl:Ontology . <{site.root}/ns#A> a owl:Class . "
        f"<{site.root}/ns/core#i> a <{site.root}/ns#A> .",
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
    text = f"{ontology(site)} owl:Foo a owl:Class ."
    result = check(code, text, online=strict, strict_oops=strict)
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
