"""Robots: a light car that is set from place to place, and a Husky that rolls on its wheels."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping

from symboslam.errors import InputError
from symboslam.sim_bridge.bridge.scene import Scene
from symboslam.sim_bridge.bridge.settings import BridgeSettings
from symboslam.sim_bridge.objects.bullet import hushed

Pose = tuple[float, float, float]

TIPPED = math.radians(50)
"""A robot that leans more has tipped over."""


class Robot(ABC):
    """A robot in a scene; what it truly does, without noise.

    Attributes:
        name: of the robot.
        bumped: whether it ran into something in the last `drive`.
        top_speed: metres a second that it can go.
    """

    name: str
    bumped: bool
    top_speed: float

    @property
    @abstractmethod
    def pose(self) -> Pose:
        """Where it truly is: metres and radians."""

    @property
    @abstractmethod
    def tipped(self) -> bool:
        """Whether it has tipped over."""

    @abstractmethod
    def drive(self, speed: float, turn: float, seconds: float) -> None:
        """Go for a time, with a speed (metres a second, below 0 backwards) and a turn (radians)."""

    @abstractmethod
    def upright(self) -> None:
        """Stand on the wheels again, in the same place."""


class KinematicCar(Robot):
    """A light car without dynamics: it goes as it is told, unless something is in its way.

    It has a round footprint and turns on the spot, as a car with four steered wheels does.

    Args:
        name: of the robot.
        scene: where it is.
        start: metres and radians.
        settings: its size and speed.
    """

    def __init__(self, name: str, scene: Scene, start: Pose, settings: BridgeSettings) -> None:
        self.name, self._scene, self._pose = name, scene, start
        self._radius = settings.radius
        self._limit = settings.turn
        self.top_speed = settings.speed
        self.bumped = False

    @property
    def pose(self) -> Pose:
        """Where it truly is."""
        return self._pose

    @property
    def tipped(self) -> bool:
        """Never: it has no dynamics."""
        return False

    def drive(self, speed: float, turn: float, seconds: float) -> None:
        """Go along an arc; in front of an obstacle it stops, and turns all the same."""
        speed = max(-self.top_speed, min(self.top_speed, speed))
        turn = max(-self._limit, min(self._limit, turn))
        x, y, heading = self._pose
        middle = heading + turn * seconds / 2
        to_x = x + speed * seconds * math.cos(middle)
        to_y = y + speed * seconds * math.sin(middle)
        after = math.remainder(heading + turn * seconds, math.tau)
        touched = self._scene.solid.touched(to_x, to_y, self._radius)
        self.bumped = False
        if touched is not None:
            # Leaving what one already touches is allowed.
            gap, before = (self._scene.solid.clearance(*at) for at in ((to_x, to_y), (x, y)))
            if gap <= before:
                self.bumped = speed != 0
                self._pose = (x, y, after)
                return
        self._pose = (to_x, to_y, after)

    def upright(self) -> None:
        """Nothing to do."""


class Husky(Robot):
    """Clearpath's Husky as pybullet_data has it: four wheels, skid steering, full dynamics.

    Args:
        name: of the robot.
        scene: where it is; it is stepped along with the robot.
        start: metres and radians.
        settings: its speed; a Husky goes no faster than 2 m/s.
    """

    RADIUS = 0.165
    TRACK = 0.55
    FASTEST = 2.0
    STEP = 1 / 240
    SKID = 3.5  # wheels that skid turn less than their speeds say

    def __init__(self, name: str, scene: Scene, start: Pose, settings: BridgeSettings) -> None:
        import pybullet_data

        self.name, self._scene = name, scene
        self.top_speed = min(settings.speed, self.FASTEST)
        self._limit = settings.turn
        self.bumped = False
        bullet, client = scene.bullet, scene.client
        x, y, heading = start
        with hushed():
            self._body: int = bullet.loadURDF(
                f"{pybullet_data.getDataPath()}/husky/husky.urdf",
                (x, y, 0.15),
                bullet.getQuaternionFromEuler((0, 0, heading)),
                physicsClientId=client,
            )
        self._wheels: dict[str, list[int]] = {"left": [], "right": []}
        for joint in range(bullet.getNumJoints(self._body, physicsClientId=client)):
            label = bullet.getJointInfo(self._body, joint, physicsClientId=client)[1].decode()
            for side, joints in self._wheels.items():
                if label.endswith("_wheel") and side in label:
                    joints.append(joint)
        for _ in range(60):
            bullet.stepSimulation(physicsClientId=client)

    @property
    def pose(self) -> Pose:
        """Where it truly is."""
        (x, y, _), (_, _, heading) = self._state()
        return x, y, heading

    @property
    def tipped(self) -> bool:
        """Whether it leans more than `TIPPED`."""
        _, (roll, pitch, _) = self._state()
        return max(abs(roll), abs(pitch)) > TIPPED

    def drive(self, speed: float, turn: float, seconds: float) -> None:
        """Turn the wheels for a time."""
        speed = max(-self.top_speed, min(self.top_speed, speed))
        turn = max(-self._limit, min(self._limit, turn)) * self.SKID
        bullet, client = self._scene.bullet, self._scene.client
        for side, sign in (("left", -1), ("right", 1)):
            rate = (speed + sign * turn * self.TRACK / 2) / self.RADIUS
            for joint in self._wheels[side]:
                bullet.setJointMotorControl2(
                    self._body, joint, bullet.VELOCITY_CONTROL, targetVelocity=rate, force=60,
                    physicsClientId=client,
                )  # fmt: skip
        for _ in range(max(1, round(seconds / self.STEP))):
            bullet.stepSimulation(physicsClientId=client)
        touched = {
            contact[2] for contact in bullet.getContactPoints(self._body, physicsClientId=client)
        }
        self.bumped = bool(touched & self._scene.solid.numbers)

    def upright(self) -> None:
        """Set it on its wheels, with its heading."""
        bullet, client = self._scene.bullet, self._scene.client
        (x, y, _), (_, _, heading) = self._state()
        turned = bullet.getQuaternionFromEuler((0, 0, heading))
        bullet.resetBasePositionAndOrientation(
            self._body, (x, y, 0.2), turned, physicsClientId=client
        )
        bullet.resetBaseVelocity(self._body, (0, 0, 0), (0, 0, 0), physicsClientId=client)

    def _state(self) -> tuple[tuple[float, float, float], tuple[float, float, float]]:
        """Place, and roll, pitch and heading."""
        bullet, client = self._scene.bullet, self._scene.client
        place, turned = bullet.getBasePositionAndOrientation(self._body, physicsClientId=client)
        return tuple(place), tuple(bullet.getEulerFromQuaternion(turned))


ROBOTS: Mapping[str, Callable[[str, Scene, Pose, BridgeSettings], Robot]] = {
    "kinematic": KinematicCar,
    "husky": Husky,
}
"""All kinds of robots by name."""


def get_robot(kind: str, name: str, scene: Scene, start: Pose, settings: BridgeSettings) -> Robot:
    """A robot of a kind.

    Raises:
        InputError: there is no such kind.
    """
    if kind not in ROBOTS:
        raise InputError(f"no robot {kind!r}; there are: {', '.join(ROBOTS)}")
    return ROBOTS[kind](name, scene, start, settings)
