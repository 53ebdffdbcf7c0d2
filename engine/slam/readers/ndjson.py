"""NDJSON logs, as agents read and write them: a file for each robot, a record in each line."""

from __future__ import annotations

import gzip
import zlib
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from symboslam.engine.readers.columns import FeatureIndex
from symboslam.engine.slam.log import (
    SIGMA_BEARING,
    SIGMA_RANGE,
    Fixes,
    Floats,
    Measurements,
    Mission,
    Odometry,
    RobotLog,
)
from symboslam.engine.slam.readers.classes import Classes
from symboslam.engine.slam.readers.records import (
    FixRecord,
    OdometryRecord,
    Record,
    SightingRecord,
)
from symboslam.engine.slam.readers.records import (
    read as read_records,
)
from symboslam.engine.slam.readers.rows import in_order, one_a_time
from symboslam.errors import InputError

_ENDINGS = (".gz", ".ndjson", ".jsonl")


def read(
    path: Path | Sequence[Path], knowledge: FeatureIndex | None = None
) -> tuple[Mission, list[str]]:
    """Read the logs of robots; each is called as its file, without the ending.

    Args:
        path: a file, or one for each robot.
        knowledge: ontology whose features classes are looked up in, by name, label or alias.

    Raises:
        InputError: a file cannot be read or holds no odometry; or two are called the same.
    """
    notes: list[str] = []
    classes = Classes(knowledge)
    robots: dict[str, RobotLog] = {}
    for file in [path] if isinstance(path, Path) else path:
        name = file.name
        for ending in _ENDINGS:
            name = name.removesuffix(ending)
        if name in robots:
            raise InputError(f"{file}: there is another log of a robot {name!r}")
        robots[name] = _log(file, name, classes, notes)
    notes += classes.notes
    size = len(classes.names)
    return Mission(tuple(robots.values()), classes.names, classes.dynamic, np.eye(size)), notes


def _log(file: Path, name: str, classes: Classes, notes: list[str]) -> RobotLog:
    records: list[Record] = list(read_records(_lines(file), file.name, notes.append))
    driven = np.array(
        [(r.time, *r.pose) for r in records if isinstance(r, OdometryRecord)], float
    ).reshape(-1, 4)
    if not len(driven):
        raise InputError(f"{file}: it holds no odometry")
    driven = driven[in_order(driven[:, 0], f"{file.name}, odometry", notes)]
    driven = driven[one_a_time(driven[:, 0], f"{file.name}, odometry", notes, driven[:, 1:3])]
    seen = [r for r in records if isinstance(r, SightingRecord)]
    order = in_order(np.array([r.time for r in seen]), f"{file.name}, sightings", notes)
    seen = [seen[n] for n in order.tolist()]
    fixes = np.array(
        [(r.time, r.x, r.y, r.sigma) for r in records if isinstance(r, FixRecord)], float
    ).reshape(-1, 4)
    fixes = fixes[in_order(fixes[:, 0], f"{file.name}, fixes", notes)]
    key = np.empty(len(seen), object)
    key[:] = [r.key for r in seen]
    return RobotLog(
        name,
        Odometry(driven[:, 0], driven[:, 1:]),
        Measurements(
            np.array([r.time for r in seen], float),
            np.array([r.range for r in seen], float),
            np.array([r.bearing for r in seen], float),
            np.array([classes.position_of(r.feature) for r in seen], np.int64),
            np.array([r.confidence for r in seen], float),
            key,
            *_sigmas(seen),
        ),
        fixes=Fixes(fixes[:, 0], fixes[:, 1:3], fixes[:, 3]) if len(fixes) else None,
    )


def _sigmas(seen: Sequence[SightingRecord]) -> tuple[float | Floats, float | Floats]:
    """Deviations of ranges and bearings; one each for all if no sighting says its own."""
    usual = SIGMA_RANGE, SIGMA_BEARING
    if all(record.sigma is None for record in seen):
        return usual
    found = np.array([record.sigma or usual for record in seen], float)
    return found[:, 0], found[:, 1]


def _lines(file: Path) -> Iterator[str]:
    """The lines of a file, plain or gzipped.

    Raises:
        InputError: it cannot be read.
    """
    try:
        with gzip.open(file) if file.suffix == ".gz" else file.open("rb") as opened:
            for line in opened:
                yield line.decode(errors="replace")
    except (OSError, EOFError, zlib.error) as error:
        said = getattr(error, "strerror", None) or error
        raise InputError(f"{file} cannot be read: {said}") from error
