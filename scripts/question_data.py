"""Make ``competency_questions/data/town.ttl``: a small map, of landmarks placed by hand.

The town is 1.2 km square. What stands where is written below in metres, so that the right answers
can be told from this file alone; a seed only moves each thing a little and gives it a confidence.
Run it after a change of the ontology's strengths or reasons; ``tests/test_question_data.py`` says
when that is needed. Answers that then change are told anew by ``tests/test_map_questions.py``.
"""

from __future__ import annotations

import random
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any

from symboslam.engine.classify import classify
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.frame import Frame
from symboslam.engine.readers import read_landmarks
from symboslam.engine.writers import write_map
from symboslam.reasoning.knowledge import Knowledge

SEED = 4
SIDE = 1200.0
CENTRE = (149.1, -35.2)
BASE = "https://example.org/town/"
TARGET = Path(__file__).parents[1] / "competency_questions" / "data" / "town.ttl"
START = datetime(2026, 3, 2, 9, 0, tzinfo=UTC)
ENDED = datetime(2026, 3, 2, 10, 30, tzinfo=UTC)
CELLS = 6
"""Cells of 200 m: column c begins 200 c metres from the west, row r 200 r metres from the south."""

ROVER_1, ROVER_2, DRONE = "rover 1", "rover 2", "drone"

# Who saw what, where: metres east and north of the town's south-west corner, for each thing.
PLACED: tuple[tuple[str, str, tuple[tuple[int, int], ...]], ...] = (
    # The north-west is a suburb.
    (ROVER_1, "House", ((40, 1160), (80, 1150), (130, 1160), (170, 1140), (50, 1080), (90, 1070))),
    (ROVER_1, "House", ((150, 1060), (230, 1150), (280, 1160), (330, 1150), (250, 1070))),
    (ROVER_1, "House", ((310, 1060), (370, 1080), (40, 950), (90, 940), (150, 960), (60, 870))),
    (ROVER_1, "House", ((120, 860), (180, 850), (240, 950), (300, 940), (360, 960))),
    (ROVER_1, "Garage", ((60, 1140), (150, 1150), (270, 1050), (100, 930))),
    (ROVER_1, "Apartment", ((260, 860), (320, 850))),
    (ROVER_1, "Dog", ((110, 1110), (340, 1100))),
    # North of the centre is a park with a playground.
    (ROVER_2, "Tree", ((440, 1150), (480, 1120), (530, 1160), (570, 1090), (620, 1150))),
    (ROVER_2, "Tree", ((690, 1120), (740, 1150), (460, 1040), (640, 1030), (770, 1060))),
    (ROVER_1, "Tree", ((420, 1170), (430, 1060))),
    (ROVER_2, "Bench", ((500, 1080), (590, 1040), (710, 1070))),
    (ROVER_2, "Swingset", ((550, 1120),)),
    (ROVER_2, "Slide", ((560, 1130),)),
    (ROVER_2, "Rotunda", ((650, 1090),)),
    # The town centre.
    (ROVER_2, "OfficeBuilding", ((440, 760), (520, 750), (470, 680), (640, 740), (720, 650))),
    (DRONE, "OfficeBuilding", ((770, 770), (760, 720))),
    (ROVER_2, "Bank", ((560, 700), (670, 680))),
    (ROVER_2, "Supermarket", ((480, 550), (700, 560))),
    (ROVER_2, "ConvenienceStore", ((550, 520), (630, 480))),
    (ROVER_2, "Restaurant", ((590, 620), (620, 570), (530, 640))),
    (ROVER_2, "Person", ((580, 650), (610, 600))),
    (ROVER_2, "BusStop", ((600, 710), (450, 430))),
    # West of it are the school and its sports ground.
    (ROVER_1, "SchoolBuilding", ((100, 700), (160, 680))),
    (ROVER_1, "BasketballCourt", ((80, 560),)),
    (ROVER_1, "SoccerGoals", ((160, 520), (160, 440))),
    # Works and sheds in the east.
    (DRONE, "Factory", ((900, 700), (1080, 660))),
    (DRONE, "Warehouse", ((870, 540), (1000, 520), (1120, 480))),
    (DRONE, "ShippingContainer", ((940, 600), (950, 610), (1050, 590), (1060, 580))),
    (DRONE, "StorageTank", ((1150, 720), (1160, 700))),
    # Open country in the north-east, with a silo by the works.
    (DRONE, "Sheep", ((900, 1100), (910, 1090), (1000, 1150))),
    (DRONE, "Cattle", ((1100, 1060), (1120, 1080))),
    (DRONE, "Barn", ((1050, 1100),)),
    (DRONE, "Silo", ((950, 870),)),
    # A railway along the south.
    (ROVER_1, "TrainStation", ((300, 140),)),
    (ROVER_1, "RailPlatform", ((270, 110), (330, 110), (60, 120), (120, 90), (500, 110))),
    (DRONE, "PowerSubstation", ((620, 240),)),
)
# From a list of the council's, which no robot saw: no agent and no time.
LISTED = (("FireHydrant", 210, 300), ("FireHydrant", 430, 330), ("Bench", 570, 660))
# What cannot be used: no such class (2), outside the area (1), and one line that comes twice (1).
USELESS = (("Obelisk", 600, 900), ("Obelisk", 300, 300), ("House", -50, 600))
SURVEYED = ((0, 0), (800, 0), (800, 400), (1000, 400), (1000, 600), (1200, 600), (1200, 1200))
"""The south-east was never looked at: nor the square south of 400 m, nor the cell north of it."""


def landmarks() -> dict[str, Any]:
    """The landmarks of the town as a GeoJSON document."""
    rng, when = random.Random(SEED), START
    found: list[dict[str, Any]] = []
    for agent, kind, places in PLACED:
        for x, y in places:
            when += timedelta(seconds=40)
            found.append(
                _point(
                    kind,
                    x + rng.uniform(-5, 5),
                    y + rng.uniform(-5, 5),
                    id=f"{kind}-{1 + sum(f['properties']['class'] == kind for f in found)}",
                    confidence=round(rng.uniform(0.55, 0.98), 2),
                    agent=agent,
                    time=when.isoformat(),
                )
            )
    listed = [_point(kind, x, y) for kind, x, y in LISTED]
    for number, entry in enumerate(listed, 1):
        entry["properties"]["id"] = f"council-{number}"
    useless = [_point(kind, x, y) for kind, x, y in USELESS]
    corners = [(0.0, 0.0), (SIDE, SIDE)]
    (west, south), (east, north) = (_degrees(x, y) for x, y in corners)
    ring = [_degrees(x, y) for x, y in (*SURVEYED, (0, 1200), (0, 0))]
    return {
        "type": "FeatureCollection",
        "bbox": [west, south, east, north],
        "surveyed": {"type": "Polygon", "coordinates": [ring]},
        "attribution": "SymboSLAM contributors, CC BY 4.0",
        "features": [*found, *listed, listed[-1], *useless],
    }


def town() -> EnvironmentMap:
    """The classified town."""
    knowledge = Knowledge.load()
    # A threshold of 1 cuts all that was seen down to the cells of 200 m.
    return classify(read_landmarks(landmarks(), knowledge), knowledge, cells=CELLS, threshold=1.0)


def write(target: Path = TARGET) -> None:
    """Write the town as Turtle; the same statements each time."""
    write_map(town(), target, reasons=4, base=BASE, ended=ENDED)


def _point(kind: str, x: float, y: float, **properties: Any) -> dict[str, Any]:
    return {
        "type": "Feature",
        "geometry": {"type": "Point", "coordinates": list(_degrees(x, y))},
        "properties": {"class": kind, **properties},
    }


def _degrees(x: float, y: float) -> tuple[float, float]:
    """Longitude and latitude of a place in the town's metres."""
    longitude, latitude = Frame.around(*CENTRE).from_metres(x - SIDE / 2, y - SIDE / 2)
    return round(float(longitude), 7), round(float(latitude), 7)


if __name__ == "__main__":
    write()
