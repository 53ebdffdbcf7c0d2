"""Pairs: a truth and a map brought to one grid of cells."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine.evaluation.cells import cells_of_points, cells_of_polygons
from symboslam.engine.evaluation.metrics import Floats, Ints, Result, result_of
from symboslam.engine.evaluation.places import Places
from symboslam.engine.landmarks import Box
from symboslam.engine.readers.area import parse_box
from symboslam.engine.readers.crs import CoordinateSystem
from symboslam.errors import GeometryError, InputError
from symboslam.reasoning.knowledge import Environment

CELLS = 24
"""Cells along each side where nobody says anything else: the paper's."""
MOST_CELLS = 4096


@dataclass(frozen=True)
class Pair:
    """A truth and a map on one grid of n = cells x cells cells.

    Attributes:
        truth_source: the file with the truth.
        map_source: the file with the map.
        system: name of the coordinate system of both.
        bbox: the area, in these coordinates.
        cells: cells along each side.
        truth: (n,) index into the environments, -1 = no truth; rows from the south.
        label: (n,) what the map says; -1 = unknown.
        probability: (n, K) its probabilities.
        names: the K environments.
        notes: what a user should know.
    """

    truth_source: str
    map_source: str
    system: str
    bbox: Box
    cells: int
    truth: Ints
    label: Ints
    probability: Floats
    names: tuple[str, ...]
    notes: tuple[str, ...]

    @cached_property
    def result(self) -> Result:
        """The metrics of this pair alone."""
        return result_of(self.truth, self.label, self.probability, self.names)


def pair_of(
    truth: Places,
    found: Places,
    environments: tuple[Environment, ...],
    cells: int | None,
    bbox: Sequence[float] | None,
) -> Pair:
    """A truth and a map on one grid.

    Args:
        truth: the truth.
        found: the map.
        environments: the K environments.
        cells: cells along each side; None takes the map's own number, or 24.
        bbox: the area; None takes that of the truth, else of the map, else the truth's extent.

    Raises:
        InputError: the truth is empty, or the number of cells is none.
        GeometryError: coordinate systems that differ, or a truth and a map that do not meet.
    """
    _check_systems(truth, found)
    if not len(truth.geometry):
        raise InputError(f"{truth.source}: there is no polygon or point in this truth")
    box = _box(truth, found, bbox)
    side = cells or found.cells or CELLS
    if not 1 <= side <= MOST_CELLS:
        raise InputError(f"{found.source}: its number of cells, {side}, is none; give --cells")
    names = tuple(e.name for e in environments)
    position = {name: k for k, name in enumerate(names)} | {None: -1}
    probability, ignored = _probabilities(found, names)
    actual = _truth_cells(truth, position, box, side, len(names))
    if not (actual >= 0).any():
        raise GeometryError(
            f"{truth.source}: no cell of the area {_shown(box)} has a truth: its places lie "
            "elsewhere, cover less than half of every cell, or have no environment"
        )
    _check_overlap(found, box, truth.source)
    label, mean = cells_of_polygons(
        found.geometry, found.area, _codes(found, position), probability, box, side
    )
    notes = [*truth.notes, *found.notes]
    if not len(found.geometry):
        notes.append(f"{found.source}: there is no polygon in this map: all of it is unknown")
    notes += [
        f"{found.source}: {n} features have a probability of {name!r}, which is no environment "
        "here: left out"
        for name, n in ignored.items()
    ]
    missing = [
        name
        for k, name in enumerate(names)
        if found.environments and name not in found.environments and (actual == k).any()
    ]
    if missing:
        notes.append(f"{found.source}: its scheme lacks {', '.join(missing)}, which the truth has")
    return Pair(
        truth_source=_short(truth.source),
        map_source=_short(found.source),
        system=truth.system.name,
        bbox=box,
        cells=side,
        truth=actual,
        label=label,
        probability=mean,
        names=names,
        notes=tuple(notes),
    )


def _truth_cells(
    truth: Places, position: Mapping[str | None, int], box: Box, cells: int, count: int
) -> Ints:
    kind = _codes(truth, position)
    if truth.points:
        x, y = shapely.get_coordinates(truth.geometry).T
        return cells_of_points(x, y, kind, box, cells, count)
    none = np.zeros((len(kind), count))
    return cells_of_polygons(truth.geometry, truth.area, kind, none, box, cells)[0]


def _codes(places: Places, position: Mapping[str | None, int]) -> Ints:
    return np.array([position[name] for name in places.environment], np.int64)


def _probabilities(found: Places, names: tuple[str, ...]) -> tuple[Floats, Counter[str]]:
    """(n, K) rows that sum to 1, or are 0; and the names in the file that are no environments.

    Where a place has no probabilities, its environment counts as sure.
    """
    position = {name: k for k, name in enumerate(names)}
    rows = np.zeros((len(found.geometry), len(names)))
    ignored: Counter[str] = Counter()
    for i, given in enumerate(found.probabilities):
        for name, p in given.items():
            if name in position:
                rows[i, position[name]] = p
            else:
                ignored[name] += 1
    total = rows.sum(1, keepdims=True)
    rows = np.divide(rows, total, out=np.zeros_like(rows), where=total > 0)
    for i in np.flatnonzero(total[:, 0] == 0).tolist():
        environment = found.environment[i]
        if environment is not None:
            rows[i, position[environment]] = 1.0
    return rows, ignored


def _box(truth: Places, found: Places, bbox: Sequence[float] | None) -> Box:
    if bbox is not None:
        return parse_box(bbox, "the bounding box", truth.system)
    box = truth.bbox or found.bbox
    if box is None:
        extent = tuple(shapely.total_bounds(truth.geometry).tolist())
        box = parse_box(extent, f"{truth.source}: the extent", truth.system)
    return box


def _check_systems(truth: Places, found: Places) -> None:
    if not _same(truth.system, found.system):
        raise GeometryError(
            f"{truth.source} is in {_words(truth.system)} and {found.source} in "
            f"{_words(found.system)}: bring both into one coordinate system"
        )


def _same(one: CoordinateSystem, other: CoordinateSystem) -> bool:
    if one.transformer is None or other.transformer is None:
        return one.name == other.name
    a, b = one.transformer.source_crs, other.transformer.source_crs
    return one.name == other.name or bool(a and b and a.equals(b, ignore_axis_order=True))


def _words(system: CoordinateSystem) -> str:
    return "local metres" if system.metric else system.name


def _short(source: str) -> str:
    """A file's name and its folder's, for reports that others get."""
    return "/".join(part for part in Path(source).parts[-2:] if part != "/")


def _check_overlap(found: Places, box: Box, truth: str) -> None:
    if not len(found.geometry):
        return
    west, south, east, north = shapely.total_bounds(found.geometry).tolist()
    if west >= box[2] or east <= box[0] or south >= box[3] or north <= box[1]:
        raise GeometryError(
            f"{found.source} lies elsewhere: it spans {_shown((west, south, east, north))}, and "
            f"the area of {truth} is {_shown(box)}"
        )


def _shown(box: Sequence[float] | NDArray[np.float64]) -> str:
    return "(" + ", ".join(f"{v:.10g}" for v in box) + ")"
