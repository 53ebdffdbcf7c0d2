"""RDF files read into a graph, whatever their syntax."""

from __future__ import annotations

import warnings
from pathlib import Path
from typing import TYPE_CHECKING

from symboslam.errors import InputError

if TYPE_CHECKING:
    from rdflib import Graph

SYNTAXES = {".ttl": "turtle", ".nt": "turtle", ".nq": "nquads"}


def read_graph(path: Path) -> Graph:
    """All statements of a Turtle, N-Triples or N-Quads file; of the latter, of all its graphs.

    Raises:
        InputError: it cannot be read, does not parse, or has another ending.
    """
    from rdflib import Dataset, Graph
    from rdflib.exceptions import ParserError

    syntax = SYNTAXES.get(path.suffix.lower())
    if syntax is None:
        raise InputError(f"{path}: RDF is read from files that end in {', '.join(SYNTAXES)}")
    graph: Graph = Dataset() if syntax == "nquads" else Graph()
    try:
        with warnings.catch_warnings():  # rdflib's N-Quads parser uses what rdflib deprecates
            warnings.filterwarnings("ignore", "Dataset.default_context", DeprecationWarning)
            graph.parse(data=path.read_bytes(), format=syntax)
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror or error}") from error
    except Exception as error:  # rdflib's parsers raise errors of many unrelated types
        told = isinstance(error, SyntaxError | ParserError)
        problem = str(error).strip() if told else "it is damaged or cut short"
        raise InputError(f"{path} does not parse: {problem}") from error
    return union_of(graph)


def union_of(graph: Graph) -> Graph:
    """The graph itself, or all statements of a dataset, whatever named graphs they are in."""
    from rdflib import Dataset, Graph

    if not isinstance(graph, Dataset):
        return graph
    union = Graph()
    for subject, predicate, value, _ in graph.quads():
        union.add((subject, predicate, value))
    return union
