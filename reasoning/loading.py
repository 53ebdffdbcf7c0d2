"""Load knowledge: from the package, from the user's cache, or by reasoning."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from symboslam.errors import EmptyOntologyError
from symboslam.reasoning import sources as files
from symboslam.reasoning import store
from symboslam.reasoning.knowledge import Knowledge

if TYPE_CHECKING:
    from symboslam.reasoning._base import Reasoner
    from symboslam.reasoning.classes import Classes

BUNDLED_FILE = Path(__file__).parent / "bundled" / "knowledge.json"


def load(paths: Sequence[Path] | None, cache: bool) -> Knowledge:
    """See :meth:`Knowledge.load`."""
    if paths is None:
        return _load_bundled(cache)
    if not paths:
        raise EmptyOntologyError("no ontology file is given")
    return _load_files(list(paths), cache)


def build_bundled() -> tuple[Knowledge, dict[str, str]]:
    """Reason over the bundled ontology; the result and the digests of its files."""
    from symboslam.reasoning.extract import extract

    read = files.read_bundled()
    hashed = files.combined_digest(read.files)
    return replace(extract(reason(read)), source_hash=hashed), read.files


def reason(read: files.Sources, reasoner: Reasoner | None = None) -> Classes:
    """The classes of an ontology after reasoning.

    Args:
        read: the merged ontology.
        reasoner: HermiT by default.

    Raises:
        InconsistentOntologyError: it contradicts itself, or a class can have no members.
        OntologyError: it is outside OWL 2 DL.
        ReasonerError: the reasoner could not be run.
    """
    from symboslam.reasoning.axioms import split
    from symboslam.reasoning.clash import refuse
    from symboslam.reasoning.classes import Classes
    from symboslam.reasoning.hermit import Hermit
    from symboslam.reasoning.statements import Statements

    reasoner = reasoner or Hermit()
    declared, axioms = split(read.graph)
    hierarchy = reasoner.classify([*declared, *(t for a in axioms for t in a.triples)])
    if hierarchy is None or hierarchy.unsatisfiable:
        raise refuse(reasoner, declared, axioms, hierarchy)
    return Classes(Statements(read.graph, read.places), hierarchy)


def _load_bundled(cache: bool) -> Knowledge:
    if not cache:
        return build_bundled()[0]
    hashed = files.bundled_hash()
    try:
        shipped, _ = store.from_json(BUNDLED_FILE.read_bytes(), "bundled")
        if shipped.source_hash == hashed:
            return shipped
    except (OSError, ValueError):
        pass  # not built yet, or built by another version
    key = f"{hashed[:40]}-{store.FORMAT}"
    if kept := store.read_cache(key, "bundled"):
        return kept[0]
    knowledge, digests = build_bundled()
    store.write_cache(key, knowledge, digests)
    return knowledge


def _load_files(paths: list[Path], cache: bool) -> Knowledge:
    source = ", ".join(str(path) for path in paths)
    bundled = files.closure_hash()
    given = {f"{i} {p.name}": files.digest(files.read_bytes(p)) for i, p in enumerate(paths)}
    key = f"{files.combined_digest({**given, 'bundled': bundled})[:40]}-{store.FORMAT}"
    kept = store.read_cache(key, source) if cache else None
    if kept and files.unchanged(kept[1], paths):
        return _with_notes(*kept)
    from symboslam.reasoning.extract import extract

    read = files.read_files(paths)
    hashed = files.combined_digest({**read.digests, "bundled": bundled})
    knowledge = replace(extract(reason(read)), source=source, source_hash=hashed)
    if cache:
        store.write_cache(key, knowledge, read.digests)
    return _with_notes(knowledge, read.digests)


def _with_notes(knowledge: Knowledge, digests: dict[str, str]) -> Knowledge:
    """Knowledge that says which imports are missing."""
    missing = sorted(name for name, value in digests.items() if value == files.MISSING)
    notes = (f"the import <{i}> was not found beside {knowledge.source}" for i in missing)
    return replace(knowledge, notes=tuple(notes))
