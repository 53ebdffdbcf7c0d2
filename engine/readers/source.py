"""Where landmarks come from: a file, a pipe or an open stream, packed with gzip or not."""

from __future__ import annotations

import gzip
import io
import sys
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any, BinaryIO, cast

from symboslam.errors import InputError, LandmarkError

_GZIP = b"\x1f\x8b"


@dataclass(frozen=True)
class Source:
    """Something to read from, as often as needed.

    Attributes:
        name: what messages call it.
        path: the file, or None where ``data`` is the whole content.
        data: the content of a stream.
    """

    name: str
    path: Path | None = None
    data: bytes = b""

    @property
    def size(self) -> int:
        """Bytes as stored."""
        return len(self.data) if self.path is None else self.path.stat().st_size

    def head(self, length: int = 4096) -> bytes:
        """The first bytes as stored."""
        with self.guard(), self._stored() as stream:
            return stream.read(length)

    @contextmanager
    def open(self) -> Iterator[tuple[BinaryIO, BinaryIO]]:
        """The unpacked content, and the stored stream below it, whose position shows progress.

        Raises:
            LandmarkError: it cannot be read or unpacked.
        """
        packed = self.head(2) == _GZIP
        with self.guard(), self._stored() as stored:
            if packed:
                with gzip.open(stored) as unpacked:
                    yield cast(BinaryIO, unpacked), stored
            else:
                yield stored, stored

    def read(self) -> bytes:
        """The whole unpacked content.

        Raises:
            LandmarkError: it cannot be read or unpacked.
        """
        with self.open() as (stream, _):
            return stream.read()

    @contextmanager
    def guard(self) -> Iterator[None]:
        """Turns what can go wrong while reading into a LandmarkError that names the source."""
        try:
            yield
        except (EOFError, zlib.error, gzip.BadGzipFile) as error:
            problem = f"the compressed file is damaged or cut short ({error})"
            raise LandmarkError(problem, source=self.name) from error
        except OSError as error:
            problem = f"cannot be read: {error.strerror or error}"
            raise LandmarkError(problem, source=self.name) from error

    def _stored(self) -> BinaryIO:
        return io.BytesIO(self.data) if self.path is None else self.path.open("rb")


def open_source(source: str | Path | IO[Any]) -> Source:
    """The source that a path, an open stream or ``-`` (standard input) stands for.

    Raises:
        LandmarkError: no such file, or it is a folder.
        InputError: this is none of these.
    """
    if not isinstance(source, str | Path):
        if not callable(getattr(source, "read", None)):
            raise InputError(
                f"landmarks cannot be read from a {type(source).__name__}: give a path, an open "
                "stream or a GeoJSON document as a dict"
            )
        return _drain(source, str(getattr(source, "name", "") or "stream"))
    if source == "-":
        if sys.stdin is None:
            raise InputError("there is no standard input: name a landmark file")
        return _drain(getattr(sys.stdin, "buffer", sys.stdin), "standard input")
    path = Path(source)
    if path.is_file():
        return Source(str(path), path)
    if path.is_dir():
        raise LandmarkError("this is a folder: name a landmark file", source=str(path))
    if not path.exists():
        raise LandmarkError("no such file", source=str(path))
    with Source(str(path)).guard(), path.open("rb") as pipe:
        return _drain(pipe, str(path))


def _drain(stream: IO[Any], name: str) -> Source:
    with Source(name).guard():
        data = stream.read()
    if isinstance(data, str):
        data = data.encode(errors="replace")
    if not isinstance(data, bytes):
        raise InputError(f"{name}: its read() gives a {type(data).__name__}, not bytes or text")
    return Source(name, data=data)


def sniff(head: bytes) -> str:
    """The format that content starting with these bytes has: ``geojson``, ``osm`` or ``csv``."""
    if head[:2] == _GZIP:
        try:
            head = zlib.decompressobj(31).decompress(head, 4096)
        except zlib.error:
            return "csv"
    if head[:3] == b"BZh" or b"OSMHeader" in head[:32]:
        return "osm"
    first = head.removeprefix(b"\xef\xbb\xbf").lstrip()[:1]
    return {b"<": "osm", b"{": "geojson", b"[": "geojson"}.get(first, "csv")
