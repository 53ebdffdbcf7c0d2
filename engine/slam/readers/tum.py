"""TUM: trajectories as rows of timestamp tx ty tz qx qy qz qw (TUM RGB-D benchmark)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from symboslam.engine.slam.log import Measurements, Mission, Odometry, RobotLog
from symboslam.engine.slam.readers.rows import in_order, one_a_time, without_repeats
from symboslam.engine.slam.readers.spatial import STEEPEST, heading_of
from symboslam.engine.slam.readers.text import read_table
from symboslam.engine.slam.slam_map import Trajectory
from symboslam.errors import InputError

COLUMNS = ("timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw")


def read_trajectory(path: str | Path) -> tuple[Trajectory, list[str]]:
    """A trajectory, brought down to the plane, and what was mended.

    Raises:
        InputError: the file is wrong, or most poses tilt too much for a map of the plane.
    """
    where, notes = Path(path), list[str]()
    table = read_table(where, COLUMNS, notes)
    if not len(table):
        raise InputError(f"{where}: no row can be read")
    kept = without_repeats(table.values, where.name, notes)
    kept = kept[in_order(table.values[kept, 0], where.name, notes)]
    kept = kept[one_a_time(table.values[kept, 0], where.name, notes)]
    values, lines = table.values[kept], table.line[kept]
    turned = np.array(
        [heading_of(q, f"{where}: line {n}") for q, n in zip(values[:, 4:], lines, strict=True)]
    )
    if np.median(turned[:, 1]) > STEEPEST:
        raise InputError(
            f"{where}: poses tilt by {np.median(turned[:, 1]):.2f} rad: this is no trajectory in "
            "the plane with z up"
        )
    if turned[:, 1].max() > STEEPEST or np.ptp(values[:, 3]) > 1:
        notes.append(
            f"{where.name}: poses climb by {np.ptp(values[:, 3]):.1f} m and tilt by up to "
            f"{turned[:, 1].max():.2f} rad; they were brought down to the plane"
        )
    pose = np.column_stack([values[:, 1:3], turned[:, 0]])
    return Trajectory(values[:, 0].copy(), pose), notes


def read(path: Path) -> tuple[Mission, list[str]]:
    """A trajectory as the odometry of a robot that saw nothing; it starts where that starts.

    Raises:
        InputError: see `read_trajectory`.
    """
    trajectory, notes = read_trajectory(path)
    none = np.zeros(0)
    seen = Measurements(
        none, none, none, np.zeros(0, np.int64), none, np.zeros(0, object)
    )  # fmt: skip
    x, y, heading = trajectory.pose[0].tolist()
    log = RobotLog(
        "Robot 1", Odometry(trajectory.time, trajectory.pose), seen, (x, y, heading)
    )  # fmt: skip
    return Mission((log,), (), np.zeros(0, np.bool_), np.zeros((0, 0))), notes
