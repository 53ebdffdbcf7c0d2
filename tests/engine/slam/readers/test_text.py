"""Text files of numbers, and rows in order of time."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from symboslam.engine.slam.readers.rows import in_order, one_a_time, without_repeats
from symboslam.engine.slam.readers.text import lines_of, read_table
from symboslam.errors import InputError

Write = Callable[..., Path]


def table(path: Path, notes: list[str] | None = None) -> list[list[float]]:
    found: list[list[float]] = read_table(
        path, ("a", "b"), [] if notes is None else notes
    ).values.tolist()
    return found


@pytest.mark.parametrize("name", ["t.dat", "t.dat.gz"])
def test_comments_blanks_and_line_ends(write: Write, name: str) -> None:
    path = write(name, b"\xef\xbb\xbf# a b\r\n 1 \t 2 \r\n\r\n3 4e-1\r\n")
    assert table(path) == [[1, 2], [3, 0.4]]
    assert [line.number for line in lines_of(path)] == [2, 4]


def test_nul_bytes_are_taken_out(write: Write) -> None:
    notes: list[str] = []
    path = write("t.dat", b"1 2\n\x00\x00\x00\n3 \x004\n5\x00 6 7\n8 9\n")
    assert table(path, notes) == [[1, 2], [3, 4], [8, 9]]
    assert notes == ["t.dat: 1 damaged or cut row left out, the first in line 4"]


def test_a_cut_last_row_is_left_out(write: Write) -> None:
    notes: list[str] = []
    assert table(write("t.dat", "1 2\n3 4\n5"), notes) == [[1, 2], [3, 4]]
    assert notes == ["t.dat: 1 damaged or cut row left out, the first in line 3"]


def test_nan_is_left_out_and_told(write: Write) -> None:
    notes: list[str] = []
    assert table(write("t.dat", "1 2\nnan 4\n5 inf\n7 8\n"), notes) == [[1, 2], [7, 8]]
    assert notes == ["t.dat: 2 rows with NaN or infinity left out, the first in line 2"]


@pytest.mark.parametrize(
    ("content", "problem"),
    [
        (b"", "the file is empty"),
        (b" \n\x00\x00", "the file is empty"),
        (b"# c\n1 2\n3\n4 5\n", "line 3: this row has 1 columns, 2 are needed: a, b"),
        (b"1 2\n1 2 3\n1 2\n", "line 2: this row has 3 columns"),
        (b"1 2\n3 x\n4 5\n", "line 2: b is 'x', not a number"),
        (b"1 2\n3 1_0\n4 5\n", "line 2: b is '1_0', not a number"),
        (b"1 2\n3 \xe9\n4 5\n", "line 2: b is '\ufffd', not a number"),
        (b"\x1f\x8b\x08 cut", "damaged or cut short"),
    ],
)
def test_what_is_refused(write: Write, content: bytes, problem: str) -> None:
    path = write("t.dat", content)
    with pytest.raises(InputError, match=r"t\.dat: ") as error:
        table(path)
    assert problem in str(error.value)


def test_missing_files_and_folders(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="no such file"):
        table(tmp_path / "none.dat")
    with pytest.raises(InputError, match="this is a folder"):
        table(tmp_path)


def test_rows_are_sorted_and_that_is_told() -> None:
    notes: list[str] = []
    assert in_order(np.array([1.0, 2, 2, 3]), "f", notes).tolist() == [0, 1, 2, 3]
    assert notes == []
    assert in_order(np.array([1.0, 3, 2.5, 4, 0]), "f", notes).tolist() == [4, 0, 2, 1, 3]
    assert notes == ["f: time goes back at 2 rows, by up to 4 s; rows were sorted by time"]


def test_repeats_and_contradictions() -> None:
    notes: list[str] = []
    rows = np.array([[1, 3], [1, 2], [1, 3], [1, 2.0]])
    assert without_repeats(rows, "f", notes).tolist() == [0, 1]
    assert one_a_time(np.array([1.0, 1, 2]), "f", notes).tolist() == [1, 2]
    assert one_a_time(np.zeros(0), "f", notes).tolist() == []
    assert notes == [
        "f: 2 repeated rows left out",
        "f: 1 row left out that another row of the same time contradicts; the last one counts",
    ]
