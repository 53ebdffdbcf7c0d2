"""Frequencies: how many objects of each class a zone of each type has, from real counts.

The counts are in ``class_frequencies.csv``. They come from maps of real places, never from the
ontology: a world made from them tests the ontology without knowing it.
"""

from __future__ import annotations

import csv
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

COMPANIONS: tuple[tuple[str, str, float], ...] = (
    ("GasStationPump", "GasStation", 2.0),
    ("Person", "Building", 0.03),
    ("Person", "ConvenienceStore", 0.3),
    ("Person", "Bench", 0.2),
    ("Boy", "Swingset", 0.5),
    ("Girl", "Swingset", 0.5),
    ("Boy", "House", 0.02),
    ("Girl", "House", 0.02),
    ("Dog", "House", 0.05),
    ("Dog", "Bench", 0.05),
    ("Cat", "House", 0.05),
    ("Bird", "Tree", 0.02),
    ("Plant", "House", 0.1),
    ("Plant", "Tree", 0.03),
    ("Bus", "BusStop", 0.1),
    ("LandVehicle", "Car", 0.1),
    ("Billboard", "ConvenienceStore", 0.03),
    ("Skyscraper", "OfficeBuilding", 0.05),
    ("PowerSubstation", "Tower", 0.2),
    ("ShippingContainer", "Warehouse", 0.5),
    ("ShippingContainer", "Factory", 0.1),
    ("BasketballCourt", "Swingset", 0.2),
    ("BasketballBackboard", "Swingset", 0.2),
    ("SoccerGoals", "Swingset", 0.3),
    ("Rotunda", "Bench", 0.03),
    ("Boy", "(school)", 1.5),
    ("Girl", "(school)", 1.5),
    ("BasketballCourt", "(school)", 0.3),
    ("BasketballBackboard", "(school)", 0.3),
    ("SoccerGoals", "(school)", 0.3),
    ("Person", "(restaurant)", 0.5),
    ("Table", "(restaurant)", 0.5),
    ("SoccerGoals", "(stadium)", 2.0),
    ("Person", "(stadium)", 2.0),
)
"""Classes that no map counts (people, animals, vehicles, ...).

Each comes with a class or site that is counted, so many to one of it, and is spread over zone types
as that is. The ratios are our assumption.
"""

OPEN_GROUND: Mapping[str, float] = {
    "Cattle": 3.0,
    "Sheep": 4.0,
    "Bull": 0.5,
    "Horse": 1.0,
    "Kangaroo": 2.0,
}
"""Animals of a square kilometre of NonUrban land, which is farmland, heath and wood; assumed."""


@dataclass(frozen=True)
class Frequencies:
    """Real counts by zone type.

    Attributes:
        area_km2: environment -> square kilometres that were counted.
        counts: class -> environment -> objects that were counted.
        sites: a site such as ``(school)`` -> environment -> how many were counted.
    """

    area_km2: Mapping[str, float]
    counts: Mapping[str, Mapping[str, int]]
    sites: Mapping[str, Mapping[str, int]]

    @property
    def environments(self) -> tuple[str, ...]:
        """Types of which some area was counted."""
        return tuple(e for e, area in self.area_km2.items() if area > 0)

    def counted(self, environment: str) -> dict[str, float]:
        """Class -> counted objects per square kilometre of a zone type."""
        area = self.area_km2[environment]
        return {
            name: row[environment] / area for name, row in self.counts.items() if row[environment]
        }

    def density(self, environment: str) -> dict[str, float]:
        """Class -> objects per square kilometre: counted ones, companions, animals outdoors."""
        found = self.counted(environment)
        area = self.area_km2[environment]
        hosts = found | {name: row[environment] / area for name, row in self.sites.items()}
        for name, host, ratio in COMPANIONS:
            if hosts.get(host, 0.0) > 0:
                found[name] = found.get(name, 0.0) + ratio * hosts[host]
        if environment == "NonUrban":
            for name, rate in OPEN_GROUND.items():
                found[name] = found.get(name, 0.0) + rate
        return found


@cache
def real_frequencies() -> Frequencies:
    """The counts that ship with the package."""
    path = files("symboslam.sim_bridge.worlds") / "class_frequencies.csv"
    lines = path.read_text(encoding="utf-8").splitlines()
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    found = {row.pop("class"): {k: v for k, v in row.items() if k != "tags"} for row in rows}
    area = {name: float(value) for name, value in found.pop("(km2)").items()}
    counts = {name: {e: int(n) for e, n in row.items()} for name, row in found.items()}
    classes = {name: row for name, row in counts.items() if not name.startswith("(")}
    sites = {name: row for name, row in counts.items() if name.startswith("(")}
    return Frequencies(area, classes, sites)
