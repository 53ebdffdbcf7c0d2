"""Cells of polygons and points: by hand, and against looking at every sample point."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from symboslam.engine.evaluation.cells import cells_of_points, cells_of_polygons

BOX = (0.0, 0.0, 40.0, 40.0)


def of(*boxes: tuple[float, float, float, float, int], count: int = 3) -> list[int]:
    """Labels of the 4 x 4 cells of ``BOX``."""
    geometry = np.array([shapely.box(*b[:4]) for b in boxes])
    kind = np.array([b[4] for b in boxes])
    probability = np.vstack([np.eye(count), np.zeros(count)])[kind]
    label, mean = cells_of_polygons(geometry, shapely.area(geometry), kind, probability, BOX, 4)
    assert (mean.sum(1) <= 1 + 1e-9).all()
    return [int(k) for k in label]


def test_rows_from_the_south() -> None:
    assert of((20, 0, 40, 20, 1)) == [-1, -1, 1, 1] * 2 + [-1] * 8


def test_the_smaller_polygon_wins_and_can_make_a_cell_unknown() -> None:
    assert of((0, 0, 40, 40, 0), (0, 0, 10, 10, 2)) == [2] + [0] * 15
    assert of((0, 0, 10, 10, 2), (0, 0, 40, 40, 0)) == [2] + [0] * 15
    assert of((0, 0, 40, 40, 0), (0, 0, 10, 10, -1)) == [-1] + [0] * 15


def test_half_of_a_cell_is_enough_and_less_is_not() -> None:
    assert of((0, 0, 10, 5, 1))[0] == 1
    assert of((0, 0, 10, 4.4, 1))[0] == -1
    # Together they cover 60 %; the larger share is the label, in a tie the first.
    assert of((0, 0, 10, 4, 2), (0, 4, 10, 6, 1))[0] == 2
    assert of((0, 0, 10, 3, 2), (0, 3, 10, 6, 1))[0] == 1


def test_of_equal_polygons_the_first_wins() -> None:
    assert of((0, 0, 40, 40, 1), (0, 0, 40, 40, 0)) == [1] * 16


def test_probabilities_are_weighted_by_area() -> None:
    geometry = np.array([shapely.box(0, 0, 10, 7), shapely.box(0, 7, 10, 9)])
    probability = np.array([[0.5, 0.5], [0.0, 1.0]])
    label, mean = cells_of_polygons(
        geometry, shapely.area(geometry), np.array([0, 1]), probability, BOX, 4
    )
    assert label[0] == 0
    assert mean[0].tolist() == pytest.approx([0.35, 0.55])
    assert (mean[1:] == 0).all()


def test_no_polygon() -> None:
    none = np.array([], object)
    label, mean = cells_of_polygons(
        none, np.zeros(0), np.zeros(0, np.int64), np.zeros((0, 3)), BOX, 4
    )
    assert (label == -1).all()
    assert mean.shape == (16, 3)


def test_points() -> None:
    x = np.array([1.0, 2.0, 3.0, 40.0, 41.0, 15.0, 16.0, 5.0])
    y = np.array([1.0, 2.0, 3.0, 40.0, 41.0, 5.0, 5.0, 5.0])
    kind = np.array([2, 2, 0, 1, 1, 1, 0, -1])
    label = cells_of_points(x, y, kind, BOX, 4, 3)
    # Most in the first cell are 2; one each in the second; the upper edges count as inside.
    assert label.tolist() == [2, 0] + [-1] * 13 + [1]


@given(st.integers(0, 10**6))
@settings(max_examples=8)
def test_same_as_looking_at_every_sample_point(seed: int) -> None:
    rng = np.random.default_rng(seed)
    count, cells = 4, 3
    shapes: list[Any] = []
    for _ in range(int(rng.integers(1, 9))):
        centre, radius = rng.random(2) * 40, rng.random() * 20 + 1
        corners = centre + radius * rng.random((3 + int(rng.integers(4)), 2))
        shapes.append(shapely.convex_hull(shapely.MultiPoint(corners)))
    shapes.append(shapely.box(0, 0, 16, 16).difference(shapely.box(4, 4, 9, 9)))
    geometry = np.array(shapes)
    kind = rng.integers(-1, count, len(shapes))
    probability = rng.random((len(shapes), count))
    label, mean = cells_of_polygons(geometry, shapely.area(geometry), kind, probability, BOX, cells)
    ranked = sorted(range(len(shapes)), key=lambda i: float(shapes[i].area))
    step = 40 / cells / 10
    for cell in range(cells * cells):
        row, column = divmod(cell, cells)
        votes, total = np.zeros(count), np.zeros(count)
        for i in range(10):
            for j in range(10):
                point = shapely.Point((column * 10 + i + 0.5) * step, (row * 10 + j + 0.5) * step)
                owner = next((k for k in ranked if point.within(geometry[k])), None)
                if owner is not None:
                    total += probability[owner]
                    if kind[owner] >= 0:
                        votes[kind[owner]] += 1
        expected = int(votes.argmax()) if votes.sum() >= 50 else -1
        assert label[cell] == expected or votes.sum() == 50
        np.testing.assert_allclose(mean[cell], total / 100, atol=1e-8)
