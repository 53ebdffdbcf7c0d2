"""Constellations: which things of two maps are the same, by class and by distances between them.

Candidates are pairs of one thing here and one there. Two candidates agree if the distance between
both things here is that between both there. A set of candidates that all agree with each other is a
clique of the graph of agreements (Bailey 2000; Mangelson et al. 2018, pairwise consistency
maximisation). Each clique is scored by how much more probable it is if the things are the same than
by chance; the best is believed if it is much more probable than chance and than its rivals.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import networkx as nx
import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.log import Floats, Ints
from symboslam.engine.slam.planar import wrap

CLIQUES = 1000
"""So many cliques of one graph are looked at."""
APART = 0.2
"""Things nearer than this share of the spacing say nothing of the map beside each other."""
CHOICES = 8
"""So many things there are looked at for each here."""


@dataclass(frozen=True)
class Things:
    """Things of a map.

    Attributes:
        xy: (n, 2) metres.
        evidence: (n, C) summed log likelihoods of the classes.
    """

    xy: Floats
    evidence: Floats


@dataclass(frozen=True)
class Placing:
    """How well it is known where things here lie on the map there.

    Attributes:
        variance: (n,) square metres in one direction; infinite where nothing is known.
        heading: standard deviation of the rotation, radians; pi or more for any.
    """

    variance: Floats
    heading: float


@dataclass(frozen=True)
class Match:
    """Things that are the same.

    Attributes:
        here: (k,) numbers of things here.
        there: (k,) numbers of things there.
        odds: log odds against chance.
        margin: log odds against the best explanation that disagrees.
    """

    here: Ints
    there: Ints
    odds: float
    margin: float


def match(
    here: Things,
    there: Things,
    alike: Floats,
    placing: Placing,
    tolerance: Floats,
    spacing: float,
    allowed: NDArray[np.bool_] | None = None,
    rival: float = 2.3,
) -> list[Match]:
    """Explanations of what is the same, the best first; no two of them share a thing.

    Args:
        here: n things, whose ``xy`` are where they are thought to be on the map there.
        there: m things.
        alike: (n, m) log odds that two are of one class.
        placing: how well it is known where things here lie there.
        tolerance: (n, n) metres, standard deviation of the difference of two distances.
        spacing: metres between things there, about.
        allowed: (n, m) which pairs may be the same; None for all.
        rival: log odds by which others have to be worse to be no rivals.
    """
    return _Candidates(here, there, alike, placing, tolerance, spacing, allowed, rival).matches()


class _Candidates:
    def __init__(
        self,
        here: Things,
        there: Things,
        alike: Floats,
        placing: Placing,
        tolerance: Floats,
        spacing: float,
        allowed: NDArray[np.bool_] | None,
        rival: float,
    ) -> None:
        near = alike > 0
        if allowed is not None:
            near &= allowed
        away = here.xy[:, None] - there.xy[None]
        near &= (away**2).sum(2) <= 11.8 * placing.variance[:, None]
        if near.shape[1] > CHOICES:
            worth = np.where(
                near, alike - (away**2).sum(2) / 2 / placing.variance[:, None], -np.inf
            )
            near &= worth >= np.partition(worth, -CHOICES, axis=1)[:, -CHOICES, None]
        self.a, self.b = np.nonzero(near)
        self.alike, self.placing = alike[near], placing
        self.here, self.there = here.xy, there.xy
        self._here, self._there = here.xy @ [1, 1j], there.xy @ [1, 1j]
        self.area, self.apart = spacing**2, APART * spacing
        self.free = not np.isfinite(placing.variance).all()
        self.tolerance = tolerance
        self.size = len(here.xy)
        self.rival = rival

    def matches(self) -> list[Match]:
        graph = self._graph()
        found = []
        while len(graph):
            cliques = [
                np.array(sorted(c)) for c in itertools.islice(nx.find_cliques(graph), CLIQUES)
            ]
            scores = self._scores(cliques)
            best = int(np.argmax(scores))
            if scores[best] <= 0:
                break
            clique, top = cliques[best], scores[best]
            mine = dict(zip(self.a[clique].tolist(), self.b[clique].tolist(), strict=True))
            back = {b: a for a, b in mine.items()}
            margin, disputed, members = top, set[int](), set(clique.tolist())
            for score, other in zip(scores, cliques, strict=True):
                if score < top - self.rival:
                    continue
                against = self._against(other, mine, back)
                if against and members.isdisjoint(other.tolist()):
                    margin = min(margin, top - score)
                disputed |= against
            sure = clique[[a not in disputed for a in self.a[clique].tolist()]]
            if len(sure):
                found.append(Match(self.a[sure], self.b[sure], top, margin))
            graph.remove_nodes_from([n for n in graph if self.a[n] in mine or self.b[n] in back])
        return found

    def _graph(self) -> nx.Graph:
        a, b = self.here[self.a], self.there[self.b]
        da, db = a[:, None] - a[None], b[:, None] - b[None]
        tol = self.tolerance[self.a[:, None], self.a[None]]
        la, lb = np.hypot(da[..., 0], da[..., 1]), np.hypot(db[..., 0], db[..., 1])
        agree = abs(la - lb) < 3 * tol
        agree &= (self.a[:, None] != self.a[None]) & (self.b[:, None] != self.b[None])
        if self.placing.heading < np.pi:
            turn = wrap(np.arctan2(da[..., 1], da[..., 0]) - np.arctan2(db[..., 1], db[..., 0]))
            agree &= abs(turn) < 3 * self.placing.heading + 3 * tol / np.maximum(la, 1e-9)
        graph = nx.Graph()
        graph.add_nodes_from(range(len(self.a)))
        graph.add_edges_from(np.argwhere(np.triu(agree, 1)).tolist())
        return graph

    def _scores(self, cliques: list[Ints]) -> list[float]:
        """Log odds of each clique; minus infinity for those that cannot be near the best."""
        least = np.minimum(self.tolerance.min(1) ** 2, self.placing.variance)[self.a]
        gain = self.alike - np.log(2 * math.pi * least / self.area)
        highest = np.maximum(gain, 0)
        bounds = np.array([highest[clique].sum() for clique in cliques])
        scores, top = np.full(len(cliques), -np.inf), -math.inf
        for n in np.argsort(-bounds).tolist():
            if bounds[n] < top - self.rival:
                break
            scores[n] = self._odds(cliques[n])
            top = max(top, scores[n])
        return scores.tolist()

    def _odds(self, clique: Ints) -> float:
        """Log odds of a clique: placed as expected, of one class, at the same distances."""
        a, b = self.a[clique], self.b[clique]
        here, there = self._here[a], self._there[b]
        alike, variance = self.alike[clique], self.placing.variance[a]
        first = int(variance.argmin())
        shift = (there - here).sum() / len(a)
        if self.free:
            odds = -math.log(len(self._there))
        else:
            least = float(variance[first])
            odds = -(abs(shift) ** 2) / 2 / least - math.log(2 * math.pi * least / self.area)
        odds += float(alike[first])
        if len(a) == 1:
            return odds
        centre, onto = here.sum() / len(a), there.sum() / len(a)
        turn = ((there - onto) * (here - centre).conj()).sum()
        turn = turn / abs(turn) if turn else 1.0
        if self.placing.heading < math.pi:
            angle = math.atan2(turn.imag, turn.real)
            odds -= angle**2 / 2 / (self.placing.heading**2 + 0.01)
        left = (abs((here - centre) * turn - (there - onto)) ** 2).tolist()
        middle = int(abs(here - centre).argmin())
        width = (self.tolerance[a, a[middle]] ** 2).tolist()
        width[middle] = float(self.tolerance[a[middle], a[first]] ** 2)
        picked, points = [first], here.tolist()
        for n in variance.argsort(kind="stable").tolist():
            apart = min(abs(points[n] - points[m]) for m in picked)
            if apart < self.apart:
                continue
            chance = 2 * math.pi * width[n] / self.area
            if self.free and len(picked) == 1:
                chance = 2 * math.pi * apart * math.sqrt(2 * math.pi * width[n]) / self.area
            odds += max(float(alike[n]) - left[n] / 2 / width[n] - math.log(chance), -1.0)
            picked.append(n)
        return odds - math.log(math.comb(self.size, min(len(picked), self.size)))

    def _against(self, clique: Ints, mine: dict[int, int], back: dict[int, int]) -> set[int]:
        """Things here of which a clique says something else than a match."""
        said = set()
        for a, b in zip(self.a[clique].tolist(), self.b[clique].tolist(), strict=True):
            own = mine.get(a, b)
            if own != b and abs(self._there[own] - self._there[b]) > 3 * self.tolerance[a, a]:
                said.add(a)
            if back.get(b, a) != a:
                said.add(back[b])
        return said
