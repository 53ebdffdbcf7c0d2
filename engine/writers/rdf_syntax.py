"""Turtle and N-Quads, written statement by statement: maps are too large to hold as a graph.

Both classes take the same calls, so one description of a map serves both; see ``rdf.py``.
"""

from __future__ import annotations

import hashlib
import re
from abc import ABC, abstractmethod
from functools import lru_cache
from typing import TypeAlias
from urllib.parse import quote

XSD = "http://www.w3.org/2001/XMLSchema#"
RDF_TYPE = "http://www.w3.org/1999/02/22-rdf-syntax-ns#type"

Properties: TypeAlias = "list[tuple[str, list[str | Properties]]]"
"""Predicates with their values; a value is a term, or the properties of a blank node."""

ABSOLUTE_IRI = re.compile(r'[A-Za-z][A-Za-z0-9+.-]*:[^\x00-\x20<>"{}|^`\\]+')
_NOT_IN_IRIS = re.compile(r'[\x00-\x20<>"{}|^`\\]')
_NOT_IN_TEXT = re.compile(r'[\x00-\x1f"\\\x7f\ud800-\udfff]')
_ESCAPED = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\r": "\\r", "\t": "\\t"}
_LOCAL_NAME = re.compile(r"[A-Za-z0-9_](?:(?:[\w.-]|%[0-9A-F]{2})*(?:[\w-]|%[0-9A-F]{2}))?", re.A)


def _escape(character: re.Match[str]) -> str:
    found = character.group()
    if "\ud800" <= found <= "\udfff":  # half of a pair, which no RDF document can hold
        return "\ufffd"
    return _ESCAPED.get(found, f"\\u{ord(found):04X}")


class Syntax(ABC):
    """How terms and statements look.

    Args:
        base: IRI below which the map's own IRIs lie.
        prefixes: prefix -> namespace.
    """

    _type = f"<{RDF_TYPE}>"

    def __init__(self, base: str, prefixes: dict[str, str]) -> None:
        self.base, self.prefixes = base, prefixes
        self._terms: dict[str, str] = {RDF_TYPE: self._type}

    def iri(self, iri: str) -> str:
        """An IRI of a vocabulary; few and often used, so they are remembered."""
        term = self._terms.get(iri)
        if term is None:
            clean = _NOT_IN_IRIS.sub(lambda c: quote(c.group()), iri)
            term = self._terms[iri] = self._reference(clean)
        return term

    def own(self, kind: str, name: str | None = None) -> str:
        """The IRI of something in the map: ``base`` + kind, or ``base`` + kind/name."""
        tail = "" if name is None else f"/{quote(name, safe='', errors='replace')}"
        return self._reference(f"{self.base}{kind}{tail}")

    def text(self, text: str, language: str = "") -> str:
        """A text."""
        return f'"{_NOT_IN_TEXT.sub(_escape, text)}"' + (f"@{language}" if language else "")

    def typed(self, text: str, datatype: str) -> str:
        """A literal of a datatype; ``text`` must fit it."""
        return f"{self.text(text)}^^{self.iri(datatype)}"

    @abstractmethod
    def _reference(self, iri: str) -> str:
        """A valid IRI as a term."""

    @abstractmethod
    def decimal(self, digits: str) -> str:
        """A decimal number, given as digits with a point."""

    @abstractmethod
    def integer(self, number: int) -> str:
        """A whole number."""

    @abstractmethod
    def head(self) -> str:
        """What stands at the beginning of the file."""

    @abstractmethod
    def statements(self, graph: str, subject: str, properties: Properties) -> str:
        """All that is said of a subject.

        Args:
            graph: term of the named graph that it belongs to.
            subject: a term.
            properties: predicates and values; nested lists become blank nodes.
        """


class Turtle(Syntax):
    """Turtle: prefixes, nested blank nodes; it has no named graphs."""

    _type = "a"

    def _reference(self, iri: str) -> str:
        for prefix, namespace in self.prefixes.items():
            if iri.startswith(namespace) and _LOCAL_NAME.fullmatch(iri, len(namespace)):
                return f"{prefix}:{iri[len(namespace) :]}"
        return f"<{iri}>"

    def decimal(self, digits: str) -> str:
        """Turtle reads 0.5 as xsd:decimal."""
        return digits

    def integer(self, number: int) -> str:
        """Turtle reads 5 as xsd:integer."""
        return str(number)

    def head(self) -> str:
        """The prefixes."""
        return "".join(f"@prefix {p}: <{n}> .\n" for p, n in self.prefixes.items()) + "\n"

    def statements(self, graph: str, subject: str, properties: Properties) -> str:
        """One paragraph a subject."""
        return f"{subject} {self._pairs(properties, f' ;{_INDENT}')} .\n\n"

    def _pairs(self, properties: Properties, between: str) -> str:
        texts = []
        for predicate, values in properties:
            objects = [v if isinstance(v, str) else f"[ {self._pairs(v, ' ; ')} ]" for v in values]
            texts.append(f"{predicate} {f',{_INDENT}    '.join(objects)}")
        return between.join(texts)


class NQuads(Syntax):
    """N-Quads: a line a statement, each with its graph."""

    def _reference(self, iri: str) -> str:
        return f"<{iri}>"

    def decimal(self, digits: str) -> str:
        """A decimal number with its datatype."""
        return f'"{digits}"^^<{XSD}decimal>'

    def integer(self, number: int) -> str:
        """A whole number with its datatype."""
        return f'"{number}"^^<{XSD}integer>'

    def head(self) -> str:
        """Nothing."""
        return ""

    def statements(self, graph: str, subject: str, properties: Properties) -> str:
        """Lines; blank nodes are named after their subject, so that files can be compared."""
        return "".join(self.lines(graph, subject, properties))

    def lines(self, graph: str, subject: str, properties: Properties) -> list[str]:
        """The lines of `statements`."""
        lines: list[str] = []
        root, end = subject, f" {graph} .\n"
        count = 0

        def add(subject: str, properties: Properties) -> None:
            nonlocal count
            for predicate, values in properties:
                for value in values:
                    if isinstance(value, str):
                        lines.append(f"{subject} {predicate} {value}{end}")
                    else:
                        count += 1
                        blank = self._node(root, count)
                        lines.append(f"{subject} {predicate} {blank}{end}")
                        add(blank, value)

        add(subject, properties)
        return lines

    def _node(self, subject: str, number: int) -> str:
        """A blank node of a subject."""
        return f"_:b{_digest(subject)}n{number}"


class Skolemised(NQuads):
    """N-Quads with an IRI in the place of each blank node (RDF 1.1 Concepts, 3.5).

    So that stores can take back what was stated. The IRIs lie below the map's base.
    """

    def _node(self, subject: str, number: int) -> str:
        return f"<{self.base}.well-known/genid/{_digest(subject)}-{number}>"


_INDENT = "\n    "


@lru_cache(maxsize=4)
def _digest(subject: str) -> str:
    return hashlib.sha256(subject.encode()).hexdigest()[:12]
