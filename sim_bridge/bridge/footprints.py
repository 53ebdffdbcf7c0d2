"""Footprints: rectangles and circles on the ground, and which of them a circle touches."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Footprint:
    """What a thing covers, as robots bump into it.

    Attributes:
        x: metres, of its middle.
        y: metres.
        heading: radians, of the axis of ``half_length``.
        half_length: metres; the radius of a circle.
        half_width: metres; not used by a circle.
        circle: whether it is one.
    """

    x: float
    y: float
    heading: float
    half_length: float
    half_width: float
    circle: bool = False


class Footprints:
    """Several of them by number, for one test of all."""

    def __init__(self) -> None:
        self._by_number: dict[int, Footprint] = {}
        self._numbers: list[int] = []
        self._columns: NDArray[np.float64] | None = None

    def __len__(self) -> int:
        return len(self._by_number)

    @property
    def numbers(self) -> set[int]:
        """Numbers of all."""
        return set(self._by_number)

    def add(self, number: int, footprint: Footprint) -> None:
        """Take one over."""
        self._by_number[number] = footprint
        self._columns = None

    def remove(self, number: int) -> None:
        """Forget one, if it is there."""
        self._by_number.pop(number, None)
        self._columns = None

    def gaps(self, x: float, y: float) -> NDArray[np.float64]:
        """(n,) metres from a point to each, 0 inside."""
        c = self._table()
        dx, dy = x - c[:, 0], y - c[:, 1]
        along = np.abs(dx * c[:, 2] + dy * c[:, 3]) - c[:, 4]
        across = np.abs(dy * c[:, 2] - dx * c[:, 3]) - c[:, 5]
        box = np.hypot(np.maximum(along, 0), np.maximum(across, 0))
        round_ = np.maximum(np.hypot(dx, dy) - c[:, 4], 0)
        return np.asarray(np.where(c[:, 6] > 0, round_, box))

    def touched(self, x: float, y: float, radius: float) -> int | None:
        """Number of the nearest that a circle overlaps, or None."""
        if not self._by_number:
            return None
        gaps = self.gaps(x, y)
        nearest = int(gaps.argmin())
        return self._numbers[nearest] if gaps[nearest] < radius else None

    def clearance(self, x: float, y: float) -> float:
        """Metres to the nearest; infinity where there is none."""
        return float(self.gaps(x, y).min()) if self._by_number else math.inf

    def _table(self) -> NDArray[np.float64]:
        if self._columns is None:
            self._numbers = list(self._by_number)
            self._columns = np.array(
                [
                    (f.x, f.y, math.cos(f.heading), math.sin(f.heading), f.half_length,
                     f.half_width, float(f.circle))
                    for f in self._by_number.values()
                ]
            ).reshape(-1, 7)  # fmt: skip
        return self._columns
