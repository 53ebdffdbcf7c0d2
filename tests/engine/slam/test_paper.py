"""The paper's maps of whole missions: a world with drift, and small ones by hand."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symboslam.engine.slam.dead_reckoning import dead_reckoned
from symboslam.engine.slam.log import Measurements, Mission, Odometry, RobotLog, Truth
from symboslam.engine.slam.metrics import Options, evaluate_slam
from symboslam.engine.slam.paper import paper_map, shifted
from symboslam.engine.slam.paper_edge import edge_map_paper
from symboslam.engine.slam.paper_oracle import path_with_oracle
from symboslam.engine.slam.paper_rules import Rules
from symboslam.engine.slam.planar import between, compose
from symboslam.engine.slam.slam_map import SlamMap
from symboslam.engine.slam.spacing import radius_by_sight
from symboslam.errors import InputError


def by_identity(mission: Mission) -> SlamMap:
    return dead_reckoned(mission, by="identity", lost="left out")


def drive(rng: Any, name: str, start: Any, world: Any, *, drift: float) -> Any:
    """A robot on a square of 300 m: its log, the names of what it saw, its true path."""
    true, believed = [np.array(start, float)], [np.zeros(3)]
    for i in range(240):
        step = np.array([5.0, 0, np.pi / 2 if i % 60 == 59 else 0.0])
        noise = rng.normal(0, 1, 3) * (0.15, 0.1, 0.01) * drift + (0, 0, 0.002 * drift)
        true.append(compose(true[-1], step))
        believed.append(compose(believed[-1], step + noise))
    rows, names = [], []
    for i, pose in enumerate(true):
        way = world - pose[:2]
        away, at = np.hypot(*way.T), np.arctan2(way[:, 1], way[:, 0]) - pose[2]
        at = (at + np.pi) % (2 * np.pi) - np.pi
        for j in np.flatnonzero((away < 60) & (np.abs(at) < 1)):
            rows.append((i, away[j] + rng.normal(0, 0.2), at[j] + rng.normal(0, 0.01), j % 3))
            names.append(f"t{j}")
    table = np.array(rows, float)
    seen = Measurements(
        time=table[:, 0],
        range=table[:, 1],
        bearing=table[:, 2],
        feature=table[:, 3].astype(np.int64),
        confidence=rng.uniform(0.5, 1, len(table)),
        key=np.full(len(table), "", object),
    )
    moments = np.arange(len(true), dtype=float)
    log = RobotLog(name, Odometry(moments, np.array(believed)), seen, start)
    return log, np.array(names, object), np.column_stack([moments, true])


def world_with_drift(drift: float = 1.0) -> Mission:
    """Three robots that drive around the same blocks, 60 landmarks of three classes."""
    rng = np.random.default_rng(4)
    world = rng.uniform(-60, 360, (60, 2))
    starts = {"r1": (0.0, 0.0, 0.0), "r2": (300.0, 0.0, np.pi / 2), "r3": (300.0, 300.0, np.pi)}
    driven = {n: drive(rng, n, start, world, drift=drift) for n, start in starts.items()}
    return Mission(
        robots=tuple(log for log, _, _ in driven.values()),
        classes=("House", "Tree", "Shop"),
        dynamic=np.zeros(3, bool),
        similarity=np.eye(3),
        identity={name: names for name, (_, names, _) in driven.items()},
        truth=Truth(
            {f"t{j}": (float(x), float(y)) for j, (x, y) in enumerate(world)},
            {name: path for name, (_, _, path) in driven.items()},
            {f"t{j}": ("House", "Tree", "Shop")[j % 3] for j in range(len(world))},
        ),
    )


@pytest.fixture(scope="module")
def world() -> Mission:
    return world_with_drift()


def figures(found: Any, mission: Mission) -> dict[str, Any]:
    return evaluate_slam(found, mission, Options(radius=12)).to_json()


def test_without_drift_the_map_is_right() -> None:
    mission = world_with_drift(drift=0)
    for found in (by_identity(mission), paper_map(mission, 2)):
        score = figures(found, mission)
        assert score["landmark_rmse_m"] < 0.5
        assert score["ate_max_m"] < 1e-9
        assert (score["duplicates"], score["wrong_merges"], score["missed"]) == (0, 0, 0)
        assert score["raw"]["accuracy"] == 1


def test_drift_spoils_it_and_the_oracle_mends_it(world: Mission) -> None:
    alone, oracle = paper_map(world, 12), paper_map(world, 12, oracle=True, oracle_every=10)
    bad, good = figures(alone, world), figures(oracle, world)
    assert bad["ate_max_m"] > 5
    assert bad["duplicates"] > 20
    assert good["ate_max_m"] < 1.5
    assert good["duplicates"] < 5
    assert good["landmark_rmse_m"] < 2 < bad["landmark_rmse_m"]
    assert figures(by_identity(world), world)["duplicates"] == 0


def test_every_row_is_of_a_landmark_or_put_aside(world: Mission) -> None:
    found = paper_map(world)
    counted = np.zeros(len(found.landmarks), np.int64)
    for log in world.robots:
        of = found.landmark_of[log.name]
        assert len(of) == len(log.seen)
        counted += np.bincount(of[of >= 0], minlength=len(counted))
    assert counted.tolist() == found.landmarks.sightings.tolist()
    aside = sum(len(log.seen) for log in world.robots) - counted.sum()
    assert any("put aside" in note for note in found.notes) == (aside > 0)


def test_the_estimator_does_not_look_at_the_truth(world: Mission) -> None:
    blind = replace(world, truth=None, identity={})
    np.testing.assert_array_equal(paper_map(blind).landmarks.xy, paper_map(world).landmarks.xy)


@given(st.tuples(st.floats(-99, 99), st.floats(-99, 99), st.floats(-3, 3)))
def test_a_shift_of_all_starts_moves_the_map(move: tuple[float, float, float]) -> None:
    mission = SMALL
    moved = replace(
        mission,
        robots=tuple(
            replace(log, start=tuple(compose(move, log.start or (0, 0, 0)).tolist()))
            for log in mission.robots
        ),
    )
    one, two = paper_map(mission, 8), paper_map(moved, 8)
    back = between(
        np.array(move), np.column_stack([two.landmarks.xy, np.zeros(len(two.landmarks))])
    )
    np.testing.assert_allclose(back[:, :2], one.landmarks.xy, atol=1e-6)


def _small() -> Mission:
    rng = np.random.default_rng(9)
    world = rng.uniform(-60, 360, (8, 2))
    log, _, _ = drive(rng, "r", (1.0, 2.0, 0.3), world, drift=0.5)
    return Mission((log,), ("House", "Tree", "Shop"), np.zeros(3, bool), np.eye(3))


SMALL = _small()


def test_an_edge_map_begins_at_the_origin(log: Any, mission: Any) -> None:
    rows = [
        (0.0, 5.0, 0.0, "House", 0.6),
        (1.0, 4.0, 0.0, "Cottage", 0.8),
        (1.0, 4.2, 0.0, "Tree", 0.9),
        (2.0, np.nan, 0.0, "House", 0.9),
        (2.0, 3.2, 0.0, "House", 0.5),
        (0.0, 5.0, 0.0, "Dog", 0.5),
        (2.0, 3.0, 0.0, "Dog", 0.6),
    ]
    robot = log("r", [[7, 7, 0], [8, 7, 0], [9, 7, 0]], rows, start=(100.0, 0.0, np.pi / 2))
    edge = edge_map_paper(robot, Rules.of(mission(), 1))
    assert edge.of.tolist() == [0, 0, 2, -1, 0, 1, 1]
    np.testing.assert_allclose(edge.landmarks.xy, np.array([[15.2 / 3, 0], [5, 0], [5.2, 0]]))
    assert edge.landmarks.feature.tolist() == [1, 3, 2]  # the most confident one's
    assert edge.landmarks.dynamic.tolist() == [False, True, False]
    moved = shifted(edge, (100.0, 0.0, np.pi / 2))
    np.testing.assert_allclose(moved.landmarks.xy[1], np.array([100, 5]), atol=1e-9)
    found = paper_map(mission(robot), 1)
    end = np.array([100, 2, np.pi / 2])
    np.testing.assert_allclose(found.trajectories["r"].pose[-1], end)
    assert found.landmark_of["r"].tolist() == [0, 0, 1, -1, 0, 2, 2]  # evidence comes last
    assert found.notes == ("robot r: 1 sightings without a range or a bearing were left out",)


def test_robots_without_a_start_are_left_out(log: Any, mission: Any) -> None:
    row = [(0.0, 5.0, 0.0, "House", 0.6)]
    known, lost = log("a", [[0, 0, 0]], row), log("b", [[0, 0, 0]], row, start=None)
    identity = {"a": ["h"], "b": ["h"]}
    for make in (paper_map, by_identity):
        found = make(mission(known, lost, identity=identity))
        assert list(found.trajectories) == ["a"]
        assert found.landmark_of["b"].tolist() == [-1]
        assert "robot b: left out" in found.notes[-1]
        alone = make(mission(lost, identity=identity))
        np.testing.assert_allclose(alone.landmarks.xy, [[5, 0]])


def test_empty_missions(log: Any, mission: Any) -> None:
    for robots in ((), (log("a", [[0, 0, 0]]),), (log("a", []),)):
        assert len(paper_map(mission(*robots)).landmarks) == 0
        assert len(by_identity(mission(*robots, identity={"a": []})).landmarks) == 0


def test_the_oracle_needs_the_truth(world: Mission, log: Any, mission: Any) -> None:
    with pytest.raises(InputError, match="robot a: the oracle needs its true path"):
        paper_map(mission(log("a", [[0, 0, 0]])), oracle=True)
    with pytest.raises(InputError, match="oracle_every is 0"):
        paper_map(world, oracle_every=0)
    with pytest.raises(InputError, match="identities"):
        by_identity(mission())


def test_the_oracle_resets_the_pose(log: Any) -> None:
    robot = log("r", [[i, 0, 0] for i in range(7)], start=(0.0, 0.0, 0.0))
    truth = np.column_stack([np.arange(7), np.arange(7), np.arange(7) * 1.0, np.zeros(7)])
    late = path_with_oracle(robot, truth[2:], 3)  # resets at 0 are not possible; at 3 and 6
    assert late.pose[:, 1].tolist() == [0, 0, 0, 3, 3, 3, 3]
    assert path_with_oracle(robot, truth, 2).pose[:, 1].tolist() == [0, 0, 2, 2, 4, 4, 4]
    lost = replace(robot, start=None)
    assert path_with_oracle(lost, truth[2:], 3).pose[:, 1].tolist() == [3] * 7


def test_radius_is_a_share_of_the_sight(log: Any) -> None:
    def sight(*ranges: float) -> float:
        rows = [(0.0, r, 0.0, "House", 1.0) for r in ranges]
        return radius_by_sight([log("r", [[0, 0, 0]], rows).seen])

    assert sight(80) == pytest.approx(12)
    assert sight(500) == 12
    assert sight(4, np.nan) == pytest.approx(0.6)
    assert sight() == 12


def test_fifty_thousand_sightings_take_seconds() -> None:
    rng = np.random.default_rng(2)
    n = 50_000
    seen = Measurements(
        time=np.sort(rng.uniform(0, 1000, n)),
        range=rng.uniform(1, 50, n),
        bearing=rng.uniform(-3, 3, n),
        feature=rng.integers(0, 3, n),
        confidence=rng.uniform(0.1, 1, n),
        key=np.full(n, "", object),
    )
    moments = np.arange(1001.0)
    odometry = Odometry(moments, np.column_stack([moments * 3, np.zeros((1001, 2))]))
    mission = Mission(
        (RobotLog("r", odometry, seen, (0.0, 0.0, 0.0)),),
        ("a", "b", "c"), np.zeros(3, bool), np.eye(3),
    )  # fmt: skip
    began = time.process_time()
    paper_map(mission)
    assert time.process_time() - began < 4
