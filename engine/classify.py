"""classify: landmarks and knowledge in, environment map out."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine._base import Evidence
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.evidence import PairEvidence
from symboslam.engine.field import FieldEvidence
from symboslam.engine.grid import Grid
from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.segmentation import Segments, cut, seen_cells, sums
from symboslam.engine.settings import Settings, settings_of
from symboslam.errors import UnknownNameError
from symboslam.reasoning.knowledge import Knowledge

Floats = NDArray[np.float64]
Progress = Callable[[str, float], None]
SEGMENTATIONS = ("grid",)


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
        segmentation: how the map is cut; ``grid``.
        progress: called with a stage and the share that is done.
        **changes: settings that differ from the profile's, by their names in ``Settings``.

    Raises:
        UnknownNameError: no such profile, scheme, segmentation or setting.
        InputError: a setting out of its range.
    """
    if segmentation not in SEGMENTATIONS:
        raise UnknownNameError(
            f"no segmentation {segmentation!r}; there are: {', '.join(SEGMENTATIONS)}"
        )
    settings = settings_of(profile, **changes)
    tell = progress or (lambda stage, share: None)
    grid = Grid(landmarks.bbox, settings.cells)
    tell("weighing evidence", 0.1)
    evidence = evidence_of(landmarks, knowledge, scheme, grid, settings)
    tell("cutting the map", 0.6)
    segments = cut(
        grid, evidence.of, evidence.settled, seen_cells(grid, landmarks.surveyed),
        inherit=settings.empty == "inherit",
    )  # fmt: skip
    tell("drawing segments", 0.9)
    config = configuration(settings, scheme or next(iter(knowledge.schemes)))
    if isinstance(evidence, FieldEvidence):  # what was left to the map
        config |= {"absence": evidence.absence, "bandwidth": evidence.bandwidth}
    counts = sums(grid, grid.count(landmarks.x, landmarks.y), segments.cells)
    return assemble(grid, segments, counts, landmarks, knowledge, config, evidence)


def assemble(
    grid: Grid,
    segments: Segments,
    counts: NDArray[np.int64],
    landmarks: LandmarkMap,
    knowledge: Knowledge,
    config: Mapping[str, Any],
    evidence: Evidence,
) -> EnvironmentMap:
    """An environment map of segments.

    Args:
        grid: what they are cells of.
        segments: s segments.
        counts: (s,) landmarks in each.
        landmarks: what was classified.
        knowledge: what it was classified with.
        config: every setting in force; ``scheme`` among them.
        evidence: what the probabilities were computed from.
    """
    return EnvironmentMap(
        environments=knowledge.scheme(config["scheme"]),
        geometry=shapely.box(*grid.rectangles(segments.cells)),
        label=segments.label,
        probability=segments.probability,
        segment_id=segments.names,
        landmark_count=counts,
        depth=segments.cells.depth.astype(np.int16),
        landmarks=landmarks,
        knowledge=knowledge,
        config=config,
        evidence=evidence,
        evidence_cells=segments.source,
    )


def configuration(settings: Settings, scheme: str) -> dict[str, Any]:
    """Every setting in force, as keywords of ``classify``."""
    return {**settings.as_dict(), "scheme": scheme, "segmentation": "grid"}


def evidence_of(
    landmarks: LandmarkMap,
    knowledge: Knowledge,
    scheme: str | None,
    grid: Grid,
    settings: Settings,
    denied: Floats | None = None,
    near: Sequence[Floats] | None = None,
) -> Evidence:
    """The evidence that the settings ask for.

    ``denied`` as in ``FieldEvidence``, ``near`` as in ``PairEvidence``, where they are known.
    """
    proximity = proximity_of(knowledge, scheme, settings)
    weight = proximity[landmarks.feature] * landmarks.confidence[:, None]
    if settings.evidence == "pairs":
        return PairEvidence(landmarks, weight, grid, settings, near)
    site = np.array([f.site for f in knowledge.features])[landmarks.feature]
    return FieldEvidence(
        landmarks, weight, grid, settings, bandwidth_of(knowledge, scheme, grid, settings), site,
        ground_of(knowledge, proximity), denied,
    )  # fmt: skip


def proximity_of(knowledge: Knowledge, scheme: str | None, settings: Settings) -> Floats:
    """(n, K) semantic proximity of each feature, times its importance unless that is off."""
    if settings.measure != "direct":
        return knowledge.weights(settings.measure, scheme, settings.importance)
    proximity = knowledge.direct(scheme)
    if settings.importance == "entropy":
        proximity = proximity * knowledge.importance("path", scheme)[:, None]
    return proximity


def ground_of(knowledge: Knowledge, proximity: Floats) -> Floats:
    """(K,) what ground without landmarks indicates, from (n, K) proximities of all features."""
    absent = [i for i in map(knowledge.index_of, knowledge.absence) if i is not None]
    return proximity[absent].sum(0) if absent else np.zeros(proximity.shape[1])


def bandwidth_of(knowledge: Knowledge, scheme: str | None, grid: Grid, settings: Settings) -> float:
    """Standard deviation of the kernel in metres: as set, the ontology's, or the grid's."""
    return settings.bandwidth or knowledge.bandwidth(scheme) or min(grid.step) / 3
