"""The modules of an ontology: one for each of its files, each with its own graph."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property
from os.path import relpath
from pathlib import Path

from rdflib import DC, DCTERMS, OWL, RDF, RDFS, SKOS, Graph, Literal, URIRef
from rdflib.term import Node

from symboslam.errors import OntologyError
from symboslam.reasoning import sources


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
        strict: refuse missing and cyclic imports (see :func:`sources.read_closure`).

    Raises:
        InputError: a file cannot be read.
        OntologySyntaxError: a file does not parse.
        ImportsError: a missing or cyclic import, if strict.
        OntologyError: no file is given.
    """
    if paths is not None and not paths:
        raise OntologyError("no ontology file is given")
    read = sources.read_closure([sources.CLOSURE] if paths is None else paths, strict)
    folder = paths[0].resolve().parent if paths else Path()
    bundled = sources.closure_files()
    found = []
    for shown, graph in read.documents.items():
        is_own = paths is None or shown not in bundled
        name = (
            shown if shown in bundled else Path(relpath(Path(shown).resolve(), folder)).as_posix()
        )
        found.append(
            Module((name.rpartition(".")[0] or name).replace("../", ""), "", graph, is_own)
        )
    return _imported_first(_with_own_pages(found))


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
