"""Compare the terms that our modules reuse with upstream files that a user supplies.

Our upstream modules restate terms of Onto4MAT and OntoSLAM, and an alignment those of the SymboSLAM
ontology of 2022, in our own words. Whether a newer upstream still has these terms, under the same
label and as the same kind of thing, is found out here; upstream files are no part of the package.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING

from symboslam.errors import InputError
from symboslam.reasoning import sources
from symboslam.reasoning import vocabulary as v

if TYPE_CHECKING:
    from rdflib import Graph, URIRef
    from rdflib.term import Node

ENDINGS = (".owl", ".ttl", ".rdf", ".owx", ".nt", ".n3", ".ofn", ".jsonld")
"""Endings of the files that are taken for ontologies in a user's folder."""

_OLD_NAMES = "alignments/symboslam-2022.ttl"
_PREFIX = re.compile(
    rb"""(?:xmlns:([\w.-]+)\s*=\s*["']|@?prefix\s+([\w.-]+):\s*<)([^"'>&\s]+)""", re.I
)


class Status(StrEnum):
    """What became of a term."""

    PRESENT = "present"
    RELABELLED = "changed label"
    OTHER_KIND = "changed kind"
    VANISHED = "vanished"
    DATA_ONLY = "in upstream data only"
    NOT_SUPPLIED = "upstream not supplied"


CHANGES = (Status.VANISHED, Status.OTHER_KIND, Status.RELABELLED)
"""What makes a comparison end with findings."""


@dataclass(frozen=True)
class Term:
    """A term of another ontology that one of our modules declares.

    Attributes:
        iri: its IRI.
        name: its short name with the module's prefix, such as ``o4m:Agent``.
        kind: ``class``, ``object property``, ``data property``, ...
        module: our module's file.
        document: IRI of the ontology that it is of.
        label: what that ontology called it when it was taken over; empty if it had no label.
        data_only: whether only the data of that ontology used it then.
    """

    iri: str
    name: str
    kind: str
    module: str
    document: str
    label: str = ""
    data_only: bool = False


@dataclass
class Sighting:
    """What the upstream files say of one IRI; all files count as one upstream.

    Attributes:
        files: the files that declare it, or else those that use it.
        kinds: the kinds that it is declared as; empty if it is used and never declared.
        labels: its labels.
        literally: how the IRI is written where that is a name such as ``OS:Position``, whose prefix
            the file declares but which RDF/XML does not expand.
        deprecated: whether it is marked as out of use.
    """

    files: list[str] = field(default_factory=list)
    kinds: set[str] = field(default_factory=set)
    labels: set[str] = field(default_factory=set)
    literally: str = ""
    deprecated: bool = False


@dataclass(frozen=True)
class Finding:
    """What became of one term.

    Attributes:
        term: the term as we reuse it.
        status: what became of it.
        files: the upstream files that hold it, relative to the folder.
        literally: the unexpanded name under which it was found, if it was.
        note: what changed, in words; may also say something about a term that is present.
    """

    term: Term
    status: Status
    files: tuple[str, ...] = ()
    literally: str = ""
    note: str = ""


@dataclass(frozen=True)
class Comparison:
    """The result of a comparison.

    Attributes:
        folder: the user's folder.
        files: the upstream files that were read, relative to it.
        findings: one for each reused term, changes first.
    """

    folder: Path
    files: tuple[str, ...]
    findings: tuple[Finding, ...]

    @property
    def ok(self) -> bool:
        """Whether nothing vanished or changed."""
        return not any(finding.status in CHANGES for finding in self.findings)

    @property
    def counts(self) -> dict[str, int]:
        """Status -> number of terms, for each status."""
        found = [finding.status for finding in self.findings]
        return {status.value: found.count(status) for status in Status}


def reused_terms() -> list[Term]:
    """The terms of others that our upstream modules and the alignment of 2022 declare.

    Such a term has ``rdfs:isDefinedBy``. A module that is not there has none.
    """
    from rdflib import Literal, URIRef

    from symboslam.reasoning.parsing import parse

    graphs = {
        module: parse(module, file.read_bytes())
        for module, file in sources.closure_files().items()
        if module.startswith("upstream/") or module == _OLD_NAMES
    }
    data_only = {
        str(subject)
        for graph in graphs.values()
        for subject in graph.subjects(URIRef(v.IN_UPSTREAM_DATA_ONLY), Literal(True))
    }
    return [t for module, graph in graphs.items() for t in _terms_of(module, graph, data_only)]


def _terms_of(module: str, graph: Graph, data_only: set[str]) -> Iterator[Term]:
    from rdflib import RDFS, URIRef

    subjects = {s for s in graph.subjects(RDFS.isDefinedBy) if isinstance(s, URIRef)}
    for subject in sorted(subjects):
        kinds = _kinds(graph, subject)
        if not kinds or subject.startswith(v.SL):
            continue
        yield Term(
            iri=str(subject),
            name=graph.namespace_manager.normalizeUri(subject).strip("<>"),
            kind=min(kinds),
            module=module,
            document=str(graph.value(subject, RDFS.isDefinedBy)),
            label=str(graph.value(subject, URIRef(v.UPSTREAM_LABEL)) or ""),
            data_only=str(subject) in data_only,
        )


def _kinds(graph: Graph, subject: URIRef) -> set[str]:
    """The kinds of term that a graph declares something as."""
    from rdflib import OWL, RDF, RDFS

    names: dict[Node, str] = {
        OWL.Class: "class",
        RDFS.Class: "class",
        OWL.ObjectProperty: "object property",
        OWL.DatatypeProperty: "data property",
        OWL.AnnotationProperty: "annotation property",
        RDF.Property: "property",
        RDFS.Datatype: "datatype",
        OWL.NamedIndividual: "individual",
    }
    return {names[t] for t in graph.objects(subject, RDF.type) if t in names}


def compare(folder: Path) -> Comparison:
    """Compare our reused terms with the ontology files in a folder and in those below it.

    The files count as one upstream: a term is present if any of them declares it. An ontology that
    none of them holds anything of was not supplied, unless that is so of all.

    Raises:
        InputError: no such folder, or no ontology file in it.
        OntologySyntaxError: a file does not parse.
    """
    from symboslam.reasoning.parsing import parse

    terms = reused_terms()
    wanted = {term.iri for term in terms}
    sightings: dict[str, Sighting] = {}
    documents: set[str] = set()
    paths = _ontology_files(folder)
    names = tuple(path.relative_to(folder).as_posix() for path in paths)
    for path, name in zip(paths, names, strict=True):
        data = sources.read_bytes(path)
        graph = parse(str(path), data)
        documents |= _documents(graph)
        _look(name, graph, _prefixes(data), wanted, sightings)
    supplied = {t.module for t in terms if t.iri in sightings or t.document in documents}
    supplied = supplied or {t.module for t in terms}
    findings = [_judge(t, sightings.get(t.iri), t.module in supplied) for t in terms]
    order = [*CHANGES, *(status for status in Status if status not in CHANGES)]
    findings.sort(key=lambda f: (order.index(f.status), f.term.module, f.term.name))
    return Comparison(folder, names, tuple(findings))


def _ontology_files(folder: Path) -> list[Path]:
    if not folder.is_dir():
        problem = (
            "is a file; give the folder that it is in" if folder.is_file() else "no such folder"
        )
        raise InputError(f"{folder}: {problem}")
    found = sorted(p for p in folder.rglob("*") if p.suffix.lower() in ENDINGS and p.is_file())
    if not found:
        raise InputError(
            f"{folder}: no ontology file in it or below it; their names end in {', '.join(ENDINGS)}"
        )
    return found


def _documents(graph: Graph) -> set[str]:
    from rdflib import OWL, RDF

    return {str(iri) for iri in graph.subjects(RDF.type, OWL.Ontology)}


def _prefixes(data: bytes) -> dict[str, str]:
    """The prefixes that a file declares; rdflib keeps only one of several for a namespace."""
    return {
        (xml or turtle).decode(): namespace.decode(errors="replace")
        for xml, turtle, namespace in _PREFIX.findall(data)
    }


def _look(
    name: str,
    graph: Graph,
    prefixes: dict[str, str],
    wanted: set[str],
    sightings: dict[str, Sighting],
) -> None:
    """Add to ``sightings`` what one file says of the wanted terms."""
    from rdflib import OWL, RDFS, Literal

    for term in _names(graph):
        written = str(term)
        head, _, rest = written.partition(":")
        expanded = prefixes[head] + rest if head in prefixes else written
        iri = written if written in wanted else expanded
        if iri not in wanted:
            continue
        seen = sightings.setdefault(iri, Sighting())
        kinds = _kinds(graph, term)
        if kinds and not seen.kinds:
            seen.files.clear()  # they only use it
        if (kinds or not seen.kinds) and name not in seen.files:
            seen.files.append(name)
        seen.kinds |= kinds
        seen.labels |= {str(label) for label in graph.objects(term, RDFS.label)}
        seen.deprecated |= (term, OWL.deprecated, Literal(True)) in graph
        if iri != written:
            seen.literally = written


def _names(graph: Graph) -> Iterable[URIRef]:
    """Every IRI that stands anywhere in a graph, once."""
    from rdflib import URIRef

    return sorted({term for triple in graph for term in triple if isinstance(term, URIRef)})


def _judge(term: Term, seen: Sighting | None, supplied: bool) -> Finding:
    """What became of a term, from what was seen of it."""
    if seen is None:
        if not supplied:
            return Finding(term, Status.NOT_SUPPLIED)
        return Finding(term, Status.DATA_ONLY if term.data_only else Status.VANISHED)
    notes = []
    status = Status.PRESENT
    general = "property" in seen.kinds and term.kind.endswith("property")
    if not seen.kinds:
        notes.append("used there, but not declared")
    elif term.kind not in seen.kinds and not general:
        status = Status.OTHER_KIND
        notes.append(f"was {term.kind}, is {' and '.join(sorted(seen.kinds))}")
    if term.label not in seen.labels and (term.label or seen.labels):
        status = Status.RELABELLED if status is Status.PRESENT else status
        now = " and ".join(repr(label) for label in sorted(seen.labels)) or "nothing"
        notes.append(f"was labelled {repr(term.label) if term.label else 'nothing'}, is {now}")
    if seen.deprecated:
        notes.append("deprecated there")
    if seen.literally:
        notes.append(f"found under unexpanded IRI {seen.literally}")
    return Finding(term, status, tuple(sorted(seen.files)), seen.literally, "; ".join(notes))
