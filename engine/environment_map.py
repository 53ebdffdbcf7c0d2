"""EnvironmentMap: segments with environment types, probabilities and reasons."""

from __future__ import annotations

import difflib
import html
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine._base import Contributions, Evidence, Regions
from symboslam.engine.chain import Shares, Zoning
from symboslam.engine.explanation import ClassParts, Explanation, Reason, reasons_of
from symboslam.engine.landmarks import LandmarkMap
from symboslam.errors import UnknownNameError
from symboslam.reasoning.knowledge import Environment, Knowledge


@dataclass(frozen=True)
class EnvironmentMap:
    """Segments of a map, column by column (s segments, K environments of the scheme in use).

    Attributes:
        environments: the K environment types of the scheme; the order of every K axis.
        geometry: (s,) shapely polygons, or several as one, in metres of ``landmarks.frame``.
        label: (s,) index into ``environments``; -1 = unknown.
        probability: (s, K), rows sum to 1, or are all 0 where unknown.
        segment_id: (s,) text, unique: depth-row-column of a cell, rows from the south; b-number
            of a fragment.
        landmark_count: (s,) landmarks inside.
        depth: (s,) how often the area was divided to get it; 0 of a fragment.
        landmarks: what was classified.
        knowledge: what it was classified with.
        config: every setting in force, as plain values.
        evidence: what the probabilities were computed from.
        regions: (s,) the region whose evidence each segment has: its own, or of a cell around it.
    """

    environments: tuple[Environment, ...]
    geometry: NDArray[Any]
    label: NDArray[np.int16]
    probability: NDArray[np.float64]
    segment_id: NDArray[np.str_]
    landmark_count: NDArray[np.int64]
    depth: NDArray[np.int16]
    landmarks: LandmarkMap
    knowledge: Knowledge
    config: Mapping[str, Any]
    evidence: Evidence[Any]
    regions: Regions

    def __len__(self) -> int:
        return len(self.label)

    @cached_property
    def _positions(self) -> dict[str, int]:
        return {str(name): i for i, name in enumerate(self.segment_id)}

    def position_of(self, segment_id: str) -> int:
        """Position of a segment.

        Raises:
            UnknownNameError: no such segment; names the closest ids.
        """
        found = self._positions.get(str(segment_id))
        if found is None:
            close = difflib.get_close_matches(str(segment_id), self._positions, 3, 0)
            raise UnknownNameError(
                f"no segment {segment_id!r} in this map of {len(self)}; close: {', '.join(close)}"
            )
        return found

    def column_of(self, environment: str) -> int:
        """Position of an environment in ``environments``.

        Raises:
            UnknownNameError: there is none of that name.
        """
        names = [e.name for e in self.environments]
        if environment not in names:
            raise UnknownNameError(f"no environment {environment!r}; there are {', '.join(names)}")
        return names.index(environment)

    def contributions(self, segments: Sequence[int]) -> Iterator[Contributions]:
        """The landmarks behind each of the segments (positions), in units of P~."""
        regions = self.regions.take(np.asarray(segments, np.int64))
        return self.evidence.contributions(regions)

    def reasons(
        self, segments: Sequence[int], limit: int | None = None
    ) -> list[tuple[Reason, ...]]:
        """Reasons of several segments (positions), the largest share of any P first."""
        return [reasons[:limit] for reasons, _ in self.told(segments)]

    def told(self, segments: Sequence[int]) -> list[tuple[tuple[Reason, ...], Shares]]:
        """Reasons of several segments (positions), and how zones share their environments."""
        known = [i for i in segments if self.label[i] >= 0]
        found = {}
        for i, each in zip(known, self.contributions(known), strict=True):
            parts = ClassParts.of(each, self.landmarks)
            found[i] = (
                reasons_of(parts, self.knowledge, self.environments),
                self.zoning.shares(parts.classes, parts.parts, parts.total),
            )
        return [found.get(i, ((), {})) for i in segments]

    @cached_property
    def zoning(self) -> Zoning:
        """How probabilities are chained to plan zones and to groups of environment types."""
        return Zoning(self.knowledge, self.config.get("scheme"), self.config.get("measure", "path"))

    def name_of(self, position: int) -> str | None:
        """Environment of a segment, or None if unknown."""
        label = int(self.label[position])
        return None if label < 0 else self.environments[label].name

    def explain(self, segment_id: str) -> Explanation:
        """Why a segment is what it is; its reasons add up to its probabilities.

        Raises:
            UnknownNameError: no such segment.
        """
        i = self.position_of(segment_id)
        reasons, shares = self.told([i])[0]
        return Explanation(
            segment_id=str(self.segment_id[i]),
            environment=self.name_of(i),
            probabilities={
                e.name: float(p)
                for e, p in zip(self.environments, self.probability[i], strict=True)
                if self.label[i] >= 0
            },
            reasons=reasons,
            chain=self.zoning.chain(self.probability[i], shares),
        )

    def tell(self, segment_id: str, *, against: str | None = None, limit: int = 6) -> str:
        """The explanation of a segment in words.

        Args:
            segment_id: the segment.
            against: the environment to compare with; None takes the one that comes second.
            limit: how many kinds of landmarks to name.

        Raises:
            UnknownNameError: no such segment.
            InputError: it is to be compared with what it is.
        """
        from symboslam.engine.account import account_of
        from symboslam.engine.wording import text_of

        told = self.explain(segment_id)
        return text_of(
            account_of(told, self.knowledge.find_indication, against=against, limit=limit)
        )

    def shares(self) -> dict[str | None, float]:
        """Environment name (None = unknown) -> share of the map's area, in scheme order."""
        area = shapely.area(self.geometry)
        names = [*(e.name for e in self.environments), None]
        total = np.bincount(self.label % len(names), area, len(names))
        return {n: float(a / area.sum()) for n, a in zip(names, total, strict=True)}

    def __repr__(self) -> str:
        parts = ", ".join(f"{n or 'unknown'} {p:.0%}" for n, p in self.shares().items() if p)
        return f"EnvironmentMap({len(self)} segments from {len(self.landmarks)} landmarks: {parts})"

    def _repr_html_(self) -> str:
        """A table of the environments for notebooks."""
        colours = {e.name: e.colour for e in self.environments}
        rows = "".join(
            f"<tr><td style='background:{html.escape(colours.get(str(n), '#ddd'))}'>&emsp;</td>"
            f"<td>{html.escape(n or 'unknown')}</td><td>{p:.1%}</td></tr>"
            for n, p in self.shares().items()
        )
        return f"<table><caption>{html.escape(repr(self))}</caption>{rows}</table>"
