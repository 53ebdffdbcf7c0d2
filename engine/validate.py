"""Validate maps in RDF against SHACL shapes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

from symboslam.engine.writers.rdf_files import read_graph, union_of
from symboslam.errors import InputError, MissingExtraError

if TYPE_CHECKING:
    from rdflib import Graph
    from rdflib.term import Node


@dataclass(frozen=True)
class Violation:
    """Something that a shape does not allow.

    Attributes:
        node: IRI or blank node that is wrong.
        message: what is wrong with it, in words.
        value: the value that is wrong; empty where something is missing.
        path: the property that is wrong, as a SPARQL path where it is more than one; empty where
            the node as a whole is.
        within: of a blank node, the nearest node with an IRI that leads to it, if there is one.
    """

    node: str
    message: str
    value: str = ""
    path: str = ""
    within: str = ""

    def __str__(self) -> str:
        node = f"{self.within} (a part of it without a name)" if self.within else self.node
        found = f" Found: {self.value}" if self.value not in ("", self.node) else ""
        return ": ".join(part for part in (node, self.path, self.message) if part) + found


@dataclass(frozen=True)
class ShapesReport:
    """What validation found.

    Attributes:
        violations: in the order of node and message; none if the map is valid.
    """

    violations: tuple[Violation, ...]

    @property
    def conforms(self) -> bool:
        """Whether the map is valid."""
        return not self.violations

    def __str__(self) -> str:
        if self.conforms:
            return "The map conforms to the shapes."
        count = len(self.violations)
        head = f"{count} violation{'' if count == 1 else 's'}:"
        return "\n".join([head, *map(str, self.violations)])


def validate_map(map_or_path: Graph | str | Path, shapes: str | Path | None = None) -> ShapesReport:
    """Check a map in RDF against the shapes in ``ontology/shapes``, or against others.

    Args:
        map_or_path: a graph (of a dataset, the union of its graphs counts), or a Turtle,
            N-Triples or N-Quads file.
        shapes: a file of other shapes, of the same formats; None for the bundled ones.

    Raises:
        InputError: a file cannot be read, does not parse, or holds no usable shapes.
        MissingExtraError: pySHACL is not installed.
    """
    try:
        from pyshacl import validate
        from pyshacl.errors import ReportableRuntimeError, ShapeLoadError
    except ImportError as error:
        raise MissingExtraError("pyshacl", "shapes") from error
    from symboslam.engine.asked_often import AskedOften

    if isinstance(map_or_path, str | Path):
        graph = read_graph(Path(map_or_path))
    else:
        graph = union_of(map_or_path)
    rules = bundled_shapes() if shapes is None else _read_shapes(Path(shapes))
    try:
        _, results, _ = validate(AskedOften(graph), shacl_graph=rules, inference="none")
    except (ReportableRuntimeError, ShapeLoadError) as error:
        raise InputError(f"{shapes or 'the bundled shapes'}: no usable shapes: {error}") from error
    return ShapesReport(tuple(sorted(set(_violations(results, graph)), key=str)))


@cache
def bundled_shapes() -> Graph:
    """The shapes of all files in ``ontology/shapes``."""
    from rdflib import Graph

    found = Graph()
    folder = files("symboslam.ontology") / "shapes"
    for file in sorted(folder.iterdir(), key=lambda entry: entry.name):
        if file.name.endswith(".ttl"):
            found.parse(data=file.read_bytes(), format="turtle")
    return found


def _read_shapes(path: Path) -> Graph:
    """A user's shapes.

    Raises:
        InputError: the file cannot be read, does not parse, or holds no shapes.
    """
    from rdflib import RDF, SH

    found = read_graph(path)
    if not any((None, RDF.type, kind) in found for kind in (SH.NodeShape, SH.PropertyShape)):
        raise InputError(f"{path} holds no SHACL shapes (sh:NodeShape, sh:PropertyShape)")
    return found


def _violations(results: Graph, graph: Graph) -> list[Violation]:
    from rdflib import SH

    def text(result: Node, predicate: Node) -> str:
        found = results.value(result, predicate)
        return "" if found is None else str(found)

    return [
        Violation(
            node=text(result, SH.focusNode),
            message=text(result, SH.resultMessage),
            value=text(result, SH.value),
            path=_path(results, results.value(result, SH.resultPath)),
            within=_within(graph, results.value(result, SH.focusNode)),
        )
        for result in results.objects(None, SH.result)  # details of a result are none of their own
    ]


def _path(results: Graph, path: Node | None) -> str:
    """A property path as SPARQL writes it, with whole IRIs; empty if there is none."""
    from rdflib import RDF, SH, BNode
    from rdflib.collection import Collection

    if not isinstance(path, BNode):
        return "" if path is None else str(path)
    if (path, RDF.first, None) in results:
        return "/".join(_path(results, step) for step in Collection(results, path))
    for form, before, after in (
        (SH.inversePath, "^", ""),
        (SH.zeroOrMorePath, "", "*"),
        (SH.oneOrMorePath, "", "+"),
        (SH.zeroOrOnePath, "", "?"),
    ):
        if (inner := results.value(path, form)) is not None:
            return f"{before}{_path(results, inner)}{after}"
    if (choices := results.value(path, SH.alternativePath)) is not None:
        return f"({'|'.join(_path(results, one) for one in Collection(results, choices))})"
    return str(path)


def _within(graph: Graph, node: Node | None) -> str:
    """The nearest node with an IRI from which statements lead to a blank node."""
    from rdflib import BNode, URIRef

    waiting = [node]
    seen: set[Node | None] = set()
    while waiting:
        here = waiting.pop(0)
        if isinstance(here, URIRef):
            return "" if here == node else str(here)
        if isinstance(here, BNode) and here not in seen:
            seen.add(here)
            waiting += sorted(graph.subjects(None, here), key=str)
    return ""
