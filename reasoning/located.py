"""Graphs that know on which line of its file each triple stands.

rdflib drops the lines that its parsers count. Both parsers here are rdflib's own, extended by a
look at their state at the moment when they add a triple.
"""

from __future__ import annotations

import io
import json
import re
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable
from typing import Any, Self
from urllib.parse import urljoin
from xml.parsers import expat

from rdflib import BNode, Graph
from rdflib.plugins.parsers.notation3 import RDFSink, SinkParser
from rdflib.plugins.parsers.rdfxml import RDFXMLHandler
from rdflib.term import Node

Triple = tuple[Node, Node, Node]


class LocatedGraph(Graph):
    """A graph that notes a line for each triple that is added.

    Attributes:
        line: where the parser is now; None where it cannot tell.
        lines: triple -> the line on which it was first stated.
    """

    def __init__(self) -> None:
        super().__init__()
        self.line: int | None = None
        self.lines: dict[Triple, int] = {}

    def add(self, triple: Any) -> Self:
        """See :meth:`rdflib.Graph.add`."""
        if self.line is not None:
            self.lines.setdefault(triple, self.line)
        super().add(triple)
        return self


def spread_lines(
    triples: Iterable[Triple], lines: dict[Triple, int], is_inside: Callable[[BNode], bool]
) -> None:
    """Give the lines of statements also to those of the anonymous expressions inside them.

    Args:
        triples: all triples of a file.
        lines: those known; the others are added.
        is_inside: whether an anonymous node is a part of what speaks of it.
    """
    about: dict[Node, list[Triple]] = {}
    for triple in triples:
        if isinstance(triple[0], BNode):
            about.setdefault(triple[0], []).append(triple)
    waiting = [
        (node, line)
        for triple, line in lines.items()
        for node in (triple[0], triple[2])
        if isinstance(node, BNode) and is_inside(node)
    ]
    seen: set[Node] = set()
    while waiting:
        node, line = waiting.pop()
        if node in seen:
            continue
        seen.add(node)
        for triple in about.get(node, ()):
            lines.setdefault(triple, line)
            if isinstance(triple[2], BNode) and is_inside(triple[2]):
                waiting.append((triple[2], line))


def parse_turtle(graph: LocatedGraph, data: bytes, base: str) -> None:
    """Read Turtle; the line of a triple is that on which its object begins."""
    parser = _TurtleParser(graph, baseURI=base, turtle=True)
    parser.loadStream(io.BytesIO(data))
    for prefix, namespace in parser._bindings.items():
        graph.bind(prefix, namespace)


class _Statement:
    """The predicate that the parser is inside of, and the lines of it and of its objects."""

    def __init__(self, line: int) -> None:
        self.line = line
        self.objects: list[int] = []
        self.list: Any = None  # where the parser collects the objects
        self.is_read = False


class _TurtleParser(SinkParser):
    """rdflib's Turtle parser, with the lines of what it is inside of.

    ``SinkParser.lines`` is no help: it counts a line again whenever the parser steps back.
    """

    def __init__(self, graph: LocatedGraph, **options: Any) -> None:
        self.graph = graph
        self.inside: list[_Statement] = [_Statement(1)]
        self._ends: list[int] | None = None
        super().__init__(RDFSink(graph), **options)

    def _line(self, argstr: str, i: int) -> int:
        if self._ends is None:  # the text is the whole document each time
            self._ends = [at for at, c in enumerate(argstr) if c == "\n"]
        return bisect_left(self._ends, i) + 1

    def property_list(self, argstr: str, i: int, subj: Node) -> int:
        self.inside.append(_Statement(self.inside[-1].line))
        end: int = super().property_list(argstr, i, subj)
        self.inside.pop()
        return end

    def verb(self, argstr: str, i: int, res: Any) -> int:
        self.inside[-1] = _Statement(self._line(argstr, i))
        end: int = super().verb(argstr, i, res)
        return end

    def objectList(self, argstr: str, i: int, res: Any) -> int:
        here = self.inside[-1]
        here.list = res
        end: int = super().objectList(argstr, i, res)
        here.is_read = True
        return end

    def object(self, argstr: str, i: int, res: Any) -> int:
        here = self.inside[-1]
        if res is here.list:
            here.line = self._line(argstr, max(self.skipSpace(argstr, i), i))
            here.objects.append(here.line)
        end: int = super().object(argstr, i, res)
        return end

    def makeStatement(self, quadruple: Any) -> None:
        here = self.inside[-1]
        self.graph.line = here.objects.pop(0) if here.is_read and here.objects else here.line
        super().makeStatement(quadruple)


def parse_rdf_xml(graph: LocatedGraph, data: bytes, base: str) -> None:
    """Read RDF/XML; the line of a triple is that of the tag which states it."""
    from xml.sax import make_parser
    from xml.sax.handler import ErrorHandler, feature_namespaces
    from xml.sax.xmlreader import InputSource

    source = InputSource(base)
    source.setByteStream(io.BytesIO(data))
    reader = make_parser()
    reader.setFeature(feature_namespaces, 1)
    # What rdflib does too: expat's reader would guess a prefix for xml:lang without it.
    reader.start_namespace_decl("xml", "http://www.w3.org/XML/1998/namespace")  # type: ignore[attr-defined]
    reader.setContentHandler(_RdfXmlHandler(graph))
    reader.setErrorHandler(ErrorHandler())
    reader.parse(source)


class _RdfXmlHandler(RDFXMLHandler):
    """rdflib's RDF/XML handler; ``tags`` holds the lines of the open tags."""

    def __init__(self, graph: LocatedGraph) -> None:
        self.graph = graph
        self.tags: list[int | None] = []
        super().__init__(graph)

    def startElementNS(self, name: Any, qname: Any, attrs: Any) -> None:
        self.tags.append(self.locator.getLineNumber())
        self.graph.line = self.tags[-1]
        super().startElementNS(name, qname, attrs)

    def endElementNS(self, name: Any, qname: Any) -> None:
        self.graph.line = self.tags[-1]
        super().endElementNS(name, qname)
        self.tags.pop()


class OwlXmlLines:
    """A file for a parser of OWL/XML, handed over line by line, that knows where an axiom begins.

    owlready2's parser states an axiom at its end tag and tells nobody where it is. What it has read
    by then is known here, and so is the line of each child of the root.
    """

    def __init__(self, data: bytes) -> None:
        self._lines = iter(data.splitlines(keepends=True))
        self._read = 0
        self._starts: list[int] = []
        self._tags: list[str] = []
        self._stated: set[int] = set()
        depth = 0
        parser = expat.ParserCreate()

        def start(tag: str, _: object) -> None:
            nonlocal depth
            depth += 1
            if depth == 2:
                self._starts.append(parser.CurrentLineNumber)
                self._tags.append(tag.rpartition(":")[2])

        def end(*_: object) -> None:
            nonlocal depth
            depth -= 1

        parser.StartElementHandler, parser.EndElementHandler = start, end
        parser.Parse(data, True)

    def read(self, _size: int = -1) -> bytes:
        """The next line; nothing at the end."""
        line = next(self._lines, b"")
        self._read += bool(line)
        return line

    def line(self) -> int:
        """The line on which the axiom begins that the parser now states."""
        at = bisect_right(self._starts, self._read)
        line = self._starts[at - 1] if at else self._read
        self._stated.add(line)
        return line

    def left_out(self) -> tuple[int, str] | None:
        """Line and element of the first axiom of which nothing was stated, after the parsing."""
        both = zip(self._starts, self._tags, strict=True)
        dropped = (b for b in both if b[0] not in self._stated and b[1] != "Prefix")
        return next(dropped, None)


_JSON_ID = re.compile(r'(\{\s*)?("(?:[^"\\]|\\.)*")(\s*:\s*)?("(?:[^"\\]|\\.)*")?(\s*\})?')


def json_ld_lines(text: str, document: Any, base: str) -> dict[str, int]:
    """IRI -> the line of JSON-LD on which the node with this ``@id`` is described.

    That is the first place where more than the ``@id`` is given, else the first of all. Where two
    contexts in the document explain a prefix differently, no IRI with it is found.
    """
    prefixes, keys, bases = _json_ld_contexts(document)
    base = urljoin(base, bases.pop()) if len(bases) == 1 else "" if bases else base
    found: dict[str, int] = {}
    mentioned: dict[str, int] = {}
    line, counted = 1, 0
    for match in _JSON_ID.finditer(text):
        key, value = match[2], match[4]
        if not (match[3] and value and json.loads(key) in keys):
            continue
        at = match.start(4)
        line += text.count("\n", counted, at)
        counted = at
        iri: str | None = json.loads(value)
        prefix, colon, rest = str(iri).partition(":")
        if prefix == "_" and colon:
            pass
        elif colon and prefix in prefixes and not rest.startswith("//"):
            namespace = prefixes[prefix]
            iri = namespace + rest if namespace is not None else None
        elif not colon:
            iri = urljoin(base, str(iri)) if base else None
        if iri is not None:
            alone = match[1] is not None and match[5] is not None
            (mentioned if alone else found).setdefault(iri, line)
    return {**mentioned, **found}


def _json_ld_contexts(document: Any) -> tuple[dict[str, str | None], set[str], set[str]]:
    """Prefix -> namespace (None where it has several), names of ``@id``, and base IRIs."""
    prefixes: dict[str, str | None] = {}
    keys, bases = {"@id"}, set()
    waiting = [document]
    contexts: list[dict[str, Any]] = []
    while waiting:
        node = waiting.pop()
        if isinstance(node, list):
            waiting += node
        elif isinstance(node, dict):
            context = node.get("@context", [])
            several = context if isinstance(context, list) else [context]
            contexts += (c for c in several if isinstance(c, dict))
            waiting += node.values()
    for context in contexts:
        for name, meaning in context.items():
            iri = meaning.get("@id") if isinstance(meaning, dict) else meaning
            if name == "@base" and isinstance(iri, str):
                bases.add(iri)
            elif iri == "@id":
                keys.add(name)
            elif not name.startswith("@"):
                iri = iri if isinstance(iri, str) and "://" in iri else None
                if prefixes.setdefault(name, iri) != iri:
                    prefixes[name] = None
    return prefixes, keys, bases
