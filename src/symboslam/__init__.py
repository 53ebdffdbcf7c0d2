"""SymboSLAM: explainable semantic maps from located, labelled landmarks.

>>> import symboslam
>>> knowledge = symboslam.Knowledge.load()
>>> landmarks = symboslam.read_landmarks("town.geojson", knowledge)  # doctest: +SKIP
>>> environments = symboslam.classify(landmarks, knowledge)  # doctest: +SKIP
>>> print(environments.tell("3-12-7"))  # doctest: +SKIP
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from symboslam.engine.classify import classify
    from symboslam.engine.environment_map import EnvironmentMap
    from symboslam.engine.evaluation import Evaluation, evaluate, evaluate_pairs
    from symboslam.engine.explanation import Explanation, Reason
    from symboslam.engine.landmarks import LandmarkMap
    from symboslam.engine.readers import read_landmarks
    from symboslam.engine.writers import write_map
    from symboslam.errors import SymboSlamError
    from symboslam.reasoning.knowledge import Knowledge
    from symboslam.reasoning.pitfalls.scan import scan_pitfalls
    from symboslam.reasoning.why import why

__version__ = "0.1.0"

_HOME = {
    "EnvironmentMap": "symboslam.engine.environment_map",
    "Evaluation": "symboslam.engine.evaluation",
    "Explanation": "symboslam.engine.explanation",
    "Knowledge": "symboslam.reasoning.knowledge",
    "LandmarkMap": "symboslam.engine.landmarks",
    "Reason": "symboslam.engine.explanation",
    "SymboSlamError": "symboslam.errors",
    "classify": "symboslam.engine.classify",
    "evaluate": "symboslam.engine.evaluation",
    "evaluate_pairs": "symboslam.engine.evaluation",
    "read_landmarks": "symboslam.engine.readers",
    "scan_pitfalls": "symboslam.reasoning.pitfalls.scan",
    "why": "symboslam.reasoning.why",
    "write_map": "symboslam.engine.writers",
}

__all__ = [
    "EnvironmentMap",
    "Evaluation",
    "Explanation",
    "Knowledge",
    "LandmarkMap",
    "Reason",
    "SymboSlamError",
    "classify",
    "evaluate",
    "evaluate_pairs",
    "read_landmarks",
    "scan_pitfalls",
    "why",
    "write_map",
]


def __getattr__(name: str) -> Any:
    """Public names are loaded when first used, so that ``import symboslam`` costs nothing."""
    if name not in _HOME:
        raise AttributeError(f"module 'symboslam' has no attribute {name!r}")
    return getattr(importlib.import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    return sorted([*__all__, "__version__"])
