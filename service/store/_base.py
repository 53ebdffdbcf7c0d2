"""What every store can do: queries, updates and whole graphs, behind one small interface."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO, NamedTuple

from symboslam.errors import StoreError


class Formats(NamedTuple):
    """Media types that a client takes, by the kind of result; None: it takes none of ours.

    Whether a query gives solutions, a boolean or triples is known only once it is parsed.
    """

    solutions: str | None
    boolean: str | None
    triples: str | None


@dataclass(frozen=True)
class Query:
    """A SPARQL query with all that its request says.

    Attributes:
        text: the query.
        base: the IRI that relative ones are resolved against.
        formats: what the client takes.
        default_graphs: IRIs of the protocol's default graphs.
        named_graphs: IRIs of the protocol's named graphs.
        has_dataset: the query has ``FROM`` clauses; then there is no union of all graphs.
        gzip: the client takes compressed results.
    """

    text: str
    base: str
    formats: Formats
    default_graphs: tuple[str, ...] = ()
    named_graphs: tuple[str, ...] = ()
    has_dataset: bool = False
    gzip: bool = False


@dataclass(frozen=True)
class Document:
    """A graph as it was sent.

    Attributes:
        media_type: one of ``vocabulary.UPLOADS``.
        data: its content, in UTF-8.
        base: the IRI that relative ones are resolved against.
    """

    media_type: str
    data: bytes
    base: str


@dataclass(frozen=True)
class Answer:
    """A complete result.

    Attributes:
        media_type: of the body before compression.
        size: bytes of the body.
        body: the bytes, or a file to read and close.
        gzipped: the body is compressed.
    """

    media_type: str
    size: int
    body: bytes | IO[bytes]
    gzipped: bool = False


class Activity(NamedTuple):
    """What a store does, and has done since it was started, for `metrics`."""

    running: int = 0
    waiting: int = 0
    timeouts: int = 0
    killed: int = 0
    writes: int = 0


class QueryError(StoreError):
    """A query or update that does not parse.

    Args:
        problem: what is wrong.
        line: where, from 1.
        column: where, from 1.
    """

    def __init__(self, problem: str, line: int | None = None, column: int | None = None) -> None:
        super().__init__(problem)
        self.line, self.column = line, column


class DocumentError(QueryError):
    """An uploaded graph that does not parse, or that is refused."""


class NotAcceptableError(StoreError):
    """The client takes none of the formats in which the result could be written."""


class MissingGraphError(StoreError):
    """A graph that is not in the store."""


class TimeLimitError(StoreError):
    """A query that took too long and was stopped."""


class ResultLimitError(StoreError):
    """A result over the size limit."""


class CrashError(StoreError):
    """A query that brought its process down, as one does that needs too much memory."""


class BusyError(StoreError):
    """Too many queries at a time."""


class Store(ABC):
    """A set of named graphs and a default graph, which is meant by the name None."""

    @property
    @abstractmethod
    def version(self) -> str | None:
        """Changes with every write, part of every ETag; None: others may write, so no ETag."""

    @property
    @abstractmethod
    def ready(self) -> bool:
        """Whether queries can be answered now."""

    @property
    def trouble(self) -> str | None:
        """What keeps it from being written until it has recovered; None: nothing."""
        return None

    @property
    def activity(self) -> Activity:
        """What it does; zeros where a store does not know."""
        return Activity()

    @abstractmethod
    async def start(self) -> None:
        """Get ready to answer."""

    @abstractmethod
    async def stop(self) -> None:
        """Stop what runs and close."""

    @abstractmethod
    async def query(self, query: Query) -> Answer:
        """Answer a query.

        Raises:
            QueryError: it does not parse.
            NotAcceptableError: no format for its kind of result is acceptable.
            TimeLimitError: it took too long.
            ResultLimitError: its result is too large.
            CrashError: it needed too much memory or nested too deeply.
            BusyError: there are too many others.
        """

    @abstractmethod
    async def read_graph(self, graph: str | None, media_type: str, gzip: bool) -> Answer:
        """A whole graph; its errors are those of `query`, and one more.

        Raises:
            MissingGraphError: it is not there.
        """

    @abstractmethod
    async def update(self, text: str, base: str) -> None:
        """Carry out a SPARQL update, all of it or nothing.

        Raises:
            QueryError: it does not parse, or asks for what cannot be done.
            TimeLimitError, CrashError, BusyError: as for `query`, while it is looked at.
        """

    @abstractmethod
    async def patch(self, removed: str, added: str) -> None:
        """Remove and add statements, all of it or nothing.

        Args:
            removed: lines of N-Quads without blank nodes, each in a named graph.
            added: the same; what is in both stays.

        Raises:
            QueryError: a line is none.
            StoreError: it cannot be written.
        """

    @abstractmethod
    async def has_graph(self, graph: str | None) -> bool:
        """Whether a graph is there; the default graph always is.

        A store need not know graphs without statements.
        """

    @abstractmethod
    async def replace_graph(self, graph: str | None, documents: Sequence[Document]) -> bool:
        """Make a graph hold what the documents say and nothing else; whether it is new.

        Raises:
            DocumentError: a document does not parse; the graph is as it was.
        """

    @abstractmethod
    async def replace_graphs(self, graphs: Mapping[str, Document]) -> None:
        """Make several named graphs hold what a document each says, all of them or none.

        Raises:
            DocumentError: a document does not parse; the graphs are as they were.
        """

    @abstractmethod
    async def add_to_graph(self, graph: str | None, documents: Sequence[Document]) -> bool:
        """Add what the documents say to a graph; whether it is new.

        Raises:
            DocumentError: a document does not parse; the graph is as it was.
        """

    @abstractmethod
    async def fill_graph(self, graph: str, text: str) -> None:
        """Make a graph hold our own statements and nothing else, as fast as may be.

        Not all or nothing: whoever calls must be able to do it again.

        Args:
            graph: its name.
            text: N-Triples without blank nodes.

        Raises:
            StoreError: it cannot be written.
        """

    @abstractmethod
    async def drop_graph(self, graph: str | None) -> None:
        """Remove a graph, or empty the default graph.

        Raises:
            MissingGraphError: it is not there.
        """

    @abstractmethod
    async def graph_names(self, limit: int) -> list[str]:
        """IRIs of up to so many named graphs, in their order."""

    async def copy_to(self, folder: Path) -> bool:
        """Put a copy of everything into a folder that is not there; False: it is elsewhere.

        Raises:
            StoreError: it cannot be made.
        """
        return False
