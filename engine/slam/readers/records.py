"""Records: what a robot writes down as it drives, one line of JSON each, in the order of time."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from typing import Any

from symboslam.engine.slam.log import FINEST, ROBOT, Pose, RobotLog
from symboslam.errors import InputError

ROBOT_CLASS = "Robot"
"""What a record calls a robot that was seen, unless the ontology has such a feature."""
_FARTHEST = 1e12
_SHOWN = 5
"""Bad lines that are told one by one."""
_LONGEST = 256


@dataclass(frozen=True)
class OdometryRecord:
    """Where a robot believes to be.

    Attributes:
        time: seconds.
        pose: x, y in metres, heading in radians, in the robot's own frame.
    """

    time: float
    pose: Pose


@dataclass(frozen=True)
class SightingRecord:
    """Something that a robot saw.

    Attributes:
        time: seconds.
        range: metres; NaN for none.
        bearing: radians from the robot's heading; NaN for none.
        feature: its class by name; `ROBOT_CLASS` for a robot.
        confidence: of the class, in (0, 1].
        key: what names it beyond doubt, such as the text of a sign; "" for none.
        sigma: standard deviations of range (metres) and bearing (radians); None for the robot's.
    """

    time: float
    range: float
    bearing: float
    feature: str
    confidence: float = 1.0
    key: str = ""
    sigma: tuple[float, float] | None = None


@dataclass(frozen=True)
class FixRecord:
    """A position from outside, such as GPS.

    Attributes:
        time: seconds.
        x: metres in the collective frame.
        y: metres in the collective frame.
        sigma: standard deviation in metres.
    """

    time: float
    x: float
    y: float
    sigma: float


Record = OdometryRecord | SightingRecord | FixRecord
_MEMBERS = {
    "odometry": {"odometry"},
    "fix": {"fix"},
    "class": {"class", "range", "bearing", "confidence", "key", "sigma"},
}


def parse(line: str) -> Record:
    """A record of its line.

    Raises:
        InputError: it is none; says what is wrong.

    >>> parse('{"time": 3, "odometry": [1, 2, 0.5]}')
    OdometryRecord(time=3.0, pose=(1.0, 2.0, 0.5))
    """
    try:
        value = json.loads(line)
    except (ValueError, RecursionError) as error:
        raise InputError(f"it is no JSON: {error}") from error
    if not isinstance(value, dict):
        raise InputError("it is no JSON object")
    kinds = [kind for kind in _MEMBERS if kind in value]
    if len(kinds) != 1:
        raise InputError("it has not one of odometry, class and fix")
    unknown = sorted(set(value) - _MEMBERS[kinds[0]] - {"time"})
    if unknown:
        raise InputError(f"a record with {kinds[0]} has no member {unknown[0][:40]!r}")
    time = _number(value, "time")
    if kinds == ["odometry"]:
        return OdometryRecord(time, _three(value, "odometry"))
    if kinds == ["fix"]:
        x, y, sigma = _three(value, "fix")
        if sigma <= 0:
            raise InputError("the deviation of fix is not above 0")
        return FixRecord(time, x, y, sigma)
    return _sighting(value, time)


def _sighting(value: dict[str, Any], time: float) -> SightingRecord:
    feature, key = value["class"], value.get("key") or ""
    for text, name in ((feature, "class"), (key, "key")):
        if not isinstance(text, str) or len(text) > _LONGEST:
            raise InputError(f"{name} is no text of at most {_LONGEST} characters")
    distance, bearing = (
        math.nan if value.get(name) is None else _number(value, name)
        for name in ("range", "bearing")
    )
    if math.isnan(distance) and math.isnan(bearing):
        raise InputError("it has neither a range nor a bearing")
    if distance < 0:
        raise InputError("range is below 0")
    confidence = _number(value, "confidence") if "confidence" in value else 1.0
    if not 0 < confidence <= 1:
        raise InputError("confidence is not in (0, 1]")
    sigma = _sigma(value["sigma"]) if value.get("sigma") is not None else None
    return SightingRecord(time, distance, bearing, feature, confidence, key, sigma)


def _sigma(found: object) -> tuple[float, float]:
    if not isinstance(found, list) or len(found) != 2 or not all(map(_is_number, found)):
        raise InputError("sigma is not two finite numbers")
    of_range, of_bearing = map(float, found)
    if min(of_range, of_bearing) < FINEST:
        raise InputError(f"sigma is not {FINEST:g} or more")
    return of_range, of_bearing


def _is_number(value: object) -> bool:
    return type(value) in (int, float) and abs(value) <= _FARTHEST  # type: ignore[arg-type]


def _number(value: dict[str, Any], name: str) -> float:
    found = value.get(name)
    if not _is_number(found):
        raise InputError(f"{name} is no finite number")
    return float(found)  # type: ignore[arg-type]


def _three(value: dict[str, Any], name: str) -> Pose:
    found = value[name]
    if not isinstance(found, list) or len(found) != 3 or not all(map(_is_number, found)):
        raise InputError(f"{name} is not three finite numbers")
    x, y, last = map(float, found)
    return x, y, last


def read(lines: Iterable[str], name: str, tell: Callable[[str], None]) -> Iterator[Record]:
    """The records of a robot's log; bad lines are told and passed over.

    Args:
        lines: of the log.
        name: of the log, for messages.
        tell: is told what is wrong.

    Raises:
        InputError: no line at all is a record, and there are some.
    """
    first, bad, good = "", 0, 0
    for number, line in enumerate(lines, 1):
        if not line.strip():
            continue
        try:
            record = parse(line)
        except InputError as error:
            bad += 1
            first = first or f"line {number}: {error}"
            if bad <= _SHOWN:
                tell(f"{name}: line {number} is left out: {error}")
            continue
        good += 1
        yield record
    if bad and not good:
        raise InputError(f"{name} is no log of a robot: {first}")
    if bad > _SHOWN:
        tell(f"{name}: {bad} lines in all were left out")


def of_log(log: RobotLog, classes: tuple[str, ...]) -> Iterator[Record]:
    """A robot's log as the records that the robot would have written.

    Args:
        log: it; relative poses from outside have no records.
        classes: names of the classes, by their position in the log.
    """
    seen, fixes = log.seen, log.fixes
    found: list[tuple[float, int, Record]] = [
        (float(time), 0, OdometryRecord(float(time), (float(x), float(y), float(heading))))
        for time, (x, y, heading) in zip(log.odometry.time, log.odometry.pose, strict=True)
    ]
    for i in range(0 if fixes is None else len(fixes.time)):
        assert fixes is not None
        time, (x, y) = float(fixes.time[i]), fixes.xy[i].tolist()
        found.append((time, 1, FixRecord(time, x, y, float(fixes.sigma[i]))))
    one_for_all = isinstance(seen.sigma_range, float) and isinstance(seen.sigma_bearing, float)
    sigmas: list[list[float]] = seen.sigmas.tolist()
    for i in range(len(seen)):
        time, feature = float(seen.time[i]), int(seen.feature[i])
        name = ROBOT_CLASS if feature == ROBOT else classes[feature]
        sighting = SightingRecord(
            time, float(seen.range[i]), float(seen.bearing[i]), name, float(seen.confidence[i]),
            str(seen.key[i]), None if one_for_all else (sigmas[i][0], sigmas[i][1]),
        )  # fmt: skip
        found.append((time, 2, sighting))
    found.sort(key=lambda each: each[:2])
    return (record for _, _, record in found)
