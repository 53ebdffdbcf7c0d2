"""Events: what changed in a map, for those who watch it."""

from __future__ import annotations

import asyncio
from collections import deque
from collections.abc import AsyncIterator
from dataclasses import dataclass
from typing import Any

KEPT = 512
"""Events that one who comes back can still get."""
_BEHIND = 512
"""Events that a watcher may be behind before it is told to start anew."""


@dataclass(frozen=True)
class Event:
    """A change.

    Attributes:
        revision: of the map after it.
        kind: ``change``; or ``reset``: events are missing, read the map anew.
        data: plain values.
    """

    revision: int
    kind: str
    data: dict[str, Any]


class Events:
    """The events of one map.

    Args:
        revision: that of the map now.
    """

    def __init__(self, revision: int) -> None:
        self._revision = revision
        self._kept: deque[Event] = deque(maxlen=KEPT)
        self._watchers: set[asyncio.Queue[Event | None]] = set()

    def publish(self, revision: int, data: dict[str, Any]) -> None:
        """Tell all who watch."""
        event = Event(revision, "change", {"revision": revision, **data})
        self._revision = revision
        self._kept.append(event)
        for queue in self._watchers:
            if queue.qsize() >= _BEHIND:
                while not queue.empty():
                    queue.get_nowait()
                queue.put_nowait(self._reset())
            else:
                queue.put_nowait(event)

    async def watch(self, since: int | None = None) -> AsyncIterator[Event]:
        """Events from now on, or those after a revision first.

        Args:
            since: the last revision that the watcher knows.
        """
        queue: asyncio.Queue[Event | None] = asyncio.Queue()
        if since is not None and since != self._revision:
            missed = [event for event in self._kept if event.revision > since]
            whole = bool(missed) and missed[0].revision == since + 1
            for event in missed if whole else [self._reset()]:
                queue.put_nowait(event)
        self._watchers.add(queue)
        try:
            while (found := await queue.get()) is not None:
                yield found
        finally:
            self._watchers.discard(queue)

    def close(self) -> None:
        """End all streams."""
        for queue in self._watchers:
            queue.put_nowait(None)

    def _reset(self) -> Event:
        return Event(self._revision, "reset", {"revision": self._revision})
