"""Sizes: how long, wide and high an object of each of the 56 detector classes nominally is."""

from __future__ import annotations

from typing import NamedTuple


class Size(NamedTuple):
    """Nominal size of a class at scale 1, in metres.

    Attributes:
        length: along the object's heading: x of a mesh, whose front is +x.
        width: across it: y of a mesh.
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
    # Buildings: the depth of the plot, the width of the street front, the height.
    "Apartment": Size(14.0, 24.0, 16.0),  # five storeys with balconies
    "Building": Size(14.0, 18.0, 11.0),  # a public building of two storeys with a portico
    "ConvenienceStore": Size(10.0, 14.0, 5.0),  # one storey with a shop window
    "Factory": Size(22.0, 34.0, 20.0),  # a hall with a saw-tooth roof; the chimney sets the height
    "GasStation": Size(16.0, 18.0, 6.0),  # a canopy over pumps, 4.5 m clear, and a kiosk
    "House": Size(10.0, 12.0, 7.5),  # one or two storeys with a pitched roof
    "OfficeBuilding": Size(18.0, 26.0, 22.0),  # six storeys of glass bands
    "Rotunda": Size(20.0, 20.0, 15.0),  # a round hall with columns and a dome
    "Skyscraper": Size(26.0, 26.0, 110.0),  # thirty storeys
    "Tower": Size(10.0, 10.0, 42.0),  # a mast or an observation tower
    "Warehouse": Size(26.0, 38.0, 9.0),  # a low hall with loading gates
    # Works.
    "GasStationPump": Size(0.7, 1.1, 2.0),
    "PowerSubstation": Size(14.0, 18.0, 8.0),  # transformers and gantries in a fence
    "ShippingContainer": Size(6.1, 2.44, 2.6),  # ISO 20 foot
    "Silo": Size(7.0, 7.0, 16.0),  # a grain silo of a farm
    # Plants.
    "Plant": Size(1.1, 1.1, 1.1),  # a shrub, or a plant in a tub
    "Tree": Size(5.5, 5.5, 9.0),  # a street tree
    # On wheels, rails and tracks.
    "Bus": Size(12.0, 2.55, 3.2, True),  # a city bus
    "Car": Size(4.4, 1.8, 1.5, True),
    "Humvee": Size(4.6, 2.2, 1.9, True),
    "LandVehicle": Size(6.5, 2.3, 2.9, True),  # lorry, tractor, pickup, van
    "MissileLauncher": Size(9.5, 2.8, 4.2, True),  # a lorry with raised tubes
    "Tank": Size(9.0, 3.6, 2.5, True),  # with the gun forward
    "Train": Size(20.0, 2.9, 4.0, True),  # an engine or one railcar
    # In the air; they stand on their wheels.
    "Aircraft": Size(8.3, 11.0, 2.8, True),  # a light propeller plane
    "Airplane": Size(34.0, 34.0, 11.0, True),  # an airliner for short hauls
    "AttackHelicopter": Size(16.5, 13.5, 4.4, True),
    "C17": Size(53.0, 51.7, 16.8, True),  # a four-engined transport
    "FighterJet": Size(15.5, 10.0, 4.8, True),
    "Helicopter": Size(12.0, 10.5, 3.3, True),
    # Weapons.
    "Bomb": Size(2.4, 0.65, 0.95, True),  # an air bomb on a cradle
    "Missile": Size(1.6, 1.6, 7.0, True),  # upright on a stand
    "Rifle": Size(1.05, 0.25, 0.42, True),  # on its bipod
    # Street furniture and signs.
    "Bench": Size(0.65, 1.8, 0.9),
    "Billboard": Size(1.4, 6.5, 6.0),
    "BusStop": Size(1.7, 4.2, 2.8),  # a shelter with its pole
    "FireHydrant": Size(0.5, 0.55, 0.9),
    "StopSign": Size(0.3, 0.8, 2.6),
    "Table": Size(0.9, 1.6, 0.76),
    "TrafficLight": Size(0.55, 0.6, 3.6),
    # Sport and play.
    "BasketballBackboard": Size(1.5, 1.8, 3.9),  # the ring hangs at 3.05 m
    "BasketballCourt": Size(15.0, 28.0, 3.9),
    "Slide": Size(3.6, 1.1, 2.4),
    "SoccerGoals": Size(2.0, 7.5, 2.5),
    "Swingset": Size(1.9, 3.8, 2.4),
    # People and animals, nose to +x.
    "Person": Size(0.42, 0.62, 1.75, True),
    "Boy": Size(0.34, 0.5, 1.25, True),
    "Girl": Size(0.36, 0.5, 1.25, True),
    "Bird": Size(0.55, 0.36, 0.45, True),  # between pigeon and gull; large for the camera's sake
    "Bull": Size(2.5, 0.85, 1.65, True),
    "Cat": Size(0.65, 0.17, 0.36, True),
    "Cattle": Size(2.3, 0.75, 1.45, True),
    "Dog": Size(1.0, 0.28, 0.7, True),
    "Horse": Size(2.5, 0.6, 2.0, True),
    "Kangaroo": Size(1.5, 0.45, 1.5, True),
    "Sheep": Size(1.25, 0.5, 0.95, True),
}
"""Detector class -> its nominal size. Meshes are scaled to these, and placement reckons with them.

Round figures of ordinary specimens, by general knowledge; variants differ from them by a fifth.
Very large things are held to what stands on one plot of the small worlds.

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
