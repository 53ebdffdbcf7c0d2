"""Files, pipes, streams and formats."""

from __future__ import annotations

import gzip
import io
import json
import os
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.readers import FORMATS
from symboslam.engine.readers.source import sniff
from symboslam.errors import InputError, LandmarkError

Read = Callable[..., LandmarkMap]
Write = Callable[[str, Any], Any]

CSV = b"class,x,y\nHouse,1,2\nTree,5,6\n"
GEOJSON = json.dumps(
    {
        "type": "FeatureCollection",
        "crs_units": "m",
        "features": [
            {
                "type": "Feature",
                "geometry": {"type": "Point", "coordinates": [x, y]},
                "properties": {"class": name},
            }
            for name, x, y in (("House", 1, 2), ("Tree", 5, 6))
        ],
    }
).encode()


@pytest.mark.parametrize("name", ["a.csv", "A.CSV", "a.b.csv"])
def test_the_name_tells_the_format(read: Read, write: Write, name: str) -> None:
    path = write(name, CSV)
    assert read(path).report.source == str(path)
    assert len(read(str(path))) == 2


@pytest.mark.parametrize("name", ["a.geojson", "a.json"])
def test_both_names_of_geojson(read: Read, write: Write, name: str) -> None:
    assert len(read(write(name, GEOJSON))) == 2


def test_the_format_can_be_given(read: Read, write: Write) -> None:
    assert len(read(write("landmarks.txt", CSV), format="csv")) == 2


def test_an_unknown_name_is_refused(read: Read, write: Write) -> None:
    with pytest.raises(LandmarkError, match=r"ends in none of .*\.geojson.*\.osm\.pbf"):
        read(write("landmarks.shp", CSV))


def test_an_unknown_format_is_refused(read: Read, write: Write) -> None:
    with pytest.raises(InputError, match="no format 'shp': choose one of geojson, csv, osm"):
        read(write("landmarks.shp", CSV), format="shp")


def test_no_such_file(read: Read, tmp_path: Path) -> None:
    with pytest.raises(LandmarkError, match=r"nothing\.csv: no such file"):
        read(tmp_path / "nothing.csv")


def test_a_folder(read: Read, tmp_path: Path) -> None:
    with pytest.raises(LandmarkError, match="this is a folder"):
        read(tmp_path)


def test_a_file_that_cannot_be_read(
    read: Read, write: Write, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write("a.csv", CSV)

    def refuse(*_: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "open", refuse)
    with pytest.raises(LandmarkError, match=r"a\.csv: cannot be read: Permission denied"):
        read(path)


@pytest.mark.parametrize(
    "content", [CSV, GEOJSON, gzip.compress(CSV, mtime=0), gzip.compress(GEOJSON, mtime=0)]
)
@pytest.mark.parametrize("way", ["stream", "stdin"])
def test_streams_are_sniffed(
    read: Read, monkeypatch: pytest.MonkeyPatch, content: bytes, way: str
) -> None:
    if way == "stdin":
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(content)))
        landmarks = read("-")
        assert landmarks.report.source == "standard input"
    else:
        stream = io.BytesIO(content)
        landmarks = read(stream)
        assert not stream.closed
    assert landmarks.xy.tolist() == [[1, 2], [5, 6]]


@pytest.mark.parametrize("content", [CSV, GEOJSON])
def test_text_streams(read: Read, monkeypatch: pytest.MonkeyPatch, content: bytes) -> None:
    assert len(read(io.StringIO(content.decode()))) == 2
    monkeypatch.setattr(sys, "stdin", io.StringIO(content.decode()))
    assert len(read("-")) == 2


def test_a_stream_with_a_telling_name(read: Read, write: Write) -> None:
    with write("a.csv", CSV).open("rb") as stream:
        assert len(read(stream)) == 2


def test_a_pipe_in_the_file_system(read: Read, tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    writer = threading.Thread(target=pipe.write_bytes, args=(CSV,))
    writer.start()
    assert len(read(pipe)) == 2
    writer.join()


@pytest.mark.parametrize("source", [None, 3, b"class,x,y", ["a.csv"]])
def test_no_source_at_all(read: Read, source: Any) -> None:
    kind = type(source).__name__
    with pytest.raises(InputError, match=f"cannot be read from a {kind}: give a path, an open"):
        read(source)


def test_no_standard_input(read: Read, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdin", None)
    with pytest.raises(InputError, match="there is no standard input"):
        read("-")


def test_a_stream_of_something_else(read: Read) -> None:
    class Odd:
        def read(self) -> None:
            """Nothing is there yet: what a stream that does not block says."""

    with pytest.raises(
        InputError, match=r"stream: its read\(\) gives a NoneType, not bytes or text"
    ):
        read(Odd())


def test_an_empty_stream(read: Read) -> None:
    with pytest.raises(LandmarkError, match="stream: the file is empty"):
        read(io.BytesIO())


@pytest.mark.parametrize("content", [CSV, GEOJSON])
def test_a_cut_gzip_file(read: Read, write: Write, content: bytes) -> None:
    packed = gzip.compress(content, mtime=0)
    suffix = "csv" if content is CSV else "geojson"
    for damaged in (packed[:-10], packed[:10] + b"\xff" + packed[11:]):
        with pytest.raises(LandmarkError, match="damaged or cut short"):
            read(write(f"a.{suffix}.gz", damaged))


@pytest.mark.parametrize(
    ("head", "name"),
    [
        (b"", "csv"),
        (b"\xef\xbb\xbf\n {", "geojson"),
        (b"[", "geojson"),
        (b"<?xml", "osm"),
        (b"\0\0\0\r\n\tOSMHeader", "osm"),
        (b"BZh91AY", "osm"),
        (gzip.compress(b"<osm/>", mtime=0), "osm"),
        (b"\x1f\x8bnonsense", "csv"),
        (b"class,x,y", "csv"),
    ],
)
def test_sniffing(head: bytes, name: str) -> None:
    assert sniff(head) == name


def test_suffixes_are_distinct() -> None:
    suffixes = [suffix for entry in FORMATS.values() for suffix in entry.suffixes]
    assert len(suffixes) == len(set(suffixes)) == 10
    assert all(suffix == suffix.lower() and suffix.startswith(".") for suffix in suffixes)
