"""Where an import leads: to a file beside the importing one, or in a circle; never the network."""

from __future__ import annotations

from collections.abc import Mapping
from graphlib import CycleError, TopologicalSorter
from itertools import pairwise
from pathlib import Path
from typing import TypeVar
from urllib.parse import unquote, urlsplit

from symboslam.errors import OntologySyntaxError
from symboslam.reasoning.vocabulary import local_name

CATALOG = "catalog-v001.xml"
"""The OASIS XML catalog that Protégé and ROBOT keep beside an ontology."""

_CATALOG_ENTRY = "{urn:oasis:names:tc:entity:xmlns:xml:catalog}uri"
_LARGEST_NEIGHBOUR = 20_000_000  # bytes; a larger file beside an ontology is not looked into

W = TypeVar("W")


def find_in_catalog(path: Path, iri: str) -> Path | None:
    """The file that the catalog beside ``path`` names for the import ``iri``, if it exists.

    Raises:
        OntologySyntaxError: the catalog is not XML.
    """
    from xml.etree import ElementTree

    catalog = path.parent / CATALOG
    if not catalog.is_file():
        return None
    try:
        tree = ElementTree.parse(catalog)
    except ElementTree.ParseError as error:
        line = error.position[0]
        raise OntologySyntaxError(f"{catalog}: line {line}: it is no XML catalog") from error
    for entry in tree.iter(_CATALOG_ENTRY):
        target = urlsplit(entry.get("uri", ""))
        if entry.get("name") == iri and target.scheme in ("", "file"):
            found = catalog.parent / unquote(target.path)
            if found.is_file():
                return found
    return None


def find_beside(path: Path, iri: str) -> Path | None:
    """The file beside ``path`` that holds the ontology ``iri``: by name, or by what it declares."""
    from symboslam.reasoning.parsing import EXTENSIONS

    try:
        beside = sorted(p for p in path.parent.iterdir() if p.suffix.lower() in (*EXTENSIONS, ""))
        names = [local_name(iri) + extension for extension in ("", *EXTENSIONS)]
        found = [p for name in names for p in beside if p.name == name and p.is_file()]
        return next(iter(found), None) or next((p for p in beside if _holds(p, iri)), None)
    except OSError:
        return None


def _holds(path: Path, iri: str) -> bool:
    """Whether a file declares the ontology, or the version of one, that is called ``iri``."""
    if not path.is_file() or path.stat().st_size > _LARGEST_NEIGHBOUR:
        return False
    data = path.read_bytes()
    if iri.encode() not in data:
        return False
    from rdflib import OWL, RDF, URIRef

    from symboslam.reasoning.parsing import parse

    try:
        graph, name = parse(path.name, data), URIRef(iri)
    except OntologySyntaxError:
        return False
    return (name, RDF.type, OWL.Ontology) in graph or (None, OWL.versionIRI, name) in graph


def find_circle(imports: Mapping[str, Mapping[str, W]]) -> list[tuple[str, W]]:
    """Files that import each other in a circle, each with what the map says of its import.

    Args:
        imports: file -> the files that it imports -> anything.
    """
    try:
        TopologicalSorter(imports).prepare()
    except CycleError as error:
        # The circle comes in reading order: each file is imported by the next.
        circle = list(reversed(error.args[1]))
        return [(to, imports[file][to]) for file, to in pairwise(circle)]
    return []
