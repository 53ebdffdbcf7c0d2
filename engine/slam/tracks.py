"""Tracker: which sightings are of one thing, by odometry alone, while it stays good enough."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from symboslam.engine.slam.beliefs import ClassBeliefs
from symboslam.engine.slam.log import Floats
from symboslam.engine.slam.pose_graph import PoseGraph, Sighting

OFTEN = 4
"""A thing seen so many times is seen often."""
NEW = 0.2
"""Share of things in view that are seen for the first time."""


@dataclass
class Track:
    """Sightings of one thing.

    Attributes:
        number: of the track.
        evidence: (C,) summed log likelihoods of the classes.
        x, y: where it is, in the frame of the odometry.
        variance: square metres of that, in one direction, relative to key pose ``last``.
        first, last: numbers of the key poses of the first and the latest sighting.
        sightings: all of them.
        key: what names it beyond doubt.
        live: whether it can still get sightings.
    """

    number: int
    evidence: Floats
    x: float
    y: float
    variance: float
    first: int
    last: int
    sightings: list[Sighting] = field(default_factory=list)
    key: str = ""
    live: bool = True

    @property
    def xy(self) -> tuple[float, float]:
        """Where it is, in the frame of the odometry."""
        return self.x, self.y


class Tracker:
    """Gives each sighting a track.

    Args:
        graph: the robot's pose graph.
        beliefs: what sightings say about classes.

    Attributes:
        tracks: all tracks, by number.
        live: those that can still get sightings.
    """

    def __init__(self, graph: PoseGraph, beliefs: ClassBeliefs) -> None:
        self._graph, self._beliefs = graph, beliefs
        self.tracks: list[Track] = []
        self.live: list[Track] = []
        self._moment, self._taken = -math.inf, set[int]()
        self._seen = self._seen_often = 0

    @property
    def often(self) -> bool:
        """Whether most sightings are of things seen again and again."""
        return self._seen > 100 and 2 * self._seen_often > self._seen

    def follow(self, sighting: Sighting, spacing: float, limit: float) -> Track:
        """The track of a sighting that has range and bearing.

        Args:
            sighting: the latest one.
            spacing: metres between landmarks, about.
            limit: metres by which odometry may be off before a track ends.
        """
        if sighting.time != self._moment:
            self._moment, self._taken = sighting.time, set()
        evidence = self._beliefs.likelihood(sighting.feature, sighting.confidence)
        x, y = self._graph.at(sighting)
        own = sighting.variance
        chance = float(np.exp(evidence) @ self._beliefs.posterior(np.zeros_like(evidence)))
        best, found, spread = math.log(NEW * chance / spacing**2), None, 0.0
        live = []
        for track in self.live:
            drift = self._graph.drift(sighting.pose, track.last, sighting.range)
            track.live = drift <= limit**2
            if not track.live:
                continue
            live.append(track)
            if track.number in self._taken or (track.key and sighting.key not in ("", track.key)):
                continue
            total = own + track.variance + drift
            distance = ((x - track.x) ** 2 + (y - track.y) ** 2) / total
            if distance > 14:
                continue
            fit = float(np.exp(evidence) @ self._beliefs.posterior(track.evidence))
            odds = math.log(fit) - distance / 2 - math.log(2 * math.pi * total)
            if odds > best:
                best, found, spread = odds, track, track.variance + drift
        self.live = live
        if found is None:
            found = Track(
                len(self.tracks), evidence, float(x), float(y), own, sighting.pose, sighting.pose
            )
            self.tracks.append(found)
            self.live.append(found)
        else:
            gain = spread / (spread + own)
            found.x += gain * float(x - found.x)
            found.y += gain * float(y - found.y)
            found.variance = spread * (1 - gain)
            found.evidence = found.evidence + evidence
            found.last = sighting.pose
        found.key = found.key or sighting.key
        found.sightings.append(sighting)
        sighting.track = found.number
        times = len(found.sightings)
        self._seen += 1
        self._seen_often += OFTEN if times == OFTEN else int(times > OFTEN)
        self._taken.add(found.number)
        return found
