"""The modules of an ontology: one for each of its files, each with its own graph."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from rdflib import DC, DCTERMS, OWL, RDF, RDFS, SKOS, Graph, Literal, URIRef
from rdflib.term import Node

from symboslam.errors import OntologyError
from symboslam.reasoning import sources
from symboslam.reasoning.parsing import parse

if TYPE_CHECKING:
    from importlib.resources.abc import Traversable


@dataclass(eq=False)
class Module:
    """One ontology document.

    Attributes:
        name: its place without the ending, such as ``alignments/envo``; unique.
        page: name of its page without the ending.
        graph: what the file states.
        is_own: whether the user gave it or it lies beside what the user gave.
    """

    name: str
    page: str
    graph: Graph = field(repr=False)
    is_own: bool = True

    @property
    def group(self) -> str:
        """The folder that it is in; empty for the top one."""
        return self.name.rpartition("/")[0]

    @cached_property
    def iri(self) -> str:
        """The IRI of its document; empty if it declares none."""
        found = sorted(str(s) for s in self.graph.subjects(RDF.type, OWL.Ontology))
        own = [iri for iri in found if iri.endswith(f"/{self.name}")]
        return next(iter([*own, *found]), "")

    @property
    def title(self) -> str:
        """What it is called."""
        return self.header(DCTERMS.title, DC.title, RDFS.label) or self.name

    @property
    def description(self) -> str:
        """One sentence, for lists."""
        return self.header(DCTERMS.description, DC.description, RDFS.comment)

    @property
    def comment(self) -> str:
        """Scope and design choice."""
        comment = self.header(RDFS.comment)
        return "" if comment == self.description else comment

    @cached_property
    def imports(self) -> tuple[str, ...]:
        """IRIs of the documents that it imports."""
        return tuple(sorted({str(o) for o in self.graph.objects(None, OWL.imports)}))

    def header(self, *predicates: URIRef) -> str:
        """The first text about the document under one of the predicates, English first."""
        return best_text(self.graph, URIRef(self.iri), predicates)

    def headers(self, predicate: URIRef) -> list[Node]:
        """All that is said about the document under a predicate."""
        return sorted(self.graph.objects(URIRef(self.iri), predicate), key=str)


def best_text(graph: Graph, subject: Node, predicates: Iterable[URIRef]) -> str:
    """The best text under some predicates.

    English before no language before another one; then an earlier predicate before a later one.
    """

    def rank(found: tuple[int, Literal]) -> tuple[int, int, str]:
        language = (found[1].language or "").lower()
        return (
            (0 if language.startswith("en") else 1 if not language else 2),
            found[0],
            str(found[1]),
        )

    texts = [
        (place, o)
        for place, predicate in enumerate(predicates)
        for o in graph.objects(subject, predicate)
        if isinstance(o, Literal)
    ]
    return " ".join(str(min(texts, key=rank)[1]).split()) if texts else ""


LABELS = (RDFS.label, SKOS.prefLabel, DCTERMS.title, DC.title)
DEFINITIONS = (
    SKOS.definition,
    DCTERMS.description,
    URIRef("http://purl.obolibrary.org/obo/IAO_0000115"),
    DC.description,
    RDFS.comment,
)


def read_modules(paths: list[Path] | None, strict: bool = False) -> list[Module]:
    """The modules to document, an imported one before those that import it.

    Args:
        paths: a user's ontology files, which bring the files that they import along; None for the
            bundled ontology.
        strict: refuse missing and cyclic imports (see :func:`sources.read_files`).

    Raises:
        InputError: a file cannot be read.
        OntologySyntaxError: a file does not parse.
        ImportsError: a missing or cyclic import, if strict.
        OntologyError: no file is given.
    """
    if paths is not None and not paths:
        raise OntologyError("no ontology file is given")
    if paths is None:
        found = [_bundled(name, file, True) for name, file in sources.closure_files().items()]
    else:
        found = _of_user(paths, strict)
    return _imported_first(_with_own_pages(found))


def _bundled(name: str, file: Traversable, is_own: bool) -> Module:
    return Module(name.removesuffix(".ttl"), "", parse(name, file.read_bytes()), is_own)


def _of_user(paths: list[Path], strict: bool) -> list[Module]:
    """A user's files, those beside them that they import, and the bundled ones that they import."""
    folder = paths[0].resolve().parent
    found = []
    for relative in sources.read_files(paths, strict).files:
        path = folder / relative
        name = relative.rpartition(".")[0] or relative
        graph = parse(str(path), sources.read_bytes(path))
        found.append(Module(name.replace("../", ""), "", graph))
    bundled, read = sources.closure_files(), set[str]()
    waiting = [iri for module in found for iri in module.imports]
    while waiting:
        name = sources.bundled_name(waiting.pop())
        if name in bundled and name not in read:
            read.add(name)
            found.append(_bundled(name, bundled[name], False))
            waiting.extend(found[-1].imports)
    return found


def _with_own_pages(modules: list[Module]) -> list[Module]:
    """Give each module a page name, and a name of its own where two files are called alike."""
    names, pages = set[str](), set[str]()
    for module in modules:
        module.name = _fresh(module.name, names)
        module.page = "module-" + _fresh(_slug(module.name), pages)
    return modules


def _slug(name: str) -> str:
    return re.sub(r"[^\w.-]+", "-", name).strip("-.") or "ontology"


def _fresh(name: str, taken: set[str]) -> str:
    """A name that differs from those taken, also where upper and lower case are alike."""
    fresh, number = name, 2
    while fresh.casefold() in taken:
        fresh, number = f"{name}-{number}", number + 1
    taken.add(fresh.casefold())
    return fresh


def slugs(names: Iterable[str]) -> dict[str, str]:
    """Name -> a word for a file name that no other of the names has.

    >>> slugs(["House", "a b", "a/b"])
    {'House': 'House', 'a b': 'a-b', 'a/b': 'a-b-2'}
    """
    taken = set[str]()
    return {name: _fresh(_slug(name), taken) for name in names}


def document_index(modules: Iterable[Module]) -> dict[str, Module]:
    """IRI of a document, or of a version of it -> its module."""
    found: dict[str, Module] = {}
    for module in modules:
        if module.iri:
            versions = [str(o) for o in module.headers(OWL.versionIRI)]
            for iri in (module.iri, *versions):
                found.setdefault(iri, module)
    return found


def _imported_first(modules: list[Module]) -> list[Module]:
    """By folder, then what is imported first; a ring of imports is cut where it closes."""
    index = document_index(modules)
    depth: dict[Module, int] = {}

    def deep(module: Module, above: frozenset[Module]) -> int:
        if module not in depth:
            below = [index[i] for i in module.imports if i in index]
            depths = [deep(m, above | {module}) for m in below if m not in above and m != module]
            depth[module] = 1 + max(depths, default=0)
        return depth[module]

    for module in sorted(modules, key=lambda m: m.name):
        deep(module, frozenset())
    return sorted(modules, key=lambda m: (depth[m], m.name))
