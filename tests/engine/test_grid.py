"""Nested cells and the quadtree."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from shapely import area, box, union_all

from symboslam.engine.grid import Cells, Grid, quadtree


@pytest.mark.parametrize(
    ("cells", "depth"), [(24, 3), (12, 2), (3, 0), (1, 0), (800, 3), (10, 1), (7, 0)]
)
def test_depth_follows_from_the_number_of_cells(cells: int, depth: int) -> None:
    assert Grid((0, 0, 1, 1), cells).depth == depth


def test_points_on_the_outer_edges_are_inside() -> None:
    row, column = Grid((0, 0, 30, 60), 3).finest_of(
        np.array([0.0, 30.0, 10.0]), np.array([0.0, 60.0, 20.0])
    )
    assert column.tolist() == [0, 2, 1]
    assert row.tolist() == [0, 2, 1]


def test_coarsen_sums_blocks() -> None:
    grid = Grid((0, 0, 4, 4), 4)
    finest = np.arange(16).reshape(4, 4)
    assert grid.depth == 2
    assert grid.coarsen(finest, 1).tolist() == [[10, 18], [42, 50]]
    assert grid.coarsen(finest, 0).tolist() == [[120]]


@given(st.sampled_from([3, 8, 12, 24]), st.integers(0, 2**32 - 1))
def test_segments_tile_the_map(cells: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    grid = Grid((-5, 0, 25, 60), cells)
    segments, values = quadtree(
        grid, lambda c: np.ones((len(c), 2)), lambda c, v: rng.random(len(c)) < 0.5
    )
    boxes = box(*grid.rectangles(segments))
    assert len(values) == len(segments)
    assert area(boxes).sum() == pytest.approx(30 * 60)
    assert union_all(boxes).area == pytest.approx(30 * 60)


def test_only_unsettled_cells_are_split() -> None:
    grid = Grid((0, 0, 24, 24), 24)

    def settled(cells: Cells, values: NDArray[np.float64]) -> NDArray[np.bool_]:
        return np.asarray((cells.row > 0) | (cells.column > 0))

    segments, _ = quadtree(grid, lambda c: np.zeros((len(c), 1)), settled)
    assert np.bincount(segments.depth).tolist() == [8, 3, 3, 4]
