"""JointGraph: the pose graphs of several robots in one frame, optimised together.

Levenberg-Marquardt over all key poses and landmarks, first with Huber's loss, which finds its way
from far off, then with Cauchy's, which lets go of what does not fit. What odometry gets wrong all
the time, the scale of the way and a steady turn, is estimated beside it, a step at a time.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import gtsam
import numpy as np
from scipy.linalg import solve_triangular

from symboslam.engine.slam import factors
from symboslam.engine.slam.log import Closures, Floats, Ints
from symboslam.engine.slam.planar import between, place, wrap
from symboslam.engine.slam.pose_graph import PoseGraph, Sighting
from symboslam.engine.slam.settings import SlamSettings
from symboslam.engine.slam.tracks import Track

SCALE = 0.03
"""Standard deviation of the scale of odometry, before anything is known."""
DRIFT = 0.01
"""The same of its steady turn, in radians a metre."""
DENSE = 1500
"""So many landmarks are inverted at once, in some 400 MB."""


@dataclass
class Member:
    """One robot of a joint graph.

    Attributes:
        name: of the robot.
        graph: its pose graph.
        poses: (n, 3) where it was, in the collective frame.
        start_sigma: standard deviations of the first pose; None if that is not known.
        pieces: its tracks.
        closures: relative poses from outside, if any.
        parts: sightings with a range or a bearing alone, with their label.
        scale: by which its odometry is to be multiplied.
        turn: radians a metre to be added to its odometry.
    """

    name: str
    graph: PoseGraph
    poses: Floats
    start_sigma: tuple[float, float, float] | None
    pieces: list[Piece]
    closures: Closures | None = None
    parts: list[tuple[Sighting, int]] = field(default_factory=list)
    scale: float = 1.0
    turn: float = 0.0

    def __post_init__(self) -> None:
        self.odometry = np.array(self.graph.step).reshape(-1, 3)
        self.sigma = np.array(self.graph.sigma).reshape(-1, 3)
        self.start = self.poses[0].copy()
        self.time = np.array(self.graph.time)

    @property
    def step(self) -> Floats:
        """(n, 3) steps, corrected by what odometry gets wrong all the time."""
        steps = self.odometry.copy()
        steps[:, 2] += self.turn * np.hypot(steps[:, 0], steps[:, 1])
        steps[:, :2] *= self.scale
        return steps

    def renumber(self, number: int) -> None:
        """Make the robot member ``number`` of a graph."""
        for piece in self.pieces:
            piece.member = number
            piece.times = {(number, time) for _, time in piece.times}

    def put(self, poses: Floats) -> None:
        """Put the robot somewhere else, without knowing where it began."""
        self.poses, self.start = poses, poses[0].copy()

    def calibrate(self) -> None:
        """Estimate scale and turn from where the robot was (least squares with a prior)."""
        raw, sigma = self.odometry[1:], self.sigma[1:]
        if len(raw) < 2:
            return
        got = between(self.poses[:-1], self.poses[1:])
        weight = 1 / np.maximum(sigma, 1e-9) ** 2
        way = np.hypot(raw[:, 0], raw[:, 1])
        self.scale = float(
            ((got[:, 0] * raw[:, 0] * weight[:, 0]).sum() + 1 / SCALE**2)
            / ((raw[:, 0] ** 2 * weight[:, 0]).sum() + 1 / SCALE**2)
        )
        turn = wrap(got[:, 2] - raw[:, 2]) * way * weight[:, 2]
        self.turn = float(turn.sum() / ((way**2 * weight[:, 2]).sum() + 1 / DRIFT**2))


@dataclass
class Piece:
    """One track as part of a joint graph.

    Attributes:
        member: number of its robot.
        track: as the robot has it.
        label: number of the landmark it is of.
    """

    member: int
    track: Track
    label: int

    def __post_init__(self) -> None:
        seen = self.track.sightings
        self.points = np.array([s.point for s in seen]).reshape(-1, 2)
        self.at: Ints = np.array([s.pose for s in seen], np.int64)
        self.variance = np.array([s.variance for s in seen])
        self.times = {(self.member, s.time) for s in seen}

    def where(self, poses: Floats) -> tuple[Floats, float]:
        """(2,) where it is, given the robot's poses, and the variance of that in one direction."""
        seen = place(poses[self.at], self.points)
        weight = 1 / self.variance
        if len(seen) > 2:
            return np.median(seen, axis=0), float(1 / weight.sum())
        return (seen * weight[:, None]).sum(0) / weight.sum(), float(1 / weight.sum())


@dataclass
class JointGraph:
    """Robots whose poses are in one frame.

    Attributes:
        members: the robots.
        settings: of map building.
        spacing: metres between landmarks, about.
        xy: label -> (2,) where the landmark is.
        parts: sightings with a range or a bearing alone, with their member and label.
        meetings: (member, sighting, member seen, number of its key pose).
        covariance: label -> (2, 2), after `marginals`.
    """

    members: list[Member]
    settings: SlamSettings
    spacing: float
    xy: dict[int, Floats] = field(default_factory=dict)
    parts: list[tuple[int, Sighting, int]] = field(default_factory=list)
    meetings: list[tuple[int, Sighting, int, int]] = field(default_factory=list)
    covariance: dict[int, Floats] = field(default_factory=dict)
    _tree: Any = None
    _graph: Any = None
    _values: Any = None

    @property
    def pieces(self) -> list[Piece]:
        """The tracks of all robots."""
        return [piece for member in self.members for piece in member.pieces]

    def labels(self) -> list[int]:
        """The labels in use, in order."""
        return sorted({piece.label for piece in self.pieces})

    def put_landmarks(self) -> None:
        """Give labels without a place the mean of where their tracks are."""
        sums: dict[int, Floats] = {}
        for piece in self.pieces:
            if piece.label not in self.xy:
                xy, variance = piece.where(self.members[piece.member].poses)
                told = np.append(xy, 1.0) / variance
                sums[piece.label] = sums.get(piece.label, np.zeros(3)) + told
        for label, told in sums.items():
            self.xy[label] = told[:2] / told[2]

    def solve(self, width: float, iterations: int = 8) -> float:
        """Optimise all poses and landmarks.

        Args:
            width: of the Cauchy loss; 0 for Huber's.
            iterations: at most.

        Returns:
            The error left.
        """
        self.put_landmarks()
        graph, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
        loss = factors.Loss(width)
        labels = self.labels()
        for number, member in enumerate(self.members):
            self._add_member(graph, values, number, member, loss)
        for label in labels:
            key = factors.landmark_key(label)
            values.insert(key, self.xy[label])
            factors.add_landmark(graph, key, self.xy[label], 10 * self.spacing)
        for piece in self.pieces:
            landmark = factors.landmark_key(piece.label)
            for seen in piece.track.sightings:
                key = factors.pose_key(piece.member, seen.pose)
                factors.add_sighting(graph, key, landmark, seen, loss)
        used = set(labels)
        for number, seen, label in self.parts:
            if label in used:
                key = factors.pose_key(number, seen.pose)
                factors.add_sighting(graph, key, factors.landmark_key(label), seen, loss)
        for number, seen, other, at in self.meetings:
            one, two = factors.pose_key(number, seen.pose), factors.pose_key(other, at)
            factors.add_meeting(graph, one, two, seen, loss)
        params = gtsam.LevenbergMarquardtParams()
        params.setMaxIterations(iterations)
        params.setRelativeErrorTol(1e-4)
        optimizer = gtsam.LevenbergMarquardtOptimizer(graph, values, params)
        self._graph, self._values = graph, optimizer.optimize()
        self._take_over(labels)
        return float(optimizer.error())

    def marginals(self) -> None:
        """Work out the covariances of the landmarks.

        The poses are eliminated first (Schur complement), and what is left is inverted. Where it
        is too large for that, or singular, landmarks are done one by one: by QR, which is slower
        and more exact than Cholesky; where that fails as well, the thing may be anywhere.

        Raises:
            RuntimeError: the graph does not say where everything is.
        """
        self._tree = None
        labels = self.labels()
        try:
            found = self._at_once(labels) if len(labels) <= DENSE else None
            self.covariance = found or {label: self._marginal(label) for label in labels}
        except (RuntimeError, np.linalg.LinAlgError):
            self._tree = self._eliminated(gtsam.EliminateQR)
            self.covariance = {label: self._marginal_or_loose(label) for label in labels}

    def _at_once(self, labels: list[int]) -> dict[int, Floats]:
        """Covariances of all landmarks, from the information that all poses leave to them.

        Raises:
            RuntimeError: the graph does not say where every pose is.
            numpy.linalg.LinAlgError: nor where every landmark is.
        """
        if not labels:
            return {}
        linear = self._graph.linearize(self._values)
        poses = [
            factors.pose_key(number, n)
            for number, member in enumerate(self.members)
            for n in range(len(member.graph))
        ]
        _, left = linear.eliminatePartialMultifrontal(gtsam.KeyVector(poses))
        ordering = gtsam.Ordering()
        for label in labels:
            ordering.push_back(factors.landmark_key(label))
        information, _ = left.hessian(ordering)
        root = np.linalg.cholesky(information)
        inverse = solve_triangular(root, np.eye(len(root)), lower=True)
        columns = inverse.reshape(len(root), len(labels), 2)
        every = np.einsum("nla,nlb->lab", columns, columns)
        return dict(zip(labels, every, strict=True))

    def _eliminated(self, *how: Any) -> Any:
        linear = self._graph.linearize(self._values)
        ordering = gtsam.Ordering.ColamdGaussianFactorGraph(linear)
        return linear.eliminateMultifrontal(ordering, *how)

    def _of(self, key: int) -> Floats:
        if self._tree is None:
            self._tree = self._eliminated()
        return np.asarray(self._tree.marginalCovariance(key))

    def _marginal(self, label: int) -> Floats:
        return self._of(factors.landmark_key(label))

    def _marginal_or_loose(self, label: int) -> Floats:
        try:
            return self._marginal(label)
        except RuntimeError:
            return np.eye(2) * (10 * self.spacing) ** 2

    def pose_covariance(self, member: int, number: int) -> Floats:
        """(3, 3) of a key pose, in its own frame, after `marginals`."""
        try:
            return self._of(factors.pose_key(member, number))
        except RuntimeError:
            return np.diag([*(2 * [(100 * self.spacing) ** 2]), np.pi**2])

    def _add_member(
        self, graph: Any, values: Any, number: int, member: Member, loss: factors.Loss
    ) -> None:
        keys = [factors.pose_key(number, n) for n in range(len(member.graph))]
        loose = (100 * self.spacing, 100 * self.spacing, np.pi)
        factors.add_start(graph, keys[0], member.start, member.start_sigma or loose)
        for key, pose in zip(keys, member.poses, strict=True):
            values.insert(key, factors.pose(pose))
        steps = member.step
        for n in range(1, len(keys)):
            factors.add_step(graph, keys[n - 1], keys[n], steps[n], member.sigma[n])
        for fix in member.graph.fixes:
            factors.add_fix(graph, keys[fix.pose], np.array([fix.x, fix.y]), fix.sigma, loss)
        if member.closures is not None:
            factors.add_closures(graph, keys, member.time, member.closures, loss)

    def _take_over(self, labels: list[int]) -> None:
        for number, member in enumerate(self.members):
            found = [
                self._values.atPose2(factors.pose_key(number, n)) for n in range(len(member.graph))
            ]
            member.poses = np.array([(p.x(), p.y(), p.theta()) for p in found])
            member.calibrate()
        for label in labels:
            self.xy[label] = np.asarray(self._values.atPoint2(factors.landmark_key(label)))
