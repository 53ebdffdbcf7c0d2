"""Stand-ins: as which of the 56 detector classes a robot sees what a map tells more finely.

A map knows shoe shops, rail signals and car parks; the detector knows stores, trains and cars. The
answer goes by the ontology's tree of classes alone: never by what a feature indicates.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from symboslam.sim_bridge.worlds.sizes import find_class

if TYPE_CHECKING:
    from symboslam.reasoning.knowledge import Feature

BY_FEATURE = {
    "PowerPole": "Tower",
    "PicnicTable": "Table",
    "GiveWay": "StopSign",
    "PlaygroundSite": "Swingset",
    "RailPlatform": "Train",
    "Parking": "Car",
    "TaxiStand": "Car",
    "CarDealer": "Car",
    "FarmHouse": "House",
    "Garage": "Building",
    "StopPosition": None,  # the bus stop beside it is counted already
    "SubwayEntrance": None,
}
"""Single features that look otherwise than their kind."""

BY_KIND = {
    "Dwelling": "House",
    "WorksBuilding": "Factory",
    "BusinessBuilding": "OfficeBuilding",
    "Office": "OfficeBuilding",
    "Shop": "ConvenienceStore",
    "Building": "Building",
    "PlayEquipment": "Swingset",
    "TallStructure": "Tower",
    "RailwayEquipment": "Train",  # signals and switches stand where trains do
}
"""Kinds of features, the more special first."""


def stand_in(feature: Feature) -> str | None:
    """The detector class that a robot would call this feature, or None if it sees nothing of it.

    A detector class is itself; a kind of a detector class is that class; for others see
    ``BY_FEATURE`` and ``BY_KIND``.
    """
    if feature.detector_label:
        return feature.detector_label
    if feature.name in BY_FEATURE:
        return BY_FEATURE[feature.name]
    for kind in feature.kinds:
        if (found := find_class(kind)) is not None and kind != "Building":
            return found
    return next((BY_KIND[kind] for kind in BY_KIND if kind in feature.kinds), None)
