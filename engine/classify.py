"""classify: landmarks and knowledge in, environment map out."""

from __future__ import annotations

import traceback
from typing import Any

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.registry import Progress, segmentation_of
from symboslam.engine.settings import settings_of
from symboslam.errors import InputError, SegmentationError, SymboSlamError
from symboslam.reasoning.knowledge import Knowledge


def classify(
    landmarks: LandmarkMap,
    knowledge: Knowledge,
    *,
    profile: str = "default",
    scheme: str | None = None,
    segmentation: str = "grid",
    progress: Progress | None = None,
    **changes: Any,
) -> EnvironmentMap:
    """Tell what kind of place each part of a map is (design 5 and 6).

    Args:
        landmarks: what was seen where.
        knowledge: what each kind of landmark indicates.
        profile: ``default`` or ``paper``.
        scheme: set of environment types; None takes the ontology's default.
        segmentation: how the map is cut: ``grid``, ``branch``, or the name of another one that
            is installed or registered (``engine/registry.py``).
        progress: called with a stage and the share that is done.
        **changes: settings that differ from the profile's, by their names in ``Settings``.

    Raises:
        UnknownNameError: no such profile, scheme, segmentation or setting.
        SegmentationError: a segmentation that is not ours failed.
        InputError: a setting out of its range, or one that the segmentation does not use.
    """
    chosen = segmentation_of(segmentation)
    idle = [name for name in sorted(chosen.unused) if changes.get(name) is not None]
    if idle:
        raise InputError(
            f"{', '.join(idle)} would change nothing: the segmentation {segmentation} does not "
            "use it; leave it out or choose another segmentation"
        )
    settings = settings_of(profile, **changes)
    tell = progress or (lambda stage, share: None)
    try:
        return chosen.cut(landmarks, knowledge, scheme, settings, tell)
    except SymboSlamError:
        raise
    except Exception as error:
        if type(chosen).__module__.startswith("symboslam."):
            raise
        frame = traceback.extract_tb(error.__traceback__)[-1]
        raise SegmentationError(
            f"the segmentation {segmentation} ({type(chosen).__module__}) failed: "
            f"{type(error).__name__}: {error} [{frame.filename}: line {frame.lineno}]"
        ) from error
