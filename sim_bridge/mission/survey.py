"""Survey: how the landmarks of a mission are classified.

The ontology's bandwidth is that of a thorough map of a town, where a landmark stands every 40 m.
Robots in the paper's areas find one every 50 to 400 m: with such a kernel most ground has no
evidence at all. So a landmark speaks for as much ground as it has to. Both figures below were
chosen on worlds of other seeds than those that are reported (docs/worlds.md, at its end).
"""

from __future__ import annotations

from typing import Any

import numpy as np

from symboslam.engine.classify import classify
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.growth import crowding
from symboslam.engine.landmarks import LandmarkMap
from symboslam.reasoning.knowledge import Knowledge

SCHEME = "territory-plan"
CLOSENESS = 0.1
"""Weight `a` of C in fragments: where landmarks stand far apart, how close they are tells little,
and how many of them agree tells more."""


def survey_settings(
    landmarks: LandmarkMap, knowledge: Knowledge, segmentation: str
) -> dict[str, Any]:
    """What differs from the profile's settings.

    ``grid``: the bandwidth is the median distance to the fifth neighbour, in three digits, unless
    the ontology's is wider: what the reach of ``branch`` goes by, too. ``branch``: `a`.

    Args:
        landmarks: what was found.
        knowledge: has the ontology's bandwidth.
        segmentation: ``grid`` or ``branch``.
    """
    if segmentation != "grid":
        return {"a": CLOSENESS}
    spacing = float(np.median(crowding(landmarks.xy))) if len(landmarks) else 0.0
    if spacing <= (knowledge.bandwidth(SCHEME) or 0.0):
        return {}
    return {"bandwidth": float(f"{spacing:.3g}")}


def classify_survey(
    landmarks: LandmarkMap, knowledge: Knowledge, segmentation: str
) -> EnvironmentMap:
    """The environment map of a mission's landmarks.

    Args:
        landmarks: what was found.
        knowledge: what it indicates.
        segmentation: ``grid`` or ``branch``.
    """
    settings = survey_settings(landmarks, knowledge, segmentation)
    return classify(landmarks, knowledge, scheme=SCHEME, segmentation=segmentation, **settings)
