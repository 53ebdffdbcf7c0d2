"""Text files of numbers: unpacked, cleaned of NUL bytes, split into words, with their lines."""

from __future__ import annotations

import io
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from symboslam.engine.readers.source import Source
from symboslam.engine.slam.log import Floats, Ints
from symboslam.errors import InputError

_NUL = b"\x00"


def find_file(folder: Path, *names: str) -> Path | None:
    """The first of the files, plain or with ``.gz`` behind its name, that is in the folder."""
    for name in names:
        for path in (folder / name, folder / f"{name}.gz"):
            if path.is_file():
                return path
    return None


def read_bytes(path: Path) -> bytes:
    """The unpacked content of a file.

    Raises:
        InputError: no such file, it cannot be read or unpacked, or it is empty.
    """
    if path.is_dir():
        raise InputError(f"{path}: this is a folder, a file is needed")
    if not path.exists():
        raise InputError(f"{path}: no such file")
    data = Source(str(path), path).read()
    if not data.strip(b"\x00 \t\r\n"):
        raise InputError(f"{path}: the file is empty")
    return data


@dataclass(frozen=True)
class Line:
    """A line that says something.

    Attributes:
        number: counted from 1.
        words: what blanks separate.
        damaged: it held NUL bytes, which were taken out.
        last: nothing comes behind it, not even the end of the line: the file may be cut short.
    """

    number: int
    words: list[str]
    damaged: bool = False
    last: bool = False


def lines_of(path: Path) -> Iterator[Line]:
    """The lines of a text file but for empty ones and comments (``#``).

    Bytes that are no UTF-8 become U+FFFD, which is no number, so that their line is told.

    Raises:
        InputError: see `read_bytes`.
    """
    data = read_bytes(path).removeprefix(b"\xef\xbb\xbf")
    whole = data.endswith((b"\n", b"\r", _NUL))
    rows = data.split(b"\n") if b"\n" in data else data.split(b"\r")
    for number, row in enumerate(rows, 1):
        damaged = _NUL in row
        if damaged:
            row = row.replace(_NUL, b"")
        words = row.decode("utf-8", "replace").split()
        if words and not words[0].startswith("#"):
            yield Line(number, words, damaged, not whole and number == len(rows))


def number(word: str, what: str, path: Path, line: int) -> float:
    """A finite number.

    Raises:
        InputError: it is none; names file and line.
    """
    try:
        if "_" in word:  # Python reads 1_0 as 10
            raise ValueError
        found = float(word)
    except ValueError:
        raise InputError(f"{path}: line {line}: {what} is {word[:60]!r}, not a number") from None
    if not math.isfinite(found):
        raise InputError(f"{path}: line {line}: {what} is {word[:60]}, not a finite number")
    return found


@dataclass(frozen=True)
class Table:
    """Rows of numbers.

    Attributes:
        values: (n, columns) all finite.
        line: (n,) where each row stands in the file.
    """

    values: Floats
    line: Ints

    def __len__(self) -> int:
        return len(self.values)


def read_table(path: Path, columns: Sequence[str], notes: list[str]) -> Table:
    """A table of numbers that blanks separate.

    Rows with NaN or infinity, rows that NUL bytes made unreadable, and a last row that is cut
    short are left out and noted.

    Args:
        path: the file.
        columns: their names, for messages.
        notes: what was mended is added here.

    Raises:
        InputError: the file cannot be read or is empty, or a row has too many or too few
            columns, or holds what is no number; names file and line.
    """
    found = _plain(path, len(columns))
    values, numbers = _mended(path, columns, notes) if found is None else found
    finite = np.isfinite(values).all(1)
    if not finite.all():
        lost = numbers[~finite]
        notes.append(f"{path.name}: {count(lost, 'row')} with NaN or infinity left out, the first "
                     f"in line {lost[0]}")  # fmt: skip
    return Table(values[finite], numbers[finite])


def _plain(path: Path, columns: int) -> tuple[Floats, Ints] | None:
    """Values and lines of a file in which nothing is wrong, fast; None if something is."""
    data = read_bytes(path).removeprefix(b"\xef\xbb\xbf")
    if _NUL in data or data[-1:] != b"\n":
        return None
    lines = enumerate(map(bytes.strip, data.split(b"\n")), 1)
    rows = [number for number, row in lines if row and row[:1] != b"#"]
    if not rows:
        return None
    try:
        values = np.loadtxt(io.BytesIO(data), ndmin=2)
    except ValueError:
        return None
    if values.shape != (len(rows), columns):
        return None
    return values, np.array(rows, np.int64)


def _mended(path: Path, columns: Sequence[str], notes: list[str]) -> tuple[Floats, Ints]:
    """Values and lines of a file, row by row; see `read_table`."""
    rows: list[list[str]] = []
    at: list[int] = []
    broken = []
    for line in lines_of(path):
        if line.damaged or line.last or len(line.words) != len(columns):
            try:
                _check(line, columns, path)
            except InputError:
                if not (line.damaged or line.last):
                    raise
                broken.append(line.number)
                continue
        rows.append(line.words)
        at.append(line.number)
    if broken:
        notes.append(
            f"{path.name}: {count(broken, 'damaged or cut row')} left out, "
            f"the first in line {broken[0]}"
        )
    return _floats(rows, at, columns, path), np.array(at, np.int64)


def count(things: Sequence[object] | Ints | int, name: str) -> str:
    """How many there are, in words.

    >>> count(1, "row"), count([3, 4], "row")
    ('1 row', '2 rows')
    """
    n = things if isinstance(things, int) else len(things)
    return f"{n} {name}" + ("" if n == 1 else "s")


def _check(line: Line, columns: Sequence[str], path: Path) -> None:
    if len(line.words) != len(columns):
        raise InputError(
            f"{path}: line {line.number}: this row has {len(line.words)} columns, "
            f"{len(columns)} are needed: {', '.join(columns)}"
        )
    for word, name in zip(line.words, columns, strict=True):
        if word.lower().lstrip("+-") not in ("nan", "inf", "infinity"):
            number(word, name, path, line.number)


def _floats(rows: list[list[str]], at: list[int], columns: Sequence[str], path: Path) -> Floats:
    try:
        if any("_" in word for words in rows for word in words):  # NumPy reads 1_0 as 10
            raise ValueError
        return np.array(rows, np.float64).reshape(-1, len(columns))
    except ValueError:
        for words, line in zip(rows, at, strict=True):
            _check(Line(line, words), columns, path)
        raise
