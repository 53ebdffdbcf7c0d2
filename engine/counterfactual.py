"""Counterfactuals: what a segment's probabilities would be without some landmarks."""

from __future__ import annotations

import numpy as np

from symboslam.engine._base import normalised
from symboslam.engine.environment_map import EnvironmentMap


def without(
    environment_map: EnvironmentMap, segment_id: str, landmarks: list[int]
) -> dict[str, float]:
    """P(e) of a segment if these landmarks were not there, computed anew and so exact.

    The estimated evidence of unmarked ground stays what it was for the whole map; classifying the
    reduced landmarks with that ``absence`` gives the same numbers. A fragment stays the same
    but for these landmarks: it keeps its diagonal.

    Args:
        environment_map: the map.
        segment_id: the segment.
        landmarks: positions in ``environment_map.landmarks``.

    Returns:
        environment name -> P(e); all 0 where nothing is left to say.

    Raises:
        UnknownNameError: no such segment.
    """
    i = environment_map.position_of(segment_id)
    region = environment_map.regions.take(np.array([i]))
    values = environment_map.evidence.without(region, landmarks)
    return {
        e.name: float(p)
        for e, p in zip(environment_map.environments, normalised(values)[0], strict=True)
    }
