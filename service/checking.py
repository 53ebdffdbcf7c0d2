"""Is what a service keeps whole, and does the store say of each map what its records say?"""

from __future__ import annotations

import sqlite3
from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass, field
from decimal import Decimal
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

from symboslam.errors import InputError, StoreError, SymboSlamError
from symboslam.service.database import NAME, check_database, lock_folder, open_database
from symboslam.service.maps.maps import BUNDLED, Maps, base_of
from symboslam.service.maps.records import Records
from symboslam.service.metrics import Metrics
from symboslam.service.settings import Settings
from symboslam.service.store._base import Answer, MissingGraphError, Store
from symboslam.service.store.opening import open_store
from symboslam.service.vocabulary import N_TRIPLES

if TYPE_CHECKING:
    from pyoxigraph import Triple

Progress = Callable[[str, float], None]
_CLOSE = Decimal("0.00001")
"""How far numbers may differ: sums in another order differ in their last digit."""
_DECIMAL = "http://www.w3.org/2001/XMLSchema#decimal"
_MAY_SAY_MORE = ("terms", "provenance")
"""Labels of features, and agents, are stated once and stay when nothing mentions them any more."""
_HOUR = 3600.0
_MOST_GRAPHS = 1_000_000


@dataclass
class Report:
    """What was found.

    Attributes:
        statements: in the store, those in the default graph included.
        maps: how many were looked at.
        problems: what is wrong, and how to mend it.
        repaired: what was wrong and is not any more.
    """

    statements: int = 0
    maps: int = 0
    problems: list[str] = field(default_factory=list)
    repaired: list[str] = field(default_factory=list)

    @property
    def is_well(self) -> bool:
        """Whether nothing is wrong, or not any more."""
        return not self.problems

    def __str__(self) -> str:
        count = len(self.problems)
        head = f"{self.statements} statements, {self.maps} maps: "
        head += "all is well" if self.is_well else f"{count} problem{'' if count == 1 else 's'}"
        return "\n".join([head, *(f"repaired: {each}" for each in self.repaired), *self.problems])


async def check_folder(
    data: Path, progress: Progress, *, shapes: bool = False, repair: bool = False
) -> Report:
    """Look at a data folder that no server has open; its settings are those of `Settings`.

    Args:
        data: it.
        progress: is told the stage and how much is done.
        shapes: check each map against the SHACL shapes, which takes long.
        repair: state maps anew from the records where the store says something else.

    Raises:
        InputError: it is no data folder.
        StoreError: the store or the database cannot be opened, or a server has them open.
    """
    if not (data / NAME).is_file():
        raise InputError(f"{data} is no data folder of symboslam serve: it has no {NAME}")
    report = Report()
    with lock_folder(data):
        check_database(data)
        settings = _settings(data)
        if settings.store is None and not (data / "store").is_dir():
            raise InputError(f"{data} has no store; where it is elsewhere, say SYMBOSLAM_STORE")
        store = open_store(settings)
        try:
            progress("reading the records", 0.0)
            report.problems += _of_database(data)
            await store.start()
            with closing(open_database(data)) as database:
                records = Records(database)
                maps = Maps(records, store, data / "ontologies", Metrics())
                report.problems += _of_ontologies(records, data / "ontologies")
                progress("reading the store", 0.05)
                try:
                    report.statements = await _count(store)
                except StoreError as error:
                    report.problems.append(
                        f"the store cannot be read: {error}; restore a backup, or move the folder"
                        f" {data / 'store'} away: maps are stated anew, graphs of your own are lost"
                    )
                    return report
                found = records.maps()
                for identifier in found:
                    progress(f"map {identifier}", 0.1 + 0.9 * report.maps / len(found))
                    report.maps += 1
                    await _look_at(report, maps, store, identifier, shapes, repair)
        finally:
            await store.stop()
    return report


def _settings(data: Path) -> Settings:
    from pydantic import ValidationError

    try:
        given: dict[str, Any] = {
            "data": data, "workers": 1, "query_seconds": _HOUR,
            "max_result_bytes": 2**40, "union_default_graph": False,
        }  # fmt: skip
        return Settings(**given)
    except ValidationError as error:
        raise InputError(f"a setting is wrong: {error.errors()[0]['msg']}") from error


def _of_database(data: Path) -> list[str]:
    """What is wrong with the database."""
    mend = "; restore a backup"
    try:
        with closing(open_database(data)) as database:
            found = [row[0] for row in database.execute("PRAGMA integrity_check")]
            loose = database.execute("PRAGMA foreign_key_check").fetchall()
    except sqlite3.Error as error:
        return [f"{NAME} cannot be read: {error}{mend}"]
    problems = [f"{NAME}: {each}{mend}" for each in found if each != "ok"]
    if loose:
        problems.append(f"{NAME}: {len(loose)} rows belong to no map{mend}")
    return problems


def _of_ontologies(records: Records, folder: Path) -> list[str]:
    """Which of the ontologies that maps use are not there as they were kept."""
    problems = []
    for name in sorted({_record_ontology(records, each) for each in records.maps()} - {BUNDLED}):
        file = folder / name
        if not file.is_file():
            problems.append(f"the ontology {file} is missing; restore it from a backup")
        elif sha256(file.read_bytes()).hexdigest()[:32] != file.stem:
            problems.append(f"the ontology {file} is damaged; restore it from a backup")
    return problems


def _record_ontology(records: Records, identifier: str) -> str:
    record = records.map(identifier)
    return BUNDLED if record is None else str(record.options["ontology"])


async def _count(store: Store) -> int:
    """How many statements there are; reads all of them, graph by graph.

    Not by a query: Oxigraph's do not end at a block that is damaged.
    """
    found = 0
    for graph in [None, *await store.graph_names(_MOST_GRAPHS)]:
        found += _bytes(await store.read_graph(graph, N_TRIPLES, gzip=False)).count(b"\n")
    return found


async def _look_at(
    report: Report, maps: Maps, store: Store, identifier: str, shapes: bool, repair: bool
) -> None:
    """Compare a map with what the store says of it."""
    name = f"map {identifier}"
    try:
        running = await maps.open(identifier)
        wanted = await running.said()
        found = await _differences(store, identifier, wanted)
        if found and repair:
            await running.state()
            report.repaired.append(f"{name}: {found}")
            found = await _differences(store, identifier, wanted)
        if found:
            report.problems.append(
                f"{name}: the store does not say what the records say: {found}; state it"
                " anew with --repair"
            )
        if shapes:
            violations = await _violations(store, identifier, list(wanted))
            report.problems += [f"{name}: {each}" for each in violations]
    except (SymboSlamError, OSError, LookupError, TypeError) as error:
        report.problems.append(f"{name} cannot be opened: {error}; restore a backup")


async def _differences(store: Store, identifier: str, wanted: dict[str, str]) -> str:
    """What the store says differently, in words; empty if nothing."""
    told = []
    for name, text in wanted.items():
        found = await _graph(store, identifier, name)
        if found is None:
            told.append(f"the graph {name} is missing")
            continue
        missing, extra = differing(_triples(text.encode()), _triples(found))
        if missing or (extra and name not in _MAY_SAY_MORE):
            told.append(f"in {name} {missing} statements are missing and {extra} too many")
    return ", ".join(told)


def differing(wanted: set[Triple], found: set[Triple]) -> tuple[int, int]:
    """How many statements are missing and how many are too many, last digits left aside."""
    missing, extra = wanted - found, found - wanted
    near: dict[tuple[str, str], list[Triple]] = {}
    for each in extra:
        near.setdefault((str(each.subject), str(each.predicate)), []).append(each)
    for each in list(missing):
        others = near.get((str(each.subject), str(each.predicate)), [])
        for other in others:
            if _is_close(each, other):
                missing.discard(each)
                extra.discard(other)
                others.remove(other)
                break
    return len(missing), len(extra)


def _is_close(one: Triple, two: Triple) -> bool:
    from pyoxigraph import Literal

    a, b = one.object, two.object
    if not (isinstance(a, Literal) and isinstance(b, Literal)):
        return False
    if not a.datatype.value == b.datatype.value == _DECIMAL:
        return False
    return abs(Decimal(a.value) - Decimal(b.value)) <= _CLOSE


def _triples(text: bytes) -> set[Triple]:
    """Statements, with numbers and times as a store writes them."""
    import pyoxigraph

    scratch = pyoxigraph.Store()
    scratch.load(text, pyoxigraph.RdfFormat.N_TRIPLES)
    return {quad.triple for quad in scratch}


async def _graph(store: Store, identifier: str, name: str) -> bytes | None:
    try:
        iri = f"{base_of(identifier)}{name}"
        return _bytes(await store.read_graph(iri, N_TRIPLES, gzip=False))
    except MissingGraphError:
        return None


def _bytes(answer: Answer) -> bytes:
    if isinstance(answer.body, bytes):
        return answer.body
    with answer.body as file:
        return file.read()


async def _violations(store: Store, identifier: str, graphs: list[str]) -> list[str]:
    """What the shapes do not allow."""
    import asyncio

    from rdflib import Graph

    from symboslam.engine.validate import validate_map

    union = Graph()
    for name in graphs:
        union.parse(data=await _graph(store, identifier, name) or b"", format="nt")
    found = await asyncio.to_thread(validate_map, union)
    return [str(each) for each in found.violations]
