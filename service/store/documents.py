"""Parse uploaded graphs; nothing outside the document is ever read."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING
from xml.parsers import expat

from symboslam.service.store._base import Document, DocumentError
from symboslam.service.vocabulary import UPLOADS

if TYPE_CHECKING:
    from pyoxigraph import Triple

_PLACE = re.compile(
    r"(?:Parser )?error at (?:line )?(\d+)(?: column |:| between columns )(\d+)(?: and \d+)?: *",
    re.IGNORECASE,
)
_EXPECTED = "expected one of "
_PARTS = re.compile(r"""\[.*?\](?=, |$)|"(?:\\.|[^"])*"|[^,]*[^, ]""")
_LONGEST = 300


def place_and_problem(error: Exception) -> tuple[str, int | None, int | None]:
    """Problem, line and column in an error of pyoxigraph, which has them in its text."""
    text = str(error)
    line = column = None
    if found := _PLACE.match(text):
        line, column = int(found[1]), int(found[2])
        text = text[found.end() :]
    text = _readable(" ".join(text.split()))
    if len(text) > _LONGEST:
        text = text[:_LONGEST].rsplit(" ", 1)[0] + " ..."
    return text or "it does not parse", line, column


def _readable(text: str) -> str:
    """What a parser expected, without its classes of characters."""
    if text == "expected [_]":
        return "this does not belong here, or something is missing"
    if not text.startswith(_EXPECTED):
        return text
    parts: list[str] = [part.strip() for part in _PARTS.findall(text.removeprefix(_EXPECTED))]
    expected = [part for part in parts if part and part[0] != "["]
    told: list[str] = [part for part in expected if " " in part and part[0] not in "\"'"]
    if told:  # such as "Prefix not found"
        return told[0]
    return "expected one of " + ", ".join(expected) if expected else _readable("expected [_]")


def parse(document: Document) -> list[Triple]:
    """The triples of a document, its blank nodes distinct from all others.

    Raises:
        DocumentError: it does not parse, is not UTF-8, has named graphs, declares XML entities
            or needs a document elsewhere.
    """
    import pyoxigraph

    try:
        text = document.data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        raise DocumentError("it is not UTF-8 text", line) from error
    name = UPLOADS[document.media_type]
    if name == "RDF_XML":
        _refuse_traps(document.data)
    if name == "JSON_LD" and text.lstrip()[:1] not in ("{", "["):
        raise DocumentError("a JSON-LD document is an object or an array", 1, 1)
    try:
        quads = pyoxigraph.parse(
            text.encode(),
            getattr(pyoxigraph.RdfFormat, name),
            base_iri=document.base,
            without_named_graphs=True,
            rename_blank_nodes=True,
        )
        return [quad.triple for quad in quads]
    except (SyntaxError, ValueError) as error:
        raise DocumentError(*place_and_problem(error)) from error


def parse_all(documents: Iterable[Document]) -> list[Triple]:
    """The triples of several documents; its errors are those of `parse`."""
    return [triple for document in documents for triple in parse(document)]


def _refuse_traps(data: bytes) -> None:
    """Refuse RDF/XML that declares entities, of whatever kind, or is not in UTF-8.

    Entities can explode ("billion laughs") or read files and addresses.
    """
    parser = expat.ParserCreate()

    def entity(name: str, *_: object) -> None:
        problem = f"it declares the XML entity {name!r}; write out what it stands for"
        raise DocumentError(problem, parser.CurrentLineNumber, parser.CurrentColumnNumber + 1)

    def doctype(_name: str, system: str | None, public: str | None, _subset: int) -> None:
        if system or public:
            problem = "its DOCTYPE names an external document, which is not read; remove it"
            raise DocumentError(problem, parser.CurrentLineNumber, parser.CurrentColumnNumber + 1)

    def declaration(_version: str, encoding: str | None, _standalone: int) -> None:
        if encoding and encoding.lower() not in ("utf-8", "utf8", "us-ascii", "ascii"):
            raise DocumentError(f"it is declared to be {encoding}; send UTF-8", 1)

    parser.EntityDeclHandler = entity
    parser.StartDoctypeDeclHandler = doctype
    parser.XmlDeclHandler = declaration
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        problem = expat.ErrorString(error.code)
        raise DocumentError(problem, error.lineno, error.offset + 1) from error
