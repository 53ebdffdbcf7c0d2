"""EdgeIncrement: what is new in a robot's pose graph; edge agents send it to the control agent."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from symboslam.engine.readers.checks import LONGEST_ID, UNWRITABLE
from symboslam.engine.slam.log import FINEST, Floats, Ints, Pose
from symboslam.errors import InputError

AHEAD = 1000
"""An increment is numbered at most so far beyond the highest that has come of its run: robots send
in order, so what lies farther ahead is a mistake, and what it would wait for does not come."""
MOST_ROWS = 10_000_000
"""Sightings of one run are numbered below it: a month of a robot that sees four things a second."""
_FARTHEST = 1e12
"""Metres, and seconds since 1970; nothing reaches farther."""
_MOST = 2**53
"""Numbers below it are exact in every JSON reader."""


@dataclass(frozen=True)
class EdgeIncrement:
    """A piece of one robot's pose graph: key poses that follow each other, and what was seen there.

    Attributes:
        robot: its name.
        run: names one run of one robot; two robots with the same name differ in it.
        sequence: number of the increment in its run, from 0.
        start: where the run began, in the collective frame; None if not known.
        start_sigma: standard deviations of that.
        first: number of the first key pose here.
        time: (k,) seconds.
        step: (k, 3) from the key pose before, in its frame; zeros for the very first.
        sigma: (k, 3) standard deviations of the steps.
        row: (m,) number of each sighting in its run.
        seen: (m,) seconds, when it was made.
        pose: (m,) number of the key pose that it is made from.
        range: (m,) metres; NaN for none.
        bearing: (m,) radians; NaN for none.
        sigma_range: (m,) metres.
        sigma_bearing: (m,) radians.
        feature: (m,) class by name; "" for a robot.
        confidence: (m,) of the class.
        key: (m,) what names it beyond doubt; "" for none.
        track: (m,) sightings that the robot holds for one thing, seen without a break; -1 for none.
        fix_pose: (g,) number of the key pose of each position from outside.
        fix: (g, 3) x, y and standard deviation in metres.
        last: nothing more comes from this run.
    """

    robot: str
    run: str
    sequence: int
    start: Pose | None
    start_sigma: Pose
    first: int
    time: Floats
    step: Floats
    sigma: Floats
    row: Ints
    seen: Floats
    pose: Ints
    range: Floats
    bearing: Floats
    sigma_range: Floats
    sigma_bearing: Floats
    feature: NDArray[np.object_]
    confidence: Floats
    key: NDArray[np.object_]
    track: Ints
    fix_pose: Ints
    fix: Floats
    last: bool = False

    def to_json(self) -> dict[str, Any]:
        """As JSON values; NaN is written as null."""
        found: dict[str, Any] = {}
        for each in fields(self):
            value = getattr(self, each.name)
            if isinstance(value, np.ndarray):
                value = value.tolist()
            elif isinstance(value, tuple):
                value = [float(v) for v in value]
            found[each.name] = value
        for name in ("range", "bearing"):
            found[name] = [None if v != v else v for v in found[name]]
        return found

    @classmethod
    def from_json(cls, value: Mapping[str, Any]) -> EdgeIncrement:
        """Read what `to_json` wrote.

        Raises:
            InputError: not an increment; the message says what is wrong.
        """
        known = [each.name for each in fields(cls)]
        for name in value:
            if name not in known:
                raise InputError(f"it has a member {name[:40]!r} that no increment has")
        for name in known:
            if name not in value:
                raise InputError(f"it has no {name}")
        columns: dict[str, Any] = {}
        for names, read in _COLUMNS:
            columns |= {name: read(value, name) for name in names}
        found = cls(
            robot=_name(value, "robot"),
            run=_name(value, "run"),
            sequence=_count(value, "sequence"),
            start=None if value["start"] is None else _pose(value, "start"),
            start_sigma=_pose(value, "start_sigma"),
            first=_count(value, "first"),
            last=_truth(value, "last"),
            **columns,
        )
        found.check()
        return found

    def check(self) -> None:
        """Whether the columns make sense together.

        Raises:
            InputError: they do not; says which, and where.
        """
        for number, names in (
            (len(self.time), ("time", "step", "sigma")),
            (len(self.row), (
                "row", "seen", "pose", "range", "bearing", "sigma_range", "sigma_bearing",
                "feature", "confidence", "key", "track",
            )),
            (len(self.fix_pose), ("fix_pose", "fix")),
        ):  # fmt: skip
            for name in names:
                if len(getattr(self, name)) != number:
                    raise InputError(
                        f"{name} has {len(getattr(self, name))} rows, {names[0]} has {number}"
                    )
        begins = self.first == 0 and len(self.sigma) > 0  # nothing leads to the very first pose
        spread = self.sigma[1:] if begins else self.sigma
        poses = self.first + len(self.time)
        _all(np.array(self.start_sigma) > 0, "start_sigma", "not above 0")
        _all(np.diff(self.time) > 0, "time", "not after the one before", 1)
        _all((spread > 0).all(1), "sigma", "not above 0", int(begins))
        _all((self.sigma >= 0).all(1), "sigma", "below 0")
        _all(self.row >= 0, "row", "below 0")
        _all(self.row < MOST_ROWS, "row", f"not below {MOST_ROWS}")
        if len(np.unique(self.row)) < len(self.row):
            raise InputError("row has a number twice")
        for name in ("pose", "fix_pose"):
            number = getattr(self, name)
            _all((number >= 0) & (number < poses), name, f"not the number of a pose below {poses}")
        _all(~(self.range < 0), "range", "below 0")
        for name in ("sigma_range", "sigma_bearing"):
            _all(getattr(self, name) >= FINEST, name, f"not {FINEST:g} or more")
        _all(self.fix[:, 2] >= FINEST, "fix", f"of a deviation that is not {FINEST:g} or more")
        _all((self.confidence > 0) & (self.confidence <= 1), "confidence", "not in (0, 1]")
        _all(self.track >= -1, "track", "below -1")


def _all(right: ArrayLike, name: str, problem: str, offset: int = 0) -> None:
    valid = np.asarray(right, np.bool_)
    if not valid.all():
        raise InputError(f"{name}: row {int(np.argmin(valid)) + offset} is {problem}")


def _text(value: object, name: str) -> str:
    if not isinstance(value, str) or len(value) > LONGEST_ID or UNWRITABLE.search(value):
        raise InputError(f"{name} is no text of at most {LONGEST_ID} characters")
    return value


def _name(value: Mapping[str, Any], name: str) -> str:
    found = _text(value[name], name)
    if not found or not found.isprintable():
        raise InputError(f"{name} is empty, or has characters that do not print")
    return found


def _is_number(value: object) -> bool:
    return type(value) in (int, float) and abs(value) <= _FARTHEST  # type: ignore[arg-type]


def _is_whole(value: object) -> bool:
    return type(value) is int and abs(value) < _MOST


def _count(value: Mapping[str, Any], name: str) -> int:
    found = value[name]
    if not _is_whole(found) or found < 0:
        raise InputError(f"{name} is no whole number from 0 on")
    return int(found)


def _truth(value: Mapping[str, Any], name: str) -> bool:
    found = value[name]
    if not isinstance(found, bool):
        raise InputError(f"{name} is neither true nor false")
    return found


def _list(value: Mapping[str, Any], name: str) -> list[Any]:
    found = value[name]
    if not isinstance(found, list):
        raise InputError(f"{name} is no list")
    return found


def _pose(value: Mapping[str, Any], name: str) -> Pose:
    found = _list(value, name)
    if len(found) != 3 or not all(map(_is_number, found)):
        raise InputError(f"{name} is not three numbers")
    x, y, heading = map(float, found)
    return x, y, heading


def _numbers(value: Mapping[str, Any], name: str) -> Floats:
    found = _list(value, name)
    for row, each in enumerate(found):
        if not _is_number(each):
            raise InputError(f"{name}: row {row} is no finite number")
    return np.array(found, np.float64)


def _numbers_or_nothing(value: Mapping[str, Any], name: str) -> Floats:
    found = _list(value, name)
    for row, each in enumerate(found):
        if each is not None and not _is_number(each):
            raise InputError(f"{name}: row {row} is neither a finite number nor null")
    return np.array([np.nan if each is None else each for each in found], np.float64)


def _triples(value: Mapping[str, Any], name: str) -> Floats:
    found = _list(value, name)
    for row, each in enumerate(found):
        if not isinstance(each, list) or len(each) != 3 or not all(map(_is_number, each)):
            raise InputError(f"{name}: row {row} is not three finite numbers")
    return np.array(found, np.float64).reshape(-1, 3)


def _whole(value: Mapping[str, Any], name: str) -> Ints:
    found = _list(value, name)
    for row, each in enumerate(found):
        if not _is_whole(each):
            raise InputError(f"{name}: row {row} is no whole number")
    return np.array(found, np.int64)


def _texts(value: Mapping[str, Any], name: str) -> NDArray[np.object_]:
    found = _list(value, name)
    column = np.empty(len(found), object)
    column[:] = [_text(each, f"{name}: row {row}") for row, each in enumerate(found)]
    return column


_COLUMNS: tuple[tuple[tuple[str, ...], Callable[[Mapping[str, Any], str], Any]], ...] = (
    (("time", "seen", "sigma_range", "sigma_bearing", "confidence"), _numbers),
    (("range", "bearing"), _numbers_or_nothing),
    (("step", "sigma", "fix"), _triples),
    (("row", "pose", "track", "fix_pose"), _whole),
    (("feature", "key"), _texts),
)
"""How each column is read."""
