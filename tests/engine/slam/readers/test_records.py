"""Records of robots: read, and refused with the reason; logs as records."""

import math

import numpy as np
import pytest

from symboslam.engine.slam.log import Fixes, Measurements, Odometry, RobotLog
from symboslam.engine.slam.readers.records import (
    FixRecord,
    OdometryRecord,
    SightingRecord,
    of_log,
    parse,
    read,
)
from symboslam.errors import InputError


def test_records_are_read() -> None:
    assert parse('{"time": 1, "odometry": [1, 2, 0.5]}') == OdometryRecord(1.0, (1.0, 2.0, 0.5))
    assert parse('{"time": 1, "fix": [1, 2, 3]}') == FixRecord(1.0, 1.0, 2.0, 3.0)
    seen = parse('{"time": 1, "class": "House", "range": 5, "bearing": 0.1, "key": "7b"}')
    assert seen == SightingRecord(1.0, 5.0, 0.1, "House", 1.0, "7b")
    sure = parse('{"time": 1, "class": "House", "range": 5, "bearing": 0, "sigma": [0.3, 0.01]}')
    assert sure == SightingRecord(1.0, 5.0, 0.0, "House", sigma=(0.3, 0.01))
    far = parse('{"time": 1, "class": "House", "range": null, "bearing": 0, "confidence": 0.5}')
    assert isinstance(far, SightingRecord)
    assert math.isnan(far.range)
    assert far.confidence == 0.5


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("{", "no JSON"), ("[1]", "no JSON object"), ('{"time": 1}', "not one of"),
        ('{"time": 1, "odometry": [1, 2, 3], "fix": [1, 2, 3]}', "not one of"),
        ('{"odometry": [1, 2, 3]}', "time is no"), ('{"time": true, "fix": [1, 2, 3]}', "time"),
        ('{"time": 1, "odometry": [1, 2]}', "three"), ('{"time": 1, "fix": [1, 2, NaN]}', "three"),
        ('{"time": 1, "fix": [1, 2, 0]}', "not above 0"),
        ('{"time": 1, "class": "House"}', "neither a range nor a bearing"),
        ('{"time": 1, "class": 3, "range": 1}', "class is no text"),
        ('{"time": 1, "class": "House", "range": -1}', "below 0"),
        ('{"time": 1, "class": "House", "range": 1, "confidence": 0}', "confidence"),
        ('{"time": 1, "class": "House", "range": 1, "sigma": 0.5}', "sigma is not two finite"),
        ('{"time": 1, "class": "House", "range": 1, "sigma": [0.5]}', "sigma is not two finite"),
        ('{"time": 1, "class": "House", "range": 1, "sigma": [NaN, 1]}', "sigma is not two finite"),
        ('{"time": 1, "class": "House", "range": 1, "sigma": [0.5, 0]}', "sigma is not 1e-09"),
        ('{"time": 1, "class": "House", "range": 1, "sigma": [-1, 1]}', "sigma is not 1e-09"),
        ('{"time": 1, "class": "House", "range": 1, "colour": 0}', "colour"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_said(line: str, said: str) -> None:
    with pytest.raises(InputError) as found:
        parse(line)
    assert said in str(found.value)


def test_bad_lines_are_told_and_passed_over() -> None:
    told: list[str] = []
    good = '{"time": 1, "odometry": [1, 2, 3]}'
    assert len(list(read([good, "", *["x"] * 9, good], "log", told.append))) == 2
    assert told[0].startswith("log: line 3 is left out: it is no JSON")
    assert told[5:] == ["log: 9 lines in all were left out"]
    with pytest.raises(InputError, match="log is no log of a robot: line 1"):
        list(read(["x"], "log", told.append))
    assert list(read([], "log", told.append)) == []


def test_a_log_is_what_the_robot_would_have_written() -> None:
    objects = np.array(["", "7b"], object)
    log = RobotLog(
        "r1", Odometry(np.array([0.0, 1.0]), np.array([[0, 0, 0], [1, 0, 0.5]], float)),
        Measurements(
            np.array([0.5, 1.0]), np.array([np.nan, 2.0]), np.array([0.1, 0.2]), np.array([0, -1]),
            np.array([0.5, 1.0]), objects,
        ),
        fixes=Fixes(np.array([1.0]), np.array([[5.0, 6.0]]), np.array([2.0])),
    )  # fmt: skip
    found = list(of_log(log, ("House",)))
    assert [type(each) for each in found] == [
        OdometryRecord, SightingRecord, OdometryRecord, FixRecord, SightingRecord
    ]  # fmt: skip
    assert found[4] == SightingRecord(1.0, 2.0, 0.2, "Robot", 1.0, "7b")
    assert found[3] == FixRecord(1.0, 5.0, 6.0, 2.0)


def test_only_what_differs_from_row_to_row_is_said_of_each() -> None:
    objects = np.array(["", ""], object)
    columns = np.array([0.0, 1.0]), np.full(2, 5.0), np.zeros(2), np.zeros(2, np.int64), np.ones(2)
    driven = Odometry(np.array([0.0]), np.zeros((1, 3)))
    for sigma, said in ((0.3, [None, None]), (np.array([0.3, 0.4]), [(0.3, 0.02), (0.4, 0.02)])):
        log = RobotLog("r1", driven, Measurements(*columns, objects, sigma, 0.02))
        found = [r.sigma for r in of_log(log, ("House",)) if isinstance(r, SightingRecord)]
        assert found == said
