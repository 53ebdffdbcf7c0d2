"""TUM and g2o: by hand, and there and back."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from symboslam.engine.slam.dead_reckoning import dead_reckoned
from symboslam.engine.slam.log import Measurements, Mission, Odometry, OdometryNoise, RobotLog
from symboslam.engine.slam.odometry import chain
from symboslam.engine.slam.planar import between, compose
from symboslam.engine.slam.readers import read_estimate, read_mission
from symboslam.engine.slam.readers.tum import read_trajectory
from symboslam.engine.slam.slam_map import MappedLandmarks, SlamMap
from symboslam.engine.slam.writers import format_of, write_slam_map
from symboslam.engine.slam.writers.robot_graph import graphs_of
from symboslam.errors import OutputError

number = st.floats(-100, 100, allow_nan=False).map(lambda x: round(x, 6))
steps = st.lists(st.tuples(number, number, number), min_size=1, max_size=6)


def test_tum_has_a_file_for_each_robot(mission: Mission, slam_map: SlamMap, tmp_path: Path) -> None:
    written = write_slam_map(tmp_path / "run.tum", slam_map, mission)
    assert [file.name for file in written.files] == ["run-Robot_A.tum", "run-é.tum"]
    assert written.notes == ("TUM has no landmarks: 3 are not in the file",)
    lines = written.files[0].read_text().splitlines()
    assert lines[0] == "# timestamp tx ty tz qx qy qz qw"
    assert lines[1] == "10.0 1.0 1.0 0 0 0 0.0 1.0"
    found, notes = read_trajectory(written.files[0])
    assert notes == []
    assert found.pose == pytest.approx(slam_map.trajectories["Robot A"].pose)


def test_a_map_without_robots_is_no_tum(
    mission: Mission, slam_map: SlamMap, tmp_path: Path
) -> None:
    lost = replace(slam_map, trajectories={})
    with pytest.raises(OutputError, match="no robot of this map was placed"):
        write_slam_map(tmp_path / "run.tum", lost, mission)
    assert list(tmp_path.iterdir()) == []


def test_g2o_by_hand(mission: Mission, slam_map: SlamMap, tmp_path: Path) -> None:
    """A vertex is added at 11.5 s, from where the car is seen; the range alone has no edge."""
    path = tmp_path / "a.g2o"
    written = write_slam_map(path, slam_map, mission)
    assert written.notes[-1] == "g2o has no edge for a range alone: 1 sightings are not in the file"
    lines = [line.split() for line in path.read_text().splitlines()]
    vertices = {
        int(words[1]): [float(w) for w in words[2:]] for words in lines if "VERTEX" in words[0]
    }
    half = np.pi / 4
    assert [vertices[i] for i in range(4)] == [
        pytest.approx(p) for p in ([1, 1, 0], [2, 1, 0], [2.5, 1, half], [3, 1, 2 * half])
    ]
    assert vertices[4] == [7, 8, -1]
    assert [vertices[i] for i in (5, 6, 7)] == [[6, 1], [3, 4.5], [2.5, 3]]
    assert ["FIX", "0"] in lines
    assert ["FIX", "4"] not in lines
    edges = [(words[0], int(words[1]), int(words[2])) for words in lines if words[0] == "EDGE_SE2"]
    assert edges == [("EDGE_SE2", 0, 1), ("EDGE_SE2", 1, 2), ("EDGE_SE2", 2, 3), ("EDGE_SE2", 0, 3)]
    lines = [words for words in lines if words[0] != "#"]
    closure = [float(w) for w in lines[-6][3:]]
    assert closure == pytest.approx([2, 0.1, 1.5, 100, 0, 0, 25, 0, 4])
    tags = [words[0] for words in lines[-5:]]
    assert tags[:3] == ["EDGE_SE2_XY", "EDGE_SE2_XY", "EDGE_BEARING_SE2_XY"]
    assert tags[3:] == ["EDGE_PRIOR_SE2_XY", "FIX"]
    first, second, third, prior = ([float(w) for w in words[1:]] for words in lines[-5:-1])
    assert first == pytest.approx([0, 5, 5, 0, 25, 0, 4])  # 1 / 0.2^2, 1 / (0.1 * 5)^2
    assert second == pytest.approx([2, 7, 0, 2, 25, 0, 25], abs=1e-9)
    assert third == pytest.approx([3, 6, 0.5, 100])
    assert prior == [3, 3, 1, 4, 0, 4]


def test_gtsam_reads_g2o(mission: Mission, slam_map: SlamMap, tmp_path: Path) -> None:
    """GTSAM's reader knows poses and the edges between them: here three steps and a closure."""
    gtsam = pytest.importorskip("gtsam", reason="it comes with symboslam[slam]")
    path = tmp_path / "a.g2o"
    write_slam_map(path, slam_map, mission)
    graph, values = gtsam.readG2o(str(path), False)
    assert graph.size() == 4
    assert values.size() == 5 + 3
    last = values.atPose2(3)
    assert (last.x(), last.y(), last.theta()) == pytest.approx((3, 1, np.pi / 2))
    # Error of the closure alone, 1/2 e' W e: the map fits odometry. e is the second pose seen from
    # where the closure puts it: (0, -0.1) turned back by 1.5, and pi/2 - 1.5.
    e = np.array([-0.1 * np.sin(1.5), -0.1 * np.cos(1.5), np.pi / 2 - 1.5])
    assert graph.error(values) == pytest.approx(e @ np.diag([100, 25, 4]) @ e / 2, rel=0.01)


def test_g2o_there_and_back(mission: Mission, slam_map: SlamMap, tmp_path: Path) -> None:
    path = tmp_path / "a.g2o"
    write_slam_map(path, slam_map, mission)
    back, _ = read_mission(path)
    first, second = back.robots
    assert first.start == (1, 1, 0)
    assert second.start is None
    assert first.odometry.noise.floor == pytest.approx((0.1, 0.05, 0.02))
    assert first.closures is not None
    assert first.closures.time.tolist() == [[0, 3]]
    assert first.closures.covariance[0] == pytest.approx(np.diag([0.01, 0.04, 0.25]))
    assert first.fixes is not None
    assert (first.fixes.time.tolist(), first.fixes.sigma.tolist()) == ([3], [0.5])
    found = read_estimate(path, back)
    assert found is not None
    assert found.landmarks.id.tolist() == ["5", "7", "6"]
    assert found.landmarks.xy.tolist() == [[6, 1], [2.5, 3], [3, 4.5]]
    assert found.landmark_of["Robot 1"].tolist() == [0, 1, 2]
    assert found.landmarks.sightings.tolist() == [1, 1, 1]


@settings(max_examples=40)
@given(steps=steps, seed=st.integers(0, 1000))
def test_any_graph_comes_back(steps: list[tuple[float, float, float]], seed: int) -> None:
    random = np.random.default_rng(seed)
    n, m = len(steps) + 1, 4
    seen = Measurements(
        time=np.sort(random.integers(0, n, m)).astype(float),
        range=random.uniform(0.1, 50, m),
        bearing=random.uniform(-3, 3, m),
        feature=np.zeros(m, np.int64),
        confidence=np.ones(m),
        key=np.array([str(k) for k in random.integers(0, 3, m)], object),
        sigma_range=random.uniform(0.1, 2, m),
        sigma_bearing=random.uniform(0.01, 0.1, m),
    )
    noise = OdometryNoise(0, 0, 0, 0, (0.3, 0.2, 0.1))
    pose = chain((0, 0, 0), np.array(steps))
    log = RobotLog("R", Odometry(np.arange(float(n)), pose, noise), seen, (1.0, -2.0, 0.5))
    mission = Mission((log,), ("Thing",), np.zeros(1, np.bool_), np.eye(1))
    drawn = dead_reckoned(mission)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "a.g2o"
        write_slam_map(path, drawn, mission)
        back, _ = read_mission(path)
        again = read_estimate(path, back)
        write_slam_map(Path(folder) / "a.tum", drawn, mission)
        path_back, _ = read_trajectory(Path(folder) / "a.tum")
    (found,) = back.robots
    assert np.abs(between(found.odometry.pose, pose)) == pytest.approx(np.zeros((n, 3)), abs=1e-6)
    assert found.odometry.noise.floor == pytest.approx((0.3, 0.2, 0.1))
    assert found.seen.range == pytest.approx(seen.range)
    assert found.seen.bearing == pytest.approx(seen.bearing)
    assert found.seen.sigmas == pytest.approx(seen.sigmas)
    assert again is not None
    true = drawn.trajectories["R"].pose
    assert again.trajectories["Robot 1"].pose == pytest.approx(true)
    assert again.landmarks.xy == pytest.approx(drawn.landmarks.xy)
    assert np.abs(between(path_back.pose, true)) == pytest.approx(np.zeros((n, 3)), abs=1e-7)


def test_vertices_follow_the_estimate_and_odometry_between(
    mission: Mission, slam_map: SlamMap
) -> None:
    graph = graphs_of(slam_map, mission, keyframes=True)[0]
    assert graph.time.tolist() == [10, 11.5, 12]
    assert graph.pose[1] == pytest.approx(compose((1, 1, 0), (1.5, 0, np.pi / 4)))
    assert graph.seen_from.tolist() == [0, 1, 2, 2]


def test_empty_maps_are_written(mission: Mission, slam_map: SlamMap, tmp_path: Path) -> None:
    marks, none = slam_map.landmarks, np.zeros(0, np.int64)
    nothing = MappedLandmarks(
        marks.id[none], marks.xy[none], marks.covariance[none], none, marks.confidence[none],
        none, marks.dynamic[none], marks.key[none],
    )  # fmt: skip
    empty = SlamMap({}, nothing, {})
    for name in ("a.g2o", "a.geojson", "a.ttl"):
        write_slam_map(tmp_path / name, empty, mission)
        assert (tmp_path / name).exists()


def test_formats_and_options(mission: Mission, slam_map: SlamMap, tmp_path: Path) -> None:
    assert format_of("a.dsg.json") == "spark_dsg"
    assert format_of("a.json") == "geojson"
    assert format_of("a.bin", "turtle") == "turtle"
    with pytest.raises(OutputError, match="no format has this ending"):
        format_of("a.bin")
    with pytest.raises(OutputError, match="no format 'bag'"):
        format_of("a.ttl", "bag")
    with pytest.raises(OutputError, match="the format g2o has no option 'origin'; it has: none"):
        write_slam_map(tmp_path / "a.g2o", slam_map, mission, origin=(0, 0))


def test_a_failure_keeps_the_old_file(mission: Mission, slam_map: SlamMap, tmp_path: Path) -> None:
    path = tmp_path / "a.g2o"
    path.write_text("old")
    broken = replace(slam_map, landmark_of={"Robot A": np.full(5, 99)})
    broken = replace(broken, landmarks=replace(broken.landmarks, feature=np.full(3, 99)))
    with pytest.raises(IndexError):
        write_slam_map(path, broken, mission)
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]
