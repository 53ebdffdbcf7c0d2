"""EdgeMapper: what an edge agent runs on a robot; maps, and tells what is new."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.increment import EdgeIncrement
from symboslam.engine.slam.joining import Joining, silent
from symboslam.engine.slam.key_poses import KeyPoses
from symboslam.engine.slam.log import (
    ROBOT,
    SIGMA_BEARING,
    SIGMA_RANGE,
    Floats,
    OdometryNoise,
    Pose,
)
from symboslam.engine.slam.outcome import outcome
from symboslam.engine.slam.run import Run
from symboslam.engine.slam.settings import SlamSettings
from symboslam.engine.slam.slam_map import SlamMap


class EdgeMapper:
    """Maps what one robot drives and sees, row by row.

    The same rows give the same increments, whatever the clock says.

    Args:
        robot: its name.
        classes: names of the classes.
        dynamic: (C,) which of them move.
        run: names this run; two robots with one name differ in it.
        start: where it begins, in the collective frame; None if not known.
        start_sigma: standard deviations of that.
        noise: of the odometry.
        sigma_range: metres, of sightings that do not say it.
        sigma_bearing: radians, likewise.
        settings: of map building.

    Attributes:
        graph: the pose graph.
    """

    def __init__(
        self,
        robot: str,
        classes: Sequence[str],
        dynamic: NDArray[np.bool_],
        *,
        run: str | None = None,
        start: Pose | None = None,
        start_sigma: Pose = (0.01, 0.01, 0.01),
        noise: OdometryNoise | None = None,
        sigma_range: float = SIGMA_RANGE,
        sigma_bearing: float = SIGMA_BEARING,
        settings: SlamSettings | None = None,
    ) -> None:
        self._settings = settings or SlamSettings()
        self._classes, self._dynamic = tuple(classes), np.asarray(dynamic, bool)
        self._similarity = np.eye(len(self._classes))
        self._run = Run(robot, self._classes, self._dynamic, self._similarity, self._settings)
        self._run.start, self._run.start_sigma = start, start_sigma
        self._name, self._robot = run or robot, robot
        self.graph = self._run.graph
        noise = noise or OdometryNoise()
        self._keys = KeyPoses(self.graph, noise, self._settings.interval)
        self._sigma = sigma_range, sigma_bearing
        self._sequence = self._poses = self._sightings = self._told = 0

    @property
    def notes(self) -> list[str]:
        """What is wrong with what came, one sentence each."""
        return [f"{problem}: {times}" for problem, times in sorted(self._keys.problems.items())]

    @property
    def pose(self) -> Pose | None:
        """Where the robot was at its last key pose, by its own map; None before the first."""
        edge = self._run.edge_map()
        if edge is None:
            return None
        x, y, heading = edge.estimate.tolist()
        return x, y, heading

    @property
    def solved(self) -> int:
        """Key poses at the last update of the map; 0 before the first."""
        edge = self._run.edge_map()
        return 0 if edge is None else edge.solved

    @property
    def covariance(self) -> Floats:
        """(3, 3) of the last key pose that was solved, in the robot's own frame.

        Raises:
            RuntimeError: none was solved yet.
        """
        edge = self._run.edge_map()
        if edge is None or not edge.solved:
            raise RuntimeError("nothing was solved yet")
        return edge.covariance(edge.solved - 1)

    @property
    def key_odometry(self) -> Pose:
        """What odometry said at the last key pose."""
        return self._keys.key_odometry

    def odometry(self, time: float, pose: Pose) -> None:
        """Where the robot believes to be, in a frame of its own: metres, radians, seconds."""
        self._keys.odometry(time, *pose)
        self._run.edge_map()

    def sighting(
        self,
        time: float,
        range: float,
        bearing: float,
        feature: int,
        confidence: float,
        key: str = "",
        sigma: tuple[float, float] | None = None,
    ) -> None:
        """What it saw; NaN for a range or a bearing that was not measured, -1 for a robot."""
        sigma = sigma or self._sigma
        self._keys.sighting(time, range, bearing, feature, confidence, key, *sigma)
        self._run.rows += 1

    def fix(self, time: float, x: float, y: float, sigma: float) -> None:
        """Where it was told to be, in the collective frame."""
        self._keys.fix(time, x, y, sigma)

    def increment(self, last: bool = False) -> EdgeIncrement | None:
        """What is new since the last call; None if nothing is, unless it is the last."""
        if last:
            self._keys.finish()
        graph = self.graph
        seen = graph.sightings[self._sightings :]
        fixes = graph.fixes[self._told :]
        first, number = self._poses, len(graph)
        if not last and first == number and not seen and not fixes:
            return None
        if not number and not last:
            return None
        names = [self._classes[s.feature] if s.feature != ROBOT else "" for s in seen]
        made = EdgeIncrement(
            robot=self._robot,
            run=self._name,
            sequence=self._sequence,
            start=self._run.start,
            start_sigma=self._run.start_sigma,
            first=first,
            time=np.array(graph.time[first:], float),
            step=np.array(graph.step[first:], float).reshape(-1, 3),
            sigma=np.array(graph.sigma[first:], float).reshape(-1, 3),
            row=np.array([s.row for s in seen], np.int64),
            seen=np.array([s.time for s in seen], float),
            pose=np.array([s.pose for s in seen], np.int64),
            range=np.array([s.range for s in seen], float),
            bearing=np.array([s.bearing for s in seen], float),
            sigma_range=np.array([s.sigma_range for s in seen], float),
            sigma_bearing=np.array([s.sigma_bearing for s in seen], float),
            feature=_texts(names),
            confidence=np.array([s.confidence for s in seen], float),
            key=_texts([s.key for s in seen]),
            track=np.array([s.track for s in seen], np.int64),
            fix_pose=np.array([fix.pose for fix in fixes], np.int64),
            fix=np.array([(fix.x, fix.y, fix.sigma) for fix in fixes], float).reshape(-1, 3),
            last=last,
        )
        self._sequence += 1
        self._poses, self._sightings = number, len(graph.sightings)
        self._told = len(graph.fixes)
        return made

    def slam_map(self) -> SlamMap:
        """The robot's own map, as it is now."""
        edge = self._run.edge_map()
        runs, edges = ([self._run], [edge]) if edge is not None else ([], [])
        joining = Joining(runs, edges, self._similarity, self._settings, silent)
        joining.join()
        return outcome(joining, self._dynamic, self._similarity, joining.said(), self.notes)


def _texts(values: Sequence[str]) -> NDArray[np.object_]:
    column = np.empty(len(values), object)
    column[:] = values
    return column
