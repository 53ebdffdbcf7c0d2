"""EyeSim names: what the models and oracle classes of EyeSim scenes are among our classes."""

from __future__ import annotations

import re

from symboslam.sim_bridge.worlds.sizes import find_class

MODELS = {
    "airliner": "Airplane",
    "apartment_bldg": "Apartment",
    "basketball_courts": "BasketballCourt",
    "bldg": "OfficeBuilding",
    "bldg_01": "OfficeBuilding",
    "bldg_02": "Building",
    "bldg_03": "Building",
    "bldg_04": "Building",
    "builder_woman": "Person",
    "bush": "Plant",
    "cockatoo": "Bird",
    "comms_tower": "Tower",
    "container": "ShippingContainer",
    "cow": "Bull",
    "cybertruck": "Car",
    "f15": "FighterJet",
    "gazebo": "Rotunda",
    "hedge": "Plant",
    "helo": "AttackHelicopter",
    "helo_v1": "Helicopter",
    "helo_v2": "Helicopter",
    "hydrant": "FireHydrant",
    "jsf": "FighterJet",
    "kid1": "Boy",
    "kid2": "Girl",
    "mitsi": "Car",
    "mustang": "Car",
    "nissan": "Car",
    "power_tower": "Tower",
    "school": "Building",
    "soccer_fields": "SoccerGoals",
    "soldier": "Person",
    "stop_light": "TrafficLight",
    "stopsign_3": "StopSign",
    "store": "ConvenienceStore",
    "stores": "ConvenienceStore",
    "substation": "PowerSubstation",
    "suit_man": "Person",
    "swings": "Swingset",
    "swwingset": "Swingset",
    "toilets": "Building",
}
"""Model or class, in lower case -> detector class, where it is not the name itself."""

GROUPS = {
    "residential": "Residential",
    "commercial": "Commercial",
    "industrial": "Industrial",
    "comfac": "CommunityFacility",
    "commfac": "CommunityFacility",
    "community facility": "CommunityFacility",
    "parks": "ParksAndRecreation",
    "transport": "TransportAndServices",
    "transport and services": "TransportAndServices",
    "non-urban": "NonUrban",
    "military": "Military",
}
"""What a comment ``# Objects - parks`` above objects says of their environment."""

ROBOTS = ("labbot", "soccerbot", "s4", "eyebot", "robot")


def class_of(name: str) -> str | None:
    """The detector class of a model or oracle name, with or without a number at its end; or None.

    ``House_V3``, ``Tree-A`` and ``cat_v1`` are variants of House, Tree and Cat.
    """
    whole = name.casefold()
    stem = re.sub(r"([_-]?v?\d+|[_-][a-z])$", "", whole)
    for tried in (whole, stem, stem.replace("_", "").replace("-", "")):
        if tried in MODELS:
            return MODELS[tried]
        if (found := find_class(tried)) is not None:
            return found
    return None


def group_of(comment: str) -> str | None:
    """The environment that a comment names, or None: ``# Objects - parks`` names one."""
    words = re.fullmatch(r"#*\s*objects\s*-?\s*(.+?)\s*#*", comment.strip().casefold())
    return GROUPS.get(words.group(1)) if words else None
