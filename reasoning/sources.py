"""Read, hash and merge the files of an ontology and what they import."""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from symboslam.errors import ImportsError, InputError, OntologySyntaxError, UnknownNameError
from symboslam.reasoning.imports import find_beside, find_circle, find_in_catalog
from symboslam.reasoning.vocabulary import DOCUMENTS

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable

    from rdflib import Graph

    from symboslam.reasoning.located import LocatedGraph, Triple

_BUNDLED_ALIGNMENTS = ("symboslam-2022.ttl",)  # old names; the others say nothing about features
MISSING = "missing"
"""Stands in a list of digests for an import that was not found."""
BUNDLED = "bundled"
"""Stands in a list of digests for an import that is a bundled module."""
CLOSURE = DOCUMENTS + "symboslam"
"""The bundled document that imports all others."""

_PARTS = ("", "upstream", "alignments")  # folders with modules
_VERSION = re.compile(r"\d+\.\d+\.\d+/")


class Place(NamedTuple):
    """Where something stands: a file, and a line where its format has lines."""

    file: str
    line: int | None

    def __str__(self) -> str:
        return self.file if self.line is None else f"{self.file}: line {self.line}"


class Note(NamedTuple):
    """Something odd about the files of an ontology.

    Attributes:
        kind: ``missing-import``, ``cyclic-import``, ``byte-order-mark`` or ``empty-file``.
        subject: the import's IRI, or the file.
        message: what is odd, with file and line.
    """

    kind: str
    subject: str
    message: str


@dataclass
class Sources:
    """A merged ontology and where it came from.

    Attributes:
        graph: all triples of all files.
        files: name -> SHA-256 of each user file and each file found for an import.
        missing: IRIs of imports that were not found, and so are left out.
        bundled: IRIs of imports by files that are bundled modules.
        documents: name -> graph of each file that was merged, as it is shown in places.
        places: triple -> where it is stated.
        notes: what is odd about the files; always empty after a strict reading.
    """

    graph: Graph
    files: dict[str, str] = field(default_factory=dict)
    missing: tuple[str, ...] = ()
    bundled: set[str] = field(default_factory=set)
    documents: dict[str, LocatedGraph] = field(default_factory=dict)
    places: dict[Triple, Place] = field(default_factory=dict)
    notes: tuple[Note, ...] = ()

    @property
    def digests(self) -> dict[str, str]:
        """``files``, and the missing and the bundled imports marked as such."""
        marked = {**dict.fromkeys(self.bundled, BUNDLED), **dict.fromkeys(self.missing, MISSING)}
        return {**self.files, **marked}


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


def closure_files() -> dict[str, Traversable]:
    """Name -> file of every module of the bundled ontology, upstream and alignments included."""
    from importlib.resources import files

    folder = files("symboslam.ontology")
    return {
        f"{part}/{entry.name}".lstrip("/"): entry
        for part in _PARTS
        if (folder / part).is_dir()
        for entry in sorted((folder / part).iterdir(), key=lambda e: e.name)
        if entry.name.endswith(".ttl")
    }


def bundled_name(iri: str) -> str:
    """The name that the bundled module with this document or version IRI would have."""
    return f"{_VERSION.sub('', iri.removeprefix(DOCUMENTS), count=1)}.ttl"


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


def closure_hash() -> str:
    """SHA-256 of all bundled modules, which an ontology of one's own may import."""
    return combined_digest({n: digest(f.read_bytes()) for n, f in closure_files().items()})


def read_bundled() -> Sources:
    """The part of the bundled ontology that decides what features indicate, merged."""
    from rdflib import Graph

    from symboslam.reasoning.parsing import parse

    read = Sources(Graph())
    for name, file in bundled_files().items():
        data = file.read_bytes()
        read.files[name] = digest(data)
        _add(read, name, parse(name, data))
    return read


def _add(read: Sources, name: str, one: LocatedGraph) -> None:
    read.graph += one
    read.documents[name] = one
    for prefix, namespace in one.namespaces():
        read.graph.bind(prefix, namespace, override=False)
    for triple in one:
        read.places.setdefault(triple, Place(name, one.lines.get(triple)))


def read_bytes(path: Path) -> bytes:
    """A user's file.

    Raises:
        InputError: it cannot be read.
    """
    try:
        if path.is_char_device():
            raise InputError(f"{path}: it is a device and no file")
        return path.read_bytes()
    except OSError as error:
        raise InputError(f"{path}: {error.strerror or error}") from error


def read_files(paths: Iterable[Path], strict: bool = False) -> Sources:
    """A user's ontology: the files, what they import, and always the bundled core.

    An import is looked for among the given files by the ontology IRI that they declare, in a
    ``catalog-v001.xml`` beside the importing file, among the bundled modules
    (``https://w3id.org/symboslam/places`` is ``places.ttl``), and among the files beside the
    importing one: by the last part of its IRI, then by the ontology IRI that a file declares.
    The network is never asked.

    Args:
        paths: the files.
        strict: refuse an import that is not found or that leads back to where it came from,
            a byte-order mark and an empty file, instead of noting it. OWL 2 allows ontologies
            that import each other, and they are read well; but in an ontology of one's own such
            a circle, as the rest, is mostly a slip that another program will stumble over.

    Raises:
        InputError: a file cannot be read.
        OntologySyntaxError: a file does not parse.
        ImportsError: a missing or cyclic import, if strict.
    """
    return _read(list(paths), {"core.ttl"}, strict)


def read_closure(
    targets: Sequence[str | Path], strict: bool = True, follow: bool = True
) -> Sources:
    """Any ontology: files or bundled documents by their IRI, with all that they import.

    Args:
        targets: files, or IRIs such as ``https://w3id.org/symboslam/core``.
        strict: see :func:`read_files`.
        follow: read the imports too. If not, they are listed as ``missing``.

    Raises:
        InputError: a file cannot be read.
        UnknownNameError: there is no bundled document of that IRI.
        OntologySyntaxError: a file does not parse.
        ImportsError: a missing or cyclic import, if strict.
    """
    paths, modules = [], set()
    for target in targets:
        if str(target).startswith(DOCUMENTS):
            name = bundled_name(str(target))
            if name not in closure_files():
                raise UnknownNameError(f"there is no bundled document <{target}>")
            modules.add(name)
        else:
            paths.append(Path(target))
    return _read(paths, modules, strict, follow)


def _read(paths: list[Path], modules: set[str], strict: bool, follow: bool = True) -> Sources:
    from rdflib import OWL, RDF, Graph

    from symboslam.reasoning.parsing import parse

    bundled = closure_files()
    read, notes = Sources(Graph()), []
    wanted: dict[str, Path | None] = {_resolved(path): path for path in reversed(paths)}
    wanted.update(dict.fromkeys(sorted(modules)))
    done: set[str] = set()
    declared: dict[str, str] = {}  # ontology or version IRI -> the file that declares it
    imports: dict[str, dict[str, Place]] = {}  # file -> imported file -> where it says so
    missing: list[tuple[str, Place]] = []
    while todo := [name for name in wanted if name not in done]:
        said: list[tuple[str, str, Place]] = []
        for name in todo:  # all of them before any import, so that a given file is found first
            path = wanted[name]
            data = read_bytes(path) if path else bundled[name].read_bytes()
            shown = str(path) if path else name
            if path:
                read.files[_relative(path, paths)] = digest(data)
            if data.startswith(codecs.BOM_UTF8):
                where = Place(shown, 1)
                problem = f"{where}: begins with a byte-order mark; save it as UTF-8 without"
                notes.append(Note("byte-order-mark", shown, problem))
            done.add(name)
            one = parse(shown, data)
            if not one:
                problem = f"{Place(shown, 1)}: states nothing at all"
                notes.append(Note("empty-file", shown, problem))
            _add(read, shown, one)
            imports[name] = {}
            iris = (*one.subjects(RDF.type, OWL.Ontology), *one.objects(None, OWL.versionIRI))
            declared.update((str(iri), name) for iri in iris if str(iri) not in declared)
            for triple in sorted(one.triples((None, OWL.imports, None)), key=lambda t: str(t[2])):
                said.append((name, str(triple[2]), Place(shown, one.lines.get(triple))))
        for name, target, place in said:
            path, beside = wanted[name], None
            if target in declared:
                found = declared[target]
            elif not follow:
                missing.append((target, place))
                continue
            elif path and (beside := find_in_catalog(path, target)):
                found = str(beside.resolve())
            elif target.startswith(DOCUMENTS) and bundled_name(target) in bundled:
                found = bundled_name(target)
                read.bundled.add(target)
            elif path and (beside := find_beside(path, target)):
                found = str(beside.resolve())
            else:
                missing.append((target, place))
                continue
            imports[name].setdefault(found, place)
            wanted.setdefault(found, beside)
    for target, place in missing:
        if target not in declared and follow:
            problem = f"{place}: the import <{target}> was not found beside the file"
            notes.append(Note("missing-import", target, problem))
    if follow and (circle := find_circle(imports)):
        steps = ", ".join(f"{place} imports {Path(to).name}" for to, place in circle)
        problem = f"the imports go round in a circle: {steps}"
        notes.append(Note("cyclic-import", circle[0][0], problem))
    if strict:
        refuse(notes)
    read.missing = tuple(sorted({target for target, _ in missing if target not in declared}))
    read.notes = tuple(notes)
    return read


def _resolved(path: Path) -> str:
    try:
        return str(path.resolve())
    except (OSError, RuntimeError):  # links that lead to each other
        raise InputError(f"{path}: the link leads to no file") from None


def refuse(notes: Iterable[Note]) -> None:
    """Raise an error that tells the notes, if there are any.

    Raises:
        OntologySyntaxError: about files only.
        ImportsError: about imports too.
    """
    notes = list(notes)
    kinds = {note.kind for note in notes}
    text = "\n".join(note.message for note in notes)
    remedies = []
    if "missing-import" in kinds:
        remedies.append("put the file there, list it in catalog-v001.xml or mend the import")
    if "cyclic-import" in kinds:
        remedies.append("leave out one of the imports")
    if remedies:
        raise ImportsError(f"{text}\n{'; '.join(remedies)}; or read on with --lenient-imports")
    if notes:
        raise OntologySyntaxError(text)


def _relative(path: Path, given: list[Path]) -> str:
    """The name of a file in a list of digests: its place relative to the first given file."""
    from os.path import relpath

    return Path(relpath(path.resolve(), given[0].resolve().parent)).as_posix()


def unchanged(digests: dict[str, str], given: list[Path]) -> bool:
    """Whether a list of digests still holds: equal files, and imports lead where they led."""
    folder = given[0].resolve().parent
    looked_for = {MISSING: (find_in_catalog, find_beside), BUNDLED: (find_in_catalog,)}
    try:
        return all(
            all(find(path, name) is None for path in given for find in looked_for[value])
            if value in looked_for
            else digest((folder / name).read_bytes()) == value
            for name, value in digests.items()
        )
    except OSError:
        return False
