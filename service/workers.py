"""The pool of processes that answer queries: killed at the time limit, and replaced.

Whether a query is quick shows when it runs. Some processes are for quick ones alone: a query that
has had a processor for `QUICK_SECONDS` needs one of the places for long ones, or is stopped, and
begins anew when it has got one. So nobody who asks something simple waits for those who do not,
whoever they are (docs/decisions/0014-quick-queries.md).
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import math
import os
import shutil
import sys
from collections import OrderedDict, deque
from collections.abc import AsyncIterator, Awaitable, Callable
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, TypeVar

from symboslam.service.limits import connection, long_turn
from symboslam.service.problems import Problem
from symboslam.service.store._base import BusyError, CrashError, TimeLimitError

T = TypeVar("T")
_MODULE = "symboslam.service.store.reader"
_LONGEST_LINE = 1024 * 1024
QUICK_SECONDS = 0.25
"""Of a processor: a query that is kept from one by others is not slow for that."""
_QUICK_LIMIT = 2.0
"""Seconds after which it is no quick one all the same."""
_PRIORITY_OF_LONG_ONES = 10
_MOST_CONNECTIONS = 10_000


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
        file: where it puts what is not small; a copy of the store to write to goes beside it.

    Attributes:
        snapshot: the folder that it has open, if it has.
        stepped_back: it has a low priority, for good.
    """

    def __init__(self, process: asyncio.subprocess.Process, file: Path) -> None:
        self.process, self._file = process, file
        self._copy = file.with_suffix(".store")
        self.snapshot: str | None = None
        self.stepped_back = False

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
            places = {"file": str(self._file), "copy": str(self._copy)}
            target.write(json.dumps({**request, **places}).encode() + b"\n")
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

    @property
    def used(self) -> float:
        """Seconds of processor time that it has taken; infinitely many where nobody says."""
        try:  # proc(5)
            text = Path(f"/proc/{self.process.pid}/stat").read_text()
        except OSError:
            return math.inf
        user, system = text.rpartition(")")[2].split()[11:13]
        return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")

    def step_back(self) -> None:
        """Let others have the processors first."""
        self.stepped_back = True
        if hasattr(os, "setpriority"):  # not on Windows
            with contextlib.suppress(OSError):
                os.setpriority(os.PRIO_PROCESS, self.process.pid, _PRIORITY_OF_LONG_ONES)

    async def kill(self) -> None:
        """End the process now, and what it has written."""
        with contextlib.suppress(ProcessLookupError):
            self.process.kill()
        await self.process.wait()
        if self.process.stdin is not None:
            self.process.stdin.close()
        self._file.unlink(missing_ok=True)
        await asyncio.to_thread(shutil.rmtree, self._copy, ignore_errors=True)


async def _quickly(work: asyncio.Future[Reply], worker: Worker) -> None:
    """Wait until a request is done, or has had the time that quick ones have."""
    loop = asyncio.get_running_loop()
    before, end = worker.used, loop.time() + _QUICK_LIMIT
    await asyncio.wait({work}, timeout=QUICK_SECONDS)
    while not work.done() and loop.time() < end and worker.used - before < QUICK_SECONDS:
        await asyncio.wait({work}, timeout=QUICK_SECONDS / 5)


class _NotQuickError(Exception):
    """It takes longer, and all places for such are taken."""


class Pool:
    """Workers for one store.

    Args:
        spool: folder for results that are not small; emptied.
        size: how many workers may be busy for long.
        quick: how many more there are; 0: none is for quick requests alone.
        memory: bytes that each may take; 0: no limit.
        queue_length: requests that may wait.
        queue_seconds: how long they may.

    Attributes:
        waiting: requests that wait.
        timeouts: requests that were stopped at their time limit.
        killed: workers that were killed, or ended by themselves.
    """

    def __init__(
        self, spool: Path, *, size: int, quick: int, memory: int, queue_length: int,
        queue_seconds: float,
    ) -> None:  # fmt: skip
        self._spool, self._memory = spool, memory
        self._quick, self._processes = quick, size + quick
        self._places = asyncio.Semaphore(size)
        self._queue_length, self._queue_seconds = queue_length, queue_seconds
        self._idle: list[Worker] = []
        self._queue: deque[tuple[asyncio.Future[Worker], bool]] = deque()
        self._quick_before: OrderedDict[str | None, None] = OrderedDict()
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
        return self._processes - len(self._idle)

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
        if self._spool.exists():
            shutil.rmtree(self._spool)
        self._spool.mkdir(parents=True)
        await asyncio.gather(*(self._add() for _ in range(self._processes)))

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
        if not self._quick:
            async with long_turn():
                return await self._ask(request, seconds, snapshot, long=True)
        try:
            return await self._ask(request, seconds, snapshot, long=False)
        except _NotQuickError:
            async with self._place():
                return await self._ask(request, seconds, snapshot, long=True)

    def _note(self, *, quick: bool) -> None:
        """Remember whether the last request of a connection was quick."""
        self._quick_before.pop(connection(), None)
        if quick:
            self._quick_before[connection()] = None
            if len(self._quick_before) > _MOST_CONNECTIONS:
                self._quick_before.popitem(last=False)

    async def _ask(
        self, request: dict[str, Any], seconds: float,
        snapshot: Callable[[], Awaitable[str]] | None, *, long: bool,
    ) -> Reply:  # fmt: skip
        worker = await self._get()
        if snapshot is not None:
            try:
                request = {**request, "snapshot": await snapshot()}
            except BaseException:
                self._release(worker)
                raise
            worker.snapshot = request["snapshot"]  # nothing can happen in between
        try:
            async with asyncio.timeout(seconds), contextlib.AsyncExitStack() as held:
                work = asyncio.ensure_future(worker.ask({**request, "seconds": seconds}))
                held.callback(work.cancel)
                if not long:
                    await _quickly(work, worker)
                    self._note(quick=work.done())
                if not work.done() and self._quick:
                    if not long:
                        await held.enter_async_context(self._place(wait=False))
                    worker.step_back()
                reply = await work
        except TimeoutError as error:
            self.timeouts += 1
            self._replace(worker)
            raise TimeLimitError(f"stopped after {seconds:g} s") from error
        except BaseException:  # it crashed, or whoever asked is gone: it may be in anything
            self._replace(worker)
            raise
        if worker.stepped_back:
            self._replace(worker, killed=False)
        else:
            self._release(worker)
        return reply

    @contextlib.asynccontextmanager
    async def _place(self, *, wait: bool = True) -> AsyncIterator[None]:
        """A place among the requests that take long.

        Raises:
            _NotQuickError: without ``wait``: there is none.
            BusyError, Problem: there was none in time.
        """
        async with contextlib.AsyncExitStack() as held:
            try:
                await held.enter_async_context(long_turn(wait=wait))
                await self._wait(self._places.acquire(), self._places.locked(), wait)
            except (BusyError, Problem) as error:
                if wait:
                    raise
                raise _NotQuickError from error
            held.callback(self._places.release)
            yield

    async def _wait(self, what: Awaitable[T], busy: bool, wait: bool = True) -> T:
        """Wait for something, as long and with as many others as is allowed."""
        if busy and (not wait or self.waiting >= self._queue_length):
            if asyncio.iscoroutine(what):
                what.close()
            raise BusyError(f"{self.waiting} queries are waiting already")
        self.waiting += 1
        try:
            async with asyncio.timeout(self._queue_seconds):
                return await what
        except TimeoutError as error:
            raise BusyError(f"no worker came free in {self._queue_seconds:g} s") from error
        finally:
            self.waiting -= 1

    async def _get(self) -> Worker:
        if self._idle:
            return self._idle.pop()
        turn: asyncio.Future[Worker] = asyncio.get_running_loop().create_future()
        waiting = turn, connection() in self._quick_before
        self._queue.append(waiting)
        try:
            return await self._wait(turn, busy=True)
        except BaseException:
            if turn.done() and not turn.cancelled():
                self._release(turn.result())
            raise
        finally:
            with contextlib.suppress(ValueError):
                self._queue.remove(waiting)

    def _release(self, worker: Worker) -> None:
        """Give a worker to one who waits: to the first whose last request was quick, if any."""
        while self._queue:
            chosen = next((each for each in self._queue if each[1]), self._queue[0])
            self._queue.remove(chosen)
            if not (turn := chosen[0]).done():
                turn.set_result(worker)
                return
        self._idle.append(worker)

    async def _add(self) -> None:
        self._started += 1
        file = self._spool / f"{self._started}.result"
        worker = await Worker.start(file, self._memory)
        self._all.add(worker)
        self._release(worker)

    def _replace(self, worker: Worker, *, killed: bool = True) -> None:
        async def replace() -> None:
            await worker.kill()
            self._all.discard(worker)
            if not self._stopping:
                await self._add()

        self.killed += killed
        task = asyncio.create_task(replace())
        self._replacing.add(task)
        task.add_done_callback(self._replacing.discard)
