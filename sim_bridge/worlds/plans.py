"""Plans: what the generator knows of each area: size, features, streets and the mix of zones."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from symboslam.errors import UnknownNameError

Where = Literal["centre", "edge", "anywhere"]


@dataclass(frozen=True)
class Patch:
    """Ground of one type that grows from a number of seeds.

    Attributes:
        environment: the type.
        share: of the area, in (0, 1).
        seeds: how many separate places it begins at.
        where: where they lie.
        objects: class -> number of what this very site has besides what such zones have.
    """

    environment: str
    share: float
    seeds: int = 1
    where: Where = "anywhere"
    objects: Mapping[str, int] = field(default_factory=dict)


@dataclass(frozen=True)
class Plan:
    """An area to generate.

    Attributes:
        name: as on the command line.
        title: for people.
        area_km2: exact area.
        features: exact number of objects.
        spacing_m: mean distance of streets in town.
        base: the type of all that no patch takes.
        patches: in the order in which they take ground.
        aspect: width over height.
        road_width_m: of ordinary streets.
    """

    name: str
    title: str
    area_km2: float
    features: int
    spacing_m: float
    base: str
    patches: tuple[Patch, ...]
    aspect: float = 1.0
    road_width_m: float = 8.0


_AIRCRAFT = {"Airplane": 7, "Helicopter": 4}  # as many as the paper's airport has
_RAILYARD = {"Train": 7, "ShippingContainer": 4, "Bus": 2}  # as the paper's train depot

PLANS: dict[str, Plan] = {
    plan.name: plan
    for plan in (
        Plan(
            "gungahlin", "Gungahlin", 29.5609, 3694, 260.0, "Residential",
            (
                Patch("Commercial", 0.05, 1, "centre"),
                Patch("NonUrban", 0.28, 4, "edge"),
                Patch("Industrial", 0.06, 1, "edge"),
                Patch("Commercial", 0.02, 3),
                Patch("CommunityFacility", 0.05, 6),
                Patch("ParksAndRecreation", 0.11, 8),
                Patch("TransportAndServices", 0.02, 2),
            ),
        ),
        Plan(
            "airport", "Airport", 27.8891, 199, 330.0, "NonUrban",
            (
                Patch("CommunityFacility", 0.06, 1, "centre", _AIRCRAFT),
                Patch("TransportAndServices", 0.03, 1, "centre"),
                Patch("Industrial", 0.03, 1),
                Patch("Commercial", 0.025, 1, "centre"),
                Patch("Residential", 0.02, 1, "edge"),
            ),
        ),
        Plan(
            "fyshwick", "Fyshwick", 6.6667, 152, 200.0, "Industrial",
            (
                Patch("NonUrban", 0.14, 2, "edge"),
                Patch("Commercial", 0.10, 2),
                Patch("TransportAndServices", 0.03, 1, "edge"),
                Patch("ParksAndRecreation", 0.02, 1),
            ),
        ),
        Plan(
            "kingston", "Kingston", 0.5041, 212, 95.0, "Residential",
            (
                Patch("Commercial", 0.36, 1, "centre"),
                Patch("ParksAndRecreation", 0.14, 1, "edge"),
                Patch("CommunityFacility", 0.05, 1),
            ),
        ),
        Plan(
            "train-depot", "Train Depot", 1.0976, 167, 110.0, "TransportAndServices",
            (
                Patch("Residential", 0.17, 1, "edge"),
                Patch("Commercial", 0.08, 1, "edge"),
                Patch("Industrial", 0.14, 1, "edge"),
                Patch("ParksAndRecreation", 0.07, 1, "edge"),
                Patch("NonUrban", 0.06, 1, "edge"),
                Patch("TransportAndServices", 0.12, 1, "centre", _RAILYARD),
            ),
        ),
        Plan(
            "city", "City", 1.8225, 429, 112.0, "Commercial",
            (
                Patch("Residential", 0.26, 2, "edge"),
                Patch("ParksAndRecreation", 0.16, 3),
                Patch("CommunityFacility", 0.05, 1),
                Patch("TransportAndServices", 0.03, 1),
            ),
        ),
        Plan(
            "demo", "Demo", 0.09, 80, 62.0, "Commercial",
            (
                Patch("Residential", 0.32, 1, "edge"),
                Patch("ParksAndRecreation", 0.16, 1, "edge"),
                Patch("Industrial", 0.12, 1, "edge"),
            ),
            road_width_m=6.0,
        ),
    )
}  # fmt: skip
"""The six areas of the paper with its areas and numbers of features, and a small one to show.

The mixes follow the paper's one-line descriptions; the shares are ours. The airport's own ground is
a community facility, as the paper reads it.
"""


def find_plan(name: str) -> Plan | None:
    """The plan of that name, whatever its case, or None."""
    return PLANS.get(name.strip().casefold().replace(" ", "-").replace("_", "-"))


def get_plan(name: str) -> Plan:
    """The plan of that name.

    Raises:
        UnknownNameError: there is none.
    """
    if (plan := find_plan(name)) is None:
        raise UnknownNameError(f"there is no area {name!r}; there are: {', '.join(PLANS)}")
    return plan
