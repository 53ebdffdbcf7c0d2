"""GridSegmentation: nested cells, split while they are uncertain, become a map (design 6)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine._base import CellEvidence
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.evidence import PairEvidence
from symboslam.engine.field import FieldEvidence
from symboslam.engine.grid import Grid
from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.registry import Progress, Segmentation
from symboslam.engine.segmentation import Segments, cut, seen_cells, sums
from symboslam.engine.settings import Settings
from symboslam.engine.weights import proximity_of, weights_of
from symboslam.reasoning.knowledge import Knowledge

Floats = NDArray[np.float64]


class GridSegmentation(Segmentation):
    """Cells that are split into quadrants while no environment is certain enough."""

    name: ClassVar[str] = "grid"
    unused: ClassVar[frozenset[str]] = frozenset(
        {"seed_position", "momentum", "reach", "relevance"}
    )

    def cut(
        self,
        landmarks: LandmarkMap,
        knowledge: Knowledge,
        scheme: str | None,
        settings: Settings,
        tell: Progress,
    ) -> EnvironmentMap:
        """Cut a map into cells."""
        grid = Grid(landmarks.bbox, settings.cells)
        tell("weighing evidence", 0.1)
        evidence = evidence_of(landmarks, knowledge, scheme, grid, settings)
        tell("cutting the map", 0.6)
        segments = cut(
            grid, evidence.of, evidence.settled, seen_cells(grid, landmarks.surveyed),
            inherit=settings.empty == "inherit",
        )  # fmt: skip
        tell("drawing segments", 0.9)
        config = self.configuration(settings, scheme or next(iter(knowledge.schemes)))
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
    evidence: CellEvidence,
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
        regions=segments.source,
    )


def evidence_of(
    landmarks: LandmarkMap,
    knowledge: Knowledge,
    scheme: str | None,
    grid: Grid,
    settings: Settings,
    denied: Floats | None = None,
    near: Sequence[Floats] | None = None,
) -> CellEvidence:
    """The evidence that the settings ask for.

    ``denied`` as in ``FieldEvidence``, ``near`` as in ``PairEvidence``, where they are known.
    """
    weight = weights_of(landmarks, knowledge, scheme, settings)
    if settings.evidence == "pairs":
        return PairEvidence(landmarks, weight, grid, settings, near)
    site = np.array([f.site for f in knowledge.features])[landmarks.feature]
    return FieldEvidence(
        landmarks, weight, grid, settings, bandwidth_of(knowledge, scheme, grid, settings), site,
        ground_of(knowledge, proximity_of(knowledge, scheme, settings)), denied,
    )  # fmt: skip


def ground_of(knowledge: Knowledge, proximity: Floats) -> Floats:
    """(K,) what ground without landmarks indicates, from (n, K) proximities of all features."""
    absent = [i for i in map(knowledge.index_of, knowledge.absence) if i is not None]
    return proximity[absent].sum(0) if absent else np.zeros(proximity.shape[1])


def bandwidth_of(knowledge: Knowledge, scheme: str | None, grid: Grid, settings: Settings) -> float:
    """Standard deviation of the kernel in metres: as set, the ontology's, or the grid's."""
    return settings.bandwidth or knowledge.bandwidth(scheme) or min(grid.step) / 3
