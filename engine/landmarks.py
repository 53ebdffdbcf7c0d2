"""LandmarkMap: located, labelled landmarks as arrays in a local metric frame."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

    from symboslam.engine.frame import Frame

Box = tuple[float, float, float, float]


@dataclass(frozen=True)
class ReadReport:
    """What a reader took and what it could not use; nothing is dropped silently.

    Attributes:
        source: the file or stream that was read.
        read: landmarks that were taken.
        unknown: ``class`` or ``key=value`` -> how many had no feature in the ontology.
        outside: landmarks outside the requested bounding box.
        duplicates: landmarks left out because their id had occurred before with the same content.
        notes: anything else worth a line to the user.
        attribution: whose data it is and under what licence, one line; empty if not known.
    """

    source: str = ""
    read: int = 0
    unknown: Counter[str] = field(default_factory=Counter)
    outside: int = 0
    duplicates: int = 0
    notes: tuple[str, ...] = ()
    attribution: str = ""


@dataclass(frozen=True)
class LandmarkMap:
    """Landmarks of one map, column by column; all columns have the same length n.

    Attributes:
        feature: (n,) int32, index into ``knowledge.features``.
        x: (n,) metres east of the frame's origin.
        y: (n,) metres north of the frame's origin.
        confidence: (n,) detection confidence in (0, 1].
        static: (n,) bool, whether the feature stays where it is.
        id: (n,) text identifiers, unique.
        frame: how the metres relate to the input's coordinates.
        bbox: area to classify, (min x, min y, max x, max y) in metres.
        surveyed: the area that was looked at, in metres; None means all of ``bbox``.
        time: (n,) ISO 8601 times, or None where the input has none.
        agent: (n,) names of the observing agents, or None where the input has none.
        report: what the reader took and left.
    """

    feature: NDArray[np.int32]
    x: NDArray[np.float64]
    y: NDArray[np.float64]
    confidence: NDArray[np.float64]
    static: NDArray[np.bool_]
    id: NDArray[np.str_]
    frame: Frame
    bbox: Box
    surveyed: BaseGeometry | None = None
    time: NDArray[Any] | None = None
    agent: NDArray[Any] | None = None
    report: ReadReport = field(default_factory=ReadReport)

    def __len__(self) -> int:
        return len(self.feature)

    @cached_property
    def xy(self) -> NDArray[np.float64]:
        """(n, 2) positions in metres."""
        return np.column_stack([self.x, self.y])

    def take(self, index: NDArray[Any]) -> LandmarkMap:
        """The landmarks at ``index`` (integers or a mask), in the same frame and area."""
        return replace(
            self,
            feature=self.feature[index],
            x=self.x[index],
            y=self.y[index],
            confidence=self.confidence[index],
            static=self.static[index],
            id=self.id[index],
            time=None if self.time is None else self.time[index],
            agent=None if self.agent is None else self.agent[index],
        )

    def without(self, *positions: int) -> LandmarkMap:
        """The map without the landmarks at these positions."""
        keep = np.ones(len(self), bool)
        keep[list(positions)] = False
        return self.take(keep)

    def __repr__(self) -> str:
        west, south, east, north = self.bbox
        return (
            f"LandmarkMap({len(self)} landmarks, {(east - west) / 1000:.2f} km x "
            f"{(north - south) / 1000:.2f} km, {self.frame.name})"
        )
