"""A process that answers queries for the server, one at a time, and that the server may kill.

``python -m symboslam.service.store.reader MEMORY`` reads requests from its standard input and
writes replies to its standard output. Each is a JSON object in a line, a reply followed by as many
bytes as its ``size`` says unless they are in the file that the request names. What it reads is a
snapshot of the store, which nobody writes to.
"""

from __future__ import annotations

import contextlib
import ctypes
import gzip
import io
import json
import os
import shutil
import signal
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any, cast

import pyoxigraph

from symboslam.service.store.documents import place_and_problem
from symboslam.service.vocabulary import PREFIXES, SOLUTIONS, TRIPLES

_PR_SET_PDEATHSIG = 1
INLINE = 256 * 1024
"""Larger results go through a file."""
_SMALL_STACK = 2 * 1024 * 1024
_OVERTIME = 5  # seconds; the server kills sooner, unless it was killed itself
_WITH_PREFIXES = ("TURTLE", "TRIG", "RDF_XML")


class TooLargeError(Exception):
    """The result is over the limit."""


class Kept:
    """Bytes in memory, or in a file once they are many.

    Args:
        path: the file.
    """

    def __init__(self, path: str) -> None:
        self._path = path
        self._target: IO[bytes] = io.BytesIO()
        self.size = 0
        self.in_file = False

    def write(self, data: bytes) -> int:
        """Keep some more."""
        if not self.in_file and self.size + len(data) > INLINE:
            small = self.content()
            self._target = open(self._path, "wb")
            self._target.write(small)
            self.in_file = True
        self._target.write(data)
        self.size += len(data)
        return len(data)

    def flush(self) -> None:
        """Let others see what is in the file."""
        self._target.flush()

    def content(self) -> bytes:
        """The bytes, unless they are in the file."""
        return self._target.getvalue() if isinstance(self._target, io.BytesIO) else b""

    def close(self) -> None:
        """Close the file, which stays."""
        self._target.close()

    def discard(self) -> None:
        """Close the file and remove it."""
        self._target.close()
        if self.in_file:
            os.unlink(self._path)


class Sink:
    """Takes a result: counts it, compresses it, keeps it.

    Args:
        path: the file for a result that is not small.
        limit: bytes before compression.
        compress: whether to.
    """

    def __init__(self, path: str, limit: int, compress: bool) -> None:
        self.kept = Kept(path)
        self.too_large = False
        self._left = limit
        self._gzip: gzip.GzipFile | None = None
        if compress:
            self._gzip = gzip.GzipFile("", "wb", 1, self.kept, mtime=0)

    def write(self, data: bytes) -> int:
        """Take some more.

        Raises:
            TooLargeError: it is more than the limit; ``too_large`` says so too.
        """
        self._left -= len(data)
        if self._left < 0:
            self.too_large = True
            raise TooLargeError
        return self._gzip.write(data) if self._gzip else self.kept.write(data)

    def flush(self) -> None:
        """Nothing: it is all written at the end."""

    def finish(self) -> tuple[int, bytes]:
        """How many bytes there are, and they themselves unless they are in the file."""
        if self._gzip:
            self._gzip.close()
        self.kept.flush()
        content = self.kept.content()
        self.kept.close()
        return self.kept.size, content


class Reader:
    """The snapshot that was asked for last, kept open."""

    def __init__(self) -> None:
        self._store: pyoxigraph.Store | None = None
        self._path = ""

    def at(self, path: str) -> pyoxigraph.Store:
        """The snapshot in a folder.

        Raises:
            OSError: it cannot be opened.
        """
        if self._store is None or path != self._path:
            self._store = None  # closes the other one
            self._store = pyoxigraph.Store.read_only(path)
            self._path = path
        return self._store


def answer(reader: Reader, request: dict[str, Any], sink: IO[bytes]) -> dict[str, Any]:
    """Carry out a request; the reply says ``media_type`` or ``error``."""
    if request["kind"] == "rehearse":
        return _rehearse(request)
    store = reader.at(request["snapshot"])
    if request["kind"] == "graph":
        return _graph(store, request, sink)
    return _query(store, request, sink)


def _query(store: pyoxigraph.Store, request: dict[str, Any], sink: IO[bytes]) -> dict[str, Any]:
    graphs: dict[str, Any] = {}
    if request["default_graphs"] or request["named_graphs"]:
        # Given by the protocol, which leaves nothing of what the query itself may say.
        graphs["default_graph"] = [pyoxigraph.NamedNode(g) for g in request["default_graphs"]]
        graphs["named_graphs"] = [pyoxigraph.NamedNode(g) for g in request["named_graphs"]]
    try:
        result = store.query(
            request["text"],
            base_iri=request["base"],
            use_default_graph_as_union=request["union"] and not graphs,
            custom_functions=_functions(request["text"]),
            **graphs,
        )
    except (SyntaxError, ValueError) as error:
        return _malformed(error)
    solutions, boolean, triples = request["formats"]
    if isinstance(result, pyoxigraph.QueryTriples):
        if triples is None:
            return {"error": "not-acceptable", "kind": "a graph"}
        name = TRIPLES[triples]
        rdf_format = getattr(pyoxigraph.RdfFormat, name)
        if name in _WITH_PREFIXES:
            pyoxigraph.serialize(result, sink, rdf_format, prefixes=PREFIXES)
        else:
            result.serialize(sink, rdf_format)
        return {"media_type": triples}
    is_boolean = isinstance(result, pyoxigraph.QueryBoolean)
    media_type = boolean if is_boolean else solutions
    if media_type is None:
        return {"error": "not-acceptable", "kind": "true or false" if is_boolean else "a table"}
    result.serialize(sink, getattr(pyoxigraph.QueryResultsFormat, SOLUTIONS[media_type]))
    return {"media_type": media_type}


def _functions(text: str) -> dict[Any, Any]:
    """The functions of ours that a text may call; they take a while to load."""
    if "geosparql" not in text:
        return {}
    from symboslam.service.store.geosparql import FUNCTIONS

    return FUNCTIONS


def _graph(store: pyoxigraph.Store, request: dict[str, Any], sink: IO[bytes]) -> dict[str, Any]:
    graph = pyoxigraph.NamedNode(request["graph"]) if request["graph"] else None
    if graph is not None and not store.contains_named_graph(graph):
        return {"error": "missing-graph"}
    name = TRIPLES[request["media_type"]]
    store.dump(
        sink,
        getattr(pyoxigraph.RdfFormat, name),
        from_graph=graph or pyoxigraph.DefaultGraph(),
        prefixes=PREFIXES if name in _WITH_PREFIXES else None,
    )
    return {"media_type": request["media_type"]}


def _rehearse(request: dict[str, Any]) -> dict[str, Any]:
    """Try an update: does it parse, does it leave the process alive, does it end in time?

    On an empty store first, with a quarter of the server's stack, so that what passes here is far
    from the end of that; then, if there is a snapshot, on a copy of it.
    """
    reply: dict[str, Any] = {"media_type": ""}

    def rehearse() -> None:
        try:
            pyoxigraph.Store().update(request["text"], base_iri=request["base"])
        except (SyntaxError, ValueError) as error:
            reply.update(_malformed(error))
        except (RuntimeError, OSError):
            pass  # a graph that is not there, or the like; the true store knows better
        if "error" not in reply and "snapshot" in request:
            with _copy(Path(request["snapshot"]), Path(request["copy"])) as copy:
                with contextlib.suppress(RuntimeError):
                    copy.update(
                        request["text"],
                        base_iri=request["base"],
                        custom_functions=_functions(request["text"]),
                    )

    failed: list[Exception] = []

    def run() -> None:
        try:
            rehearse()
        except Exception as error:
            failed.append(error)

    before = threading.stack_size(_SMALL_STACK)
    thread = threading.Thread(target=run)
    thread.start()
    threading.stack_size(before)
    thread.join()
    if failed:
        raise failed[0]
    return reply


@contextlib.contextmanager
def _copy(snapshot: Path, folder: Path) -> Iterator[pyoxigraph.Store]:
    """A snapshot that can be written; its tables, which never change, are links."""
    shutil.rmtree(folder, ignore_errors=True)
    try:
        folder.mkdir()
        for file in snapshot.iterdir():
            put = os.link if file.suffix == ".sst" else shutil.copyfile
            put(file, folder / file.name)
        yield pyoxigraph.Store(str(folder))
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _malformed(error: Exception) -> dict[str, Any]:
    problem, line, column = place_and_problem(error)
    return {"error": "malformed", "detail": problem, "line": line, "column": column}


def handle(reader: Reader, request: dict[str, Any]) -> tuple[dict[str, Any], bytes]:
    """A request's reply and the bytes that follow it."""
    sink = Sink(request["file"], request["limit"], request["gzip"])
    try:
        reply = answer(reader, request, cast("IO[bytes]", sink))
        if "error" not in reply:
            size, content = sink.finish()
            return {**reply, "size": size, "in_file": sink.kept.in_file}, content
    except Exception as error:  # pyoxigraph may wrap what the sink raises
        if sink.too_large:
            reply = {"error": "too-large"}
        elif isinstance(error, MemoryError):
            reply = {"error": "memory"}
        else:
            of_the_store = isinstance(error, OSError) or "IO error" in str(error)
            kind = "store" if of_the_store else "failed"
            reply = {"error": kind, "detail": str(error)}
    sink.kept.discard()
    return reply, b""


def main() -> None:
    """Answer requests until there are no more."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the server, which ends us
    _die_with_parent()
    _limit_memory(int(sys.argv[1]))
    reader = Reader()
    source, target = sys.stdin.buffer, sys.stdout.buffer
    for line in source:
        request = json.loads(line)
        if hasattr(signal, "alarm"):
            signal.alarm(int(request["seconds"]) + _OVERTIME)  # ends us, whatever we are in
        reply, content = handle(reader, request)
        if hasattr(signal, "alarm"):
            signal.alarm(0)
        target.write(json.dumps(reply).encode() + b"\n" + content)
        target.flush()


def _limit_memory(size: int) -> None:
    try:
        import resource
    except ImportError:  # not on Windows
        return
    if size:
        resource.setrlimit(resource.RLIMIT_DATA, (size, size))


def _die_with_parent() -> None:
    """Let the system end us when the server is gone, whatever we are in (Linux; prctl(2))."""
    with contextlib.suppress(OSError, AttributeError):
        ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, signal.SIGKILL)


if __name__ == "__main__":
    main()
