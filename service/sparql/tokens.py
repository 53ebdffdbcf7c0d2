"""A look at the words of a query or update, without parsing it.

Oxigraph parses, and tells us nothing of what it saw. Three things have to be known before: does the
text ask for something outside (``SERVICE``, ``LOAD``), does it name a dataset of its own, and where
does ``USING`` belong. For the first, doubt is refusal.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

_TOKEN = re.compile(
    r"""
      (?P<space>\s+|\#[^\r\n]*)
    | (?P<iri><(?:[^<>"{}|^`\\\x00-\x20]|\\u[0-9A-Fa-f]{4}|\\U[0-9A-Fa-f]{8})*>)
    | (?P<string>'''(?:'{0,2}(?:[^'\\]|\\.))*+'''|\"\"\"(?:"{0,2}(?:[^"\\]|\\.))*+\"\"\"
        |'(?:[^'\\\r\n]|\\.)*+'|"(?:[^"\\\r\n]|\\.)*+")
    | (?P<variable>[?$][\w\u00B7]+)
    | (?P<language>@[A-Za-z]+(?:-[A-Za-z0-9]+)*)
    | (?P<name>(?:[^\W\d][\w.\u00B7-]*)?:(?:[\w:.\u00B7-]|%[0-9A-Fa-f]{2}|\\.)*)
    | (?P<word>[^\W\d]\w*)
    | (?P<other>.)
    """,
    re.VERBOSE | re.DOTALL,
)
_ABSOLUTE = re.compile(r"<[A-Za-z][A-Za-z0-9+.-]*://")
_CHANGES = {"NOW", "RAND", "UUID", "STRUUID", "BNODE"}
_ESCAPED = re.compile(r"\\(?:u|U0000)00([0-7][0-9A-Fa-f])")
_WHERE = "WHERE"


class Token(NamedTuple):
    """A piece of a query.

    Attributes:
        kind: ``iri``, ``string``, ``variable``, ``language``, ``name``, ``word`` or ``other``.
        text: as it stands.
        start: where it begins.
        depth: how many braces are open around it; a brace is outside of itself.
    """

    kind: str
    text: str
    start: int
    depth: int

    @property
    def end(self) -> int:
        """Where it ends."""
        return self.start + len(self.text)

    @property
    def word(self) -> str:
        """A keyword in capitals; empty for anything else."""
        return self.text.upper() if self.kind == "word" else ""


def tokens(text: str) -> Iterator[Token]:
    """The tokens of a text; spaces and comments are left out."""
    depth = 0
    for found in _TOKEN.finditer(text):
        kind = found.lastgroup
        assert kind is not None
        if kind == "space":
            continue
        piece = found.group()
        depth -= piece == "}"
        yield Token(kind, piece, found.start(), depth)
        depth += piece == "{"


def asks_for(text: str, keyword: str) -> bool:
    """Whether a text may have a keyword that must not be in it.

    Oxigraph needs no space around keywords, and takes ``<b#>`` for an IRI in one place and for
    "less than b" with a comment in another. So a word that merely contains the keyword counts, and
    where such an IRI makes it doubtful what is in quotes, so does one in quotes. Other stores than
    Oxigraph read the code point of an S as that everywhere (SPARQL 1.1, 19.2): it counts both ways.

    >>> asks_for("SELECT ?service { ?s ?p 'SERVICE' }", "SERVICE")
    False
    >>> asks_for("ASK { ?s ?p 1SERVICE<http://example.org/>{} }", "SERVICE")
    True
    """
    if (plain := _unescaped(text)) != text and asks_for(plain, keyword):
        return True
    keyword = keyword.lower()
    if keyword not in text.lower():
        return False
    for token in tokens(text):
        lower = token.text.lower()
        if token.kind == "word" and keyword in lower:
            return True
        if token.kind == "name" and (keyword + ":" in lower or "." + keyword in lower):
            return True
        if token.kind == "iri" and re.search("[#']", lower) and not _ABSOLUTE.match(lower):
            return True
        if token.kind == "other" and lower in "'\"":
            return True
    return False


def _unescaped(text: str) -> str:
    """A text with the ASCII characters that are written by their code points."""
    return _ESCAPED.sub(lambda found: chr(int(found[1], 16)), text)


def has_dataset(query: str) -> bool:
    """Whether a query has ``FROM`` clauses.

    >>> has_dataset("SELECT * FROM <http://example.org/g> { ?s ?p ?o }")
    True
    """
    if "FROM" not in query.upper():
        return False
    return any(token.word == "FROM" and token.depth == 0 for token in tokens(query))


def is_stable(query: str) -> bool:
    """Whether a query gives the same result as long as the data are the same."""
    upper = query.upper()
    if not any(word in upper for word in _CHANGES):
        return True
    return not any(token.word in _CHANGES for token in tokens(query))


def undeclared_prefixes(text: str) -> list[str]:
    """Prefixes that are used and not declared, in their order; Oxigraph does not say so.

    >>> undeclared_prefixes("ASK { ?s rdfs:label 'x' }")
    ['rdfs:']
    """
    declared, used = {"_:"}, []
    before = ""
    for token in tokens(text):
        if token.kind == "name":
            prefix = token.text.partition(":")[0] + ":"
            if before == "PREFIX":
                declared.add(prefix)
            elif prefix not in declared and prefix not in used:
                used.append(prefix)
        before = token.word
    return used


class DatasetConflictError(ValueError):
    """The dataset is given twice: by the request and by the update."""


def with_using(update: str, default: tuple[str, ...], named: tuple[str, ...]) -> str:
    """An update whose patterns look into the graphs that a request names (Protocol, 2.2.3).

    Args:
        update: the text.
        default: graphs of ``using-graph-uri``.
        named: graphs of ``using-named-graph-uri``.

    Raises:
        DatasetConflictError: the update has ``USING`` or ``WITH`` itself.

    >>> with_using("DELETE WHERE { ?s ?p 1 }", ("http://example.org/g",), ())
    'DELETE { ?s ?p 1 } USING <http://example.org/g> WHERE { ?s ?p 1 }'
    """
    if not default and not named:
        return update
    clauses = "".join(f"USING <{g}> " for g in default)
    clauses += "".join(f"USING NAMED <{g}> " for g in named)
    outer = [token for token in tokens(update) if token.depth == 0]
    result, done, before = [], 0, ""
    for place, token in enumerate(outer):
        if token.word in ("USING", "WITH"):
            raise DatasetConflictError(token.word)
        if token.word == _WHERE:
            result.append(update[done : token.start])
            done = token.start
            if before == "DELETE":  # the short form: the pattern is also the template
                closing = [t for t in outer[place:] if t.text == "}"]
                if closing:
                    result.append(update[token.end : closing[0].end].strip() + " ")
            result.append(clauses)
        before = token.word
    result.append(update[done:])
    return "".join(result)
