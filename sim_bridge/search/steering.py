"""Steering: speed and turn towards a goal around what a planar lidar sees, and what if stuck.

Pure functions of a pose in the plane; the motion is that of a unicycle, or of a car that may not
turn more sharply than a radius.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from symboslam.errors import InputError
from symboslam.sim_bridge.search.area import Floats
from symboslam.sim_bridge.search.swarm import Goal

Pose = tuple[float, float, float]
_FAN: Floats = np.radians(np.arange(-180.0, 180.0, 5.0))


@dataclass(frozen=True)
class Drive:
    """What a robot can do.

    Attributes:
        speed: metres a second at most.
        turn_rate: radians a second at most.
        clearance: metres to keep from obstacle points, at least half the robot's width.
        look: metres ahead at which obstacles count.
        turn_radius: metres; 0 turns on the spot.

    Raises:
        InputError: a number that is not positive.
    """

    speed: float
    turn_rate: float = 0.8
    clearance: float = 2.0
    look: float = 25.0
    turn_radius: float = 0.0

    def __post_init__(self) -> None:
        for name in ("speed", "turn_rate", "clearance", "look"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise InputError(f"{name} {value}: give a number above 0")
        if not (math.isfinite(self.turn_radius) and self.turn_radius >= 0):
            raise InputError(f"turn_radius {self.turn_radius}: give 0 or more metres")


def steer(pose: Pose, goal: Goal, drive: Drive, points: Floats, tick: float) -> tuple[float, float]:
    """Speed (m/s) and turn (rad/s) for the next tick.

    Args:
        pose: x, y in metres and heading in radians.
        goal: where to go.
        drive: what the robot can do.
        points: (k, 2) obstacle points in the frame of the pose, as from a planar lidar.
        tick: seconds until the next call.

    Returns:
        Speed, at least 0, and turn, counterclockwise. Without a free way it turns on the spot, or
        creeps as its turning radius asks.

    Raises:
        InputError: the pose is not finite.
    """
    x, y, heading = pose
    if not math.isfinite(x + y + heading):
        raise InputError(f"pose {pose} is not finite")
    away = goal.distance_from(x, y)
    if away < 1e-6:
        return 0.0, 0.0
    wanted = goal.bearing_from(x, y)
    room = math.inf
    if len(points):
        wanted, room = _around(x, y, heading, wanted, away, drive, points)
    error = math.remainder(wanted - heading, 2 * math.pi)
    turn = min(max(error / tick, -drive.turn_rate), drive.turn_rate)
    left = abs(error) - abs(turn) * tick / 2  # what is not turned in the middle of the tick
    speed = drive.speed * max(math.cos(min(left, math.pi / 2)), 0.0) ** 2
    speed = min(speed, away / tick, max(room - drive.clearance, 0.0) / tick)
    if drive.turn_radius > 0:
        speed = max(speed, 0.1 * drive.speed)
        limit = speed / drive.turn_radius
        turn = min(max(turn, -limit), limit)
    return speed, turn


def _around(
    x: float, y: float, heading: float, wanted: float, away: float, drive: Drive, points: Floats
) -> tuple[float, float]:
    """The free direction that is nearest to the wanted one, and the room ahead, metres."""
    dx, dy = points[:, 0] - x, points[:, 1] - y
    gap = np.hypot(dx, dy)
    near = gap < min(drive.look, away + drive.clearance)
    if not near.any():
        return wanted, math.inf
    gap, bearing = gap[near], np.arctan2(dy[near], dx[near])
    half = np.arcsin(np.minimum(1.0, drive.clearance / np.maximum(gap, 1e-9)))
    tries = np.concatenate([[wanted], wanted + _FAN])
    off = np.abs((tries[:, None] - bearing + math.pi) % (2 * math.pi) - math.pi)
    free = ~(off < half).any(1)
    room = gap[np.abs((heading - bearing + math.pi) % (2 * math.pi) - math.pi) < half]
    ahead = float(room.min()) if len(room) else math.inf
    if not free.any():
        return heading + math.pi, 0.0
    turn = np.abs((tries - wanted + math.pi) % (2 * math.pi) - math.pi)
    swing = np.abs((tries - heading + math.pi) % (2 * math.pi) - math.pi)
    cost = np.where(free, turn + 0.5 * swing, np.inf)
    return float(tries[int(cost.argmin())]), ahead


def advance(pose: Pose, speed: float, turn: float, seconds: float) -> Pose:
    """The pose after driving an arc; speed may be below 0."""
    x, y, heading = pose
    half = turn * seconds / 2
    way = speed * seconds * (math.sin(half) / half if abs(half) > 1e-9 else 1.0)
    return (
        x + way * math.cos(heading + half),
        y + way * math.sin(heading + half),
        math.remainder(heading + 2 * half, 2 * math.pi),
    )


Advice = Literal["go", "back", "turn", "give up"]


class Stuck:
    """Watches whether one robot gets on; else it is to back off, to turn, then to give up its goal.

    Args:
        progress: metres that count as getting on.
        patience: seconds without progress after which a robot is stuck.
        back: seconds of backing off.
        turn: seconds of turning.
        tries: recoveries from one place before the goal is given up.

    Raises:
        InputError: a number that is not positive.
    """

    def __init__(
        self,
        progress: float,
        patience: float = 8.0,
        back: float = 2.0,
        turn: float = 2.0,
        tries: int = 2,
    ) -> None:
        for name, value in (("progress", progress), ("patience", patience), ("tries", tries)):
            if not (math.isfinite(value) and value > 0):
                raise InputError(f"{name} {value}: give a number above 0")
        self.progress, self.patience, self.back, self.turn, self.tries = (
            progress,
            patience,
            back,
            turn,
            tries,
        )
        self._goal: Goal | None = None
        self._reset(0.0, 0.0, 0.0, math.inf)

    def _reset(self, time: float, x: float, y: float, away: float) -> None:
        self._place, self._since = (x, y), time
        self._best, self._nearer = away, time
        self._tried, self._until = 0, -math.inf

    def watch(self, time: float, pose: Pose, goal: Goal | None) -> Advice:
        """What to do now; called at each tick.

        A goal is new when it lies elsewhere by more than ten times the progress. A goal that does
        not come nearer for ten times the patience is given up too, such as one circled around.
        """
        x, y, _ = pose
        if goal is None:
            self._goal = None
            return "go"
        away = goal.distance_from(x, y)
        if self._goal is None or self._is_new(goal):
            self._goal = goal
            self._best, self._nearer = away, time
            if self._until < time - self.patience:
                self._reset(time, x, y, away)
        if away < self._best - self.progress or math.isinf(away):
            self._best, self._nearer = away, time
        if time < self._until:
            return "back" if time < self._until - self.turn else "turn"
        if math.dist(self._place, (x, y)) > self.progress:
            far = math.dist(self._place, (x, y)) > 4 * self.progress
            self._place, self._since = (
                ((x, y), time) if far or not self._tried else (self._place, time)
            )
            self._tried = 0 if far else self._tried
        if time - self._nearer > 10 * self.patience:
            self._reset(time, x, y, away)
            return "give up"
        if time - self._since > self.patience:
            if self._tried >= self.tries:
                self._reset(time, x, y, away)
                return "give up"
            self._tried += 1
            self._until = time + self.back + self.turn
            self._since = self._until
            return "back"
        return "go"

    def _is_new(self, goal: Goal) -> bool:
        old = self._goal
        if old is None or (old.heading is None) != (goal.heading is None):
            return True
        return (
            goal.heading is None
            and math.dist((old.x, old.y), (goal.x, goal.y)) > 10 * self.progress
        )
