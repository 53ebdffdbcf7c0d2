"""Habits: where in a block objects of each class stand, and how they are turned."""

from __future__ import annotations

from typing import Literal

Habit = Literal["front", "kerb", "corner", "ground"]
"""front: along a street, some metres back, square to it; kerb: beside the street, along it; corner:
beside a crossing; ground: anywhere in the block, often near others of its class."""

_FRONT = (
    "Apartment Building ConvenienceStore Factory GasStation House OfficeBuilding Skyscraper "
    "Warehouse PowerSubstation"
)
_KERB = "BusStop Car Bus LandVehicle FireHydrant Billboard"
_CORNER = "TrafficLight StopSign"

HABITS: dict[str, Habit] = {
    **dict.fromkeys(_FRONT.split(), "front"),
    **dict.fromkeys(_KERB.split(), "kerb"),
    **dict.fromkeys(_CORNER.split(), "corner"),
}
"""Class -> habit; all others stand on the ground."""

NEAR: dict[str, tuple[str, ...]] = {
    "GasStationPump": ("GasStation",),
    "Table": ("Bench", "Table", "ConvenienceStore"),
    "Girl": ("Swingset", "Slide", "House", "Boy", "Girl"),
    "Boy": ("Swingset", "Slide", "House", "Boy", "Girl"),
    "BasketballBackboard": ("BasketballCourt",),
}
"""Class -> what it likes to be near, in place of its own class."""

ALIGNED = frozenset(
    "Airplane Helicopter Train ShippingContainer BasketballCourt BasketballBackboard SoccerGoals "
    "GasStationPump Swingset Slide".split()
)
"""Classes on the ground that are turned as the block is."""

SIGNS: dict[str, tuple[str, ...]] = {
    "StopSign": ("STOP",),
    "ConvenienceStore": ("CORNER SHOP", "FRESH MARKET", "MINI MART", "BOOKS", "SHOES", "BAKERY"),
    "GasStation": ("FUEL", "PETROL 24"),
    "BusStop": ("BUS",),
    "Billboard": ("SALE", "VISIT US", "NEW HOMES"),
    "Factory": ("WORKS",),
    "Warehouse": ("STORAGE", "LOGISTICS"),
}
"""Class -> texts that may be written on it."""
