"""Parse one ontology file of any usual format into a graph, without ever touching the network."""

from __future__ import annotations

import codecs
import json
import logging
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import PurePath
from typing import TYPE_CHECKING, Any
from xml.parsers import expat
from xml.sax import SAXParseException

from symboslam.errors import OntologySyntaxError
from symboslam.reasoning.vocabulary import OWL_NAMESPACE

if TYPE_CHECKING:
    from rdflib import Graph

    from symboslam.reasoning.located import LocatedGraph

_BY_EXTENSION = {
    ".ttl": "turtle",
    ".n3": "turtle",
    ".nt": "turtle",  # a subset of Turtle, whose parser reports lines
    ".jsonld": "json-ld",
    ".json": "json-ld",
    ".omn": "Manchester syntax",
    ".ofn": "functional syntax",
    ".fss": "functional syntax",
    ".obo": "OBO format",
}
_UNSUPPORTED = ("Manchester syntax", "OBO format")
EXTENSIONS = (
    ".ttl", ".owl", ".rdf", ".xml", ".owx", ".ofn", ".nt", ".n3", ".jsonld", ".json",
)  # fmt: skip
"""Extensions that an ontology file may have here; a content that is plainly another wins."""

_RDF_XML_ERROR = re.compile(r"[^\s]*?:(\d+):\d+: (.*)", re.DOTALL)  # base:line:column: problem
_SPACE = rb"(?:\s|#[^\n]*(?:\n|\Z))*+"  # comments too
_FUNCTIONAL_START = re.compile(_SPACE + rb"(?:Prefix|Ontology)\s*\(")
_MANCHESTER_START = re.compile(_SPACE + rb"(?:Prefix|Ontology):")
_TURTLE_START = re.compile(_SPACE + rb"(?:@prefix\s|@base\s|(?i:prefix|base)\s+[^(]|<|_:)")
_JSON_START = re.compile(rb"\{|\[\s*[{\]]")
_XML_START = re.compile(rb"<(\?xml|!|[\w.-]+(:[\w.-]+)?\s)")  # not <http://...>

# A document may not grow by more than this when its entities are expanded ("billion laughs").
_EXPANSION_FACTOR, _EXPANSION_FREE = 10, 1_000_000
_DEEPEST = 100  # levels of an expression


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep rdflib from writing tracebacks about odd values to standard error."""
    logger = logging.getLogger("rdflib.term")
    before, logger.disabled = logger.disabled, True
    try:
        yield
    finally:
        logger.disabled = before


@_quiet()
def parse(name: str, data: bytes) -> LocatedGraph:
    """The graph of an ontology file, with the line of each triple where the format has lines.

    Args:
        name: the file's name, for its extension and for messages.
        data: its content.

    Raises:
        OntologySyntaxError: it does not parse, its format is not supported, or it asks for
            something outside itself (external XML entities, remote JSON-LD contexts).
    """
    from symboslam.reasoning.located import LocatedGraph, parse_rdf_xml, parse_turtle

    graph = LocatedGraph()
    data = data.removeprefix(codecs.BOM_UTF8)
    try:
        language = _language(name, data)
        if language in _UNSUPPORTED:
            raise _error(
                name,
                None,
                f"{language} is not supported; save it as Turtle, RDF/XML, OWL/XML, functional "
                "syntax, N-Triples or JSON-LD (Protégé and ROBOT can)",
            )
        base = f"file:///{PurePath(name).name.replace(' ', '%20')}"
        if language == "json-ld":
            _parse_json_ld(name, data, base, graph)
        elif language in ("functional syntax", "owl/xml"):
            _parse_structure(name, language, data, base, graph)
        else:
            (parse_turtle if language == "turtle" else parse_rdf_xml)(graph, data, base)
    except OntologySyntaxError:
        raise
    except RecursionError:
        raise _error(name, graph.line, "it is nested too deeply") from None
    except UnicodeDecodeError as error:
        line = error.object[: error.start].count(b"\n") + 1
        raise _error(name, line, "it is not UTF-8 text") from error
    except Exception as error:  # parsers raise errors of many unrelated types
        where, problem = _place(error)
        if isinstance(error, IndexError):  # rdflib's Turtle, when it runs out of text
            where = data.rstrip().count(b"\n") + 1
            problem = "the file ends in the middle of something"
        elif where is None and language == "turtle":
            where = graph.line  # of the last triple before
        raise _error(name, where, problem.partition(" at ^ in:")[0]) from error
    _refuse_bad_iris(name, graph)
    _refuse_endless(name, graph)
    return graph


def _error(name: str, line: int | None, problem: str) -> OntologySyntaxError:
    return OntologySyntaxError(f"{name}: {f'line {line}: ' if line else ''}{problem}")


def _place(error: Exception) -> tuple[int | None, str]:
    """Line and problem in an error of one of the parsers."""
    if hasattr(error, "_str") and hasattr(error, "_why"):  # rdflib's Turtle
        # Its own count of lines goes wrong where the parser stepped back.
        text = error._str.decode()
        end = getattr(error, "_i", -1)
        read = text[:end] if end >= 0 else text.rstrip()
        return read.count("\n") + 1, str(error._why)
    if isinstance(error, SAXParseException):
        return error.getLineNumber(), str(error.getMessage())
    if isinstance(error, json.JSONDecodeError):
        return error.lineno, error.msg
    if found := _RDF_XML_ERROR.match(str(error)):
        return int(found[1]), found[2].strip()
    return None, " ".join(str(error).split()) or type(error).__name__


def _language(name: str, data: bytes) -> str:
    """The name of the parser to use: the extension says it, unless the content says another."""
    said = _BY_EXTENSION.get(PurePath(name).suffix.lower())
    text = data.lstrip()
    # "<name " might be a broken IRI in Turtle, and "[" begins an anonymous node there.
    if _XML_START.match(text) and (
        said is None or text.startswith(b"<?xml") or b"xmlns" in text[:10_000]
    ):
        return _xml_language(name, data)
    if _JSON_START.match(text) or (said is None and text.startswith(b"[")):
        if said == "json-ld" or b"@" in text[:100_000]:
            return "json-ld"
    elif _FUNCTIONAL_START.match(data):
        return "functional syntax"
    elif _MANCHESTER_START.match(data):
        return "Manchester syntax"
    elif text.startswith(b"format-version:"):
        return "OBO format"
    elif _TURTLE_START.match(data):
        return "turtle"
    return said or "turtle"


def _xml_language(name: str, data: bytes) -> str:
    """``xml`` (RDF/XML) or ``owl/xml``, after a look at the whole document for traps.

    Raises:
        OntologySyntaxError: not well-formed, an external entity, or entities that explode.
    """
    root: list[str] = []
    grown = 0
    limit = _EXPANSION_FACTOR * len(data) + _EXPANSION_FREE
    parser = expat.ParserCreate(namespace_separator="")

    def start(tag: str, attributes: dict[str, str]) -> None:
        if not root:
            root.append(tag)
        text("".join(attributes.values()))

    def text(content: str) -> None:
        nonlocal grown
        grown += len(content)
        if grown > limit:
            raise _error(name, parser.CurrentLineNumber, "its XML entities explode")

    def entity(
        entity_name: str, _is_parameter: int, value: str | None, _base: object, system: str | None,
        *_rest: object,
    ) -> None:  # fmt: skip
        if value is None or system is not None:
            problem = f"the external XML entity {entity_name!r} is refused; write its content here"
            raise _error(name, parser.CurrentLineNumber, problem)

    parser.StartElementHandler = start
    parser.CharacterDataHandler = text
    parser.EntityDeclHandler = entity
    try:
        parser.Parse(data, True)
    except expat.ExpatError as error:
        raise _error(name, error.lineno, expat.ErrorString(error.code)) from error
    return "owl/xml" if root[0] == OWL_NAMESPACE + "Ontology" else "xml"


def _parse_structure(name: str, language: str, data: bytes, base: str, graph: LocatedGraph) -> None:
    """Read a syntax of OWL's structure, and not of RDF."""
    from symboslam.reasoning.functional import parse_functional
    from symboslam.reasoning.functional_expressions import FormError
    from symboslam.reasoning.owl_xml import parse_owl_xml

    try:
        if language == "owl/xml":
            parse_owl_xml(graph, data, base)
        else:
            parse_functional(graph, data)
    except FormError as error:
        raise _error(name, error.line, error.problem) from error


def _parse_json_ld(name: str, data: bytes, base: str, graph: LocatedGraph) -> None:
    from rdflib import BNode, Graph
    from rdflib.plugins.parsers.jsonld import to_rdf

    from symboslam.reasoning.located import json_ld_lines, spread_lines

    document = json.loads(data)
    _refuse_remote_contexts(name, document)
    to_rdf(document, read := Graph(), base)
    subjects = json_ld_lines(data.decode(), document, base)
    lines = {
        triple: line
        for triple in read
        if (line := subjects.get(("_:" if isinstance(triple[0], BNode) else "") + str(triple[0])))
    }
    spread_lines(read, lines, lambda node: f"_:{node}" not in subjects)
    fresh: dict[object, BNode] = {}  # the parser keeps names, which another file may use too
    for triple in read:
        s, p, o = (fresh.setdefault(t, BNode()) if isinstance(t, BNode) else t for t in triple)
        graph.line = lines.get(triple)
        graph.add((s, p, o))


def _refuse_remote_contexts(name: str, node: Any) -> None:
    """Refuse JSON-LD whose terms are explained in another document."""
    if isinstance(node, list):
        for item in node:
            _refuse_remote_contexts(name, item)
    elif isinstance(node, dict):
        context = node.get("@context", [])
        for item in context if isinstance(context, list) else [context]:
            if isinstance(item, str) or (isinstance(item, dict) and "@import" in item):
                problem = "a remote JSON-LD context is not fetched; write it into the file"
                raise _error(name, None, problem)
        for item in node.values():
            _refuse_remote_contexts(name, item)


def _refuse_bad_iris(name: str, graph: LocatedGraph) -> None:
    """Refuse IRIs with characters that none may have; they could not be written again."""
    from rdflib import URIRef

    for triple in graph:
        for term in triple:
            if isinstance(term, URIRef) and any(c in '<>" {}|\\^`' or c < "!" for c in term):
                shown = "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in term)
                raise _error(name, graph.lines.get(triple), f"<{shown}> is not an IRI")


def _refuse_endless(name: str, graph: Graph) -> None:
    """Refuse anonymous expressions that contain themselves or are nested beyond all reason.

    Anonymous individuals may be linked in circles; only what makes up expressions counts.
    """
    from rdflib import OWL, RDF, BNode

    parts = (str(OWL), str(RDF.first), str(RDF.rest))
    inside: dict[BNode, list[tuple[BNode, int]]] = {}
    holders: dict[BNode, int] = {}
    for s, p, o in graph:
        if isinstance(s, BNode) and isinstance(o, BNode) and str(p).startswith(parts):
            inside.setdefault(s, []).append((o, 0 if p == RDF.rest else 1))
            holders[o] = holders.get(o, 0) + 1
    depth = dict.fromkeys(inside.keys() - holders.keys(), 0)
    waiting = list(depth)
    while waiting:
        outer = waiting.pop()
        for inner, step in inside.get(outer, ()):
            depth[inner] = max(depth.get(inner, 0), depth[outer] + step)
            holders[inner] -= 1
            if not holders[inner]:
                waiting.append(inner)
    if any(holders.values()):
        raise _error(name, None, "an anonymous expression contains itself")
    if max(depth.values(), default=0) > _DEEPEST:
        raise _error(name, None, "its expressions are nested too deeply")
