"""Sizes: how long, wide and high an object of each of the 56 detector classes nominally is."""

from __future__ import annotations

from typing import NamedTuple


class Size(NamedTuple):
    """Nominal size of a class at scale 1, in metres.

    Attributes:
        length: along the object's heading.
        width: across it.
        height: above the ground.
        moves: whether the class is dynamic, as the ontology has it.
    """

    length: float
    width: float
    height: float
    moves: bool = False

    @property
    def radius(self) -> float:
        """Half the diagonal of the footprint, in metres."""
        return 0.5 * float((self.length**2 + self.width**2) ** 0.5)


SIZES: dict[str, Size] = {
    "Aircraft": Size(12.0, 11.0, 4.0, True),
    "Airplane": Size(34.0, 32.0, 11.0, True),
    "Apartment": Size(24.0, 14.0, 15.0),
    "AttackHelicopter": Size(15.0, 5.0, 4.0, True),
    "BasketballBackboard": Size(1.5, 1.8, 3.9),
    "BasketballCourt": Size(20.0, 12.0, 3.9),
    "Bench": Size(1.8, 0.7, 0.9),
    "Billboard": Size(6.0, 0.8, 6.0),
    "Bird": Size(0.4, 0.4, 0.4, True),
    "Bomb": Size(2.0, 0.5, 0.5, True),
    "Boy": Size(0.4, 0.5, 1.3, True),
    "Building": Size(16.0, 11.0, 7.0),
    "Bull": Size(2.5, 0.9, 1.6, True),
    "Bus": Size(11.0, 2.5, 3.1, True),
    "BusStop": Size(3.6, 1.6, 2.6),
    "C17": Size(53.0, 51.0, 16.8, True),
    "Car": Size(4.5, 1.8, 1.5, True),
    "Cat": Size(0.5, 0.2, 0.3, True),
    "Cattle": Size(2.3, 0.8, 1.5, True),
    "ConvenienceStore": Size(14.0, 10.0, 5.0),
    "Dog": Size(0.9, 0.35, 0.6, True),
    "Factory": Size(36.0, 24.0, 12.0),
    "FighterJet": Size(16.0, 11.0, 4.8, True),
    "FireHydrant": Size(0.4, 0.4, 0.8),
    "GasStation": Size(20.0, 12.0, 6.0),
    "GasStationPump": Size(1.0, 0.6, 2.0),
    "Girl": Size(0.4, 0.5, 1.3, True),
    "Helicopter": Size(12.0, 3.5, 3.5, True),
    "Horse": Size(2.4, 0.7, 1.8, True),
    "House": Size(13.0, 9.5, 6.0),
    "Humvee": Size(4.7, 2.2, 1.9, True),
    "Kangaroo": Size(1.2, 0.5, 1.5, True),
    "LandVehicle": Size(5.5, 2.0, 2.2, True),
    "Missile": Size(6.0, 0.6, 0.6, True),
    "MissileLauncher": Size(9.0, 3.0, 4.0, True),
    "OfficeBuilding": Size(22.0, 16.0, 20.0),
    "Person": Size(0.5, 0.6, 1.75, True),
    "Plant": Size(1.2, 1.2, 1.0),
    "PowerSubstation": Size(12.0, 9.0, 5.0),
    "Rifle": Size(1.0, 0.2, 0.3, True),
    "Rotunda": Size(6.0, 6.0, 4.5),
    "Sheep": Size(1.3, 0.6, 1.0, True),
    "ShippingContainer": Size(6.1, 2.44, 2.6),
    "Silo": Size(7.0, 7.0, 14.0),
    "Skyscraper": Size(30.0, 30.0, 90.0),
    "Slide": Size(4.0, 1.2, 2.6),
    "SoccerGoals": Size(2.2, 7.3, 2.4),
    "StopSign": Size(0.2, 0.8, 2.4),
    "Swingset": Size(2.4, 4.0, 2.5),
    "Table": Size(1.8, 1.6, 0.8),
    "Tank": Size(8.0, 3.6, 2.5, True),
    "Tower": Size(6.0, 6.0, 30.0),
    "TrafficLight": Size(0.5, 0.5, 4.0),
    "Train": Size(22.0, 3.0, 4.0, True),
    "Tree": Size(5.0, 5.0, 8.0),
    "Warehouse": Size(32.0, 20.0, 9.0),
}
"""Detector class -> its nominal size. Meshes are scaled to these, and placement reckons with them.

The names are the ontology's detector labels; the file is the plain list of classes of worlds.
"""

CLASSES: tuple[str, ...] = tuple(SIZES)
"""The 56 detector classes."""

OTHER_NAMES = {"unspecifiedbuilding": "Building"}
"""Local names of the ontology, in lower case, that are not the detector's label."""

_BY_CASE = {name.casefold(): name for name in CLASSES} | OTHER_NAMES


def find_class(name: str) -> str | None:
    """The detector class of that name or local name of the ontology, whatever its case; or None."""
    return _BY_CASE.get(name.strip().casefold())


def near_classes(name: str) -> list[str]:
    """Up to three classes whose names come close."""
    from difflib import get_close_matches

    return [_BY_CASE[n] for n in get_close_matches(name.casefold(), _BY_CASE, n=3, cutoff=0.7)]
