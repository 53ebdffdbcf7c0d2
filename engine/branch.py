"""BranchSegmentation: fragments that grow from landmark to landmark become a map (design 6)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam.engine.boundaries import Parting, settle
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.fragments import FragmentEvidence, Fragments
from symboslam.engine.growth import crowding, densest, grow
from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.merging import alike, merge_alike, merged, neighbours
from symboslam.engine.registry import Progress, Segmentation
from symboslam.engine.settings import Settings
from symboslam.engine.territories import rest_of, territories
from symboslam.engine.weights import weights_of
from symboslam.errors import InputError
from symboslam.reasoning.knowledge import Knowledge

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
SPACINGS = 1.5
"""Reach, in distances to the fifth neighbour of a landmark in the middle of all."""


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
        xy = landmarks.xy
        weight = weights_of(landmarks, knowledge, scheme, settings)
        weight[weight < settings.relevance * weight.max(1, keepdims=True, initial=0)] = 0
        evidence = FragmentEvidence(xy, weight, settings.a)
        reach = settings.reach or reach_of(xy, knowledge.bandwidth(scheme))
        config = self.configuration(settings, scheme or next(iter(knowledge.schemes)))
        config |= {"reach": reach}
        fragment, ground = np.zeros(0, np.int64), np.zeros(0, object)
        if len(landmarks):
            # 1. Fragments grow from the seed position until all landmarks are placed.
            start = self._start(landmarks, settings)
            grown = grow(
                xy, weight, settings.a, start, settings.momentum, part_of(tell, "growing", 0.1, 0.4)
            )
            fragment = np.empty(len(xy), np.int64)
            for i, members in enumerate(grown):
                fragment[members] = i
            # 2. What stands at one place belongs together; neighbours of the same type merge.
            tell("merging", 0.4)
            places, place = np.unique(xy, axis=0, return_inverse=True)
            fragment = _numbered(_owners(fragment, place)[place])
            home = _owners(fragment, place)
            label = _labels(evidence.probability(Fragments.of(fragment, xy)))
            home = merged(home, alike(neighbours(places, reach), home, label))
            # 3. Where their pair lines cross, landmarks are traded.
            home = settle(places, home, reach, part_of(tell, "parting", 0.5, 0.7))
            # 4. What has come to be next to its like merges, too, where no lines cross then; each
            #    time there are fewer fragments.
            home = _numbered(home)

            def label_of(fragment: Ints, numbers: Ints) -> Ints:
                some = Fragments.some(fragment[place], xy, numbers)
                return _labels(evidence.probability(some))

            label = label_of(home, np.arange(home.max() + 1))
            parting = Parting.of(places, home, reach)
            home = merge_alike(places, parting, label, reach, label_of)
            fragment = _numbered(home[place])
            home[place] = fragment
            # 5. The ground near to a fragment's landmarks is its segment.
            tell("drawing segments", 0.8)
            ground = territories(places, home, reach, landmarks.bbox, landmarks.surveyed)
        # 6. All other ground is one more segment, of which nothing is known.
        number, ground, regions = _with_the_rest(fragment, ground, landmarks)
        probability = evidence.probability(regions)
        probability[number == 0] = 0
        return EnvironmentMap(
            environments=knowledge.scheme(config["scheme"]),
            geometry=ground,
            label=_labels(probability).astype(np.int16),
            probability=probability,
            segment_id=np.array([f"b-{i}" for i in number.tolist()], dtype=np.str_),
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
        first, second = settings.seed_position
        if landmarks.frame.geographic and (abs(first) > 180 or abs(second) > 90):
            raise InputError(
                f"seed_position {first:g}, {second:g} is out of range for longitude and latitude"
            )
        x, y = landmarks.frame.to_metres([first], [second])
        return float(x[0]), float(y[0])


def part_of(tell: Progress, stage: str, first: float, last: float) -> Callable[[float], None]:
    """Tell the progress of a stage that lies between two shares of the whole."""
    return lambda share: tell(stage, first + (last - first) * share)


def reach_of(xy: Floats, bandwidth: float | None) -> float:
    """Reach in metres, in three digits: from how far apart the landmarks stand.

    One and a half of the median distance to the fifth neighbour, at least two of the ontology's
    bandwidths (1 m where both are 0): so a landmark in the middle of all is not alone.
    """
    least = 2 * (bandwidth or 0.0)
    spacing = float(np.median(crowding(xy))) if len(xy) > 1 else 0.0
    return float(f"{max(SPACINGS * spacing, least):.3g}") or 1.0


def _labels(probability: Floats) -> Ints:
    """(m,) the most probable environment of each fragment; -1 where nothing speaks for any."""
    return np.where(probability.any(1), probability.argmax(1), -1)


def _owners(fragment: Ints, place: Ints) -> Ints:
    """(p,) which fragment has most of the landmarks at each place, ties by number."""
    order = np.lexsort((fragment, place))
    pairs, counts = np.unique(
        np.column_stack([place[order], fragment[order]]), axis=0, return_counts=True
    )
    best = pairs[np.lexsort((pairs[:, 1], -counts, pairs[:, 0]))]
    first = np.flatnonzero(np.diff(best[:, 0], prepend=-1))
    return np.asarray(best[first, 1])


def _with_the_rest(
    fragment: Ints, ground: NDArray[Any], landmarks: LandmarkMap
) -> tuple[Ints, NDArray[Any], Fragments]:
    """Number, ground and landmarks of each segment.

    Number 0 is the ground that is no fragment's, if there is any. It also holds the landmarks of
    fragments that have no ground, because nobody is said to have looked where they are.
    """
    there = ~shapely.is_empty(ground)
    regions = Fragments.of(fragment, landmarks.xy)
    number = np.flatnonzero(there) + 1
    rest = rest_of(landmarks.bbox, ground[there])
    if shapely.is_empty(rest):
        return number, ground[there], regions.take(there)
    lost = np.flatnonzero(~there[fragment])
    kept = regions.take(there)
    regions = Fragments((lost, *kept.members), np.append(0.0, kept.diagonal))
    return np.append(0, number), np.append(rest, ground[there]), regions


def _numbered(fragment: Ints) -> Ints:
    """(n,) fragments numbered from 0 in the order of their first landmarks."""
    _, first, inverse = np.unique(fragment, return_index=True, return_inverse=True)
    rank = np.empty(len(first), np.int64)
    rank[np.argsort(first)] = np.arange(len(first))
    return np.asarray(rank[inverse])
