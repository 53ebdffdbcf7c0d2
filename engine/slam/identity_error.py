"""Errors of landmarks by identity: which sighting was of what, by the truth.

The true landmark of a landmark of the map is that of most of its sightings. So this sees what
positions cannot tell: that two landmarks are one, or one is two.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.log import Ints, Mission
from symboslam.engine.slam.slam_map import SlamMap
from symboslam.errors import InputError

LEAST = 2
"""Sightings from which on a second true landmark in a landmark is a wrong merge ..."""
SHARE = 0.1
"""... if they are also this share of the landmark's sightings."""


@dataclass(frozen=True)
class IdentityScore:
    """What landmarks are of, by the truth.

    Attributes:
        true_of: (L,) the true landmark of each landmark of the map; None for one without sightings
            of anything known, and for dynamic ones.
        stands: true landmark -> position of the landmark that stands for it: of those whose true
            landmark it is, the one with most sightings of it.
        duplicates: landmarks whose true landmark another one stands for.
        wrong_merges: true landmarks besides the main one among a landmark's sightings, with at
            least two sightings and a tenth of the landmark's; summed over all landmarks.
        sightings: that were attached to a landmark, and whose identity is known.
        wrong_sightings: those of them that are not of the landmark's true landmark.
        missed: true landmarks that were seen and that no landmark stands for.
    """

    true_of: NDArray[np.object_]
    stands: Mapping[str, int]
    duplicates: int
    wrong_merges: int
    sightings: int
    wrong_sightings: int
    missed: tuple[str, ...]


def score_identities(slam_map: SlamMap, mission: Mission) -> IdentityScore:
    """Compare what sightings were attached to with what they were of.

    Sightings of robots and of dynamic classes, sightings without an identity ("" or None), and
    dynamic landmarks do not count.

    Args:
        slam_map: with ``landmark_of``.
        mission: with ``identity``.

    Raises:
        InputError: ``landmark_of`` or ``identity`` has not a value for each sighting.
    """
    landmark, name = _attached(slam_map, mission)
    dynamic = slam_map.landmarks.dynamic
    known = _landmarks(mission, name)
    use = landmark >= 0
    use[use] = ~dynamic[landmark[use]]
    names, identity = np.unique(name[use].astype(str), return_inverse=True)
    pairs, count = np.unique(np.column_stack([landmark[use], identity]), axis=0, return_counts=True)
    true_of = np.full(len(slam_map.landmarks), None, object)
    stands: dict[str, tuple[int, int]] = {}
    merges = wrong = 0
    borders = np.flatnonzero(np.diff(pairs[:, 0])) + 1
    for rows in np.split(np.arange(len(pairs)), borders) if len(pairs) else ():
        at, counts = int(pairs[rows[0], 0]), count[rows]
        main = int(counts.argmax())
        true = true_of[at] = str(names[pairs[rows[main], 1]])
        others = np.delete(counts, main)
        wrong += int(others.sum())
        merges += int(((others >= LEAST) & (others >= SHARE * counts.sum())).sum())
        if true not in stands or counts[main] > stands[true][0]:
            stands[true] = int(counts[main]), at
    return IdentityScore(
        true_of=true_of,
        stands={true: at for true, (_, at) in stands.items()},
        duplicates=sum(true is not None for true in true_of) - len(stands),
        wrong_merges=merges,
        sightings=int(use.sum()),
        wrong_sightings=wrong,
        missed=tuple(sorted(known - stands.keys())),
    )


def holders(slam_map: SlamMap, mission: Mission) -> dict[str, int]:
    """True landmark -> position of the landmark that holds most of its sightings.

    Unlike ``IdentityScore.stands``, a landmark that mixes several true ones may hold each of them:
    their errors then tell of the mistake. What counts as a sighting is as in `score_identities`.

    Raises:
        InputError: see `score_identities`.
    """
    landmark, name = _attached(slam_map, mission)
    use = landmark >= 0
    use[use] = ~slam_map.landmarks.dynamic[landmark[use]]
    names, identity = np.unique(name[use].astype(str), return_inverse=True)
    pairs, count = np.unique(np.column_stack([identity, landmark[use]]), axis=0, return_counts=True)
    best = {int(pairs[row, 0]): int(pairs[row, 1]) for row in np.argsort(count, kind="stable")}
    known = _landmarks(mission, name)
    return {str(names[of]): at for of, at in sorted(best.items()) if str(names[of]) in known}


def _attached(slam_map: SlamMap, mission: Mission) -> tuple[Ints, NDArray[np.object_]]:
    """Landmark (-1 for none) and identity of all sightings whose identity is known."""
    landmarks, names = [np.empty(0, np.int64)], [np.empty(0, object)]
    for robot in mission.robots:
        identity = mission.identity.get(robot.name)
        if identity is None:
            continue
        nowhere = np.full(len(robot.seen), -1)
        attached = np.asarray(slam_map.landmark_of.get(robot.name, nowhere))
        if not len(identity) == len(attached) == len(robot.seen):
            raise InputError(
                f"robot {robot.name}: {len(robot.seen)} sightings, but {len(attached)} landmarks "
                f"and {len(identity)} identities of them"
            )
        feature = robot.seen.feature
        use = (feature >= 0) & np.array([bool(i) for i in identity], bool)
        use[use] = ~mission.dynamic[feature[use]]
        landmarks.append(attached[use])
        names.append(np.asarray(identity)[use])
    return np.concatenate(landmarks).astype(np.int64), np.concatenate(names)


def _landmarks(mission: Mission, seen: NDArray[np.object_]) -> set[str]:
    """Names of the true landmarks that were seen: things that the truth has a place for.

    With a truth that has no landmarks, all that were seen as something static count.
    """
    names = {str(name) for name in seen}
    if mission.truth is None or not mission.truth.landmarks:
        return names
    return names & mission.truth.landmarks.keys()
