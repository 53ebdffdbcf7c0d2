"""Writers: maps of robots and landmarks as TUM, g2o, GeoJSON, Turtle or spark_dsg JSON."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from symboslam.engine.slam.log import Mission
from symboslam.engine.slam.slam_map import SlamMap
from symboslam.engine.slam.writers.output import Output, Written
from symboslam.errors import OutputError

__all__ = ["FORMATS", "Format", "Written", "format_of", "write_slam_map"]


@dataclass(frozen=True)
class Format:
    """A format of maps.

    Attributes:
        suffixes: ends of file names that ask for it.
        options: what ``write_slam_map`` can be told for it.
    """

    suffixes: tuple[str, ...]
    options: tuple[str, ...] = ()

    @staticmethod
    def load(name: str) -> Callable[[Output], Written]:
        """The function that writes the format of this name."""
        write: Callable[[Output], Written] = import_module(f"{__name__}.{name}").write
        return write


FORMATS: Mapping[str, Format] = {
    "tum": Format((".tum",)),
    "g2o": Format((".g2o",)),
    "spark_dsg": Format((".dsg.json",)),
    "geojson": Format((".geojson", ".json"), ("origin", "paths")),
    "turtle": Format((".ttl",), ("base", "knowledge")),
}
"""All formats by name; each is the module of that name, with ``write``."""


def format_of(path: str | Path, format: str | None = None) -> str:
    """Name of the format of a file that is to be written.

    Raises:
        OutputError: no such format, or an ending that stands for none.
    """
    if format is not None:
        if format not in FORMATS:
            raise OutputError(f"no format {format!r}; there are: {', '.join(FORMATS)}")
        return format
    name = str(path).lower()
    for known, entry in FORMATS.items():
        if name.endswith(entry.suffixes):
            return known
    endings = ", ".join(end for entry in FORMATS.values() for end in entry.suffixes)
    raise OutputError(f"{path}: no format has this ending; use one of {endings}")


def write_slam_map(
    path: str | Path, slam_map: SlamMap, mission: Mission, format: str | None = None, **options: Any
) -> Written:
    """Write a map, whole or not at all.

    Args:
        path: the file; its ending tells the format. TUM has a file for each robot: of several
            robots each has its name behind that of the file (``run-Robot_2.tum``).
        slam_map: the map.
        mission: the logs that it was made of.
        format: a name in ``FORMATS``, whatever the ending is.
        options: of the format, see ``Format.options`` and `Output`.

    Raises:
        OutputError: unknown format or option, or the file cannot be written; an old file is kept.
        InputError: an option has no possible value.
        MissingExtraError: spark_dsg is not installed.
    """
    name = format_of(path, format)
    given = {key: value for key, value in options.items() if value is not None}
    for key in given:
        if key not in FORMATS[name].options:
            known = ", ".join(FORMATS[name].options) or "none"
            raise OutputError(f"the format {name} has no option {key!r}; it has: {known}")
    _check(Path(path), slam_map)
    return Format.load(name)(Output(Path(path), slam_map, mission, **given))


def _check(path: Path, slam_map: SlamMap) -> None:
    """Refuse maps with places that are none.

    Raises:
        OutputError: a pose or a landmark is NaN or infinite.
    """
    for name, trajectory in slam_map.trajectories.items():
        if not (np.isfinite(trajectory.pose).all() and np.isfinite(trajectory.time).all()):
            raise OutputError(f"{path}: a pose of {name} is NaN or infinite")
    bad = ~np.isfinite(slam_map.landmarks.xy).all(1)
    if bad.any():
        raise OutputError(f"{path}: landmark {slam_map.landmarks.id[bad][0]} lies nowhere (NaN)")
