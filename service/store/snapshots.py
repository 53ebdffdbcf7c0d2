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
        self._current: tuple[int, str] | None = None

    def clear(self) -> None:
        """Remove all."""
        self._current = None
        shutil.rmtree(self._folder, ignore_errors=True)

    async def at(self, generation: int) -> str:
        """A snapshot with everything that was written up to a generation, perhaps with more.

        Raises:
            StoreError: it cannot be made.
        """
        async with self._making:  # whoever waits here finds the new one
            if self._current is None or self._current[0] < generation:
                self._made += 1
                path = self._folder / str(self._made)
                try:
                    await asyncio.to_thread(self._replace, path, self._held())
                except OSError as error:
                    raise StoreError(f"the store cannot be read: {error}") from error
                self._current = generation, str(path)
            return self._current[1]

    def _replace(self, path: Path, held: set[str]) -> None:
        """Make one and remove those that nobody holds."""
        self._folder.mkdir(parents=True, exist_ok=True)
        current = self._current and self._current[1]
        for other in self._folder.iterdir():
            if str(other) not in held and str(other) != current:
                shutil.rmtree(other, ignore_errors=True)
        self._make(str(path))
