"""Coverage and metrics: hand-computed values, and that coverage only grows."""

import json
import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from symboslam.errors import GeometryError, InputError
from symboslam.sim_bridge.search.area import Area, Box, Floats
from symboslam.sim_bridge.search.coverage import Coverage, swept
from symboslam.sim_bridge.search.swarm_metrics import SearchMetrics, dispersion, ideal_area

EXTENT = (0.0, 0.0, 1000.0, 400.0)


def pose(x: float, y: float, heading: float = 0.0) -> Floats:
    return np.array([x, y, heading])


def test_a_straight_drive_sees_a_capsule() -> None:
    grid = Coverage(EXTENT, 2.0)
    for x in range(200, 800, 10):
        grid.sweep(pose(x, 200), pose(x + 10, 200), 60.0)
    capsule = 600 * 120 + math.pi * 60**2
    assert grid.share == pytest.approx(capsule / 400_000, rel=0.002)
    assert grid.share == grid.seen.mean()


def test_one_long_step_sees_what_many_short_ones_see() -> None:
    long, short = Coverage(EXTENT, 5.0), Coverage(EXTENT, 5.0)
    long.sweep(pose(100, 50), pose(500, 350), 40.0)
    for a, b in zip(np.linspace(0, 1, 9), np.linspace(0, 1, 9)[1:], strict=False):
        short.sweep(pose(100 + 400 * a, 50 + 300 * a), pose(100 + 400 * b, 50 + 300 * b), 40.0)
    assert (long.seen == short.seen).all()


def test_a_sector_sees_ahead_only() -> None:
    xy = np.array([[30.0, 0], [-30, 0], [30, 29], [30, 31], [61, 0]])
    assert swept(xy, pose(0, 0), pose(0, 0), 60, math.pi / 2).tolist() == [1, 0, 1, 0, 0]
    turned = swept(xy, pose(0, 0), pose(0, 0, math.pi), 60, math.pi / 2)
    assert turned.tolist() == [1, 1, 1, 1, 0]


def test_a_sector_that_drives_sees_its_width() -> None:
    grid = Coverage(EXTENT, 2.0)
    grid.sweep(pose(0, 200), pose(1000, 200), 60.0, math.radians(90))
    middle = grid.seen[:, 250]
    assert middle.sum() * 2.0 == pytest.approx(2 * 60 * math.sin(math.radians(45)), abs=3)


def test_cells_in_obstacles_do_not_count() -> None:
    area = Area(EXTENT, ((10.0, 10.0, 0.0),), reach=60, obstacles=(Box(0, 0, 500, 400),))
    grid = Coverage.of(area, 10.0)
    grid.sweep(pose(500, 200), pose(1000, 200), 250.0)
    assert grid.share == 1.0
    assert not grid.missing.any()


@given(
    st.lists(
        st.tuples(st.floats(-50, 1050), st.floats(-50, 450), st.floats(-4, 4)),
        min_size=2,
        max_size=8,
    ),
    st.floats(1, 200),
    st.floats(0.2, 2 * math.pi),
)
def test_coverage_only_grows(
    places: list[tuple[float, float, float]], reach: float, fov: float
) -> None:
    grid = Coverage(EXTENT, 20.0)
    before = 0
    for a, b in pairwise(places):
        new = grid.sweep(np.array(a), np.array(b), reach, fov)
        assert int(grid.seen.sum()) == before + new
        before += new
    assert grid.share == pytest.approx(grid.seen.mean())


def test_bad_grids_are_refused() -> None:
    with pytest.raises(GeometryError, match="no area"):
        Coverage((0, 0, 0, 5), 1.0)
    with pytest.raises(InputError, match="cell 0"):
        Coverage(EXTENT, 0)
    with pytest.raises(InputError, match="too many"):
        Coverage(EXTENT, 0.01)


def test_dispersion() -> None:
    xy = np.array([[0.0, 0], [3, 4], [6, 8]])
    assert dispersion(xy) == pytest.approx((5 + 10 + 5) / 3)
    assert dispersion(xy, np.array([True, False, True])) == pytest.approx(10)
    assert dispersion(xy[:1]) == 0


def metrics(**changes: object) -> SearchMetrics:
    values: dict[str, object] = {
        "time": np.array([0.0, 1, 2, 3]), "coverage": np.array([0.0, 0.5, 0.96, 1]),
        "dispersion": np.array([10.0, 20, 30, 40]), "driven": np.array([0.0, 20, 40, 60]),
        "found": np.array([1.0, 2.0]), "size": 1e4, "diagonal": 100.0, "speed": 10.0,
        "width": 50.0, "robots": 2,
    }  # fmt: skip
    return SearchMetrics(**{**values, **changes})  # type: ignore[arg-type]


def test_metrics() -> None:
    found = metrics()
    assert ideal_area(10, 50, 3, 2) == 3000
    assert found.ideal_share(3) == pytest.approx(0.3)
    assert found.ideal_share(20) == pytest.approx(2.0)
    assert found.capped_share(20) == 1.0
    assert found.coverage_at(0.5) == pytest.approx(0.25)
    assert found.coverage_at(99) == 1.0
    assert found.time_to(0.95) == 2
    assert found.time_to_all_features == 2
    assert found.mean_dispersion() == 25
    assert found.mean_dispersion(1) == 15
    assert found.normalised_dispersion() == 0.25


def test_metrics_as_json() -> None:
    never = metrics(found=np.array([1.0, math.inf]))
    told = json.loads(never.to_text())
    assert told["time_to_all_features"] is None
    assert told["found"] == [1.0, None]
    assert told["over_time"]["coverage"] == [0, 0.5, 0.96, 1]
    with pytest.raises(InputError, match="one length"):
        metrics(time=np.array([0.0]))
