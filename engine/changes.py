"""Counterfactual: a change of landmarks that gives a segment another type; how it is applied."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.landmarks import LandmarkMap

MOST = 30
"""Landmarks that a counterfactual may take away or add."""


@dataclass(frozen=True)
class Counterfactual:
    """A change of landmarks after which a segment has another type.

    Attributes:
        environment: the type that it has then; None = unknown, nothing says anything.
        probability: P of that type then; 0 if unknown.
        removed: positions of the landmarks that are taken away.
        added: position in ``knowledge.features`` of the landmarks that are added; None if none.
        count: how many are added.
        place: where they all stand, in metres; the middle of the segment.
        minimal: whether no smaller change of the same kind does it, which was proved by trying.
        tried: changes that were weighed in the search.
        anew: whether this is what the changed landmarks give if they are classified anew; if not,
            it is what the segment is if its outline stays as it is.
    """

    environment: str | None
    probability: float
    removed: tuple[int, ...] = ()
    added: int | None = None
    count: int = 0
    place: tuple[float, float] = (0.0, 0.0)
    minimal: bool = False
    tried: int = 0
    anew: bool = True


def applied(environment_map: EnvironmentMap, change: Counterfactual) -> LandmarkMap:
    """The landmarks of a map after a change, to be classified with the map's ``config``."""
    marks = environment_map.landmarks
    kept = marks.without(*change.removed) if change.removed else marks
    if change.added is None:
        return kept
    n, feature = change.count, environment_map.knowledge.features[change.added]
    return replace(
        kept,
        feature=np.append(kept.feature, np.full(n, change.added, np.int32)),
        x=np.append(kept.x, np.full(n, change.place[0])),
        y=np.append(kept.y, np.full(n, change.place[1])),
        confidence=np.append(kept.confidence, np.ones(n)),
        static=np.append(kept.static, np.full(n, feature.static)),
        id=np.append(kept.id, [f"added-{j + 1}" for j in range(n)]),
        time=None if kept.time is None else np.append(kept.time, [None] * n),
        agent=None if kept.agent is None else np.append(kept.agent, [None] * n),
    )
