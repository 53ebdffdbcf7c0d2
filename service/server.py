"""uvicorn as the service needs it: stops in good order, and waits for nobody's headers."""

from __future__ import annotations

import asyncio
import logging
import socket
from collections.abc import Callable

import h11
import uvicorn
from fastapi import FastAPI
from uvicorn.protocols.http.h11_impl import H11Protocol

from symboslam.service.lifecycle import Lifecycle
from symboslam.service.settings import Settings

_HEADER_SECONDS = 20.0
_TICK = 0.05


class Protocol(H11Protocol):
    """A connection that is closed when the head of a request does not arrive in time."""

    _head: asyncio.TimerHandle | None = None

    def connection_made(self, transport: asyncio.Transport) -> None:  # type: ignore[override]
        """Start to wait for the first request."""
        super().connection_made(transport)
        self._wait()

    def connection_lost(self, exc: Exception | None) -> None:
        """Wait no longer."""
        self._wait_no_longer()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Take what came; wait on only where it is not a whole head yet."""
        super().data_received(data)
        if self.conn.their_state is not h11.IDLE:
            self._wait_no_longer()
        elif self._head is None:
            self._wait()

    def _wait(self) -> None:
        self._head = self.loop.call_later(_HEADER_SECONDS, self._give_up)

    def _wait_no_longer(self) -> None:
        if self._head is not None:
            self._head.cancel()
            self._head = None

    def _give_up(self) -> None:
        if self.conn.their_state is h11.IDLE:
            self.transport.close()


class Server(uvicorn.Server):
    """A server of one app.

    Args:
        app: from `create_app`.
        settings: how long the end may take.
        started: called when requests are taken.
    """

    def __init__(
        self, app: FastAPI, settings: Settings, started: Callable[[], None] | None = None
    ) -> None:
        super().__init__(
            uvicorn.Config(
                app, http=Protocol, ws="none", lifespan="on", log_config=None, access_log=False,
                server_header=False, timeout_graceful_shutdown=settings.stop_seconds,
            )
        )  # fmt: skip
        self._settings, self._tell = settings, started
        self._lifecycle: Lifecycle = app.state.lifecycle

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        """Start, and say so; what keeps it from starting is ``app.state.failure``."""
        log = logging.getLogger("uvicorn.error")
        log.disabled = True
        try:
            await super().startup(sockets)
        finally:
            log.disabled = False
        if self.started and self._tell is not None:
            self._tell()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        """Stop: not ready first, then no new connections; then wait for what runs."""
        self._lifecycle.draining = True
        loop = asyncio.get_running_loop()
        until = loop.time() + self._settings.drain_seconds
        while loop.time() < until and not self.force_exit:
            await asyncio.sleep(_TICK)
        for server in self.servers:
            server.close()
        self._lifecycle.end()
        await super().shutdown(sockets)
