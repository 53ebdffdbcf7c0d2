"""CollectiveMap: logs that are odd; robots of one name are kept apart."""

from dataclasses import replace

import numpy as np
import pytest

from symboslam.engine.slam.control import CollectiveMap
from symboslam.engine.slam.log import RobotLog
from symboslam.engine.slam.simulate import World, simulate

MISSION = simulate(World(robots=2, poses=60, side=200.0, landmarks=40, classes=6, reach=60.0), 3)


def collective(*logs: RobotLog) -> CollectiveMap:
    found = CollectiveMap(MISSION.classes, MISSION.dynamic, MISSION.similarity)
    for log in logs:
        found.add_log(log)
    return found


def test_two_robots_of_one_name_are_kept_apart() -> None:
    found = collective(*(replace(log, name="r") for log in MISSION.robots)).solve()
    assert found.trajectories.keys() == {"r", "r (2)"}
    assert any("another run calls itself r; it is kept apart as r (2)" in n for n in found.notes)
    apart = collective(*MISSION.robots).solve()
    for name, robot in (("r", "robot 1"), ("r (2)", "robot 2")):
        assert found.trajectories[name].pose.tolist() == apart.trajectories[robot].pose.tolist()


def test_nothing_gives_an_empty_map() -> None:
    found = collective().solve()
    assert not found.trajectories
    assert len(found.landmarks) == 0


def test_a_robot_that_saw_nothing_has_a_path() -> None:
    log = MISSION.robots[0]
    found = collective(replace(log, seen=log.seen.take(np.zeros(len(log.seen), bool)))).solve()
    assert len(found.trajectories["robot 1"].pose) == 60
    assert len(found.landmarks) == 0


def test_bad_rows_are_noted_and_the_rest_is_mapped() -> None:
    log = MISSION.robots[0]
    reach, sure, time = log.seen.range.copy(), log.seen.confidence.copy(), log.seen.time.copy()
    reach[0], sure[1], time[2] = -1.0, 0.0, -50.0
    bearing = log.seen.bearing.copy()
    reach[3] = bearing[3] = np.nan
    seen = replace(log.seen, range=reach, bearing=bearing, confidence=sure, time=time)
    found = collective(replace(log, seen=seen)).solve()
    assert found.landmark_of["robot 1"][:4].tolist() == [-1] * 4
    assert (found.landmark_of["robot 1"][4:] >= 0).mean() > 0.8
    assert sum("robot 1: measurements" in note for note in found.notes) == 4


@pytest.mark.parametrize("start", [None, (7.0, 8.0, 1.0)])
def test_a_robot_alone_begins_where_it_says_or_at_the_origin(
    start: tuple[float, float, float] | None,
) -> None:
    found = collective(replace(MISSION.robots[0], start=start)).solve()
    assert found.trajectories["robot 1"].pose[0] == pytest.approx(start or (0, 0, 0), abs=0.05)
