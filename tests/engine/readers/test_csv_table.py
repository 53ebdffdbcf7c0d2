"""CSV: delimiters, headers, and the exact line of whatever is wrong."""

from __future__ import annotations

import gzip
from collections.abc import Callable
from typing import Any

import pytest

from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.readers import csv_table
from symboslam.errors import LandmarkError

Read = Callable[..., LandmarkMap]
Write = Callable[[str, Any], Any]
Names = Callable[[LandmarkMap], list[str]]


@pytest.fixture
def table(read: Read, write: Write) -> Read:
    """Read text as a CSV file."""
    return lambda text, **options: read(write("map.csv", text), **options)


def test_all_columns(table: Read, names: Names) -> None:
    landmarks = table(
        "id,class,y,x,confidence,agent,time\n"
        "a,House,2,1,0.25,r1,2022-01-31T12:00:00+01:00\n"
        "b, Tree ,4,30,,,\n"
    )
    assert names(landmarks) == ["House", "Tree"]
    assert landmarks.xy.tolist() == [[1, 2], [30, 4]]
    assert landmarks.confidence.tolist() == [0.25, 1]
    assert landmarks.id.tolist() == ["a", "b"]
    assert landmarks.agent is not None
    assert landmarks.agent.tolist() == ["r1", None]
    assert landmarks.time is not None
    assert landmarks.time.tolist() == ["2022-01-31T12:00:00+01:00", None]
    assert landmarks.bbox == (1, 2, 30, 4)
    assert not landmarks.frame.geographic


@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
@pytest.mark.parametrize("mark", ["", "\ufeff"])
def test_dialects(table: Read, names: Names, delimiter: str, newline: str, mark: str) -> None:
    rows = [["Class", " X", "Y"], ["House", "1", "2"], ['"Tree"', "30.5", "4e0"]]
    landmarks = table(mark + newline.join(delimiter.join(row) for row in rows))
    assert names(landmarks) == ["House", "Tree"]
    assert landmarks.xy.tolist() == [[1, 2], [30.5, 4]]


@pytest.mark.parametrize(
    ("first", "second"), [("lon", "lat"), ("Longitude", "LATITUDE"), ("lng", "lat")]
)
def test_degrees_by_name(table: Read, first: str, second: str) -> None:
    landmarks = table(f"class,{second},{first}\nHouse,47,9\nHouse,48,10\n")
    assert landmarks.frame.geographic
    assert landmarks.frame.origin == (9.5, 47.5)


def test_degrees_by_option(table: Read) -> None:
    landmarks = table("class,x,y\nHouse,9,47\nHouse,10,48\n", crs="EPSG:4326")
    assert landmarks.frame.origin == (9.5, 47.5)
    assert landmarks.report.notes == ()
    assert landmarks.report.attribution == ""


def test_unused_columns_are_noted(table: Read) -> None:
    landmarks = table("class,x,y,colour,size\nHouse,1,2,red,5\nHouse,7,9,red,5\n")
    assert landmarks.report.notes == ("columns that were not used: colour, size",)


def test_gzip(read: Read, write: Write) -> None:
    packed = gzip.compress(b"class,x,y\nHouse,1,2\nHouse,5,6\n")
    assert len(read(write("map.csv.gz", packed))) == 2


def test_a_header_alone_is_an_empty_map(table: Read) -> None:
    landmarks = table("class,x,y,confidence,id\n", bbox=(0, 0, 1000, 1000))
    assert len(landmarks) == 0
    assert landmarks.bbox == (0, 0, 1000, 1000)


@pytest.mark.parametrize("chunk", [1, 2, 3, 1000])
def test_pieces_make_no_difference(
    table: Read, monkeypatch: pytest.MonkeyPatch, chunk: int
) -> None:
    monkeypatch.setattr(csv_table, "_CHUNK", chunk)
    rows = "".join(f"{('House', 'Tree')[i % 2]},{i},{i * i},{1 / (i + 1)}\n" for i in range(10))
    landmarks = table("class,x,y,confidence\n" + rows)
    assert landmarks.x.tolist() == list(range(10))
    assert landmarks.y.tolist() == [i * i for i in range(10)]
    assert landmarks.confidence.tolist() == [1 / (i + 1) for i in range(10)]
    assert landmarks.feature.tolist() == [0, 2] * 5


HEAD = "class,x,y,confidence,id\n"
GOOD = "House,1,2,1,\n"


@pytest.mark.parametrize("chunk", [1, 4, 1000])
@pytest.mark.parametrize(
    ("text", "line", "message"),
    [
        (HEAD + GOOD + "House,x,2,1,\n", 3, "x is 'x', not a number"),
        (HEAD + GOOD + "House,1_0,2,1,\n", 3, "x is '1_0', not a number"),
        (HEAD + GOOD + "House,1,2,0_1,\n", 3, "confidence is '0_1', not a number"),
        (HEAD + GOOD + "House,1,,1,\n", 3, "y is '', not a number"),
        (HEAD + GOOD + "House,1,2,?,\n", 3, "confidence is '\\?', not a number"),
        (HEAD + GOOD * 5 + "House,nan,2,1,\n" + GOOD, 7, "not finite"),
        (HEAD + GOOD * 5 + "House,1,inf,1,\n" + GOOD, 7, "not finite"),
        (HEAD + GOOD * 5 + "House,1,2,1.5,\n" + GOOD, 7, "confidence 1.5 is not"),
        (HEAD + GOOD + "House,1,2,nan,\n" + GOOD, 3, "confidence nan is not"),
        (HEAD + GOOD + "House,1,2\n", 3, "3 fields, the header has 5"),
        (HEAD + GOOD + "House,1,2,1,,9\n" + GOOD, 3, "6 fields, the header has 5"),
        (HEAD + "House,1,2\n" * 3, 2, "3 fields, the header has 5"),
        (HEAD + GOOD + ",1,2,1,\n", 3, "class is empty"),
        (HEAD + GOOD + 'House,1,2,1,"a\n', 3, "not valid CSV"),
        (HEAD + "\n" + GOOD + "\n\n" + "House,x,2,1,\n", 6, "x is 'x'"),
        (HEAD + 'House,1,2,1,"a\nb"\n' + GOOD + "House,x,2,1,\n", 5, "x is 'x'"),
        (HEAD + 'House,1,2,1,"a\r\nb\rc"\n' + GOOD + "House,1,2,0,\n", 6, "confidence 0.0"),
        ("\n\n" + HEAD + GOOD + "House,x,2,1,\n", 5, "x is 'x'"),
        (HEAD + "House,1,2,1,a\n" + GOOD + "House,1,3,1,a\n", 4, r"different .*\(line 2\)"),
    ],
)
def test_bad_rows_are_named_by_their_line(
    table: Read, monkeypatch: pytest.MonkeyPatch, chunk: int, text: str, line: int, message: str
) -> None:
    monkeypatch.setattr(csv_table, "_CHUNK", chunk)
    with pytest.raises(LandmarkError, match=message) as caught:
        table(text)
    assert caught.value.where == f"line {line}"


def test_a_decimal_comma_is_recognised(table: Read) -> None:
    with pytest.raises(
        LandmarkError, match="line 2: x is '1,5', not a number: write decimals with"
    ):
        table("class;x;y\nHouse;1,5;2\n")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "is empty"),
        ("\n \n", "is empty"),
        ("x,y\n1,2\n", "no column 'class' .found: x, y.*class,x,y"),
        ("House,1,2\nTree,3,4\n", "header: there is no column 'class'"),
        ("class,x\nHouse,1\n", "no columns for the position"),
        ("class,x,y,lon,lat\nHouse,1,2,3,4\n", "more than one pair"),
        ("class,x,y,X\nHouse,1,2,3\n", "'x' occurs twice"),
    ],
)
def test_bad_headers(table: Read, text: str, message: str) -> None:
    with pytest.raises(LandmarkError, match=message):
        table(text)


def test_text_in_another_encoding(read: Read, write: Write) -> None:
    with pytest.raises(LandmarkError, match="not UTF-8"):
        read(write("map.csv", "class,x,y\nHäuschen,1,2\n".encode("latin-1")))


def test_degrees_named_x_and_y_are_suspected(table: Read) -> None:
    (note,) = table("class,x,y\nHouse,9.50,47.10\nTree,9.51,47.11\n").report.notes
    assert "are the coordinates degrees?" in note


def test_progress_grows_to_one(table: Read, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(csv_table, "_CHUNK", 500)
    seen: list[tuple[str, float]] = []
    table(HEAD + GOOD * 5000, progress=lambda stage, share: seen.append((stage, share)))
    reading = [share for stage, share in seen if stage == "reading"]
    assert reading == sorted(reading)
    assert (reading[0], reading[-1], len(reading)) == (0, 1, 12)
    assert seen[-1] == ("placing", 1)
