"""A SPARQL 1.1 store elsewhere, over HTTP."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Iterator, Mapping, Sequence
from contextlib import asynccontextmanager, contextmanager
from typing import TYPE_CHECKING, Any

from symboslam.errors import StoreError
from symboslam.service.limits import long_turn
from symboslam.service.store._base import (
    Answer,
    BusyError,
    Document,
    Formats,
    MissingGraphError,
    Query,
    QueryError,
    Store,
    TimeLimitError,
)
from symboslam.service.store.documents import parse_all
from symboslam.service.store.endpoint import Endpoint, canonical, chosen, keep
from symboslam.service.store.patches import patch_update
from symboslam.service.vocabulary import N_TRIPLES, SOLUTIONS, SPARQL_UPDATE, TRIPLES

if TYPE_CHECKING:
    import httpx
    from pyoxigraph import Triple

    from symboslam.service.settings import Settings

_JSON = next(iter(SOLUTIONS))
_DATASETS = ("N_QUADS", "TRIG")
_MOST_GRAPHS = 5000


class RemoteStore(Store):
    """Graphs in a store that has a URL.

    Args:
        settings: its addresses, who we are there, and all limits.
    """

    def __init__(self, settings: Settings) -> None:
        assert settings.store is not None
        self._settings = settings
        self._url = settings.store
        self._update_url = settings.store_update or _beside(settings.store, "update")
        self._graphs_url = settings.store_graphs
        if self._graphs_url is None and settings.store.endswith("/sparql"):
            self._graphs_url = _beside(settings.store, "data")
        self._spool = settings.data / "spool"
        self._endpoint: Endpoint | None = None
        self._free = asyncio.Semaphore(settings.workers)
        self._waiting = 0
        self._writing = asyncio.Lock()

    @property
    def version(self) -> None:
        """None: others may write to it."""
        return None

    @property
    def ready(self) -> bool:
        """Whether the last contact succeeded."""
        return self._endpoint is not None and self._endpoint.reached

    async def start(self) -> None:
        """Look whether it is there.

        Raises:
            StoreError: it is not, or it is no SPARQL endpoint.
        """
        try:
            self._spool.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise StoreError(f"{self._spool} cannot be made: {error}") from error
        self._endpoint = Endpoint(self._settings)
        try:
            await self._ask("ASK {}")
        except StoreError as error:
            raise StoreError(f"{self._url}: {error}") from error

    async def stop(self) -> None:
        """Close all connections, when a running update is done."""
        async with self._writing:
            if self._endpoint is not None:
                await self._endpoint.close()
            self._endpoint = None

    async def query(self, query: Query) -> Answer:
        """Answer a query; see `Store`. What kind of result it has, the response says."""
        form = [("query", _with_base(query.text, query.base)), *await self._dataset(query)]
        with _counted_from_base():
            async with self._asked(query.formats, form) as response:
                media_type = chosen(response, query.formats)
                return await self._keep(response, media_type, query.gzip)

    async def read_graph(self, graph: str | None, media_type: str, gzip: bool) -> Answer:
        """A whole graph; see `Store`."""
        if not await self.has_graph(graph):
            raise MissingGraphError(f"there is no graph <{graph}>")
        accept = canonical(media_type, TRIPLES)
        if self._graphs_url is None or TRIPLES[media_type] in _DATASETS:  # not for one graph
            text = f"CONSTRUCT {{ ?s ?p ?o }} WHERE {{ {_pattern(graph)} }}"
            asked = self._asked(Formats(None, None, accept), [("query", text)])
        else:
            asked = self._slot("GET", self._graphs_url, params=_named(graph), accept=accept)
        async with asked as response:
            chosen(response, Formats(None, None, accept))
            return await self._keep(response, media_type, gzip)

    async def update(self, text: str, base: str) -> None:
        """Carry out an update; all or nothing where the store does so."""
        with _counted_from_base():
            await self._update(_with_base(text, base))

    async def patch(self, removed: str, added: str) -> None:
        """Remove and add statements."""
        if text := patch_update(removed, added):
            await self._update(text)

    async def has_graph(self, graph: str | None) -> bool:
        """Whether a graph is there, which it is if it has statements."""
        return graph is None or await self._ask(f"ASK {{ {_pattern(graph)} }}")

    async def replace_graph(self, graph: str | None, documents: Sequence[Document]) -> bool:
        """Make a graph hold what the documents say."""
        return await self._put("PUT", graph, await asyncio.to_thread(parse_all, documents))

    async def replace_graphs(self, graphs: Mapping[str, Document]) -> None:
        """Make several named graphs hold what a document each says, in one request."""
        import pyoxigraph

        before, inside = [], []
        for graph, document in graphs.items():
            triples = await asyncio.to_thread(parse_all, [document])
            data = pyoxigraph.serialize(triples, format=pyoxigraph.RdfFormat.N_TRIPLES) or b""
            before.append(_drop(graph))
            inside.append(f"GRAPH {_iri(graph)} {{\n{data.decode()}}}\n")
        await self._update(" ;\n".join([*before, f"INSERT DATA {{\n{''.join(inside)}}}"]))

    async def add_to_graph(self, graph: str | None, documents: Sequence[Document]) -> bool:
        """Add what the documents say to a graph."""
        return await self._put("POST", graph, await asyncio.to_thread(parse_all, documents))

    async def fill_graph(self, graph: str, text: str) -> None:
        """Make a graph hold our own statements."""
        await self.replace_graph(graph, [Document(N_TRIPLES, text.encode(), graph)])

    async def drop_graph(self, graph: str | None) -> None:
        """Remove a graph."""
        if not await self.has_graph(graph):
            raise MissingGraphError(f"there is no graph <{graph}>")
        await self._update(_drop(graph))

    async def graph_names(self, limit: int) -> list[str]:
        """IRIs of named graphs."""
        text = f"SELECT DISTINCT ?g {{ GRAPH ?g {{}} }} LIMIT {limit}"
        rows = (await self._json(text))["results"]["bindings"]
        return sorted(row["g"]["value"] for row in rows if "g" in row)

    @property
    def _open(self) -> Endpoint:
        if self._endpoint is None:
            raise StoreError("the store is closed")
        return self._endpoint

    async def _dataset(self, query: Query) -> list[tuple[str, str]]:
        """The parameters that say which graphs a query sees."""
        default, named = query.default_graphs, query.named_graphs
        union = self._settings.store_union_graphs
        if not default and not named and union and self._settings.union_default_graph:
            if query.has_dataset:
                return []
            default = union
            if "graph" in query.text.lower():  # it sees the named graphs that are named, no others
                named = tuple(await self.graph_names(_MOST_GRAPHS + 1))
                if len(named) > _MOST_GRAPHS:
                    raise StoreError(
                        "the store has too many graphs: let it make their union itself"
                    )
        return [
            *(("default-graph-uri", graph) for graph in default),
            *(("named-graph-uri", graph) for graph in named),
        ]

    @asynccontextmanager
    async def _asked(
        self, formats: Formats, form: list[tuple[str, str]]
    ) -> AsyncIterator[httpx.Response]:
        """The response to a query, sent as a form, which has room for many graphs."""
        solutions, boolean, triples = formats
        accepted = {canonical(kind, SOLUTIONS) for kind in (solutions, boolean) if kind}
        if triples:
            accepted.add(canonical(triples, TRIPLES))
        data: dict[str, list[str]] = {}
        for name, value in form:
            data.setdefault(name, []).append(value)
        async with self._slot(
            "POST", self._url, data=data, accept=", ".join(sorted(accepted)) or "*/*"
        ) as response:
            yield response

    @asynccontextmanager
    async def _slot(
        self, method: str, url: str, *, accept: str, **given: Any
    ) -> AsyncIterator[httpx.Response]:
        """The response to a request that reads: so many at a time, each within the time limit."""
        async with long_turn():
            if self._free.locked() and self._waiting >= self._settings.queue_length:
                raise BusyError(f"{self._waiting} queries are waiting already")
            self._waiting += 1
            try:
                async with asyncio.timeout(self._settings.queue_seconds):
                    await self._free.acquire()
            except TimeoutError as error:
                problem = f"no other query ended in {self._settings.queue_seconds:g} s"
                raise BusyError(problem) from error
            finally:
                self._waiting -= 1
            seconds = self._settings.query_seconds
            try:
                async with asyncio.timeout(seconds):
                    async with self._open.request(
                        method, url, headers={"Accept": accept}, **given
                    ) as response:
                        yield response
            except TimeoutError as error:
                raise TimeLimitError(f"stopped after {seconds:g} s") from error
            finally:
                self._free.release()

    async def _keep(self, response: httpx.Response, media_type: str, gzip: bool) -> Answer:
        limit = self._settings.max_result_bytes
        return await keep(response, media_type, self._spool, limit, gzip)

    async def _json(self, text: str) -> Any:
        """The result of a query of our own."""
        async with self._asked(Formats(_JSON, _JSON, None), [("query", text)]) as response:
            chosen(response, Formats(_JSON, _JSON, None))
            try:
                return json.loads(await response.aread())
            except ValueError as error:
                raise StoreError("the store does not answer in JSON") from error

    async def _ask(self, text: str) -> bool:
        return bool((await self._json(text)).get("boolean"))

    async def _put(self, method: str, graph: str | None, triples: list[Triple]) -> bool:
        """Send triples; whether the graph is new."""
        import pyoxigraph

        data = pyoxigraph.serialize(triples, format=pyoxigraph.RdfFormat.N_TRIPLES) or b""
        new = not await self.has_graph(graph)
        if self._graphs_url is not None:
            kind = {"Content-Type": N_TRIPLES}
            await self._write(method, self._graphs_url, kind, data, params=_named(graph))
            return new
        inside = data.decode()
        if graph is not None:
            inside = f"GRAPH {_iri(graph)} {{\n{inside}}}"
        before = f"{_drop(graph)} ;\n" if method == "PUT" else ""
        await self._update(f"{before}INSERT DATA {{\n{inside}}}")
        return new

    async def _update(self, text: str) -> None:
        if self._update_url is None:
            raise StoreError("where the store takes updates is not known: SYMBOSLAM_STORE_UPDATE")
        kind = {"Content-Type": SPARQL_UPDATE}
        await self._write("POST", self._update_url, kind, text.encode())

    async def _write(
        self, method: str, url: str, headers: dict[str, str], content: bytes, **given: Any
    ) -> None:
        """Send what changes the store, one at a time."""
        async with self._writing:
            try:
                async with self._open.request(
                    method, url, headers=headers, content=content, **given
                ) as response:
                    await response.aread()
            except TimeLimitError as error:
                problem = "the store did not say in time that it has written; perhaps it will"
                raise StoreError(problem) from error


def _beside(url: str, name: str) -> str | None:
    """The address of another endpoint of a store, where it can be guessed.

    >>> _beside("http://localhost:3030/ds/sparql", "update")
    'http://localhost:3030/ds/update'
    """
    for ending in ("/sparql", "/query"):
        if url.endswith(ending):
            return f"{url.removesuffix(ending)}/{name}"
    return None


def _with_base(text: str, base: str) -> str:
    return f"BASE <{base}>\n{text}"


@contextmanager
def _counted_from_base() -> Iterator[None]:
    """Leave the line with the base, which is ours, out of the place of an error."""
    try:
        yield
    except QueryError as error:
        if error.line is not None:
            error.line = max(1, error.line - 1)
        raise


def _iri(graph: str) -> str:
    from pyoxigraph import NamedNode

    return str(NamedNode(graph))


def _pattern(graph: str | None) -> str:
    return "?s ?p ?o" if graph is None else f"GRAPH {_iri(graph)} {{ ?s ?p ?o }}"


def _drop(graph: str | None) -> str:
    return "CLEAR SILENT DEFAULT" if graph is None else f"DROP SILENT GRAPH {_iri(graph)}"


def _named(graph: str | None) -> dict[str, str]:
    return {"default": ""} if graph is None else {"graph": graph}
