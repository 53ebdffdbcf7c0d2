"""Checks of the raw columns, row by row: positions, confidence, times, agents and identifiers."""

from __future__ import annotations

import re
from datetime import UTC, datetime
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.readers.columns import Columns
from symboslam.engine.readers.crs import CoordinateSystem
from symboslam.errors import LandmarkError

UNWRITABLE = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\ud800-\udfff\ufffe\uffff]")
"""Characters that are no text and that XML, RDF or UTF-8 cannot hold."""

LONGEST_ID = 256
_FARTHEST = 1e9
"""Metres; no local map reaches farther."""


def fail(columns: Columns, row: int, problem: str) -> LandmarkError:
    """The error for one row, to be raised; names its place in the input."""
    return LandmarkError(problem, source=columns.source, where=columns.place(row))


def check_positions(columns: Columns, system: CoordinateSystem) -> None:
    """Positions must be finite and in range; the message says what they look like instead.

    Raises:
        LandmarkError: the first that is not.
    """
    x, y = columns.x, columns.y
    finite = np.isfinite(x) & np.isfinite(y)
    if not finite.all():
        row = int(np.argmin(finite))
        raise fail(columns, row, f"the coordinates ({x[row]}, {y[row]}) are not finite numbers")
    if not system.degrees:
        near = (np.abs(x) <= _FARTHEST) & (np.abs(y) <= _FARTHEST)
        if not near.all():
            row = int(np.argmin(near))
            problem = f"the coordinates ({x[row]}, {y[row]}) are farther than {_FARTHEST:g} m"
            raise fail(columns, row, problem)
        return
    valid = (np.abs(x) <= 180) & (np.abs(y) <= 90)
    if valid.all():
        return
    row = int(np.argmin(valid))
    first, second = x[row], y[row]
    problem = f"({first:.10g}, {second:.10g}) is out of range for longitude and latitude in degrees"
    if abs(first) <= 90 and abs(second) <= 180:
        problem += ": longitude and latitude look swapped, longitude comes first"
    elif max(np.abs(x).max(), np.abs(y).max()) > 360:
        problem += (
            ': these look like metres: add "crs_units": "m" to the file or give crs m, or name '
            "their coordinate system (crs EPSG:...)"
        )
    raise fail(columns, row, problem)


def check_confidence(columns: Columns) -> None:
    """Confidences must be in (0, 1].

    Raises:
        LandmarkError: the first that is not.
    """
    if columns.confidence is None:
        return
    valid = (columns.confidence > 0) & (columns.confidence <= 1)
    if not valid.all():
        row = int(np.argmin(valid))
        problem = f"the confidence {columns.confidence[row]} is not above 0 and at most 1"
        raise fail(columns, row, problem)


def read_times(columns: Columns, notes: list[str]) -> NDArray[Any] | None:
    """(n,) times in the extended form of ISO 8601, None where missing; None if there are none.

    Those without a zone are taken as UTC, which is added to ``notes``.

    Raises:
        LandmarkError: the first that is no ISO 8601 time.
    """
    if columns.time is None:
        return None
    zoned: dict[str | None, str | None] = {None: None, "": None}
    naive: set[str | None] = set()
    for row, text in enumerate(columns.time):
        if not text or text in zoned:
            continue
        try:
            time = datetime.fromisoformat(text)
        except ValueError as error:
            problem = f"the time {text[:40]!r} is not ISO 8601, such as 2022-01-31T12:00:00Z"
            raise fail(columns, row, problem) from error
        if time.tzinfo is None:
            naive.add(text)
            time = time.replace(tzinfo=UTC)
        zoned[text] = time.isoformat()
    if naive:
        without_zone = sum(text in naive for text in columns.time)
        notes.append(f"{without_zone} times have no zone and were read as UTC")
    times = np.empty(len(columns), object)
    times[:] = [zoned[text] for text in columns.time]
    return times


def read_agents(columns: Columns) -> NDArray[Any] | None:
    """(n,) names of agents, None where missing; None if there are none.

    Raises:
        LandmarkError: the first with characters that cannot be written.
    """
    if columns.agent is None:
        return None
    for name in set(columns.agent):
        if name and UNWRITABLE.search(name):
            problem = f"the agent {name[:80]!r} has characters that are no text"
            raise fail(columns, columns.agent.index(name), problem)
    agents = np.empty(len(columns), object)
    agents[:] = [name or None for name in columns.agent]
    return agents


def without_duplicates(columns: Columns) -> NDArray[np.bool_]:
    """(n,) mask of the rows that do not merely repeat an earlier one with the same id.

    Raises:
        LandmarkError: two different landmarks have the same id.
    """
    fresh = np.ones(len(columns), bool)
    if columns.id is None:
        return fresh
    given = [name for name in columns.id if name]
    if len(set(given)) == len(given):
        return fresh
    first: dict[str, int] = {}
    for row, name in enumerate(columns.id):
        if not name or (earlier := first.setdefault(name, row)) == row:
            continue
        if _content(columns, row) != _content(columns, earlier):
            problem = (
                f"the id {name[:80]!r} is already that of a different landmark "
                f"({columns.place(earlier)}): ids must be unique"
            )
            raise fail(columns, row, problem)
        fresh[row] = False
    return fresh


def _content(columns: Columns, row: int) -> tuple[object, ...]:
    time = columns.time[row] if columns.time else None
    agent = columns.agent[row] if columns.agent else None
    confidence = 1.0 if columns.confidence is None else float(columns.confidence[row])
    x, y = float(columns.x[row]), float(columns.y[row])
    return int(columns.kind[row]), x, y, confidence, time, agent


def check_ids(columns: Columns) -> None:
    """Identifiers must be short and writable.

    Raises:
        LandmarkError: the first that is not.
    """
    for row, name in enumerate(columns.id or ()):
        if name and (len(name) > LONGEST_ID or UNWRITABLE.search(name)):
            problem = f"the id {name[:80]!r} is longer than {LONGEST_ID} or is no text"
            raise fail(columns, row, problem)


def make_ids(columns: Columns) -> NDArray[np.str_]:
    """(n,) identifiers: those given; for the others the row, marked if that is an id already.

    Raises:
        LandmarkError: the first that is too long or cannot be written.
    """
    size = len(columns)
    if columns.id is None:
        return np.arange(size).astype(f"U{len(str(size))}")
    check_ids(columns)
    missing = [row for row, name in enumerate(columns.id) if not name]
    if not missing:
        return np.array(columns.id, np.str_)
    given, mark = set(columns.id), ""
    while any(f"{mark}{row}" in given for row in missing):
        mark += "#"
    return np.array([name or f"{mark}{row}" for row, name in enumerate(columns.id)], np.str_)
