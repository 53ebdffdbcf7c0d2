"""Evaluation: maps against their truths, pair by pair and the cells of all pairs together."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.evaluation.metrics import Result, result_of
from symboslam.engine.evaluation.pairs import MOST_CELLS, Pair, pair_of
from symboslam.engine.evaluation.places import Places, read_places
from symboslam.errors import InputError
from symboslam.reasoning.knowledge import Environment, Knowledge
from symboslam.reasoning.matching import unknown_name

if TYPE_CHECKING:
    from symboslam.engine.evaluation.reports import Document

Source = str | Path | Mapping[str, Any]
PLAN_ORDER = (
    "Residential",
    "Commercial",
    "Industrial",
    "CommunityFacility",
    "ParksAndRecreation",
    "TransportAndServices",
    "NonUrban",
    "Military",
)
"""The zones in the order of the Territory Plan; in a tie the first wins. Others come after them."""


@dataclass(frozen=True)
class Evaluation:
    """How well maps agree with their truths.

    Attributes:
        environments: the K environment types, in the order of every K axis.
        pairs: one for each map.
    """

    environments: tuple[Environment, ...]
    pairs: tuple[Pair, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the environments."""
        return tuple(e.name for e in self.environments)

    @cached_property
    def result(self) -> Result:
        """The metrics over the cells of all pairs together."""
        return result_of(
            np.concatenate([pair.truth for pair in self.pairs]),
            np.concatenate([pair.label for pair in self.pairs]),
            np.concatenate([pair.probability for pair in self.pairs]),
            self.names,
        )

    @property
    def notes(self) -> tuple[str, ...]:
        """What a user should know, each note once."""
        return tuple(dict.fromkeys(note for pair in self.pairs for note in pair.notes))

    def as_dict(self) -> Document:
        """All figures as plain values; what ``report.json`` holds."""
        from symboslam.engine.evaluation.reports import as_dict

        return as_dict(self)

    def write(self, target: str | Path) -> None:
        """Write a report: ``.json``, ``.md`` or ``.html``.

        Raises:
            OutputError: another ending, or the file cannot be written; an old file is then kept.
        """
        from symboslam.engine.evaluation.reports import write_report

        write_report(self, target)

    def __repr__(self) -> str:
        r = self.result
        kappa = "none" if r.all.kappa is None else f"{r.all.kappa:.3f}"
        return (
            f"Evaluation({r.cells} truth cells: coverage {r.coverage:.3f}, accuracy "
            f"{r.all.accuracy:.3f}, kappa {kappa}, macro-F1 {r.all.macro_f1:.3f}, mean IoU "
            f"{r.all.mean_iou:.3f}, mAP {r.all.mean_ap:.3f})"
        )


def evaluate(
    truth: Source,
    environment_map: Source | EnvironmentMap,
    *,
    cells: int | None = None,
    bbox: Sequence[float] | None = None,
    knowledge: Knowledge | None = None,
) -> Evaluation:
    """Compare a map with a truth, cell by cell (docs/evaluate.md has the definitions).

    Args:
        truth: GeoJSON of polygons or points with ``environment``: a file, or the document.
        environment_map: a map: GeoJSON, Turtle or N-Quads as ``write_map`` writes it, anybody's
            GeoJSON polygons with ``environment`` and maybe ``probabilities``, or one in memory.
        cells: cells along each side; None takes the map's own number, or 24.
        bbox: the area, in the coordinates of both; None takes that of the truth, else that of the
            map, else the extent of the truth.
        knowledge: the environments that there are besides those that the map describes; None for
            the bundled ontology's.

    Raises:
        InputError: a file cannot be read, says nothing, or names an environment that nobody knows.
        GeometryError: coordinate systems that differ, or a truth and a map that do not meet.
    """
    return evaluate_pairs([(truth, environment_map)], cells=cells, bbox=bbox, knowledge=knowledge)


def evaluate_pairs(
    pairs: Iterable[tuple[Source, Source | EnvironmentMap]],
    *,
    cells: int | None = None,
    bbox: Sequence[float] | None = None,
    knowledge: Knowledge | None = None,
) -> Evaluation:
    """Compare several maps, each with its truth; the metrics are over all their cells together.

    Args:
        pairs: (truth, map) each; see ``evaluate`` for these and the other arguments.
        cells: cells along each side.
        bbox: the area.
        knowledge: the environments that there are.

    Raises:
        InputError: there is no pair, or as ``evaluate``.
        GeometryError: as ``evaluate``.
    """
    if cells is not None and not 1 <= cells <= MOST_CELLS:
        raise InputError(f"cells is {cells}; it must lie from 1 to {MOST_CELLS}")
    read = [(read_places(truth, points=True), _read_map(found)) for truth, found in pairs]
    if not read:
        raise InputError("there is no pair of a truth and a map")
    environments = _environments([p for pair in read for p in pair], knowledge)
    return Evaluation(
        environments, tuple(pair_of(truth, m, environments, cells, bbox) for truth, m in read)
    )


def _read_map(source: Source | EnvironmentMap) -> Places:
    if isinstance(source, EnvironmentMap):
        from symboslam.engine.writers.geojson import to_geojson

        source = to_geojson(source, reasons=0)
    return read_places(source)


def _environments(files: Sequence[Places], knowledge: Knowledge | None) -> tuple[Environment, ...]:
    """All environments that the ontology or a map describes, in the order in which they win ties.

    Raises:
        UnknownNameError: a file names one that is not among them.
    """
    known = {e.name: e for e in (knowledge or Knowledge.load()).environments}
    for places in files:
        known |= places.environments
    for places in files:
        for name in places.environment:
            if name is not None and name not in known:
                count = places.environment.count(name)
                error = unknown_name("environment", name, list(known))
                raise type(error)(f"{places.source}: {error} ({count} features)")
    rank = {name: i for i, name in enumerate(PLAN_ORDER)}
    return tuple(sorted(known.values(), key=lambda e: (rank.get(e.name, len(rank)), e.name)))
