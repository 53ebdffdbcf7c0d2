"""Snapshots of the store for those who read: made when needed, removed when nobody holds them."""

from __future__ import annotations

import asyncio
import shutil
from collections.abc import Callable
from pathlib import Path

from symboslam.errors import StoreError


class Snapshots:
    """Folders that hold the store as it was at some moment.

    Files in them are hard links to the store's own, so that one costs no space until the store has
    replaced them, and what is read stays there however long a query takes.

    Args:
        folder: where they are; emptied by `clear`.
        make: makes one in a folder that is not there yet.
        held: the folders that somebody reads.
    """

    def __init__(
        self, folder: Path, make: Callable[[str], None], held: Callable[[], set[str]]
    ) -> None:
        self._folder, self._make, self._held = folder, make, held
        self._making = asyncio.Lock()
        self._made = 0
        self._there: set[str] = set()
        self._current: tuple[int, str] | None = None
        self._removing: set[asyncio.Future[None]] = set()

    def clear(self) -> None:
        """Remove all."""
        self._current = None
        self._there.clear()
        shutil.rmtree(self._folder, ignore_errors=True)

    async def at(self, generation: int) -> str:
        """A snapshot with everything that was written up to a generation, perhaps with more.

        Raises:
            StoreError: it cannot be made.
        """
        async with self._making:  # whoever waits here finds the new one
            if self._current is None or self._current[0] < generation:
                self._made += 1
                path = str(self._folder / str(self._made))
                self._there.add(path)
                try:
                    await asyncio.to_thread(self._new, path)
                except OSError as error:
                    raise StoreError(f"the store cannot be read: {error}") from error
                before = self._current[1] if self._current else path
                self._current = generation, path
                self._remove(self._there - self._held() - {before, path})
            return self._current[1]

    def _new(self, path: str) -> None:
        self._folder.mkdir(parents=True, exist_ok=True)
        self._make(path)

    def _remove(self, paths: set[str]) -> None:
        """Remove those that nobody holds, while the query that asked for a new one goes on."""
        self._there -= paths

        def remove() -> None:
            for path in paths:
                shutil.rmtree(path, ignore_errors=True)

        task = asyncio.ensure_future(asyncio.to_thread(remove))
        self._removing.add(task)
        task.add_done_callback(self._removing.discard)
