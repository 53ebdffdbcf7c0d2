"""Areas, swarms and goals: hand-computed values, and what is refused."""

import math

import numpy as np
import pytest

from symboslam.errors import GeometryError, InputError, UnknownNameError
from symboslam.sim_bridge.search._base import Goals, Search
from symboslam.sim_bridge.search.area import Area, Box, Circle, boxes_of
from symboslam.sim_bridge.search.coverage import Coverage
from symboslam.sim_bridge.search.paper_areas import AREAS, get_paper_area, open_area
from symboslam.sim_bridge.search.registry import get_search, register, search_of, searches
from symboslam.sim_bridge.search.swarm import Goal, Swarm
from symboslam.sim_bridge.worlds.plans import PLANS

SQUARE = (0.0, 0.0, 100.0, 100.0)
START = ((50.0, 50.0, 0.0),)


def swarm_of(area: Area, **changes: object) -> Swarm:
    n = area.robots
    values = {
        "time": 0.0, "poses": np.array(area.starts), "alive": np.ones(n, bool),
        "coverage": Coverage.of(area), "bumped": np.zeros(n, bool), "gave_up": np.zeros(n, bool),
    }  # fmt: skip
    return Swarm(**{**values, **changes})  # type: ignore[arg-type]


def test_sensor_width() -> None:
    assert Area(SQUARE, START, reach=60).sensor_width == pytest.approx(120)
    assert Area(SQUARE, START, reach=60, fov=math.pi).sensor_width == pytest.approx(120)
    assert Area(SQUARE, START, reach=60, fov=math.pi / 3).sensor_width == pytest.approx(60)


@pytest.mark.parametrize(
    ("extent", "starts", "rest", "error", "words"),
    [
        ((0, 0, 0, 10), START, {}, GeometryError, "extent"),
        ((0, 0, 10, math.nan), START, {}, GeometryError, "extent"),
        (SQUARE, (), {}, InputError, "no robots"),
        (SQUARE, ((150.0, 0.0, 0.0),), {}, GeometryError, "start 0"),
        (SQUARE, ((math.nan, 0.0, 0.0),), {}, GeometryError, "start 0"),
        (SQUARE, START, {"speed": 0}, InputError, "speed 0"),
        (SQUARE, START, {"reach": math.inf}, InputError, "reach"),
        (SQUARE, START, {"fov": 7}, InputError, "fov"),
    ],
)
def test_bad_areas_are_refused(extent, starts, rest, error, words) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(error, match=words):
        Area(extent, starts, **rest)


def test_obstacles() -> None:
    area = Area(SQUARE, START, obstacles=(Circle(20, 20, 5), Box(60, 60, 80, 70)))
    xy = np.array([[20.0, 24.0], [20, 26], [70, 65], [70, 71]])
    assert area.blocked(xy).tolist() == [True, False, True, False]
    assert not area.unmapped().blocked(xy).any()
    around = Circle(20, 20, 5).outline(1.0)
    assert np.allclose(np.hypot(*(around - 20).T), 5)
    assert len(Box(0, 0, 10, 5).outline(1.0)) == 30


def test_boxes_of_an_occupancy_grid() -> None:
    grid = np.array([[1, 1, 0, 1], [0, 0, 0, 0]], bool)
    assert boxes_of(grid, 2.0, (10.0, 20.0)) == (Box(10, 20, 14, 22), Box(16, 20, 18, 22))


def test_goals() -> None:
    assert Goal(3, 4).distance_from(0, 0) == 5
    assert Goal(0, 4).bearing_from(0, 0) == pytest.approx(math.pi / 2)
    assert Goal.along(7.0).bearing_from(1, 1) == pytest.approx(7 - 2 * math.pi)
    assert Goal.along(1.0).distance_from(0, 0) == math.inf


def test_poses_of_working_robots_are_finite() -> None:
    area = Area(SQUARE, (START[0], START[0]))
    poses = np.array([[1, 2, 0], [math.nan, 0, 0]])
    with pytest.raises(InputError, match="robot 1"):
        swarm_of(area, poses=poses)
    assert swarm_of(area, poses=poses, alive=np.array([True, False])).working == [0]


@pytest.mark.parametrize("name", searches())
def test_lost_robots_may_be_anywhere(name: str) -> None:
    area = Area(SQUARE, (START[0], START[0]))
    poses = np.array([[1, 2, 0], [math.nan, 0, 0]])
    goals = search_of(name, area)(swarm_of(area, poses=poses, alive=np.array([True, False])))
    assert goals[0] is not None
    assert goals[1] is None
    assert search_of(name, area)(swarm_of(area, alive=np.zeros(2, bool))) == [None, None]


def test_shapes_are_checked() -> None:
    area = Area(SQUARE, START)
    with pytest.raises(InputError, match="alive"):
        swarm_of(area, alive=np.ones(2, bool))
    with pytest.raises(InputError, match="poses"):
        swarm_of(area, poses=np.zeros((1, 2)))
    with pytest.raises(InputError, match="2 robots"):
        search_of("frontier", area)(swarm_of(Area(SQUARE, (START[0], START[0]))))


def test_names() -> None:
    with pytest.raises(UnknownNameError, match="did you mean frontier"):
        get_search("fronteir")
    with pytest.raises(UnknownNameError, match="there are: random-walk"):
        get_search("")
    with pytest.raises(InputError, match="seed"):
        search_of("frontier", Area(SQUARE, START), -1)

    class Mine(Search):
        name = "frontier"

        def _goals(self, swarm: Swarm) -> Goals:
            return []

    with pytest.raises(InputError, match="already"):
        register(Mine)


def test_paper_areas_are_those_of_the_worlds() -> None:
    for name, area in AREAS.items():
        assert (area.km2, area.features) == (PLANS[name].area_km2, PLANS[name].features)
    with pytest.raises(UnknownNameError, match="kingston"):
        get_paper_area("sydney")


def test_open_area_is_the_same_for_a_seed() -> None:
    area, features = open_area(300, 200, 2, 5, 3)
    again, same = open_area(300, 200, 2, 5, 3)
    assert area == again
    assert (features == same).all()
    assert features.shape == (5, 2)
    with pytest.raises(InputError, match="0 robots"):
        open_area(300, 200, 0, 5, 3)
    with pytest.raises(GeometryError):
        open_area(0, 200, 1, 5, 3)
