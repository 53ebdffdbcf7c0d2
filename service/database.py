"""The service's own records (tokens, maps, batches): one SQLite file beside the store."""

from __future__ import annotations

import sqlite3
from pathlib import Path

from symboslam.errors import StoreError

NAME = "service.sqlite3"


def open_database(data: Path) -> sqlite3.Connection:
    """The database in a data folder; each module makes the tables that it needs.

    What is committed survives the death of the process: writes go to a log that the operating
    system holds (``WAL``). The connection may be used by any thread, one at a time; transactions
    are begun and ended by the caller.

    Raises:
        StoreError: the folder or file cannot be made or opened.
    """
    try:
        data.mkdir(parents=True, exist_ok=True)
        found = sqlite3.connect(
            data / NAME, timeout=10, isolation_level=None, check_same_thread=False
        )
        found.execute("PRAGMA journal_mode = WAL")
        found.execute("PRAGMA synchronous = NORMAL")
        found.execute("PRAGMA foreign_keys = ON")
    except (OSError, sqlite3.Error) as error:
        raise StoreError(f"{data / NAME} cannot be opened: {error}") from error
    return found
