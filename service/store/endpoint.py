"""HTTP to a SPARQL store elsewhere: its failures by their kind, its results within a limit."""

from __future__ import annotations

import asyncio
import contextlib
import gzip
import re
from collections.abc import AsyncIterator
from http import HTTPStatus
from pathlib import Path
from tempfile import SpooledTemporaryFile
from typing import IO, TYPE_CHECKING, Any, cast

import httpx

from symboslam.errors import StoreError
from symboslam.service.store._base import (
    Answer,
    Formats,
    NotAcceptableError,
    QueryError,
    ResultLimitError,
    TimeLimitError,
)
from symboslam.service.vocabulary import SOLUTIONS, TRIPLES

if TYPE_CHECKING:
    from symboslam.service.settings import Settings

_CONNECT_SECONDS = 5.0
_PROBE_SECONDS = 5.0
_INLINE = 256 * 1024  # larger results go through a file
_MOST_OF_A_PROBLEM = 4096  # bytes
_LONGEST = 300
_PLACE = re.compile(r"(?: at)? ?\bline (\d+),? col(?:umn)?:? ?(\d+)[.:,]? ?", re.IGNORECASE)
_GONE = (HTTPStatus.BAD_GATEWAY, HTTPStatus.SERVICE_UNAVAILABLE, HTTPStatus.GATEWAY_TIMEOUT)


class Endpoint:
    """Sends requests to a store and looks whether it is there.

    Args:
        settings: who we are there, and the time limit.
    """

    def __init__(self, settings: Settings) -> None:
        auth: httpx.Auth | None = None
        headers = {}
        if settings.store_token is not None:
            headers["Authorization"] = f"Bearer {settings.store_token.get_secret_value()}"
        elif settings.store_user is not None:
            password = settings.store_password
            auth = httpx.BasicAuth(
                settings.store_user, password.get_secret_value() if password else ""
            )
        self._client = httpx.AsyncClient(
            auth=auth,
            headers=headers,
            timeout=httpx.Timeout(settings.query_seconds, connect=_CONNECT_SECONDS, pool=None),
            limits=httpx.Limits(max_connections=None),
        )  # redirects are not followed: our credentials are for nobody else
        self._url = settings.store or ""
        self._reached = False
        self._probing: asyncio.Task[None] | None = None

    @property
    def reached(self) -> bool:
        """Whether the last contact succeeded."""
        return self._reached

    async def close(self) -> None:
        """Close all connections."""
        if self._probing is not None:
            self._probing.cancel()
        await self._client.aclose()

    @contextlib.asynccontextmanager
    async def request(self, method: str, url: str, **given: Any) -> AsyncIterator[httpx.Response]:
        """Send a request; whoever asks reads the body of the response.

        Args:
            method: of HTTP.
            url: where to.
            given: parameters, headers and content, as httpx takes them.

        Raises:
            QueryError: the store finds what was sent malformed.
            NotAcceptableError: it has none of the formats.
            TimeLimitError: it was too slow.
            StoreError: it cannot be reached, refuses us, or fails.
        """
        try:
            async with self._client.stream(method, url, **given) as response:
                self._reached = True
                if not response.is_success:
                    raise await self._failure(response)
                yield response
        except httpx.ReadTimeout as error:
            raise TimeLimitError("too slow: the store did not answer in time") from error
        except (httpx.HTTPError, httpx.InvalidURL) as error:
            self._lost()
            connecting = isinstance(error, httpx.ConnectError | httpx.ConnectTimeout)
            what = "the store cannot be reached" if connecting else "the store's answer broke off"
            raise StoreError(f"{what}: {str(error) or type(error).__name__}") from error

    async def _failure(self, response: httpx.Response) -> StoreError:
        """What a response that is no success means."""
        status = response.status_code
        text = await _beginning(response)
        if status == HTTPStatus.BAD_REQUEST:
            return QueryError(*problem_and_place(text))
        if status == HTTPStatus.NOT_ACCEPTABLE:
            return NotAcceptableError("the store has none of the formats that are accepted")
        if status == HTTPStatus.REQUEST_TIMEOUT or (status in _GONE and "timed out" in text):
            return TimeLimitError("stopped by the store at its own time limit")
        if status in (HTTPStatus.UNAUTHORIZED, HTTPStatus.FORBIDDEN):
            hint = "SYMBOSLAM_STORE_USER and _PASSWORD, or SYMBOSLAM_STORE_TOKEN"
            return StoreError(f"the store refuses us (status {status}): look at {hint}")
        if response.has_redirect_location:
            where = response.headers["location"]
            return StoreError(f"the store is elsewhere, at {where}: set that address itself")
        if status in _GONE:
            self._lost()
        first = text.strip().partition("\n")[0][:_LONGEST]
        return StoreError(f"the store failed with status {status}" + (first and f": {first}"))

    def _lost(self) -> None:
        """Look from time to time whether the store is there again."""
        self._reached = False
        if self._probing is None or self._probing.done():
            self._probing = asyncio.create_task(self._probe())

    async def _probe(self) -> None:
        while True:
            with contextlib.suppress(httpx.HTTPError):
                response = await self._client.get(self._url, params={"query": "ASK {}"})
                self._reached = response.status_code not in _GONE
            if self._reached:
                return
            await asyncio.sleep(_PROBE_SECONDS)


async def keep(
    response: httpx.Response, media_type: str, folder: Path, limit: int, compress: bool
) -> Answer:
    """A whole result, in memory or in a file without a name.

    Args:
        response: where it comes from.
        media_type: what the client is told that it is.
        folder: for the file.
        limit: bytes before compression.
        compress: whether to.

    Raises:
        ResultLimitError: it is larger than the limit; the rest is not read.
    """
    kept = cast("IO[bytes]", SpooledTemporaryFile(_INLINE, dir=str(folder)))
    target = gzip.GzipFile("", "wb", 1, kept, mtime=0) if compress else kept
    left = limit
    try:
        async for chunk in response.aiter_bytes():
            left -= len(chunk)
            if left < 0:
                problem = f"the result is larger than {limit} bytes; add a LIMIT"
                raise ResultLimitError(problem)
            target.write(chunk)
        if compress:
            target.close()  # its end; the file stays open
        size = kept.tell()
        kept.seek(0)
    except BaseException:
        kept.close()
        raise
    if size > _INLINE:
        return Answer(media_type, size, kept, compress)
    with kept:
        return Answer(media_type, size, kept.read(), compress)


def canonical(media_type: str, table: dict[str, str]) -> str:
    """The first media type of a format.

    >>> canonical("application/json", TRIPLES)
    'application/ld+json'
    """
    return next(name for name, value in table.items() if value == table[media_type])


def chosen(response: httpx.Response, formats: Formats) -> str:
    """Under which of the accepted names a result goes.

    Raises:
        NotAcceptableError: there is none for its kind.
        StoreError: it is no result of SPARQL.
    """
    received = response.headers.get("content-type", "").partition(";")[0].strip().lower()
    solutions, boolean, triples = formats
    for wanted, table in ((solutions, SOLUTIONS), (boolean, SOLUTIONS), (triples, TRIPLES)):
        if wanted is not None and received == canonical(wanted, table):
            return wanted
    if received in SOLUTIONS or received in TRIPLES:
        kind = "a table, or true or false" if received in SOLUTIONS else "a graph"
        raise NotAcceptableError(f"the result is {kind}, for which no format is accepted")
    raise StoreError(f"it is no SPARQL endpoint: it answers {received or 'without a media type'}")


def problem_and_place(text: str) -> tuple[str, int | None, int | None]:
    """Problem, line and column in what a store says of a malformed query.

    >>> problem_and_place('Parse error: Encountered "<EOF>" at line 3, column 9. Was expecting: x')
    ('Encountered "<EOF>"', 3, 9)
    """
    line = column = None
    text = " ".join(text.partition("Was expecting")[0].removeprefix("Parse error:").split())
    if found := _PLACE.search(text):
        line, column = int(found[1]), int(found[2])
        text = f"{text[: found.start()]} {text[found.end() :]}".strip()
    if len(text) > _LONGEST:
        text = text[:_LONGEST].rsplit(" ", 1)[0] + " ..."
    return text or "the store finds it malformed", line, column


async def _beginning(response: httpx.Response) -> str:
    """The beginning of a text that says what is wrong; nothing of a page for people."""
    if "html" in response.headers.get("content-type", ""):
        return ""
    found = bytearray()
    async for chunk in response.aiter_bytes():
        found += chunk
        if len(found) >= _MOST_OF_A_PROBLEM:
            break
    return found[:_MOST_OF_A_PROBLEM].decode(errors="replace")
