"""Ask the Web for an ontology or a term; only rules under ``Settings.online`` may do so."""

from __future__ import annotations

import re
import socket
import time
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from http.client import HTTPException
from typing import TYPE_CHECKING, Any
from urllib.error import HTTPError, URLError
from urllib.parse import quote, urlsplit
from urllib.request import (
    HTTPDefaultErrorHandler,
    HTTPErrorProcessor,
    HTTPHandler,
    HTTPRedirectHandler,
    HTTPSHandler,
    OpenerDirector,
    ProxyHandler,
    Request,
    getproxies,
    proxy_bypass,
)

from symboslam.errors import OntologySyntaxError
from symboslam.reasoning.pitfalls.model import NotCheckedError, Settings

if TYPE_CHECKING:
    from rdflib import Graph

RDF = (
    "text/turtle, application/rdf+xml, application/n-triples;q=0.9, application/ld+json;q=0.8, "
    "application/xml;q=0.5, text/plain;q=0.3, */*;q=0.1"
)
"""What to accept where data are wanted."""
HTML = "text/html, application/xhtml+xml, */*;q=0.1"
"""What to accept where a page is wanted."""

SECONDS = 10.0
"""Time limit of a request."""
BYTES = 20_000_000
"""Size limit of an answer."""
WELL_KNOWN = "www.w3.org"
"""A host whose name is found wherever there is a network."""

_BLOCK = 65536
_TEMPORARY = (401, 403, 407, 408, 423, 425, 429)
_EXTENSIONS = {
    "text/turtle": ".ttl",
    "application/x-turtle": ".ttl",
    "text/n3": ".n3",
    "application/n-triples": ".nt",
    "application/ld+json": ".jsonld",
    "application/rdf+xml": ".rdf",
}
_HTML = re.compile(rb"<!doctype\s+html|<html[\s>]", re.IGNORECASE)


@dataclass(frozen=True)
class Answer:
    """What a server said.

    Attributes:
        iri: that was asked for.
        media_type: of the content, such as ``text/turtle``.
        content: None if there was none.
        problem: why there was none.
        final: the problem will not go away by itself: no such page, no such host.
        status: of HTTP, where the problem is one; 0 otherwise.
        heard: a server answered something, so that others of its pages may be asked for.
    """

    iri: str
    media_type: str = ""
    content: bytes | None = None
    problem: str = ""
    final: bool = False
    status: int = 0
    heard: bool = True

    @property
    def outcome(self) -> str:
        """What came of asking where there is no content, in words that follow the IRI."""
        if not self.final:
            return f"could not be looked at: {self.problem}"
        return f"answers {self.problem}" if self.status else f"leads nowhere: {self.problem}"

    @property
    def is_page(self) -> bool:
        """Whether it is HTML."""
        return self.content is not None and bool(_HTML.search(self.content[:4096]))

    def graph(self) -> Graph | None:
        """The statements in it; None if it is no RDF."""
        from rdflib import Graph, URIRef

        from symboslam.reasoning.parsing import parse

        if self.content is None or self.is_page:
            return None
        name = "answer" + _EXTENSIONS.get(self.media_type, "")
        try:
            read = parse(name, self.content)
        except OntologySyntaxError:
            return None
        ours, theirs = f"file:///{name}", str(self.iri).partition("#")[0]
        graph = Graph()
        for triple in read:
            s, p, o = (
                URIRef(theirs + term.removeprefix(ours))
                if isinstance(term, URIRef) and term.startswith(ours)
                else term
                for term in triple
            )
            graph.add((s, p, o))
        return graph


def require(settings: Settings) -> None:
    """Refuse to go on if the network may not be asked.

    Raises:
        NotCheckedError: it may not.
    """
    if not settings.online:
        raise NotCheckedError("needs the network: --online")


def gaps(silent: Iterable[tuple[str, str]]) -> str:
    """What could not be told, by reason: ``<a>, <b> could not be asked: 503; <c> ...``.

    Args:
        silent: what was asked, and what came of it.
    """
    by_reason: dict[str, list[str]] = {}
    for asked, reason in silent:
        by_reason.setdefault(reason, []).append(asked)
    return "; ".join(f"{', '.join(asked)} {reason}" for reason, asked in by_reason.items())


def fetch(iri: str, accept: str) -> Answer:
    """What is at an IRI; whatever goes wrong is in the answer.

    Args:
        iri: to be looked up; its fragment is left out.
        accept: the media types that are wanted.
    """
    address = str(iri).partition("#")[0]
    if not address.startswith(("http://", "https://")):
        return Answer(iri, problem="it is no address of the Web", final=True)
    headers = {"Accept": accept, "User-Agent": "symboslam-pitfalls"}
    request = Request(quote(address, safe="%/:=&?~#+!$,;'@()*[]"), headers=headers)
    until = time.monotonic() + SECONDS
    try:
        with _opener().open(request, timeout=SECONDS) as response:
            media_type = response.headers.get_content_type()
            content = bytearray()
            while block := response.read(_BLOCK):
                content += block
                if len(content) > BYTES:
                    return Answer(iri, problem=f"it is larger than {BYTES // 1_000_000} MB")
                if time.monotonic() > until:
                    return Answer(iri, problem=f"no full answer within {SECONDS:g} s")
            return Answer(iri, media_type, bytes(content))
    except HTTPError as error:
        error.close()
        final = error.code < 500 and error.code not in _TEMPORARY
        problem = f"{error.code} {error.reason}".strip()
        return Answer(iri, problem=problem, final=final, status=error.code)
    except URLError as error:
        return _failure(iri, error.reason)
    except (OSError, HTTPException, ValueError) as error:
        return _failure(iri, error)


def _failure(iri: str, reason: Any) -> Answer:
    """No answer at all; final if the host refuses to speak, or is not known but others are."""
    if isinstance(reason, TimeoutError):
        return Answer(iri, problem=f"no answer within {SECONDS:g} s", heard=False)
    text = str(getattr(reason, "strerror", None) or reason or type(reason).__name__)
    unknown = isinstance(reason, socket.gaierror) and reason.errno == socket.EAI_NONAME
    if not (unknown or isinstance(reason, ConnectionRefusedError)):
        return Answer(iri, problem=text, heard=False)
    if _has_proxy(iri):
        text += ", which may concern the proxy"
        return Answer(iri, problem=text, heard=False)
    if unknown and not _names_are_found():
        text += f", and {WELL_KNOWN} is not found either"
        return Answer(iri, problem=text, heard=False)
    return Answer(iri, problem=text, final=True, heard=False)


@cache
def _names_are_found() -> bool:
    """Whether the names of hosts are found at all; without a network, none may "exist"."""
    try:
        socket.getaddrinfo(WELL_KNOWN, 443)
    except OSError:
        return False
    return True


def _has_proxy(iri: str) -> bool:
    """Whether a proxy is asked instead of the host, or may be after a redirection."""
    host = urlsplit(iri).hostname or ""
    return bool({"http", "https"} & getproxies().keys()) and not proxy_bypass(host)


class _Redirects(HTTPRedirectHandler):
    """Follows redirections within the Web only."""

    def redirect_request(
        self, req: Request, fp: Any, code: int, msg: str, headers: Any, newurl: str
    ) -> Request | None:
        if not newurl.startswith(("http://", "https://")):
            raise HTTPError(req.full_url, code, f"leads to {newurl}", headers, fp)
        return super().redirect_request(req, fp, code, msg, headers, newurl)


def _opener() -> OpenerDirector:
    """Opens ``http`` and ``https`` only."""
    opener = OpenerDirector()
    for handler in (
        ProxyHandler(), HTTPHandler(), HTTPSHandler(), HTTPDefaultErrorHandler(), _Redirects(),
        HTTPErrorProcessor(),
    ):  # fmt: skip
        opener.add_handler(handler)
    return opener
