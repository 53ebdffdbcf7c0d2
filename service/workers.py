"""The pool of processes that answer queries: killed at the time limit, and replaced."""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import sys
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from symboslam.service.store._base import BusyError, CrashError, TimeLimitError

_MODULE = "symboslam.service.store.reader"
_LONGEST_LINE = 1024 * 1024


@dataclass
class Reply:
    """What a worker said.

    Attributes:
        head: the JSON object.
        body: the bytes after it, or the opened file, which has no name any more.
    """

    head: dict[str, Any]
    body: bytes | IO[bytes]


class Worker:
    """One process.

    Args:
        process: it.
        file: where it puts what is not small.

    Attributes:
        snapshot: the folder that it has open, if it has.
    """

    def __init__(self, process: asyncio.subprocess.Process, file: Path) -> None:
        self.process, self._file = process, file
        self.snapshot: str | None = None

    @classmethod
    async def start(cls, file: Path, memory: int) -> Worker:
        """Start a process."""
        # Not our secrets; and not the folder that we happen to be in (-P).
        environment = {k: v for k, v in os.environ.items() if not k.startswith("SYMBOSLAM_")}
        process = await asyncio.create_subprocess_exec(
            sys.executable, "-P", "-m", _MODULE, str(memory),
            stdin=asyncio.subprocess.PIPE, stdout=asyncio.subprocess.PIPE,
            stderr=asyncio.subprocess.DEVNULL, env=environment, limit=_LONGEST_LINE,
        )  # fmt: skip
        return cls(process, file)

    async def ask(self, request: dict[str, Any]) -> Reply:
        """Send a request and wait for the reply.

        Raises:
            CrashError: the process ended instead.
        """
        source, target = self.process.stdout, self.process.stdin
        assert source is not None
        assert target is not None
        try:
            target.write(json.dumps({**request, "file": str(self._file)}).encode() + b"\n")
            await target.drain()
            line = await source.readline()
            if not line:
                raise CrashError("the process ended")
            head = json.loads(line)
            if head.get("in_file"):
                opened = self._file.open("rb")  # closed by whoever sends it on
                self._file.unlink()
                return Reply(head, opened)
            return Reply(head, await source.readexactly(head.get("size", 0)))
        except (ConnectionError, asyncio.IncompleteReadError) as error:
            raise CrashError("the process ended") from error

    async def kill(self) -> None:
        """End the process now, and what it has written."""
        with contextlib.suppress(ProcessLookupError):
            self.process.kill()
        await self.process.wait()
        if self.process.stdin is not None:
            self.process.stdin.close()
        self._file.unlink(missing_ok=True)


class Pool:
    """Workers for one store.

    Args:
        spool: folder for results that are not small; emptied.
        size: how many workers.
        memory: bytes that each may take; 0: no limit.
        queue_length: requests that may wait.
        queue_seconds: how long they may.

    Attributes:
        waiting: requests that wait.
        timeouts: requests that were stopped at their time limit.
        killed: workers that were killed, or ended by themselves.
    """

    def __init__(
        self, spool: Path, *, size: int, memory: int, queue_length: int,
        queue_seconds: float,
    ) -> None:  # fmt: skip
        self._spool, self._size, self._memory = spool, size, memory
        self._queue_length, self._queue_seconds = queue_length, queue_seconds
        self._idle: asyncio.Queue[Worker] = asyncio.Queue()
        self._all: set[Worker] = set()
        self._replacing: set[asyncio.Task[None]] = set()
        self.waiting = self.timeouts = self.killed = 0
        self._started = 0
        self._stopping = False

    @property
    def alive(self) -> int:
        """Workers that run."""
        return sum(worker.process.returncode is None for worker in self._all)

    @property
    def busy(self) -> int:
        """Workers that are not free: they answer, or start."""
        return self._size - self._idle.qsize()

    @property
    def snapshots(self) -> set[str]:
        """The folders that workers have open."""
        return {worker.snapshot for worker in self._all if worker.snapshot}

    @property
    def processes(self) -> list[int]:
        """Their process ids."""
        return sorted(worker.process.pid for worker in self._all)

    async def start(self) -> None:
        """Start all workers."""
        self._spool.mkdir(parents=True, exist_ok=True)
        for left in self._spool.iterdir():
            left.unlink()
        await asyncio.gather(*(self._add() for _ in range(self._size)))

    async def stop(self) -> None:
        """Kill all workers, whatever they do."""
        self._stopping = True
        await asyncio.gather(*self._replacing, return_exceptions=True)
        await asyncio.gather(*(worker.kill() for worker in self._all))
        self._all.clear()

    async def ask(
        self,
        request: dict[str, Any],
        seconds: float,
        snapshot: Callable[[], Awaitable[str]] | None = None,
    ) -> Reply:
        """Let a worker answer.

        Args:
            request: what `reader` takes.
            seconds: the time limit, from when a worker is there.
            snapshot: makes the snapshot to read, once a worker is there to hold it.

        Raises:
            BusyError: no worker came free in time, or too many wait already.
            TimeLimitError: the time was up; the worker was killed.
            CrashError: the worker ended by itself.
        """
        worker = await self._get()
        if snapshot is not None:
            try:
                request = {**request, "snapshot": await snapshot()}
            except BaseException:
                self._idle.put_nowait(worker)
                raise
            worker.snapshot = request["snapshot"]  # nothing can happen in between
        try:
            async with asyncio.timeout(seconds):
                reply = await worker.ask({**request, "seconds": seconds})
        except TimeoutError as error:
            self.timeouts += 1
            self._replace(worker)
            raise TimeLimitError(f"stopped after {seconds:g} s") from error
        except BaseException:  # it crashed, or whoever asked is gone: it may be in anything
            self._replace(worker)
            raise
        self._idle.put_nowait(worker)
        return reply

    async def _get(self) -> Worker:
        with contextlib.suppress(asyncio.QueueEmpty):
            return self._idle.get_nowait()
        if self.waiting >= self._queue_length:
            raise BusyError(f"{self.waiting} queries are waiting already")
        self.waiting += 1
        try:
            async with asyncio.timeout(self._queue_seconds):
                return await self._idle.get()
        except TimeoutError as error:
            raise BusyError(f"no worker came free in {self._queue_seconds:g} s") from error
        finally:
            self.waiting -= 1

    async def _add(self) -> None:
        self._started += 1
        file = self._spool / f"{self._started}.result"
        worker = await Worker.start(file, self._memory)
        self._all.add(worker)
        self._idle.put_nowait(worker)

    def _replace(self, worker: Worker) -> None:
        async def replace() -> None:
            await worker.kill()
            self._all.discard(worker)
            if not self._stopping:
                await self._add()

        self.killed += 1
        task = asyncio.create_task(replace())
        self._replacing.add(task)
        task.add_done_callback(self._replacing.discard)
