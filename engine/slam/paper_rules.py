"""Rules of the paper's merging: how near is near, how alike is alike (docs/decisions/0019)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.landmark_error import SIMILAR
from symboslam.engine.slam.log import Floats, Mission
from symboslam.engine.slam.spacing import radius_by_sight
from symboslam.errors import InputError


@dataclass(frozen=True)
class Rules:
    """What may be one landmark.

    Attributes:
        radius: the paper's a, in metres: landmarks no farther apart may be one.
        similarity: (C, C) how alike classes are, in [0, 1].
        dynamic: (C,) which classes move.
        least: classes that are at least so alike are similar; all others are dissimilar.
    """

    radius: float
    similarity: Floats
    dynamic: NDArray[np.bool_]
    least: float = SIMILAR

    def __post_init__(self) -> None:
        if not 0 < self.radius < np.inf:
            raise InputError(f"the radius of merging is {self.radius}; give metres > 0")
        if not 0 < self.least <= 1:
            raise InputError(f"the similarity is {self.least}; it must lie above 0 and up to 1")

    @classmethod
    def of(cls, mission: Mission, radius: float | None = None, least: float = SIMILAR) -> Rules:
        """Rules for a mission; without a radius that of ``radius_by_sight``."""
        if radius is None:
            radius = radius_by_sight(robot.seen for robot in mission.robots)
        return cls(radius, mission.similarity, mission.dynamic, least)

    @property
    def alike(self) -> NDArray[np.bool_]:
        """(C, C) which classes are similar; each is to itself."""
        return np.asarray(
            (self.similarity >= self.least) | np.eye(len(self.similarity), dtype=bool)
        )
