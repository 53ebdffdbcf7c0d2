"""Local evidence: what one segment's evidence would be with some landmarks fewer or more.

Exact, and from the landmarks around the segment alone: sets of removals are weighed many at a
time, without making the map's evidence anew. The segment's outline, bandwidth and absence stay.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import fields
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from symboslam.engine._base import Evidence
from symboslam.engine.evidence import PairEvidence
from symboslam.engine.field import CLOSE, FieldEvidence
from symboslam.engine.fragments import FragmentEvidence, Fragments
from symboslam.engine.grid import Cells, Grid
from symboslam.engine.settings import Settings
from symboslam.engine.weights import proximity_of
from symboslam.errors import InputError

if TYPE_CHECKING:
    from symboslam.engine.environment_map import EnvironmentMap

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Sets = NDArray[np.bool_]
"""(b, q) which of q landmarks each of b sets has."""
AT_ONCE = 500_000
"""Numbers in the largest array that a block of sets may need."""


class LocalEvidence(ABC):
    """The evidence for one segment and the m landmarks that have a say in it.

    Args:
        environment_map: the map.
        position: of the segment.

    Attributes:
        landmark: (m,) their positions in the map.
        own: (m, K) what each adds to P~ by itself.
        pairs: (m, K) what each adds, or loses, through others.
        ground: (K,) what ground without landmarks adds.
        proximity: (F, K) SP(e, f) I(f) of all features.
    """

    def __init__(self, environment_map: EnvironmentMap, position: int) -> None:
        self._map = environment_map
        self._region = environment_map.regions.take(np.array([position]))
        parts = next(environment_map.contributions([position]))
        self.landmark, self.own, self.pairs, self.ground = (
            parts.landmark, parts.own, parts.pairs, parts.ground,
        )  # fmt: skip
        config = environment_map.config
        used = {f.name: config[f.name] for f in fields(Settings) if f.name in config}
        self._settings = Settings(**used)
        self.proximity = self._proximity(
            proximity_of(environment_map.knowledge, config["scheme"], self._settings)
        )
        self._xy, self._weight = (
            environment_map.landmarks.xy[self.landmark],
            self._weights(self.landmark),
        )

    def _proximity(self, proximity: Floats) -> Floats:
        """What counts of (F, K) proximities; all, unless a segmentation leaves some out."""
        return proximity

    def _weights(self, landmarks: Ints) -> Floats:
        """(q, K) SP(e, x) I(x) f_x of landmarks of the map."""
        marks = self._map.landmarks
        return self.proximity[marks.feature[landmarks]] * marks.confidence[landmarks, None]

    @property
    def total(self) -> Floats:
        """(K,) the evidence P~ as it is."""
        return np.asarray((self.own + self.pairs).sum(0) + self.ground)

    def without(self, chosen: Ints, sets: Sets) -> Floats:
        """(b, K) the evidence P~ without each of some sets of landmarks.

        Args:
            chosen: (q,) the landmarks that sets are made of, as rows of ``landmark``.
            sets: which of them each set takes away.
        """
        step = max(AT_ONCE // max(len(self.landmark), 1), 1)
        blocks = [sets[start : start + step] for start in range(0, len(sets), step)]
        found = [self._without(chosen, block) for block in blocks]
        return np.concatenate(found) if found else np.zeros((0, len(self.ground)))

    @abstractmethod
    def _without(self, chosen: Ints, sets: Sets) -> Floats:
        """As ``without``, for sets that are few enough to be weighed at once."""

    @abstractmethod
    def plus(self, feature: int, place: Floats, counts: Ints) -> Floats:
        """(b, K) the evidence P~ with b numbers of landmarks of a feature more, sure ones.

        Args:
            feature: position in ``knowledge.features``.
            place: (2,) where all of them stand, in metres.
            counts: (b,) how many.
        """

    @abstractmethod
    def between(self, rows: Ints, e: int) -> Floats:
        """(q, q) what ``pairs`` of (q,) landmarks for environment e are through each of them."""

    def _kept(self, chosen: Ints, sets: Sets) -> Floats:
        """(b, m) 1 for the landmarks that a set leaves."""
        kept = np.ones((len(sets), len(self.landmark)))
        kept[:, chosen] -= sets
        return kept


class LocalField(LocalEvidence):
    """Evidence as a density: own parts stay, and what neighbours deny changes (field.py)."""

    def __init__(self, environment_map: EnvironmentMap, position: int) -> None:
        super().__init__(environment_map, position)
        evidence = environment_map.evidence
        assert isinstance(evidence, FieldEvidence)
        assert isinstance(self._region, Cells)
        self._cell, self._field, self._radius = self._region, evidence, CLOSE * evidence.bandwidth
        self._deny = self._settings.dissimilarity
        self._around = np.maximum(self._evidence_around(self._xy) - self._weight, 0)

    def _evidence_around(self, xy: Floats) -> Floats:
        """(q, K) the evidence of the map's landmarks close to some places."""
        from scipy.spatial import KDTree

        if not len(xy):
            return np.zeros((0, len(self.ground)))
        marks = self._map.landmarks.xy
        low, high = xy.min(0) - self._radius, xy.max(0) + self._radius
        near = np.flatnonzero(((marks >= low) & (marks <= high)).all(1))
        weight, found = self._weights(near), np.zeros((len(xy), len(self.ground)))
        pairs = KDTree(xy).sparse_distance_matrix(
            KDTree(marks[near]), self._radius, output_type="ndarray"
        )
        closeness = 1 - pairs["v"] / self._radius
        for e in range(found.shape[1]):
            amount = closeness * weight[pairs["j"], e]
            found[:, e] = np.bincount(pairs["i"], amount, minlength=len(xy))
        return found

    def _closeness(self, xy: Floats) -> Floats:
        """(q, m) how far each landmark counts at each of some places, from 1 down to 0."""
        from scipy.spatial.distance import cdist

        return np.asarray(np.maximum(1 - cdist(xy, self._xy) / self._radius, 0))

    def _denied(self, around: Floats) -> Floats:
        """D(e) where the evidence around is this (..., K); see ``field.dissimilarity``."""
        total = around.sum(-1, keepdims=True)
        zeros = np.zeros_like(around)
        return np.asarray(np.divide(total - around, total, out=zeros, where=total > 1e-12))

    def _without(self, chosen: Ints, sets: Sets) -> Floats:
        close, kept = self._closeness(self._xy[chosen]), self._kept(chosen, sets)
        around = np.empty((len(sets), len(self.landmark), len(self.ground)))
        for e in range(len(self.ground)):
            gone = (sets * self._weight[chosen, e]) @ close
            around[:, :, e] = np.maximum(self._around[:, e] - gone, 0)
        left = self.own * (1 - self._deny * self._denied(around))
        return np.asarray((kept[:, :, None] * left).sum(1) + self.ground)

    def plus(self, feature: int, place: Floats, counts: Ints) -> Floats:
        """See the base class."""
        weight, number = self.proximity[feature], counts[:, None]
        site = self._map.knowledge.features[feature].site
        alone = weight * self._field.of_one(self._cell, place, site)
        close = self._closeness(place[None])[0][:, None]
        around = self._around + counts[:, None, None] * (close * weight)
        left = self.own * (1 - self._deny * self._denied(around))
        there = self._evidence_around(place[None]) + (number - 1) * weight
        added = number * alone * (1 - self._deny * self._denied(there))
        return np.asarray(left.sum(1) + added + self.ground)

    def between(self, rows: Ints, e: int) -> Floats:
        """See the base class: what each neighbour denies."""
        close = self._closeness(self._xy[rows])[:, rows]
        np.fill_diagonal(close, 0)
        weight, total = self._weight[rows], self._around[rows].sum(1)
        scale = np.divide(self.own[rows, e], total, out=np.zeros_like(total), where=total > 1e-12)
        away = weight.sum(1) - weight[:, e]  # (q,) what points elsewhere
        return np.asarray(-self._deny * scale[:, None] * close * away)


class LocalPairs(LocalEvidence):
    """The paper's C and share of inferences among the landmarks inside (evidence.py)."""

    def __init__(self, environment_map: EnvironmentMap, position: int) -> None:
        super().__init__(environment_map, position)
        self._member = (self._weight > 0).astype(np.float64)
        self._size = self._member.sum(0)
        n = self._size * (self._size - 1)
        scale = self._settings.a * self._weight
        zeros = np.zeros_like(scale)
        self._near = np.divide(self.pairs * n, scale, out=zeros, where=scale > 0)
        self._diagonal = self._diagonal_in_metres()

    def _diagonal_in_metres(self) -> float:
        assert isinstance(self._region, Cells)
        grid = Grid(self._map.landmarks.bbox, self._settings.cells)
        west, south, east, north = grid.rectangles(self._region)
        return float(np.hypot(east - west, north - south)[0])

    def _similar(self, xy: Floats) -> Floats:
        """(q, m) 1 - d between some places and the landmarks."""
        from scipy.spatial.distance import cdist

        return np.asarray(np.maximum(1 - cdist(xy, self._xy) / self._diagonal, 0))

    def _evidence(self, c: Floats, size: Floats, z: Floats) -> Floats:
        """P~ from (b, K) sums of w times nearness, (b, K) sizes of S_e and (b, 1) z."""
        n, a, pairs = size * (size - 1), self._settings.a, z * (z - 1)
        first = np.divide(a * c, n, out=np.zeros_like(c), where=n > 0)
        second = np.divide((1 - a) * n, pairs, out=np.zeros_like(c), where=pairs > 0)
        return np.asarray(first + second)

    def _without(self, chosen: Ints, sets: Sets) -> Floats:
        similar, kept = self._similar(self._xy[chosen]), self._kept(chosen, sets)
        member, c = self._member[chosen], np.empty((len(sets), len(self.ground)))
        for e in range(len(self.ground)):
            near = self._near[:, e] - (sets * member[:, e]) @ similar
            c[:, e] = ((kept * near) @ self._weight[:, e]).ravel()
        size = self._size - sets @ member
        return self._evidence(c, size, len(self.landmark) - sets.sum(1, keepdims=True))

    def plus(self, feature: int, place: Floats, counts: Ints) -> Floats:
        """See the base class."""
        weight, number = self.proximity[feature], counts[:, None].astype(np.float64)
        member = (weight > 0).astype(np.float64)
        similar = self._similar(place[None])[0]
        before = (self._weight * self._near).sum(0)
        old = before + number * member * (similar @ self._weight)
        new = number * weight * (similar @ self._member + (number - 1) * member)
        return self._evidence(old + new, self._size + number * member, len(self.landmark) + number)

    def between(self, rows: Ints, e: int) -> Floats:
        """See the base class: each pair's part of a C, half of it for each of the two."""
        from scipy.spatial.distance import cdist

        similar = np.maximum(1 - cdist(self._xy[rows], self._xy[rows]) / self._diagonal, 0)
        np.fill_diagonal(similar, 0)
        n = self._size[e] * (self._size[e] - 1)
        both = self._weight[rows, e, None] * self._member[rows, e]
        return np.asarray(similar * both * (self._settings.a / n if n else 0.0))


class LocalFragment(LocalPairs):
    """The same in a fragment, which keeps its diagonal; one landmark alone counts by itself."""

    def _proximity(self, proximity: Floats) -> Floats:
        strongest = proximity.max(1, keepdims=True, initial=0)
        return np.where(proximity < self._settings.relevance * strongest, 0, proximity)

    def _diagonal_in_metres(self) -> float:
        assert isinstance(self._region, Fragments)
        return float(self._region.diagonal[0]) or 1.0  # all in one place: no distance counts

    def _without(self, chosen: Ints, sets: Sets) -> Floats:
        found, kept = super()._without(chosen, sets), self._kept(chosen, sets)
        alone = kept.sum(1) == 1
        found[alone] = kept[alone] @ self._weight
        return found

    def plus(self, feature: int, place: Floats, counts: Ints) -> Floats:
        """See the base class."""
        found = super().plus(feature, place, counts)
        found[len(self.landmark) + counts == 1] = self.proximity[feature]
        return found


_KINDS: dict[type[Evidence[Any]], type[LocalEvidence]] = {
    FieldEvidence: LocalField,
    FragmentEvidence: LocalFragment,
    PairEvidence: LocalPairs,
}


def local_evidence(environment_map: EnvironmentMap, position: int) -> LocalEvidence:
    """The evidence around one segment.

    Raises:
        InputError: the map's evidence is of a kind that is not known here.
    """
    kind = _KINDS.get(type(environment_map.evidence))
    if kind is None:
        raise InputError(
            "what this map's evidence would be with other landmarks is not known: it is neither "
            "made from pairs nor a density"
        )
    return kind(environment_map, position)
