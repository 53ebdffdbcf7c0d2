"""Read OWL/XML into a graph, with lines: from elements to the forms of functional syntax.

The W3C's "OWL 2 XML Serialization" states the same structure as functional syntax, element by
element; so the elements become forms, and these triples. See decision 9 in ``docs/decisions``.
"""

from __future__ import annotations

import re
from contextlib import suppress
from dataclasses import dataclass, field
from typing import TYPE_CHECKING
from urllib.parse import urljoin
from xml.parsers import expat

from rdflib import RDF, XSD, BNode, Literal, URIRef

from symboslam.reasoning.functional_axioms import Axioms
from symboslam.reasoning.functional_expressions import (
    DEEPEST,
    Argument,
    Form,
    FormError,
    Names,
)
from symboslam.reasoning.vocabulary import OWL_NAMESPACE

if TYPE_CHECKING:
    from symboslam.reasoning.located import LocatedGraph

__all__ = ["parse_owl_xml"]

_XML = "http://www.w3.org/XML/1998/namespace "  # expat puts the space between namespace and name
_NAMED = {
    "Class", "Datatype", "ObjectProperty", "DataProperty", "AnnotationProperty", "NamedIndividual",
}  # fmt: skip
_WITH_TEXT = {"IRI", "AbbreviatedIRI", "Literal", "Import"}
_COUNTED = {
    f"{kind}{bound}Cardinality" for kind in ("Object", "Data") for bound in ("Min", "Max", "Exact")
}
_NAMES = ("IRI", "abbreviatedIRI")
_ATTRIBUTES = {
    **dict.fromkeys((*_NAMED, "Variable", "BuiltInAtom"), _NAMES),
    **dict.fromkeys(_COUNTED, ("cardinality",)),
    "Ontology": ("ontologyIRI", "versionIRI"),
    "Prefix": ("name", "IRI"),
    "AnonymousIndividual": ("nodeID",),
    "Literal": ("datatypeIRI",),
    "FacetRestriction": ("facet",),
}
_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:")
_NO_IRI = re.compile(r'[\x00-\x20<>"{}|\\^`]')


def parse_owl_xml(graph: LocatedGraph, data: bytes, base: str) -> None:
    """Read OWL/XML; the line of a triple is that on which its axiom's element begins.

    Relative IRIs are relative to ``xml:base``, else to the ontology's IRI, else to ``base``. Names
    of entities follow that at once, as the OWL API means those that it writes: ``/B`` in the base
    ``http://e.org/a`` is ``http://e.org/a/B``, and ``B`` in ``http://e.org/a#`` is
    ``http://e.org/a#B``.

    Args:
        graph: takes the triples.
        data: well-formed XML, the root an ``Ontology``.
        base: the document's IRI.

    Raises:
        FormError: it is not OWL/XML.
    """
    reader = _Reader(data, base)
    for prefix, namespace in reader.names.prefixes.items():
        graph.bind(prefix, namespace)
    Axioms(graph).ontology(reader.ontology)


@dataclass(slots=True)
class _Element:
    """An element that has not ended yet."""

    name: str
    line: int
    base: str
    attributes: dict[str, str]
    parts: list[Argument] = field(default_factory=list)
    kinds: list[str] = field(default_factory=list)  # the elements that the parts were
    text: list[str] = field(default_factory=list)

    def error(self, problem: str) -> FormError:
        return FormError(self.line, problem)

    def needed(self, attribute: str) -> str:
        if attribute not in self.attributes:
            raise self.error(f"<{self.name}> has no {attribute}")
        return self.attributes[attribute]


class _Reader:
    """The forms of a document.

    Attributes:
        ontology: the outermost one.
        names: the prefixes and anonymous individuals.
    """

    def __init__(self, data: bytes, base: str) -> None:
        self.names = Names()
        self.ontology = Form("", 1)
        self._base = base
        self._open: list[_Element] = []
        self._parser = expat.ParserCreate(namespace_separator=" ")
        self._parser.buffer_text = True
        self._parser.StartElementHandler = self._start
        self._parser.EndElementHandler = self._end
        self._parser.CharacterDataHandler = self._text
        self._parser.SkippedEntityHandler = self._skipped
        self._parser.Parse(data, True)

    def _start(self, tag: str, given: dict[str, str]) -> None:
        line = self._parser.CurrentLineNumber
        name = tag.removeprefix(OWL_NAMESPACE + " ")
        if name == tag:
            raise FormError(line, f"<{name.rpartition(' ')[2]}> is no element of OWL/XML")
        if len(self._open) == DEEPEST:
            raise FormError(line, "it is nested too deeply")
        known = _ATTRIBUTES.get(name, ())
        for attribute in given:
            if " " not in attribute and attribute not in known:
                raise FormError(line, f"<{name}> has no attribute {attribute} in OWL/XML")
        element = _Element(name, line, self._base, {k: v.strip() for k, v in given.items()})
        if self._open:
            element.base = self._open[-1].base
        else:
            element.base = self._full(element, element.attributes.get("ontologyIRI", ""))
        if _XML + "base" in given:
            element.base = self._full(element, element.attributes[_XML + "base"])
        self._open.append(element)

    def _text(self, text: str) -> None:
        element = self._open[-1]
        if element.name in _WITH_TEXT:
            element.text.append(text)
        elif text.strip():
            # The text between two tags comes at its end.
            line = self._parser.CurrentLineNumber - text.lstrip().count("\n")
            problem = f"the text {text.strip()[:40]!r} has no place in <{element.name}>"
            raise FormError(line, problem)

    def _skipped(self, name: str, _is_parameter: int) -> None:
        raise FormError(self._parser.CurrentLineNumber, f"the XML entity {name!r} is not declared")

    def _end(self, _tag: str) -> None:
        element = self._open.pop()
        if not self._open:
            self.ontology = self._whole(element)
            return
        outer = self._open[-1]
        if element.name == "Prefix":
            if len(self._open) > 1:
                raise element.error(f"<Prefix> has no place in <{outer.name}>")
            namespace = self._full(element, element.needed("IRI"))
            self.names.prefixes[element.needed("name")] = namespace
            return
        if element.name == "FacetRestriction" and outer.name == "DatatypeRestriction":
            self._close_facet(element, outer)
            return
        part = self._part(element)
        if outer.name == "Declaration" and element.name in _NAMED:
            part = Form(element.name, element.line, [part])
        elif len(self._open) == 1 and not isinstance(part, Form):
            raise element.error(f"an axiom is expected, not <{element.name}>")
        outer.parts.append(part)
        outer.kinds.append(element.name)

    def _whole(self, element: _Element) -> Form:
        """The form of the root; names first."""
        names: list[Argument] = []
        if iri := element.attributes.get("ontologyIRI"):
            names.append(URIRef(self._full(element, iri)))
        if version := element.attributes.get("versionIRI"):
            if not names:
                raise element.error("an ontology without ontologyIRI has no versionIRI")
            names.append(URIRef(self._full(element, version)))
        return Form("Ontology", element.line, names + element.parts)

    def _close_facet(self, element: _Element, outer: _Element) -> None:
        facet = URIRef(self._full(element, element.needed("facet")))
        if element.kinds != ["Literal"]:
            raise element.error("<FacetRestriction> holds one <Literal>")
        outer.parts += [facet, *element.parts]
        outer.kinds += [element.name, "Literal"]

    def _part(self, element: _Element) -> Argument:
        """What an element is as an argument of the element around it."""
        name, line, parts = element.name, element.line, element.parts
        if parts and (name in _NAMED or name in _WITH_TEXT or name == "AnonymousIndividual"):
            raise element.error(f"<{element.kinds[0]}> has no place in <{name}>")
        if name in _NAMED:
            return self._named(element)
        text = "".join(element.text)
        match name:
            case "IRI":
                return self._iri(element, text)
            case "AbbreviatedIRI":
                return self.names.short(text.strip(), line)
            case "AnonymousIndividual":
                return self._anonymous(element)
            case "Literal":
                return self._literal(element, text)
            case "Import":
                if not text.strip():
                    raise element.error("<Import> names no ontology")
                return Form(name, line, [URIRef(self._full(element, text.strip()))])
            case "Variable" | "BuiltInAtom":
                return Form(name, line, [self._named(element), *parts])
            case "HasKey":
                return self._key(element)
        if name in _COUNTED:
            number = element.needed("cardinality")
            if not (number.isascii() and number.isdigit()):
                raise element.error(f"the cardinality of <{name}> is {number!r}, no number")
            return Form(name, line, [number, *parts])
        return Form(name, line, parts)

    def _key(self, element: _Element) -> Form:
        """``HasKey(class (object properties) (data properties))``."""
        notes = element.kinds.count("Annotation")
        objects, data = Form("", element.line), Form("", element.line)
        for kind, part in list(zip(element.kinds, element.parts, strict=True))[notes + 1 :]:
            (data if kind == "DataProperty" else objects).arguments.append(part)
        return Form("HasKey", element.line, [*element.parts[: notes + 1], objects, data])

    def _named(self, element: _Element) -> URIRef:
        if all(name in element.attributes for name in _NAMES):
            raise element.error(f"<{element.name}> has both IRI and abbreviatedIRI")
        if (short := element.attributes.get("abbreviatedIRI")) is not None:
            return self.names.short(short, element.line)
        return self._iri(element, element.needed("IRI"))

    def _iri(self, element: _Element, text: str) -> URIRef:
        """The IRI of an entity."""
        text = text.strip()
        if text.startswith("#"):
            text = element.base.partition("#")[0] + text
        elif text.startswith(":"):
            raise element.error(f"{text!r} is not an IRI but an abbreviated one")
        elif not _SCHEME.match(text) and not text.startswith(("./", "../", "//")):
            text = element.base + text
        return URIRef(self._full(element, text))

    def _full(self, element: _Element, text: str) -> str:
        """An IRI in full, by RFC 3986."""
        if not _SCHEME.match(text):
            with suppress(ValueError):  # http://[
                text = urljoin(element.base, text)
        if _NO_IRI.search(text) or not _SCHEME.match(text):
            raise element.error(f"{text!r} is not an IRI")
        return text

    def _anonymous(self, element: _Element) -> BNode:
        return self.names.anonymous(element.needed("nodeID").removeprefix("_:"))

    def _literal(self, element: _Element, text: str) -> Literal:
        """A literal; the text of a plain one holds no ``@en``, unlike in functional syntax."""
        datatype = element.attributes.get("datatypeIRI")
        language = element.attributes.get(_XML + "lang")
        kind = URIRef(self._full(element, datatype)) if datatype else RDF.PlainLiteral
        if language and kind in (RDF.PlainLiteral, RDF.langString):
            return self.names.tagged(text, language, element.line)
        return self.names.typed(text, XSD.string if kind == RDF.PlainLiteral else kind)
