"""Readers: landmark files of several formats -> LandmarkMap.

A reader turns one format into raw columns; ``build`` makes the map from them, so that every
check, projection and count is the same for all formats (design 8 and 10). A further format is one
more module with a ``read`` function and one more line in ``FORMATS``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import IO, Any

from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.readers import csv_table, geojson, osm
from symboslam.engine.readers.build import build
from symboslam.engine.readers.columns import Columns, FeatureIndex, Progress
from symboslam.engine.readers.source import Source, open_source, sniff
from symboslam.errors import InputError, LandmarkError

__all__ = ["FORMATS", "FeatureIndex", "Format", "Progress", "read_landmarks"]


@dataclass(frozen=True)
class Format:
    """A format of landmark files.

    Attributes:
        suffixes: ends of the names of its files, in lower case.
        read: turns a source into columns.
    """

    suffixes: tuple[str, ...]
    read: Callable[[Source, FeatureIndex, Progress], Columns]


FORMATS: Mapping[str, Format] = {
    "geojson": Format((".geojson", ".json", ".geojson.gz", ".json.gz"), geojson.read),
    "csv": Format((".csv", ".csv.gz"), csv_table.read),
    "osm": Format((".osm.pbf", ".osm", ".osm.bz2", ".osm.gz"), osm.read),
}


def read_landmarks(
    source: str | Path | IO[Any] | Mapping[str, Any],
    knowledge: FeatureIndex,
    *,
    format: str | None = None,
    crs: str | None = None,
    bbox: Sequence[float] | None = None,
    progress: Progress | None = None,
) -> LandmarkMap:
    """Read landmarks.

    Landmarks whose class or tags no feature has, that lie outside the area, or that repeat
    another one exactly are left out and counted in ``LandmarkMap.report``.

    Args:
        source: a file; ``-`` for standard input; an open stream; or a GeoJSON document as a dict.
        knowledge: which features there are; a ``Knowledge``.
        format: ``geojson``, ``csv`` or ``osm``; default by the file's name, for streams without
            a telling name by their first bytes.
        crs: coordinate system of the input if the file does not say it or says it wrongly:
            ``EPSG:...``, ``OGC:CRS84``, or ``m`` for local metres.
        bbox: the area, (min x, min y, max x, max y) in the input's coordinates, edges included;
            default: what the file says, else the landmarks' extent.
        progress: called with the stage and the fraction of it that is done.

    Raises:
        LandmarkError: the file or a landmark in it is wrong; names the file and the place.
        GeometryError: the area, the surveyed area or the coordinate system is wrong.
        InputError: there is no such format.
    """
    report = progress or _silent
    columns = _columns(source, knowledge, format, report)
    report("placing", 0.0)
    landmarks = build(columns, knowledge, crs=crs, bbox=bbox)
    report("placing", 1.0)
    return landmarks


def _columns(
    source: str | Path | IO[Any] | Mapping[str, Any],
    knowledge: FeatureIndex,
    name: str | None,
    progress: Progress,
) -> Columns:
    if name is not None and name not in FORMATS:
        raise InputError(f"there is no format {name!r}: choose one of {', '.join(FORMATS)}")
    if isinstance(source, Mapping):
        title = source.get("name")
        return geojson.from_object(
            source, title if isinstance(title, str) and title else "GeoJSON", knowledge
        )
    opened = open_source(source)
    chosen = name or _format_of(opened)
    columns = FORMATS[chosen].read(opened, knowledge, progress)
    progress("reading", 1.0)
    return columns


def _format_of(source: Source) -> str:
    """The format by the name's end, or by the first bytes where there is no file."""
    lower = source.name.lower()
    for name, entry in FORMATS.items():
        if lower.endswith(entry.suffixes):
            return name
    if source.path is None:
        return sniff(source.data[:4096])
    known = ", ".join(suffix for entry in FORMATS.values() for suffix in entry.suffixes)
    problem = f"the name does not tell the format: it ends in none of {known}; give the format"
    raise LandmarkError(problem, source=source.name)


def _silent(stage: str, fraction: float) -> None:
    """Progress that nobody wants to see."""
