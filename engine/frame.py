"""Frame: the local metric frame of a map and its way back to the input's coordinates."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    from pyproj import Transformer

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Frame:
    """Metres around an origin.

    Attributes:
        geographic: True if the outside coordinates are longitude and latitude (OGC CRS84), then
            metres are an azimuthal equidistant projection about ``origin`` on WGS 84; False if
            the outside coordinates are metres already, then nothing is changed.
        origin: (longitude, latitude) in degrees; unused where not geographic.
    """

    geographic: bool
    origin: tuple[float, float] = (0.0, 0.0)

    @classmethod
    def metric(cls) -> Frame:
        """The frame of input that is in metres."""
        return cls(False)

    @classmethod
    def around(cls, longitude: float, latitude: float) -> Frame:
        """The frame about a place in degrees."""
        return cls(True, (float(longitude), float(latitude)))

    @property
    def name(self) -> str:
        """``OGC:CRS84`` or ``local metres``."""
        return "OGC:CRS84" if self.geographic else "local metres"

    @cached_property
    def _transformer(self) -> Transformer:
        from pyproj import Transformer

        longitude, latitude = self.origin
        return Transformer.from_crs(
            "OGC:CRS84",
            f"+proj=aeqd +lon_0={longitude!r} +lat_0={latitude!r} +datum=WGS84 +units=m",
            always_xy=True,
        )

    def to_metres(self, first: ArrayLike, second: ArrayLike) -> tuple[Floats, Floats]:
        """Outside coordinates -> metres."""
        a, b = np.asarray(first, np.float64), np.asarray(second, np.float64)
        if not self.geographic:
            return a, b
        x, y = self._transformer.transform(a, b)
        return np.asarray(x), np.asarray(y)

    def from_metres(self, x: ArrayLike, y: ArrayLike) -> tuple[Floats, Floats]:
        """Metres -> outside coordinates."""
        a, b = np.asarray(x, np.float64), np.asarray(y, np.float64)
        if not self.geographic:
            return a, b
        first, second = self._transformer.transform(a, b, direction="INVERSE")
        return np.asarray(first), np.asarray(second)
