"""Readers: logs of robots in several formats -> Mission, with notes on what was mended.

A further format is one more module with a ``read`` function and one more line in ``FORMATS``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

from symboslam.engine.slam.log import Mission
from symboslam.engine.slam.readers.text import find_file, lines_of
from symboslam.engine.slam.slam_map import SlamMap
from symboslam.errors import InputError

__all__ = ["FORMATS", "Format", "format_of", "read_estimate", "read_mission"]

AnyPath = str | Path


@dataclass(frozen=True)
class Format:
    """A format of logs.

    Attributes:
        module: where its ``read`` is: path and options -> mission and notes; imported when needed.
        options: names of what ``read`` can be told.
        suffixes: ends of file names that tell the format, without ``.gz``.
        tags: first words of a line that tell it.
        folder: files in a folder that tell it.
        estimates: it can hold the result of an optimisation: ``read_estimate`` of the module.
        several: it can be read from several files at once.
    """

    module: str
    options: tuple[str, ...] = ()
    suffixes: tuple[str, ...] = ()
    tags: tuple[str, ...] = ()
    folder: tuple[str, ...] = ()
    estimates: bool = False
    several: bool = False

    def load(self, function: str = "read") -> Callable[..., Any]:
        """A function of its module."""
        found: Callable[..., Any] = getattr(import_module(self.module), function)
        return found


FORMATS: Mapping[str, Format] = {
    "mrclam": Format(f"{__name__}.mrclam", ("classes", "start"), folder=("Barcodes.dat",)),
    "csv": Format(
        f"{__name__}.csv_log", ("knowledge",), (".csv",), folder=("odometry.csv",), several=True
    ),
    "g2o": Format(
        f"{__name__}.g2o",
        ("identities",),
        (".g2o",),
        ("VERTEX_SE2", "EDGE_SE2", "VERTEX_XY", "VERTEX_SE3:QUAT", "EDGE_SE3:QUAT", "FIX",
         "PARAMS_SE2OFFSET", "PARAMS_SE3OFFSET", "EDGE_SE2_XY", "EDGE_BEARING_SE2_XY"),
        estimates=True,
    ),
    "gtsam": Format(
        f"{__name__}.gtsam_text",
        ("identities",),
        (".graph",),
        ("VERTEX2", "VERTEX", "EDGE2", "EDGE", "ODOMETRY", "LANDMARK", "BR"),
        estimates=True,
    ),
    "tum": Format(f"{__name__}.tum", (), (".tum",)),
    "ndjson": Format(f"{__name__}.ndjson", ("knowledge",), (".ndjson", ".jsonl"), several=True),
}  # fmt: skip
"""All formats by name."""


def read_mission(
    path: AnyPath | Sequence[AnyPath], format: str | None = None, **options: Any
) -> tuple[Mission, list[str]]:
    """Read the logs of one or several robots.

    Args:
        path: a file or a folder; of CSV and NDJSON also several files.
        format: a name in ``FORMATS``; default by name and content.
        options: what the format can be told, see ``Format.options`` and its module's ``read``.

    Returns:
        The mission, and one sentence for each thing that was mended or left out.

    Raises:
        InputError: the files are wrong; names file and line. Or no such format or option.
    """
    name = format_of(path, format)
    chosen = FORMATS[name]
    given = {key: value for key, value in options.items() if value is not None}
    for key in given:
        if key not in chosen.options:
            able = ", ".join(n for n, each in FORMATS.items() if key in each.options) or "no format"
            raise InputError(f"the format {name} has no option {key!r}, only: {able}")
    if not chosen.several and not isinstance(path, str | Path):
        raise InputError(f"the format {name} is read from one file or folder")
    mission, notes = chosen.load()(_paths(path), **given)
    return mission, notes


def read_estimate(
    path: AnyPath | Sequence[AnyPath], mission: Mission, format: str | None = None
) -> SlamMap | None:
    """The estimate that a file holds beside the measurements (``VERTEX_SE2``), if it holds one.

    Args:
        path: as for `read_mission`.
        mission: what that has read from it.
        format: likewise.

    Raises:
        InputError: the file is wrong, or no such format.
    """
    chosen = FORMATS[format_of(path, format)]
    if not chosen.estimates:
        return None
    found: SlamMap | None = chosen.load("read_estimate")(_paths(path), mission)
    return found


def format_of(path: AnyPath | Sequence[AnyPath], format: str | None = None) -> str:
    """Name of the format of a file or folder.

    Raises:
        InputError: no such format, no such file, or nothing tells the format.
    """
    if format is not None:
        if format not in FORMATS:
            raise InputError(f"there is no format {format!r}: choose one of {', '.join(FORMATS)}")
        return format
    if not isinstance(path, str | Path):
        logs = all(_plain(Path(each)).endswith(FORMATS["ndjson"].suffixes) for each in path)
        other = [f for f in map(Path, path) if _plain(f).endswith(FORMATS["tum"].suffixes)]
        if other:
            raise InputError(f"{other[0]}: several files at once are read of CSV and NDJSON alone")
        return "ndjson" if logs and path else "csv"
    where = Path(path)
    if where.is_dir():
        for name, entry in FORMATS.items():
            if find_file(where, *entry.folder):
                return name
        files = ", ".join(file for entry in FORMATS.values() for file in entry.folder)
        raise InputError(f"{where}: the folder holds none of the files that tell a format: {files}")
    plain = _plain(where)
    for name, entry in FORMATS.items():
        if plain.endswith(entry.suffixes):
            return name
    line = next(lines_of(where), None)
    words = [] if line is None else line.words
    for name, entry in FORMATS.items():
        if words and words[0] in entry.tags:
            return name
    if words and words[0].startswith("{"):
        return "ndjson"
    if len(words) == 8:
        return "tum"
    raise InputError(
        f"{where}: neither name nor first line tell the format; give one of {', '.join(FORMATS)}"
    )


def _plain(path: Path) -> str:
    """The name of a file, in small letters and without ``.gz``."""
    return path.name.lower().removesuffix(".gz")


def _paths(path: AnyPath | Sequence[AnyPath]) -> Path | list[Path]:
    return Path(path) if isinstance(path, str | Path) else [Path(p) for p in path]
