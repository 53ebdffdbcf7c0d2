"""Graphs that know on which line of its file each triple stands.

rdflib drops the lines that its parsers count. Both parsers here are rdflib's own, extended by a
look at their state at the moment when they add a triple.
"""

from __future__ import annotations

import io
import json
import re
from bisect import bisect_left
from collections.abc import Callable, Iterable, Iterator
from typing import Any, Self
from urllib.parse import urljoin

from rdflib import RDF, BNode, Graph, Literal
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
        lines: those known; the others are added. A line of :func:`json_ld_lines`, which is that of
            the triple's subject, becomes that of the triple.
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
    for triple, line in lines.items():
        if isinstance(line, _JsonNode):
            lines[triple] = line.line(triple)
    seen: set[Node] = set()
    while waiting:
        node, line = waiting.pop()
        if node in seen:
            continue
        seen.add(node)
        for triple in about.get(node, ()):
            if triple not in lines:
                lines[triple] = line.line(triple, True) if isinstance(line, _JsonNode) else line
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


_Value = str | tuple[str]


class _JsonNode(int):
    """The line of a node of JSON-LD, and those of the values in its object.

    Attributes:
        own: (predicate, value) -> the line on which the value is first given. IRIs are strings,
            literals are tuples of their lexical form.
        inner: the same for the anonymous nodes inside; 0 where a value stands on several lines.
    """

    own: dict[tuple[str, _Value], int]
    inner: dict[tuple[str, _Value], int]

    def __new__(cls, line: int) -> Self:
        node = super().__new__(cls, line)
        node.own, node.inner = {}, {}
        return node

    def line(self, triple: Triple, is_inner: bool = False) -> int:
        """The line of a triple about this node, or about an anonymous node inside it."""
        _, predicate, value = triple
        if isinstance(value, BNode):
            return int(self)
        key = (str(predicate), (str(value),) if isinstance(value, Literal) else str(value))
        return (self.inner if is_inner else self.own).get(key) or int(self)


class _JsonObject:
    """An object of JSON whose end is not yet reached.

    Attributes:
        is_context: whether it explains words and describes nothing.
        is_map: whether its keys are languages or indexes, not predicates.
        is_value: whether it has an ``@value``.
        key: of the value that comes next.
        keys: how many there were.
        id: word and line of its ``@id``.
        tokens: of its own statements.
        inner: of the anonymous nodes inside.
    """

    __slots__ = ("id", "inner", "is_context", "is_map", "is_value", "key", "keys", "tokens")

    def __init__(self, is_context: bool = False, is_map: bool = False) -> None:
        self.is_context, self.is_map, self.is_value = is_context, is_map, False
        self.key, self.keys = "", 0
        self.id: tuple[str, int] | None = None
        self.tokens: list[_Token] = []
        self.inner: list[_Token] = []


_Token = tuple[str, str, str, int]  # key; "iri", "literal" or "either"; what is written; line
_JSON_KEYWORDS = ("@id", "@type", "@value", "@set", "@list")
_JSON_TOKEN = re.compile(r'("[^"\\]*(?:\\.[^"\\]*)*")(\s*:)?|[{}]|[-+.\w]+')


def json_ld_lines(text: str, document: Any, base: str) -> dict[str, int]:
    """IRI -> the line of JSON-LD on which the node with this ``@id`` is described.

    That is the first place where more than the ``@id`` is given, else the first of all. Where two
    contexts in the document explain a prefix differently, no IRI with it is found. For
    :func:`spread_lines` these lines also know those of the node's statements.
    """
    words = _JsonWords(document, base)
    found: dict[str, _JsonNode] = {}
    mentioned: dict[str, _JsonNode] = {}
    here = _JsonObject()
    outer: list[_JsonObject] = []
    line, counted = 1, 0
    for match in _JSON_TOKEN.finditer(text):
        string, colon = match.groups()
        if colon:
            here.key = _json_string(string)
            here.keys += 1
        elif string or match[0] not in "{}":
            if not here.is_context and match[0] != "null":
                line += text.count("\n", counted, match.start())
                counted = match.start()
                words.add(here, string, match[0], line)
        elif match[0] == "{":
            outer.append(here)
            is_context = here.is_context or here.key == "@context"
            here = _JsonObject(is_context, here.key in words.maps)
        else:
            inside, here = here, outer.pop()
            if inside.id is None:
                words.close(inside, here)
                continue
            here.tokens.append((here.key, "iri", *inside.id))
            if (iri := words.iri(inside.id[0])) is not None:
                nodes = mentioned if inside.keys == 1 else found
                words.note(nodes.setdefault(iri, _JsonNode(inside.id[1])), inside)
    return {**mentioned, **found}


def _json_string(token: str) -> str:
    return str(json.loads(token)) if "\\" in token else token[1:-1]


class _JsonWords:
    """What the words of a JSON-LD document mean, after all contexts in it together.

    Attributes:
        keywords: name -> the keyword that it stands for, as ``@id``.
        maps: names of predicates whose values are maps of languages or indexes.
        lists: names of predicates whose values are lists.
    """

    def __init__(self, document: Any, base: str) -> None:
        self.keywords = {keyword: keyword for keyword in _JSON_KEYWORDS}
        self.maps: set[str] = set()
        self.lists: set[str] = set()
        self._of_iris = {"@type"}  # predicates whose values are IRIs though plain strings
        self._names: dict[str, str | None] = {}  # None where there are several meanings
        self._vocabs: set[str] = set()
        bases: set[str] = set()
        for context in _json_contexts(document):
            for name, meaning in context.items():
                if name == "@base" and isinstance(meaning, str):
                    bases.add(meaning)
                elif name == "@vocab" and isinstance(meaning, str):
                    self._vocabs.add(meaning)
                elif not name.startswith("@"):
                    self._learn(name, meaning)
        self._base = urljoin(base, bases.pop()) if len(bases) == 1 else "" if bases else base
        self._iris: dict[str, str | None] = {}
        self._meanings: dict[str, str | None] = {
            name: str(RDF.type if keyword == "@type" else RDF.first)
            for name, keyword in self.keywords.items()
            if keyword in ("@type", "@list")
        }

    def _learn(self, name: str, meaning: Any) -> None:
        more = meaning if isinstance(meaning, dict) else {"@id": meaning}
        iri = more.get("@id", name)
        iri = iri if isinstance(iri, str) else None
        if iri in _JSON_KEYWORDS:
            self.keywords[name] = iri
            if iri == "@type":
                self._of_iris.add(name)
            return
        if self._names.setdefault(name, iri) != iri:
            self._names[name] = None
        if more.get("@type") in ("@id", "@vocab"):
            self._of_iris.add(name)
        container = more.get("@container")
        for kind in container if isinstance(container, list) else [container]:
            if kind in ("@language", "@index"):
                self.maps.add(name)
            elif kind == "@list":
                self.lists.add(name)

    def iri(self, word: str) -> str | None:
        """The IRI that is the value of an ``@id``, or ``_:`` and a name; None where unknown."""
        if word not in self._iris:
            self._iris[word] = self._resolve(word)
        return self._iris[word]

    def _resolve(self, word: str) -> str | None:
        prefix, colon, rest = word.partition(":")
        if colon and prefix in self._names and not rest.startswith("//"):
            namespace = self._meaning(prefix)
            return None if namespace is None else namespace + rest
        if colon:
            return word
        return urljoin(self._base, word) if self._base else None

    def _meaning(self, word: str) -> str | None:
        """The IRI of a predicate or a type, None where unknown."""
        if word not in self._meanings:
            self._meanings[word] = None  # against definitions in a circle
            meaning = self._names.get(word, word)
            if meaning is not None and meaning != word:
                meaning = self._meaning(meaning)
            elif meaning is not None and ":" in meaning:
                meaning = self._resolve(meaning)
            elif meaning is not None:
                meaning = min(self._vocabs) + word if len(self._vocabs) == 1 else None
            self._meanings[word] = meaning
        return self._meanings[word]

    def add(self, here: _JsonObject, string: str | None, token: str, line: int) -> None:
        """Note a string, a number or a truth value where it stands."""
        keyword = self.keywords.get(here.key)
        if string is None:
            value = json.loads(token)
            for word in {token, str(value), str(Literal(value))}:
                here.tokens.append((here.key, "literal", word, line))
        elif keyword == "@id":
            here.id = (_json_string(string), line)
        else:
            here.tokens.append((here.key, "either", _json_string(string), line))
        here.is_value |= keyword == "@value"

    def close(self, inside: _JsonObject, outer: _JsonObject) -> None:
        """Hand over what an object without ``@id`` says.

        That is a value of the predicate outside, or an anonymous node inside the node outside.
        """
        for token in inside.tokens:
            keyword = self.keywords.get(token[0])
            if inside.is_value:
                if keyword == "@value":
                    outer.tokens.append((outer.key, "literal", *token[2:]))
            elif inside.is_map or keyword == "@set":
                outer.tokens.append((outer.key, *token[1:]))
            else:
                outer.inner.append(token)
        if len(inside.inner) > len(outer.inner):
            inside.inner, outer.inner = outer.inner, inside.inner
        outer.inner += inside.inner

    def note(self, node: _JsonNode, described: _JsonObject) -> None:
        """Note the lines of what an object says of its node and of the anonymous nodes inside."""
        for token in described.tokens:
            if token[0] in self.lists:
                described.inner.append(token)
                continue
            for key in self._statements(token):
                node.own.setdefault(key, token[3])
        for token in described.inner:
            for key in self._statements(token):
                if node.inner.setdefault(key, token[3]) != token[3]:
                    node.inner[key] = 0

    def _statements(self, token: _Token) -> Iterator[tuple[str, _Value]]:
        """Predicate and value, or both values that a string may stand for."""
        key, kind, word, _ = token
        predicate = str(RDF.first) if key in self.lists else self._meaning(key)
        if predicate is None:
            return
        if kind != "iri":
            yield predicate, (word,)
        if kind == "iri" or (kind == "either" and key in self._of_iris):
            if (iri := self.iri(word)) is not None:
                yield predicate, iri
            if kind == "either" and (meaning := self._meaning(word)) is not None:
                yield predicate, meaning


def _json_contexts(document: Any) -> Iterator[dict[str, Any]]:
    waiting = [document]
    while waiting:
        node = waiting.pop()
        if isinstance(node, list):
            waiting += node
        elif isinstance(node, dict):
            context = node.get("@context", [])
            several = context if isinstance(context, list) else [context]
            yield from (c for c in several if isinstance(c, dict))
            waiting += node.values()
