"""What happens to every request: its id, its line in the log, its limits, and the last resort.

Plain ASGI, so that nothing is held back: event streams pass through as they come.
"""

from __future__ import annotations

import asyncio
import logging
import re
import time
from typing import Any
from uuid import uuid4

from starlette.datastructures import Headers, MutableHeaders, State
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from symboslam.errors import StoreError
from symboslam.service.auth import Authenticator, Identity
from symboslam.service.lifecycle import Lifecycle
from symboslam.service.limits import Limits, client_of
from symboslam.service.logs import REQUEST_ID
from symboslam.service.metrics import Metrics
from symboslam.service.problems import Problem, store_unavailable
from symboslam.service.requests import body_too_large
from symboslam.service.settings import Settings

_log = logging.getLogger(__name__)
_ID = re.compile(r"[A-Za-z0-9][A-Za-z0-9._:+/=@-]{0,127}")
_LONGEST_PATH = 500
_EVENTS = "text/event-stream"
_POLICY = (
    "default-src 'self'; base-uri 'none'; form-action 'self'; frame-ancestors 'none';"
    " object-src 'none'"
)
_GONE = 499  # nobody was there to see a status


class Accounts:
    """The outermost one: gives a request its id, logs and counts it, adds headers.

    Args:
        app: what is inside.
        metrics: where it is counted.
    """

    def __init__(self, app: ASGIApp, metrics: Metrics) -> None:
        self._app, self._metrics = app, metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        sent = Headers(scope=scope).get("x-request-id", "")
        identifier = sent if _ID.fullmatch(sent) else uuid4().hex
        REQUEST_ID.set(identifier)
        status, size, start = _GONE, 0, time.perf_counter()

        async def count(message: Message) -> None:
            nonlocal status, size
            if message["type"] == "http.response.start":
                status = message["status"]
                headers = MutableHeaders(scope=message)
                headers["X-Request-ID"] = identifier
                for name, value in _state(scope).get("rate_headers", {}).items():
                    headers[name] = value
                _secure(headers)
            elif message["type"] == "http.response.body":
                size += len(message.get("body", b""))
            await send(message)

        self._metrics.running.inc()
        try:
            await self._app(scope, receive, count)
        finally:
            self._metrics.running.dec()
            seconds = time.perf_counter() - start
            route = getattr(scope.get("route"), "path", "none")
            self._metrics.observe(route, scope["method"], status, seconds)
            _note(scope, route, status, seconds, size)


class Guard:
    """The innermost one: who asks, limits on bodies and on what runs at a time, defects.

    Args:
        app: what is inside.
        settings: the limits.
        limits: of requests at a time.
        lifecycle: tells when event streams end.
        state: of the app; has ``authenticator`` once it has started.
    """

    def __init__(
        self, app: ASGIApp, settings: Settings, limits: Limits, lifecycle: Lifecycle, state: State
    ) -> None:
        self._app, self._settings, self._state = app, settings, state
        self._limits, self._lifecycle = limits, lifecycle

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        started = streaming = False
        task = asyncio.current_task()
        assert task is not None

        async def watch(message: Message) -> None:
            nonlocal started, streaming
            if message["type"] == "http.response.start":
                started = True
                kind = Headers(raw=message["headers"]).get("content-type", "")
                streaming = kind.startswith(_EVENTS)
                if streaming:
                    self._lifecycle.streams.add(task)
            await send(message)

        try:
            await self._answer(scope, receive, watch)
        except Problem as problem:
            await problem.response()(scope, receive, send)
        except asyncio.CancelledError:
            if not self._lifecycle.ending or (started and not streaming):
                raise
            task.uncancel()
            if streaming:
                await send({"type": "http.response.body", "body": b"", "more_body": False})
            else:
                await _stopped().response()(scope, receive, send)
        except StoreError as error:  # of the tokens; what handlers raise is a response by now
            await store_unavailable(error).response()(scope, receive, send)
        except Exception:
            if started:
                raise  # uvicorn cuts the response off, and logs this
            _log.exception("a defect")
            await _defect().response()(scope, receive, send)
        finally:
            self._lifecycle.streams.discard(task)

    async def _answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        authenticator: Authenticator = self._state.authenticator
        identity = authenticator.identify(Headers(scope=scope).get("authorization", ""))
        _state(scope)["identity"] = identity
        limit = self._settings.max_body_bytes
        if identity is None or not identity.scopes - {"query"}:
            limit = min(limit, 4 * self._settings.max_query_bytes)  # percent-encoded, and more
        client = client_of(scope, identity.id if identity else None)
        with self._limits.running(client):
            bounded = _bounded(receive, limit, self._settings.body_seconds)
            await self._app(scope, bounded, send)


def _bounded(receive: Receive, limit: int, seconds: float) -> Receive:
    """Receive a body of up to so many bytes, in up to so many seconds.

    The one that comes out of it raises a `Problem`: 413 or 408.
    """
    deadline = asyncio.get_running_loop().time() + seconds
    complete, size = False, 0

    async def bounded() -> Message:
        nonlocal complete, size
        if complete:
            return await receive()
        try:
            async with asyncio.timeout_at(deadline):
                message = await receive()
        except TimeoutError as error:
            detail = f"the body did not arrive in {seconds:g} s"
            headers = {"Connection": "close"}
            raise Problem(408, "body-too-slow", detail, headers=headers) from error
        complete = not message.get("more_body", False)
        size += len(message.get("body", b""))
        if size > limit:
            raise body_too_large(limit)
        return message

    return bounded


def _state(scope: Scope) -> dict[str, Any]:
    found: dict[str, Any] = scope.setdefault("state", {})
    return found


def _stopped() -> Problem:
    detail = "the service stops, and did not get this done"
    headers = {"Retry-After": "10", "Connection": "close"}
    return Problem(503, "stopping", detail, headers=headers)


def _defect() -> Problem:
    detail = "the service has a defect; its log says more, under the id of this request"
    return Problem(500, "internal-error", detail)


def _secure(headers: MutableHeaders) -> None:
    headers.setdefault("X-Content-Type-Options", "nosniff")
    headers.setdefault("Referrer-Policy", "no-referrer")
    if headers.get("content-type", "").startswith("text/html"):
        headers.setdefault("Content-Security-Policy", _POLICY)


def _note(scope: Scope, route: str, status: int, seconds: float, size: int) -> None:
    """Log a request that was answered."""
    if not _log.isEnabledFor(logging.INFO):
        return
    identity: Identity | None = _state(scope).get("identity")
    raw: bytes = scope.get("raw_path") or scope["path"].encode()
    client = scope.get("client")
    fields = {
        "method": scope["method"],
        # As it was sent: percent-encoded, so that nobody can write lines into a log.
        "path": raw.partition(b"?")[0].decode("ascii", "backslashreplace")[:_LONGEST_PATH],
        "route": route,
        "status": status,
        "seconds": round(seconds, 4),
        "bytes": size,
        "client": client[0] if client else None,
        "token": identity.id if identity else None,
    }
    _log.info("request", extra={"fields": fields})
