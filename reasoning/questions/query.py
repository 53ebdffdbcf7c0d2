"""A SPARQL query: its syntax, its terms, and the answers of a store to it."""

from __future__ import annotations

import re
from collections.abc import Container, Iterable, Iterator
from functools import lru_cache
from typing import Any

from pyoxigraph import QueryBoolean, QuerySolutions, Store

from symboslam.errors import InputError
from symboslam.reasoning.questions import vocabulary as v
from symboslam.reasoning.questions.model import Answer, Query, Table, Triples
from symboslam.reasoning.vocabulary import local_name

_TEXT_ONLY = (
    r'"""(?:[^"\\]|\\.|"(?!""))*"""|'
    r"'''(?:[^'\\]|\\.|'(?!''))*'''|"
    r'"(?:[^"\\\n]|\\.)*"|'
    r"'(?:[^'\\\n]|\\.)*'"
)
_TEXT = re.compile(rf"{_TEXT_ONLY}|" r'<[^<>"{}|^`\\\s]*>|#[^\n]*', re.DOTALL)
_NAME = r"(?:[\w.:-]|%[0-9A-Fa-f]{2}|\\[-_~.!$&'()*+,;=/?#@%])*(?:[\w:-]|%[0-9A-Fa-f]{2}|\\.)"
_IRI = re.compile(
    r"#[^\n]*|"
    rf"{_TEXT_ONLY}|"
    r'<(?P<iri>[^<>"{}|^`\\\s]*)>|'
    r"[?$]\w+|@[A-Za-z-]+|_:[\w.-]+|"
    rf"(?P<prefix>[^\W\d_][\w.-]*|):(?P<name>{_NAME}|)",
    re.DOTALL,
)
_SERVICE = re.compile(r"(?<![\w:?$@.-])SERVICE(?![\w:-])", re.IGNORECASE)
_BASE = re.compile(r"\bBASE\b", re.IGNORECASE)
_PLACE = re.compile(r"^error at (\d+):(\d+): ")
_PREFIX = re.compile(r"PREFIX\s+([^\s:]*):\s*<([^>\s]*)>", re.IGNORECASE)


def check_syntax(query: Query) -> None:
    """Refuse a query that is not SPARQL, or that asks another server.

    Raises:
        InputError: names the file and the line.
    """
    bare = _bare(query.text)
    if service := _SERVICE.search(bare):
        line = bare[: service.start()].count("\n") + 1
        raise _error(query, line, "SERVICE asks another server, which is not done here")
    try:
        Store().query(query.text, prefixes=dict(query.prefixes), base_iri=_base(query))
    except SyntaxError as error:
        raise _error(query, *_explained(query, str(error.msg or error))) from error
    except ValueError as error:
        raise _error(query, 1, str(error)) from error


def _explained(query: Query, said: str) -> tuple[int, str]:
    """Line and problem of a syntax error; pyoxigraph's own words do not tell of prefixes."""
    prefixes = prefixes_of(query)
    text = _TEXT.sub(_blank, _PREFIX.sub(_blank, query.text))
    for found in _IRI.finditer(text):
        if (name := found["prefix"]) is not None and name not in prefixes:
            line = text.count("\n", 0, found.start()) + 1
            return line, f"the prefix {name}: is not declared ({found[0]})"
    place = _PLACE.match(said)
    problem = " ".join(_PLACE.sub("", said).split())
    if len(problem) > 160:
        problem = problem[:160] + " ..."
    return int(place[1]) if place else 1, f"it is not SPARQL: {problem}"


def _blank(found: re.Match[str]) -> str:
    """As many lines as the match has, and nothing else."""
    return " " + "\n" * found[0].count("\n")


def ask(query: Query, store: Store) -> Answer:
    """What a store answers.

    Raises:
        InputError: the query fails while it is being answered.
    """
    try:
        found = store.query(query.text, prefixes=dict(query.prefixes), base_iri=_base(query))
        if isinstance(found, QueryBoolean):
            return bool(found)
        if isinstance(found, QuerySolutions):
            columns = tuple(variable.value for variable in found.variables)
            rows = tuple(tuple(row[i] for i in range(len(columns))) for row in found)
            return Table(columns, rows)
        return Triples(tuple(found))
    except (OSError, RuntimeError, SyntaxError, ValueError) as error:
        raise InputError(f"{query.file}: {error}") from error


def is_ordered(query: Query) -> bool:
    """Whether the order of the rows counts: there is an ORDER BY outside all braces."""
    depth, outside = 0, []
    for part in re.split(r"([{}])", _bare(query.text)):
        depth += {"{": 1, "}": -1}.get(part, 0)
        if depth == 0:
            outside.append(part)
    return bool(re.search(r"\bORDER\s+BY\b", " ".join(outside), re.IGNORECASE))


def prefixes_of(query: Query) -> dict[str, str]:
    """Prefix -> namespace, as the query has them."""
    return {**dict(query.prefixes), **dict(_PREFIX.findall(_without_comments(query.text)))}


def unknown_terms(query: Query, known: Container[str]) -> list[str]:
    """IRIs that a query looks for and that are not known; see :func:`terms_of`."""
    # Parsing takes rdflib long, and where every name in the text is known there is no need to.
    if all(iri in known or iri.startswith(v.BUILT_IN) for iri in _names(query)):
        return []
    return sorted(iri for iri in terms_of(query) or () if iri not in known)


def _names(query: Query) -> Iterator[str]:
    """Every IRI in the text of a query, those of prefixes and of functions included."""
    prefixes = prefixes_of(query)
    text = _PREFIX.sub(" ", _without_comments(query.text))
    if _BASE.search(text):
        yield ""  # IRIs may be relative to anything
    for found in _IRI.finditer(text):
        if found["iri"] is not None:
            yield found["iri"]
        elif found["prefix"] is not None:
            yield prefixes.get(found["prefix"], "") + re.sub(r"\\(.)", r"\1", found["name"])


@lru_cache(maxsize=512)
def terms_of(query: Query) -> frozenset[str] | None:
    """IRIs that a query looks for; None if they cannot be told.

    They stand in triple patterns, paths, graph names and VALUES, or are compared with ``=``,
    ``!=`` or ``IN``. Names of functions, arguments of functions and datatypes are none.
    """
    from rdflib.plugins.sparql.algebra import translateQuery
    from rdflib.plugins.sparql.parser import parseQuery

    try:
        parsed = translateQuery(
            parseQuery(query.text), base=_base(query), initNs=dict(query.prefixes)
        )
    except Exception:  # pyoxigraph has accepted it: a construct that rdflib does not know
        return None
    # rdflib leaves the backslashes of escaped prefixed names in.
    found = (re.sub(r"\\(.)", r"\1", term) for term in _terms(parsed.algebra))
    return frozenset(term for term in found if not term.startswith(v.BUILT_IN))


def _terms(node: Any) -> Iterator[str]:
    """IRIs below a node of rdflib's algebra."""
    from rdflib.plugins.sparql.parserutils import CompValue

    if isinstance(node, CompValue):
        if node.name in ("BGP", "TriplesBlock"):
            yield from _pattern(node.triples)
        elif node.name in ("Graph", "GraphGraphPattern"):
            yield from _pattern([node.term])
        elif node.name == "values":
            yield from _pattern([list(row.values()) for row in node.res])
        elif node.name == "InlineData":
            yield from _pattern([node.value])
        elif node.name == "RelationalExpression" and node.op in ("=", "!=", "IN", "NOT IN"):
            if not _is_datatype(node.expr) and not _is_datatype(node.other):
                yield from _pattern([node.expr, node.other])
        elif node.name == "DescribeQuery":
            yield from _pattern([node.PV])
        below: Iterable[Any] = (
            value
            for key, value in node.items()
            if key not in ("_vars", "triples", "template", "datasetClause")
        )
    elif isinstance(node, list | tuple | set | frozenset):
        below = node
    else:
        return
    for value in below:
        yield from _terms(value)


def _pattern(parts: Any) -> Iterator[str]:
    """IRIs among terms, paths, and lists of them."""
    from rdflib import URIRef
    from rdflib.paths import AlternativePath, InvPath, MulPath, NegatedPath, Path, SequencePath

    if isinstance(parts, URIRef):
        yield str(parts)
    elif isinstance(parts, list | tuple):
        for part in parts:
            yield from _pattern(part)
    elif isinstance(parts, Path):
        if isinstance(parts, InvPath):
            yield from _pattern(parts.arg)
        elif isinstance(parts, MulPath):
            yield from _pattern(parts.path)
        elif isinstance(parts, SequencePath | AlternativePath | NegatedPath):
            yield from _pattern(list(parts.args))


def _is_datatype(node: Any) -> bool:
    return getattr(node, "name", "") == "Builtin_DATATYPE"


def close_to(term: str, known: Iterable[str]) -> list[str]:
    """Known IRIs whose last part is much like that of ``term``."""
    from difflib import get_close_matches

    names: dict[str, list[str]] = {}
    for iri in sorted(iri for iri in known if not iri.startswith(v.BUILT_IN)):
        names.setdefault(local_name(iri).casefold(), []).append(iri)
    close = get_close_matches(local_name(term).casefold(), names, n=3, cutoff=0.6)
    return [iri for name in close for iri in names[name]][:3]


def _bare(text: str) -> str:
    """The query without texts, IRIs and comments; line ends stay."""
    return _TEXT.sub(_blank, text)


def _without_comments(text: str) -> str:
    return _TEXT.sub(lambda found: "" if found[0].startswith("#") else found[0], text)


def _base(query: Query) -> str:
    return query.file.resolve().as_uri()


def _error(query: Query, line: int, problem: str) -> InputError:
    return InputError(f"{query.file}: line {query.line + line - 1}: {problem}")
