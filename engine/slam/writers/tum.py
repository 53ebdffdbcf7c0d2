"""Trajectories as TUM: timestamp tx ty tz qx qy qz qw, a file for each robot."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from symboslam.engine.slam.slam_map import Trajectory
from symboslam.engine.slam.writers.output import Output, Written, write_files
from symboslam.errors import OutputError


def write(output: Output) -> Written:
    """Write the trajectories; landmarks have no place in TUM.

    Raises:
        OutputError: no robot was placed, or a file cannot be written.
    """
    paths = output.slam_map.trajectories
    if not paths:
        raise OutputError(f"{output.path}: no robot of this map was placed: nothing to write")
    files = {_file(output.path, name, len(paths)): path for name, path in paths.items()}
    if len(files) < len(paths):
        raise OutputError(f"{output.path}: the names of two robots make the same file name")
    write_files([(file, _rows(path)) for file, path in files.items()])
    notes = (
        [f"TUM has no landmarks: {len(output.slam_map.landmarks)} are not in the file"]
        if len(output.slam_map.landmarks)
        else []
    )
    return Written(tuple(files), tuple(notes))


def _file(path: Path, robot: str, robots: int) -> Path:
    if robots == 1:
        return path
    name = re.sub(r"[^\w.-]+", "_", robot)
    return path.with_name(f"{path.stem}-{name}{path.suffix}")


def _rows(path: Trajectory) -> Iterator[str]:
    yield "# timestamp tx ty tz qx qy qz qw\n"
    half = path.pose[:, 2] / 2
    rows = np.column_stack([path.time, path.pose[:, :2], np.sin(half), np.cos(half)]).tolist()
    for time, x, y, sine, cosine in rows:
        yield f"{time!r} {x!r} {y!r} 0 0 0 {sine!r} {cosine!r}\n"
