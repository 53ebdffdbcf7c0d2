"""What the text formats say of a map: rounded numbers, outside coordinates, names and lineage.

All formats take their values from here, so that they agree digit by digit. Probabilities and
contributions are whole millionths: a row of probabilities adds up to exactly 1, and the
contributions to an environment to exactly its probability, also after rounding.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine.chain import Shares
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.explanation import Reason
from symboslam.reasoning.knowledge import Feature

MILLION = 1_000_000
OTHER = "other"
"""Label of the reason that holds what all the reasons that are not listed add."""
BLOCK = 5_000
"""Segments that are prepared at a time."""


@dataclass(frozen=True)
class Part:
    """A reason in whole millionths.

    Attributes:
        feature: name of the feature; None for the rest of the reasons.
        label: words for people.
        count: landmarks that had a say.
        shares: environment name -> millionths of P(e); zeros may be missing.
    """

    feature: str | None
    label: str
    count: int
    shares: dict[str, int]


@dataclass(frozen=True)
class ChainPart:
    """A chain in whole millionths; every level adds up exactly.

    Attributes:
        groups: coarser area -> millionths, which add up to a million.
        zones: environment name -> zone name -> millionths, which add up to those of the
            environment; None where its zones are not told apart. Zeros are left out.
    """

    groups: dict[str, int]
    zones: dict[str, dict[str, int] | None]


@dataclass(frozen=True)
class Block:
    """Some segments (s of them), ready to be written.

    Attributes:
        geometry: (s,) polygons in outside coordinates, rounded, outer rings counter-clockwise.
        segment_id: s texts.
        environment: s positions in the map's environments; -1 = unknown.
        probability: (s, K) whole millionths; rows add up to a million, or to 0 where unknown.
        landmark_count: s numbers.
        depth: s numbers.
        parts: the reasons of each segment; None if none are wanted.
        chains: the chain of each segment, None where it is unknown or in no group or zone; None if
            no reasons are wanted, for zones are made from them.
    """

    geometry: NDArray[Any]
    segment_id: list[str]
    environment: list[int]
    probability: NDArray[np.int64]
    landmark_count: list[int]
    depth: list[int]
    parts: list[list[Part]] | None
    chains: list[ChainPart | None] | None


class Content:
    """A map's content, taken block by block.

    Args:
        environment_map: the map.
        reasons: how many reasons a segment gets, the strongest first; 0 = none.

    Attributes:
        mentioned: name -> label of the features that occurred in the reasons so far.
    """

    def __init__(self, environment_map: EnvironmentMap, reasons: int = 0) -> None:
        self.map, self._reasons = environment_map, reasons
        self.mentioned: dict[str, str] = {}

    def blocks(self) -> Iterator[Block]:
        """All segments in the map's order."""
        m = self.map
        for start in range(0, len(m), BLOCK):
            part = slice(start, start + BLOCK)
            probability = millionths(m.probability[part])
            probability[m.label[part] < 0] = 0
            parts, chains = self._told(start, probability) if self._reasons else (None, None)
            yield Block(
                geometry=self.outside(m.geometry[part]),
                segment_id=[str(name) for name in m.segment_id[part]],
                environment=m.label[part].tolist(),
                probability=probability,
                landmark_count=m.landmark_count[part].tolist(),
                depth=m.depth[part].tolist(),
                parts=parts,
                chains=chains,
            )

    def _told(
        self, start: int, probability: NDArray[np.int64]
    ) -> tuple[list[list[Part]], list[ChainPart | None]]:
        """The reasons and chains of the segments from ``start`` on, as many as there are rows."""
        found = self.map.told(range(start, start + len(probability)))
        names = self.environment_names
        shown: list[list[Part]] = []
        chains: list[ChainPart | None] = []
        for (reasons, shares), row in zip(found, probability.tolist(), strict=True):
            chances = dict(zip(names, row, strict=True))
            parts = rounded(reasons, chances, self._reasons)
            self.mentioned.update((p.feature, p.label) for p in parts if p.feature is not None)
            shown.append(parts)
            chains.append(self._chain(chances, shares))
        return shown, chains

    def _chain(self, chances: dict[str, int], shares: Shares) -> ChainPart | None:
        groups = self.map.zoning.groups(chances)
        if not self.map.zoning.tells_more(groups, shares):
            return None
        zones: dict[str, dict[str, int] | None] = {}
        for name, found in shares.items():
            if chances[name]:
                zones[name] = None if found is None else divided(chances[name], found)
        return ChainPart(groups, zones)

    @cached_property
    def environment_names(self) -> list[str]:
        """Names of the K environments."""
        return [e.name for e in self.map.environments]

    @cached_property
    def decimals(self) -> int:
        """Decimals of a coordinate: centimetres, or 1/100000 of the map if that is finer."""
        west, south, east, north = self.map.landmarks.bbox
        size = max(east - west, north - south)
        fine = 5 - math.floor(math.log10(size)) if size > 0 else 0
        return min(max(fine + 5, 7) if self.map.landmarks.frame.geographic else max(fine, 3), 15)

    def outside(self, geometry: NDArray[Any]) -> NDArray[Any]:
        """Geometries in metres -> in the input's coordinates; all corners in one call.

        Where rounding makes a polygon touch or cross itself, it is mended.
        """
        frame = self.map.landmarks.frame
        exact = shapely.transform(geometry, frame.from_metres, interleaved=False)
        found = shapely.transform(exact, self._round)
        jagged = np.flatnonzero(shapely.get_num_coordinates(found) > 5)
        bad = jagged[~shapely.is_valid(found[jagged])]
        if len(bad):
            mended = shapely.make_valid(found[bad], method="structure", keep_collapsed=False)
            found[bad] = np.where(shapely.is_empty(mended), exact[bad], mended)
        return np.asarray(shapely.orient_polygons(found))

    def _round(self, corners: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.round(corners, self.decimals) + 0.0  # never -0

    @cached_property
    def bbox(self) -> tuple[float, float, float, float]:
        """(min x, min y, max x, max y) of the area in the input's coordinates."""
        side = shapely.segmentize(shapely.box(*self.map.landmarks.bbox), self._edge)
        west, south, east, north = shapely.bounds(self.outside(np.array([side])))[0].tolist()
        return west, south, east, north

    @cached_property
    def _edge(self) -> float:
        """Longest straight piece of the area's border in metres: borders bend on a globe."""
        west, south, east, north = self.map.landmarks.bbox
        return max(east - west, north - south, 1e-9) / 16

    def environments(self) -> dict[str, dict[str, str]]:
        """Environment name -> what a reader of the file needs to know of it."""
        return {
            e.name: {
                "iri": e.iri,
                "label": e.label,
                "definition": e.definition,
                "colour": e.colour,
            }
            for e in self.map.environments
        }

    def levels(self) -> dict[str, dict[str, Any]]:
        """The groups above and the zones below the map's environments, if chains are told."""
        if not self._reasons:
            return {}
        knowledge, names = self.map.knowledge, set(self.environment_names)
        found: dict[str, dict[str, Any]] = {
            g.name: {
                "iri": g.iri,
                "label": g.label,
                "definition": g.definition,
                "members": [name for name in g.members if name in names],
            }
            for g in knowledge.groups
            if names & set(g.members)
        }
        if knowledge.zones is not None:
            for environment in self.map.environments:
                if environment.name in knowledge.zones.schemes:
                    for zone in knowledge.zones.scheme(environment.name):
                        found[zone.name] = {
                            "iri": zone.iri,
                            "label": zone.label,
                            "definition": zone.definition,
                            "within": environment.name,
                        }
        return found

    @cached_property
    def _known(self) -> dict[str, Feature]:
        return {f.name: f for f in self.map.knowledge.features}

    def features(self) -> dict[str, dict[str, Any]]:
        """The features mentioned so far: IRI, label and what they indicate, why and how much."""
        used: dict[str, dict[str, Any]] = {
            name: {"iri": self._known[name].iri, "label": label, "indications": {}}
            for name, label in sorted(self.mentioned.items())
            if name in self._known
        }
        names = set(self.environment_names)
        for i in self.map.knowledge.indications:
            if i.feature in used and i.environment in names:
                used[i.feature]["indications"][i.environment] = {
                    "strength": i.strength,
                    "steps": i.steps,
                    "path": list(i.path),
                    "reason": i.reason,
                    "source": i.source,
                    "source_iri": i.source_iri,
                    "stands": i.stands,
                }
        return used

    def report(self) -> dict[str, Any]:
        """What the reader took and left."""
        report = self.map.landmarks.report
        return {
            "read": report.read,
            "unknown": dict(report.unknown.most_common()),
            "outside": report.outside,
            "duplicates": report.duplicates,
            "notes": list(report.notes),
            "attribution": report.attribution,
        }


def source_name(m: EnvironmentMap) -> str:
    """The file that the landmarks are from, without its folders: those are nobody else's."""
    return _base_name(m.landmarks.report.source)


def ontology_name(m: EnvironmentMap) -> str:
    """The ontology's files without their folders, or ``bundled``."""
    return ", ".join(map(_base_name, m.knowledge.source.split(", ")))


def _base_name(path: str) -> str:
    return re.split(r"[\\/]", path)[-1]


def millionths(probability: NDArray[np.float64]) -> NDArray[np.int64]:
    """Rows that sum to 1 -> whole millionths that sum to a million (largest remainders go up).

    Args:
        probability: (s, K); rows sum to 1, or are all 0.

    Returns:
        (s, K) whole numbers; rows of zeros stay zeros.
    """
    exact = np.asarray(probability, np.float64) * MILLION
    whole = np.floor(exact).astype(np.int64)
    missing = np.where(whole.any(1), MILLION - whole.sum(1), 0)
    rank = np.argsort(np.argsort(whole - exact, axis=1, kind="stable"), axis=1, kind="stable")
    return np.asarray(whole + (rank < missing[:, None]))


def divided(whole: int, shares: Mapping[str, float]) -> dict[str, int]:
    """A whole number by shares that sum to 1, largest remainders up; zeros are left out.

    >>> divided(10, {"RZ1": 0.25, "RZ2": 0.75, "RZ3": 0.0})
    {'RZ1': 3, 'RZ2': 7}
    """
    exact = {name: whole * share for name, share in shares.items() if share}
    found = {name: math.floor(value) for name, value in exact.items()}
    order = sorted(exact, key=lambda name: found[name] - exact[name])
    for name in order[: whole - sum(found.values())]:
        found[name] += 1
    return {name: n for name, n in found.items() if n}


def rounded(reasons: tuple[Reason, ...], probability: dict[str, int], limit: int) -> list[Part]:
    """Reasons -> whole millionths that add up to the probabilities.

    Args:
        reasons: all reasons of a segment, the strongest first.
        probability: environment name -> millionths.
        limit: how many to list; what the others add becomes one part without a feature.

    Returns:
        Parts, the rest last. Reasons below half a millionth everywhere are not listed.
    """
    left = dict(probability)
    parts = []
    for reason in reasons[:limit]:
        shares = {}
        for environment, share in reason.contribution.items():
            n = round(share * MILLION)
            if n:
                shares[environment] = n
                left[environment] -= n
        if shares:
            parts.append(Part(reason.feature, reason.label, reason.count, shares))
    left = {e: n for e, n in left.items() if n}
    if left and len(reasons) > limit:
        parts.append(Part(None, OTHER, sum(r.count for r in reasons[limit:]), left))
    elif left and parts and max(map(abs, left.values())) <= len(reasons):  # only rounding
        for environment, n in left.items():
            most = max(parts, key=lambda part: abs(part.shares.get(environment, 0)))
            most.shares[environment] = most.shares.get(environment, 0) + n
    return parts
