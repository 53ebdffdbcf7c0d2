"""g2o and GTSAM's text graphs."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from symboslam.engine.slam.readers import format_of, read_estimate, read_mission
from symboslam.engine.slam.readers.gtsam_text import covariance_by_layout
from symboslam.engine.slam.readers.information import covariance_of, polar, toro
from symboslam.engine.slam.readers.pose_graph import Edge, _reversed
from symboslam.errors import InputError

Write = Callable[..., Path]
I3 = "100 0 0 400 0 2500"
"""Standard deviations of 0.1, 0.05 and 0.02."""
G2O = f"""# made by hand
PARAMS_SE2OFFSET 0 0 0 0
VERTEX_SE2 0 1 2 0
VERTEX_SE2 1 2 2 1.5
VERTEX_SE2 2 2 3 1.5
VERTEX_XY 7 5 5
FIX 0
EDGE_SE2 0 1 1 0 1.5 {I3}
EDGE_SE2 1 2 1 0 0 {I3}
EDGE_SE2 2 0 -1 -1 0 {I3}
EDGE_SE2_XY 1 7 3 4 25 0 25
EDGE_BEARING_SE2_XY 0 7 0.5 10000
EDGE_PRIOR_SE2_XY 2 2 3 4 0 4
"""
Q = "0 0 0.7071067811865476 0.7071067811865476"
"""A quarter turn."""
I6 = " ".join("100" if i == j else "0" for i in range(6) for j in range(i, 6))


def test_g2o_by_hand(write: Write) -> None:
    path = write("a.g2o", G2O)
    mission, notes = read_mission(path)
    (log,) = mission.robots
    assert log.odometry.time.tolist() == [0, 1, 2]
    turned = [1 + np.cos(1.5), np.sin(1.5), 1.5]
    assert log.odometry.pose == pytest.approx(np.array([[0, 0, 0], [1, 0, 1.5], turned]))
    assert log.odometry.noise.floor == pytest.approx((0.1, 0.05, 0.02))
    assert log.odometry.noise.sigmas(np.ones((1, 3)))[0] == pytest.approx([0.1, 0.05, 0.02])
    assert log.start == (1, 2, 0)
    seen = log.seen
    assert seen.time.tolist() == [0, 1]
    assert seen.key.tolist() == ["7", "7"]
    assert np.isnan(seen.range[0])
    assert seen.range[1] == 5
    assert seen.bearing == pytest.approx([0.5, np.arctan2(4, 3)])
    assert seen.sigmas == pytest.approx(np.array([[0.2, 0.01], [0.2, 0.04]]))
    assert log.closures is not None
    assert log.closures.time.tolist() == [[2, 0]]
    assert log.closures.step.tolist() == [[-1, -1, 0]]
    assert log.closures.covariance[0] == pytest.approx(np.diag([0.01, 0.0025, 0.0004]))
    assert log.fixes is not None
    assert (log.fixes.time.tolist(), log.fixes.xy.tolist(), log.fixes.sigma.tolist()) == (
        [2], [[2, 3]], [0.5],
    )  # fmt: skip
    assert notes == [
        "a.g2o has no times: one second from pose to pose",
        "a.g2o: lines that were not used: PARAMS_SE2OFFSET (1)",
    ]


def test_the_estimate_of_the_file(write: Write) -> None:
    path = write("a.g2o", G2O.replace("VERTEX_SE2 2 2 3 1.5\n", ""))
    mission, _ = read_mission(path, identities="hidden")
    assert mission.robots[0].seen.key.tolist() == ["", ""]
    assert mission.identity["Robot 1"].tolist() == ["7", "7"]
    found = read_estimate(path, mission)
    assert found is not None
    poses = found.trajectories["Robot 1"].pose
    assert poses[:2].tolist() == [[1, 2, 0], [2, 2, 1.5]]
    assert poses[2] == pytest.approx([2 + np.cos(1.5), 2 + np.sin(1.5), 1.5])
    assert found.landmarks.xy.tolist() == [[5, 5]]
    assert found.landmark_of["Robot 1"].tolist() == [0, 0]
    assert "1 pose without an estimate follow odometry" in found.notes


def test_a_file_without_vertices_has_no_estimate(write: Write) -> None:
    path = write("a.g2o", f"EDGE_SE2 0 1 1 0 0 {I3}\n")
    assert read_estimate(path, read_mission(path)[0]) is None


def test_chains_are_robots(write: Write) -> None:
    text = "".join(f"EDGE_SE2 {i} {i + 1} 1 0 0 {I3}\n" for i in (0, 1, 10, 11))
    text += f"EDGE_SE2 0 11 1 0 0 {I3}\nEDGE_SE2 10 12 2 0 0 {I3}\nVERTEX_SE2 10 9 9 0\n"
    mission, notes = read_mission(write("a.g2o", text))
    assert [len(log.odometry) for log in mission.robots] == [3, 3]
    assert mission.robots[0].start == (0, 0, 0)
    assert mission.robots[1].start is None
    closures = mission.robots[1].closures
    assert closures is not None
    assert closures.time.tolist() == [[0, 2]]
    assert any("1 edge between different robots left out" in note for note in notes)
    assert "the poses fall into 2 chains: read as 2 robots" in notes
    fixed, _ = read_mission(write("b.g2o", text + "FIX 10\n"))
    assert fixed.robots[1].start == (9, 9, 0)


def test_edges_that_lead_back_are_turned(write: Write) -> None:
    """1 -> 0 goes 2 m to the right and turns left: 0 -> 1 turns right and goes 2 m back."""
    mission, _ = read_mission(write("a.g2o", f"EDGE_SE2 1 0 0 -2 {np.pi / 2!r} {I3}\n"))
    assert mission.robots[0].odometry.pose[1] == pytest.approx([2, 0, -np.pi / 2])
    edge = Edge(1, 0, np.array([0.0, -2, np.pi / 2]), np.diag([1.0, 4, 0]))
    assert np.diag(_reversed(edge).covariance) == pytest.approx([4, 1, 0])
    again = _reversed(_reversed(Edge(1, 0, np.array([1.0, -2, 0.7]), np.diag([1.0, 4, 9]))))
    assert again.step == pytest.approx([1, -2, 0.7])
    assert again.covariance == pytest.approx(np.diag([1.0, 4, 9]))


def test_repeated_edges_are_left_out(write: Write) -> None:
    text = f"EDGE_SE2 0 1 1 0 0 {I3}\n" * 2 + f"EDGE_SE2 0 1 1.1 0 0 {I3}\n"
    mission, notes = read_mission(write("a.g2o", text))
    closures = mission.robots[0].closures
    assert closures is not None
    assert closures.step.tolist() == [[1.1, 0, 0]]
    assert "1 repeated edge left out" in notes


def test_edges_in_space_near_the_plane(write: Write) -> None:
    text = f"VERTEX_SE3:QUAT 0 1 2 0.1 {Q}\nEDGE_SE3:QUAT 0 1 2 1 0.01 {Q} {I6}\n"
    path = write("a.g2o", text)
    mission, _ = read_mission(path)
    log = mission.robots[0]
    assert log.start == pytest.approx((1, 2, np.pi / 2))
    assert log.odometry.pose[1] == pytest.approx([2, 1, np.pi / 2])
    assert log.odometry.noise.floor == pytest.approx((0.1, 0.1, 0.2))


@pytest.mark.parametrize(
    ("line", "problem"),
    [
        (f"EDGE_SE3:QUAT 0 1 2 1 3 {Q} {I6}", "climbs 3.00 m and tilts by 0.00 rad"),
        (f"EDGE_SE3:QUAT 0 1 2 1 0 0.5 0.5 0.5 0.5 {I6}", "tilts by 1.57 rad"),
        (f"EDGE_SE3:QUAT 0 1 2 1 0 0 0 0 0 {I6}", "the quaternion is 0"),
        ("EDGE_SE2 0 1 1 0", "EDGE_SE2 has 4 values, 11 are needed"),
        (f"EDGE_SE2 0 1 nan 0 0 {I3}", "a value of EDGE_SE2 is nan, not a finite number"),
        (f"EDGE_SE2 0 x 1 0 0 {I3}", "'x' is no number of a vertex"),
        (f"EDGE_SE2 0 0 1 0 0 {I3}", "leads from 0 to itself"),
        ("VERTEX_SE2 0 1 2 3\nVERTEX_SE2 0 1 2 3", "line 2: VERTEX_SE2 0 is there twice"),
        ("VERTEX_SE2 0 1 2 3", "no edge leads from a pose to the next"),
    ],
)
def test_what_is_refused(write: Write, line: str, problem: str) -> None:
    path = write("a.g2o", line + "\n")
    with pytest.raises(InputError, match=r"a\.g2o") as error:
        read_mission(path)
    assert problem in str(error.value)


def test_a_cut_file_is_mended(write: Write) -> None:
    _, notes = read_mission(write("a.g2o", f"EDGE_SE2 0 1 1 0 0 {I3}\nEDGE_SE2 1 2 0.3"))
    assert notes[0] == "a.g2o: 1 damaged or cut line left out, the first is line 2"


def test_edges_without_information(write: Write) -> None:
    none = "0 0 0 0 0 0"
    text = f"EDGE_SE2 0 1 1 0 0 {none}\nEDGE_SE2 1 2 1 0 0 {I3}\nEDGE_SE2 0 2 2 0 0 {none}\n"
    mission, notes = read_mission(write("a.g2o", text))
    assert mission.robots[0].odometry.noise.floor == pytest.approx((0.1, 0.05, 0.02))
    assert mission.robots[0].closures is None
    assert "Robot 1: 1 closure without usable information left out" in notes


def test_gtsam_text_by_hand(write: Write) -> None:
    """Poses and landmarks share no numbers, as in GTSAM's loader."""
    text = (
        "ODOMETRY 0 2 1 0 0 0.0001 0 0 4e-06 0 9e-06\n"
        "LANDMARK 2 0 0 2 0.04 0 0.16\n"
        "BR 2 1 0.5 3 0.01 0.3\n"
        "EDGE2 2 4 1 0 0 100 0 400 2500 0 0\n"
    )
    path = write("graph.txt.gz", text)
    assert format_of(path) == "gtsam"
    mission, notes = read_mission(path)
    (log,) = mission.robots
    assert log.odometry.pose.tolist() == [[0, 0, 0], [1, 0, 0], [2, 0, 0]]
    assert log.odometry.noise.floor == pytest.approx(
        ((0.01 + 0.1) / 2, (0.002 + 0.05) / 2, (0.003 + 0.02) / 2)
    )
    assert "Robot 1: its steps are not equally sure; their median is used" in notes
    assert log.seen.key.tolist() == ["0", "1"]
    assert log.seen.range.tolist() == [2, 3]
    assert log.seen.bearing == pytest.approx([np.pi / 2, 0.5])
    assert log.seen.sigmas == pytest.approx(np.array([[0.4, 0.1], [0.3, 0.01]]))


def test_symbols_of_gtsam(write: Write) -> None:
    a, b, x = ((ord(c) << 56) for c in "abx")
    lines = [f"EDGE2 {a} {a + 1} 1 0 0 {I3}", f"EDGE2 {b} {b + 1} 1 0 0 {I3}"]
    lines.append(f"BR {a} {x + 7} 0 1 0.1 0.1")
    mission, _ = read_mission(write("a.graph", "\n".join(lines) + "\n"))
    assert len(mission.robots) == 2
    assert mission.robots[0].seen.key.tolist() == ["x7"]


def test_matrices_by_hand() -> None:
    assert toro([1, 2, 3, 4, 5, 6]).tolist() == [[1, 2, 5], [2, 3, 6], [5, 6, 4]]
    assert np.isnan(covariance_of(np.diag([1.0, -1]))).all()
    assert polar(3, 4, np.eye(2) * 0.25) == pytest.approx((5, np.arctan2(4, 3), 0.5, 0.1))
    assert polar(0, 0, np.eye(2))[:3] == (0, 0, 1)
    full = [2, 0.1, 0, 2, 0, 3]
    assert covariance_by_layout(full, "f")[0].tolist() == [2, 0.1, 0]
    with pytest.raises(InputError, match="f: the six numbers"):
        covariance_by_layout([1, 0, 0, 0, 0, 0], "f")


def test_victoria_park(shared: Path) -> None:
    path = shared / "data" / "victoria_park" / "victoria_park.txt.gz"
    mission, notes = read_mission(path, identities="hidden")
    (log,) = mission.robots
    assert (len(log.odometry), len(log.seen)) == (6969, 3640)
    assert len(set(mission.identity["Robot 1"])) == 151
    assert set(log.seen.key) == {""}
    assert log.odometry.noise.floor == pytest.approx((0.01, 0.002, 0.002))
    assert log.seen.sigma_range == pytest.approx(0.4**0.5)
    assert log.seen.range[0] == pytest.approx(np.hypot(11.5387, 3.2007))
    assert log.closures is None
    assert notes == ["victoria_park.txt.gz has no times: one second from pose to pose"]
