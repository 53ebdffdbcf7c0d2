"""How large the objects are: length (x, to the front), width (y) and height (z) in metres.

Round figures of ordinary specimens, by general knowledge; variants differ from them by a fifth.
Very large things are held to what stands on one plot of the small worlds.
"""

from __future__ import annotations

SIZES: dict[str, tuple[float, float, float]] = {
    # Buildings: the depth of the plot, the width of the street front, the height.
    "Apartment": (14.0, 24.0, 16.0),  # five storeys with balconies
    "Building": (14.0, 18.0, 11.0),  # a public building of two storeys with a portico
    "ConvenienceStore": (10.0, 14.0, 5.0),  # one storey with a shop window
    "Factory": (22.0, 34.0, 20.0),  # a hall with a saw-tooth roof; the chimney sets the height
    "GasStation": (16.0, 18.0, 6.0),  # a canopy over pumps, 4.5 m clear, and a kiosk
    "House": (10.0, 12.0, 7.5),  # one or two storeys with a pitched roof
    "OfficeBuilding": (18.0, 26.0, 22.0),  # six storeys of glass bands
    "Rotunda": (20.0, 20.0, 15.0),  # a round hall with columns and a dome
    "Skyscraper": (26.0, 26.0, 110.0),  # thirty storeys
    "Tower": (10.0, 10.0, 42.0),  # a mast or an observation tower
    "Warehouse": (26.0, 38.0, 9.0),  # a low hall with loading gates
    # Works.
    "GasStationPump": (0.7, 1.1, 2.0),
    "PowerSubstation": (14.0, 18.0, 8.0),  # transformers and gantries in a fence
    "ShippingContainer": (6.1, 2.44, 2.6),  # ISO 20 foot
    "Silo": (7.0, 7.0, 16.0),  # a grain silo of a farm
    # Plants.
    "Plant": (1.1, 1.1, 1.1),  # a shrub, or a plant in a tub
    "Tree": (5.5, 5.5, 9.0),  # a street tree
    # On wheels, rails and tracks.
    "Bus": (12.0, 2.55, 3.2),  # a city bus
    "Car": (4.4, 1.8, 1.5),
    "Humvee": (4.6, 2.2, 1.9),
    "LandVehicle": (6.5, 2.3, 2.9),  # lorry, tractor, pickup, van
    "MissileLauncher": (9.5, 2.8, 4.2),  # a lorry with raised tubes
    "Tank": (9.0, 3.6, 2.5),  # with the gun forward
    "Train": (20.0, 2.9, 4.0),  # an engine or one railcar
    # In the air; they stand on their wheels.
    "Aircraft": (8.3, 11.0, 2.8),  # a light propeller plane
    "Airplane": (34.0, 34.0, 11.0),  # an airliner for short hauls
    "AttackHelicopter": (16.5, 13.5, 4.4),
    "C17": (53.0, 51.7, 16.8),  # a four-engined transport
    "FighterJet": (15.5, 10.0, 4.8),
    "Helicopter": (12.0, 10.5, 3.3),
    # Weapons.
    "Bomb": (2.4, 0.65, 0.95),  # an air bomb on a cradle
    "Missile": (1.6, 1.6, 7.0),  # upright on a stand
    "Rifle": (1.05, 0.25, 0.42),  # on its bipod
    # Street furniture and signs.
    "Bench": (0.65, 1.8, 0.9),
    "Billboard": (1.4, 6.5, 6.0),
    "BusStop": (1.7, 4.2, 2.8),  # a shelter with its pole
    "FireHydrant": (0.5, 0.55, 0.9),
    "StopSign": (0.3, 0.8, 2.6),
    "Table": (0.9, 1.6, 0.76),
    "TrafficLight": (0.55, 0.6, 3.6),
    # Sport and play.
    "BasketballBackboard": (1.5, 1.8, 3.9),  # the ring hangs at 3.05 m
    "BasketballCourt": (15.0, 28.0, 3.9),
    "Slide": (3.6, 1.1, 2.4),
    "SoccerGoals": (2.0, 7.5, 2.5),
    "Swingset": (1.9, 3.8, 2.4),
    # People and animals, nose to +x.
    "Person": (0.42, 0.62, 1.75),
    "Boy": (0.34, 0.5, 1.25),
    "Girl": (0.36, 0.5, 1.25),
    "Bird": (0.55, 0.36, 0.45),  # between pigeon and gull; large for the camera's sake
    "Bull": (2.5, 0.85, 1.65),
    "Cat": (0.65, 0.17, 0.36),
    "Cattle": (2.3, 0.75, 1.45),
    "Dog": (1.0, 0.28, 0.7),
    "Horse": (2.5, 0.6, 2.0),
    "Kangaroo": (1.5, 0.45, 1.5),
    "Sheep": (1.25, 0.5, 0.95),
}
