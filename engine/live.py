"""LiveMap: a map cut by grid that is kept up to date as its landmarks come, change and go.

The same evidence and the same cutting as in ``classify``, given the landmarks around the change
alone. After each change the map is what ``classify`` makes of all its landmarks with the settings
in ``config``, which are those asked for and the bandwidth and absence in force.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from symboslam.engine._base import CellEvidence
from symboslam.engine.classify import classify
from symboslam.engine.density import Density
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.field import FieldEvidence, crowding_share
from symboslam.engine.grid import Cells, Grid
from symboslam.engine.grid_map import (
    GridSegmentation,
    assemble,
    bandwidth_of,
    evidence_of,
    ground_of,
)
from symboslam.engine.landmarks import LandmarkMap, ReadReport
from symboslam.engine.live_field import LiveField
from symboslam.engine.live_pairs import LivePairs
from symboslam.engine.neighbourhood import Mask, covered
from symboslam.engine.segmentation import Segments, cut, seen_cells, sums
from symboslam.engine.settings import settings_of
from symboslam.engine.table import Landmark, LandmarkTable
from symboslam.engine.weights import proximity_of
from symboslam.errors import UnknownNameError
from symboslam.reasoning.knowledge import Knowledge

DRIFT = 0.1
"""How far, as a share, the estimate of absence may move before the whole map takes it over."""


@dataclass(frozen=True)
class Change:
    """What changed in a map.

    Attributes:
        landmarks: id -> the landmark before and after; None where there was, or is, none.
        gone: ids of segments that are no more.
        changed: new segments and those whose evidence changed, as a map of their own; None if
            there are none.
        everything: all segments were made anew.
    """

    landmarks: Mapping[str, tuple[Landmark | None, Landmark | None]]
    gone: tuple[str, ...] = ()
    changed: EnvironmentMap | None = None
    everything: bool = False


class LiveMap:
    """A map that is kept up to date.

    Args:
        area: frame, box and surveyed area of the map; its landmarks are not taken over.
        knowledge: what each kind of landmark indicates.
        profile: ``default`` or ``paper``.
        scheme: set of environment types; None takes the ontology's default.
        **changes: settings that differ from the profile's.

    Attributes:
        table: the landmarks; whoever changes it calls `catch_up`.
        knowledge: as given.
        absence: evidence of unmarked ground per hectare, as set or estimated.

    Raises:
        UnknownNameError: no such profile, scheme or setting.
        InputError: a setting out of its range.
    """

    def __init__(
        self,
        area: LandmarkMap,
        knowledge: Knowledge,
        *,
        profile: str = "default",
        scheme: str | None = None,
        **changes: Any,
    ) -> None:
        settings = settings_of(profile, **changes)
        self._like, self.knowledge = area.take(np.zeros(0, np.int64)), knowledge
        self._scheme = scheme or next(iter(knowledge.schemes))
        self._grid = grid = Grid(area.bbox, settings.cells)
        proximity = proximity_of(knowledge, self._scheme, settings)
        bandwidth = bandwidth_of(knowledge, self._scheme, grid, settings)
        self._ground = ground_of(knowledge, proximity)
        width = np.maximum([f.site for f in knowledge.features], bandwidth)
        self._seen = seen_cells(grid, area.surveyed)
        self._inside = np.zeros((grid.cells, grid.cells), np.int64)
        self._field = np.zeros((grid.cells, grid.cells, proximity.shape[1]))
        self._estimates = settings.absence is None
        self.absence = settings.absence or 0.0
        if self._estimates:
            self.absence = crowding_share(self._field)
        self._settings = replace(settings, bandwidth=bandwidth, absence=self.absence)
        self._no_evidence = evidence_of(self._like, knowledge, self._scheme, grid, self._settings)
        """That of a map without landmarks."""
        self._roots: dict[tuple[int, int], Segments] = {}
        self._pairs = LivePairs(grid, proximity) if settings.evidence == "pairs" else None
        self.table = LandmarkTable(knowledge, grid, np.unique(width, return_inverse=True)[1])
        self._around = LiveField(
            grid, self.table, proximity, width, bandwidth, settings.dissimilarity > 0
        )
        self._update(np.ones((grid.cells, grid.cells), bool), Change({}))

    @property
    def config(self) -> dict[str, Any]:
        """Every setting in force; ``classify`` with these gives the same map."""
        return GridSegmentation().configuration(self._settings, self._scheme)

    @property
    def report(self) -> ReadReport:
        """What readers took and left; whoever adds landmarks keeps it up to date."""
        return self._like.report

    @report.setter
    def report(self, report: ReadReport) -> None:
        self._like = replace(self._like, report=report)

    @property
    def area(self) -> LandmarkMap:
        """Where the map lies, as a map without landmarks."""
        return self._like

    def resume(self, absence: float) -> None:
        """Take over the estimate of absence of a map with the same landmarks.

        The estimate in force depends on how the landmarks came, because it follows in steps of
        `DRIFT`. A map that is made of all landmarks at once has another one, and so slightly
        other probabilities, until it takes the old one over.
        """
        if self._estimates and absence != self.absence:
            self.absence = absence
            self._settings = replace(self._settings, absence=absence)
            self._update(np.ones_like(self._inside, dtype=bool), Change({}))

    def landmarks(self) -> LandmarkMap:
        """All landmarks."""
        return self.table.take(self.table.rows(), self._like)

    def environment_map(self) -> EnvironmentMap:
        """The whole map, classified at one go."""
        return classify(self.landmarks(), self.knowledge, **self.config)

    def described(self, landmarks: Sequence[Landmark]) -> EnvironmentMap:
        """Some landmarks, as a map without segments."""
        none = Segments(_cells([]), _cells([]), np.zeros((0, len(self._ground))))
        return self._assembled(
            none, self.table.landmark_map(landmarks, self._like), self._no_evidence
        )

    def segments(self) -> EnvironmentMap:
        """All segments, without the landmarks behind them."""
        segments = Segments.joined(list(self._roots.values()))
        return self._assembled(segments, self._like, self._no_evidence)

    def segment(self, name: str) -> EnvironmentMap:
        """One segment as a map, with the landmarks that have a say, and those close to them.

        Raises:
            UnknownNameError: no such segment.
        """
        for segments in self._roots.values():
            here = np.flatnonzero(segments.names == name)
            if len(here):
                return self._map(segments.take(here), True)
        raise UnknownNameError(f"no segment {name[:80]!r} in this map")

    def catch_up(self) -> Change | None:
        """Classify anew what was touched since the last call; None if nothing was."""
        landmarks, moved = {}, []
        gone: list[int] = []
        come: list[tuple[int, Landmark]] = []
        for identifier, (row, before) in self.table.pop_changes().items():
            after = self.table.find(identifier)
            here = row if after is None else self.table.number(identifier)
            if before == after and here == row:
                continue
            landmarks[identifier] = before, after
            if before is None or after is None or here != row or _differ(before, after):
                moved += [each for each in (before, after) if each is not None]
                gone += [row] if before is not None else []
                come += [(here, after)] if after is not None else []
        if self._pairs:
            self._pairs.follow(gone, come)
        if not landmarks:
            return None
        change = Change(landmarks)
        return self._follow(change, moved) if moved else change

    def _follow(self, change: Change, moved: list[Landmark]) -> Change:
        """Classify anew what some landmarks have, or had, a say in."""
        x, y = np.array([(each.x, each.y) for each in moved]).T
        own = np.zeros(self._inside.shape, bool)
        own[self._grid.finest_of(x, y)] = True
        for cell in np.flatnonzero(own).tolist():
            self._inside.flat[cell] = self.table.count(cell)
        return self._update(own if self._pairs else self._around.follow(moved), change)

    def _update(self, touched: Mask, change: Change) -> Change:
        """Classify anew the segments whose evidence is from cells that were touched."""
        roots = self._roots_in(touched)
        old = [self._roots[root] for root in roots if root in self._roots]
        around = touched.copy()
        for segments in old:
            source = segments.source
            around |= covered(self._grid, source.take(self._overlap(source, touched)))
        landmarks, evidence = self._evidence(around)
        everything = False
        if isinstance(evidence, FieldEvidence):
            self._field[touched] = evidence.field[touched]
            if everything := self._silence_changed():
                touched = np.ones_like(touched)
                roots, old = self._roots_in(touched), list(self._roots.values())
        values = self._density() if isinstance(evidence, FieldEvidence) else evidence
        segments = cut(
            self._grid,
            values.of,
            values.settled,
            self._seen,
            inherit=self._settings.empty == "inherit",
            roots=_cells(roots),
        )
        before = {name for part in old for name in part.names.tolist()}
        names = segments.names
        self._keep(segments, roots)
        new = np.array([name not in before for name in names.tolist()], bool)
        changed = segments.take(new | self._overlap(segments.source, touched))
        if everything or (covered(self._grid, changed.source) & ~around).any():
            landmarks, evidence = self._evidence(covered(self._grid, changed.source))
        gone = tuple(sorted(before.difference(names.tolist())))
        return replace(
            change,
            gone=gone,
            changed=self._assembled(changed, landmarks, evidence) if len(changed.cells) else None,
            everything=everything,
        )

    def _evidence(self, cells: Mask, neighbours: bool = False) -> tuple[LandmarkMap, CellEvidence]:
        """The evidence in some cells, and the landmarks that it is from.

        With ``neighbours`` also those that contradict these, or would if one were gone.
        """
        denied = near = None
        if self._pairs:
            roots = covered(self._grid, _cells(self._roots_in(cells)))
            rows = self.table.within(np.flatnonzero(roots).tolist())
            near = list(self._pairs.near(rows))
        else:
            rows = self._around.rows(cells)
            if neighbours:
                rows = self._around.with_neighbours(rows)
            denied = self._around.denied(rows)
        landmarks = self.table.take(rows, self._like)
        return landmarks, evidence_of(
            landmarks, self.knowledge, self._scheme, self._grid, self._settings, denied, near
        )

    def _density(self) -> Density:
        field = self._field + self.absence * self._ground
        return Density(self._grid, self._settings.threshold, field, self._inside)

    def _silence_changed(self) -> bool:
        """Estimate anew what unmarked ground says; whether that has moved far enough to count."""
        estimate = crowding_share(self._field)
        if not self._estimates or abs(estimate - self.absence) <= DRIFT * self.absence:
            return False
        self.absence = estimate
        self._settings = replace(self._settings, absence=estimate)
        return True

    def _roots_in(self, cells: Mask) -> list[tuple[int, int]]:
        """(row, column) of the coarsest cells with some of the finest in them."""
        found = self._grid.coarsen(cells.astype(np.int64), 0)
        return [(int(row), int(column)) for row, column in np.argwhere(found)]

    def _overlap(self, cells: Cells, mask: Mask) -> Mask:
        """(m,) which of m cells overlap others."""
        return np.asarray(sums(self._grid, mask.astype(np.int64), cells) > 0)

    def _keep(self, segments: Segments, roots: list[tuple[int, int]]) -> None:
        cells = segments.cells
        for row, column in roots:
            here = (cells.row >> cells.depth == row) & (cells.column >> cells.depth == column)
            self._roots[row, column] = segments.take(here)

    def _map(self, segments: Segments, neighbours: bool = False) -> EnvironmentMap:
        cells = covered(self._grid, segments.source)
        return self._assembled(segments, *self._evidence(cells, neighbours))

    def _assembled(
        self, segments: Segments, landmarks: LandmarkMap, evidence: CellEvidence
    ) -> EnvironmentMap:
        counts = sums(self._grid, self._inside, segments.cells)
        return assemble(
            self._grid, segments, counts, landmarks, self.knowledge, self.config, evidence
        )


def _differ(one: Landmark, two: Landmark) -> bool:
    """Whether the evidence of a landmark changed."""
    return (one.feature, one.x, one.y, one.confidence) != (
        two.feature,
        two.x,
        two.y,
        two.confidence,
    )


def _cells(roots: list[tuple[int, int]]) -> Cells:
    row, column = np.array(roots, np.int64).reshape(-1, 2).T
    return Cells(np.zeros(len(roots), np.int64), row, column)
