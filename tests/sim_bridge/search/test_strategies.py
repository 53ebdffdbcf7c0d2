"""Strategies in trials: what they cover, how they deal with losses, that seeds decide all."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symboslam.errors import InputError, UnknownNameError
from symboslam.sim_bridge.search._base import Goals, Search
from symboslam.sim_bridge.search.area import Area, Box, Circle
from symboslam.sim_bridge.search.lanes import Lane, lanes_of, partitions, path_length, plan
from symboslam.sim_bridge.search.paper_areas import open_area
from symboslam.sim_bridge.search.registry import get_search, searches
from symboslam.sim_bridge.search.swarm import Swarm
from symboslam.sim_bridge.search.trial import run_trial

FEW = np.array([[30.0, 30], [570, 370]])
SMALL = Area((0.0, 0.0, 600.0, 400.0), ((50.0, 50.0, 0.0), (300.0, 200.0, 2.0), (550.0, 90.0, 1.0)))


@pytest.mark.parametrize("name", searches())
def test_a_seed_decides_all(name: str) -> None:
    one, two = (run_trial(SMALL, name, FEW, 120, seed=5, stop=False) for _ in range(2))
    assert (one.paths == two.paths).all()
    assert one.metrics.to_text() == two.metrics.to_text()
    if get_search(name).random:
        other = run_trial(SMALL, name, FEW, 120, seed=6, stop=False)
        assert (other.paths[-1] != one.paths[-1]).any()


@settings(deadline=None, max_examples=15)
@given(
    st.sampled_from(searches()), st.integers(1, 5), st.integers(0, 99),
    st.floats(150, 900), st.floats(150, 900), st.sampled_from([60.0, 120.0, 360.0]),
)  # fmt: skip
def test_goals_and_robots_stay_in_the_area(
    name: str, robots: int, seed: int, width: float, height: float, fov: float
) -> None:
    area, features = open_area(width, height, robots, 4, seed, fov=math.radians(fov))
    kind = get_search(name)

    class Watched(kind):  # type: ignore[valid-type, misc]
        def _goals(self, swarm: Swarm) -> Goals:
            goals: Goals = super()._goals(swarm)
            assert len(goals) == robots
            for goal in goals:
                assert goal is not None
                if goal.heading is None:
                    assert area.inside(np.array([[goal.x, goal.y]])).all()
                else:
                    assert math.isfinite(goal.heading)
            return goals

    trial = run_trial(area, Watched, features, 90, seed=seed)
    assert area.inside(trial.paths[..., :2].reshape(-1, 2)).all()
    assert (np.diff(trial.metrics.coverage) >= 0).all()


@settings(deadline=None, max_examples=12)
@given(st.integers(1, 6), st.integers(0, 999), st.floats(200, 1500), st.floats(200, 1500))
def test_boustrophedon_covers_open_ground(
    robots: int, seed: int, width: float, height: float
) -> None:
    area, features = open_area(width, height, robots, 20, seed)
    places = [start[:2] for start in area.starts]
    ways = plan(area, places)
    longest = max(path_length(way, place) for way, place in zip(ways, places, strict=True))
    trial = run_trial(area, "boustrophedon", features, 300 + 3 * longest / area.speed, seed=seed)
    assert trial.metrics.coverage[-1] >= 0.999
    assert trial.metrics.time_to(0.95) <= 60 + 1.5 * longest / area.speed


@pytest.mark.parametrize("name", ["frontier", "boustrophedon"])
def test_what_a_lost_robot_leaves_is_done_by_others(name: str) -> None:
    area, features = open_area(900, 900, 3, 30, 1)
    trial = run_trial(area, name, features, 1500, lost={0: 60.0, 2: 150.0})
    assert trial.metrics.coverage[-1] >= 0.999
    assert math.isfinite(trial.metrics.time_to_all_features)
    assert (trial.paths[160:, 0] == trial.paths[160, 0]).all()


@pytest.mark.parametrize("name", ["frontier", "boustrophedon"])
def test_obstacles_are_passed(name: str) -> None:
    boxes = Box(400, 300, 480, 420), Box(100, 420, 300, 440)
    obstacles = (*boxes, Circle(200, 200, 40), Circle(500, 100, 30))
    starts = ((30.0, 30.0, 0.0), (560.0, 560.0, 3.0))
    area = Area((0.0, 0.0, 600.0, 600.0), starts, obstacles=obstacles)
    trial = run_trial(area, name, FEW, 1200)
    assert trial.metrics.coverage[-1] >= 0.98
    places = trial.paths[..., :2].reshape(-1, 2)
    assert not area.blocked(places).any()


def test_walks_pass_obstacles() -> None:
    area = Area((0.0, 0.0, 600.0, 600.0), ((30.0, 30.0, 0.0),), obstacles=(Circle(300, 300, 80),))
    for name in ("random-walk", "ballistic", "random-waypoint"):
        trial = run_trial(area, name, FEW, 600, stop=False)
        assert trial.metrics.coverage[-1] > 0.5, name


def test_systematic_search_beats_chance() -> None:
    area, features = open_area(710, 710, 3, 100, 2)
    times = {
        name: run_trial(area, name, features, 3600, seed=2).metrics.time_to_all_features
        for name in ("random-walk", "frontier", "boustrophedon")
    }
    assert times["boustrophedon"] < times["random-walk"] / 2
    assert times["frontier"] < times["random-walk"] / 2


def test_robots_that_start_at_one_place_part() -> None:
    area = Area((0.0, 0.0, 900.0, 900.0), ((450.0, 450.0, 0.0),) * 3)
    for name in ("random-walk", "frontier", "boustrophedon"):
        assert run_trial(area, name, FEW, 100, seed=1).metrics.dispersion[-1] > 100, name


def test_lanes_of_a_block() -> None:
    area = Area((0.0, 0.0, 1000.0, 300.0), ((0.0, 0.0, 0.0),), reach=60)
    lanes = lanes_of(area.extent, area, along_x=True)
    assert [lane.start[1] for lane in lanes] == pytest.approx([50, 150, 250])
    assert lanes[0].start[0] < lanes[0].end[0]
    assert lanes[1].start[0] > lanes[1].end[0]
    assert len(lanes_of(area.extent, area, along_x=False)) == 9
    assert lanes_of(area.extent, area, along_x=False)[0].start[0] == pytest.approx(500 / 9)


def test_a_lane() -> None:
    lane = Lane((0, 0), (30, 40))
    assert lane.length == 50
    assert lane.at(25) == (15, 20)
    assert lane.at(99) == (30, 40)
    assert lane.way_of(15, 20) == pytest.approx(25)
    assert lane.part(10, 40).length == pytest.approx(30)
    assert path_length((lane, lane.turned()), (0, 3)) == pytest.approx(103)


@given(st.integers(1, 12))
def test_partitions_are_of_equal_blocks(count: int) -> None:
    for blocks in partitions((0, 0, 600, 300), count):
        assert len(blocks) == count
        sizes = [(c - a) * (d - b) for a, b, c, d in blocks]
        assert sizes == pytest.approx([600 * 300 / count] * count)


def test_bad_input() -> None:
    with pytest.raises(InputError, match="above 0"):
        run_trial(SMALL, "frontier", FEW, 0)
    with pytest.raises(InputError, match="finite"):
        run_trial(SMALL, "frontier", np.array([[math.nan, 0]]), 10)
    with pytest.raises(UnknownNameError):
        run_trial(SMALL, "fronteer", FEW, 10)


def test_a_search_of_ones_own() -> None:
    class Lazy(Search):
        name = "lazy"

        def _goals(self, swarm: Swarm) -> Goals:
            return [None] * len(swarm.poses)

    trial = run_trial(SMALL, Lazy, FEW, 5)
    assert (trial.paths[-1] == trial.paths[0]).all()
    assert trial.metrics.driven[-1] == 0


def test_an_area_that_is_all_in_view_takes_no_way() -> None:
    area = Area((0, 0, 60, 60), ((30, 30, 0.0),), 10, 80, 2 * math.pi)
    (way,) = plan(area, [(30.0, 30.0)])
    assert path_length(way) + math.dist((30, 30), way[0].start) < 60
