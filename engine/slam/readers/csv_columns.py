"""Columns of CSV logs: found by their names and usual other names, read as numbers and texts."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.log import Floats, Ints
from symboslam.engine.slam.readers.text import count, read_bytes
from symboslam.errors import InputError

Names = Mapping[str, tuple[str, ...]]
"""Column -> what it may be called besides, in lower case."""


@dataclass(frozen=True)
class Columns:
    """The known columns of a file.

    Attributes:
        path: the file.
        line: (n,) where each row begins.
        text: column -> n cells without blanks around them.
    """

    path: Path
    line: Ints
    text: dict[str, list[str]]

    def __len__(self) -> int:
        return len(self.line)

    def __contains__(self, name: str) -> bool:
        return name in self.text

    def floats(self, name: str, empty: float = float("nan")) -> Floats:
        """(n,) numbers of a column; empty cells, and all if there is no such column, are `empty`.

        Raises:
            InputError: a cell holds something else; names file, line and column.
        """
        if name not in self.text:
            return np.full(len(self), empty)
        found = np.empty(len(self))
        for i, cell in enumerate(self.text[name]):
            try:
                if "_" in cell:  # Python reads 1_0 as 10
                    raise ValueError
                found[i] = float(cell) if cell else empty
            except ValueError:
                raise self.wrong(i, name, "not a number") from None
        return found

    def times(self, notes: list[str]) -> Floats:
        """(n,) seconds; ISO 8601 becomes seconds since 1970, without a zone in UTC.

        Raises:
            InputError: a cell is neither.
        """
        found = np.empty(len(self))
        naive = 0
        for i, cell in enumerate(self.text["time"]):
            try:
                found[i] = float(cell) if cell else np.nan
            except ValueError:
                try:
                    moment = datetime.fromisoformat(cell)
                except ValueError:
                    raise self.wrong(i, "time", "neither seconds nor ISO 8601") from None
                naive += moment.tzinfo is None
                found[i] = (moment if moment.tzinfo else moment.replace(tzinfo=UTC)).timestamp()
        if naive:
            notes.append(f"{self.path.name}: {count(naive, 'time')} without a zone read as UTC")
        return found

    def texts(self, name: str) -> NDArray[np.object_]:
        """(n,) texts of a column; "" where there is no such column."""
        return np.array(self.text.get(name, [""] * len(self)), object)

    def take(self, index: Ints | NDArray[np.bool_]) -> Columns:
        """Some rows."""
        rows = np.arange(len(self))[index].tolist()
        text = {name: [cells[i] for i in rows] for name, cells in self.text.items()}
        return Columns(self.path, self.line[index], text)

    def where(self, row: int) -> str:
        """File and line of a row, in words."""
        return f"{self.path}: line {self.line[row]}"

    def wrong(self, row: int, name: str, problem: str) -> InputError:
        """The error for a cell."""
        return InputError(f"{self.where(row)}: {name} is {self.text[name][row][:60]!r}, {problem}")


def read_columns(path: Path, names: Names, notes: list[str]) -> Columns:
    """Read a CSV file with a header, separated by comma, semicolon or tab.

    Empty rows and exactly repeated ones are left out, the latter noted, as are unused columns.

    Raises:
        InputError: the file cannot be read, is empty or is no UTF-8, a column is there twice, or a
            row is longer or shorter than the header; names file and line.
    """
    text = _decode(path, notes)
    delimiter = max(",;\t", key=text.lstrip().partition("\n")[0].count)
    rows = _rows(path, text, delimiter)
    try:
        line, header = next(rows)
    except StopIteration:
        raise InputError(f"{path}: the file is empty") from None
    at = _places(path, [cell.strip().lower() for cell in header], names, notes)
    cells: dict[str, list[str]] = {name: [] for name in at}
    lines, seen, repeated = [], set(), 0
    for line, row in rows:
        if not any(row):
            continue
        if len(row) != len(header):
            raise InputError(
                f"{path}: line {line}: this row has {len(row)} cells, the header {len(header)}"
            )
        if tuple(row) in seen:
            repeated += 1
            continue
        seen.add(tuple(row))
        lines.append(line)
        for name, place in at.items():
            cells[name].append(row[place].strip())
    if repeated:
        notes.append(f"{path.name}: {count(repeated, 'repeated row')} left out")
    return Columns(path, np.array(lines, np.int64), cells)


def _decode(path: Path, notes: list[str]) -> str:
    data = read_bytes(path)
    nul = data.count(0)
    if nul:
        notes.append(f"{path.name}: {count(nul, 'NUL byte')} left out")
        data = data.replace(b"\x00", b"")
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise InputError(
            f"{path}: line {line}: this is not UTF-8 text; save the file as UTF-8"
        ) from error


def _rows(path: Path, text: str, delimiter: str) -> Iterator[tuple[int, list[str]]]:
    """Rows with the line on which each begins."""
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter, strict=True)
    while True:
        line = reader.line_num + 1
        try:
            row = next(reader)
        except StopIteration:
            return
        except csv.Error as error:
            raise InputError(f"{path}: line {line}: this is not valid CSV: {error}") from error
        if row and not row[0].lstrip().startswith("#"):
            yield line, row


def _places(path: Path, header: list[str], names: Names, notes: list[str]) -> dict[str, int]:
    """Column -> its place."""
    found: dict[str, int] = {}
    unused = []
    for place, title in enumerate(header):
        name = next((n for n, others in names.items() if title == n or title in others), None)
        if name is None:
            unused.append(title)
        elif name in found:
            raise InputError(f"{path}: header: two columns are for the {name}: keep one")
        else:
            found[name] = place
    if "time" in names and "time" not in found:
        raise InputError(f"{path}: header: there is no column 'time' (found: {', '.join(header)})")
    if any(unused):
        notes.append(f"{path.name}: columns that were not used: {', '.join(filter(None, unused))}")
    return found
