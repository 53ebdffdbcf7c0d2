"""Association: which landmarks of a joint graph are one, and which tracks are of another."""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import count

import numpy as np
from scipy.spatial import cKDTree

from symboslam.engine.slam.beliefs import ClassBeliefs
from symboslam.engine.slam.constellation import Placing, Things, match
from symboslam.engine.slam.joint import JointGraph, Piece
from symboslam.engine.slam.log import Floats
from symboslam.engine.slam.scale import Scale, together

WINDOW = 1.4
"""A window of tracks is this many times as wide as tracks wait for (``hold``)."""
FITS = 9.0
"""Squared distance in standard deviations up to which a track is of a landmark."""
FAR = 0.3
"""Merged landmarks farther apart than this share of the spacing pull the map far."""
STRANGE = 25.0
"""The same, beyond which it is not."""


class Association:
    """Merges, moves and splits the landmarks of a joint graph.

    Args:
        graph: is changed; solved, with marginals, whenever a method is called.
        beliefs: what sightings say about classes.
        scale: how far apart landmarks are, and how far sensors reach.
        numbers: labels that nobody has, for landmarks that are split off.
    """

    def __init__(
        self,
        graph: JointGraph,
        beliefs: ClassBeliefs,
        scale: Scale,
        numbers: Iterator[int] | None = None,
    ) -> None:
        self.graph, self.beliefs, self.scale = graph, beliefs, scale
        self._numbers = numbers or count(max(graph.labels(), default=-1) + 1)

    def take_stock(self) -> None:
        """Evidence and times of each landmark, as it is now."""
        self.labels = self.graph.labels()
        self.times: dict[int, set[tuple[int, float]]] = {label: set() for label in self.labels}
        self.evidence = {label: np.zeros(self.beliefs.size) for label in self.labels}
        for piece in self.graph.pieces:
            self.times[piece.label] |= piece.times
            self.evidence[piece.label] = self.evidence[piece.label] + piece.track.evidence
        told = np.array([self.evidence[label] for label in self.labels])
        self.beliefs.learn(told.argmax(1))
        self.alike = self.beliefs.alike(told, told)
        self.place_of = {label: n for n, label in enumerate(self.labels)}
        self.xy = np.array([self.graph.xy[label] for label in self.labels])
        self.told = told

    def _together(self, one: int, other: int) -> bool:
        """Whether two landmarks were seen beside each other, and so are two."""
        return together(self.times[one], self.times[other])

    def move(self) -> int:
        """Give tracks to the landmarks that they fit, split off those that fit none; how many."""
        graph = self.graph
        self.take_stock()
        floor = (graph.settings.floor * self.scale.sigma) ** 2
        size = {label: 0 for label in self.labels}
        pieces = graph.pieces
        for piece in pieces:
            size[piece.label] += 1
        alike = self.beliefs.alike(np.array([p.track.evidence for p in pieces]), self.told)
        changed = 0
        for piece, fits in zip(pieces, alike, strict=True):
            where, variance = piece.where(graph.members[piece.member].poses)
            square = ((self.xy - where) ** 2).sum(1) / (variance + floor)
            own = float(square[self.place_of[piece.label]])
            if own < FITS:
                continue
            best = int(np.where(fits > 0, square, np.inf).argmin())
            if fits[best] > 0 and square[best] < FITS:
                changed += self._give(piece, self.labels[best])
            elif own > STRANGE and size[piece.label] > 1:
                label = next(self._numbers)
                graph.xy[label] = where
                changed += self._give(piece, label)
        return changed

    def _give(self, piece: Piece, label: int) -> int:
        """Give a track to a landmark, unless it is named otherwise."""
        if piece.track.key or piece.label == label:
            return 0
        piece.label = label
        return 1

    def merge_near(self) -> int:
        """Merge landmarks that lie within their covariances; how many."""
        self.take_stock()
        graph = self.graph
        known = [label for label in self.labels if label in graph.covariance]
        if len(known) < 2:
            return 0
        floor = np.eye(2) * (graph.settings.floor * self.scale.sigma) ** 2
        widest = max(float(np.trace(graph.covariance[label])) for label in known)
        reach = min(graph.spacing, 4 * math.sqrt(widest) + self.scale.sigma)
        xy = np.array([graph.xy[label] for label in known])
        names: dict[int, set[str]] = {label: set() for label in known}
        for piece in graph.pieces:
            if piece.track.key and piece.label in names:
                names[piece.label].add(piece.track.key)
        found = []
        for i, j in sorted(cKDTree(xy).query_pairs(reach)):
            one, other = known[i], known[j]
            alike = float(self.alike[self.place_of[one], self.place_of[other]])
            if alike <= 0 or self._together(one, other) or _apart(names[one], names[other]):
                continue
            covariance = graph.covariance[one] + graph.covariance[other] + floor
            times = len(self.times[one]) + len(self.times[other])
            odds = self.scale.same(xy[i] - xy[j], covariance, alike, times, graph.spacing)
            wide = math.sqrt(float(np.trace(covariance)) / 2) > FAR * graph.spacing
            if odds > graph.settings.certainty / (1 if wide else 2):
                found.append((odds, one, other))
        return self._merge([(odds, [(one, other)]) for odds, one, other in found])

    def _merge(self, found: list[tuple[float, list[tuple[int, int]]]]) -> int:
        """Merge pairs of landmarks, the surest first, each landmark once."""
        busy: set[int] = set()
        into: dict[int, int] = {}
        for _, pairs in sorted(found, key=lambda each: (-each[0], each[1])):
            if any(label in busy for pair in pairs for label in pair):
                continue
            for one, other in pairs:
                keep, gone = min(one, other), max(one, other)
                into[gone] = keep
                busy |= {one, other}
                self._average(keep, gone)
        for piece in self.graph.pieces:
            piece.label = into.get(piece.label, piece.label)
        self.graph.parts = [
            (member, seen, into.get(label, label)) for member, seen, label in self.graph.parts
        ]
        return len(into)

    def _average(self, keep: int, gone: int) -> None:
        """Where the merged landmark is thought to be, by the covariances of both."""
        graph = self.graph
        one, other = (np.linalg.inv(graph.covariance[label]) for label in (keep, gone))
        told = one @ graph.xy[keep] + other @ graph.xy[gone]
        graph.xy[keep] = np.asarray(np.linalg.solve(one + other, told), np.float64)

    def constellations(self) -> tuple[int, bool]:
        """Merge landmarks whose constellations agree.

        Returns:
            How many, and whether some of them were far apart.
        """
        self.take_stock()
        graph, found = self.graph, []
        spread = float(np.median([np.trace(graph.covariance[label]) / 2 for label in self.labels]))
        for number in range(len(graph.members)):
            for window in self.windows(number):
                found += self._match(number, window, spread)
        apart = [
            float(np.hypot(*(graph.xy[one] - graph.xy[other])))
            for _, pairs in found
            for one, other in pairs
        ]
        return self._merge(found), max(apart, default=0.0) > FAR * graph.spacing

    def windows(self, number: int) -> list[list[Piece]]:
        """The tracks of a robot, some at a time, while its odometry is good; they overlap."""
        graph = self.graph
        member = graph.members[number]
        pieces = sorted(member.pieces, key=lambda piece: piece.track.last)
        wide = (WINDOW * graph.settings.hold * graph.spacing) ** 2
        windows, begin = [], 0
        while begin < len(pieces):
            drift = [
                member.graph.drift(piece.track.last, pieces[begin].track.last)
                for piece in pieces[begin : begin + 200]
            ]
            end = begin + int(np.searchsorted(drift, wide, side="right"))
            windows.append(pieces[begin:end])
            begin = max(begin + int(np.searchsorted(drift, wide / 4, side="right")), begin + 1)
        return windows

    def _match(
        self, number: int, window: list[Piece], spread: float
    ) -> list[tuple[float, list[tuple[int, int]]]]:
        graph, settings = self.graph, self.graph.settings
        member = graph.members[number]
        labels = list(dict.fromkeys(piece.label for piece in window))
        middle = sorted(piece.track.last for piece in window)[len(window) // 2]
        covariance = graph.pose_covariance(number, middle)
        here = self.around(number, window, labels)
        arm = ((here.xy - member.poses[middle, :2]) ** 2).sum(1)
        rows = [self.place_of[label] for label in labels]
        allowed = np.ones((len(labels), len(self.labels)), bool)
        allowed[:, rows] = False
        for i, j in np.argwhere(allowed & (self.alike[rows] > 0)).tolist():
            allowed[i, j] = not self._together(labels[i], self.labels[j])
        variance = covariance[0, 0] + covariance[1, 1] + covariance[2, 2] * arm
        far = max(float(arm.mean()), graph.spacing**2)
        placing = Placing(
            variance / 2 + spread + self.scale.sigma**2,
            math.sqrt(covariance[2, 2] + spread / far),
        )
        there = Things(self.xy, self.told)
        return [
            (
                found.odds,
                [
                    (labels[a], self.labels[b])
                    for a, b in zip(found.here.tolist(), found.there.tolist(), strict=True)
                ],
            )
            for found in match(
                here,
                there,
                self.alike[rows],
                placing,
                self.tolerance(number, window, labels),
                graph.spacing,
                allowed,
                settings.rival,
            )
            if found.odds > settings.certainty and found.margin > settings.rival
        ]

    def around(self, number: int, window: list[Piece], labels: list[int]) -> Things:
        """The landmarks of a window, where its tracks have them."""
        poses = self.graph.members[number].poses
        xy = [
            np.mean([p.where(poses)[0] for p in window if p.label == label], axis=0)
            for label in labels
        ]
        return Things(np.array(xy), np.array([self.evidence[label] for label in labels]))

    def tolerance(self, number: int, window: list[Piece], labels: list[int]) -> Floats:
        """(n, n) metres by which the distances of a window may be off."""
        graph = self.graph.members[number].graph
        last = [next(p.track.last for p in window if p.label == label) for label in labels]
        base = (self.graph.settings.base * self.scale.sigma) ** 2
        return np.sqrt([[base + 2 * graph.drift(a, b) for b in last] for a in last])


def _apart(one: set[str], other: set[str]) -> bool:
    """Whether two landmarks have names, and none in common."""
    return bool(one and other and not one & other)
