"""The end of a service in good order: no longer ready, event streams ended, requests let go."""

from __future__ import annotations

import asyncio
from typing import Annotated, Any, cast

from fastapi import Depends, Request


class Lifecycle:
    """How far a service is on the way to its end.

    Attributes:
        draining: it stops soon, and says at ``/readyz`` that it takes no more.
        ending: it takes no more requests; those that run are waited for, event streams are not.
        streams: the tasks that send event streams, or wait for what may never come.
    """

    def __init__(self) -> None:
        self.draining = False
        self.ending = False
        self.streams: set[asyncio.Task[Any]] = set()

    def end(self) -> None:
        """End event streams, and let nothing start again."""
        self.draining = self.ending = True
        for task in self.streams:
            task.cancel("the service stops")


async def _lifecycle(request: Request) -> Lifecycle:
    return cast(Lifecycle, request.app.state.lifecycle)


CurrentLifecycle = Annotated[Lifecycle, Depends(_lifecycle)]
