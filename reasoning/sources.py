"""Find, hash and merge the files of an ontology; imports are only looked for locally."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING

from symboslam.errors import InputError, OntologySyntaxError
from symboslam.reasoning.vocabulary import DOCUMENTS, local_name

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable

    from rdflib import Graph

_BUNDLED_ALIGNMENTS = ("symboslam-2022.ttl",)  # old names; the others say nothing about features
MISSING = "missing"
"""Stands in a list of digests for an import that was not found."""

_LARGEST_NEIGHBOUR = 20_000_000  # bytes; a larger file beside an ontology is not looked into


@dataclass
class Sources:
    """A merged ontology and where it came from.

    Attributes:
        graph: all triples of all files.
        files: name -> SHA-256 of each user file and each file found for an import.
        missing: IRIs of imports that were not found, and so are left out.
    """

    graph: Graph
    files: dict[str, str] = field(default_factory=dict)
    missing: tuple[str, ...] = ()

    @property
    def digests(self) -> dict[str, str]:
        """``files``, and the missing imports marked as such."""
        return {**self.files, **dict.fromkeys(self.missing, MISSING)}


def bundled_files() -> dict[str, Traversable]:
    """Name -> file of each module of the bundled ontology: its top folder, and the old names."""
    from importlib.resources import files

    folder = files("symboslam.ontology")
    found = {entry.name: entry for entry in folder.iterdir() if entry.name.endswith(".ttl")}
    for name in _BUNDLED_ALIGNMENTS:
        alignment = folder / "alignments" / name
        if alignment.is_file():
            found[f"alignments/{name}"] = alignment
    return dict(sorted(found.items()))


def digest(data: bytes) -> str:
    """SHA-256 of a file's content; line ends do not count, so a checkout on Windows is equal."""
    return sha256(data.replace(b"\r\n", b"\n")).hexdigest()


def combined_digest(digests: dict[str, str]) -> str:
    """SHA-256 over names and digests of several files, in the order of their names."""
    lines = (f"{name} {value}\n" for name, value in sorted(digests.items()))
    return sha256("".join(lines).encode()).hexdigest()


def bundled_hash() -> str:
    """SHA-256 of the bundled ontology: of the names and contents of all its modules."""
    return combined_digest({n: digest(f.read_bytes()) for n, f in bundled_files().items()})


def read_bundled() -> Sources:
    """The bundled ontology, merged."""
    from rdflib import Graph

    from symboslam.reasoning.parsing import parse

    graph, digests = Graph(), {}
    for name, file in bundled_files().items():
        data = file.read_bytes()
        digests[name] = digest(data)
        graph += parse(name, data)
    return Sources(graph, digests)


def read_bytes(path: Path) -> bytes:
    """A user's file.

    Raises:
        InputError: it cannot be read.
    """
    try:
        return path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or error}") from error


def read_files(paths: Iterable[Path]) -> Sources:
    """A user's ontology: the files, what they import, and always the bundled core.

    An import is looked for among the bundled modules (``https://w3id.org/symboslam/places`` is
    ``places.ttl``) and among the files beside the importing one: by the last part of its IRI, then
    by the ontology IRI that a file declares. The network is never asked.

    Raises:
        InputError: a file cannot be read.
        OntologySyntaxError: a file does not parse.
    """
    from rdflib import OWL, RDF, Graph

    from symboslam.reasoning.parsing import parse

    paths = list(paths)
    bundled = bundled_files()
    graph, digests = Graph(), {}
    missing: list[str] = []
    read: set[str] = set()
    imported = {"core.ttl"}  # bundled modules that are wanted
    waiting = list(paths)
    while waiting or imported - read:
        if waiting:
            path = waiting.pop()
            name, data = str(path.resolve()), read_bytes(path)
            if name in read:
                continue
            digests[_relative(path, paths)] = digest(data)
        else:
            path, name = None, min(imported - read)
            data = bundled[name].read_bytes()
        read.add(name)
        one = parse(str(path) if path else name, data)
        graph += one
        for target in sorted({str(o) for o in one.objects(None, OWL.imports)}):
            module = f"{target.removeprefix(DOCUMENTS)}.ttl"
            if target.startswith(DOCUMENTS) and module in bundled:
                imported.add(module)
            elif path and (neighbour := _find_beside(path, target)):
                waiting.append(neighbour)
            else:
                missing.append(target)
    present = {*graph.subjects(RDF.type, OWL.Ontology), *graph.objects(None, OWL.versionIRI)}
    return Sources(graph, digests, tuple(sorted(set(missing) - {str(iri) for iri in present})))


def _relative(path: Path, given: list[Path]) -> str:
    """The name of a file in a list of digests: its place relative to the first given file."""
    from os.path import relpath

    return Path(relpath(path.resolve(), given[0].resolve().parent)).as_posix()


def _find_beside(path: Path, iri: str) -> Path | None:
    """The file beside ``path`` that holds the ontology ``iri``."""
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


def unchanged(digests: dict[str, str], given: list[Path]) -> bool:
    """Whether a list of digests still holds: equal files, and what was missing still is."""
    folder = given[0].resolve().parent
    try:
        return all(
            all(_find_beside(path, name) is None for path in given)
            if value == MISSING
            else digest((folder / name).read_bytes()) == value
            for name, value in digests.items()
        )
    except OSError:
        return False
