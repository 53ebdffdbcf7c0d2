"""Records: what is known of maps, in SQLite; the store is made from it and can be made anew."""

from __future__ import annotations

import json
import sqlite3
from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import asdict, dataclass, field
from typing import Any

from symboslam.engine.sightings import Name
from symboslam.engine.table import Landmark
from symboslam.service.maps.tables import Tables

_TABLES = """
CREATE TABLE IF NOT EXISTS map (
  id TEXT PRIMARY KEY, name TEXT NOT NULL, created TEXT NOT NULL, area TEXT NOT NULL,
  options TEXT NOT NULL, left_out TEXT NOT NULL DEFAULT '{}', revision INTEGER NOT NULL DEFAULT 0,
  changed TEXT NOT NULL, stated INTEGER NOT NULL DEFAULT -1, absence REAL
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS landmark (
  map TEXT NOT NULL REFERENCES map ON DELETE CASCADE, id TEXT NOT NULL, feature TEXT NOT NULL,
  x REAL NOT NULL, y REAL NOT NULL, confidence REAL NOT NULL, time TEXT, agent TEXT,
  count INTEGER NOT NULL, weight REAL NOT NULL, number INTEGER NOT NULL, PRIMARY KEY (map, id)
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS name (
  map TEXT NOT NULL REFERENCES map ON DELETE CASCADE, agent TEXT NOT NULL, name TEXT NOT NULL,
  landmark TEXT NOT NULL, PRIMARY KEY (map, agent, name)
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS batch (
  map TEXT NOT NULL REFERENCES map ON DELETE CASCADE, id TEXT NOT NULL, digest TEXT NOT NULL,
  received TEXT NOT NULL, result TEXT NOT NULL, PRIMARY KEY (map, id)
) WITHOUT ROWID;
CREATE TABLE IF NOT EXISTS override (
  map TEXT NOT NULL REFERENCES map ON DELETE CASCADE, id TEXT NOT NULL, segment TEXT NOT NULL,
  environment TEXT, operator TEXT NOT NULL, reason TEXT NOT NULL, made TEXT NOT NULL, undone TEXT,
  snapshot TEXT NOT NULL, PRIMARY KEY (map, id)
) WITHOUT ROWID;
"""


Row = tuple[int, str, Landmark]
"""A landmark after its number in the map and the IRI of its feature."""


@dataclass(frozen=True)
class MapRecord:
    """A map as it was asked for.

    Attributes:
        id: its identifier.
        name: what people call it.
        created: when, ISO 8601.
        area: frame, box and surveyed area, as plain values.
        options: profile, scheme, ontology, settings and the rest, as plain values.
        left_out: kind of cause -> how many observations were left out so far.
        revision: how often it changed.
        changed: when it did last, ISO 8601.
        stated: the revision that the store is at; -1 = none.
        absence: the estimate of absence that the store's statements were made with, if any.
    """

    id: str
    name: str
    created: str
    area: dict[str, Any]
    options: dict[str, Any]
    changed: str
    left_out: Counter[str] = field(default_factory=Counter)
    revision: int = 0
    stated: int = -1
    absence: float | None = None


@dataclass(frozen=True)
class Override:
    """An operator's statement that a segment is of another type.

    Attributes:
        id: its identifier in the map.
        segment: the segment.
        environment: IRI of the type; None = unknown.
        operator: who says so.
        reason: why, in the operator's words.
        made: when, ISO 8601.
        undone: when it was taken back, or None.
        snapshot: what was stated of the segment when it was made, as N-Quads.
    """

    id: str
    segment: str
    environment: str | None
    operator: str
    reason: str
    made: str
    undone: str | None = None
    snapshot: str = ""


class Records(Tables):
    """Maps, landmarks, batches and overrides; any thread may call.

    Args:
        database: an open one; the tables are made if they are not there.

    Raises:
        StoreError: (all methods) the database cannot be read or written; nothing has changed.
    """

    def __init__(self, database: sqlite3.Connection) -> None:
        super().__init__(database, _TABLES)
        with self._errors():
            columns = self._database.execute("SELECT name FROM pragma_table_info('map')")
            if ("absence",) not in columns.fetchall():  # made before there was this column
                self._database.execute("ALTER TABLE map ADD COLUMN absence REAL")

    def maps(self) -> list[str]:
        """Ids of all maps, the oldest first."""
        return [row[0] for row in self._all("SELECT id FROM map ORDER BY created, id")]

    def map(self, identifier: str) -> MapRecord | None:
        """A map, or None."""
        rows = self._all(
            "SELECT id, name, created, area, options, changed, left_out, revision, stated, absence"
            " FROM map WHERE id = ?",
            identifier,
        )
        if not rows:
            return None
        i, name, created, area, options, changed, left_out, revision, stated, absence = rows[0]
        return MapRecord(
            i, name, created, json.loads(area), json.loads(options), changed,
            Counter(json.loads(left_out)), revision, stated, absence,
        )  # fmt: skip

    def landmarks(self, identifier: str) -> Iterator[tuple[str, dict[str, Any]]]:
        """The landmarks of a map: IRI of their feature, and everything else."""
        columns = "feature, id, x, y, confidence, time, agent, count, weight"
        for row in self._all(
            f"SELECT {columns} FROM landmark WHERE map = ? ORDER BY number, id", identifier
        ):
            yield row[0], dict(zip(columns.split(", ")[1:], row[1:], strict=True))

    def names(self, identifier: str) -> dict[Name, str]:
        """What agents call the landmarks of a map."""
        rows = self._all("SELECT agent, name, landmark FROM name WHERE map = ?", identifier)
        return {(agent, name): landmark for agent, name, landmark in rows}

    def batch(self, identifier: str, batch: str) -> tuple[str, dict[str, Any]] | None:
        """Digest and result of a batch that was taken, or None."""
        rows = self._all(
            "SELECT digest, result FROM batch WHERE map = ? AND id = ?", identifier, batch
        )
        return (rows[0][0], json.loads(rows[0][1])) if rows else None

    def batches(self, identifier: str) -> int:
        """How many batches were taken."""
        return int(self._all("SELECT count(*) FROM batch WHERE map = ?", identifier)[0][0])

    def overrides(self, identifier: str) -> list[Override]:
        """The overrides of a map, the oldest first; those taken back included."""
        rows = self._all(
            "SELECT id, segment, environment, operator, reason, made, undone, snapshot"
            " FROM override WHERE map = ? ORDER BY made, id",
            identifier,
        )
        return [Override(*row) for row in rows]

    def add(self, record: MapRecord, landmarks: Iterable[Row]) -> None:
        """Add a map with its first landmarks."""
        with self._transaction() as database:
            database.execute(
                "INSERT INTO map"
                " (id, name, created, area, options, changed, left_out, revision)"
                " VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
                (
                    record.id, record.name, record.created, json.dumps(record.area),
                    json.dumps(record.options), record.changed, json.dumps(record.left_out),
                    record.revision,
                ),
            )  # fmt: skip
            _put(database, record.id, landmarks)

    def remove(self, identifier: str) -> None:
        """Remove a map and all that belongs to it."""
        with self._transaction() as database:
            database.execute("DELETE FROM map WHERE id = ?", (identifier,))

    def take(
        self,
        record: MapRecord,
        landmarks: Iterable[Row],
        names: Iterable[tuple[Name, str]],
        batches: Iterable[tuple[str, str, dict[str, Any]]],
        removed: Iterable[str] = (),
    ) -> None:
        """Keep what batches did to a map: all of it or nothing.

        Args:
            record: the map with its new revision.
            landmarks: those that changed.
            names: what agents call them.
            batches: id, digest and result of each.
            removed: ids of those that are gone.
        """
        i = record.id
        with self._transaction() as database:
            database.executemany(
                "DELETE FROM landmark WHERE map = ? AND id = ?", ((i, gone) for gone in removed)
            )
            _put(database, i, landmarks)
            database.executemany(
                "INSERT OR REPLACE INTO name VALUES (?, ?, ?, ?)",
                ((i, agent, name, landmark) for (agent, name), landmark in names),
            )
            database.executemany(
                "INSERT INTO batch VALUES (?, ?, ?, ?, ?)",
                (
                    (i, b, digest, record.changed, json.dumps(result))
                    for b, digest, result in batches
                ),
            )
            database.execute(
                "UPDATE map SET revision = ?, changed = ?, left_out = ? WHERE id = ?",
                (record.revision, record.changed, json.dumps(record.left_out), i),
            )

    def keep_overrides(self, record: MapRecord, overrides: Iterable[Override]) -> None:
        """Add overrides, or change some."""
        with self._transaction() as database:
            for values in map(asdict, overrides):
                database.execute(
                    f"INSERT OR REPLACE INTO override (map, {', '.join(values)})"
                    f" VALUES (?{', ?' * len(values)})",
                    (record.id, *values.values()),
                )
            database.execute(
                "UPDATE map SET revision = ?, changed = ? WHERE id = ?",
                (record.revision, record.changed, record.id),
            )

    def stated(self, identifier: str, revision: int, absence: float | None = None) -> None:
        """Note the revision that the store is at, and the estimate of absence behind it."""
        with self._transaction() as database:
            database.execute(
                "UPDATE map SET stated = ?, absence = ? WHERE id = ?",
                (revision, absence, identifier),
            )


def _put(database: sqlite3.Connection, identifier: str, landmarks: Iterable[Row]) -> None:
    database.executemany(
        "INSERT OR REPLACE INTO landmark VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        (
            (identifier, m.id, iri, m.x, m.y, m.confidence, m.time, m.agent, m.count, m.weight, n)
            for n, iri, m in landmarks
        ),
    )
