"""The embedded store: Oxigraph on RocksDB. This process writes; others read.

Why queries run elsewhere: docs/decisions/0010-query-workers.md
"""

from __future__ import annotations

import asyncio
import itertools
import logging
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
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
from symboslam.service.store.folder import DAMAGED, note, open_folder
from symboslam.service.store.patches import patch_update
from symboslam.service.store.snapshots import Snapshots
from symboslam.service.workers import Pool

if TYPE_CHECKING:
    import pyoxigraph
    from pyoxigraph import DefaultGraph, NamedNode, Triple

    from symboslam.service.settings import Settings

T = TypeVar("T")
_MANY = 1_000_000  # bytes
_log = logging.getLogger(__name__)
_REFUSED = "IO error"
"""How RocksDB begins what it says of writes that the system refuses."""
_AGAIN_SECONDS = 1.0
"""How long after a failure the store is opened anew, and how long after that once more."""


@contextmanager
def _told() -> Iterator[None]:
    """Tell as such what RocksDB finds damaged."""
    try:
        yield
    except RuntimeError as error:
        if str(error).startswith(DAMAGED):
            raise StoreError(f"the store is damaged: {error}") from error
        raise


class OxigraphStore(Store):
    """Graphs in a folder.

    Args:
        settings: where, and all limits.

    Raises:
        StoreError: the folder cannot be made or opened, or another process writes to it.
    """

    def __init__(self, settings: Settings) -> None:
        self._settings = settings
        self._store: pyoxigraph.Store | None = open_folder(settings.data)
        note(settings.data)
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
        self._loop: asyncio.AbstractEventLoop | None = None
        self._trouble: str | None = None
        self._recovering: asyncio.Task[None] | None = None

    @property
    def version(self) -> str:
        """Changes with every write."""
        return f"{self._start}.{self._generation}"

    @property
    def ready(self) -> bool:
        """Open, and somebody there to answer."""
        return self._store is not None and self._trouble is None and self._pool.alive > 0

    @property
    def trouble(self) -> str | None:
        """Why it cannot be written; it is opened anew until it can."""
        return self._trouble

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
        self._loop = asyncio.get_running_loop()
        try:
            await asyncio.to_thread(self._snapshots.clear)
            await self._pool.start()
        except OSError as error:
            raise StoreError(f"the query workers cannot be started: {error}") from error

    async def stop(self) -> None:
        """Kill the workers, wait for a running update, and close."""
        if self._recovering is not None:
            self._recovering.cancel()
            await asyncio.wait([self._recovering])
        await self._pool.stop()
        await asyncio.to_thread(self._snapshots.clear)
        async with self._writing:
            try:
                if self._store is not None:
                    await asyncio.to_thread(self._store.flush)
            except (OSError, RuntimeError) as error:  # what it was told is in its log
                _log.error("the store could not be flushed: %s", error)
            finally:
                self._store = None  # closes it, and lets go of the lock
                await asyncio.to_thread(note, self._settings.data)

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

        A worker tries it first: what is nested so deeply that it ends the process ends that one.
        Where it depends on what is there, it is tried on a copy of the store, and stopped at the
        time limit. An update that takes long holds up other writers, not queries.
        """
        depends = "where" in text.lower()
        await self._ask({"kind": "rehearse", "text": text, "base": base}, False, reads=depends)
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

    async def replace_graphs(self, graphs: Mapping[str, Document]) -> None:
        """Make several named graphs hold what a document each says, as one update."""

        def text() -> str:
            import pyoxigraph

            before, inside = [], []
            for graph, document in graphs.items():
                data = pyoxigraph.serialize(
                    parse_all([document]), format=pyoxigraph.RdfFormat.N_TRIPLES
                )
                before.append(f"CREATE SILENT GRAPH {_name(graph)} ; CLEAR GRAPH {_name(graph)} ;")
                inside.append(f"GRAPH {_name(graph)} {{\n{(data or b'').decode()}}}\n")
            return "\n".join([*before, f"INSERT DATA {{\n{''.join(inside)}}}"])

        update = await asyncio.to_thread(text)
        await self._write(lambda: self._update(update, None))

    async def add_to_graph(self, graph: str | None, documents: Sequence[Document]) -> bool:
        """Add what the documents say to a graph."""
        triples = await asyncio.to_thread(parse_all, documents)
        return await self._write(lambda: self._insert(graph, triples))

    async def fill_graph(self, graph: str, text: str) -> None:
        """Make a graph hold our own statements, by files of their own if they are many."""
        from pyoxigraph import RdfFormat

        def write() -> None:
            name, data = _name(graph), text.encode()
            if self._has(graph):
                self._open.remove_graph(name)
            load = self._open.bulk_load if len(data) > _MANY else self._open.load
            load(data, RdfFormat.N_TRIPLES, to_graph=name)
            self._open.add_graph(name)

        await self._write(write)

    async def drop_graph(self, graph: str | None) -> None:
        """Remove a graph."""

        def write() -> None:
            if not self._has(graph):
                raise MissingGraphError(f"there is no graph <{graph}>")
            self._open.remove_graph(_name(graph))

        await self._write(write)

    async def graph_names(self, limit: int) -> list[str]:
        """IRIs of named graphs."""

        @_told()
        def names() -> list[str]:
            found = itertools.islice(self._open.named_graphs(), limit)
            return sorted(getattr(name, "value", "") for name in found)

        return await asyncio.to_thread(names)

    async def copy_to(self, folder: Path) -> bool:
        """Put a copy into a folder on the same disk: hard links, which cost no space at first."""
        try:
            await asyncio.to_thread(self._backup, str(folder))
        except OSError as error:
            raise StoreError(f"the store cannot be copied: {error}") from error
        return True

    @property
    def _open(self) -> Any:
        if self._store is None:
            raise StoreError(self._trouble or "the store is closed")
        return self._store

    @_told()
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
        from symboslam.service.store.geosparql import FUNCTIONS

        try:
            with _told():
                self._open.update(text, base_iri=base, custom_functions=FUNCTIONS)
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
            if self._trouble is not None:
                raise StoreError(self._trouble)
            try:
                with _told():
                    found = await asyncio.to_thread(write)
            except OSError as error:
                self._fail(error)
                raise StoreError(f"the store cannot be written: {error}") from error
            except BaseException:
                self._generation += 1
                raise
            self._generation += 1
            return found

    @_told()
    def _backup(self, folder: str) -> None:
        try:
            self._open.backup(folder)
        except OSError as error:
            if self._loop is not None:
                self._loop.call_soon_threadsafe(self._fail, error)
            raise

    def _fail(self, error: OSError) -> None:
        """Take no more writes until the store was opened anew.

        RocksDB refuses every write after one that failed, as on a full disk, until it is opened
        anew. What it acknowledged is there, what failed is not. Queries go on with the last
        snapshot, if nothing was written since.
        """
        if self._trouble is None and str(error).startswith(_REFUSED):  # not of a LOAD
            self._trouble = f"the store cannot be written until it has recovered: {error}"
            _log.error(self._trouble)
            self._recovering = asyncio.create_task(self._recover())

    async def _recover(self) -> None:
        while self._trouble is not None:
            await asyncio.sleep(_AGAIN_SECONDS)
            async with self._writing:
                try:
                    await asyncio.to_thread(self._open_anew)
                except StoreError as error:
                    self._trouble = str(error)
                    continue
                self._trouble = None
                self._generation += 1
        _log.warning("the store can be written again")

    def _open_anew(self) -> None:
        self._store = None  # closes it, unless a snapshot is being made, which has an end
        self._store = open_folder(self._settings.data)

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
    if kind == "failed" and detail.startswith(DAMAGED):
        raise StoreError(f"the store is damaged: {detail}")
    if kind == "failed":
        raise QueryError(f"it cannot be evaluated: {detail}")
    raise StoreError(f"the store cannot be read: {detail}")


def _name(graph: str | None) -> NamedNode | DefaultGraph:
    from pyoxigraph import DefaultGraph, NamedNode

    return DefaultGraph() if graph is None else NamedNode(graph)
