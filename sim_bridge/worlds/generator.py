"""Generator: the six areas of the paper, and others by a plan, from a seed.

Streets first, then zones, then which streets run through open country, then objects by the
frequencies of real zones. Nothing here reads the ontology: its indications are what a world tests.
"""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from symboslam.errors import InputError
from symboslam.sim_bridge.worlds.checks import Notes, free_starts
from symboslam.sim_bridge.worlds.filling import Filler
from symboslam.sim_bridge.worlds.frequencies import real_frequencies
from symboslam.sim_bridge.worlds.plans import PLANS, Plan, find_plan, get_plan
from symboslam.sim_bridge.worlds.starts import base
from symboslam.sim_bridge.worlds.streets import (
    Network,
    Streets,
    lay_streets,
    open_streets,
    roads_of,
)
from symboslam.sim_bridge.worlds.world import Extent, Ground, Start, World, WorldObject
from symboslam.sim_bridge.worlds.zoning import zone_blocks, zones_of

ATTRIBUTION = (
    "Synthetic: a made-up place. Class frequencies after OpenStreetMap, (c) OpenStreetMap "
    "contributors, ODbL 1.0"
)


def world_by_name(name: str, seed: int = 7) -> World:
    """A generated area: gungahlin, airport, fyshwick, kingston, train-depot, city or demo.

    Args:
        name: its name, whatever its case.
        seed: an integer of 0 or more; the same seed gives the same world.

    Raises:
        UnknownNameError: there is no such area.
        InputError: the seed is negative.
    """
    return generate(get_plan(name), seed)


def get_world(name_or_file: str | Path, seed: int = 7) -> tuple[World, Notes]:
    """The world of an area's name or of a file, and notes on what is odd in it.

    A file that is called like an area is given with its folder, as in ``./city``.

    Raises:
        InputError: there is neither.
    """
    if isinstance(name_or_file, str) and (plan := find_plan(name_or_file)) is not None:
        return generate(plan, seed), ()
    if not Path(name_or_file).exists():
        areas = ", ".join(PLANS)
        raise InputError(f"{name_or_file}: neither a file nor an area; areas: {areas}")
    from symboslam.sim_bridge.worlds.formats import read_any

    return read_any(name_or_file)


def generate(plan: Plan, seed: int = 7) -> World:
    """The world of a plan: exactly its area and number of features.

    Objects do not overlap, lie within the extent and off the streets. Zones fill the extent and do
    not overlap; a zone includes its streets.

    Raises:
        InputError: the seed is negative.
        WorldError: the features do not fit.
    """
    if seed < 0:
        raise InputError(f"seed {seed}: give an integer of 0 or more")
    rng = np.random.default_rng([seed, *plan.name.encode()])
    width = math.sqrt(plan.area_km2 * plan.aspect) * 1000
    extent = Extent(0.0, 0.0, width, plan.area_km2 * 1e6 / width)
    streets = lay_streets(extent, plan.spacing_m, plan.road_width_m, rng)
    zoning = zone_blocks(streets, plan, rng)
    network = open_streets(streets, zoning.environments == "NonUrban")
    objects = Filler(streets, network, zoning, real_frequencies(), rng).fill(plan.features)
    world = World(
        name=plan.title,
        extent=extent,
        objects=objects,
        zones=zones_of(streets, zoning),
        roads=roads_of(streets, network),
        starts=_starts(streets, network, objects),
        ground=Ground(),
        attribution=ATTRIBUTION,
    )
    return free_starts(world, plan.name)[0]


def _starts(
    streets: Streets, network: Network, objects: tuple[WorldObject, ...]
) -> tuple[Start, ...]:
    """At the middle of a street between two crossings."""
    n = streets.nodes
    places, headings = [], []
    for begin, end, width in (
        (n[:-1], n[1:], network.across),
        (n[:, :-1], n[:, 1:], network.along),
    ):
        there = width > 0
        places.append(((begin + end) / 2)[there])
        step = (end - begin)[there]
        headings.append(np.arctan2(step[:, 1], step[:, 0]))
    return base(np.vstack(places), np.concatenate(headings), streets.extent, objects)
