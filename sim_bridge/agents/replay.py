"""Replay: a robot's log in any format that map building reads, as its records at their times."""

from __future__ import annotations

import hashlib
import json
import time
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

from symboslam.engine.slam.log import Mission, RobotLog
from symboslam.engine.slam.readers.records import Record, of_log
from symboslam.errors import InputError
from symboslam.reasoning.knowledge import Knowledge

_LINES = (".ndjson", ".jsonl")


def is_mission(path: Path) -> bool:
    """Whether a file or folder holds something else than records in lines.

    Raises:
        InputError: it cannot be read.
    """
    try:
        if path.is_dir():
            return True
        with path.open("rb") as file:
            return path.suffix not in _LINES and not file.read(4096).lstrip().startswith(b"{")
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror or error}") from error


def read(
    path: Path, robot: str, knowledge: Knowledge, tell: Callable[[str], None]
) -> tuple[Iterator[Record], dict[str, Any]]:
    """The records of one robot of a mission, and what its mapper is to know beside them.

    Args:
        path: a file or folder that `symboslam.engine.slam.readers.read_mission` reads.
        robot: the name of the robot there; a robot that is alone may have any.
        knowledge: where classes are looked up.
        tell: is told what was mended or left out.

    Raises:
        InputError: it cannot be read, or holds no such robot.
    """
    from symboslam.engine.slam.readers import FORMATS, format_of, read_mission

    name = format_of(path)
    options = {"knowledge": knowledge} if "knowledge" in FORMATS[name].options else {}
    mission, notes = read_mission(path, name, **options)
    for note in notes:
        tell(note)
    log = robot_of(mission, robot, str(path))
    if log.closures is not None:
        tell(f"{len(log.closures.time)} relative poses from outside are left out")
    return of_log(log, mission.classes), {
        "start": log.start, "start_sigma": log.start_sigma, "noise": log.odometry.noise,
        **{
            name: sigma
            for name in ("sigma_range", "sigma_bearing")
            if isinstance(sigma := getattr(log.seen, name), float)
        },
    }  # fmt: skip


def robot_of(mission: Mission, robot: str, source: str) -> RobotLog:
    """The log of a robot; that of the only one, whatever it is called.

    Raises:
        InputError: there are several, and none has this name.
    """
    found = [log for log in mission.robots if log.name == robot]
    if not found and len(mission.robots) != 1:
        names = ", ".join(log.name for log in mission.robots)
        raise InputError(f"{source} has no robot {robot!r}; it has: {names or 'none'}")
    return (found or list(mission.robots))[0]


def run_of(log: Path, *options: object) -> str:
    """Name of the run in which a log is replayed: the same again has the same.

    Args:
        log: a file, or a folder of files.
        options: all else that its increments depend on.

    Raises:
        InputError: a file cannot be read.
    """
    digest = hashlib.sha256(json.dumps([str(each) for each in options]).encode())
    files = sorted(each for each in log.rglob("*") if each.is_file()) if log.is_dir() else [log]
    try:
        for file in files:
            with file.open("rb") as opened:
                digest.update(hashlib.file_digest(opened, "sha256").digest())
    except OSError as error:
        raise InputError(f"{file} cannot be read: {error.strerror or error}") from error
    return f"replay-{digest.hexdigest()[:24]}"


def paced(records: Iterable[Record], speed: float | None) -> Iterable[Record]:
    """Records at the times at which they were made, so many times faster; None: at once."""
    start = None
    for record in records:
        if speed is not None:
            start = start or (time.monotonic(), record.time)
            left = start[0] + (record.time - start[1]) / speed - time.monotonic()
            time.sleep(min(max(left, 0.0), 3600.0))
        yield record
