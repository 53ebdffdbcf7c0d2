"""Tables: what modules that keep something in SQLite share, which is threads and transactions."""

from __future__ import annotations

import sqlite3
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from symboslam.errors import StoreError


class Tables:
    """Tables of a database; any thread may call.

    Args:
        database: an open one.
        tables: what makes them if they are not there, in SQL.

    Raises:
        StoreError: (all methods) the database cannot be read or written; nothing has changed.
    """

    def __init__(self, database: sqlite3.Connection, tables: str) -> None:
        self._database, self._lock = database, threading.Lock()
        with self._errors():
            self._database.executescript(tables)

    def _all(self, query: str, *values: str | int) -> list[tuple[Any, ...]]:
        with self._errors(), self._lock:
            return self._database.execute(query, values).fetchall()

    @contextmanager
    def _transaction(self) -> Iterator[sqlite3.Connection]:
        with self._errors(), self._lock:
            self._database.execute("BEGIN IMMEDIATE")
            try:
                yield self._database
                self._database.execute("COMMIT")
            except BaseException:
                self._database.rollback()
                raise

    @contextmanager
    def _errors(self) -> Iterator[None]:
        try:
            yield
        except sqlite3.Error as error:
            raise StoreError(f"the records cannot be read or written: {error}") from error
