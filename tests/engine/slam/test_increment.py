"""EdgeIncrement: written as JSON and read again; what is wrong is refused with what and where."""

import json
from dataclasses import fields
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symboslam.engine.slam.increment import EdgeIncrement
from symboslam.errors import InputError

FAR = st.floats(-1e6, 1e6)
ABOVE = st.floats(1e-6, 1e3)
NAME = st.text(st.characters(codec="utf-8", categories=("L", "N", "P")), min_size=1, max_size=12)


def objects(values: list[str]) -> Any:
    column = np.empty(len(values), object)
    column[:] = values
    return column


@st.composite
def increments(draw: st.DrawFn) -> EdgeIncrement:
    k, m, g = (draw(st.integers(0, 4)) for _ in range(3))
    first = draw(st.integers(0, 10))
    m, g = (0 if first + k == 0 else n for n in (m, g))

    def column(of: st.SearchStrategy[Any], n: int, dtype: Any = np.float64) -> Any:
        return np.array(draw(st.lists(of, min_size=n, max_size=n)), dtype)

    def table(of: st.SearchStrategy[float], n: int) -> Any:
        return column(of, 3 * n).reshape(-1, 3)

    pose = st.integers(0, max(first + k - 1, 0))
    row = draw(st.lists(st.integers(0, 99), min_size=m, max_size=m, unique=True))
    return EdgeIncrement(
        robot=draw(NAME), run=draw(NAME), sequence=draw(st.integers(0, 2**40)),
        start=draw(st.none() | st.tuples(FAR, FAR, FAR)),
        start_sigma=draw(st.tuples(ABOVE, ABOVE, ABOVE)), first=first,
        time=np.cumsum(column(st.floats(0.01, 10), k)), step=table(FAR, k), sigma=table(ABOVE, k),
        row=np.array(row, np.int64), seen=column(FAR, m), pose=column(pose, m, np.int64),
        range=column(st.floats(0, 100) | st.just(float("nan")), m),
        bearing=column(st.floats(-4, 4) | st.just(float("nan")), m),
        sigma_range=column(ABOVE, m), sigma_bearing=column(ABOVE, m),
        feature=objects(draw(st.lists(NAME | st.just(""), min_size=m, max_size=m))),
        confidence=column(st.floats(0.01, 1), m),
        key=objects(draw(st.lists(NAME | st.just(""), min_size=m, max_size=m))),
        track=column(st.integers(-1, 9), m, np.int64),
        fix_pose=column(pose, g, np.int64), fix=table(ABOVE, g), last=draw(st.booleans()),
    )  # fmt: skip


@given(increments())
def test_what_is_written_is_read_again(increment: EdgeIncrement) -> None:
    text = json.dumps(increment.to_json(), allow_nan=False)
    again = EdgeIncrement.from_json(json.loads(text))
    for each in fields(EdgeIncrement):
        one, two = getattr(increment, each.name), getattr(again, each.name)
        if isinstance(one, np.ndarray):
            assert one.dtype == two.dtype
            assert one.shape == two.shape
            np.testing.assert_array_equal(one, two)
        else:
            assert one == two
    assert json.dumps(again.to_json()) == text


GOOD = EdgeIncrement(
    "r1", "a", 3, (1.0, 2.0, 0.5), (0.1, 0.1, 0.1), 4, np.array([1.0, 2.0]), np.ones((2, 3)),
    np.ones((2, 3)), np.array([7]), np.array([2.5]), np.array([5]), np.array([np.nan]),
    np.array([0.5]),
    np.array([0.5]), np.array([0.1]), objects(["House"]), np.array([0.9]), objects([""]),
    np.array([-1]), np.array([4]), np.ones((1, 3)),
).to_json()  # fmt: skip


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("robot", "", "robot is empty"), ("robot", "a\nb", "do not print"),
        ("run", "x" * 300, "at most 256"), ("run", 7, "run is no text"),
        ("sequence", -1, "sequence"), ("sequence", True, "sequence"), ("sequence", 2**60, "seque"),
        ("sequence", 3.0, "sequence is no whole number from 0 on"), ("sequence", "3", "sequence"),
        ("row", [10_000_000], "row: row 0 is not below 10000000"),
        ("start", [1, 2], "three numbers"), ("start", [1, 2, float("inf")], "three numbers"),
        ("start_sigma", [1, 0, 1], "start_sigma: row 1 is not above 0"),
        ("time", [2.0, 2.0], "time: row 1 is not after"), ("time", [1.0], "step has 2 rows"),
        ("time", [1.0, None], "time: row 1 is no finite"), ("time", "now", "time is no list"),
        ("step", [[1, 2, 3], [1, 2]], "step: row 1 is not three"),
        ("step", [[1, 2, 3], [1, 2, float("nan")]], "step: row 1 is not three"),
        ("sigma", [[1, 1, 1], [1, 0, 1]], "sigma: row 1 is not above 0"),
        ("pose", [6], "pose: row 0 is not the number of a pose below 6"),
        ("fix_pose", [-1], "fix_pose: row 0"), ("fix", [[1, 1, 0]], "fix: row 0"),
        ("range", [-1.0], "range: row 0 is below 0"), ("bearing", ["x"], "bearing: row 0"),
        ("sigma_range", [0], "sigma_range: row 0"), ("confidence", [1.5], "confidence: row 0"),
        ("feature", [None], "feature: row 0 is no text"), ("key", [], "key has 0 rows"),
        ("track", [-2], "track: row 0"), ("track", [1.5], "track: row 0 is no whole"),
        ("last", 1, "last is neither"), ("colour", "red", "a member 'colour'"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_refused(name: str, value: object, said: str) -> None:
    EdgeIncrement.from_json(GOOD)
    with pytest.raises(InputError, match=None) as found:
        EdgeIncrement.from_json({**GOOD, name: value})
    assert said in str(found.value)


def test_every_member_has_to_be_there() -> None:
    for name in GOOD:
        with pytest.raises(InputError, match=f"it has no {name}"):
            EdgeIncrement.from_json({k: v for k, v in GOOD.items() if k != name})


def test_rows_are_numbered_once() -> None:
    twice = {
        **GOOD, "row": [7, 7],
        **{name: GOOD[name] * 2 for name in (
            "seen", "pose", "range", "bearing", "sigma_range", "sigma_bearing", "feature",
            "confidence", "key", "track",
        )},
    }  # fmt: skip
    with pytest.raises(InputError, match="twice"):
        EdgeIncrement.from_json(twice)


def test_nothing_leads_to_the_very_first_pose() -> None:
    zeros = [[0, 0, 0], [1, 1, 1]]
    EdgeIncrement.from_json({**GOOD, "first": 0, "pose": [1], "fix_pose": [0], "sigma": zeros})
    with pytest.raises(InputError, match="sigma: row 0"):
        EdgeIncrement.from_json({**GOOD, "sigma": zeros})
