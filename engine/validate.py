"""Validate maps in RDF against the bundled SHACL shapes."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import TYPE_CHECKING

from symboslam.engine.writers.rdf_files import read_graph, union_of
from symboslam.errors import MissingExtraError

if TYPE_CHECKING:
    from rdflib import Graph


@dataclass(frozen=True)
class Violation:
    """Something that a shape does not allow.

    Attributes:
        node: IRI or blank node that is wrong.
        message: what is wrong with it, in words.
        value: the value that is wrong; empty where something is missing.
        path: the property that is wrong; empty where the node as a whole is.
    """

    node: str
    message: str
    value: str = ""
    path: str = ""

    def __str__(self) -> str:
        found = f" Found: {self.value}" if self.value not in ("", self.node) else ""
        return f"{self.node}: {self.message}{found}"


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
        return "\n".join([f"{len(self.violations)} violations:", *map(str, self.violations)])


def validate_map(map_or_path: Graph | str | Path) -> ShapesReport:
    """Check a map in RDF against ``ontology/shapes/map-shapes.ttl``.

    Args:
        map_or_path: a graph (of a dataset, the union of its graphs counts), or a Turtle,
            N-Triples or N-Quads file.

    Raises:
        InputError: the file cannot be read or does not parse.
        MissingExtraError: pySHACL is not installed.
    """
    try:
        from pyshacl import validate
    except ImportError as error:
        raise MissingExtraError("pyshacl", "shapes") from error
    if isinstance(map_or_path, str | Path):
        graph = read_graph(Path(map_or_path))
    else:
        graph = union_of(map_or_path)
    _, results, _ = validate(graph, shacl_graph=_shapes(), inference="none")
    return ShapesReport(tuple(sorted(_violations(results), key=str)))


@cache
def _shapes() -> Graph:
    from rdflib import Graph

    file = files("symboslam.ontology") / "shapes" / "map-shapes.ttl"
    return Graph().parse(data=file.read_bytes(), format="turtle")


def _violations(results: Graph) -> list[Violation]:
    from rdflib import RDF, SH

    def text(result: object, predicate: object) -> str:
        found = results.value(result, predicate)  # type: ignore[call-overload]
        return "" if found is None else str(found)

    return [
        Violation(
            node=text(result, SH.focusNode),
            message=text(result, SH.resultMessage),
            value=text(result, SH.value),
            path=text(result, SH.resultPath),
        )
        for result in results.subjects(RDF.type, SH.ValidationResult)
    ]
