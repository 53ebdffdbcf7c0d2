"""KeyPoses: sightings are carried exactly, nothing is lost without being counted, bad rows."""

import math
from collections.abc import Sequence

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symboslam.engine.slam.key_poses import KeyPoses, replay
from symboslam.engine.slam.log import Floats, Measurements, Odometry, OdometryNoise, RobotLog
from symboslam.engine.slam.odometry import pose_at
from symboslam.engine.slam.planar import compose, place
from symboslam.engine.slam.pose_graph import PoseGraph, Sighting

BAD = st.sampled_from([math.nan, math.inf, -math.inf, -1.0, 0.0])


def keys(interval: float = 1.0) -> KeyPoses:
    return KeyPoses(PoseGraph("r"), OdometryNoise(), interval)


def see(
    found: KeyPoses, time: float, reach: float, bearing: float, confidence: float = 0.9
) -> list[Sighting]:
    """Something of class 0 without a key, 0.5 m and 0.02 rad wrong."""
    return found.sighting(time, reach, bearing, 0, confidence, "", 0.5, 0.02)


def driven(found: KeyPoses, poses: int, step: float = 1.0) -> KeyPoses:
    for n in range(poses):
        found.odometry(float(n), n * step, 0.0, 0.0)
    return found


def log(time: Floats, way: Floats, rows: Sequence[Sequence[float]]) -> RobotLog:
    columns = np.array(rows, float).reshape(-1, 4).T
    size = columns.shape[1]
    seen = Measurements(
        columns[0],
        columns[1],
        columns[2],
        np.zeros(size, np.int64),
        columns[3],
        np.full(size, "", object),
    )
    return RobotLog("r", Odometry(time, way), seen)


def walk(seed: int, poses: int) -> tuple[Floats, Floats]:
    rng = np.random.default_rng(seed)
    time = np.cumsum(rng.uniform(0.05, 1.0, poses))
    still = rng.random(poses) < 0.3
    step = np.column_stack([rng.uniform(0, 1, poses), rng.normal(0, 0.1, poses)])
    turn = rng.normal(0, 0.7, poses)
    way = np.zeros((poses, 3))
    way[0] = rng.uniform(-3, 3, 3)
    for n in range(1, poses):
        moved = (0, 0, 0) if still[n] else (step[n, 0], step[n, 1], turn[n])
        way[n] = compose(way[n - 1], moved)
    return time, way


@given(st.integers(0, 10_000), st.sampled_from([0.1, 0.5, 1.0, 3.0]))
def test_key_pose_and_carried_sighting_give_the_point_that_was_seen(
    seed: int, interval: float
) -> None:
    time, way = walk(seed, 12)
    rng = np.random.default_rng(seed + 1)
    rows = np.column_stack(
        [
            rng.uniform(time[0], time[-1], 15),
            rng.uniform(0.5, 20, 15),
            rng.uniform(-3, 3, 15),
            np.ones(15),
        ]
    )
    found = keys(interval)
    sightings = [s for some in replay(log(time, way, rows.tolist()), found) for s in some]
    assert sorted(s.row for s in sightings) == list(range(15))
    assert not found.problems
    for s in sightings:
        when, reach, bearing, _ = rows[s.row]
        true = place(
            pose_at(time, way, when), (reach * math.cos(bearing), reach * math.sin(bearing))
        )
        key = compose(found.graph.origin, found.graph.odometry[s.pose])
        assert place(key, s.point) == pytest.approx(true, abs=1e-6)
        assert found.graph.time[s.pose] <= when + 1e-6


@given(
    st.integers(0, 100),
    st.lists(
        st.tuples(
            st.floats(-5, 30) | BAD, st.floats(-1, 50) | BAD, st.floats(-4, 4) | BAD,
            st.floats(-0.5, 1.5) | BAD,
        ),
        max_size=25,
    ),
    st.integers(0, 15),
)  # fmt: skip
def test_no_row_is_lost_without_being_counted(
    seed: int, rows: list[tuple[float, float, float, float]], poses: int
) -> None:
    time, way = walk(seed, max(poses, 1))
    found = keys()
    sightings = [s for each in replay(log(time[:poses], way[:poses], rows), found) for s in each]
    left_out = sum(n for what, n in found.problems.items() if what.startswith("measurements"))
    assert len(sightings) + left_out == len(rows)
    assert len({s.row for s in sightings}) == len(sightings)
    assert sightings == found.graph.sightings


def test_a_robot_that_stands_still_has_one_key_pose() -> None:
    found = driven(keys(), 10, step=0.0)
    assert len(found.graph) == 1


def test_key_poses_lie_on_a_grid_that_all_robots_share() -> None:
    found = keys(0.5)
    for n in range(12):
        found.odometry(10.1 + 0.3 * n, n, 0, 0)
    time = found.graph.time
    assert time[0] == 10.1
    assert [t * 2 % 1 for t in time[1:]] == pytest.approx([0.0] * (len(time) - 1))
    assert min(np.diff(time)[1:]) == pytest.approx(0.5)


def test_a_sighting_waits_until_odometry_says_where_it_was_made() -> None:
    found = driven(keys(), 3)
    assert see(found, 2.5, 4.0, 0.0) == []
    (seen,) = found.odometry(3.0, 3.0, 0.0, 0.0)
    assert seen.pose == 2
    assert (seen.range, seen.bearing) == pytest.approx((4.5, 0))


def test_a_bearing_alone_gets_a_key_pose_of_its_own() -> None:
    found = keys(10)
    found.odometry(0, 0, 0, 0)
    see(found, 1, math.nan, 0.3)
    (seen,) = found.odometry(2, 0, 0, 1.0)
    assert math.isnan(seen.range)
    assert (seen.pose, seen.bearing) == (1, 0.3)
    assert found.graph.time == [0, 1]
    assert found.graph.odometry[1].tolist() == pytest.approx([0, 0, 0.5])


def test_what_is_seen_at_a_key_pose_is_seen_from_it() -> None:
    found = keys(0.5)
    found.odometry(1.2e9, 0, 0, 0)
    see(found, 1.2e9 + 1, math.nan, 0.3)
    (seen,) = found.odometry(1.2e9 + 1, 5, 0, 0)
    assert (seen.pose, len(found.graph)) == (1, 2)


def told(found: KeyPoses) -> dict[str, int]:
    return dict(found.problems)


def test_before_the_first_odometry() -> None:
    found = keys()
    see(found, -5, 1, 0)
    driven(found, 2)
    assert told(found) == {"measurements before the first odometry, left out": 1}


def test_long_after_the_last_odometry() -> None:
    found = driven(keys(), 2)
    see(found, 1.5, 1, 0)
    see(found, 99, 1, 0)
    assert [s.time for s in found.finish()] == [1.5]
    assert told(found) == {"measurements without odometry at their time, left out": 1}


def test_time_that_goes_backwards() -> None:
    found = driven(keys(), 4)
    found.odometry(1.5, 9, 9, 9)
    found.odometry(3.0, 3.0, 0.0, 0.0)  # the last row once more: nothing is wrong
    found.odometry(3.0, 7.0, 0.0, 0.0)
    assert told(found) == {"odometry that goes back in time, left out": 2}
    assert found.graph.odometry[-1] == pytest.approx([3, 0, 0])


@pytest.mark.parametrize("row", [(math.nan, 0, 0, 0), (1, math.inf, 0, 0), (1, 0, 0, math.nan)])
def test_odometry_that_is_not_finite(row: tuple[float, float, float, float]) -> None:
    found = keys()
    found.odometry(*row)
    assert told(found) == {"odometry that is not finite, left out": 1}
    assert not len(found.graph)


@pytest.mark.parametrize(
    ("row", "problem"),
    [
        ((math.nan, 1, 1, 1), "without time, or without range and bearing"),
        ((0, math.nan, math.nan, 1), "without time, or without range and bearing"),
        ((0, math.inf, 0, 1), "whose range or bearing cannot be"),
        ((0, 1, -math.inf, 1), "whose range or bearing cannot be"),
        ((0, 0, 0, 1), "whose range or bearing cannot be"),
        ((0, -3, 0, 1), "whose range or bearing cannot be"),
        ((0, 1, 0, 0), "with a confidence outside (0, 1]"),
        ((0, 1, 0, 1.5), "with a confidence outside (0, 1]"),
        ((0, 1, 0, math.nan), "with a confidence outside (0, 1]"),
    ],
)
def test_bad_sightings_are_left_out_and_counted(
    row: tuple[float, float, float, float], problem: str
) -> None:
    found = driven(keys(), 2)
    assert see(found, *row) == []
    assert told(found) == {f"measurements {problem}, left out": 1}


def test_rows_are_numbered_as_they_come_even_those_left_out() -> None:
    found = driven(keys(), 2)
    see(found, 0, 1, 0, 0)
    seen = see(found, 1, 1, 0, 1)
    assert [s.row for s in seen] == [1]


def test_the_same_again_is_left_out_and_told() -> None:
    found = driven(keys(), 4)
    for bearing in (0.1, 0.1, 0.2, math.nan, math.nan):
        see(found, 2, 5, bearing)
    found.finish()
    assert len(found.graph.sightings) == 3
    assert told(found) == {"measurements that repeat another, left out": 2}


def test_each_sighting_keeps_its_own_deviations() -> None:
    """Also if it waits for odometry, and is carried back to the key pose before it."""
    found = driven(keys(), 3)
    found.sighting(1, 5, 0.1, 0, 0.9, "", 0.3, 0.01)
    found.sighting(2.5, 4, 0, 0, 0.9, "", 0.7, 0.04)
    found.odometry(3, 3, 0, 0)
    assert [(s.sigma_range, s.sigma_bearing) for s in found.graph.sightings] == [
        (0.3, 0.01), (0.7, 0.04),
    ]  # fmt: skip


@pytest.mark.parametrize("sigma", [0.0, -0.5, 1e-200, math.nan, math.inf])
def test_a_deviation_that_cannot_be_is_left_out_and_counted(sigma: float) -> None:
    found = driven(keys(), 2)
    assert found.sighting(1, 5, 0.1, 0, 0.9, "", sigma, 0.02) == []
    assert found.sighting(1, 5, 0.1, 0, 0.9, "", 0.5, sigma) == []
    assert told(found) == {"measurements with a deviation below 1e-09 or none, left out": 2}


def test_the_deviation_of_what_was_not_measured_does_not_matter() -> None:
    found = driven(keys(), 2)
    (bearing,) = found.sighting(1, math.nan, 0.1, 0, 0.9, "", math.nan, 0.02)
    (reach,) = found.sighting(1, 5, math.nan, 0, 0.9, "", 0.4, 0.0)
    assert (bearing.sigma_range, bearing.sigma_bearing) == (0.5, 0.02)
    assert (reach.sigma_range, reach.sigma_bearing) == (0.4, 0.02)


def test_a_log_replays_the_deviations_of_its_rows() -> None:
    """The rows are not in the order of time: each deviation goes with its row."""
    seen = Measurements(
        np.array([2.0, 1.0]), np.array([5.0, 6.0]), np.zeros(2), np.zeros(2, np.int64),
        np.ones(2), np.full(2, "", object), np.array([0.2, 0.1]), 0.03,
    )  # fmt: skip
    time = np.arange(4.0)
    found = keys()
    list(
        replay(
            RobotLog("r", Odometry(time, np.column_stack([time, 0 * time, 0 * time])), seen), found
        )
    )
    assert {s.row: (s.sigma_range, s.sigma_bearing) for s in found.graph.sightings} == {
        0: (0.2, 0.03), 1: (0.1, 0.03),
    }  # fmt: skip


def test_what_lies_beyond_a_planet_is_left_out_and_counted() -> None:
    found = driven(keys(), 2)
    assert found.odometry(2.5, 1e200, 0, 0) == []
    assert found.sighting(1, 1e300, 0.1, 0, 0.9, "", 0.5, 0.02) == []
    found.fix(1, 1, 2, 1e-200)
    assert told(found) == {
        "odometry beyond 1e+08 m, left out": 1,
        "measurements whose range or bearing cannot be, left out": 1,
        "positions from outside that cannot be, left out": 1,
    }
