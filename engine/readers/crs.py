"""Coordinate systems of landmark files: degrees, plain metres, or anything that PROJ knows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from symboslam.errors import GeometryError

if TYPE_CHECKING:
    from pyproj import Transformer

Floats = NDArray[np.float64]
DEGREES = "OGC:CRS84"
METRES = "m"
_SAME_AS_DEGREES = {
    "CRS84",
    "OGC:CRS84",
    "EPSG:4326",
    "WGS84",
    "URN:OGC:DEF:CRS:OGC:1.3:CRS84",
    "URN:OGC:DEF:CRS:OGC::CRS84",
    "URN:OGC:DEF:CRS:EPSG::4326",
    "HTTP://WWW.OPENGIS.NET/DEF/CRS/OGC/1.3/CRS84",
    "HTTP://WWW.OPENGIS.NET/DEF/CRS/EPSG/0/4326",
}


@dataclass(frozen=True)
class CoordinateSystem:
    """How the coordinates of an input are to be read; x always comes first.

    Attributes:
        name: ``OGC:CRS84``, ``m``, or the name that was given.
        degrees: True if x is a longitude and y a latitude.
        transformer: turns other systems into longitude and latitude.
    """

    name: str
    degrees: bool
    transformer: Transformer | None = None

    @property
    def metric(self) -> bool:
        """True if the coordinates are local metres, which are taken as they are."""
        return self.name == METRES

    def outside(self, x: Floats, y: Floats) -> tuple[Floats, Floats]:
        """Input coordinates -> the frame's outside coordinates: lon/lat, or local metres.

        What cannot be converted becomes infinite.
        """
        if self.transformer is None:
            return x, y
        longitude, latitude = self.transformer.transform(x, y)
        return np.asarray(longitude), np.asarray(latitude)


def canonical(name: str) -> str:
    """The name with all spellings of plain degrees and of local metres made one."""
    key = name.strip().upper()
    if key in {"M", "METRES", "METERS"}:
        return METRES
    return DEGREES if key in _SAME_AS_DEGREES else name.strip()


def coordinate_system(name: str, source: str = "") -> CoordinateSystem:
    """The coordinate system with this name.

    Args:
        name: ``m``, ``EPSG:4326``, ``OGC:CRS84``, a URN, or any text that PROJ understands.
        source: the file that names it, for messages.

    Raises:
        GeometryError: PROJ does not know it, or it does not locate things on a map.
    """
    name = canonical(name)
    if name in (METRES, DEGREES):
        return CoordinateSystem(name, degrees=name == DEGREES)
    from pyproj import CRS, Transformer
    from pyproj.exceptions import CRSError, ProjError

    prefix = f"{source}: " if source else ""
    try:
        crs = CRS.from_user_input(name)
        if not (crs.is_geographic or crs.is_projected):
            raise GeometryError(
                f"{prefix}the coordinate system {name!r} is a {crs.type_name}, not one of maps: "
                "give a geographic or projected one such as EPSG:4326, or m for local metres"
            )
        transformer = Transformer.from_crs(crs, DEGREES, always_xy=True)
    except (CRSError, ProjError, ValueError) as error:
        raise GeometryError(
            f"{prefix}unknown coordinate system {name!r}: "
            "give one such as EPSG:28355, OGC:CRS84, or m for local metres"
        ) from error
    return CoordinateSystem(name, degrees=crs.is_geographic, transformer=transformer)
