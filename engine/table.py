"""LandmarkTable: landmarks that come, change and go, found by where they are."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.grid import Grid
from symboslam.engine.landmarks import LandmarkMap
from symboslam.reasoning.knowledge import Knowledge

Rows = NDArray[np.int64]
_FIRST = 1024


@dataclass(frozen=True)
class Landmark:
    """One landmark, and how often it was seen.

    Attributes:
        id: unique in its map.
        feature: position in ``knowledge.features``.
        x: metres east of the frame's origin.
        y: metres north of the frame's origin.
        confidence: of its class, in (0, 1].
        time: of its last observation, ISO 8601 with zone, or None.
        agent: who made that one, or None.
        count: observations that were merged into it.
        weight: sum of their confidences.
    """

    id: str
    feature: int
    x: float
    y: float
    confidence: float
    time: str | None = None
    agent: str | None = None
    count: int = 1
    weight: float = 1.0


class LandmarkTable:
    """Landmarks in rows; a row keeps its number as long as its landmark is there.

    Args:
        knowledge: what their features are.
        grid: cells by which they are found.
        group: (features,) number of the group of each feature, by which they are found as well;
            by default all are of one group.
    """

    def __init__(
        self, knowledge: Knowledge, grid: Grid, group: NDArray[np.int64] | None = None
    ) -> None:
        self._static = np.array([f.static for f in knowledge.features], np.bool_)
        self._grid = grid
        self._rows: dict[str, int] = {}
        self._landmarks: list[Landmark | None] = []
        self._free: list[int] = []
        self._feature = np.zeros(_FIRST, np.int32)
        self._numbers = np.zeros((_FIRST, 3))  # x, y, confidence
        self._cell: list[int] = []
        self._group = [0] * len(self._static) if group is None else group.tolist()
        self._within: list[dict[int, set[int]]] = [{} for _ in range(max(self._group) + 1)]
        self._before: dict[str, tuple[int, Landmark | None]] = {}

    def __len__(self) -> int:
        return len(self._rows)

    def __contains__(self, identifier: object) -> bool:
        return identifier in self._rows

    def __getitem__(self, row: int) -> Landmark:
        found = self._landmarks[row]
        if found is None:
            raise IndexError(f"there is no landmark in row {row}")
        return found

    def find(self, identifier: str) -> Landmark | None:
        """A landmark, or None."""
        row = self._rows.get(identifier)
        return None if row is None else self._landmarks[row]

    def row_of(self, identifier: str) -> int | None:
        """Row of a landmark, or None."""
        return self._rows.get(identifier)

    def number(self, identifier: str) -> int:
        """Row of a landmark that is there."""
        return self._rows[identifier]

    def rows(self) -> Rows:
        """All rows, in order."""
        return np.array(sorted(self._rows.values()), np.int64)

    def put(self, landmark: Landmark) -> int:
        """Add a landmark, or change the one with its id; its row."""
        row = self._rows.get(landmark.id)
        before = None if row is None else self._landmarks[row]
        if row is None:
            row = self._new_row()
            self._rows[landmark.id] = row
        else:
            self._leave(row)
        self._before.setdefault(landmark.id, (row, before))
        self._landmarks[row] = landmark
        self._feature[row] = landmark.feature
        self._numbers[row] = landmark.x, landmark.y, landmark.confidence
        self._cell[row] = self._grid.cell_of(landmark.x, landmark.y)
        group = self._within[self._group[landmark.feature]]
        group.setdefault(self._cell[row], set()).add(row)
        return row

    def remove(self, identifier: str) -> None:
        """Remove a landmark; one that is not there is removed already."""
        row = self._rows.pop(identifier, None)
        if row is not None:
            self._before.setdefault(identifier, (row, self._landmarks[row]))
            self._leave(row)
            self._landmarks[row] = None
            self._free.append(row)

    def pop_changes(self) -> dict[str, tuple[int, Landmark | None]]:
        """What changed since the last call: id -> row, and the landmark as it was, if it was."""
        found, self._before = self._before, {}
        return found

    def count(self, cell: int) -> int:
        """Landmarks in a finest cell, given as row * cells + column."""
        return sum(len(group.get(cell, ())) for group in self._within)

    def _new_row(self) -> int:
        if self._free:
            return self._free.pop()
        row = len(self._landmarks)
        self._landmarks.append(None)
        self._cell.append(0)
        if row == len(self._feature):
            self._feature = np.concatenate([self._feature, np.zeros_like(self._feature)])
            self._numbers = np.concatenate([self._numbers, np.zeros_like(self._numbers)])
        return row

    def xy(self, rows: Rows) -> NDArray[np.float64]:
        """(m, 2) positions of rows, in metres."""
        return self._numbers[rows, :2]

    def feature(self, rows: Rows) -> NDArray[np.int32]:
        """(m,) features of rows."""
        return self._feature[rows]

    def confidence(self, rows: Rows) -> NDArray[np.float64]:
        """(m,) confidences of rows."""
        return np.asarray(self._numbers[rows, 2])

    def within(self, cells: Iterable[int], group: int | None = None) -> Rows:
        """Rows in finest cells, given as row * cells + column; in order.

        Args:
            cells: the cells.
            group: of the features; None takes all.
        """
        wanted = list(cells)
        found: set[int] = set()
        for here in self._within if group is None else [self._within[group]]:
            if len(here) < len(wanted):
                chosen = set(wanted)
                found.update(*(rows for cell, rows in here.items() if cell in chosen))
            else:
                found.update(*(here[cell] for cell in wanted if cell in here))
        rows = np.fromiter(found, np.int64, len(found))
        rows.sort()
        return rows

    def _leave(self, row: int) -> None:
        self._within[self._group[self._feature[row]]][self._cell[row]].discard(row)

    def take(self, rows: Rows, like: LandmarkMap) -> LandmarkMap:
        """Some landmarks as a map with the frame, area and report of another."""
        found = self._landmarks
        return self.landmark_map([m for row in rows.tolist() if (m := found[row])], like)

    def landmark_map(self, landmarks: Sequence[Landmark], like: LandmarkMap) -> LandmarkMap:
        """Landmarks, be they in the table or not, as a map like another."""
        feature = np.array([each.feature for each in landmarks], np.int32)
        numbers = np.array([(each.x, each.y, each.confidence) for each in landmarks])
        x, y, confidence = numbers.reshape(-1, 3).T
        return LandmarkMap(
            feature=feature,
            x=x,
            y=y,
            confidence=confidence,
            static=self._static[feature],
            id=np.array([each.id for each in landmarks], np.str_),
            frame=like.frame,
            bbox=like.bbox,
            surveyed=like.surveyed,
            time=_column([each.time for each in landmarks]),
            agent=_column([each.agent for each in landmarks]),
            report=like.report,
        )


def _column(values: list[str | None]) -> NDArray[Any] | None:
    """Texts as a column, or None if there are none."""
    if not any(values):
        return None
    column = np.empty(len(values), object)
    column[:] = values
    return column
