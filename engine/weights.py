"""Weights: how strongly each landmark speaks for each environment."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.settings import Settings
from symboslam.reasoning.knowledge import Knowledge

Floats = NDArray[np.float64]


def weights_of(
    landmarks: LandmarkMap, knowledge: Knowledge, scheme: str | None, settings: Settings
) -> Floats:
    """(n, K) SP(e, x) f_x of each landmark, times its importance unless that is off."""
    proximity = proximity_of(knowledge, scheme, settings)
    return np.asarray(proximity[landmarks.feature] * landmarks.confidence[:, None])


def proximity_of(knowledge: Knowledge, scheme: str | None, settings: Settings) -> Floats:
    """(n, K) semantic proximity of each feature, times its importance unless that is off."""
    if settings.measure != "direct":
        return knowledge.weights(settings.measure, scheme, settings.importance)
    proximity = knowledge.direct(scheme)
    if settings.importance == "entropy":
        proximity = proximity * knowledge.importance("path", scheme)[:, None]
    return proximity
