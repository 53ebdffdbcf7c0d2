"""JointGraph: robots in one frame are solved together; what odometry gets wrong is learnt."""

from typing import Any

import numpy as np
import pytest

from symboslam.engine.slam.joint import JointGraph, Member, Piece
from symboslam.engine.slam.pose_graph import Fix, Sighting
from symboslam.engine.slam.settings import SlamSettings


def test_where_a_track_is_by_the_better_sightings(robot: Any) -> None:
    member: Member = robot("r", [(0, 0, 0), (1, 0, 0)], {0: [(0, 5, 0), (1, 5.3, 0)]})
    (piece,) = member.pieces
    first, second = (s.variance for s in piece.track.sightings)
    where, variance = piece.where(member.poses)
    assert where[0] == pytest.approx((5 / first + 5.3 / second) / (1 / first + 1 / second))
    assert variance == pytest.approx(1 / (1 / first + 1 / second))


def test_one_bad_sighting_of_many_does_not_move_a_track(robot: Any) -> None:
    rows = [(0, 5, 0), (0, 5.01, 0), (1, 9, 0)]
    member: Member = robot("r", [(0, 0, 0), (1, 0, 0)], {0: rows})
    assert member.pieces[0].where(member.poses)[0] == pytest.approx([5.01, 0])


def test_a_shared_landmark_puts_two_robots_right(robot: Any) -> None:
    marks = {0: [(0, 5, 0)], 1: [(0, 0, 5)], 2: [(0, 5, 5)]}
    one: Member = robot("one", [(0, 0, 0)], marks)
    other: Member = robot("other", [(2, 1, 0)], marks)
    other.put(other.poses + np.array([0.4, -0.3, 0.1]))
    other.start_sigma = None
    graph = JointGraph([one, other], SlamSettings(), 5.0)
    other.renumber(1)
    graph.solve(0, 50)
    assert other.poses[0] == pytest.approx([2, 1, 0], abs=0.02)
    assert graph.xy[2] == pytest.approx([5, 5], abs=0.02)
    assert graph.labels() == [0, 1, 2]


def test_covariances_grow_with_the_way(robot: Any) -> None:
    marks = {0: [(0, 2, 0)], 1: [(4, 6, 0)]}
    member: Member = robot("r", [(n, 0, 0) for n in range(5)], marks)
    graph = JointGraph([member], SlamSettings(), 5.0)
    graph.solve(2.0)
    graph.marginals()
    near, far = (float(np.trace(graph.covariance[n])) for n in (0, 1))
    assert 0 < near < far
    assert np.linalg.eigvalsh(graph.pose_covariance(0, 4)).min() > 0


def test_covariances_at_once_are_those_one_by_one(
    robot: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    rows = {n: [(n, 2, 1), (n + 1, 1, 1)] for n in range(6)} | {6: [(0, 3, 3), (6, -3, 3)]}
    members = [robot(name, [(n, 0, 0) for n in range(8)], rows) for name in ("r", "s")]
    graph = JointGraph(members, SlamSettings(), 5.0)
    for number, member in enumerate(members):
        member.renumber(number)
    graph.solve(2.0)
    graph.marginals()
    at_once = graph.covariance
    monkeypatch.setattr("symboslam.engine.slam.joint.DENSE", 0)
    graph.marginals()
    assert sorted(at_once) == sorted(graph.covariance) == list(range(7))
    for label, one in graph.covariance.items():
        assert at_once[label] == pytest.approx(one, rel=1e-6)
        assert at_once[label] == pytest.approx(at_once[label].T)


def test_what_hardly_holds_may_be_anywhere(robot: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Marginals that cannot be had of one landmark: QR for the others, a loose one for it."""
    marks = {0: [(0, 2, 0)], 1: [(4, 6, 0)]}
    member: Member = robot("r", [(n, 0, 0) for n in range(5)], marks)
    graph = JointGraph([member], SlamSettings(), 5.0)
    graph.solve(2.0)
    graph.marginals()
    sound = graph.covariance[0]
    marginal = JointGraph._marginal

    def fails(self: JointGraph, label: int) -> Any:
        if label == 1:
            raise RuntimeError("Indeterminate linear system")
        return marginal(self, label)

    def singular(self: JointGraph, labels: list[int]) -> Any:
        raise np.linalg.LinAlgError("not positive definite")

    monkeypatch.setattr(JointGraph, "_at_once", singular)
    monkeypatch.setattr(JointGraph, "_marginal", fails)
    graph.marginals()
    assert graph.covariance[0] == pytest.approx(sound, rel=1e-6)
    assert graph.covariance[1] == pytest.approx(np.eye(2) * 50.0**2)


def test_a_meeting_puts_a_robot_right(robot: Any) -> None:
    one: Member = robot("one", [(0, 0, 0)], {0: [(0, 5, 0)]})
    other: Member = robot("other", [(3, 4, 0)], {})
    other.put(np.array([[3.5, 4.5, 0.0]]))
    other.start_sigma = None
    graph = JointGraph([one, other], SlamSettings(), 5.0)
    met = Sighting(0, 0, 0, 5.0, float(np.arctan2(4, 3)), 0.1, 0.01, -1, 0.9)
    graph.meetings = [(0, met, 1, 0)]
    graph.solve(0, 50)
    assert other.poses[0, :2] == pytest.approx([3, 4], abs=0.01)


def test_fixes_bend_a_path(robot: Any) -> None:
    member: Member = robot("r", [(n, 0, 0) for n in range(5)], {})
    member.graph.fixes.append(Fix(4, 4.0, 0.4, 0.01))
    graph = JointGraph([member], SlamSettings(), 5.0)
    graph.solve(0, 50)
    assert member.poses[4, 1] > 0.2
    assert (np.diff(member.poses[:, 1]) > 0).all()


def test_scale_and_turn_of_odometry_are_learnt(robot: Any) -> None:
    member: Member = robot("r", [(n, 0, 0) for n in range(100)], {})
    member.poses = member.poses * [1.02, 1, 1]
    member.calibrate()
    assert member.scale == pytest.approx(1.02, abs=0.001)
    assert member.turn == pytest.approx(0, abs=1e-6)
    assert member.step[1] == pytest.approx([1.02, 0, 0], abs=0.001)
    member.poses = np.array([(n, 0, 0.002 * n) for n in range(100)])
    member.calibrate()
    assert member.turn == pytest.approx(0.002, abs=0.001)


def test_numbers_of_members_name_their_times(robot: Any) -> None:
    member: Member = robot("r", [(0, 0, 0)], {0: [(0, 5, 0)]})
    member.renumber(3)
    piece: Piece = member.pieces[0]
    assert piece.member == 3
    assert piece.times == {(3, 0.0)}
