"""Shapes as bodies of pybullet: one textured mesh for looks, one primitive for contacts.

TinyRenderer shows one colour or one texture for a shape, and no colours of vertices. So all plain
colours come from one palette, a picture of 64 by 64 points; every triangle looks up its own.
Why: docs/decisions/0024-object-meshes.md
"""

from __future__ import annotations

import os
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symboslam.errors import MissingExtraError
from symboslam.sim_bridge.objects.catalogue import ShapeError, placeholder, shape
from symboslam.sim_bridge.objects.parts import Part, Shape

SIDE = 64  # points of the palette along a side: 16 levels for each of three colours
LEVELS = 16
# Footprints that are round; all others are boxes.
ROUND = {
    "FireHydrant", "GasStationPump", "Missile", "Plant", "Rotunda", "StopSign", "Tower",
    "TrafficLight", "Tree",
}  # fmt: skip
# Robots drive over the floor of a court.
FLAT = {"BasketballCourt": 0.05}


def import_pybullet() -> Any:
    """The module pybullet.

    Raises:
        MissingExtraError: it is not installed.
    """
    known = sys.modules.get("pybullet")
    if known is not None:
        return known
    try:
        with hushed():
            import pybullet
    except ImportError as error:
        raise MissingExtraError("pybullet", "sim") from error
    return pybullet


@contextmanager
def hushed() -> Iterator[None]:
    """Nothing is printed: pybullet tells when it was built, and what it misses in URDF files."""
    import ctypes

    sys.stdout.flush()
    sys.stderr.flush()
    libc = ctypes.CDLL(None)
    libc.fflush(None)
    kept, nowhere = [os.dup(1), os.dup(2)], os.open(os.devnull, os.O_WRONLY)
    try:
        os.dup2(nowhere, 1)
        os.dup2(nowhere, 2)
        yield
    finally:
        libc.fflush(None)
        for number, old in zip((1, 2), kept, strict=True):
            os.dup2(old, number)
            os.close(old)
        os.close(nowhere)


def palette() -> NDArray[np.uint8]:
    """(64, 64, 3) bytes: all colours with 16 levels each of red, green and blue, in rows."""
    index = np.arange(SIDE * SIDE)
    levels = np.stack([index // 256, index // 16 % 16, index % 16], 1)
    return (levels * (255 // (LEVELS - 1))).astype(np.uint8).reshape(SIDE, SIDE, 3)


def texture(made: Shape) -> NDArray[np.uint8]:
    """The shape's picture above the palette; the palette alone where it has no picture."""
    if made.picture is None:
        return palette()
    height, width, _ = made.picture.shape
    whole = np.zeros((height + SIDE, max(width, SIDE), 3), np.uint8)
    whole[:height, :width] = made.picture
    whole[height:, :SIDE] = palette()
    return whole


def places(part: Part, made: Shape) -> NDArray[np.float64]:
    """(n, 2) places of a part's vertices in the texture, from its lower left corner."""
    width, height = SIDE, 0
    if made.picture is not None:
        height, width = made.picture.shape[0], max(made.picture.shape[1], SIDE)
    if part.uv is not None and made.picture is not None:
        across, up = part.uv[:, 0] * made.picture.shape[1], SIDE + part.uv[:, 1] * height
    else:
        red, green, blue = (min(LEVELS - 1, round(c * (LEVELS - 1))) for c in part.rgba[:3])
        index = red * 256 + green * 16 + blue
        across = np.full(len(part.vertices), index % SIDE + 0.5)
        up = np.full(len(part.vertices), SIDE - index // SIDE - 0.5)
    return np.stack([across / width, up / (height + SIDE)], 1)


def mesh(made: Shape) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """All triangles as one mesh.

    Returns:
        (n, 8): metres, the unit normal and the place in the texture; and (m, 3) indices of rows.
        Triangles share a corner only where they lie in one plane, so that they look flat.

    Raises:
        ShapeError: there is no triangle, an index leads nowhere, or a coordinate is not finite.
    """
    points, spots = [], []
    for part in made.parts:
        if len(part.faces) and (part.faces.min() < 0 or part.faces.max() >= len(part.vertices)):
            raise ShapeError(f"{made.name}: a triangle has a corner that does not exist")
        points.append(part.vertices[part.faces].reshape(-1, 3))
        spots.append(places(part, made)[part.faces].reshape(-1, 2))
    corners = np.concatenate(points).astype(float) if points else np.empty((0, 3))
    if not len(corners):
        raise ShapeError(f"{made.name}: there is nothing to show")
    if not np.isfinite(corners).all():
        raise ShapeError(f"{made.name}: a coordinate is not a finite number")
    a, b, c = corners[0::3], corners[1::3], corners[2::3]
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-12)
    rows = np.hstack([corners, np.repeat(normals, 3, 0), np.concatenate(spots)])
    unique, back = np.unique(rows.round(5), axis=0, return_inverse=True)
    return unique, back.reshape(-1, 3)


class Bodies:
    """Makes bodies of shapes in one physics client, and shares what equal ones have in common.

    Args:
        client: the number of a connected physics client.
    """

    def __init__(self, client: int) -> None:
        self._bullet = import_pybullet()
        self._client = client
        self._shared: dict[tuple[str, float], tuple[int, int]] = {}
        self._textures: dict[str, int] = {}

    def add(
        self, made: Shape, position: tuple[float, float, float] = (0, 0, 0), yaw: float = 0.0,
        scale: float = 1.0,
    ) -> int:  # fmt: skip
        """A body that stands still; its number is in the camera's segmentation mask.

        Args:
            made: what it looks like; shapes of one name are taken to be equal.
            position: of the middle of its footprint, metres.
            yaw: where its front looks to, radians from the x axis.
            scale: how much larger than the shape.

        Raises:
            ShapeError: the mesh cannot be loaded.
        """
        bullet, client = self._bullet, self._client
        with _loading(made.name, bullet):
            if not (np.isfinite(scale) and scale > 0):
                raise ShapeError(f"{made.name}: the scale {scale} is not above 0")
            seen, touched = self._shapes(made, scale)
            turned = bullet.getQuaternionFromEuler((0, 0, yaw))
            body: int = bullet.createMultiBody(
                0, touched, seen, position, turned, physicsClientId=client
            )
            if body < 0:
                raise ShapeError(f"{made.name}: pybullet made no body of it")
            bullet.changeVisualShape(
                body, -1, textureUniqueId=self._texture(made), physicsClientId=client
            )
        return body

    def add_object(
        self, cls: str, variant: str = "0", position: tuple[float, float, float] = (0, 0, 0),
        yaw: float = 0.0, scale: float = 1.0,
    ) -> tuple[int, str | None]:  # fmt: skip
        """A body of a class and variant, or a plain box in its place.

        Returns:
            The body's number, and why it is a box, or None.
        """
        from symboslam.errors import UnknownNameError

        try:
            return self.add(shape(cls, variant), position, yaw, scale), None
        except (ShapeError, UnknownNameError) as error:
            size = scale if np.isfinite(scale) and scale > 0 else 1.0
            return self.add(placeholder(cls), position, yaw, size), str(error)

    def _shapes(self, made: Shape, scale: float) -> tuple[int, int]:
        """Numbers of the visual and the collision shape."""
        key = (made.name, round(scale, 4))
        if key not in self._shared:
            bullet, client = self._bullet, self._client
            rows, faces = mesh(made)
            seen = bullet.createVisualShape(
                bullet.GEOM_MESH, vertices=(rows[:, :3] * scale).tolist(),
                indices=faces.ravel().tolist(), normals=rows[:, 3:6].tolist(),
                uvs=rows[:, 6:].tolist(), physicsClientId=client,
            )  # fmt: skip
            low, high = made.bounds * scale
            cls = made.name.partition("/")[0]
            half = np.maximum((high - low) / 2, 0.01)
            if cls in FLAT:
                half[2] = FLAT[cls] * scale / 2
            middle = [*((low + high)[:2] / 2), low[2] + half[2]]
            if cls in ROUND:
                touched = bullet.createCollisionShape(
                    bullet.GEOM_CYLINDER, radius=float(half[:2].mean()), height=float(2 * half[2]),
                    collisionFramePosition=middle, physicsClientId=client,
                )  # fmt: skip
            else:
                touched = bullet.createCollisionShape(
                    bullet.GEOM_BOX, halfExtents=half.tolist(), collisionFramePosition=middle,
                    physicsClientId=client,
                )  # fmt: skip
            if seen < 0 or touched < 0:
                raise ShapeError(f"{made.name}: pybullet did not take the mesh")
            self._shared[key] = (seen, touched)
        return self._shared[key]

    def _texture(self, made: Shape) -> int:
        """Number of the palette's texture, or of the shape's own."""
        key = "" if made.picture is None else made.name
        if key not in self._textures:
            from PIL import Image

            with tempfile.TemporaryDirectory() as folder:  # pybullet reads textures from files
                path = Path(folder) / "texture.png"
                Image.fromarray(texture(made)).save(path)
                number = self._bullet.loadTexture(str(path), physicsClientId=self._client)
            if number < 0:
                raise ShapeError(f"{made.name}: pybullet did not take the texture")
            self._textures[key] = number
        return self._textures[key]


@contextmanager
def _loading(name: str, bullet: Any) -> Iterator[None]:
    """What pybullet complains of becomes an error of ours that says of which shape."""
    try:
        yield
    except bullet.error as error:
        raise ShapeError(f"{name}: pybullet: {error}") from error
