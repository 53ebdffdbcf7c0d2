"""The table of all classes and their models; a shape for a class and a variant."""

from __future__ import annotations

import difflib
from collections.abc import Callable
from functools import cache

import numpy as np

from symboslam.errors import SymboSlamError, UnknownNameError
from symboslam.sim_bridge.objects import (
    aircraft,
    animals,
    army,
    buildings,
    farm,
    people,
    plants,
    play,
    street,
    vehicles,
    weapons,
    works,
)
from symboslam.sim_bridge.objects.draw import Draw
from symboslam.sim_bridge.objects.parts import Model, Part, Shape
from symboslam.sim_bridge.worlds.sizes import SIZES

VARIANTS = 16
# Of the nominal size, along each axis, a shape is at most this.
LIMIT = 1.45

BUILDERS: dict[str, Callable[[Model, Draw], None]] = {
    "Aircraft": aircraft.aircraft,
    "Airplane": aircraft.airplane,
    "Apartment": buildings.apartment,
    "AttackHelicopter": aircraft.attack_helicopter,
    "BasketballBackboard": play.basketball_backboard,
    "BasketballCourt": play.basketball_court,
    "Bench": street.bench,
    "Billboard": street.billboard,
    "Bird": animals.bird,
    "Bomb": weapons.bomb,
    "Boy": people.boy,
    "Building": buildings.building,
    "Bull": farm.bull,
    "Bus": vehicles.bus,
    "BusStop": street.bus_stop,
    "C17": aircraft.c17,
    "Car": vehicles.car,
    "Cat": animals.cat,
    "Cattle": farm.cattle,
    "ConvenienceStore": works.convenience_store,
    "Dog": animals.dog,
    "Factory": works.factory,
    "FighterJet": aircraft.fighter_jet,
    "FireHydrant": street.fire_hydrant,
    "GasStation": works.gas_station,
    "GasStationPump": works.gas_station_pump,
    "Girl": people.girl,
    "Helicopter": aircraft.helicopter,
    "Horse": farm.horse,
    "House": buildings.house,
    "Humvee": army.humvee,
    "Kangaroo": animals.kangaroo,
    "LandVehicle": vehicles.land_vehicle,
    "Missile": weapons.missile,
    "MissileLauncher": army.missile_launcher,
    "OfficeBuilding": buildings.office_building,
    "Person": people.person,
    "Plant": plants.plant,
    "PowerSubstation": works.power_substation,
    "Rifle": weapons.rifle,
    "Rotunda": buildings.rotunda,
    "Sheep": farm.sheep,
    "ShippingContainer": works.shipping_container,
    "Silo": works.silo,
    "Skyscraper": buildings.skyscraper,
    "Slide": play.slide,
    "SoccerGoals": play.soccer_goals,
    "StopSign": street.stop_sign,
    "Swingset": play.swingset,
    "Table": street.table,
    "Tank": army.tank,
    "Tower": buildings.tower,
    "TrafficLight": street.traffic_light,
    "Train": vehicles.train,
    "Tree": plants.tree,
    "Warehouse": works.warehouse,
}


class ShapeError(SymboSlamError):
    """A model that cannot be made, or a mesh that cannot be loaded; a placeholder can stand in."""


def classes() -> list[str]:
    """The classes that have a model, sorted; they are the detector's labels."""
    return sorted(BUILDERS)


def variants(cls: str) -> list[str]:
    """Names of the variants of a class.

    Raises:
        UnknownNameError: there is no model of the class.
    """
    _check(cls)
    return [str(i) for i in range(VARIANTS)]


@cache
def shape(cls: str, variant: str = "0") -> Shape:
    """The shape of a variant, the same in every process; its arrays must not be changed.

    Raises:
        UnknownNameError: there is no model of the class, or no such variant.
        ShapeError: the model failed.
    """
    if variant not in variants(cls):
        raise UnknownNameError(f"{cls} has no variant {variant!r}: they are 0 to {VARIANTS - 1}")
    draw = Draw(cls, int(variant))
    model = Model()
    try:
        BUILDERS[cls](model, draw)
        raw = model.build(f"{cls}/{variant}")
        return fitted(raw, SIZES[cls][:3], draw)
    except (ArithmeticError, LookupError, TypeError, ValueError) as error:
        raise ShapeError(f"the model of {cls}, variant {variant}, failed: {error}") from error


def fitted(raw: Shape, size: tuple[float, float, float], draw: Draw) -> Shape:
    """The shape on the ground, in the middle, about as large as ``size`` says.

    The longer axes count more. It keeps its proportions but for a twentieth.
    """
    low, high = raw.bounds.astype(float)
    extent = np.maximum(high - low, 1e-6)
    wanted = np.asarray(size)
    scale = np.exp((np.log(wanted / extent) * wanted).sum() / wanted.sum()) * draw.between(
        0.88, 1.15
    )
    scale = min(scale, float((LIMIT * wanted / extent).min()) / 1.05)
    factor = scale * draw.rng.uniform(0.95, 1.05, 3)
    shift = np.array([*((low + high)[:2] / 2), low[2]])
    parts = tuple(
        Part(((p.vertices - shift) * factor).astype(np.float32), p.faces, p.rgba, p.uv)
        for p in raw.parts
    )
    return Shape(raw.name, parts, raw.picture)


def placeholder(cls: str) -> Shape:
    """A plain box of the class's size (one metre where the class is unknown)."""
    model = Model()
    size = SIZES[cls][:3] if cls in SIZES else (1.0, 1.0, 1.0)
    model.box((0, 0, 0), size, (200, 60, 200))
    return model.build(f"{cls}/placeholder")


def _check(cls: str) -> None:
    if cls not in BUILDERS:
        near = difflib.get_close_matches(cls, BUILDERS, n=3, cutoff=0.5)
        hint = f"; close to it: {', '.join(near)}" if near else ""
        raise UnknownNameError(f"there is no model of the class {cls!r}{hint}")
