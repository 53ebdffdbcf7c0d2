"""CSV logs: odometry.csv and detections.csv, with fixes.csv and starts.csv where there are any."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.readers.columns import FeatureIndex
from symboslam.engine.slam.log import (
    FARTHEST,
    FINEST,
    SIGMA_BEARING,
    SIGMA_RANGE,
    Fixes,
    Floats,
    Ints,
    Measurements,
    Mission,
    Odometry,
    Pose,
    RobotLog,
)
from symboslam.engine.slam.odometry import arcs, chain
from symboslam.engine.slam.planar import wrap
from symboslam.engine.slam.readers.classes import Classes
from symboslam.engine.slam.readers.csv_columns import Columns, read_columns
from symboslam.engine.slam.readers.rows import in_order, one_a_time
from symboslam.engine.slam.readers.text import count, find_file
from symboslam.errors import InputError

TIME = ("t", "timestamp", "stamp", "time_s", "seconds")
ROBOT_NAMES = ("agent", "robot_id", "robot_name")
HEADING = {
    "heading": ("theta", "yaw", "heading_rad", "yaw_rad", "phi"),
    "heading_deg": ("theta_deg", "yaw_deg", "heading_degrees"),
}
PLACE = {"x": ("x_m", "pos_x", "tx"), "y": ("y_m", "pos_y", "ty")}
ODOMETRY = {
    "time": TIME,
    "robot": ROBOT_NAMES,
    **PLACE,
    **HEADING,
    "v": ("linear", "linear_velocity", "forward_velocity", "velocity", "speed"),
    "omega": ("w", "angular", "angular_velocity", "yaw_rate"),
}
DETECTIONS = {
    "time": TIME,
    "robot": ROBOT_NAMES,
    "range": ("r", "dist", "distance", "range_m"),
    "bearing": ("angle", "bearing_rad"),
    "bearing_deg": ("angle_deg", "bearing_degrees"),
    "class": ("label", "feature", "type", "class_name"),
    "confidence": ("score", "probability", "conf"),
    "key": ("sign", "barcode", "marker"),
    "sigma_range": ("range_sigma", "range_std", "std_range"),
    "sigma_bearing": ("bearing_sigma", "bearing_std", "std_bearing"),
}
FIXES = {"time": TIME, "robot": ROBOT_NAMES, **PLACE, "sigma": ("std", "accuracy", "sigma_m")}
DEGREES = 0.1
"""Share of bearings beyond a turn from which they are not in radians."""
STARTS = {"robot": ROBOT_NAMES, **PLACE, **HEADING}
SIGMAS = {"sigma_range": SIGMA_RANGE, "sigma_bearing": SIGMA_BEARING}
SIGMA_FIX = 3.0
"""Metres of a fix that does not say how good it is: a plain GPS receiver under open sky."""
ONLY_ROBOT = "Robot 1"
"""The robot of files without a column that names one."""


def read(
    path: Path | Sequence[Path], knowledge: FeatureIndex | None = None
) -> tuple[Mission, list[str]]:
    """Read the logs of robots.

    Args:
        path: a folder with odometry.csv and, where there are any, detections.csv, fixes.csv
            (or gps.csv) and starts.csv; or these files; or the odometry alone.
        knowledge: ontology whose features classes are looked up in, by name, label or alias.

    Raises:
        InputError: a file is wrong; names it and the line.
    """
    notes: list[str] = []
    files = _files(path)
    odometry = _odometry(read_columns(files["odometry"], ODOMETRY, notes), notes)
    robots = tuple(odometry)
    classes = Classes(knowledge)
    seen: dict[str, Measurements] = {}
    if "detections" in files:
        table = read_columns(files["detections"], DETECTIONS, notes)
        for name, rows in _by_robot(table, robots, notes).items():
            seen[name] = _detections(rows, odometry[name], robots, classes, notes)
    fixes: dict[str, Fixes] = {}
    if "fixes" in files:
        table = read_columns(files["fixes"], FIXES, notes)
        for name, rows in _by_robot(table, robots, notes).items():
            fixes[name] = _fixes(rows, notes)
    starts: dict[str, Pose] = {}
    if "starts" in files:
        starts = _starts(read_columns(files["starts"], STARTS, notes), robots, notes)
    none = np.zeros(0)
    nothing = Measurements(none, none, none, np.zeros(0, np.int64), none, np.zeros(0, object))
    notes += classes.notes
    return Mission(
        tuple(
            RobotLog(
                name, track, seen.get(name, nothing), starts.get(name), fixes=fixes.get(name)
            )
            for name, track in odometry.items()
        ),
        classes.names,
        classes.dynamic,
        np.eye(len(classes.names)),
    ), notes  # fmt: skip


def _files(path: Path | Sequence[Path]) -> dict[str, Path]:
    """Role -> file."""
    names = {
        "odometry": ("odometry.csv",),
        "detections": ("detections.csv",),
        "fixes": ("fixes.csv", "gps.csv"),
        "starts": ("starts.csv",),
    }
    found: dict[str, Path] = {}
    if isinstance(path, Path) and path.is_dir():
        for role, files in names.items():
            file = find_file(path, *files)
            if file is not None:
                found[role] = file
    elif isinstance(path, Path):
        found["odometry"] = path
    else:
        for file in path:
            stem = file.name.lower()
            role = next((r for r in names if r in stem), "fixes" if "gps" in stem else "")
            if not role or role in found:
                raise InputError(f"{file}: the name must hold one of {', '.join(names)}, each once")
            found[role] = file
    if "odometry" not in found:
        raise InputError(f"{path}: there is no odometry.csv")
    return found


def _by_robot(table: Columns, robots: tuple[str, ...], notes: list[str]) -> dict[str, Columns]:
    """Robot -> its rows; those of robots without odometry are left out and noted.

    Raises:
        InputError: there are several robots, and nothing says whose rows these are.
    """
    if "robot" not in table:
        if len(robots) > 1:
            raise InputError(
                f"{table.path}: header: there is no column 'robot', and there are {len(robots)}"
            )
        return {robots[0]: table}
    names = table.texts("robot")
    found = {name: table.take(names == name) for name in robots}
    strange = ~np.isin(names.astype(str), robots)
    if strange.any():
        who = ", ".join(sorted(set(names[strange].tolist())))
        rows = count(int(strange.sum()), "row")
        notes.append(f"{table.path.name}: {rows} of robots without odometry left out: {who}")
    return {name: rows for name, rows in found.items() if len(rows)}


def _left_out(
    table: Columns, wrong: NDArray[np.bool_], what: str, notes: list[str]
) -> NDArray[np.bool_]:
    """Note rows that are left out; the mask of the others."""
    if wrong.any():
        rows, line = count(int(wrong.sum()), "row"), table.line[wrong][0]
        notes.append(f"{table.path.name}: {rows} {what} left out, the first in line {line}")
    return ~wrong


def _angle(table: Columns, radians: str, degrees: str) -> Floats:
    """(n,) radians of a column in either unit; empty cells are NaN."""
    if radians in table and degrees in table:
        raise InputError(f"{table.path}: header: both {radians} and {degrees}: keep one")
    return np.deg2rad(table.floats(degrees)) if degrees in table else table.floats(radians)


def _odometry(table: Columns, notes: list[str]) -> dict[str, Odometry]:
    """Robot -> its odometry, from poses or from velocities that hold until the next row."""
    poses = "x" in table and "y" in table and ("heading" in table or "heading_deg" in table)
    if not poses and not ("v" in table and "omega" in table):
        raise InputError(
            f"{table.path}: header: columns x, y, heading (or heading_deg) are needed, or v, omega"
        )
    names = table.texts("robot") if "robot" in table else np.full(len(table), ONLY_ROBOT, object)
    found = {}
    for name in dict.fromkeys(names.tolist()):
        rows = table.take(names == name)
        if not name:
            raise InputError(f"{rows.where(0)}: the robot is empty")
        columns = (
            [rows.floats("x"), rows.floats("y"), _angle(rows, "heading", "heading_deg")]
            if poses
            else [rows.floats("v"), rows.floats("omega")]
        )
        values = np.column_stack([rows.times(notes), *columns])
        bad = np.any(~np.isfinite(values), axis=1, keepdims=True)[:, 0]
        values = values[_left_out(rows, bad, "with NaN or empty cells", notes)]
        label = f"{table.path.name}, {name}"
        values = values[in_order(values[:, 0], label, notes)]
        places = values[:, 1:3] if poses else None
        values = values[one_a_time(values[:, 0], label, notes, places)]
        if not len(values):
            notes.append(f"{label}: no row of odometry can be used; the robot is left out")
            continue
        time = values[:, 0].copy()
        if poses:
            pose = np.column_stack([values[:, 1:3], wrap(values[:, 3])])
        else:
            pose = chain((0, 0, 0), arcs(values[:-1, 1], values[:-1, 2], np.diff(time)))
        found[str(name)] = Odometry(time, pose)
    if not found:
        raise InputError(f"{table.path}: no robot has a row of odometry that can be used")
    return found


def _detections(
    table: Columns,
    odometry: Odometry,
    robots: tuple[str, ...],
    classes: Classes,
    notes: list[str],
) -> Measurements:
    """What one robot saw, by time."""
    if not {"range", "bearing", "bearing_deg"} & set(table.text):
        raise InputError(f"{table.path}: header: a column range or bearing is needed")
    time, reach = table.times(notes), table.floats("range")
    bearing = _angle(table, "bearing", "bearing_deg")
    confidence = table.floats("confidence", empty=1.0)
    turns = np.abs(bearing[np.isfinite(bearing)])
    beyond = turns > math.tau
    if "bearing" in table and beyond.sum() >= DEGREES * max(len(beyond), 20):
        raise InputError(
            f"{table.path}: bearings reach {turns.max():.0f}, and should be in "
            "radians; a column of degrees is called bearing_deg"
        )
    bad = ~((confidence > 0) & (confidence <= 1)) & ~np.isnan(confidence)
    if bad.any():
        raise table.wrong(int(np.argmax(bad)), "confidence", "not in (0, 1]")
    good = _left_out(table, ~np.isfinite(time), "without a time", notes)
    early: NDArray[np.bool_] = good & (time < odometry.time[0])
    good &= _left_out(table, early, "from before the first odometry", notes)
    negative = good & ((reach < 0) | (reach > FARTHEST) | np.isinf(bearing))
    good &= _left_out(table, negative, "with a range below 0 or infinity", notes)
    blind = good & np.isnan(reach) & np.isnan(bearing)
    good &= _left_out(table, blind, "with neither range nor bearing", notes)
    for missing, kept, column in ((reach, "bearing", "range"), (bearing, "range", "bearing")):
        partial = int(np.isnan(missing[good]).sum())
        if partial:
            notes.append(
                f"{table.path.name}: {count(partial, 'row')} without a {column} (empty or NaN): "
                f"read as a {kept} alone"
            )
    late = int((time[good] > odometry.time[-1]).sum())
    if late:
        notes.append(f"{table.path.name}: {count(late, 'row')} from after the last odometry")
    unsure = int(np.isnan(confidence[good]).sum())
    if unsure:
        notes.append(
            f"{table.path.name}: {count(unsure, 'row')} with a confidence of NaN: read as 1"
        )
    index: Ints = np.flatnonzero(good)
    index = index[in_order(time[index], table.path.name, notes)]
    sigmas = {
        name: table.floats(name, empty=default) for name, default in SIGMAS.items() if name in table
    }
    for name, sigma in sigmas.items():
        sigma[np.isnan(reach if name == "sigma_range" else bearing)] = SIGMAS[name]
        wrong = good & ~((sigma >= FINEST) & (sigma <= FARTHEST))
        if wrong.any():
            raise table.wrong(int(np.argmax(wrong)), name, f"not from {FINEST:g} to {FARTHEST:g}")
    feature = [classes.position_of(name) for name in table.texts("class")[index].tolist()]
    return Measurements(
        time=time[index],
        range=reach[index],
        bearing=wrap(bearing[index]),
        feature=np.array(feature, np.int64),
        confidence=np.nan_to_num(confidence[index], nan=1.0),
        key=table.texts("key")[index],
        **{name: sigma[index] for name, sigma in sigmas.items()},
    )


def _fixes(table: Columns, notes: list[str]) -> Fixes:
    if "x" not in table or "y" not in table:
        raise InputError(f"{table.path}: header: columns x and y, in metres, are needed")
    sigma = table.floats("sigma", empty=SIGMA_FIX)
    values = np.column_stack([table.times(notes), table.floats("x"), table.floats("y"), sigma])
    bad: NDArray[np.bool_] = ~(np.isfinite(values).all(1) & (sigma > 0))
    values = values[_left_out(table, bad, "with NaN, empty cells or no sigma above 0", notes)]
    values = values[in_order(values[:, 0], table.path.name, notes)]
    return Fixes(values[:, 0], values[:, 1:3], values[:, 3])


def _starts(table: Columns, robots: tuple[str, ...], notes: list[str]) -> dict[str, Pose]:
    found: dict[str, Pose] = {}
    for name, rows in _by_robot(table, robots, notes).items():
        angle = _angle(rows, "heading", "heading_deg")
        values = np.column_stack([rows.floats("x"), rows.floats("y"), angle])
        if len(values) > 1:
            raise InputError(f"{rows.where(1)}: {name} has a second start")
        if not (np.isfinite(values).all() and np.abs(values).max() <= FARTHEST):
            raise InputError(
                f"{rows.where(0)}: a start needs x, y and heading, no farther than {FARTHEST:g}"
            )
        x, y, heading = values[0].tolist()
        found[name] = (x, y, heading)
    return found
