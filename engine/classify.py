"""classify: landmarks and knowledge in, environment map out."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine._base import Evidence, normalised
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.evidence import PairEvidence
from symboslam.engine.field import FieldEvidence
from symboslam.engine.grid import Cells, Grid, quadtree
from symboslam.engine.landmarks import LandmarkMap
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
    environments = knowledge.scheme(scheme)
    tell = progress or (lambda stage, share: None)
    grid = Grid(landmarks.bbox, settings.cells)
    tell("weighing evidence", 0.1)
    evidence = evidence_of(landmarks, knowledge, scheme, grid, settings)
    tell("cutting the map", 0.6)
    seen = _seen(grid, landmarks)

    def settled(cells: Cells, values: Floats) -> NDArray[np.bool_]:
        """Settled by the evidence, and not partly outside what was looked at."""
        part = _sums(grid, seen, cells)
        whole = (part == 0) | (part == np.asarray(grid.span(cells.depth)) ** 2)
        return np.asarray(evidence.settled(cells, values) & whole)

    cells, values = quadtree(grid, evidence.of, settled)
    source = cells
    if settings.empty == "inherit":
        source, values = _inherit(grid, evidence, cells, values)
    values[_sums(grid, seen, cells) == 0] = 0
    probability = normalised(values)
    label = np.where(probability.any(1), probability.argmax(1), -1).astype(np.int16)
    tell("drawing segments", 0.9)
    return EnvironmentMap(
        environments=environments,
        geometry=shapely.box(*grid.rectangles(cells)),
        label=label,
        probability=probability,
        segment_id=np.array(
            [f"{d}-{r}-{c}" for d, r, c in zip(cells.depth, cells.row, cells.column, strict=True)],
            dtype=np.str_,
        ),
        landmark_count=_sums(grid, _inside(grid, landmarks), cells),
        depth=cells.depth.astype(np.int16),
        landmarks=landmarks,
        knowledge=knowledge,
        config={
            **settings.as_dict(),
            "scheme": scheme or next(iter(knowledge.schemes)),
            "segmentation": segmentation,
            **_estimated(evidence),
        },
        evidence=evidence,
        evidence_cells=source,
    )


def evidence_of(
    landmarks: LandmarkMap,
    knowledge: Knowledge,
    scheme: str | None,
    grid: Grid,
    settings: Settings,
) -> Evidence:
    """The evidence that the settings ask for."""
    if settings.measure == "direct":
        proximity = knowledge.direct(scheme)
        if settings.importance == "entropy":
            proximity = proximity * knowledge.importance("path", scheme)[:, None]
    else:
        proximity = knowledge.weights(settings.measure, scheme, settings.importance)
    weight = proximity[landmarks.feature] * landmarks.confidence[:, None]
    if settings.evidence == "pairs":
        return PairEvidence(landmarks, weight, grid, settings)
    absent = [i for i in map(knowledge.index_of, knowledge.absence) if i is not None]
    absence = proximity[absent].sum(0) if absent else np.zeros(proximity.shape[1])
    bandwidth = settings.bandwidth or knowledge.bandwidth(scheme) or min(grid.step) / 3
    site = np.array([f.site for f in knowledge.features])[landmarks.feature]
    return FieldEvidence(landmarks, weight, grid, settings, bandwidth, site, absence)


def _estimated(evidence: Evidence) -> dict[str, Any]:
    """Settings that were left to the map, as they were in the end."""
    if isinstance(evidence, FieldEvidence):
        return {"absence": evidence.absence, "bandwidth": evidence.bandwidth}
    return {}


def _inherit(grid: Grid, evidence: Evidence, cells: Cells, values: Floats) -> tuple[Cells, Floats]:
    """Cells without evidence take that of the nearest larger cell that has some."""
    source = Cells(cells.depth.copy(), cells.row.copy(), cells.column.copy())
    values = values.copy()
    for _ in range(grid.depth):
        bare = np.flatnonzero(~values.any(1) & (source.depth > 0))
        if not len(bare):
            break
        parents = source.take(bare).parent()
        source.depth[bare], source.row[bare], source.column[bare] = (
            parents.depth,
            parents.row,
            parents.column,
        )
        for depth in np.unique(parents.depth):
            here = parents.depth == depth
            values[bare[here]] = evidence.of(parents.take(here))
    return source, values


def _inside(grid: Grid, landmarks: LandmarkMap) -> NDArray[np.int64]:
    """(cells, cells) landmarks in each finest cell."""
    inside = np.zeros((grid.cells, grid.cells), np.int64)
    np.add.at(inside, grid.finest_of(landmarks.x, landmarks.y), 1)
    return inside


def _sums(grid: Grid, finest: NDArray[np.int64], cells: Cells) -> NDArray[np.int64]:
    """(s,) sum of a (cells, cells) array over each segment."""
    sums = np.zeros(len(cells), np.int64)
    for depth in np.unique(cells.depth):
        here = cells.depth == depth
        sums[here] = grid.coarsen(finest, int(depth))[cells.row[here], cells.column[here]]
    return sums


def _seen(grid: Grid, landmarks: LandmarkMap) -> NDArray[np.int64]:
    """(cells, cells) 1 where the middle of the finest cell was looked at (design 5)."""
    if landmarks.surveyed is None:
        return np.ones((grid.cells, grid.cells), np.int64)
    west, south, east, north = grid.rectangles(grid.level(grid.depth))
    shapely.prepare(landmarks.surveyed)
    middle = shapely.contains_xy(landmarks.surveyed, (west + east) / 2, (south + north) / 2)
    return np.asarray(middle, np.int64).reshape(grid.cells, grid.cells)
