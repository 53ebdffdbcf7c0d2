"""EdgeMapper and what CollectiveMap makes of its increments, in whatever order they come."""

import random
from dataclasses import replace

import numpy as np
import pytest

pytest.importorskip("gtsam", reason="needs symboslam[slam]")

from symboslam.engine.slam.control import CollectiveMap
from symboslam.engine.slam.edge import EdgeMapper
from symboslam.engine.slam.increment import EdgeIncrement
from symboslam.engine.slam.log import Mission, OdometryNoise, RobotLog
from symboslam.engine.slam.simulate import World, simulate

SMALL = World(robots=2, poses=120, side=300.0, landmarks=40, classes=8, misclassified=0.0)


@pytest.fixture(scope="module")
def mission() -> Mission:
    return simulate(SMALL, 1)


def increments(
    mission: Mission, log: RobotLog, run: str = "a", robot: str = ""
) -> list[EdgeIncrement]:
    """Those of one robot, one for every 20 rows of odometry, as they come over the wire."""
    seen = log.seen
    mapper = EdgeMapper(
        robot or log.name, mission.classes, mission.dynamic, run=run, start=log.start,
        start_sigma=log.start_sigma, noise=log.odometry.noise,
    )  # fmt: skip
    sigmas: list[list[float]] = seen.sigmas.tolist()
    found, row = [], 0
    for n, (time, pose) in enumerate(
        zip(log.odometry.time.tolist(), log.odometry.pose.tolist(), strict=True)
    ):
        mapper.odometry(time, tuple(pose))
        while row < len(seen) and seen.time[row] <= time:
            mapper.sighting(
                seen.time[row].item(), seen.range[row].item(), seen.bearing[row].item(),
                int(seen.feature[row]), seen.confidence[row].item(),
                sigma=(sigmas[row][0], sigmas[row][1]),
            )  # fmt: skip
            row += 1
        if n % 20 == 19:
            found.append(mapper.increment())
    found.append(mapper.increment(last=True))
    assert not mapper.notes
    return [EdgeIncrement.from_json(each.to_json()) for each in found if each is not None]


def collective(mission: Mission, arrived: list[EdgeIncrement]) -> CollectiveMap:
    found = CollectiveMap(mission.classes, mission.dynamic, mission.similarity)
    for each in arrived:
        found.add(each)
    return found


def test_everything_of_a_log_is_in_its_increments_once(mission: Mission) -> None:
    log = mission.robots[0]
    found = increments(mission, log)
    assert [each.sequence for each in found] == list(range(len(found)))
    assert [each.last for each in found] == [False] * (len(found) - 1) + [True]
    rows = np.concatenate([each.row for each in found])
    assert sorted(rows.tolist()) == list(range(len(log.seen)))
    times = np.concatenate([each.time for each in found])
    assert times.tolist() == sorted(set(times.tolist()))


def test_order_and_repetition_do_not_matter(mission: Mission) -> None:
    one, two = (increments(mission, log) for log in mission.robots)
    straight = collective(mission, one + two)
    expected = straight.solve()
    rest = [*one[1:], *two, *two[:2]]
    random.Random(2).shuffle(rest)
    mixed = collective(mission, [one[0], *rest])  # the robots keep their order
    found = mixed.solve()
    np.testing.assert_array_equal(found.landmarks.xy, expected.landmarks.xy)
    assert mixed.notes == ["increments of robot 2 that had come before, left out: 2"]
    assert straight.notes == []


def test_what_comes_after_a_gap_waits(mission: Mission) -> None:
    one = increments(mission, mission.robots[0])
    found = collective(mission, one[:2] + one[3:])
    assert found.notes == ["robot 1: increments 2 are missing; later ones wait"]
    until = one[1].time[-1]
    assert found.solve().trajectories["robot 1"].time[-1] == until
    found.add(one[2])
    assert found.notes == []
    assert found.solve().trajectories["robot 1"].time[-1] == one[-2].time[-1]


def test_two_robots_of_one_name_are_kept_apart(mission: Mission) -> None:
    one, two = mission.robots
    arrived = increments(mission, one, "a", "r") + increments(mission, two, "b", "r")
    found = collective(mission, arrived)
    assert set(found.solve().trajectories) == {"r", "r (2)"}
    assert found.notes == ["another run calls itself r; it is kept apart as r (2): 1"]


def test_a_robot_that_disappears_leaves_its_part(mission: Mission) -> None:
    one, two = (increments(mission, log) for log in mission.robots)
    found = collective(mission, one + two[:3]).solve()
    assert len(found.trajectories["robot 1"].time) == SMALL.poses
    assert len(found.trajectories["robot 2"].time) == 60


def test_fixes_that_cannot_be_are_told() -> None:
    mapper = EdgeMapper("r", ["House"], np.array([False]))
    mapper.fix(0.0, 1.0, 2.0, 1.0)
    mapper.odometry(0.0, (0.0, 0.0, 0.0))
    mapper.fix(1.0, float("nan"), 2.0, 1.0)
    mapper.fix(1.0, 1.0, 2.0, 0.0)
    assert mapper.notes == [
        "positions from outside before the first odometry, left out: 1",
        "positions from outside that cannot be, left out: 2",
    ]
    assert mapper.increment() is not None
    assert mapper.increment() is None
    last = mapper.increment(last=True)
    assert last is not None
    assert (last.last, len(last.time)) == (True, 0)


def test_an_increment_that_does_not_begin_where_the_one_before_ended_is_left_out(
    mission: Mission,
) -> None:
    one = increments(mission, mission.robots[0])
    shifted = replace(one[2], first=one[2].first + 7, pose=one[2].pose + 7)
    found = collective(mission, [*one[:2], shifted])
    assert found.notes == [
        "robot 1: increments that do not begin where the one before ended, left out: 1"
    ]
    assert found.solve().trajectories["robot 1"].time[-1] == one[1].time[-1]


def test_numbers_far_ahead_are_left_out_and_told(mission: Mission) -> None:
    found = increments(mission, mission.robots[0])
    far = [replace(found[0], sequence=n) for n in (1000 + len(found), 2**52)]
    mixed = collective(mission, [*found, *far])
    assert mixed.notes == [
        "increments of robot 1 numbered more than 1000 beyond the highest that had come, left out: "
        "2"
    ]
    expected = collective(mission, found).solve()
    assert mixed.solve().landmarks.xy.tolist() == expected.landmarks.xy.tolist()


def test_missing_increments_are_counted_up_to_a_limit(mission: Mission) -> None:
    first = increments(mission, mission.robots[0])[0]
    late = collective(mission, [first, *(replace(first, sequence=n * 1000) for n in range(1, 9))])
    assert late.notes == ["robot 1: increments 1, 2, 3, 4, 5 are missing; later ones wait"]


def test_a_sighting_says_how_good_it_is_or_is_as_good_as_all() -> None:
    mapper = EdgeMapper("r", ("Tree",), np.zeros(1, np.bool_), sigma_range=0.7, sigma_bearing=0.03)
    mapper.odometry(0, (0, 0, 0))
    mapper.sighting(0, 5, 0, 0, 0.9)
    mapper.sighting(0, 5, 1, 0, 0.9, sigma=(0.2, 0.01))
    made = mapper.increment()
    assert made is not None
    assert made.sigma_range.tolist() == [0.7, 0.2]
    assert made.sigma_bearing.tolist() == [0.03, 0.01]


def test_the_covariance_grows_with_what_odometry_loses() -> None:
    """Steps of 1 m whose way is off by 0.1 m each: 20 of them by 0.2 m2 along the way."""
    noise = OdometryNoise(0, 0, 0, 0, (0.1, 0.05, 0.001))
    mapper = EdgeMapper("r", ("Tree",), np.zeros(1, np.bool_), noise=noise)
    with pytest.raises(RuntimeError, match="nothing was solved"):
        mapper.covariance  # noqa: B018
    found: list[float] = []
    for n in range(60):
        mapper.odometry(float(n), (float(n), 0, 0))
        if mapper.solved:
            found.append(float(mapper.covariance[0, 0]))
    assert found[-1] - found[-21] == pytest.approx(0.2, rel=0.05)
