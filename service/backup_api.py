"""Backups over HTTP at ``/v1/backup``, for administrators: of a service that goes on."""

from __future__ import annotations

import asyncio
import os
import shutil
import threading
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from fastapi import APIRouter, Request
from fastapi.responses import StreamingResponse

from symboslam.service.auth import AdminOnly
from symboslam.service.backup import archive, collect
from symboslam.service.dependencies import CurrentSettings, CurrentStore
from symboslam.service.maps.routes import CurrentMaps
from symboslam.service.problems import Problem

if TYPE_CHECKING:
    from starlette.types import Receive, Scope, Send

router = APIRouter(prefix="/v1/backup", tags=["Backup"])
_PIECE = 256 * 1024


@router.post("", summary="Back up", response_class=StreamingResponse, responses={
    200: {"content": {"application/gzip": {}}},
})  # fmt: skip
async def make_backup(
    request: Request, settings: CurrentSettings, store: CurrentStore, maps: CurrentMaps,
    _: AdminOnly,
) -> StreamingResponse:  # fmt: skip
    """All that is kept, as one file for `symboslam store restore`. Hashes of tokens are in it.

    The service goes on meanwhile. A file that is cut short is noticed by its checksums.
    """
    making: asyncio.Lock = request.app.state.backing_up
    if making.locked():
        detail = "another backup is being made"
        raise Problem(503, "too-busy", detail, headers={"Retry-After": "30"})
    await making.acquire()
    try:
        folder = await collect(settings.data, store, maps.coming_and_going)
    except BaseException:
        making.release()
        raise
    return Backup(folder, making)


class Backup(StreamingResponse):
    """A folder of `collect` as a file; when it is sent, or the client is gone, it is removed.

    Args:
        folder: it.
        making: a lock to be released then.
    """

    def __init__(self, folder: Path, making: asyncio.Lock) -> None:
        name = f"symboslam-{datetime.now(UTC):%Y%m%d-%H%M%S}.tar.gz"
        headers = {
            "Content-Disposition": f'attachment; filename="{name}"', "Cache-Control": "no-store",
        }  # fmt: skip
        super().__init__(_pieces(folder), headers=headers, media_type="application/gzip")
        self._folder, self._making = folder, making

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Send it."""
        try:
            await super().__call__(scope, receive, send)
        finally:
            self._making.release()
            await asyncio.to_thread(shutil.rmtree, self._folder, True)


def _pieces(folder: Path) -> Iterator[bytes]:
    """A folder as a file, while it is packed."""
    read, write = os.pipe()
    failed: list[OSError] = []

    def pack() -> None:
        try:
            with open(write, "wb") as target:
                archive(folder, target, lambda stage, share: None)
        except OSError as error:  # or nobody reads any more
            failed.append(error)

    packing = threading.Thread(target=pack, name="backup")
    packing.start()
    with open(read, "rb", buffering=0) as source:
        while piece := source.read(_PIECE):
            yield piece
    packing.join()
    if failed:
        raise failed[0]  # the connection is closed before its end
