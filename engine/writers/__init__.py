"""Writers: environment maps as GeoJSON, RDF, picture or page; each file whole or not at all."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib import import_module
from pathlib import Path
from typing import BinaryIO, Literal

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.writers.atomic import atomic_file, check_writable
from symboslam.engine.writers.options import Progress, WriteOptions, reasons_wanted
from symboslam.errors import OutputError

__all__ = ["FORMATS", "Format", "WriteOptions", "check_targets", "format_of", "write_map"]

Write = Callable[[EnvironmentMap, BinaryIO, WriteOptions], None]


@dataclass(frozen=True)
class Format:
    """A file format for maps.

    Attributes:
        extensions: endings of file names that ask for it.
        module: where its function is; imported when it is first needed.
        function: the function that writes it.
    """

    extensions: tuple[str, ...]
    module: str
    function: str = "write"

    def load(self) -> Write:
        """The function that writes it."""
        write: Write = getattr(import_module(self.module), self.function)
        return write


FORMATS: dict[str, Format] = {
    "geojson": Format((".geojson", ".json"), f"{__name__}.geojson"),
    "ttl": Format((".ttl",), f"{__name__}.rdf", "write_turtle"),
    "nq": Format((".nq",), f"{__name__}.rdf", "write_nquads"),
    "png": Format((".png",), f"{__name__}.png"),
    "html": Format((".html", ".htm"), f"{__name__}.html"),
}
"""All formats by name; a new one needs an entry here and a module with ``write``."""


def format_of(target: str | Path, format: str | None = None) -> str:
    """Name of the format that a target is to be written in.

    Args:
        target: a file, or ``-`` for the standard output, which is GeoJSON if nothing is said.
        format: a name in ``FORMATS``, which then counts more than the target's ending.

    Raises:
        OutputError: no such format, or an ending that stands for none.
    """
    if format is not None:
        if format not in FORMATS:
            raise OutputError(f"no format {format!r}; there are: {', '.join(FORMATS)}")
        return format
    if str(target) == "-":
        return "geojson"
    suffix = Path(target).suffix.lower()
    for name, known in FORMATS.items():
        if suffix in known.extensions:
            return name
    endings = ", ".join(e for known in FORMATS.values() for e in known.extensions)
    raise OutputError(f"{target}: no format has the ending {suffix!r}; use one of {endings}")


def check_targets(
    targets: Iterable[str | Path],
    inputs: Iterable[str | Path] = (),
    known: Callable[[str | Path], object] = format_of,
) -> None:
    """Refuse targets that cannot be written, before any work is done for them.

    Args:
        targets: the files to write.
        inputs: files that are read, which no target may replace.
        known: raises an OutputError for a target whose format is not known.

    Raises:
        OutputError: a target without a known format, one that is named twice, or one whose
            folder does not exist or may not be written to, or that is an input.
    """
    read = {os.path.realpath(name) for name in inputs if str(name) != "-"}
    seen = set()
    for target in targets:
        known(target)
        place = str(target) if str(target) == "-" else os.path.realpath(target)
        if place in seen:
            raise OutputError(f"{target} is named twice; each output needs its own file")
        if place in read:
            raise OutputError(f"{target} is an input; writing there would replace it")
        seen.add(place)
        if place != "-":
            check_writable(target)


def write_map(
    environment_map: EnvironmentMap,
    target: str | Path,
    *,
    format: str | None = None,
    reasons: int | None = None,
    progress: Progress | None = None,
    base: str | None = None,
    ended: datetime | Literal["now"] | None = "now",
) -> None:
    """Write a map to a file, whole or not at all.

    Args:
        environment_map: the map.
        target: the file; its ending tells the format. ``-`` is the standard output.
        format: a name in ``FORMATS``, whatever the ending is.
        reasons: how many reasons each segment lists, the strongest first; 0 = none; None = 8, or
            none where there are more than 20,000 segments.
        progress: called with a stage and the share of it that is done.
        base: RDF: IRI below which the map's own IRIs lie; None derives one from the content.
        ended: RDF: when the classification ended, with time zone; None leaves it out, so that equal
            maps give equal files.

    Raises:
        OutputError: unknown format, or the file cannot be written; an old file is then kept.
        InputError: ``reasons`` or ``base`` is no possible value.
    """
    write = FORMATS[format_of(target, format)].load()
    moment = datetime.now(UTC).replace(microsecond=0) if ended == "now" else ended
    wanted = reasons_wanted(reasons, len(environment_map))
    options = WriteOptions(wanted, progress, base, moment)
    if str(target) != "-":
        with atomic_file(target) as stream:
            write(environment_map, stream, options)
        return
    try:
        write(environment_map, sys.stdout.buffer, options)
        sys.stdout.buffer.flush()
    except OSError as error:
        raise OutputError(f"standard output: {error.strerror or error}") from error
