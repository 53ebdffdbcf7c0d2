"""PoseGraph: odometry, drift and sightings by hand."""

import math

import numpy as np
import pytest

from symboslam.engine.slam.log import OdometryNoise
from symboslam.engine.slam.pose_graph import PoseGraph, Sighting


def straight(poses: int) -> PoseGraph:
    graph = PoseGraph("r")
    for n in range(poses):
        first = n == 0
        step = np.array([0.0 if first else 1.0, 0, 0])
        graph.add(float(n), step, np.zeros(3) if first else np.array([0.1, 0.2, 0.01]))
    return graph


def test_odometry_is_the_chain_of_steps() -> None:
    graph = PoseGraph("r")
    graph.add(0, np.zeros(3), np.zeros(3))
    graph.add(1, np.array([2.0, 0, math.pi / 2]), np.ones(3))
    graph.add(2, np.array([1.0, 0, 0]), np.ones(3))
    assert len(graph) == 3
    assert graph.odometry[2] == pytest.approx([2, 1, math.pi / 2])


def test_drift_is_what_steps_and_turns_may_be_off() -> None:
    graph = straight(3)
    assert graph.drift(0, 2) == pytest.approx(2 * 0.05 + 2e-4 * 4 / 3)
    assert graph.drift(2, 0, 3.0) == pytest.approx(2 * 0.05 + 2e-4 * (4 / 3 + 9))
    assert graph.drift(1, 1, 3.0) == 0
    assert graph.way(2, 0) == graph.way(0, 2) == 2


def test_the_odometrys_own_frame_may_begin_anywhere() -> None:
    graph = PoseGraph("r")
    noise = OdometryNoise(along=0.1, across=0.2, turn=0.3, drift=0.4, floor=(0, 0, 0))
    graph.extend(0, np.array([1.0, 2.0, math.pi / 2]), noise)
    graph.extend(1, np.array([1.0, 4.0, math.pi / 2]), noise)
    assert graph.step[0].tolist() == [0, 0, 0]
    assert graph.step[1] == pytest.approx([2, 0, 0])
    assert graph.sigma[1] == pytest.approx([0.2, 0.4, 0.8])


def test_a_sighting_says_where_and_how_well() -> None:
    graph = straight(2)
    seen = Sighting(0, 1.0, 1, 10.0, math.pi / 2, 0.3, 0.04, 0, 0.9)
    assert seen.whole
    assert seen.point == pytest.approx((0, 10))
    assert seen.variance == pytest.approx(0.09 + 0.16)
    assert graph.at(seen) == pytest.approx([1, 10])


@pytest.mark.parametrize(("reach", "bearing"), [(math.nan, 1.0), (1.0, math.nan)])
def test_a_range_or_a_bearing_alone_is_not_whole(reach: float, bearing: float) -> None:
    assert not Sighting(0, 0, 0, reach, bearing, 0.3, 0.04, 0, 0.9).whole
