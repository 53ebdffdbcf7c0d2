"""Cells: polygons and points as labels and probabilities of a grid over a box."""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine.landmarks import Box

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]
SAMPLES = 10
"""Sample points along each side of a cell."""
COVER = 0.5
"""A cell has a label if labelled polygons cover at least this share of its sample points."""
DECIMALS = 9
"""Probabilities of cells are rounded to so many, so that equal ones stay equal when ranked."""
_BLOCK = 4096
"""Cells whose sample points are looked at together, for the sake of memory."""


def cells_of_points(x: Floats, y: Floats, kind: Ints, box: Box, cells: int, count: int) -> Ints:
    """The environment that most of the points in each cell have; ties go to the first.

    Args:
        x: (n,) of points.
        y: (n,) of points.
        kind: (n,) environment of each; -1 = none.
        box: the area; its outer edges count as inside.
        cells: cells along each side.
        count: K, how many environments there are.

    Returns:
        (cells * cells,) environment, or -1; row by row from the south, columns from the west.
    """
    west, south, east, north = box
    column = np.floor((x - west) / (east - west) * cells).astype(np.int64)
    row = np.floor((y - south) / (north - south) * cells).astype(np.int64)
    column[x == east] = cells - 1
    row[y == north] = cells - 1
    inside = (column >= 0) & (column < cells) & (row >= 0) & (row < cells) & (kind >= 0)
    where = (row * cells + column)[inside] * count + kind[inside]
    votes = np.bincount(where, minlength=cells * cells * count).reshape(-1, count)
    return np.where(votes.any(1), votes.argmax(1), -1)


def cells_of_polygons(
    geometry: NDArray[Any],
    area: Floats,
    kind: Ints,
    probability: Floats,
    box: Box,
    cells: int,
) -> tuple[Ints, Floats]:
    """The environment and probabilities of each cell, by 10 x 10 sample points in it.

    Where polygons overlap, a point belongs to the smallest; of equal ones to the first.

    Args:
        geometry: (n,) valid polygons and multipolygons.
        area: (n,) what decides which of them is the smallest.
        kind: (n,) environment of each; -1 = unknown.
        probability: (n, K) of each.
        box: the area.
        cells: cells along each side.

    Returns:
        (cells * cells,) the environment with the largest share of the cell, if all that are
        labelled cover at least half of it, else -1; ties go to the first. (cells * cells, K)
        mean probability of the sample points, 0 where no polygon is.
    """
    total, count = cells * cells, probability.shape[1]
    kind, probability = np.append(kind, -1), np.vstack([probability, np.zeros(count)])
    order = np.argsort(area, kind="stable")
    x, y = _samples(box[0], box[2], cells), _samples(box[1], box[3], cells)
    row, column = np.divmod(np.arange(total), cells)
    frames = shapely.box(x[column, 0], y[row, 0], x[column, -1], y[row, -1])
    tree = shapely.STRtree(frames)
    touching, touched = tree.query(geometry[order], predicate="intersects")
    containing, contained = tree.query(geometry[order], predicate="contains_properly")
    # The smallest polygon that reaches the sample points at all, and the smallest that holds all.
    reaching, holding = np.full((2, total), len(order))
    np.minimum.at(reaching, touched, touching)
    np.minimum.at(holding, contained, containing)
    owner = np.append(order, -1)[reaching]
    label, mean = kind[owner], np.round(probability[owner], DECIMALS)
    mixed = np.flatnonzero(reaching < holding)
    by_cell = np.argsort(touched, kind="stable")
    touching, touched = touching[by_cell], touched[by_cell]
    for start in range(0, len(mixed), _BLOCK):
        some = mixed[start : start + _BLOCK]
        first, last = np.searchsorted(touched, (some[0], some[-1] + 1))
        near = np.unique(touching[first:last])
        points = shapely.points(
            np.repeat(x[column[some]], SAMPLES, axis=0).ravel(),
            np.tile(y[row[some]][:, :, None], (1, 1, SAMPLES)).ravel(),
        )
        around = _first_around(geometry[order[near]], points)
        owners = np.append(order[near], -1)[around].reshape(len(some), -1)
        label[some] = _majority(kind[owners], count)
        mean[some] = np.round(probability[owners].mean(1), DECIMALS)
    return label, mean


def _samples(low: float, high: float, cells: int) -> Floats:
    """(cells, SAMPLES) coordinates of the sample points along one side."""
    n = cells * SAMPLES
    return np.asarray(low + (np.arange(n) + 0.5) * (high - low) / n).reshape(cells, SAMPLES)


def _first_around(geometry: NDArray[Any], points: NDArray[Any]) -> Ints:
    """(m,) the first polygon that has each point inside; the number of polygons if none has."""
    polygon, point = shapely.STRtree(points).query(geometry, predicate="contains")
    first = np.full(len(points), len(geometry))
    np.minimum.at(first, point, polygon)
    return first


def _majority(kind: Ints, count: int) -> Ints:
    """(m,) the most frequent kind of each row, or -1 where fewer than half have one.

    Shares are added as numbers, as the benchmark's scorer does: where three environments or more
    cover exactly half of a cell, the last bit of the sum decides.
    """
    share = np.stack([(kind == k).mean(1) for k in range(count)], 1)
    return np.where(share.sum(1) >= COVER, share.argmax(1), -1)
