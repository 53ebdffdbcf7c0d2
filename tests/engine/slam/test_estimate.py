"""Whole missions in small simulated worlds: what is mapped, what is merged, what is doubted."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from symboslam.engine.slam.comparison import measure
from symboslam.engine.slam.estimate import estimate
from symboslam.engine.slam.log import Fixes, Floats, Mission, RobotLog
from symboslam.engine.slam.odometry import pose_at
from symboslam.engine.slam.planar import compose
from symboslam.engine.slam.simulate import World, simulate
from symboslam.engine.slam.slam_map import SlamMap

pytestmark = pytest.mark.proof

SMALL = World(robots=2, poses=200, side=300.0, landmarks=60, classes=12, reach=60.0, known_starts=2)
SEED = 1


def changed(mission: Mission, change: Callable[[RobotLog], RobotLog]) -> Mission:
    return replace(mission, robots=tuple(change(log) for log in mission.robots))


def off(mission: Mission, name: str, time: Floats, pose: Floats) -> float:
    """RMSE in metres of a path in the frame of the map."""
    assert mission.truth is not None
    path = mission.truth.trajectories[name]
    true = pose_at(path[:, 0], path[:, 1:], time)
    return float(np.sqrt(((pose[:, :2] - true[:, :2]) ** 2).sum(1).mean()))


def errors(mission: Mission, found: SlamMap) -> dict[str, float]:
    return {n: off(mission, n, t.time, t.pose) for n, t in found.trajectories.items()}


def dead_reckoning(mission: Mission) -> dict[str, float]:
    said = {}
    assert mission.truth is not None
    for log in mission.robots:
        start = mission.truth.trajectories[log.name][0, 1:]
        said[log.name] = off(
            mission, log.name, log.odometry.time, compose(start, log.odometry.pose)
        )
    return said


def things_of(mission: Mission, found: SlamMap) -> list[list[str]]:
    """For each landmark the true names of its sightings."""
    names: list[list[str]] = [[] for _ in range(len(found.landmarks))]
    for robot, landmarks in found.landmark_of.items():
        for name, landmark in zip(mission.identity[robot], landmarks.tolist(), strict=True):
            if landmark >= 0:
                names[landmark].append(str(name))
    return names


def wrong_merges(mission: Mission, found: SlamMap) -> int:
    """Landmarks of which more than a fifth is not of the one thing they are mostly of."""
    wrong = 0
    for names in things_of(mission, found):
        _, counts = np.unique(names, return_counts=True)
        wrong += int(counts.max(initial=0) < 0.8 * len(names))
    return wrong


def common(mission: Mission, found: SlamMap) -> int:
    """Landmarks that more than one robot saw."""
    seen = [set(of[of >= 0].tolist()) for of in found.landmark_of.values()]
    return len(set.intersection(*seen))


@pytest.fixture(scope="module")
def plain() -> tuple[Mission, SlamMap]:
    mission = simulate(SMALL, SEED)
    return mission, estimate(mission)


def test_paths_are_far_better_than_dead_reckoning(plain: tuple[Mission, SlamMap]) -> None:
    mission, found = plain
    before, after = dead_reckoning(mission), errors(mission, found)
    assert after.keys() == before.keys()
    for name, error in after.items():
        assert error < 1.0
        assert error < before[name] / 5
    assert found.doubts == ()


def test_landmarks_are_merged_and_none_wrongly(plain: tuple[Mission, SlamMap]) -> None:
    mission, found = plain
    assert wrong_merges(mission, found) == 0
    assert common(mission, found) > 10
    true = {str(name) for names in mission.identity.values() for name in names}
    assert 0.9 * len(true) < len(found.landmarks) < 1.1 * len(true)


def test_landmarks_lie_where_they_are(plain: tuple[Mission, SlamMap]) -> None:
    mission, found = plain
    assert mission.truth is not None
    for xy, names in zip(found.landmarks.xy, things_of(mission, found), strict=True):
        values, counts = np.unique(names, return_counts=True)
        true = mission.truth.landmarks[str(values[counts.argmax()])]
        assert np.hypot(*(xy - true)) < 3


def test_columns_of_a_map_fit_each_other(plain: tuple[Mission, SlamMap]) -> None:
    mission, found = plain
    marks = found.landmarks
    rows = np.concatenate([found.landmark_of[log.name] for log in mission.robots])
    assert len(set(marks.id)) == len(marks)
    counts = np.bincount(rows[rows >= 0], minlength=len(marks))
    assert marks.sightings.tolist() == counts.tolist()
    assert ((marks.confidence > 0) & (marks.confidence <= 1)).all()
    assert np.isfinite(marks.covariance).all()
    for log in mission.robots:
        assert len(found.landmark_of[log.name]) == len(log.seen)
        assert (np.diff(found.trajectories[log.name].time) > 0).all()
    for name, of in found.landmark_of.items():
        times = next(log.seen.time for log in mission.robots if log.name == name)
        both = list(zip(times[of >= 0].tolist(), of[of >= 0].tolist(), strict=True))
        assert len(set(both)) > 0.99 * len(both)


def test_the_same_mission_gives_the_same_map(plain: tuple[Mission, SlamMap]) -> None:
    mission, found = plain
    again = estimate(mission)
    assert again.landmarks.xy.tolist() == found.landmarks.xy.tolist()
    for name, path in found.trajectories.items():
        assert again.trajectories[name].pose.tolist() == path.pose.tolist()


def test_truth_and_identities_are_not_looked_at(plain: tuple[Mission, SlamMap]) -> None:
    mission, found = plain
    blind = estimate(replace(mission, truth=None, identity={}))
    assert blind.landmarks.xy.tolist() == found.landmarks.xy.tolist()


def test_progress_is_told_up_to_the_end() -> None:
    told: list[tuple[str, float]] = []
    mission = simulate(replace(SMALL, robots=1, poses=30), SEED)
    estimate(mission, progress=lambda what, share: told.append((what, share)))
    assert all(0 <= share <= 1 for _, share in told)
    assert told[0][0] == "reading robot 1"
    assert told[-1] == ("done", 1.0)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_robot_that_does_not_know_where_it_began_is_placed(seed: int) -> None:
    mission = simulate(replace(SMALL, known_starts=1), seed)
    found = estimate(mission)
    assert errors(mission, found).keys() == {"robot 1", "robot 2"}
    assert max(errors(mission, found).values()) < 5
    assert wrong_merges(mission, found) == 0
    assert common(mission, found) > 10


def test_a_robot_that_saw_nothing_that_others_saw_is_not_placed() -> None:
    mission = simulate(replace(SMALL, known_starts=1), SEED)
    one, other = mission.robots
    found = estimate(
        replace(mission, robots=(one, replace(other, seen=other.seen.take(other.seen.time < 0))))
    )
    assert found.trajectories.keys() == {"robot 1"}
    assert any("robot 2 could not be placed" in doubt for doubt in found.doubts)


def test_keys_merge_landmarks_of_two_robots_that_have_nothing_else() -> None:
    mission = simulate(replace(SMALL, known_starts=1, classes=1, misclassified=0.0), SEED)

    def named(log: RobotLog) -> RobotLog:
        return replace(log, seen=replace(log.seen, key=mission.identity[log.name].copy()))

    found = estimate(changed(mission, named))
    assert errors(mission, found).keys() == {"robot 1", "robot 2"}
    assert max(errors(mission, found).values()) < 5
    keys = found.landmarks.key.tolist()
    assert len(set(keys)) == len(keys)
    for key, names in zip(keys, things_of(mission, found), strict=True):
        assert set(names) == {key}
    assert common(mission, found) > 10


def test_things_that_move_are_dynamic_landmarks_and_anchor_nothing() -> None:
    mission = simulate(SMALL, SEED)
    rng = np.random.default_rng(0)

    def moved(log: RobotLog) -> RobotLog:
        reach = log.seen.range.copy()
        moves = log.seen.feature == 0
        reach[moves] = rng.uniform(1, 60, moves.sum())
        return replace(log, seen=replace(log.seen, range=reach))

    dynamic = np.arange(SMALL.classes) == 0  # their ranges tell how far the sensor reaches
    shifted = estimate(replace(changed(mission, moved), dynamic=dynamic))
    still = estimate(replace(mission, dynamic=dynamic))
    assert shifted.landmarks.dynamic.any()
    assert not shifted.landmarks.dynamic.all()
    for name, path in still.trajectories.items():
        assert shifted.trajectories[name].pose == pytest.approx(path.pose, abs=1e-5)
    static = ~shifted.landmarks.dynamic
    assert shifted.landmarks.xy[static] == pytest.approx(
        still.landmarks.xy[~still.landmarks.dynamic], abs=1e-5
    )


@pytest.mark.parametrize("known", [True, False])
def test_fixes_pull_a_drifting_path_straight(known: bool) -> None:
    mission = simulate(replace(SMALL, robots=1, landmarks=1, known_starts=1), SEED)
    assert mission.truth is not None
    path = mission.truth.trajectories["robot 1"][::10]
    rng = np.random.default_rng(0)
    fixes = Fixes(path[:, 0], path[:, 1:3] + rng.normal(0, 0.5, (20, 2)), np.full(20, 0.5))
    without = errors(mission, estimate(mission))["robot 1"]
    helped = changed(
        mission, lambda log: replace(log, fixes=fixes, start=log.start if known else None)
    )
    assert errors(mission, estimate(helped))["robot 1"] < min(2.0, without / 3)


@pytest.mark.parametrize("missing", ["range", "bearing"])
def test_ranges_or_bearings_alone_of_named_landmarks_are_used(missing: str) -> None:
    mission = simulate(replace(SMALL, robots=1, misclassified=0.0), 4)

    def partly(log: RobotLog, left: bool) -> RobotLog:
        names = mission.identity[log.name]
        part = log.seen.time > 60
        column = getattr(log.seen, missing).copy()
        column[part] = np.nan
        seen = replace(log.seen, key=names.copy(), **{missing: column})
        return replace(log, seen=seen.take(~part) if left else seen)

    used = changed(mission, lambda log: partly(log, False))
    unused = changed(mission, lambda log: partly(log, True))
    found = estimate(used)
    assert errors(mission, found)["robot 1"] < errors(mission, estimate(unused))["robot 1"] / 1.5
    late = mission.robots[0].seen.time > 60
    names = mission.identity["robot 1"]
    seen_before = np.isin(names[late].astype(str), names[~late].astype(str))
    assert ((found.landmark_of["robot 1"][late] >= 0) == seen_before).all()
    assert wrong_merges(mission, found) == 0


@pytest.mark.parametrize("seed", [1, 2])
def test_a_start_that_is_wrong_is_told_by_name(seed: int) -> None:
    mission = simulate(replace(SMALL, robots=3, known_starts=3), seed)
    assert estimate(mission).doubts == ()

    def moved(log: RobotLog) -> RobotLog:
        x, y, heading = log.start or (0.0, 0.0, 0.0)
        return replace(log, start=(x + 30 * (log.name == "robot 2"), y, heading))

    found = estimate(changed(mission, moved))
    assert max(errors(mission, found).values()) > 5
    told = [doubt for doubt in found.doubts if "the start that it was given" in doubt]
    assert told[0].startswith("robot 2: ")


def test_robots_that_see_each_other_help_each_other() -> None:
    mission = simulate(
        replace(SMALL, landmarks=1, meetings=True, side=80.0, reach=80.0, known_starts=2), SEED
    )
    alone = changed(mission, lambda log: replace(log, seen=log.seen.take(log.seen.feature >= 0)))
    with_meetings = errors(mission, estimate(mission))
    without = errors(mission, estimate(alone))
    assert sum(with_meetings.values()) < sum(without.values())


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_many_outliers_are_doubted_and_bend_no_path(seed: int) -> None:
    mission = simulate(replace(SMALL, outliers=0.4), seed)
    found = estimate(mission)
    # Measured: 0.53, 0.35 and 0.38 m; dead reckoning is at least 16.5, 10.8 and 6.7 m off.
    assert max(errors(mission, found).values()) < 0.8
    for name in ("robot 1", "robot 2"):
        (said,) = [doubt for doubt in found.doubts if doubt.startswith(f"{name}: ")]
        assert "sightings are of nothing that was seen again" in said


def test_classes_that_are_mistaken_often_merge_nothing_wrongly() -> None:
    mission = simulate(replace(SMALL, misclassified=0.3), SEED)
    found = estimate(mission)
    assert wrong_merges(mission, found) == 0
    assert max(errors(mission, found).values()) < 1.5


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "landmarks", "path"), [(1, 1.5, 1.0), (2, 3.0, 3.0)])
def test_three_robots_of_a_town_of_which_one_knows_where_it_began(
    seed: int, landmarks: float, path: float
) -> None:
    mission = simulate(World(known_starts=1), seed)
    result = measure(lambda: estimate(mission), mission)
    found, figures = result.slam_map, result.figures
    assert wrong_merges(mission, found) == 0
    assert len(found.trajectories) == 3
    # Measured: 0.96 and 2.12 m aligned, paths 0.67 and 2.04 m; in the frame of the map, which one
    # start alone hardly turns, paths are 8.2 and 17.4 m off, and that is told.
    assert figures.landmark_rmse_m is not None
    assert figures.ate_max_m is not None
    assert figures.landmark_rmse_m < landmarks
    assert figures.ate_max_m < path
    assert max(errors(mission, found).values()) < 12 * landmarks
    (said,) = found.doubts
    assert "landmarks may be off by more than 16 m" in said
