"""RDF files as plain look-up tables: all that reading a map back needs, and quick to fill."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator
from pathlib import Path

from symboslam.engine.writers.vocabulary import RDF
from symboslam.errors import InputError

_TERM = r'<[^<>"{}|^`\\\x00-\x20]*>|_:[^\s<"]+'
_LITERAL = r'"(?:[^"\\\n\r]|\\.)*"(?:@[A-Za-z0-9-]+|\^\^<[^<>]*>)?'
_STATEMENT = re.compile(
    rf"({_TERM})\s*(<[^<>]*>)\s*({_TERM}|{_LITERAL})\s*(?:{_TERM})?\s*\.\s*(?:#.*)?"
)
_NOTHING = re.compile(r"(?:#.*)?")
_ESCAPE = re.compile(r"\\(?:u([0-9A-Fa-f]{4})|U([0-9A-Fa-f]{8})|(.))")
_CHARACTERS = {"t": "\t", "b": "\b", "n": "\n", "r": "\r", "f": "\f"}


class Index:
    """Statements by subject and predicate.

    IRIs and literals are plain texts, blank nodes texts that begin with ``_:``; languages,
    datatypes and named graphs are not kept.

    Args:
        statements: (subject, predicate, value) each.
    """

    def __init__(self, statements: Iterator[tuple[str, str, str]]) -> None:
        self._values: dict[tuple[str, str], list[str]] = defaultdict(list)
        self._subjects: dict[tuple[str, str], list[str]] = defaultdict(list)
        for subject, predicate, value in statements:
            self._values[subject, predicate].append(value)
            self._subjects[predicate, value].append(subject)

    def all(self, subject: str, predicate: str) -> list[str]:
        """All values of a property."""
        return self._values.get((subject, predicate), [])

    def one(self, subject: str, predicate: str) -> str | None:
        """The value of a property, or None."""
        values = self.all(subject, predicate)
        return values[0] if values else None

    def text(self, subject: str, predicate: str) -> str:
        """The value of a property, or an empty text."""
        return self.one(subject, predicate) or ""

    def subjects(self, predicate: str, value: str) -> list[str]:
        """All that have a value as a property."""
        return self._subjects.get((predicate, value), [])

    def of_type(self, kind: str) -> list[str]:
        """All instances of a class."""
        return self.subjects(RDF + "type", kind)


def read_index(path: Path) -> Index:
    """The statements of a Turtle, N-Triples or N-Quads file.

    Raises:
        InputError: it cannot be read or does not parse.
    """
    return Index(_nquads(path) if path.suffix.lower() in (".nq", ".nt") else _turtle(path))


def _turtle(path: Path) -> Iterator[tuple[str, str, str]]:
    """Each statement once, by a parser that is many times as fast as rdflib's."""
    from pyoxigraph import BlankNode, RdfFormat, parse

    if path.suffix.lower() != ".ttl":
        raise InputError(f"{path}: RDF is read from files that end in .ttl, .nt, .nq")
    try:
        text = path.read_bytes()
        quads = {*parse(text, RdfFormat.TURTLE, base_iri=path.resolve().as_uri())}
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror or error}") from error
    except SyntaxError as error:
        raise InputError(f"{path} does not parse: {error.msg}") from error
    for quad in quads:
        terms = (quad.subject, quad.predicate, quad.object)
        subject, predicate, value = (
            str(term) if isinstance(term, BlankNode) else term.value for term in terms
        )
        yield subject, predicate, value


def _nquads(path: Path) -> Iterator[tuple[str, str, str]]:
    """Line by line, several times as fast as a parser that builds a graph."""
    try:
        with path.open(encoding="utf-8") as lines:
            for number, line in enumerate(lines, 1):
                found = _STATEMENT.fullmatch(line.strip())
                if found:
                    subject, predicate, value = map(_plain, found.groups())
                    yield subject, predicate, value
                elif not _NOTHING.fullmatch(line.strip()):
                    raise InputError(f"{path} does not parse: line {number} is no statement")
    except UnicodeDecodeError as error:
        raise InputError(f"{path} does not parse: it is not UTF-8 text") from error
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror or error}") from error


def _plain(term: str) -> str:
    """The text of a term."""
    if term[0] == "_":
        return term
    text = term[1:-1] if term[0] == "<" else term[1 : term.rindex('"')]
    return _ESCAPE.sub(_character, text) if "\\" in text else text


def _character(escape: re.Match[str]) -> str:
    code = escape[1] or escape[2]
    return chr(int(code, 16)) if code else _CHARACTERS.get(escape[3], escape[3])
