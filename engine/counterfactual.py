"""Counterfactuals: what a segment's probabilities would be without some landmarks."""

from __future__ import annotations

from dataclasses import fields

import numpy as np

from symboslam.engine._base import normalised
from symboslam.engine.classify import evidence_of
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.grid import Grid
from symboslam.engine.settings import Settings


def without(
    environment_map: EnvironmentMap, segment_id: str, landmarks: list[int]
) -> dict[str, float]:
    """P(e) of a segment if these landmarks were not there, computed anew and so exact.

    The estimated evidence of unmarked ground stays what it was for the whole map; classifying the
    reduced landmarks with that ``absence`` gives the same numbers.

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
    config = environment_map.config
    settings = Settings(**{f.name: config[f.name] for f in fields(Settings)})
    evidence = evidence_of(
        environment_map.landmarks.without(*landmarks),
        environment_map.knowledge,
        config["scheme"],
        Grid(environment_map.landmarks.bbox, settings.cells),
        settings,
    )
    values = evidence.of(environment_map.evidence_cells.take(np.array([i])))
    return {
        e.name: float(p)
        for e, p in zip(environment_map.environments, normalised(values)[0], strict=True)
    }
