"""What a request says: its body within limits, its parameters, its media type."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator
from email.message import Message
from pathlib import Path
from urllib.parse import unquote_to_bytes

from fastapi import Request
from fastapi.dependencies.models import Dependant

from symboslam.errors import StoreError
from symboslam.reasoning.matching import unknown_name
from symboslam.service.problems import Problem
from symboslam.service.settings import Settings

_UTF_8 = ("utf-8", "utf8", "us-ascii")
_MOST_PARAMETERS = 1000


class Parameters:
    """Parameters of a query string or form, in order; nothing is passed over silently.

    Args:
        encoded: as they were sent.

    Raises:
        Problem: not UTF-8, or too many.
    """

    def __init__(self, encoded: bytes = b"") -> None:
        self._pairs: list[tuple[str, str]] = []
        parts = [part for part in encoded.split(b"&") if part]
        if len(parts) > _MOST_PARAMETERS:
            raise Problem(400, "too-many-parameters", f"more than {_MOST_PARAMETERS} parameters")
        for part in parts:
            name, _, value = part.partition(b"=")
            self._pairs.append((_decode(name), _decode(value)))

    def __contains__(self, name: object) -> bool:
        return any(name == key for key, _ in self._pairs)

    @property
    def names(self) -> tuple[str, ...]:
        """Each name once, in the order of their first use."""
        return tuple(dict.fromkeys(name for name, _ in self._pairs))

    def all(self, name: str) -> tuple[str, ...]:
        """All values of a parameter."""
        return tuple(value for key, value in self._pairs if key == name)

    def find(self, name: str) -> str | None:
        """The value of a parameter that may be given once.

        Raises:
            Problem: it is given more often.
        """
        values = self.all(name)
        if len(values) > 1:
            detail = f"the parameter {name!r} is given {len(values)} times; give it once"
            raise Problem(400, "repeated-parameter", detail, parameter=name)
        return values[0] if values else None

    def iris(self, name: str) -> tuple[str, ...]:
        """All values of a parameter, which are absolute IRIs.

        Raises:
            Problem: one is not.
        """
        return tuple(absolute_iri(value, name) for value in self.all(name))

    def __add__(self, other: Parameters) -> Parameters:
        both = Parameters()
        both._pairs = self._pairs + other._pairs
        return both


def _decode(text: bytes) -> str:
    try:
        return unquote_to_bytes(text.replace(b"+", b" ")).decode()
    except UnicodeDecodeError as error:
        raise Problem(400, "not-utf-8", "a parameter is not UTF-8, percent-encoded") from error


def absolute_iri(text: str, parameter: str) -> str:
    """An absolute IRI, checked.

    Raises:
        Problem: it is not one.
    """
    import pyoxigraph

    try:
        return pyoxigraph.NamedNode(text).value
    except ValueError as error:
        detail = f"{parameter}: {text!r} is not an absolute IRI: {error}"
        raise Problem(400, "not-an-iri", detail, parameter=parameter) from error


def url_parameters(request: Request) -> Parameters:
    """The parameters in the address of a request."""
    return Parameters(request.scope["query_string"])


async def known_parameters(request: Request) -> None:
    """A dependency of routers: the address has no parameter but those that its route declares.

    Raises:
        Problem: 422 where it has another one; 400 where one is repeated or not UTF-8.
    """
    known = sorted(_query_names(request.scope["route"].dependant))
    sent = url_parameters(request)
    for name in sent.names:
        if name not in known:
            hint = str(unknown_name("parameter", name[:80], known)) if known else (
                f"there is no parameter {name[:80]!r}: this address takes none"
            )  # fmt: skip
            raise Problem(422, "unknown-parameter", hint, parameter=name[:80])
        sent.find(name)


def _query_names(dependant: Dependant) -> set[str]:
    """The parameters in the address that a route and what it depends on declare."""
    found = {field.alias for field in dependant.query_params}
    return found.union(*map(_query_names, dependant.dependencies))


def media_type(header: str | None) -> tuple[str, Message]:
    """The media type of a Content-Type header, in lower case, and its parameters.

    Raises:
        Problem: it names another character encoding than UTF-8.
    """
    message = Message()
    message["Content-Type"] = (header or "").strip()
    name = (header or "").partition(";")[0].strip().lower()
    charset = message.get_param("charset")
    if charset is not None and str(charset).lower() not in _UTF_8:
        raise Problem(415, "not-utf-8", f"charset={charset}: only UTF-8 is understood")
    return name, message


async def read_body(request: Request, limit: int) -> bytes:
    """The body of a request.

    Raises:
        Problem: it is larger than the limit, or compressed.
    """
    body = bytearray()
    async for chunk in _chunks(request, limit):
        body += chunk
    return bytes(body)


async def body_to_file(request: Request, file: Path, limit: int) -> None:
    """Write the body of a request to a file.

    Raises:
        Problem: as `read_body`.
        StoreError: the file cannot be written.
    """
    try:
        with file.open("wb") as target:
            async for chunk in _chunks(request, limit):
                await asyncio.to_thread(target.write, chunk)
    except OSError as error:
        raise StoreError(f"the file cannot be kept: {error.strerror or error}") from error


async def _chunks(request: Request, limit: int) -> AsyncIterator[bytes]:
    encoding = request.headers.get("content-encoding", "identity").strip().lower()
    if encoding != "identity":
        detail = f"Content-Encoding {encoding} is not understood; send it as it is"
        raise Problem(415, "content-encoding", detail, headers={"Accept-Encoding": "identity"})
    length = request.headers.get("content-length", "")
    if length.isdigit() and int(length) > limit:
        raise body_too_large(limit)
    size = 0
    async for chunk in request.stream():
        size += len(chunk)
        if size > limit:
            raise body_too_large(limit)
        yield chunk


def body_too_large(limit: int) -> Problem:
    """What a body over a limit gets."""
    detail = f"the body is larger than {limit} bytes"
    return Problem(413, "body-too-large", detail, headers={"Connection": "close"}, limit=limit)


def address(request: Request, settings: Settings, path: str) -> str:
    """The public address of a path of ours."""
    return (settings.public_url or str(request.base_url)).rstrip("/") + path
