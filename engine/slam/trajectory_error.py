"""Errors of trajectories: ATE and RPE (Sturm et al. 2012), with the definitions of evo.

J. Sturm et al.: A benchmark for the evaluation of RGB-D SLAM systems, IROS 2012. The numbers equal
those of evo (github.com/MichaelGrupp/evo) for poses in a plane, with one exception: evo aligns in
space, where turning the plane over is a rotation too, so that a path that is nearer to the mirrored
truth gets a smaller ATE from evo. Here a mirrored path is a wrong path.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from symboslam.engine.slam.error_statistics import Statistics
from symboslam.engine.slam.log import Floats, Ints
from symboslam.engine.slam.planar import between, place, rigid
from symboslam.errors import InputError

MAX_DIFF = 0.01
"""Seconds that two time stamps of one moment may differ by (evo's default)."""
UNITS = {"f": "frames", "s": "seconds", "m": "metres"}


@dataclass(frozen=True)
class Delta:
    """How far apart the two poses of a relative error are.

    Attributes:
        value: > 0; whole for frames.
        unit: "f" frames, "s" seconds, "m" metres of the estimated way.
    """

    value: float = 1.0
    unit: str = "m"

    def __post_init__(self) -> None:
        if self.unit not in UNITS:
            raise InputError(f"delta in {self.unit!r}: give f (frames), s (seconds) or m (metres)")
        if not 0 < self.value < np.inf or (self.unit == "f" and self.value % 1):
            raise InputError(f"delta {self}: give a number > 0, of frames a whole one")

    def __str__(self) -> str:
        return f"{self.value:g}{self.unit}"

    @classmethod
    def parse(cls, text: str) -> Delta:
        """Read ``1m``, ``0.5s`` or ``10f``.

        Raises:
            InputError: anything else.
        """
        found = re.fullmatch(r"\s*(\d+\.?\d*|\.\d+)\s*([fsm])\s*", text)
        if not found:
            raise InputError(f"delta {text!r}: give a number and f, s or m, such as 1m, 10s or 5f")
        return cls(float(found[1]), found[2])


ONE_METRE = Delta()


@dataclass(frozen=True)
class TrajectoryScore:
    """How far a trajectory is off.

    Attributes:
        poses: how many poses have a true one within the time difference.
        ate: metres between estimated and true positions, after the alignment; None where fewer
            than two poses can be compared.
        ate_raw: the same without alignment; None without any pose.
        alignment: (3,) pose that was applied to the estimate; None as ``ate``.
        rpe_translation: metres; None where the way is shorter than the delta.
        rpe_rotation: radians; None as before.
        delta: what the relative errors are over.
    """

    poses: int
    ate: Statistics | None
    ate_raw: Statistics | None
    alignment: Floats | None
    rpe_translation: Statistics | None
    rpe_rotation: Statistics | None
    delta: Delta


def score_trajectory(
    time: Floats,
    pose: Floats,
    truth: Floats,
    *,
    max_diff: float = MAX_DIFF,
    delta: Delta = ONE_METRE,
) -> TrajectoryScore:
    """ATE and RPE of one trajectory.

    Args:
        time: (n,) seconds, increasing.
        pose: (n, 3) x, y, heading.
        truth: (m, 4) time, x, y, heading; by increasing time.
        max_diff: seconds; see ``associate``.
        delta: what the relative errors are over.
    """
    i, j = associate(time, truth[:, 0], max_diff)
    found, true = pose[i], truth[j, 1:]
    alignment = ate = None
    if len(i) >= 2:
        alignment = rigid(found[:, :2], true[:, :2])
        ate = Statistics.of(distances(place(alignment, found[:, :2]), true[:, :2]))
    error = relative_errors(found, true, pairs_of(time[i], found, delta))
    return TrajectoryScore(
        poses=len(i),
        ate=ate,
        ate_raw=Statistics.of(distances(found[:, :2], true[:, :2])),
        alignment=alignment,
        rpe_translation=Statistics.of(np.hypot(error[:, 0], error[:, 1])),
        rpe_rotation=Statistics.of(np.abs(error[:, 2])),
        delta=delta,
    )


def distances(a: Floats, b: Floats) -> Floats:
    """(n,) distances of (n, 2) points to (n, 2) others."""
    return np.asarray(np.hypot(*(a - b).T))


def associate(first: Floats, second: Floats, max_diff: float = MAX_DIFF) -> tuple[Ints, Ints]:
    """Positions of the stamps in two columns that are of one moment.

    As evo: each stamp of the shorter column (of equal ones the first) takes the nearest of the
    longer, of equally near ones the earlier, if it is no more than ``max_diff`` away.

    Args:
        first: (n,) seconds, not decreasing.
        second: (m,) seconds, not decreasing.
        max_diff: seconds.

    Returns:
        (k,) positions in the first column, and (k,) in the second.
    """
    if len(first) > len(second):
        longer, shorter = associate(second, first, max_diff)[::-1]
        return longer, shorter
    if not len(first):
        return np.empty(0, np.int64), np.empty(0, np.int64)
    after = np.searchsorted(second, first, side="right").clip(max=len(second) - 1)
    before = np.maximum(after - 1, 0)
    to_after, to_before = np.abs(second[after] - first), np.abs(first - second[before])
    nearest = np.where(to_after < to_before, after, before)
    near = np.flatnonzero(np.minimum(to_after, to_before) <= max_diff)
    return near.astype(np.int64), nearest[near].astype(np.int64)


def pairs_of(time: Floats, pose: Floats, delta: Delta) -> Ints:
    """(k, 2) positions of poses that are ``delta`` apart, each pair beginning where one ends.

    As evo without ``--all_pairs``: the next pose is the first at which the way, or the time, since
    the last is at least the delta; the way is that of the estimate, pose by pose.

    Args:
        time: (n,) seconds.
        pose: (n, 3) estimated poses.
        delta: how far apart.
    """
    if delta.unit == "f":
        ends = list(range(0, len(pose), int(delta.value)))
    else:
        steps = np.diff(time) if delta.unit == "s" else distances(pose[1:, :2], pose[:-1, :2])
        ends, way = [0], 0.0
        for i, step in enumerate(steps.tolist(), 1):
            way += step
            if way >= delta.value:
                ends.append(i)
                way = 0.0
    return np.column_stack([ends[:-1], ends[1:]]).astype(np.int64).reshape(-1, 2)


def relative_errors(pose: Floats, truth: Floats, pairs: Ints) -> Floats:
    """(k, 3) errors of the estimated steps in the frame of the true ones (Sturm 2012, eq. 1).

    Args:
        pose: (n, 3) estimated poses.
        truth: (n, 3) true ones of the same moments.
        pairs: (k, 2) positions of the poses between which the steps are.
    """
    i, j = pairs.T
    return between(between(truth[i], truth[j]), between(pose[i], pose[j]))
