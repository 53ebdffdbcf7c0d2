"""CSV landmarks: a header with class, x, y (or lon, lat) and optional columns, then rows."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice
from typing import Any, BinaryIO

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.readers.columns import Codes, Columns, FeatureIndex, Floats, Progress
from symboslam.engine.readers.crs import DEGREES, METRES
from symboslam.engine.readers.source import Source
from symboslam.errors import LandmarkError

_CHUNK = 8_192
_POSITIONS = (
    ("x", "y", METRES),
    ("lon", "lat", DEGREES),
    ("lng", "lat", DEGREES),
    ("longitude", "latitude", DEGREES),
)
_OPTIONAL = ("confidence", "id", "time", "agent")
_NEED = "a header such as class,x,y or class,lon,lat is needed"
_NEWLINE = re.compile(r"\r\n|\r|\n")
Row = list[str]


@dataclass(frozen=True)
class _Header:
    """Where each column stands; the coordinate system that the position columns' names imply."""

    names: tuple[str, ...]
    label: int
    x: int
    y: int
    crs: str
    optional: dict[str, int]
    unused: tuple[str, ...]


@dataclass
class _Table:
    """The columns read so far, one piece a chunk."""

    codes: Codes = field(default_factory=Codes)
    kind: list[NDArray[np.int32]] = field(default_factory=list)
    x: list[Floats] = field(default_factory=list)
    y: list[Floats] = field(default_factory=list)
    confidence: list[Floats] = field(default_factory=list)
    lines: list[NDArray[np.int32]] = field(default_factory=list)
    texts: dict[str, list[str | None]] = field(default_factory=dict)
    seen: dict[str, str] = field(default_factory=dict)


def read(source: Source, knowledge: FeatureIndex, progress: Progress) -> Columns:
    """Columns of a CSV file with comma, semicolon or tab between the fields.

    Raises:
        LandmarkError: the file is empty, its header lacks a column, or a row is wrong; a row is
            named by its line.
    """
    progress("reading", 0.0)
    size = max(source.size, 1)
    with source.open() as (stream, stored):
        text = io.TextIOWrapper(stream, encoding="utf-8-sig", newline="")
        try:
            return _read(text, source.name, lambda: progress("reading", _share(stored, size)))
        except UnicodeDecodeError as error:
            raise LandmarkError("the file is not UTF-8 text", source=source.name) from error
        finally:
            text.detach()


def _share(stored: BinaryIO, size: int) -> float:
    return min(stored.tell() / size, 1.0)


def _read(text: io.TextIOWrapper, name: str, progress: Callable[[], None]) -> Columns:
    first = ""
    skipped = 0
    while not first.strip():
        first = text.readline()
        if not first:
            raise LandmarkError(f"the file is empty: {_NEED}", source=name)
        skipped += 1
    delimiter = max(",;\t", key=first.count)
    header = _header(next(csv.reader([first], delimiter=delimiter)), name)
    table = _Table(texts={key: [] for key in _OPTIONAL[1:] if key in header.optional})
    for rows, lines in _chunks(csv.reader(text, delimiter=delimiter, strict=True), skipped, name):
        _add(table, rows, lines, header, name)
        progress()
    lines = _join(table.lines, np.int32)
    unused = ", ".join(header.unused)
    return Columns(
        source=name,
        x=_join(table.x, np.float64),
        y=_join(table.y, np.float64),
        kind=_join(table.kind, np.int32),
        kinds=[(label, ()) for label in table.codes],
        place=lambda row: f"line {lines[row]}",
        crs=header.crs,
        crs_from="file" if header.crs == DEGREES else "default",
        confidence=_join(table.confidence, np.float64) if table.confidence else None,
        id=table.texts.get("id"),
        time=table.texts.get("time"),
        agent=table.texts.get("agent"),
        notes=(f"columns that were not used: {unused}",) if unused else (),
    )


def _header(fields: Row, name: str) -> _Header:
    names = tuple(field.strip().lower() for field in fields)

    def fail(problem: str) -> LandmarkError:
        found = ", ".join(names)[:120]
        return LandmarkError(f"{problem} (found: {found}); {_NEED}", source=name, where="header")

    twice = sorted({column for column in names if column and names.count(column) > 1})
    if twice:
        raise fail(f"the column {twice[0]!r} occurs twice")
    if "class" not in names:
        raise fail("there is no column 'class'")
    pairs = [pair for pair in _POSITIONS if pair[0] in names and pair[1] in names]
    if not pairs:
        raise fail("there are no columns for the position")
    if len(pairs) > 1:
        raise fail("there is more than one pair of position columns: keep one")
    x, y, crs = pairs[0]
    used = {"class", x, y, *_OPTIONAL}
    return _Header(
        names=names,
        label=names.index("class"),
        x=names.index(x),
        y=names.index(y),
        crs=crs,
        optional={key: names.index(key) for key in _OPTIONAL if key in names},
        unused=tuple(column for column in names if column and column not in used),
    )


def _chunks(reader: Any, line: int, name: str) -> Iterator[tuple[Sequence[Row], NDArray[np.int32]]]:
    """Rows that are not empty, with the line on which each begins; ``line`` lines come before."""
    while True:
        before = reader.line_num
        rows: list[Row] = []
        try:
            rows.extend(islice(reader, _CHUNK))
        except csv.Error as error:
            problem, where = f"this is not valid CSV: {error}", f"line {line + reader.line_num}"
            raise LandmarkError(problem, source=name, where=where) from error
        if not rows:
            return
        start = line + before + 1
        if reader.line_num - before == len(rows):
            lines = np.arange(start, start + len(rows), dtype=np.int32)
        else:
            height = [1 + sum(len(_NEWLINE.findall(text)) for text in row) for row in rows]
            lines = np.cumsum([start, *height[:-1]]).astype(np.int32)
        if [] in rows:
            lines = lines[[bool(row) for row in rows]]
            rows = [row for row in rows if row]
        if rows:
            yield rows, lines


def _add(
    table: _Table, rows: Sequence[Row], lines: NDArray[np.int32], header: _Header, name: str
) -> None:
    """Append one chunk to the table."""
    width = len(header.names)
    try:
        columns = list(zip(*rows, strict=True))
    except ValueError:
        columns = []
    if len(columns) != width:
        bad = next(i for i, row in enumerate(rows) if len(row) != width)
        problem = f"this row has {len(rows[bad])} fields, the header has {width}"
        raise LandmarkError(problem, source=name, where=f"line {lines[bad]}")
    labels = [label.strip() for label in columns[header.label]]
    if not all(labels):
        where = f"line {lines[labels.index('')]}"
        raise LandmarkError("the class is empty", source=name, where=where)
    codes = map(table.codes.__getitem__, labels)
    table.kind.append(np.fromiter(codes, np.int32, len(rows)))
    table.x.append(_floats(columns[header.x], header.names[header.x], lines, name))
    table.y.append(_floats(columns[header.y], header.names[header.y], lines, name))
    if "confidence" in header.optional:
        column = columns[header.optional["confidence"]]
        table.confidence.append(_floats(column, "confidence", lines, name, empty=1.0))
    for key, texts in table.texts.items():
        column = columns[header.optional[key]]
        if key != "id":  # times and agents repeat: one object for each distinct text
            column = tuple(map(table.seen.setdefault, column, column))
        texts.extend([text.strip() or None for text in column])
    table.lines.append(lines)


def _floats(
    column: Sequence[str],
    what: str,
    lines: NDArray[np.int32],
    name: str,
    empty: float | None = None,
) -> Floats:
    """Numbers of a column of text; the line of the first one that is none is found afterwards."""
    if "_" not in "".join(column):  # Python reads 1_0 as 10
        try:
            return np.fromiter(map(float, column), np.float64, len(column))
        except ValueError:
            pass
    numbers = np.empty(len(column))
    for row, text in enumerate(column):
        try:
            if "_" in text:
                raise ValueError
            blank = empty is not None and not text.strip()
            numbers[row] = empty if blank else float(text)
        except ValueError as error:
            hint = ": write decimals with a point" if "," in text else ""
            problem = f"{what} is {text[:60]!r}, not a number{hint}"
            raise LandmarkError(problem, source=name, where=f"line {lines[row]}") from error
    return numbers


def _join(pieces: list[NDArray[Any]], dtype: type[np.generic]) -> NDArray[Any]:
    return np.concatenate(pieces) if pieces else np.empty(0, dtype)
