"""Bounds: how well generated worlds could be classified at all (world_bounds.py [SEED ...]).

Prints, over the cells of the six areas together as ``symboslam evaluate`` has them, IoU, AP and
accuracy of our maps of all objects at their true places, and of a classifier by Bayes that knows
what no user can: the generator's own table and each plan's shares, so its exact rates. It is told

- ``zones``: the outline of every zone, but not its type;
- ``blocks``: the streets, so the smallest pieces of ground that have one type each; once by itself,
  once with what neighbouring blocks are (a Potts model, by Gibbs sampling);
- ``cells``: no outlines; objects around a cell count by a Gaussian.

Strengths of smoothing were chosen on seeds 100 to 104. With several seeds figures are means.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine.classify import classify
from symboslam.engine.evaluation import evaluate_pairs
from symboslam.engine.growth import crowding
from symboslam.engine.readers import read_landmarks
from symboslam.reasoning.knowledge import Knowledge
from symboslam.sim_bridge.mission.survey import SCHEME, classify_survey
from symboslam.sim_bridge.search.paper_areas import AREAS
from symboslam.sim_bridge.worlds.frequencies import real_frequencies
from symboslam.sim_bridge.worlds.generator import world_by_name
from symboslam.sim_bridge.worlds.plans import get_plan
from symboslam.sim_bridge.worlds.sizes import CLASSES
from symboslam.sim_bridge.worlds.streets import lay_streets
from symboslam.sim_bridge.worlds.truth import landmarks_geojson, zones_geojson
from symboslam.sim_bridge.worlds.world import World
from symboslam.sim_bridge.worlds.zoning import zone_blocks

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
CELLS = 24
TYPES = real_frequencies().environments
LEAST_SHARE = 1e-4  # of a class that was never counted in a type: counts are not complete
LEAST_PRIOR = 1e-6
CLUMPS = 2.5  # how unevenly the generator fills blocks
SWEEPS, BURN_IN = 500, 100


@dataclass(frozen=True)
class Area:
    """A world, and all that the generator knew of it.

    Attributes:
        world: with its truth.
        shape: (columns, rows) of its blocks.
        corners: the four corners of each block.
        prior: (T,) share of each type in the plan.
        rate: (T, C) objects of each class per square kilometre of each type.
        kind: (n,) class of each object.
        xy: (n, 2) where it is.
    """

    world: World
    shape: tuple[int, int]
    corners: list[Floats]
    prior: Floats
    rate: Floats
    kind: Ints
    xy: Floats


def area_of(name: str, seed: int) -> Area:
    """The world of an area and a seed."""
    plan, world = get_plan(name), world_by_name(name, seed)
    rng = np.random.default_rng([seed, *plan.name.encode()])  # as generate() has it
    streets = lay_streets(world.extent, plan.spacing_m, plan.road_width_m, rng)
    zone_blocks(streets, plan, rng)
    columns, rows = streets.shape
    prior = np.zeros(len(TYPES))
    own = np.zeros((len(TYPES), len(CLASSES)))
    for patch in plan.patches:
        prior[TYPES.index(patch.environment)] += patch.share
        for kind, number in patch.objects.items():
            own[TYPES.index(patch.environment), CLASSES.index(kind)] += number
    prior[TYPES.index(plan.base)] += 1 - prior.sum()
    real = np.zeros_like(own)
    for t, environment in enumerate(TYPES):
        for kind, density in real_frequencies().density(environment).items():
            real[t, CLASSES.index(kind)] = density
    root, share = np.sqrt(real.sum(1)), real / real.sum(1, keepdims=True)
    share = (share + LEAST_SHARE) / (share + LEAST_SHARE).sum(1, keepdims=True)
    per_root = (plan.features - own.sum()) / (prior @ root) / plan.area_km2
    ground = np.maximum(prior, LEAST_PRIOR)[:, None] * plan.area_km2
    return Area(
        world,
        (columns, rows),
        [streets.corners(i, j) for i in range(columns) for j in range(rows)],
        np.maximum(prior, LEAST_PRIOR),
        share * root[:, None] * per_root + own / ground,
        np.array([CLASSES.index(o.kind) for o in world.objects]),
        np.array([(o.x, o.y) for o in world.objects]),
    )


def by_zones(area: Area) -> dict[str, Any]:
    """Told the outline of every zone."""
    polygons = [shapely.Polygon(z.rings[0], z.rings[1:]) for z in area.world.zones]
    return _map(area, polygons, _posterior(_likelihood(area, polygons) + np.log(area.prior)))


def by_blocks(area: Area) -> dict[str, Any]:
    """Told the streets; each block by itself."""
    polygons = [shapely.Polygon(c) for c in area.corners]
    return _map(area, polygons, _posterior(_likelihood(area, polygons) + np.log(area.prior)))


def by_neighbours(area: Area, coupling: float = 1.5, trust: float = 0.5) -> dict[str, Any]:
    """Told the streets; blocks and what is around them.

    Args:
        area: the world.
        coupling: what a neighbour of the same type adds to the logarithm.
        trust: power of the plan's shares, which coupling strengthens already.
    """
    polygons = [shapely.Polygon(c) for c in area.corners]
    known = _likelihood(area, polygons) + trust * np.log(area.prior)
    rng, (columns, rows) = np.random.default_rng(0), area.shape
    now = known.argmax(1).reshape(columns, rows)
    total = np.zeros_like(known)
    i, j = np.indices((columns, rows))
    for sweep in range(SWEEPS):
        for colour in (0, 1):  # as on a chessboard: those of one colour are no neighbours
            around = np.pad(np.eye(len(TYPES))[now], ((1, 1), (1, 1), (0, 0)))
            same = around[:-2, 1:-1] + around[2:, 1:-1] + around[1:-1, :-2] + around[1:-1, 2:]
            chance = _posterior(known + coupling * same.reshape(len(known), -1))
            drawn = (chance.cumsum(1) < rng.random((len(known), 1))).sum(1)
            drawn = np.minimum(drawn, len(TYPES) - 1).reshape(columns, rows)
            here = (i + j) % 2 == colour
            now = np.where(here, drawn, now)
            if sweep >= BURN_IN:
                total[here.ravel()] += chance[here.ravel()]
    return _map(area, polygons, total / total.sum(1, keepdims=True))


def by_cells(area: Area, width: float = 0.7, trust: float = 0.5) -> dict[str, Any]:
    """Told no outlines.

    Args:
        area: the world.
        width: of the Gaussian, in median distances to the fifth neighbour.
        trust: power of the plan's shares; with less the plan's rare types are found more often.
    """
    e = area.world.extent
    middle = (np.arange(CELLS) + 0.5) / CELLS
    x, y = e.min_x + middle * e.width, e.min_y + middle * e.height
    sigma = width * float(np.median(crowding(area.xy)))

    def near(at: Floats, places: Floats) -> Floats:
        return np.asarray(np.exp(-0.5 * ((at[:, None] - places) / sigma) ** 2))

    def inside(at: Floats, low: float, length: float) -> Floats:
        fine = low + (np.arange(240) + 0.5) / 240 * length
        return np.asarray(near(at, fine).sum(1) * length / 240)

    kernel = np.einsum("yn,xn->yxn", near(y, area.xy[:, 1]), near(x, area.xy[:, 0]))
    ground = np.outer(inside(y, e.min_y, e.height), inside(x, e.min_x, e.width)) / 1e6
    known = kernel.reshape(CELLS**2, -1) @ np.log(area.rate).T[area.kind]
    known += trust * np.log(area.prior) - ground.reshape(-1, 1) * area.rate.sum(1)
    half_x, half_y = e.width / CELLS / 2, e.height / CELLS / 2
    cells = [shapely.box(a - half_x, b - half_y, a + half_x, b + half_y) for b in y for a in x]
    return _map(area, cells, _posterior(known))


def _likelihood(area: Area, polygons: list[Any]) -> Floats:
    """(m, T) logarithm of how likely the objects of each piece of ground are if it has a type."""
    owner = shapely.STRtree(polygons).nearest(shapely.points(area.xy))
    count = np.zeros((len(polygons), len(CLASSES)))
    np.add.at(count, (owner, area.kind), 1)
    km2 = shapely.area(polygons)[:, None] / 1e6
    block = area.world.extent.area_km2 / len(area.corners)
    expected, number = km2 * area.rate.sum(1), count.sum(1, keepdims=True)
    shape = CLUMPS * np.maximum(km2 / block, 1)
    found = count @ np.log(area.rate / area.rate.sum(1, keepdims=True)).T
    found += number * np.log(expected / (expected + shape))
    return np.asarray(found + shape * np.log(shape / (expected + shape)))


def _posterior(logarithm: Floats) -> Floats:
    weight = np.exp(logarithm - logarithm.max(1, keepdims=True))
    return np.asarray(weight / weight.sum(1, keepdims=True))


def _map(area: Area, polygons: Iterable[Any], probability: Floats) -> dict[str, Any]:
    features = [
        {
            "type": "Feature",
            "geometry": shapely.geometry.mapping(polygon),
            "properties": {
                "environment": TYPES[int(row.argmax())],
                "probabilities": dict(zip(TYPES, row.tolist(), strict=True)),
            },
        }
        for polygon, row in zip(polygons, probability, strict=True)
    ]
    e = area.world.extent
    head = {"crs_units": "m", "bbox": [e.min_x, e.min_y, e.max_x, e.max_y]}
    return {"type": "FeatureCollection", **head, "features": features}


def main() -> None:
    """Print the table."""
    seeds = [int(text) for text in sys.argv[1:]] or [7]
    knowledge = Knowledge.load()

    def ours(segmentation: str, **changes: Any) -> Callable[[Area], Any]:
        def made(area: Area) -> Any:
            landmarks = read_landmarks(landmarks_geojson(area.world), knowledge)
            if not changes:
                return classify_survey(landmarks, knowledge, segmentation)
            return classify(landmarks, knowledge, segmentation=segmentation, **changes)

        return made

    rows: dict[str, Callable[[Area], Any]] = {
        "ours, grid, as the profile has it": ours("grid", scheme=SCHEME),
        "ours, grid, as missions have it": ours("grid"),
        "ours, branch, as the profile has it": ours("branch", scheme=SCHEME),
        "ours, branch, as missions have it": ours("branch"),
        "Bayes, cells": by_cells,
        "Bayes, blocks": by_blocks,
        "Bayes, blocks and neighbours": by_neighbours,
        "Bayes, zones": by_zones,
    }
    worlds = {seed: [area_of(name, seed) for name in AREAS] for seed in seeds}
    print(f"seeds {', '.join(map(str, seeds))}")
    print("| map of all objects at their true places | IoU | AP | accuracy |")
    print("| --- | ---: | ---: | ---: |")
    for label, make in rows.items():
        figures = []
        for areas in worlds.values():
            pairs = [(zones_geojson(area.world), make(area)) for area in areas]
            scores = evaluate_pairs(pairs, cells=CELLS, knowledge=knowledge).result.all
            figures.append((scores.mean_iou, scores.mean_ap, scores.accuracy))
        print("| " + " | ".join([label, *(f"{v:.3f}" for v in np.mean(figures, 0))]) + " |")


if __name__ == "__main__":
    main()
