"""Stored maps with their landmarks: classified anew, and checked to be what was written."""

from __future__ import annotations

from symboslam.engine.classify import classify
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.writers.stored import StoredMap
from symboslam.errors import InputError
from symboslam.reasoning.knowledge import Knowledge

_NEAR = 2e-6
"""Probabilities in files are whole millionths."""


def restored(stored: StoredMap, landmarks: LandmarkMap, knowledge: Knowledge) -> EnvironmentMap:
    """The map that was written, with the landmarks behind it.

    Args:
        stored: what its file tells.
        landmarks: those that it was made from, in the same area.
        knowledge: of the ontology that it was made with.

    Raises:
        InputError: the ontology is another one, or the landmarks do not give this map.
    """
    if stored.knowledge_hash != knowledge.source_hash:
        raise InputError(
            f"{stored.source} was made with another ontology, or another version of it: give the "
            "same one with --ontology, or classify anew"
        )
    found = classify(landmarks, knowledge, **stored.config)
    if set(stored.segments) != {str(name) for name in found.segment_id}:
        raise InputError(f"{stored.source} was not made from these landmarks: its segments differ")
    names = [e.name for e in found.environments]
    for name, row in zip(found.segment_id.tolist(), found.probability.tolist(), strict=True):
        told = stored.segments[name].probabilities
        if any(abs(told.get(e, 0.0) - p) > _NEAR for e, p in zip(names, row, strict=True)):
            raise InputError(
                f"{stored.source} was not made from these landmarks: P differs in segment {name}"
            )
    return found
