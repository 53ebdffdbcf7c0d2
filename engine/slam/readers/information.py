"""Covariances from what files of graphs state: triangles of information matrices."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np

from symboslam.engine.slam.log import Floats, Ints


def symmetric(triangle: Sequence[float], size: int) -> Floats:
    """(size, size) matrix of its upper triangle, row by row."""
    return np.asarray(np.array(triangle, float)[_places(size)])


@cache
def _places(size: int) -> Ints:
    """(size, size) where in the triangle each element stands."""
    found = np.zeros((size, size), np.int64)
    found[np.triu_indices(size)] = np.arange(size * (size + 1) // 2)
    return np.maximum(found, found.T)


def toro(triangle: Sequence[float]) -> Floats:
    """(3, 3) matrix in TORO's order: 11, 12, 22, 33, 13, 23."""
    a, b, c, d, e, f = triangle
    return symmetric((a, b, e, c, f, d), 3)


def covariance_of(information: Floats) -> Floats:
    """The inverse; NaN where the matrix has none or is no positive one."""
    try:
        np.linalg.cholesky(information)
        return np.asarray(np.linalg.inv(information))
    except np.linalg.LinAlgError:
        return np.full(information.shape, np.nan)


def positive(covariance: Floats) -> Floats:
    """The matrix itself, or NaN if it is no positive one."""
    known = np.isfinite(covariance_of(covariance)).all()
    return covariance if known else np.full(covariance.shape, np.nan)


def polar(x: float, y: float, covariance: Floats) -> tuple[float, float, float, float]:
    """A point as range and bearing, with their standard deviations to the first order.

    Args:
        x: metres ahead.
        y: metres to the left.
        covariance: (2, 2) of both; NaN where not known.
    """
    reach = float(np.hypot(x, y))
    if reach == 0:
        return 0.0, 0.0, float(np.sqrt(covariance[0, 0])), float("nan")
    ahead = np.array([x, y]) / reach
    aside = np.array([-ahead[1], ahead[0]])
    return (
        reach,
        float(np.arctan2(y, x)),
        float(np.sqrt(ahead @ covariance @ ahead)),
        float(np.sqrt(aside @ covariance @ aside)) / reach,
    )
