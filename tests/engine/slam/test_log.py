"""Measurements: deviations of all rows, or of each."""

import numpy as np

from symboslam.engine.slam.log import Floats, Measurements


def seen(sigma_range: float | Floats, sigma_bearing: float | Floats) -> Measurements:
    return Measurements(
        np.arange(3.0), np.arange(1.0, 4.0), np.zeros(3), np.zeros(3, np.int64), np.ones(3),
        np.full(3, "", object), sigma_range, sigma_bearing,
    )  # fmt: skip


def test_one_deviation_is_that_of_every_row() -> None:
    assert seen(0.5, 0.02).sigmas.tolist() == [[0.5, 0.02]] * 3


def test_each_row_has_its_own() -> None:
    found = seen(np.array([0.1, 0.2, 0.3]), 0.02)
    assert found.sigmas.tolist() == [[0.1, 0.02], [0.2, 0.02], [0.3, 0.02]]


def test_taken_rows_take_their_deviations_along() -> None:
    found = seen(np.array([0.1, 0.2, 0.3]), np.array([0.01, 0.02, 0.03]))
    assert found.take(np.array([2, 0])).sigmas.tolist() == [[0.3, 0.03], [0.1, 0.01]]
    assert found.take(np.array([False, True, False])).sigmas.tolist() == [[0.2, 0.02]]
    one = seen(0.5, np.array([0.01, 0.02, 0.03])).take(np.array([1]))
    assert (one.sigma_range, one.sigmas.tolist()) == (0.5, [[0.5, 0.02]])
