"""Poses in the plane: composition, differences, the best rigid alignment of two sets of points."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]


def wrap(angle: ArrayLike) -> Floats:
    """Angles in [-pi, pi)."""
    return np.asarray((np.asarray(angle) + np.pi) % (2 * np.pi) - np.pi)


def compose(pose: ArrayLike, step: ArrayLike) -> Floats:
    """(..., 3) poses reached from (..., 3) poses by (..., 3) steps in their own frames."""
    a, b = np.asarray(pose, float), np.asarray(step, float)
    cos, sin = np.cos(a[..., 2]), np.sin(a[..., 2])
    x = a[..., 0] + cos * b[..., 0] - sin * b[..., 1]
    y = a[..., 1] + sin * b[..., 0] + cos * b[..., 1]
    return np.stack([x, y, wrap(a[..., 2] + b[..., 2])], -1)


def between(start: ArrayLike, end: ArrayLike) -> Floats:
    """(..., 3) steps that lead from (..., 3) poses to others, in the frames of the first."""
    a, b = np.asarray(start, float), np.asarray(end, float)
    cos, sin = np.cos(a[..., 2]), np.sin(a[..., 2])
    dx, dy = b[..., 0] - a[..., 0], b[..., 1] - a[..., 1]
    return np.stack([cos * dx + sin * dy, cos * dy - sin * dx, wrap(b[..., 2] - a[..., 2])], -1)


def place(pose: ArrayLike, point: ArrayLike) -> Floats:
    """(..., 2) points of robots' frames, in the frame of their (..., 3) poses."""
    a, b = np.asarray(pose, float), np.asarray(point, float)
    cos, sin = np.cos(a[..., 2]), np.sin(a[..., 2])
    x = a[..., 0] + cos * b[..., 0] - sin * b[..., 1]
    y = a[..., 1] + sin * b[..., 0] + cos * b[..., 1]
    return np.stack([x, y], -1)


def rigid(source: Floats, target: Floats) -> Floats:
    """(3,) pose that brings (n, 2) points nearest to (n, 2) others in the least squares.

    Rotation and shift without scale or mirror (Umeyama 1991); n >= 2.
    """
    a, b = source - source.mean(0), target - target.mean(0)
    dot, cross = (a * b).sum(), (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).sum()
    angle = np.arctan2(cross, dot)
    turned = place((0, 0, angle), source.mean(0))
    return np.array([*(target.mean(0) - turned), angle])
