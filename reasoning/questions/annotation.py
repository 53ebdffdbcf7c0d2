"""Annotation verifications: SHACL shapes over an ontology and data."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from symboslam.errors import InputError, MissingExtraError, OntologySyntaxError
from symboslam.reasoning.questions.dataset import Dataset
from symboslam.reasoning.questions.rdf import graph_of, read_bytes

DEFAULT_SHAPES = Path(__file__).with_name("annotation-shapes.ttl")
"""What is asked where a verification names no shapes: a label and a definition of every term."""

_SHOWN = 5


def violations(dataset: Dataset, shapes: Sequence[Path]) -> str:
    """What breaks the shapes, in words; empty if nothing does.

    Raises:
        InputError: a file of shapes cannot be read, or is no SHACL.
        MissingExtraError: pySHACL is not installed.
    """
    from rdflib import RDF, SH, Graph

    from symboslam.reasoning.parsing import parse

    try:
        from pyshacl import validate
        from pyshacl.errors import ReportableRuntimeError, ShapeLoadError
    except ImportError as error:
        raise MissingExtraError("pyshacl", "shapes") from error
    rules = Graph()
    for path in shapes or [DEFAULT_SHAPES]:
        try:
            rules += parse(str(path), read_bytes(path))
        except OntologySyntaxError as error:
            raise InputError(str(error)) from error
    data = graph_of(dataset.quads)
    try:
        conforms, report, _ = validate(data, shacl_graph=rules, inference="none", inplace=True)
    except (ShapeLoadError, ReportableRuntimeError) as error:
        names = ", ".join(map(str, shapes))
        raise InputError(f"{names}: it is no SHACL: {error}") from error
    if conforms or not isinstance(report, Graph):
        return ""
    lines = []
    for result in report.subjects(RDF.type, SH.ValidationResult):
        focus = report.value(result, SH.focusNode)
        message = " ".join(str(report.value(result, SH.resultMessage) or "").split())
        lines.append(f"  {focus}: {message}")
    lines.sort()
    number = f"{len(lines)} violation{'' if len(lines) == 1 else 's'}:"
    more = [f"  ... and {len(lines) - _SHOWN} more"] if len(lines) > _SHOWN else []
    return "\n".join((number, *lines[:_SHOWN], *more))
