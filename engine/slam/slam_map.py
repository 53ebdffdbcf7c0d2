"""SlamMap: where robots went and which landmarks they saw, as an estimator has it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.log import Floats, Ints


@dataclass(frozen=True)
class Trajectory:
    """Where a robot was.

    Attributes:
        time: (n,) seconds, increasing.
        pose: (n, 3) x, y, heading in the collective frame.
        covariance: (n, 3, 3) of the poses in that frame; None where an estimator has none.
    """

    time: Floats
    pose: Floats
    covariance: Floats | None = None


@dataclass(frozen=True)
class MappedLandmarks:
    """Landmarks of a map, column by column.

    Attributes:
        id: (L,) names, unique.
        xy: (L, 2) metres in the collective frame.
        covariance: (L, 2, 2) square metres; NaN where an estimator has none.
        feature: (L,) position in ``Mission.classes``.
        confidence: (L,) of the class, in (0, 1].
        sightings: (L,) how many measurements are of it.
        dynamic: (L,) whether things of its class move; such are evidence, not landmarks to go by.
        key: (L,) what names it beyond doubt; "" for most.
    """

    id: NDArray[np.object_]
    xy: Floats
    covariance: Floats
    feature: Ints
    confidence: Floats
    sightings: Ints
    dynamic: NDArray[np.bool_]
    key: NDArray[np.object_]

    def __len__(self) -> int:
        return len(self.xy)


@dataclass(frozen=True)
class SlamMap:
    """The map of one or several robots.

    Attributes:
        trajectories: robot -> where it was; robots that could not be placed are left out.
        landmarks: all landmarks.
        landmark_of: robot -> (m,) position in ``landmarks`` of what each row of its
            ``Measurements`` is of; -1 for none.
        doubts: why the map should not be trusted, one sentence each; empty if it can be.
        notes: what was left out or mended on the way, one sentence each.
    """

    trajectories: Mapping[str, Trajectory]
    landmarks: MappedLandmarks
    landmark_of: Mapping[str, Ints]
    doubts: tuple[str, ...] = ()
    notes: tuple[str, ...] = field(default=())
