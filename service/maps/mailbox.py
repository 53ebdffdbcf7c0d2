"""Mailbox: the increments that edge agents send to a map, for a control agent to fetch.

An increment is known by robot, run and sequence. It is taken once, in whatever order they come, and
is on record before its sender hears so. Nothing here looks into the pose graphs.
"""

from __future__ import annotations

import asyncio
import json
import sqlite3
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from datetime import UTC, datetime
from hashlib import sha256
from typing import Any

from symboslam.engine.slam.increment import AHEAD, EdgeIncrement
from symboslam.service.maps.tables import Tables

_TABLES = """
CREATE TABLE IF NOT EXISTS increment (
  map TEXT NOT NULL REFERENCES map ON DELETE CASCADE, number INTEGER NOT NULL,
  robot TEXT NOT NULL, run TEXT NOT NULL, sequence INTEGER NOT NULL, digest TEXT NOT NULL,
  received TEXT NOT NULL, poses INTEGER NOT NULL, sightings INTEGER NOT NULL,
  last INTEGER NOT NULL, content TEXT NOT NULL,
  PRIMARY KEY (map, number), UNIQUE (map, robot, run, sequence)
);
"""
_MOST_BYTES = 16 * 1024 * 1024
"""Of increments that are given at a time; one alone may be larger."""
MOST_GAPS = 100
"""Gaps of a run that are listed."""


class IncrementConflictError(Exception):
    """Another increment with the same robot, run and sequence was taken before."""


class IncrementAheadError(Exception):
    """An increment is numbered so far beyond the others of its run that it is a mistake."""


@dataclass(frozen=True)
class Run:
    """What is known of one run of a robot.

    Attributes:
        robot: its name.
        run: of the robot.
        increments: how many have come.
        poses: key poses in them.
        sightings: sightings in them.
        latest: the highest sequence.
        missing: (first, last) sequence of each gap below the highest, at most `MOST_GAPS`.
        began: when the first one came, ISO 8601.
        heard: when the latest one came.
        silent: seconds since then.
        finished: the last one of the run is there, and all before it.
    """

    robot: str
    run: str
    increments: int
    poses: int
    sightings: int
    latest: int
    missing: tuple[tuple[int, int], ...]
    began: str
    heard: str
    silent: float
    finished: bool


class Mailbox(Tables):
    """The increments of all maps; any thread may call what is not async.

    Args:
        database: an open one that has the table of maps.

    Raises:
        StoreError: (all methods) the database cannot be read or written; nothing has changed.
    """

    def __init__(self, database: sqlite3.Connection) -> None:
        super().__init__(database, _TABLES)
        self._news: dict[str, asyncio.Event] = {}

    async def post(self, identifier: str, increments: Iterable[EdgeIncrement]) -> Counter[str]:
        """Take increments, all or none, and tell those who wait for them.

        Returns:
            How many are ``new``, and how many were ``known``.

        Raises:
            IncrementConflictError: one is known with another content; names it.
            IncrementAheadError: one is numbered more than `AHEAD` beyond the highest; names it.
        """
        found = await asyncio.to_thread(self.put, identifier, list(increments))
        if found["new"] and (news := self._news.pop(identifier, None)):
            news.set()
        return found

    async def fetch(self, identifier: str, after: int, limit: int, seconds: float) -> list[str]:
        """Increments as lines of JSON: see `read`. Waits so long for the first."""
        deadline = asyncio.get_running_loop().time() + seconds
        while True:
            news = self._news.setdefault(identifier, asyncio.Event())
            lines = await asyncio.to_thread(self.read, identifier, after, limit)
            left = deadline - asyncio.get_running_loop().time()
            if lines or left <= 0:
                return lines
            try:
                await asyncio.wait_for(news.wait(), left)
            except TimeoutError:
                return []

    def put(self, identifier: str, increments: list[EdgeIncrement]) -> Counter[str]:
        """Keep increments; see `post`."""
        now = datetime.now(UTC).isoformat(timespec="milliseconds")
        count: Counter[str] = Counter()
        with self._transaction() as database:
            number = _number(database, identifier)
            for each in increments:
                content = json.dumps(each.to_json(), ensure_ascii=False, separators=(",", ":"))
                digest = sha256(content.encode()).hexdigest()
                name = identifier, each.robot, each.run, each.sequence
                known = database.execute(
                    "SELECT digest FROM increment"
                    " WHERE map = ? AND robot = ? AND run = ? AND sequence = ?",
                    name,
                ).fetchone()
                if known is not None and known[0] != digest:
                    raise IncrementConflictError(
                        f"another increment {each.sequence} of run {each.run!r} of robot"
                        f" {each.robot!r} was taken before; a run and its numbers belong to one"
                        " agent"
                    )
                count["new" if known is None else "known"] += 1
                if known is None:
                    _check_ahead(database, identifier, each)
                    number += 1
                    database.execute(
                        "INSERT INTO increment (map, robot, run, sequence, number, digest,"
                        " received, poses, sightings, last, content)"
                        " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                        (
                            *name, number, digest, now, len(each.time), len(each.row), each.last,
                            content,
                        ),
                    )  # fmt: skip
        return count

    def read(self, identifier: str, after: int, limit: int) -> list[str]:
        """Increments that came after the one with a number, as lines of JSON.

        Each has ``number``, ``received`` and ``increment``. A few megabytes at a time.
        """
        sizes = self._all(
            "SELECT number, length(content) FROM increment WHERE map = ? AND number > ?"
            " ORDER BY number LIMIT ?",
            identifier, after, limit,
        )  # fmt: skip
        size, end = 0, after
        for number, length in sizes:
            size += length
            if size > _MOST_BYTES and end > after:
                break
            end = number
        rows = self._all(
            "SELECT number, received, content FROM increment"
            " WHERE map = ? AND number > ? AND number <= ? ORDER BY number",
            identifier, after, end,
        )  # fmt: skip
        return [
            f'{{"number":{number},"received":"{received}","increment":{content}}}\n'
            for number, received, content in rows
        ]

    def runs(self, identifier: str) -> list[Run]:
        """What is known of each run of each robot, in the order of their first increments."""
        now = datetime.now(UTC)
        rows = self._all(
            "SELECT robot, run, count(*), sum(poses), sum(sightings), max(sequence),"
            " min(received), max(received), max(iif(last, sequence, -1)) FROM increment"
            " WHERE map = ? GROUP BY robot, run ORDER BY min(number)",
            identifier,
        )
        found = []
        for robot, run, count, poses, sightings, latest, began, heard, end in rows:
            missing = self._missing(identifier, robot, run) if count <= latest else ()
            silent = (now - datetime.fromisoformat(heard)).total_seconds()
            found.append(
                Run(
                    robot, run, count, poses, sightings, latest, missing, began, heard,
                    max(round(silent, 3), 0.0), not missing and end == latest,
                )
            )  # fmt: skip
        return found

    def _missing(self, identifier: str, robot: str, run: str) -> tuple[tuple[int, int], ...]:
        rows = self._all(
            "SELECT before + 1, sequence - 1 FROM (SELECT sequence, lag(sequence, 1, -1)"
            " OVER (ORDER BY sequence) AS before FROM increment"
            " WHERE map = ? AND robot = ? AND run = ?) WHERE sequence > before + 1 LIMIT ?",
            identifier, robot, run, MOST_GAPS,
        )  # fmt: skip
        return tuple((first, last) for first, last in rows)


def _number(database: sqlite3.Connection, identifier: str) -> int:
    """Number of the increment of a map that came last; 0 if there is none."""
    query = "SELECT coalesce(max(number), 0) FROM increment WHERE map = ?"
    return int(database.execute(query, (identifier,)).fetchone()[0])


def _check_ahead(database: sqlite3.Connection, identifier: str, each: EdgeIncrement) -> None:
    """Refuse what is numbered too far ahead.

    Raises:
        IncrementAheadError: it is.
    """
    (latest,) = database.execute(
        "SELECT coalesce(max(sequence), -1) FROM increment WHERE map = ? AND robot = ? AND run = ?",
        (identifier, each.robot, each.run),
    ).fetchone()
    if each.sequence > latest + AHEAD:
        come = f"the highest that has come is {latest}" if latest >= 0 else "none has come yet"
        raise IncrementAheadError(
            f"increment {each.sequence} of run {each.run!r} of robot {each.robot!r} cannot be:"
            f" {come}, and at most {AHEAD} may be missing in between"
        )


def any_of(run: Run) -> dict[str, Any]:
    """A run as plain values."""
    return {**run.__dict__, "missing": [list(gap) for gap in run.missing]}
