"""Read RDF files of any usual format into triples of pyoxigraph; nothing outside is fetched."""

from __future__ import annotations

import codecs
import gzip
import re
import zlib
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from pyoxigraph import Quad, RdfFormat, parse

from symboslam.errors import InputError

if TYPE_CHECKING:
    from rdflib import Graph

_FORMATS = {
    ".ttl": RdfFormat.TURTLE,
    ".nt": RdfFormat.N_TRIPLES,
    ".nq": RdfFormat.N_QUADS,
    ".trig": RdfFormat.TRIG,
}
_GUARDED = (".rdf", ".owl", ".xml", ".jsonld", ".json", ".owx")  # may ask for something outside
_MANY_BYTES = 2_000_000_000  # unpacked; more is taken for a trap
_PLACE = re.compile(r"^Parser error (?:at|between)? ?line (\d+)[^:]*: |\s*\(line \d+\)$")


def read_bytes(path: Path) -> bytes:
    """The content of a file, unpacked if its name ends in ``.gz``.

    Raises:
        InputError: it cannot be read or unpacked.
    """
    try:
        if path.suffix.lower() != ".gz":
            return path.read_bytes()
        with gzip.open(path) as packed:
            data = packed.read(_MANY_BYTES + 1)
    except (EOFError, zlib.error, gzip.BadGzipFile) as error:
        raise InputError(f"{path}: it cannot be unpacked: {error}") from error
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or error}") from error
    if len(data) > _MANY_BYTES:
        raise InputError(f"{path}: it is too large when unpacked")
    return data


def read_text(path: Path) -> str:
    """The content of a text file.

    Raises:
        InputError: it cannot be read, is not UTF-8, or starts with a byte-order mark.
    """
    data = read_bytes(path)
    refuse_byte_order_mark(path, data)
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise InputError(f"{path}: line {line}: it is not UTF-8 text") from error


def refuse_byte_order_mark(path: Path, data: bytes) -> None:
    """Refuse what neither Turtle nor SPARQL allows at the start of a file.

    Raises:
        InputError: the file starts with a byte-order mark.
    """
    if data.startswith((codecs.BOM_UTF8, codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        raise InputError(
            f"{path}: line 1: it starts with a byte-order mark; save it as UTF-8 without one"
        )


def read_quads(path: Path, rename: bool = True) -> list[Quad]:
    """The statements of a file; IRIs in it are relative to the file.

    Args:
        path: the file; its name tells the format, after ``.gz`` is taken off.
        rename: give anonymous nodes fresh names, so that files can be put together.

    Raises:
        InputError: it cannot be read, or does not parse.
    """
    data = read_bytes(path)
    kind = Path(path.stem if path.suffix.lower() == ".gz" else path.name).suffix.lower()
    if kind in _GUARDED:
        return _read_guarded(path, data)
    if kind not in _FORMATS:
        known = ", ".join((*_FORMATS, *_GUARDED))
        raise InputError(f"{path}: {kind or 'no ending'} is no known RDF format; known: {known}")
    refuse_byte_order_mark(path, data)
    return parse_quads(data, path, _FORMATS[kind], rename=rename)


def parse_quads(
    data: bytes, path: Path, kind: RdfFormat, *, first_line: int = 1, rename: bool = True
) -> list[Quad]:
    """The statements of a text that stands in ``path``, from ``first_line`` on.

    Raises:
        InputError: it does not parse.
    """
    base = path.resolve().as_uri()
    try:
        return list(parse(data, kind, base_iri=base, rename_blank_nodes=rename))
    except SyntaxError as error:
        line = first_line - 1 + (error.lineno or 1)
        raise InputError(f"{path}: line {line}: {explain(error)}") from error
    except ValueError as error:
        raise InputError(f"{path}: {error}") from error


def explain(error: SyntaxError) -> str:
    """What pyoxigraph says is wrong, without the place, on one line."""
    text = " ".join(_PLACE.sub("", str(error.msg or error)).split())
    return text if len(text) <= 200 else text[:200] + " ..."


def quads_of(graph: Graph) -> list[Quad]:
    """The triples of an rdflib graph; anonymous nodes keep their names."""
    text = graph.serialize(format="nt", encoding="utf-8")
    return list(parse(text, RdfFormat.N_TRIPLES, lenient=True))


def graph_of(quads: Iterable[Quad]) -> Graph:
    """An rdflib graph of the statements in the default graph."""
    from pyoxigraph import DefaultGraph, serialize
    from rdflib import Graph

    default = DefaultGraph()
    triples = {quad.triple for quad in quads if quad.graph_name == default}
    text = serialize(triples, format=RdfFormat.N_TRIPLES)
    graph = Graph()
    graph.parse(data=text, format="nt")
    return graph


def _read_guarded(path: Path, data: bytes) -> list[Quad]:
    from symboslam.errors import OntologySyntaxError
    from symboslam.reasoning.parsing import parse as parse_guarded

    name = str(path.with_suffix("") if path.suffix.lower() == ".gz" else path)
    try:
        return quads_of(parse_guarded(name, data))
    except OntologySyntaxError as error:
        raise InputError(str(error)) from error
