"""Sample area: a made-up town with zones, streets and landmarks, for the demo and for tests.

A street lattice is bent a little, its blocks get a use (town centre, suburbs, an estate along a
railway, school and hospital grounds, parks, fields around), and each block gets landmarks at the
rates that such zones really have. Everything follows from the seed.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.sample_rates import (
    ATTRIBUTION,
    ENVIRONMENTS,
    INDOOR_KEYS,
    INDOOR_VALUES,
    RATES_PER_KM2,
    SITES,
    STREET_KEYS,
    STREET_VALUES,
    amounts,
)
from symboslam.errors import InputError

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

_BLOCK_M = 115.0  # mean distance of streets
_RAIL_M = 55.0  # width of the railway's strip
_LOT_M = (17.0, 24.0)  # a building's lot
_KERB_M = 9.0  # no building nearer to the middle of a street


def sample_area(
    seed: int = 7, size_m: float = 3000.0, centre: tuple[float, float] = (149.1, -35.2)
) -> dict[str, Any]:
    """Landmarks of a made-up town, as a GeoJSON FeatureCollection.

    Args:
        seed: any integer of 0 or more; the same seed gives the same town.
        size_m: side of the square area in metres, 1000 to 10000.
        centre: longitude and latitude of its middle in degrees.

    Returns:
        Points in longitude and latitude with raw OSM-style ``tags``; ``bbox`` is the area.

    Raises:
        InputError: an argument is out of range.
    """
    town = _Town.plan(seed, size_m)
    lonlat = _degrees(town.landmark_xy, size_m, centre)
    order = np.lexsort((lonlat[:, 1], lonlat[:, 0]))  # by position: the order tells nothing
    features = [
        _feature(
            {"type": "Point", "coordinates": lonlat[i].tolist()},
            {"tags": dict(part.split("=") for part in town.landmark_tags[i].split("+"))},
            f"sample-{number}",
        )
        for number, i in enumerate(order)
    ]
    return _collection(features, size_m, centre)


def sample_truth(
    seed: int = 7, size_m: float = 3000.0, centre: tuple[float, float] = (149.1, -35.2)
) -> dict[str, Any]:
    """The zones that `sample_area` of the same arguments was made from, one polygon a block.

    Args:
        seed: as for `sample_area`.
        size_m: as for `sample_area`.
        centre: as for `sample_area`.

    Returns:
        A FeatureCollection of polygons with ``environment`` and ``kind`` (a site, or empty).
    """
    town = _Town.plan(seed, size_m)
    features = [
        _feature(
            {"type": "Polygon", "coordinates": [_degrees(ring, size_m, centre).tolist()]},
            {"environment": ENVIRONMENTS[zone], "kind": kind},
            f"block-{number}",
        )
        for number, (ring, zone, kind) in enumerate(
            zip(town.rings, town.zone.tolist(), town.kind.tolist(), strict=True)
        )
    ]
    return _collection(features, size_m, centre)


@dataclass
class _Town:
    """Blocks (b of them) of a bent street lattice, and the landmarks placed so far."""

    rng: np.random.Generator
    size: float
    corners: Floats  # (b, 4) u0, v0, u1, v1 in lattice metres
    bend: Floats  # (2,) phases of the bend
    zone: Ints  # (b,) index into ENVIRONMENTS
    kind: NDArray[np.str_]  # (b,) what site the block belongs to, or ""
    grounds: list[tuple[str, Ints]] = field(default_factory=list)  # (site, its blocks)
    rings: Floats = field(init=False)  # (b, 17, 2) closed, counter-clockwise, metres
    area_km2: Floats = field(init=False)  # (b,)
    lots: Floats = field(init=False)  # (l, 2) places for buildings, shuffled
    lot_block: Ints = field(init=False)  # (l,)
    lot_free: NDArray[np.bool_] = field(init=False)  # (l,)
    landmark_uv: list[Floats] = field(default_factory=list)
    landmark_tags: list[str] = field(default_factory=list)

    @classmethod
    def plan(cls, seed: int, size: float) -> _Town:
        """Lay out the town and fill it."""
        if seed < 0:
            raise InputError(f"seed {seed}: must be 0 or more")
        if not 1000.0 <= size <= 10000.0:
            raise InputError(f"size {size} m: must be from 1000 to 10000 m")
        rng = np.random.default_rng(seed)
        # 1. Streets, with a strip for the railway south of the middle.
        u, v = _streets(rng, size), _streets(rng, size)
        rail = int(np.abs(v - 0.38 * size).argmin())
        v = np.insert(v, rail + 1, v[rail] + _RAIL_M)
        west, south = (a.ravel() for a in np.meshgrid(u[:-1], v[:-1]))
        east, north = (a.ravel() for a in np.meshgrid(u[1:], v[1:]))
        corners = np.column_stack([west, south, east, north])
        zone = np.full(len(corners), ENVIRONMENTS.index("NonUrban"))
        kind = np.full(len(corners), "", dtype="<U16")
        town = cls(rng, size, corners, rng.uniform(0, 2 * np.pi, 2), zone, kind)
        # 2. Zones, 3. sites, 4. landmarks.
        town._zones(south == v[rail])
        town._grounds()
        town._measure()
        town._fill_sites()
        for index in range(len(ENVIRONMENTS)):
            town._fill_zone(index)
        return town

    @property
    def middles(self) -> Floats:
        """(b, 2) middles of the blocks from the town's centre, in lattice metres."""
        centre = np.array([0.47, 0.5]) * self.size
        middles: Floats = (self.corners[:, :2] + self.corners[:, 2:]) / 2 - centre
        return middles

    @property
    def landmark_xy(self) -> Floats:
        """(n, 2) metres of all landmarks, from the south-west corner."""
        return self._bent(np.concatenate(self.landmark_uv))

    def _bent(self, uv: Floats) -> Floats:
        """Lattice metres -> metres; the border of the area stays where it is."""
        unit = uv / self.size
        window = 0.03 * self.size * np.prod(np.sin(np.pi * unit), axis=-1, keepdims=True)
        bent: Floats = uv + window * np.sin(2.6 * np.pi * unit[..., ::-1] + self.bend)
        return bent

    def _zones(self, rail: NDArray[np.bool_]) -> None:
        """Centre, suburbs, estate and railway; fields are what is left."""
        x, y = self.middles.T / self.size
        distance = np.hypot(x, y) * (1 + 0.15 * np.sin(3 * np.arctan2(y, x) + self.bend[0]))
        estate = (y < -0.11) & (y > -0.27) & (x > 0.08) & (x < 0.36)
        for name, where in (
            ("Residential", distance < 0.31),
            ("Industrial", estate),
            ("Commercial", distance < 0.075),
            ("TransportAndServices", rail),
        ):
            self.zone[where] = ENVIRONMENTS.index(name)

    def _grounds(self) -> None:
        """Give blocks to the sites: those of the wanted zone that are nearest to a place."""
        turn = self.rng.uniform(0, 2 * np.pi)
        for kind, zone, on, blocks, distance, angle in (
            ("station", "TransportAndServices", "TransportAndServices", 2, 0.12, -np.pi / 2),
            ("town park", "ParksAndRecreation", "Residential", 7, 0.13, turn),
            ("hospital", "CommunityFacility", "Residential", 4, 0.14, turn + 1.6),
            ("church", "CommunityFacility", "Residential", 1, 0.08, turn + 3.3),
            ("school", "CommunityFacility", "Residential", 3, 0.18, turn + 0.8),
            ("school", "CommunityFacility", "Residential", 3, 0.21, turn + 2.8),
            ("school", "CommunityFacility", "Residential", 3, 0.20, turn + 4.9),
            ("sports ground", "ParksAndRecreation", "Residential", 6, 0.28, turn + 2.2),
            ("small park", "ParksAndRecreation", "Residential", 1, 0.18, turn + 4.2),
            ("small park", "ParksAndRecreation", "Residential", 1, 0.24, turn + 5.5),
            ("substation", "TransportAndServices", "NonUrban", 2, 0.40, -2.6),
            ("barracks", "Military", "NonUrban", 4, 0.42, 0.8),
            *(("farm", "NonUrban", "NonUrban", 1, 0.40, 0.3 + 0.9 * k) for k in range(7)),
        ):
            place = distance * self.size * np.array([np.cos(angle), np.sin(angle)])
            gap = np.hypot(*(self.middles - place).T)
            gap[(self.kind != "") | (self.zone != ENVIRONMENTS.index(on))] = np.inf
            nearest = np.argsort(gap, kind="stable")[:blocks]
            ground = nearest[np.isfinite(gap[nearest])]
            self.zone[ground] = ENVIRONMENTS.index(zone)
            self.kind[ground] = kind
            self.grounds.append((kind, ground))

    def _measure(self) -> None:
        """Outlines, areas and building lots of the blocks."""
        west, south, east, north = self.corners.T
        step = np.arange(4)[:, None] / 4
        u = [west + step * (east - west), east + 0 * step]
        v = [south + 0 * step, south + step * (north - south)]
        u += [east - step * (east - west), west + 0 * step]
        v += [north + 0 * step, north - step * (north - south)]
        uv = np.stack([np.concatenate(u).T, np.concatenate(v).T], axis=-1)
        self.rings = self._bent(np.concatenate([uv, uv[:, :1]], axis=1))
        x, y = self.rings[..., 0], self.rings[..., 1]
        self.area_km2 = (x[:, :-1] * y[:, 1:] - x[:, 1:] * y[:, :-1]).sum(axis=1) / 2e6
        lots, owners = [], []
        margin = _KERB_M * np.array([1, 1, -1, -1])
        for block, (u0, v0, u1, v1) in enumerate(self.corners + margin):
            mesh = np.meshgrid(np.arange(u0, u1, _LOT_M[0]), np.arange(v0, v1, _LOT_M[1]))
            lots.append(np.column_stack([axis.ravel() for axis in mesh]))
            owners.append(np.full(len(lots[-1]), block))
        order = self.rng.permutation(sum(map(len, lots)))
        self.lots = np.concatenate(lots)[order]
        self.lot_block = np.concatenate(owners)[order]
        self.lot_free = np.ones(len(order), bool)

    def _fill_sites(self) -> None:
        """What each site has, and the pylons of a power line across the northern fields."""
        for kind, ground in self.grounds:
            for tags, count in amounts(SITES[kind]).items():
                self._place(tags, int(count), ground)
        pylons = np.arange(0.03 * self.size, 0.99 * self.size, 280.0)
        self._add("power=tower", np.column_stack([pylons, 0.93 * self.size + 0 * pylons]))

    def _fill_zone(self, zone: int) -> None:
        """Poisson numbers of landmarks at the zone's rates."""
        blocks = np.flatnonzero(self.zone == zone)
        rates = amounts(RATES_PER_KM2[ENVIRONMENTS[zone]])
        for tags, rate in rates.items():
            self._place(tags, int(self.rng.poisson(rate * self.area_km2[blocks].sum())), blocks)

    def _place(self, tags: str, count: int, blocks: Ints) -> None:
        """Put landmarks where such things stand: on a lot, in a building, at the kerb, anywhere."""
        if not count or not len(blocks):
            return
        key, value = tags.split("+")[-1].split("=")
        on_lots = np.flatnonzero(np.isin(self.lot_block, blocks))
        if key == "building":
            chosen = on_lots[self.lot_free[on_lots]][:count]
            self.lot_free[chosen] = False
            self._add(tags, self.lots[chosen] + self.rng.uniform(-3, 3, (len(chosen), 2)))
            return
        if key in INDOOR_KEYS or value in INDOOR_VALUES:
            built = on_lots[~self.lot_free[on_lots]]
            if len(built):
                where = self.lots[self.rng.choice(built, count)]
                self._add(tags, where + self.rng.uniform(-5, 5, (count, 2)))
                return
        share = self.area_km2[blocks] / self.area_km2[blocks].sum()
        block = self.corners[self.rng.choice(blocks, count, p=share)]
        spot = self.rng.uniform(0, 1, (count, 2))
        kerb = key in STREET_KEYS or value in STREET_VALUES
        if kerb or value == "tree":  # every second tree stands along a street
            side = self.rng.integers(0, 4 if kerb else 8, count)
            spot[side == 0, 0], spot[side == 1, 0] = 0.0, 1.0
            spot[side == 2, 1], spot[side == 3, 1] = 0.0, 1.0
        low, high = block[:, :2] + 4.0, block[:, 2:] - 4.0
        self._add(tags, low + spot * (high - low))

    def _add(self, tags: str, uv: Floats) -> None:
        self.landmark_uv.append(uv)
        self.landmark_tags += [tags] * len(uv)


def _streets(rng: np.random.Generator, size: float) -> Floats:
    """Positions of the parallel streets from 0 to ``size``."""
    steps = rng.uniform(0.75, 1.25, round(size / _BLOCK_M))
    streets: Floats = np.concatenate([[0.0], np.cumsum(steps)]) * (size / steps.sum())
    return streets


def _degrees(xy: Floats, size: float, centre: tuple[float, float]) -> Floats:
    """Metres from the south-west corner -> (longitude, latitude), to the centimetre.

    The lengths of a degree on WGS 84 at the centre's latitude are used for the whole area.
    """
    longitude, latitude = centre
    phi = np.radians(latitude)
    scale = np.array(
        [
            111412.84 * np.cos(phi) - 93.5 * np.cos(3 * phi) + 0.118 * np.cos(5 * phi),
            111132.954 - 559.822 * np.cos(2 * phi) + 1.175 * np.cos(4 * phi),
        ]
    )
    degrees: Floats = np.round(np.array([longitude, latitude]) + (xy - size / 2) / scale, 7)
    return degrees


def _feature(geometry: dict[str, Any], properties: dict[str, Any], name: str) -> dict[str, Any]:
    return {"type": "Feature", "id": name, "geometry": geometry, "properties": properties}


def _collection(
    features: list[dict[str, Any]], size: float, centre: tuple[float, float]
) -> dict[str, Any]:
    corners = _degrees(np.array([[0.0, 0.0], [size, size]]), size, centre)
    return {
        "type": "FeatureCollection",
        "bbox": corners.ravel().tolist(),
        "attribution": ATTRIBUTION,
        "features": features,
    }
