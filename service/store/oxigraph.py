"""The embedded store: Oxigraph on RocksDB. This process writes; others read.

Why queries run elsewhere: docs/decisions/0010-query-workers.md
"""

from __future__ import annotations

import asyncio
import itertools
from collections.abc import Callable, Sequence
from pathlib import Path
from secrets import token_hex
from typing import TYPE_CHECKING, Any, NoReturn, TypeVar

from symboslam.errors import StoreError
from symboslam.service.store._base import (
    Activity,
    Answer,
    CrashError,
    Document,
    MissingGraphError,
    NotAcceptableError,
    Query,
    QueryError,
    ResultLimitError,
    Store,
)
from symboslam.service.store.documents import parse_all, place_and_problem
from symboslam.service.store.patches import patch_update
from symboslam.service.store.snapshots import Snapshots
from symboslam.service.workers import Pool

if TYPE_CHECKING:
    from pyoxigraph import DefaultGraph, NamedNode, Triple

    from symboslam.service.settings import Settings

T = TypeVar("T")


class OxigraphStore(Store):
    """Graphs in a folder.

    Args:
        settings: where, and all limits.

    Raises:
        StoreError: the folder cannot be made or opened, or another process writes to it.
    """

    def __init__(self, settings: Settings) -> None:
        import pyoxigraph

        self._settings = settings
        folder = settings.data / "store"
        try:
            folder.mkdir(parents=True, exist_ok=True)
            self._store: pyoxigraph.Store | None = pyoxigraph.Store(folder)
        except OSError as error:
            raise StoreError(_opening(settings.data, error)) from error
        self._snapshots = Snapshots(
            settings.data.resolve() / "snapshots", self._backup, lambda: self._pool.snapshots
        )
        self._pool = Pool(
            (settings.data / "spool").resolve(),
            size=settings.workers,
            quick=settings.quick_workers,
            memory=settings.worker_memory,
            queue_length=settings.queue_length,
            queue_seconds=settings.queue_seconds,
        )
        self._start = token_hex(4)  # so that versions of different runs differ
        self._generation = 0
        self._writing = asyncio.Lock()
        self._writes: set[asyncio.Task[Any]] = set()

    @property
    def version(self) -> str:
        """Changes with every write."""
        return f"{self._start}.{self._generation}"

    @property
    def ready(self) -> bool:
        """Open, and somebody there to answer."""
        return self._store is not None and self._pool.alive > 0

    @property
    def activity(self) -> Activity:
        """What it does and has done."""
        pool = self._pool
        return Activity(pool.busy, pool.waiting, pool.timeouts, pool.killed, self._generation)

    @property
    def busy(self) -> int:
        """How many of the workers are not free."""
        return self._pool.busy

    @property
    def workers(self) -> list[int]:
        """Ids of the processes that answer queries."""
        return self._pool.processes

    async def start(self) -> None:
        """Start the workers."""
        try:
            await asyncio.to_thread(self._snapshots.clear)
            await self._pool.start()
        except OSError as error:
            raise StoreError(f"the query workers cannot be started: {error}") from error

    async def stop(self) -> None:
        """Kill the workers, wait for a running update, and close."""
        await self._pool.stop()
        await asyncio.to_thread(self._snapshots.clear)
        async with self._writing:
            if self._store is not None:
                await asyncio.to_thread(self._store.flush)
            self._store = None  # closes it, and lets go of the lock

    async def query(self, query: Query) -> Answer:
        """Answer a query; see `Store`."""
        return await self._ask(
            {
                "kind": "query",
                "text": query.text,
                "base": query.base,
                "union": self._settings.union_default_graph and not query.has_dataset,
                "default_graphs": query.default_graphs,
                "named_graphs": query.named_graphs,
                "formats": query.formats,
            },
            query.gzip,
        )

    async def read_graph(self, graph: str | None, media_type: str, gzip: bool) -> Answer:
        """A whole graph; see `Store`."""
        return await self._ask({"kind": "graph", "graph": graph, "media_type": media_type}, gzip)

    async def update(self, text: str, base: str) -> None:
        """Carry out an update.

        A worker tries it first on an empty store: what is nested so deeply that it ends the
        process ends that one. An update that takes long holds up other writers, not queries.
        """
        await self._ask({"kind": "rehearse", "text": text, "base": base}, False, reads=False)

        await self._write(lambda: self._update(text, base))

    async def patch(self, removed: str, added: str) -> None:
        """Remove and add statements, as one update, which is one transaction.

        No other way of pyoxigraph is atomic. `Store.remove` and `Store.extend` are not, and take
        as long: RocksDB's share of 120 ms for 5,000 lines each way is 100.
        """
        if removed != added:
            await self._write(lambda: self._update(patch_update(removed, added), None))

    async def has_graph(self, graph: str | None) -> bool:
        """Whether a graph is there."""
        return await asyncio.to_thread(self._has, graph)

    async def replace_graph(self, graph: str | None, documents: Sequence[Document]) -> bool:
        """Make a graph hold what the documents say."""
        triples = await asyncio.to_thread(parse_all, documents)

        def write() -> bool:
            if not self._has(graph):
                return self._insert(graph, triples)
            self._replace(graph, triples)
            return False

        return await self._write(write)

    async def add_to_graph(self, graph: str | None, documents: Sequence[Document]) -> bool:
        """Add what the documents say to a graph."""
        triples = await asyncio.to_thread(parse_all, documents)
        return await self._write(lambda: self._insert(graph, triples))

    async def drop_graph(self, graph: str | None) -> None:
        """Remove a graph."""

        def write() -> None:
            if not self._has(graph):
                raise MissingGraphError(f"there is no graph <{graph}>")
            self._open.remove_graph(_name(graph))

        await self._write(write)

    async def graph_names(self, limit: int) -> list[str]:
        """IRIs of named graphs."""

        def names() -> list[str]:
            found = itertools.islice(self._open.named_graphs(), limit)
            return sorted(getattr(name, "value", "") for name in found)

        return await asyncio.to_thread(names)

    @property
    def _open(self) -> Any:
        if self._store is None:
            raise StoreError("the store is closed")
        return self._store

    def _has(self, graph: str | None) -> bool:
        return graph is None or bool(self._open.contains_named_graph(_name(graph)))

    def _insert(self, graph: str | None, triples: list[Triple]) -> bool:
        """Add triples, all or none; whether the graph is new."""
        from pyoxigraph import Quad

        name = _name(graph)
        new = not self._has(graph)
        if triples:
            self._open.extend([Quad(t.subject, t.predicate, t.object, name) for t in triples])
        elif new:
            self._open.add_graph(name)
        return new

    def _update(self, text: str, base: str | None) -> None:
        try:
            self._open.update(text, base_iri=base)
        except (SyntaxError, ValueError) as error:
            raise QueryError(*place_and_problem(error)) from error
        except RuntimeError as error:  # "The graph ... does not exist", and the like
            raise QueryError(str(error)) from error

    def _replace(self, graph: str | None, triples: list[Triple]) -> None:
        """Put triples in the place of others, as one update and so all or nothing."""
        import pyoxigraph

        text = pyoxigraph.serialize(triples, format=pyoxigraph.RdfFormat.N_TRIPLES)
        assert text is not None
        if graph is None:
            self._open.update(f"CLEAR DEFAULT ; INSERT DATA {{\n{text.decode()}}}")
        else:
            inside = f"GRAPH <{graph}> {{\n{text.decode()}}}"
            self._open.update(f"CLEAR GRAPH <{graph}> ; INSERT DATA {{ {inside} }}")

    async def _write(self, write: Callable[[], T]) -> T:
        """One writer at a time, in a thread; what it did is there for the next query.

        It goes on when the request is cancelled: the generation has to count what it does.
        """
        task = asyncio.create_task(self._locked(write))
        self._writes.add(task)
        task.add_done_callback(self._writes.discard)
        return await asyncio.shield(task)

    async def _locked(self, write: Callable[[], T]) -> T:
        async with self._writing:
            try:
                return await asyncio.to_thread(write)
            except OSError as error:
                raise StoreError(f"the store cannot be written: {error}") from error
            finally:
                self._generation += 1

    def _backup(self, folder: str) -> None:
        self._open.backup(folder)

    async def _ask(self, request: dict[str, Any], gzip: bool, *, reads: bool = True) -> Answer:
        limit = self._settings.max_result_bytes
        try:
            reply = await self._pool.ask(
                {**request, "limit": limit, "gzip": gzip},
                self._settings.query_seconds,
                (lambda: self._snapshots.at(self._generation)) if reads else None,
            )
        except CrashError as error:
            problem = "it needs too much memory or is nested too deeply; its process was ended"
            raise CrashError(problem) from error
        if "error" in reply.head:
            _fail(reply.head, request, limit)
        return Answer(reply.head["media_type"], reply.head["size"], reply.body, gzip)


def _fail(reply: dict[str, Any], request: dict[str, Any], limit: int) -> NoReturn:
    """Raise what a worker reports."""
    kind, detail = reply["error"], reply.get("detail", "")
    if kind == "malformed":
        raise QueryError(detail, reply["line"], reply["column"])
    if kind == "not-acceptable":
        raise NotAcceptableError(f"the result is {reply['kind']}, for which no format is accepted")
    if kind == "missing-graph":
        raise MissingGraphError(f"there is no graph <{request['graph']}>")
    if kind == "too-large":
        raise ResultLimitError(f"the result is larger than {limit} bytes; add a LIMIT")
    if kind == "memory":
        raise CrashError("it needs too much memory")
    if kind == "failed":
        raise QueryError(f"it cannot be evaluated: {detail}")
    raise StoreError(f"the store cannot be read: {detail}")


def _name(graph: str | None) -> NamedNode | DefaultGraph:
    from pyoxigraph import DefaultGraph, NamedNode

    return DefaultGraph() if graph is None else NamedNode(graph)


def _opening(data: Path, error: OSError) -> str:
    if "lock" in str(error).lower():
        return f"{data}: another process has this store open; stop it, or take another --data"
    return f"{data}: the store cannot be opened: {error}"
