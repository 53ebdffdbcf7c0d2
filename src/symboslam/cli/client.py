"""Requests to a service, by the standard library: a client needs no extra."""

from __future__ import annotations

import json
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from email.message import Message
from email.utils import parsedate_to_datetime
from typing import IO, Annotated

import typer

from symboslam.errors import InputError, ServiceError

URL = "http://127.0.0.1:8080"
_LATER = (429, 503)
_TRIES = 20
_PIECE = 256 * 1024
_LONGEST_WAIT = 120  # seconds

TokenOption = Annotated[
    str | None,
    typer.Option(
        metavar="TOKEN", envvar="SYMBOSLAM_TOKEN", show_default=False,
        help="Token for a service that wants one; better set SYMBOSLAM_TOKEN.",
    ),
]  # fmt: skip
TimeoutOption = Annotated[
    float, typer.Option(metavar="SECONDS", min=0.1, help="How long to wait for an answer.")
]


@dataclass(frozen=True)
class Reply:
    """What a service answered.

    Attributes:
        status: HTTP status.
        headers: its headers.
        body: its content.
    """

    status: int
    headers: Message
    body: bytes


class Client:
    """A service that is asked.

    Args:
        url: its address, as ``symboslam serve`` prints it.
        token: sent as ``Authorization: Bearer``; None sends nothing.
        timeout: seconds that an answer may take.
        wait: waits some seconds.

    Raises:
        InputError: the address is none of http or https.
    """

    def __init__(
        self,
        url: str,
        token: str | None,
        timeout: float,
        wait: Callable[[float], None] = time.sleep,
    ) -> None:
        from urllib.parse import urlsplit

        parts = urlsplit(url)
        if parts.scheme not in ("http", "https") or not parts.hostname:
            raise InputError(f"{url!r} is no address of a service, such as {URL}")
        if not (token or "").isascii() or any(c.isspace() for c in token or ""):
            raise InputError("the token has characters that no token has")
        self.url = url.rstrip("/").removesuffix("/sparql")
        self._token, self._timeout, self._wait = token, timeout, wait

    def post(
        self, path: str, body: bytes, headers: Mapping[str, str], *, patient: bool = False
    ) -> Reply:
        """Send something.

        Args:
            path: below the service's address.
            body: what to send.
            headers: its headers; Accept and Content-Type belong there.
            patient: where the service says "later", do it again later.

        Raises:
            InputError: the service refuses it (4xx); has what the service says.
            ServiceError: the service cannot be reached, or has failed (5xx).
        """
        for _ in range(_TRIES):
            reply = self._send(path, body, headers)
            if not (patient and reply.status in _LATER):
                break
            self._wait(_seconds(reply.headers.get("Retry-After")))
        if reply.status >= 500:
            raise ServiceError(f"{self.url}: {_detail(reply)}")
        if reply.status >= 400:
            raise InputError(_detail(reply))
        if reply.status >= 300:
            raise InputError(f"{self.url} leads to {reply.headers.get('Location')}: give that one")
        return reply

    def save(self, path: str, target: IO[bytes], tell: Callable[[int], None]) -> None:
        """Ask for something that can be large, and write it to a file; errors as in `post`.

        Args:
            path: below the service's address.
            target: what is written to.
            tell: is told how many bytes have come.
        """
        reply = self._send(path, b"", {}, target, tell)
        if reply.status >= 500:
            raise ServiceError(f"{self.url}: {_detail(reply)}")
        if reply.status >= 300:
            raise InputError(_detail(reply))

    def _send(
        self, path: str, body: bytes, headers: Mapping[str, str],
        target: IO[bytes] | None = None, tell: Callable[[int], None] | None = None,
    ) -> Reply:  # fmt: skip
        import http.client
        from urllib.error import HTTPError
        from urllib.request import HTTPRedirectHandler, Request, build_opener

        class Stay(HTTPRedirectHandler):
            """Nobody else gets the token."""

            def redirect_request(self, *_: object) -> None:
                return None

        request = Request(self.url + path, body, dict(headers), method="POST")
        if self._token:
            request.add_header("Authorization", f"Bearer {self._token}")
        try:
            with build_opener(Stay).open(request, timeout=self._timeout) as response:
                size = 0
                while target is not None and (piece := response.read(_PIECE)):
                    size += target.write(piece)
                    if tell is not None:
                        tell(size)
                return Reply(response.status, response.headers, response.read())
        except HTTPError as error:
            with error:
                return Reply(error.code, error.headers, error.read())
        except TimeoutError as error:
            raise self._silent() from error
        except (OSError, http.client.HTTPException) as error:
            reason = getattr(error, "reason", error)
            if isinstance(reason, TimeoutError):
                raise self._silent() from error
            raise ServiceError(f"{self.url} cannot be reached: {reason}") from error

    def _silent(self) -> ServiceError:
        return ServiceError(f"{self.url} has not answered within {self._timeout:g} seconds")


def _detail(reply: Reply) -> str:
    """What a problem says, in a line."""
    try:
        found = json.loads(reply.body)
        detail = str(found["detail"])
    except (ValueError, KeyError, TypeError):
        return f"the service answers with HTTP status {reply.status}"
    return "".join(c if c.isprintable() else " " for c in detail)


def _seconds(later: str | None) -> float:
    """The seconds of a Retry-After header, which may be a date."""
    from datetime import UTC, datetime

    try:
        seconds = float(later or 1)
    except ValueError:
        try:
            seconds = (parsedate_to_datetime(later or "") - datetime.now(UTC)).total_seconds()
        except (ValueError, TypeError):
            seconds = 1.0
    return min(max(seconds, 0.0), _LONGEST_WAIT)
