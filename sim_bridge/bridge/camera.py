"""Camera: pictures and segmentation by TinyRenderer, skipped where nothing can be seen."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.sim_bridge.bridge.scene import Scene, colour_of, in_view
from symboslam.sim_bridge.bridge.settings import CameraSpec

Pose = tuple[float, float, float]


@dataclass(frozen=True)
class Picture:
    """What a camera saw.

    Attributes:
        raw: (height, width, 3) bytes, as they were drawn, without a ground.
        segmentation: (height, width) number of the body at each point; -1 for ground and sky.
        ground: colour of the ground.
    """

    raw: NDArray[np.uint8]
    segmentation: NDArray[np.int32]
    ground: tuple[int, int, int]

    @property
    def rgb(self) -> NDArray[np.uint8]:
        """(height, width, 3) bytes.

        The camera is level, so that the ground begins below the middle row. It is painted where
        nothing stands, because TinyRenderer takes longer for a plane than for all objects.
        """
        painted = self.raw.copy()
        horizon = len(painted) // 2
        painted[horizon:][self.segmentation[horizon:] < 0] = self.ground
        return painted


class Camera:
    """Looks ahead from a robot.

    Args:
        scene: what there is to see.
        spec: of the camera.
        least: height over distance of the smallest thing that a detector finds; without one in
            view nothing is drawn.

    Attributes:
        drawn: pictures that were drawn.
        skipped: pictures that were not, because nothing could be seen.
    """

    def __init__(self, scene: Scene, spec: CameraSpec, least: float = 0.0) -> None:
        self._scene, self.spec, self._least = scene, spec, least
        self.drawn = self.skipped = 0
        self._ground = colour_of(scene.stock.world.ground.colour)
        vertical = 2 * math.atan(spec.height / 2 / spec.focal)
        self._lens = scene.bullet.computeProjectionMatrixFOV(
            math.degrees(vertical), spec.width / spec.height, spec.near, spec.far
        )

    def look(self, pose: Pose, lift: float = 0.0) -> Picture | None:
        """The picture from a pose, or None where no object can be seen.

        Args:
            pose: of the robot: metres and radians.
            lift: metres by which the robot stands higher than the ground.
        """
        spec = self.spec
        if not in_view(self._scene.stock, pose, spec.fov, spec.far, self._least):
            self.skipped += 1
            return None
        self.drawn += 1
        bullet = self._scene.bullet
        x, y, heading = pose
        z = spec.mount + lift
        view = bullet.computeViewMatrix(
            (x, y, z), (x + math.cos(heading), y + math.sin(heading), z), (0, 0, 1)
        )
        _, _, rgba, _, segmentation = bullet.getCameraImage(
            spec.width, spec.height, view, self._lens, shadow=0,
            renderer=bullet.ER_TINY_RENDERER, physicsClientId=self._scene.client,
        )  # fmt: skip
        size = spec.height, spec.width
        return Picture(
            np.asarray(rgba, np.uint8).reshape(*size, 4)[:, :, :3],
            np.asarray(segmentation, np.int32).reshape(size),
            self._ground,
        )
