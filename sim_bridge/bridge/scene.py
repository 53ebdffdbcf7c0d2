"""Scene: what is near robots, in a physics client of pybullet; tiles come and go as they drive."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from itertools import pairwise
from typing import Any

import numpy as np

from symboslam.errors import UnknownNameError
from symboslam.sim_bridge.bridge.footprints import Footprint, Footprints
from symboslam.sim_bridge.bridge.stock import Stock, model_of, scale_of
from symboslam.sim_bridge.objects.bullet import FLAT, ROUND, Bodies, import_pybullet
from symboslam.sim_bridge.objects.catalogue import ShapeError, placeholder, shape

LOAD = 105.0
"""Metres around a robot within which objects are there."""
KEEP = 145.0
"""Metres from all robots beyond which they go; more than ``LOAD``, so that none comes and goes."""
WALL = 0.3
"""Metres that a wall is thick."""
ABOVE = 1.0
"""Metres above the ground: what stands higher is driven under."""


class Scene:
    """The ground, the walls and the objects near robots.

    A scene is cheap to draw because it holds little. So each robot has one of its own, unless all
    are to be seen in one window.

    Args:
        stock: the world's objects; shared by scenes.
        window: whether to open pybullet's window; there can be one at a time.

    Attributes:
        bullet: the module pybullet.
        client: number of the physics client.
        object_of: body -> position of its object in ``stock.objects``.
        solid: what a robot bumps into, by body.
        notes: objects whose mesh failed, and why; a box stands for each.

    Raises:
        MissingExtraError: pybullet is not installed.
    """

    def __init__(self, stock: Stock, window: bool = False) -> None:
        self.bullet: Any = import_pybullet()
        self.stock = stock
        self.client: int = self.bullet.connect(self.bullet.GUI if window else self.bullet.DIRECT)
        self.bullet.setGravity(0, 0, -9.81, physicsClientId=self.client)
        self._bodies = Bodies(self.client)
        self._loaded: dict[tuple[int, int], list[int]] = {}
        self._failed: set[int] = set()
        self.object_of: dict[int, int] = {}
        self.solid = Footprints()
        self.notes: list[str] = []
        self._ground(window)
        for wall in stock.world.walls:
            for one, other in pairwise(wall.points):
                self._wall(one, other, wall.height)

    def close(self) -> None:
        """Leave the physics client; nothing works after that."""
        if self.bullet.isConnected(self.client):
            self.bullet.disconnect(self.client)

    def follow(self, places: Iterable[tuple[float, float]]) -> None:
        """Load what is near the places of robots, in metres, and let go of what is far."""
        spots = list(places)
        wanted: set[tuple[int, int]] = set()
        kept: set[tuple[int, int]] = set()
        for x, y in spots:
            wanted |= self.stock.tiles_near(x, y, LOAD)
            kept |= self.stock.tiles_near(x, y, KEEP)
        for tile in sorted(set(self._loaded) - kept):
            for body in self._loaded.pop(tile):
                self.bullet.removeBody(body, physicsClientId=self.client)
                self.solid.remove(body)
                del self.object_of[body]
        for tile in sorted(wanted - set(self._loaded)):
            self._loaded[tile] = [self._load(n) for n in self.stock.tiles[tile]]

    def _load(self, number: int) -> int:
        thing = self.stock.objects[number]
        scale = scale_of(thing)
        place = (thing.x, thing.y, thing.z)
        try:
            made = shape(thing.kind, model_of(thing))
            body = self._bodies.add(made, place, thing.heading, scale)
        except (ShapeError, UnknownNameError) as error:
            made = placeholder(thing.kind)
            body = self._bodies.add(made, place, thing.heading, scale)
            if number not in self._failed:
                self._failed.add(number)
                self.notes.append(f"object {thing.id!r}: a box stands for it: {error}")
        self.object_of[body] = number
        if thing.kind not in FLAT and thing.z < ABOVE:
            self.solid.add(body, self._footprint(made.bounds.astype(float) * scale, number))
        return body

    def _footprint(self, bounds: Any, number: int) -> Footprint:
        """The same box or cylinder as ``Bodies`` gives to contacts and rays."""
        thing = self.stock.objects[number]
        (x, y), half = (bounds[0] + bounds[1])[:2] / 2, (bounds[1] - bounds[0])[:2] / 2
        cos, sin = math.cos(thing.heading), math.sin(thing.heading)
        circle = thing.kind in ROUND
        return Footprint(
            thing.x + cos * x - sin * y,
            thing.y + sin * x + cos * y,
            thing.heading,
            float(half.mean()) if circle else float(half[0]),
            float(half[1]),
            circle,
        )

    def _ground(self, shown: bool) -> None:
        """A plane to stand on; cameras paint it, which is three times as fast as drawing it."""
        bullet, client, world = self.bullet, self.client, self.stock.world
        e = world.extent
        touched = bullet.createCollisionShape(bullet.GEOM_PLANE, physicsClientId=client)
        bullet.createMultiBody(0, touched, physicsClientId=client)
        if not shown:
            return
        size = [e.width / 2 + 200, e.height / 2 + 200, 0.05]
        rgba = [part / 255 for part in colour_of(world.ground.colour)] + [1.0]
        seen = bullet.createVisualShape(
            bullet.GEOM_BOX, halfExtents=size, rgbaColor=rgba, physicsClientId=client
        )
        middle = [(e.min_x + e.max_x) / 2, (e.min_y + e.max_y) / 2, -0.05]
        bullet.createMultiBody(0, -1, seen, middle, physicsClientId=client)

    def _wall(self, one: tuple[float, float], other: tuple[float, float], height: float) -> None:
        bullet, client = self.bullet, self.client
        length = math.dist(one, other)
        if length == 0:
            return
        half = [length / 2 + WALL / 2, WALL / 2, height / 2]
        heading = math.atan2(other[1] - one[1], other[0] - one[0])
        middle = ((one[0] + other[0]) / 2, (one[1] + other[1]) / 2, height / 2)
        touched = bullet.createCollisionShape(
            bullet.GEOM_BOX, halfExtents=half, physicsClientId=client
        )
        seen = bullet.createVisualShape(
            bullet.GEOM_BOX, halfExtents=half, rgbaColor=(0.6, 0.55, 0.5, 1), physicsClientId=client
        )
        turned = bullet.getQuaternionFromEuler((0, 0, heading))
        body = bullet.createMultiBody(0, touched, seen, middle, turned, physicsClientId=client)
        self.solid.add(body, Footprint(*middle[:2], heading, half[0], half[1]))


def colour_of(text: str) -> tuple[int, int, int]:
    """Red, green and blue of ``#rrggbb``, from 0 to 255."""
    red, green, blue = bytes.fromhex(text.lstrip("#"))
    return red, green, blue


class Others:
    """The other robots as they look in one robot's scene: plain boxes that are moved about.

    Args:
        scene: of the robot.
    """

    SIZE = (1.2, 0.8, 1.0)

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self._body: dict[str, int] = {}

    def show(self, poses: Mapping[str, tuple[float, float, float]]) -> None:
        """Where the others are: metres and radians. They can be bumped into."""
        bullet, client = self._scene.bullet, self._scene.client
        length, width, height = self.SIZE
        for name, (x, y, heading) in poses.items():
            turned = bullet.getQuaternionFromEuler((0, 0, heading))
            if name not in self._body:
                half = [length / 2, width / 2, height / 2]
                touched = bullet.createCollisionShape(
                    bullet.GEOM_BOX, halfExtents=half, physicsClientId=client
                )
                seen = bullet.createVisualShape(
                    bullet.GEOM_BOX, halfExtents=half, rgbaColor=(0.9, 0.8, 0.1, 1),
                    physicsClientId=client,
                )  # fmt: skip
                self._body[name] = bullet.createMultiBody(
                    0, touched, seen, (x, y, height / 2), turned, physicsClientId=client
                )
            body = self._body[name]
            bullet.resetBasePositionAndOrientation(
                body, (x, y, height / 2), turned, physicsClientId=client
            )
            self._scene.solid.add(body, Footprint(x, y, heading, length / 2, width / 2))


def in_view(
    stock: Stock, pose: tuple[float, float, float], fov: float, far: float, least: float
) -> bool:
    """Whether a camera may see an object, by circles around the objects.

    Args:
        stock: the objects.
        pose: of the camera: metres and radians.
        fov: radians.
        far: metres.
        least: height over distance of the smallest that counts.
    """
    if not len(stock.xy):
        return False
    delta = stock.xy - np.asarray(pose[:2])
    distance = np.hypot(delta[:, 0], delta[:, 1])
    front = np.maximum(distance - stock.radius, 0.1)
    near = (front < far) & (stock.height >= 0.8 * least * front)
    if not near.any():
        return False
    delta, distance, radius = delta[near], distance[near], stock.radius[near]
    bearing = np.abs((np.arctan2(delta[:, 1], delta[:, 0]) - pose[2] + np.pi) % (2 * np.pi) - np.pi)
    slack = np.arcsin(np.minimum(radius / np.maximum(distance, radius + 1e-6), 1.0))
    return bool((bearing - slack < fov / 2).any())
