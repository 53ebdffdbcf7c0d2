"""MRCLAM: the UTIAS multi-robot data sets (Leung, Halpern, Barfoot, Liu; IJRR 2011), sets 1 to 9.

A folder with Barcodes.dat, Landmark_Groundtruth.dat and, for each robot N, RobotN_Odometry.dat,
RobotN_Measurement.dat and RobotN_Groundtruth.dat, each plain or gzipped. Subjects 1 to 5 are the
robots, 6 to 20 the landmarks.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.log import (
    ROBOT,
    Floats,
    Ints,
    Measurements,
    Mission,
    Odometry,
    OdometryNoise,
    Pose,
    RobotLog,
    Truth,
)
from symboslam.engine.slam.odometry import arcs, chain, pose_at
from symboslam.engine.slam.planar import between, compose
from symboslam.engine.slam.readers.rows import in_order, one_a_time, without_repeats
from symboslam.engine.slam.readers.text import Table, count, find_file, read_table
from symboslam.errors import InputError

NOISE = OdometryNoise(along=0.15, across=0.03, turn=0.35, drift=0.0, floor=(0.004, 0.001, 0.008))
"""Of a step of 0.5 s, measured on these robots. The rows of the files are 10 to 20 ms apart: an
estimator that takes each row for a step must not use the floor as it is."""
SIGMA_RANGE = 0.15
SIGMA_BEARING = 0.02
ROBOTS = 5
"""Subjects up to this number are robots."""
STARTS = ("all", "first", "none")
LONGEST_STEP = 2.0
"""Seconds between two rows of odometry above which the gap is told."""
LATEST_TRUTH = 5.0
"""Seconds after the first odometry at which the truth may begin and still give the start."""


def read(folder: Path, classes: int | None = None, start: str = "all") -> tuple[Mission, list[str]]:
    """Read a set.

    Args:
        folder: where its files are.
        classes: hide who is who: landmarks get classes "class 0" to "class k - 1", by subject
            modulo k, and no key. None: the key of each is its subject ("6" to "20"), each has
            a class of its own, and seen robots have their names as keys.
        start: robots whose start is told, by the truth: ``all``, the ``first``, or ``none``.

    Returns:
        The mission with truth and identities, and what was mended.

    Raises:
        InputError: a file is missing or wrong, or an option is.
    """
    if start not in STARTS:
        raise InputError(f"start is {start!r}; it can be {', '.join(STARTS)}")
    if classes is not None and classes < 1:
        raise InputError(f"classes is {classes}; it must be 1 or more")
    if not folder.is_dir():
        what = "this is a file" if folder.exists() else "there is no such folder"
        raise InputError(f"{folder}: {what}; an MRCLAM set is a folder with Barcodes.dat in it")
    notes: list[str] = []
    subject_of = _barcodes(folder, notes)
    landmarks = _landmarks(folder, notes)
    subjects = sorted({s for s in subject_of.values() if s > ROBOTS} | {int(s) for s in landmarks})
    hidden = classes is not None
    if classes is None:
        names, feature_of = (
            tuple(f"Landmark {s}" for s in subjects),
            {s: i for i, s in enumerate(subjects)},
        )
    else:
        names = tuple(f"class {i}" for i in range(classes))
        feature_of = {s: s % classes for s in subjects}
    logs: list[RobotLog] = []
    paths: dict[str, Floats] = {}
    identity: dict[str, NDArray[np.object_]] = {}
    for n in _robots(folder):
        name = f"Robot {n}"
        odometry = _odometry(folder, n, notes)
        if odometry is None:
            continue
        truth = _truth(folder, n, notes)
        known = start == "all" or (start == "first" and not logs)
        begun = float(odometry.time[0])
        seen, identity[name] = _seen(folder, n, subject_of, feature_of, hidden, begun, notes)
        if truth is not None:
            paths[name] = truth
            early = odometry.time[-1] - truth[-1, 0]
            if early > LATEST_TRUTH:
                notes.append(f"{name}: its truth ends {early:.0f} s before its odometry")
        begin = None if truth is None or not known else _start(odometry, truth, name, notes)
        logs.append(RobotLog(name, odometry, seen, begin))
    if not logs:
        raise InputError(f"{folder}: no robot has odometry (RobotN_Odometry.dat)")
    return Mission(
        robots=tuple(logs),
        classes=names,
        dynamic=np.zeros(len(names), np.bool_),
        similarity=np.eye(len(names)),
        identity=identity,
        truth=Truth(
            landmarks,
            paths,
            {s: names[feature_of[int(s)]] for s in landmarks},
        ),
    ), notes


def _barcodes(folder: Path, notes: list[str]) -> dict[int, int]:
    """Barcode -> subject."""
    path = find_file(folder, "Barcodes.dat")
    if path is None:
        raise InputError(
            f"{folder}: this is no MRCLAM set: there is no Barcodes.dat in it, plain or .gz"
        )
    table = read_table(path, ("subject", "barcode"), notes)
    found: dict[int, int] = {}
    for row, line in zip(table.values.tolist(), table.line.tolist(), strict=True):
        subject, barcode = map(int, row)
        if [subject, barcode] != row:
            raise InputError(f"{path}: line {line}: subject and barcode must be whole numbers")
        if found.setdefault(barcode, subject) != subject:
            raise InputError(f"{path}: line {line}: barcode {barcode} is of two subjects")
    return found


def _landmarks(folder: Path, notes: list[str]) -> dict[str, tuple[float, float]]:
    path = find_file(folder, "Landmark_Groundtruth.dat")
    if path is None:
        notes.append("Landmark_Groundtruth.dat is missing: no truth of the landmarks")
        return {}
    columns = ("subject", "x", "y", "x std-dev", "y std-dev")
    values = read_table(path, columns, notes).values
    return {str(int(row[0])): (float(row[1]), float(row[2])) for row in values}


def _robots(folder: Path) -> list[int]:
    """Numbers of the robots that have any file, in order."""
    names = (re.match(r"Robot(\d+)_\w+\.dat(\.gz)?$", path.name) for path in folder.iterdir())
    return sorted({int(found[1]) for found in names if found})


def _table(folder: Path, file: str, columns: tuple[str, ...], notes: list[str]) -> Table | None:
    """A table by time, without repeats, or None where the file is missing."""
    path = find_file(folder, file)
    if path is None:
        return None
    table = read_table(path, columns, notes)
    kept = without_repeats(table.values, file, notes)
    kept = kept[in_order(table.values[kept, 0], file, notes)]
    return Table(table.values[kept], table.line[kept])


def _odometry(folder: Path, n: int, notes: list[str]) -> Odometry | None:
    """Velocities, integrated: each row holds until the next; its step is the time between them."""
    file = f"Robot{n}_Odometry.dat"
    table = _table(folder, file, ("time", "forward velocity", "angular velocity"), notes)
    if table is None or not len(table):
        notes.append(f"{file} is missing or has no rows: Robot {n} is left out")
        return None
    time, forward, turning = table.values[one_a_time(table.values[:, 0], file, notes)].T
    step = np.diff(time)
    gaps = step[step > LONGEST_STEP]
    if len(gaps):
        notes.append(
            f"{file}: {count(len(gaps), 'gap')} of more than {LONGEST_STEP:g} s, the longest "
            f"{gaps.max():.3g} s; the last velocity holds through it"
        )
    pose = chain((0, 0, 0), arcs(forward[:-1], turning[:-1], step))
    return Odometry(time.copy(), pose, NOISE)


def _truth(folder: Path, n: int, notes: list[str]) -> Floats | None:
    file = f"Robot{n}_Groundtruth.dat"
    table = _table(folder, file, ("time", "x", "y", "orientation"), notes)
    if table is None or not len(table):
        notes.append(f"{file} is missing or has no rows: neither truth nor start of Robot {n}")
        return None
    values: Floats = table.values[one_a_time(table.values[:, 0], file, notes)]
    return values


def _start(odometry: Odometry, truth: Floats, name: str, notes: list[str]) -> Pose | None:
    """The true pose when odometry begins; where truth begins a little later, driven back to it."""
    first = odometry.time[0]
    late = truth[0, 0] - first
    if late > LATEST_TRUTH or truth[-1, 0] < first:
        notes.append(f"{name}: no truth near the first odometry, so its start is not known")
        return None
    at = pose_at(truth[:, 0], truth[:, 1:], first)
    if late > 0:
        then = pose_at(odometry.time, odometry.pose, truth[0, 0])
        at = compose(truth[0, 1:], between(then, odometry.pose[0]))
        notes.append(f"{name}: truth begins {late:.2f} s late; odometry leads back to the start")
    return float(at[0]), float(at[1]), float(at[2])


def _seen(
    folder: Path,
    n: int,
    subject_of: dict[int, int],
    feature_of: dict[int, int],
    hidden: bool,
    begun: float,
    notes: list[str],
) -> tuple[Measurements, NDArray[np.object_]]:
    """What a robot saw, and what each row is of."""
    file = f"Robot{n}_Measurement.dat"
    table = _table(folder, file, ("time", "barcode", "range", "bearing"), notes)
    if table is None:
        notes.append(f"{file} is missing: Robot {n} saw nothing")
        table = Table(np.zeros((0, 4)), np.zeros(0, np.int64))
    values = table.values
    subject: Ints = np.array([subject_of.get(int(b), 0) for b in values[:, 1]], np.int64)
    known = (subject != 0) & (subject != n)
    for wrong, what in (
        (subject == 0, "with a barcode that nobody has"),
        (subject == n, "of the robot itself"),
        (known & (values[:, 2] < 0), "with a range below 0"),
        (known & (values[:, 0] < begun), "from before the first odometry"),
    ):
        if wrong.any():
            lines = f"the first in line {table.line[wrong].min()}"
            rows = count(int(wrong.sum()), "measurement")
            notes.append(f"{file}: {rows} {what} left out, {lines}")
    good = known & (values[:, 2] >= 0) & (values[:, 0] >= begun)
    values, subject = values[good], subject[good]
    names = [f"Robot {s}" if s <= ROBOTS else str(s) for s in subject.tolist()]
    identity = np.array(names, object)
    return Measurements(
        time=values[:, 0].copy(),
        range=values[:, 2].copy(),
        bearing=values[:, 3].copy(),
        feature=np.array([feature_of.get(s, ROBOT) for s in subject.tolist()], np.int64),
        confidence=np.ones(len(values)),
        key=np.full(len(values), "", object) if hidden else identity.copy(),
        sigma_range=SIGMA_RANGE,
        sigma_bearing=SIGMA_BEARING,
    ), identity
