"""EdgeAgent: one robot's mind, as the paper has it: scan, approach, range, map, search on."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from symboslam.engine.slam.edge import EdgeMapper
from symboslam.sim_bridge.bridge.camera import Camera
from symboslam.sim_bridge.bridge.detections import Detector
from symboslam.sim_bridge.bridge.lidar import Lidar, Scan
from symboslam.sim_bridge.bridge.odometry import Gps, WheelOdometry
from symboslam.sim_bridge.bridge.ranging import expected_range, measure
from symboslam.sim_bridge.bridge.robots import Robot
from symboslam.sim_bridge.bridge.scene import Others, Scene
from symboslam.sim_bridge.bridge.settings import BridgeSettings
from symboslam.sim_bridge.mission.driver import command
from symboslam.sim_bridge.mission.journal import Journal, Seen
from symboslam.sim_bridge.mission.targets import Target, Targets
from symboslam.sim_bridge.mission.trouble import AROUND, BACK, Finding, Watch
from symboslam.sim_bridge.worlds.sizes import SIZES

Point = tuple[float, float]
Pose = tuple[float, float, float]

NEAR = 25.0
"""Metres within which the lidar looks for what is in the way."""
GRID = 4.0
"""Metres between obstacles that are remembered."""
THIN = 4
"""To drive, each so-manieth ray is enough."""
STAND = 10.0
"""Metres that a robot keeps from what it approaches, so that it stays wholly in frame."""
REACH = 60.0
"""Metres within which a target is approached."""


class EdgeAgent:
    """One robot with its sensors and its own map.

    Args:
        scene: where it is.
        robot: drives.
        camera: looks.
        detector: finds things in pictures.
        lidar: measures ranges.
        odometry: tells where the robot believes to be.
        gps: tells where it is; None for none.
        mapper: its own map, which corrects where it believes to be.
        position: class -> number of it in the mapper.
        start: where it truly begins, which it knows.
        settings: of robot and sensors.

    Attributes:
        name: of the robot.
        journal: what it drove and saw.
        targets: what it has seen of what stands still.
        target: what it approaches.
        gaze: where its camera looked last, in radians to the left of its heading.
        bumps: how often it ran into something.
        stuck: whether it was stuck at the last tick.
        obstacles: where its lidar met something while it drove, in its own eyes, on a grid of
            `GRID` metres.
    """

    def __init__(
        self,
        scene: Scene,
        robot: Robot,
        camera: Camera,
        detector: Detector,
        lidar: Lidar,
        odometry: WheelOdometry,
        gps: Gps | None,
        mapper: EdgeMapper,
        position: Mapping[str, int],
        start: Pose,
        settings: BridgeSettings,
    ) -> None:
        self.name, self.scene, self.robot = robot.name, scene, robot
        self._others = Others(scene)
        self.camera, self._detector, self._lidar = camera, detector, lidar
        self._odometry, self._gps, self.mapper = odometry, gps, mapper
        self._position, self._settings, self._start = position, settings, start
        self.journal = Journal(robot.name, start)
        self.targets = Targets()
        self.target: Target | None = None
        self.watch = Watch()
        self.gaze = 0.0
        self._pictures = 0
        self.bumps = 0
        self.stuck = False
        self.obstacles: set[Point] = set()
        self._bumped = False
        self._back = self._detour = 0.0
        self._side = 1
        self._anchor: tuple[Pose, Pose] = (start, (0.0, 0.0, 0.0))
        self._solved, self._sigma = 0, 0.0
        self._kinds = [o.kind for o in scene.stock.objects]

    @property
    def pose(self) -> Pose:
        """Where it believes to be, in the collective frame."""
        (x, y, heading), (from_x, from_y, from_heading) = self._anchor
        now_x, now_y, now_heading = self._odometry.pose
        turn, dx, dy = heading - from_heading, now_x - from_x, now_y - from_y
        return (
            x + math.cos(turn) * dx - math.sin(turn) * dy,
            y + math.sin(turn) * dx + math.cos(turn) * dy,
            math.remainder(turn + now_heading, math.tau),
        )

    @property
    def sigma(self) -> float:
        """Metres along one axis by which it may be elsewhere, as its map was last solved."""
        return self._sigma

    @property
    def lost(self) -> bool:
        """Whether it was given up."""
        return self.watch.given_up

    def sense(self, time: float, others: Mapping[str, Pose]) -> list[Seen]:
        """Look around, and take over into its own map what is there (scan, range, insert).

        Args:
            time: seconds.
            others: name -> true pose of the other robots, which can be run into.
        """
        true = self.robot.pose
        self._log_odometry(time, true)
        self.scene.follow([true[:2]])
        self._others.show(others)
        if self.lost:
            return []
        self.gaze = self._gaze()
        eye = (true[0], true[1], true[2] + self.gaze)
        picture = self.camera.look(eye)
        if picture is None:
            return []
        kinds = {body: self._kinds[n] for body, n in self.scene.object_of.items()}
        found = []
        here = self.pose
        detections = self._detector.detect(picture, kinds)
        for detection in detections:
            measured = measure(detection, self._lidar, eye, self.camera.spec, detections)
            if measured is None:
                continue
            ranged = math.isfinite(measured.range)
            bearing = math.remainder(measured.bearing + self.gaze, math.tau)
            thing = ""
            if detection.body is not None:
                thing = self.scene.stock.objects[self.scene.object_of[detection.body]].id
            if not SIZES[detection.kind].moves:
                far = measured.range if ranged else expected_range(detection, self.camera.spec)
                angle = here[2] + bearing
                x, y = here[0] + far * math.cos(angle), here[1] + far * math.sin(angle)
                self.targets.see(detection.kind, x, y, far, ranged)
            if not ranged:
                continue
            seen = Seen(
                time, measured.range, bearing, detection.kind, detection.confidence,
                measured.sigma, thing,
            )  # fmt: skip
            self.mapper.sighting(
                time, seen.range, seen.bearing, self._position[seen.kind], seen.confidence,
                sigma=seen.sigma,
            )  # fmt: skip
            found.append(seen)
        self.journal.seen += found
        return found

    def _gaze(self) -> float:
        """Where to look next: all around in turn, each second picture at the target."""
        self._pictures += 1
        if self.target is not None and self._pictures % 2:
            x, y, heading = self.pose
            there = math.atan2(self.target.y - y, self.target.x - x)
            return math.remainder(there - heading, math.tau)
        pan = self.camera.spec.pan
        share = 2 if self.target is not None else 1
        return pan[self._pictures // share % len(pan)]

    def _log_odometry(self, time: float, true: Pose) -> None:
        pose = self._odometry.pose
        self.journal.odometry.append((time, pose))
        self.journal.truth.append((time, true))
        self.mapper.odometry(time, pose)
        fix = None if self._gps is None else self._gps.fix(time, true)
        if fix is not None and self._gps is not None:
            self.journal.fixes.append((time, *fix))
            self.mapper.fix(time, *fix, self._gps.spec.sigma)
        estimate = self.mapper.pose or self._start
        self._anchor = (estimate, self.mapper.key_odometry)
        if self.mapper.solved > self._solved:
            self._solved, covariance = self.mapper.solved, self.mapper.covariance
            self._sigma = math.sqrt(max(covariance[0, 0] + covariance[1, 1], 0.0) / 2)

    def choose(self, claimed: Sequence[Point], seconds: float) -> Target | None:
        """The nearest target that is not mapped yet, if any; the other robots' are left to them."""
        if self.target is not None:
            gap = math.dist(self.pose[:2], (self.target.x, self.target.y))
            close = gap < SIZES[self.target.kind].radius + STAND + 2
            self.target.spent += 3 * seconds if close else seconds
        self.target = self.targets.nearest(self.pose[:2], REACH, claimed)
        return self.target

    def drive(self, goal: Point | None, seconds: float) -> None:
        """Drive towards the target, or without one towards the goal, for some seconds."""
        settings = self._settings
        left, steps = seconds, 0
        scan = None
        while left > 1e-9:
            step = min(settings.control, left)
            left -= step
            true = self.robot.pose
            if self._back > 0:
                self._back -= step
                self._step(-0.3 * self.robot.top_speed, 0.8, step)
                continue
            if goal is None or self.lost:
                self._step(0.0, 0.0, step)
                continue
            if steps % 2 == 0:
                near = self.scene.solid.clearance(*true[:2]) < NEAR
                scan = self._lidar.scan(true, THIN, NEAR) if near else None
                self._remember(scan)
            steps += 1
            x, y, heading = self.pose
            to, stand = goal, 0.0
            if self.target is not None:
                to = (self.target.x, self.target.y)
                stand = SIZES[self.target.kind].radius + STAND
            wanted = math.remainder(math.atan2(to[1] - y, to[0] - x) - heading, math.tau)
            if self._detour > 0:
                self._detour -= step
                wanted = math.remainder(wanted + self._side * math.pi / 2, math.tau)
            distance = math.dist((x, y), to) - stand
            speed, turn = command(scan, wanted, distance, self.robot.top_speed, settings.radius)
            self._step(speed, turn, step)

    def _remember(self, scan: Scan | None) -> None:
        """Take over what a scan met into the obstacles."""
        if scan is None:
            return
        hit = np.isfinite(scan.range)
        x, y, heading = self.pose
        angle = scan.bearing[hit] + heading
        across = np.round((x + scan.range[hit] * np.cos(angle)) / GRID) * GRID
        up = np.round((y + scan.range[hit] * np.sin(angle)) / GRID) * GRID
        self.obstacles.update(zip(across.tolist(), up.tolist(), strict=True))

    def _step(self, speed: float, turn: float, seconds: float) -> None:
        self.robot.drive(speed, turn, seconds)
        self._odometry.move(self.robot.pose)
        self.bumps += self.robot.bumped and not self._bumped
        self._bumped = self.robot.bumped

    def look_after(self, time: float, wants: bool) -> Finding | None:
        """Notice a robot that tipped over or is stuck, and free it or give it up."""
        finding = self.watch.check(time, self._odometry.pose[:2], wants, self.robot.tipped)
        self.stuck = finding is not None
        if finding is None:
            return None
        if finding.kind == "tipped":
            self.robot.upright()
        if finding.kind in ("tipped", "stuck"):
            self._back, self._detour, self._side = BACK, AROUND, -self._side
        if self.target is not None:
            self.target.spent = math.inf
        return finding


def things_seen(seen: Sequence[Seen]) -> set[str]:
    """Ids of the objects that were truly ranged."""
    return {one.thing for one in seen if one.thing and np.isfinite(one.range)}
