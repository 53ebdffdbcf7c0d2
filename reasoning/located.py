"""Graphs that know on which line of its file each triple stands.

rdflib drops the lines that its parsers count. Both parsers here are rdflib's own, extended by a
look at their state at the moment when they add a triple.
"""

from __future__ import annotations

import io
from bisect import bisect_left, bisect_right
from typing import Any, Self
from xml.parsers import expat

from rdflib import Graph
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


def parse_turtle(graph: LocatedGraph, data: bytes, base: str) -> None:
    """Read Turtle; the line of a triple is that of its predicate."""
    parser = _TurtleParser(graph, baseURI=base, turtle=True)
    parser.loadStream(io.BytesIO(data))
    for prefix, namespace in parser._bindings.items():
        graph.bind(prefix, namespace)


class _TurtleParser(SinkParser):
    """rdflib's Turtle parser, with the lines of the predicates that it is inside of.

    ``SinkParser.lines`` is no help: it counts a line again whenever the parser steps back.
    """

    def __init__(self, graph: LocatedGraph, **options: Any) -> None:
        self.graph = graph
        self.verbs: list[int] = [1]
        self._ends: list[int] | None = None
        super().__init__(RDFSink(graph), **options)

    def property_list(self, argstr: str, i: int, subj: Node) -> int:
        self.verbs.append(self.verbs[-1])
        end: int = super().property_list(argstr, i, subj)
        self.verbs.pop()
        return end

    def verb(self, argstr: str, i: int, res: Any) -> int:
        if self._ends is None:  # the text is the whole document each time
            self._ends = [at for at, c in enumerate(argstr) if c == "\n"]
        self.verbs[-1] = bisect_left(self._ends, i) + 1
        end: int = super().verb(argstr, i, res)
        return end

    def makeStatement(self, quadruple: Any) -> None:
        self.graph.line = self.verbs[-1]
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
        depth = 0
        parser = expat.ParserCreate()

        def start(*_: object) -> None:
            nonlocal depth
            depth += 1
            if depth == 2:
                self._starts.append(parser.CurrentLineNumber)

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

    @property
    def line(self) -> int:
        """The line on which the axiom begins that the parser is at."""
        at = bisect_right(self._starts, self._read)
        return self._starts[at - 1] if at else self._read
