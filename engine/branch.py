"""BranchSegmentation: fragments that grow from landmark to landmark become a map (design 6)."""

from __future__ import annotations

from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from symboslam.engine._base import normalised
from symboslam.engine.boundaries import settle
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.fragments import FragmentEvidence, Fragments
from symboslam.engine.growth import densest, grow
from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.registry import Progress, Segmentation
from symboslam.engine.settings import Settings
from symboslam.engine.territories import territories
from symboslam.engine.triangulation import delaunay_edges
from symboslam.engine.weights import weights_of
from symboslam.reasoning.knowledge import Knowledge

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
SPACINGS = 2.0
"""Reach, in distances to the fifth neighbour of a landmark in the middle of all."""
CROWD = 5


class BranchSegmentation(Segmentation):
    """The paper's N-nearest-neighbour segmentation, with boundaries between its fragments."""

    name: ClassVar[str] = "branch"
    unused: ClassVar[frozenset[str]] = frozenset(
        {"evidence", "dissimilarity", "absence", "bandwidth", "cells", "threshold",
         "min_landmarks", "empty"}
    )  # fmt: skip

    def cut(
        self,
        landmarks: LandmarkMap,
        knowledge: Knowledge,
        scheme: str | None,
        settings: Settings,
        tell: Progress,
    ) -> EnvironmentMap:
        """Cut a map into fragments of landmarks and the ground around them."""
        xy, weight = landmarks.xy, weights_of(landmarks, knowledge, scheme, settings)
        evidence = FragmentEvidence(xy, weight, settings.a)
        reach = settings.reach or reach_of(xy, knowledge.bandwidth(scheme))
        config = self.configuration(settings, scheme or next(iter(knowledge.schemes)))
        config |= {"reach": reach}
        if not len(landmarks):
            fragment, ground = np.zeros(0, np.int64), np.zeros(0, object)
        else:
            # 1. Fragments grow from the seed position until all landmarks are placed.
            tell("growing fragments", 0.1)
            start = self._start(landmarks, settings)
            grown = grow(xy, weight, settings.a, start, settings.momentum)
            fragment = np.empty(len(xy), np.int64)
            for number, members in enumerate(grown):
                fragment[members] = number
            # 2. What stands at one place belongs together; neighbours of the same type merge.
            places, place = np.unique(xy, axis=0, return_inverse=True)
            fragment = _numbered(_owners(fragment, place)[place])
            tell("merging fragments", 0.4)
            label = _labels(evidence.of(Fragments.of(fragment, xy)))
            home = _merged(places, _owners(fragment, place), label, reach)
            # 3. Where their pair lines cross, landmarks are traded.
            tell("parting fragments", 0.5)
            home = settle(places, home, reach)
            # 4. The ground near to a fragment's landmarks is its segment.
            tell("drawing segments", 0.8)
            fragment = _numbered(home[place])
            home[place] = fragment
            ground = territories(places, home, reach, landmarks.bbox, landmarks.surveyed)
        regions = Fragments.of(fragment, xy)
        probability = normalised(evidence.of(regions))
        return EnvironmentMap(
            environments=knowledge.scheme(config["scheme"]),
            geometry=ground,
            label=np.where(probability.any(1), probability.argmax(1), -1).astype(np.int16),
            probability=probability,
            segment_id=np.array([f"b-{i + 1}" for i in range(len(regions))], dtype=np.str_),
            landmark_count=np.array([len(m) for m in regions.members], np.int64),
            depth=np.zeros(len(regions), np.int16),
            landmarks=landmarks,
            knowledge=knowledge,
            config=config,
            evidence=evidence,
            regions=regions,
        )

    def _start(self, landmarks: LandmarkMap, settings: Settings) -> tuple[float, float]:
        """Where the first fragment begins, in metres."""
        if settings.seed_position is None:
            return densest(landmarks.xy)
        x, y = landmarks.frame.to_metres(*([v] for v in settings.seed_position))
        return float(x[0]), float(y[0])


def reach_of(xy: Floats, bandwidth: float | None) -> float:
    """Reach in metres: from how far apart the landmarks stand, at least two bandwidths."""
    from scipy.spatial import cKDTree

    least = 2 * (bandwidth or 0.0)
    if len(xy) < 2:
        return least or 1.0
    rank = min(CROWD + 1, len(xy))
    spacing = float(np.median(cKDTree(xy).query(xy, [rank])[0]))
    return float(f"{max(SPACINGS * spacing, least):.3g}") or 1.0


def _labels(evidence: Floats) -> Ints:
    """(m,) the strongest environment of each fragment; -1 where nothing speaks for any."""
    return np.where(evidence.any(1), evidence.argmax(1), -1)


def _owners(fragment: Ints, place: Ints) -> Ints:
    """(p,) which fragment has most of the landmarks at each place, ties by number."""
    order = np.lexsort((fragment, place))
    pairs, counts = np.unique(
        np.column_stack([place[order], fragment[order]]), axis=0, return_counts=True
    )
    best = pairs[np.lexsort((pairs[:, 1], -counts, pairs[:, 0]))]
    first = np.flatnonzero(np.diff(best[:, 0], prepend=-1))
    return np.asarray(best[first, 1])


def _merged(places: Floats, home: Ints, label: Ints, reach: float) -> Ints:
    """(p,) fragments of one environment whose landmarks stand next to each other become one."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    one, two = delaunay_edges(places).T
    near = np.hypot(*(places[one] - places[two]).T) <= reach
    one, two = home[one[near]], home[two[near]]
    same = (label[one] == label[two]) & (label[one] >= 0)
    m = len(label)
    joined = coo_array((np.ones(int(same.sum())), (one[same], two[same])), shape=(m, m))
    return np.asarray(connected_components(joined, directed=False)[1][home], np.int64)


def _numbered(fragment: Ints) -> Ints:
    """(n,) fragments numbered from 0 in the order of their first landmarks."""
    _, first, inverse = np.unique(fragment, return_index=True, return_inverse=True)
    rank = np.empty(len(first), np.int64)
    rank[np.argsort(first)] = np.arange(len(first))
    return np.asarray(rank[inverse])
