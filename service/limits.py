"""How often and how much at a time one client may ask; all of it in memory, and bounded.

Our own, since the library ``limits`` has no token bucket and keeps every client that it ever saw
until its window ends.
"""

from __future__ import annotations

import asyncio
import math
import re
import time
from collections import Counter, OrderedDict
from collections.abc import AsyncIterator, Callable, Iterator, Mapping
from contextlib import asynccontextmanager, contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from ipaddress import IPv4Address, IPv6Address, ip_address
from typing import Any

from fastapi import Request

from symboslam.service.problems import Problem

_SECONDS = {"second": 1, "minute": 60, "hour": 3600}
_RATE = re.compile(r"(?:(query|ingest|update|admin)=)?([1-9]\d{0,8})/(second|minute|hour)")
_MOST_BUCKETS = 10_000
_RETRY = {"Retry-After": "2"}


@dataclass(frozen=True)
class Rate:
    """So many requests in so many seconds."""

    requests: int
    seconds: int


# For 20 robots that share a token or an address and send ten batches a second each.
DEFAULT_RATES = {
    "query": Rate(6000, 60),
    "ingest": Rate(12000, 60),
    "update": Rate(6000, 60),
    "admin": Rate(600, 60),
}


def parse_rates(text: str) -> dict[str, Rate]:
    """The rate of each scope, from ``600/minute`` for all or ``query=600/minute,...`` for some.

    Args:
        text: the setting; ``none``: there are no limits; empty: the defaults.

    Raises:
        ValueError: it is none of these.
    """
    if text.strip().lower() == "none":
        return {}
    found = dict(DEFAULT_RATES)
    for part in filter(None, (part.strip() for part in text.split(","))):
        match = _RATE.fullmatch(part)
        if match is None:
            problem = f"{part!r} is not a rate such as 600/minute or query=600/minute, or none"
            raise ValueError(problem)
        rate = Rate(int(match[2]), _SECONDS[match[3]])
        found.update(dict.fromkeys([match[1]] if match[1] else DEFAULT_RATES, rate))
    return found


class Buckets:
    """Token buckets: each holds as many requests as its rate says, and fills up steadily.

    Args:
        size: how many are kept; beyond that the one that was not used for the longest time is
            forgotten, and so is full again.
        clock: seconds that only grow.
    """

    def __init__(
        self, size: int = _MOST_BUCKETS, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._size, self._clock = size, clock
        self._buckets: OrderedDict[tuple[str, str], tuple[float, float]] = OrderedDict()

    def __len__(self) -> int:
        return len(self._buckets)

    def take(self, key: tuple[str, str], rate: Rate) -> float:
        """Take one request out of a bucket.

        Returns:
            How many are left; below zero: none was there, and so much is missing to one.
        """
        now = self._clock()
        level, then = self._buckets.pop(key, (float(rate.requests), now))
        level = min(rate.requests, level + (now - then) * rate.requests / rate.seconds)
        left = level - 1
        self._buckets[key] = (level if left < 0 else left, now)
        if len(self._buckets) > self._size:
            self._buckets.popitem(last=False)
        return left


@dataclass
class _Queue:
    turns: asyncio.Semaphore
    users: int = field(default=0)


class Limits:
    """The limits of one service.

    Args:
        rates: requests by scope, from `parse_rates`.
        at_a_time: requests of one client at a time.
        queries: queries and updates of one client at a time; None: as many as there are workers.
        seconds: how long further ones wait.
    """

    def __init__(
        self, rates: Mapping[str, Rate], at_a_time: int, queries: int | None, seconds: float
    ) -> None:
        self._rates, self._at_a_time = rates, at_a_time
        self._queries, self._seconds = queries, seconds
        self._buckets = Buckets()
        self._running: Counter[str] = Counter()
        self._queues: dict[str, _Queue] = {}

    def count(self, request: Request, client: str | None, scope: str) -> None:
        """Count a request; the response will say how many are left.

        Raises:
            Problem: 429 where none is.
        """
        rate = self._rates.get(scope)
        if client is None or rate is None:
            return
        left = self._buckets.take((client, scope), rate)
        full = math.ceil((rate.requests - max(left, 0)) * rate.seconds / rate.requests)
        # draft-ietf-httpapi-ratelimit-headers
        headers = {
            "RateLimit-Policy": f'"{scope}";q={rate.requests};w={rate.seconds}',
            "RateLimit": f'"{scope}";r={max(0, math.floor(left))};t={full}',
        }
        request.state.rate_headers = headers
        if left < 0:
            wait = math.ceil(-left * rate.seconds / rate.requests)
            detail = f"more than {rate.requests} requests of this kind in {rate.seconds} s"
            raise Problem(429, "too-many-requests", detail, headers={"Retry-After": str(wait)})

    @contextmanager
    def running(self, client: str | None) -> Iterator[None]:
        """One request more of a client, as long as it runs.

        Raises:
            Problem: 429 where it has too many already.
        """
        if client is None:
            yield
            return
        if self._running[client] >= self._at_a_time:
            detail = f"more than {self._at_a_time} requests at a time"
            raise Problem(429, "too-many-at-a-time", detail, headers=_RETRY)
        self._running[client] += 1
        try:
            yield
        finally:
            self._running[client] -= 1
            if not self._running[client]:
                del self._running[client]

    @asynccontextmanager
    async def turn(self, client: str | None, *, wait: bool = True) -> AsyncIterator[None]:
        """One query or update more of a client; it waits until it is its turn.

        Raises:
            Problem: 429 where that takes too long, or any time without ``wait``.
        """
        if client is None or self._queries is None:
            yield
            return
        queue = self._queues.setdefault(client, _Queue(asyncio.Semaphore(self._queries)))
        queue.users += 1
        try:
            try:
                async with asyncio.timeout(self._seconds if wait else 0):
                    await queue.turns.acquire()
            except TimeoutError as error:
                detail = f"more than {self._queries} queries at a time for {self._seconds:g} s"
                raise Problem(429, "too-many-at-a-time", detail, headers=_RETRY) from error
            try:
                yield
            finally:
                queue.turns.release()
        finally:
            queue.users -= 1
            if not queue.users:
                del self._queues[client]


@dataclass(frozen=True)
class _Asker:
    limits: Limits
    client: str | None
    connection: str


_ASKER: ContextVar[_Asker | None] = ContextVar("asker", default=None)


@contextmanager
def turn(request: Request) -> Iterator[None]:
    """Let stores know for whom they work, so that they can ask for `long_turn`."""
    identity = request.state.identity
    client = client_of(request.scope, identity.id if identity else None)
    connection = client if identity and identity.id else str(request.scope.get("client"))
    before = _ASKER.set(_Asker(request.app.state.limits, client, str(connection)))
    try:
        yield
    finally:
        _ASKER.reset(before)


def connection() -> str | None:
    """The token, or else the connection, of whom a store works for."""
    asker = _ASKER.get()
    return None if asker is None else asker.connection


@asynccontextmanager
async def long_turn(*, wait: bool = True) -> AsyncIterator[None]:
    """What a store holds while it works for long; its errors are those of `Limits.turn`."""
    asker = _ASKER.get()
    if asker is None:
        yield
        return
    async with asker.limits.turn(asker.client, wait=wait):
        yield


def client_of(scope: Mapping[str, Any], token: str | None) -> str | None:
    """Whom limits are counted for; None: nobody, the request comes from this machine.

    Args:
        scope: of the request (ASGI).
        token: the id of its token.
    """
    if token is not None:
        return f"token {token}"
    host = (scope.get("client") or ("",))[0]
    address = address_of(scope)
    if address is None:
        return host or None
    if address.is_loopback:
        return None
    if isinstance(address, IPv6Address):  # who has one has the rest of its /64
        return f"{IPv6Address(int(address) >> 64 << 64)}/64"
    return str(address)


def address_of(scope: Mapping[str, Any]) -> IPv4Address | IPv6Address | None:
    """The address of the client; None: it has none, as one at a Unix socket."""
    try:
        address = ip_address((scope.get("client") or ("",))[0])
    except ValueError:
        return None
    return getattr(address, "ipv4_mapped", None) or address
