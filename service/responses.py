"""Answers of the store as responses: errors by their type, ETags, files that are sent on."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator, Awaitable, Iterator
from hashlib import sha256
from typing import IO, TypeVar

from fastapi import Request
from fastapi.responses import Response, StreamingResponse

from symboslam.service.problems import Problem
from symboslam.service.sparql.negotiation import with_charset
from symboslam.service.store._base import (
    Answer,
    BusyError,
    CrashError,
    DocumentError,
    MissingGraphError,
    NotAcceptableError,
    QueryError,
    ResultLimitError,
    TimeLimitError,
)

T = TypeVar("T")
_CHUNK = 256 * 1024
VARY = "Accept, Accept-Encoding"


@contextlib.contextmanager
def problems_of_the_store() -> Iterator[None]:
    """Turn errors of a store into problems."""
    try:
        yield
    except DocumentError as error:
        raise _malformed("malformed-graph", error) from error
    except QueryError as error:
        raise _malformed("malformed-query", error) from error
    except NotAcceptableError as error:
        raise Problem(406, "not-acceptable", str(error)) from error
    except MissingGraphError as error:
        raise Problem(404, "missing-graph", str(error)) from error
    except ResultLimitError as error:
        raise Problem(422, "result-too-large", str(error)) from error
    except TimeLimitError as error:
        detail = f"the query was {error}; ask for less, or put MINUS in the place of NOT EXISTS"
        raise Problem(504, "query-timeout", detail) from error
    except CrashError as error:
        raise Problem(422, "query-too-complex", str(error)) from error
    except BusyError as error:
        raise Problem(503, "too-busy", str(error), headers={"Retry-After": "2"}) from error


def _malformed(name: str, error: QueryError) -> Problem:
    detail = str(error)
    if error.line is not None:
        column = "" if error.column is None else f", column {error.column}"
        detail = f"line {error.line}{column}: {detail}"
    return Problem(400, name, detail, line=error.line, column=error.column)


def etag(version: str | None, *parts: object) -> str | None:
    """A weak ETag: results may come in another order.

    Args:
        version: of the store; without one there is no ETag.
        parts: everything else that the response depends on.
    """
    if version is None:
        return None
    rest = sha256("\0".join(str(part) for part in parts).encode()).hexdigest()[:16]
    return f'W/"{version}.{rest}"'


def not_modified(request: Request, tag: str | None) -> Response | None:
    """The response 304 where the client has this ETag already."""
    if tag is None:
        return None
    have = [part.strip() for part in request.headers.get("if-none-match", "").split(",")]
    if tag in have or "*" in have:
        return Response(status_code=304, headers={"ETag": tag, "Vary": VARY})
    return None


def respond(request: Request, answer: Answer, tag: str | None) -> Response:
    """An answer as the response to a request, without the body if it asks HEAD."""
    headers = {"Vary": VARY, "Content-Length": str(answer.size), "Cache-Control": "no-cache"}
    if tag:
        headers["ETag"] = tag
    if answer.gzipped:
        headers["Content-Encoding"] = "gzip"
    headers["Content-Type"] = with_charset(answer.media_type)
    if isinstance(answer.body, bytes):
        return Response(b"" if request.method == "HEAD" else answer.body, headers=headers)
    if request.method == "HEAD":
        answer.body.close()
        return Response(headers=headers)
    return StreamingResponse(_chunks(answer.body), headers=headers)


async def _chunks(file: IO[bytes]) -> AsyncIterator[bytes]:
    with file:
        while chunk := await asyncio.to_thread(file.read, _CHUNK):
            yield chunk


async def unless_disconnected(request: Request, work: Awaitable[T]) -> T:
    """Wait for something as long as the client does; its body has been read.

    Raises:
        Problem: the client is gone; nobody will see it.
    """
    task = asyncio.ensure_future(work)
    gone = asyncio.ensure_future(_disconnect(request))
    try:
        await asyncio.wait({task, gone}, return_when=asyncio.FIRST_COMPLETED)
        if task.done():
            return task.result()
        gone.result()  # raises where it was a body that is too slow, not the client's end
        raise Problem(499, "client-closed-request", "the client is gone")
    finally:
        for each in (task, gone):
            if not each.done():
                each.cancel()
                with contextlib.suppress(asyncio.CancelledError):
                    await each


async def _disconnect(request: Request) -> None:
    while (await request.receive())["type"] != "http.disconnect":
        pass
