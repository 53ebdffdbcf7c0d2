"""Spool: increments on the robot's own disk, from when they are made until the service has them.

One file for each robot and map. It also knows how far each run has come, so that a replay that was
cut short goes on where it stopped, and tells the end of runs that did not tell it themselves.
"""

from __future__ import annotations

import fcntl
import json
import sqlite3
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import quote

from symboslam.engine.slam.increment import EdgeIncrement
from symboslam.errors import InputError, OutputError

_TABLES = """
CREATE TABLE IF NOT EXISTS run (
  name TEXT PRIMARY KEY, next INTEGER NOT NULL, empty TEXT, state TEXT NOT NULL
);
CREATE TABLE IF NOT EXISTS letter (
  number INTEGER PRIMARY KEY AUTOINCREMENT, run TEXT NOT NULL, sequence INTEGER NOT NULL,
  content TEXT NOT NULL
);
CREATE TABLE IF NOT EXISTS refused (
  run TEXT NOT NULL, sequence INTEGER NOT NULL, reason TEXT NOT NULL, content TEXT NOT NULL
);
"""
OPEN, FINISHED, CLOSED = "open", "finished", "closed"


class SpoolFullError(OutputError):
    """A spool that takes no more until something was delivered."""


@dataclass(frozen=True)
class Letter:
    """An increment that waits to be delivered.

    Attributes:
        number: of it in the spool.
        name: run and sequence, in words.
        content: its JSON.
    """

    number: int
    name: str
    content: str


class Spool:
    """The increments of one robot for one map that are not delivered yet; any thread may call.

    Args:
        folder: where its file lies; made if needed.
        robot: its name.
        identifier: id of the map.
        limit: bytes of increments that it takes.

    Raises:
        OutputError: (all methods) the file cannot be read or written, or another agent has it.
    """

    def __init__(self, folder: Path, robot: str, identifier: str, limit: int) -> None:
        self.folder, self._limit = folder, limit
        self._changed = threading.Condition()
        self._file = folder / f"{quote(robot, safe='')}@{quote(identifier, safe='')}.sqlite3"
        try:
            folder.mkdir(parents=True, exist_ok=True)
            self._guard = self._file.with_suffix(".lock").open("ab")
        except OSError as error:
            raise OutputError(f"{folder}: no spool can be kept there: {error.strerror}") from error
        try:
            fcntl.flock(self._guard, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            self._guard.close()
            raise OutputError(
                f"{self._file}: another agent of robot {robot!r} sends to this map; stop it, or"
                " give this robot a name of its own"
            ) from error
        try:
            with self._errors():
                self._database = self._open()
                count, size = self._database.execute(
                    "SELECT count(*), coalesce(sum(length(content)), 0) FROM letter"
                ).fetchone()
        except OutputError:
            self._guard.close()
            raise
        self.waiting, self._bytes = int(count), int(size)
        """How many increments wait."""

    def _open(self) -> sqlite3.Connection:
        found = sqlite3.connect(self._file, isolation_level=None, check_same_thread=False)
        try:
            found.execute("PRAGMA journal_mode = WAL")
            found.execute("PRAGMA synchronous = FULL")  # robots lose power
            found.executescript(_TABLES)
        except sqlite3.Error:
            found.close()
            raise
        return found

    def close(self) -> None:
        """Let another agent have it."""
        self._database.close()
        self._guard.close()

    def begin(self, run: str) -> bool:
        """Begin a run or go on with it; other runs of this robot are over.

        Returns:
            Whether there is anything left to do in this run.

        Raises:
            InputError: it was closed before, because another one began.
        """
        with self._transaction() as database:
            row = database.execute("SELECT state FROM run WHERE name = ?", (run,)).fetchone()
            if row == (CLOSED,):
                raise InputError(
                    f"run {run!r} was cut short and closed when another one began; --run NAME"
                    " sends it all as a run of its own"
                )
            if row == (FINISHED,):
                return False
            others = database.execute(
                "SELECT name, next, empty FROM run WHERE state = ? AND name != ?", (OPEN, run)
            ).fetchall()
            for name, number, empty in others:
                if empty is not None:
                    last = {**json.loads(empty), "sequence": number, "last": True}
                    self._add(database, name, number, _dump(last))
                database.execute("UPDATE run SET state = ? WHERE name = ?", (CLOSED, name))
            database.execute("INSERT OR IGNORE INTO run VALUES (?, 0, NULL, ?)", (run, OPEN))
        return True

    def put(self, increment: EdgeIncrement) -> bool:
        """Keep an increment; whether it is new. It is on the disk when this returns.

        Raises:
            SpoolFullError: there is no room.
        """
        content = _dump(increment.to_json())
        with self._transaction() as database:
            (known,) = database.execute(
                "SELECT next FROM run WHERE name = ?", (increment.run,)
            ).fetchone()
            if increment.sequence < known:
                return False
            if self._bytes + len(content) > self._limit and self.waiting:
                raise SpoolFullError(
                    f"{self._file} is full: {self.waiting} increments wait in it"
                    f" ({self._bytes / 2**20:.1f} MiB)"
                )
            self._add(database, increment.run, increment.sequence, content)
            state = FINISHED if increment.last else OPEN
            database.execute(
                "UPDATE run SET next = ?, empty = ?, state = ? WHERE name = ?",
                (increment.sequence + 1, _dump(_empty(increment)), state, increment.run),
            )
        return True

    def next(self, count: int, size: int) -> list[Letter]:
        """The increments that have waited longest: so many, so many bytes, and at least one."""
        with self._errors(), self._changed:
            rows = self._database.execute(
                "SELECT number, run, sequence, content FROM letter ORDER BY number LIMIT ?",
                (count,),
            ).fetchall()
        found: list[Letter] = []
        total = 0
        for number, run, sequence, content in rows:
            total += len(content)
            if found and total > size:
                break
            found.append(Letter(number, f"increment {sequence} of run {run}", content))
        return found

    def delivered(self, letters: Sequence[Letter]) -> None:
        """Forget increments that the service has."""
        with self._transaction() as database:
            self._remove(database, letters)

    def refuse(self, letter: Letter, reason: str) -> None:
        """Put an increment aside that the service will never take."""
        with self._transaction() as database:
            database.execute(
                "INSERT INTO refused SELECT run, sequence, ?, content FROM letter WHERE number = ?",
                (reason, letter.number),
            )
            self._remove(database, [letter])

    def wait(self, seconds: float) -> None:
        """Wait until something comes or goes, but not longer than that."""
        with self._changed:
            self._changed.wait(seconds)

    def _add(self, database: sqlite3.Connection, run: str, sequence: int, content: str) -> None:
        database.execute(
            "INSERT INTO letter (run, sequence, content) VALUES (?, ?, ?)", (run, sequence, content)
        )
        self.waiting += 1
        self._bytes += len(content)

    def _remove(self, database: sqlite3.Connection, letters: Sequence[Letter]) -> None:
        numbers = [(letter.number,) for letter in letters]
        database.executemany("DELETE FROM letter WHERE number = ?", numbers)
        self.waiting -= len(letters)
        self._bytes -= sum(len(letter.content) for letter in letters)

    @contextmanager
    def _transaction(self) -> Iterator[sqlite3.Connection]:
        with self._errors(), self._changed:
            before = self.waiting, self._bytes
            self._database.execute("BEGIN IMMEDIATE")
            try:
                yield self._database
                self._database.execute("COMMIT")
            except BaseException:
                if self._database.in_transaction:
                    self._database.rollback()
                    self.waiting, self._bytes = before
                raise
            self._changed.notify_all()

    @contextmanager
    def _errors(self) -> Iterator[None]:
        try:
            yield
        except sqlite3.Error as error:
            if getattr(error, "sqlite_errorcode", None) == sqlite3.SQLITE_FULL:
                raise SpoolFullError(f"{self._file}: the disk is full") from error
            raise OutputError(f"{self._file} cannot be read or written: {error}") from error


def _empty(increment: EdgeIncrement) -> dict[str, Any]:
    """An increment with nothing in it that could come after another."""
    value = increment.to_json()
    first = increment.first + len(increment.time)
    return {**{k: [] if isinstance(v, list) else v for k, v in value.items()}, "first": first,
            "start": value["start"], "start_sigma": value["start_sigma"]}  # fmt: skip


def _dump(value: object) -> str:
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"))
