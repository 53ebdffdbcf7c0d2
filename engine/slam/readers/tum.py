"""TUM: trajectories as rows of timestamp tx ty tz qx qy qz qw (TUM RGB-D benchmark)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from symboslam.engine.slam.slam_map import Trajectory
from symboslam.errors import InputError


def read_trajectory(path: str | Path) -> tuple[Trajectory, list[str]]:
    """A trajectory seen from above, and what was mended (nothing).

    Raises:
        InputError: the file cannot be read, a row is wrong, or times do not increase.
    """
    try:
        lines = Path(path).read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        reason = getattr(error, "strerror", None) or "it is no text"
        raise InputError(f"{path}: cannot be read: {reason}") from error
    rows: list[list[float]] = []
    for number, line in enumerate(lines, 1):
        words = line.partition("#")[0].replace(",", " ").split()
        if not words:
            continue
        try:
            row = [float(word) for word in words]
        except ValueError:
            row = []
        if len(row) != 8 or not np.isfinite(row).all() or not any(row[4:]):
            raise InputError(
                f"{path}: line {number}: give eight numbers: timestamp tx ty tz qx qy qz qw"
            )
        if rows and row[0] <= rows[-1][0]:
            raise InputError(f"{path}: line {number}: the time is not later than that before")
        rows.append(row)
    if not rows:
        raise InputError(f"{path}: there is no pose in it")
    time, x, y, _, qx, qy, qz, qw = np.array(rows).T
    size = qx**2 + qy**2 + qz**2 + qw**2
    heading = np.arctan2(2 * (qw * qz + qx * qy), size - 2 * (qy**2 + qz**2))
    return Trajectory(time, np.column_stack([x, y, heading])), []
