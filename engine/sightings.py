"""Sightings: observations of a running map, merged into landmarks by class and distance.

An observation that an agent gave an id belongs to the landmark that this agent has called so
before, if that is of the same class; any other belongs to the nearest landmark of its class within
the radius. An id without an agent says nothing: two that do not know of each other may use it. A
landmark lies at the mean of its observations, weighted by their confidence, and has the largest of
their confidences (design 7). Whole maps of agents are merged elsewhere.
"""

from __future__ import annotations

import math
from dataclasses import replace
from datetime import datetime

from symboslam.engine.table import Landmark, LandmarkTable

_Place = tuple[int, int, int]
Name = tuple[str, str]
"""Agent, and the id that it gave."""


class Sightings:
    """Merges observations into a table of landmarks.

    Args:
        table: the landmarks.
        radius: in metres; observations of one class within it are of one landmark.
        names: what agents call landmarks -> landmark id.

    Attributes:
        names: as given, kept up to date.
    """

    def __init__(
        self, table: LandmarkTable, radius: float, names: dict[Name, str] | None = None
    ) -> None:
        self._table, self._radius = table, radius
        self.names = {} if names is None else names
        self._near: dict[_Place, set[int]] = {}
        self._next = len(table) + 1
        for row in table.rows().tolist():
            self._near.setdefault(self._place(table[row]), set()).add(row)

    def observe(self, seen: Landmark, name: str = "") -> Landmark:
        """Merge one observation.

        Args:
            seen: the observation as a landmark; its id, count and weight do not matter.
            name: the id that its agent gave it; without an agent it is no more than a suggestion
                of what to call a new landmark.

        Returns:
            The landmark that it is of, as it is now in the table.
        """
        row = self._known(seen, name)
        if row is None:
            row = self._nearest(seen)
        if row is None:
            found = replace(seen, id=self._new_id(seen, name), count=1, weight=seen.confidence)
        else:
            known = self._table[row]
            self._near[self._place(known)].discard(row)
            found = merged(known, seen)
        row = self._table.put(found)
        self._near.setdefault(self._place(found), set()).add(row)
        if name and seen.agent:
            self.names[seen.agent, name] = found.id
        return found

    def put(self, landmark: Landmark) -> None:
        """Make a landmark what it is said to be, whatever was observed of it before."""
        self._leave(landmark.id)
        row = self._table.put(landmark)
        self._near.setdefault(self._place(landmark), set()).add(row)

    def remove(self, identifier: str) -> bool:
        """Remove a landmark; whether it was there."""
        was_there = self._leave(identifier)
        self._table.remove(identifier)
        return was_there

    def _leave(self, identifier: str) -> bool:
        row = self._table.row_of(identifier)
        if row is not None:
            self._near[self._place(self._table[row])].discard(row)
        return row is not None

    def _known(self, seen: Landmark, name: str) -> int | None:
        identifier = self.names.get((seen.agent, name)) if name and seen.agent else None
        row = None if identifier is None else self._table.row_of(identifier)
        return row if row is not None and self._table[row].feature == seen.feature else None

    def _nearest(self, seen: Landmark) -> int | None:
        feature, i, j = self._place(seen)
        best: tuple[float, int] | None = None
        for u in (i - 1, i, i + 1):
            for v in (j - 1, j, j + 1):
                for row in self._near.get((feature, u, v), ()):
                    other = self._table[row]
                    found = math.hypot(other.x - seen.x, other.y - seen.y), row
                    if found[0] <= self._radius and (best is None or found < best):
                        best = found
        return None if best is None else best[1]

    def _new_id(self, seen: Landmark, name: str) -> str:
        if name:
            for identifier in (name, *([f"{seen.agent}/{name}"] if seen.agent else [])):
                if identifier not in self._table:
                    return identifier
        while f"L{self._next}" in self._table:
            self._next += 1
        return f"L{self._next}"

    def _place(self, landmark: Landmark) -> _Place:
        size = self._radius or 1.0
        return landmark.feature, math.floor(landmark.x / size), math.floor(landmark.y / size)


def merged(known: Landmark, seen: Landmark) -> Landmark:
    """A landmark with one observation more."""
    weight = known.weight + seen.confidence
    share = seen.confidence / weight
    later = _moment(seen) >= _moment(known)
    return replace(
        known,
        x=known.x + (seen.x - known.x) * share,
        y=known.y + (seen.y - known.y) * share,
        confidence=max(known.confidence, seen.confidence),
        time=seen.time if later else known.time,
        agent=seen.agent if later else known.agent,
        count=known.count + 1,
        weight=weight,
    )


def _moment(landmark: Landmark) -> float:
    return datetime.fromisoformat(landmark.time).timestamp() if landmark.time else -math.inf
