"""Joining: the maps of all runs in one joint graph, merged round by round.

Landmarks of different visits and of different robots are merged by what lies within covariances
and by constellations, until nothing changes. Robots that do not know where they began are placed by
what they saw. A robot that is doubted is mapped again, with what the others have mapped to go by.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import count

from symboslam.engine.slam.association import Association
from symboslam.engine.slam.beliefs import ClassBeliefs
from symboslam.engine.slam.consistency import Doubt, doubts, names_of_several, vagueness
from symboslam.engine.slam.edge_landmarks import Known
from symboslam.engine.slam.edge_map import EdgeMap
from symboslam.engine.slam.joint import JointGraph, Member
from symboslam.engine.slam.log import Floats, Pose
from symboslam.engine.slam.meetings import find_meetings, seen_robots
from symboslam.engine.slam.placing import place_lost
from symboslam.engine.slam.run import OWN, Run
from symboslam.engine.slam.scale import Scale
from symboslam.engine.slam.settings import SlamSettings

Progress = Callable[[str, float], None]
"""Is told what is done, and which share of it."""


def silent(what: str, share: float) -> None:
    """Tell nobody."""


FULL = 50
"""Iterations of a solution that has far to go, or that is the last, at most."""
CERTAINTIES = (1.0, 0.7, 1.5)
"""A robot is mapped again with so many times the certainty; that counts with which it meets most
of the others."""
WHERE = 0.9
"""A robot that meets this share of those that it saw is where it thinks it is."""
WELL = 5
"""A landmark seen so often by others is one to go by."""


class Joining:
    """The maps of all runs in one graph.

    Args:
        runs: of robots, with at least one key pose each.
        edges: their own maps.
        similarity: (C, C) how alike classes are.
        settings: of map building.
        progress: is told what is done.

    Attributes:
        edges: as given; those of robots that were mapped again are replaced.
        beliefs: of classes.
        scale: of what all robots saw.
        graph: of all robots that are placed, in that order.
        placed: numbers of their runs.
        lost: numbers of runs that could not be placed.
        doubts: number of a run -> why it should not be trusted; only those with doubts.
        vague: why the whole map should not be trusted, though it fits.
    """

    def __init__(
        self,
        runs: Sequence[Run],
        edges: Sequence[EdgeMap],
        similarity: Floats,
        settings: SlamSettings,
        progress: Progress,
    ) -> None:
        self.runs, self.edges = list(runs), list(edges)
        self._settings, self._progress = settings, progress
        self.beliefs, self.scale = ClassBeliefs(similarity), Scale()
        self.graph = JointGraph([], settings, 1.0)
        self.placed: list[int] = []
        self.lost = list(range(len(self.runs)))
        self.doubts: dict[int, list[Doubt]] = {}
        self.vague: list[str] = []
        self._numbers = count()
        self._named: dict[str, int] = {}
        self._members = [self._member(n, edge) for n, edge in enumerate(self.edges)]
        for edge in self.edges:
            self.scale.include(edge.scale)

    def join(self) -> None:
        """Put all robots in one frame."""
        known = [n for n in self.lost if self.runs[n].start is not None or self.runs[n].graph.fixes]
        if not known and self.lost:
            known = self.lost[:1]
            self._members[known[0]].start_sigma = OWN
        if not known:
            return
        self._add(known)
        while self.lost:
            waiting = [self._members[n] for n in self.lost]
            found = place_lost(self.graph, waiting, self.beliefs, self.scale)
            if found is None:
                break
            number = self.lost[found[0]]
            self._members[number].put(found[1])
            self._add([number])
        self._look()
        self._repair()
        self.vague = vagueness(self.graph, self.scale.reach) + names_of_several(self.graph)

    def said(self) -> list[str]:
        """Why the map should not be trusted, one sentence each."""
        return [doubt.said for each in self.doubts.values() for doubt in each] + self.vague

    def _add(self, numbers: Sequence[int]) -> None:
        self.placed += numbers
        self.lost = [n for n in self.lost if n not in numbers]
        self.graph = self._solved([self._members[n] for n in self.placed])

    def _look(self) -> None:
        """Find out whom to doubt."""
        said = doubts(self.graph, [self.edges[n] for n in self.placed])
        self.doubts = {n: each for n, each in zip(self.placed, said, strict=True) if each}

    def _repair(self) -> None:
        """Map the robot that is doubted most again, then the next, as long as that helps.

        A robot that is wrong makes those doubted that saw it, so one at a time.
        """
        tried: set[int] = set()
        for _ in range(self._settings.repairs):
            left = {n: self._excess(n) for n in self.doubts if n not in tried}
            if not left or len(self.placed) < 2:
                break
            worst = max(left, key=lambda n: left[n])
            if self._map_again(worst):
                tried.clear()
            tried.add(worst)

    def _excess(self, *numbers: int) -> float:
        """How much robots are doubted."""
        return sum(doubt.excess for n in numbers for doubt in self.doubts.get(n, ()))

    def _map_again(self, number: int) -> bool:
        """Map a robot by what the others have mapped; keep that if there is less to doubt.

        Returns:
            Whether it is kept.
        """
        before = self.graph, list(self.edges), list(self._members), self.doubts
        kept = [
            (m, m.poses, m.scale, m.turn, [piece.label for piece in m.pieces])
            for m in self._members
        ]
        run = self.runs[number]
        self._progress(f"mapping {run.name} again", 0.5)
        others = self._graph([self._members[n] for n in self.placed if n != number])
        others.solve(self._settings.kernel, FULL)
        others.marginals()
        given, known = _known(others)
        x, y, heading = self._members[number].poses[0].tolist()
        start: Pose = run.start or (x, y, heading)
        best = -1
        for share in CERTAINTIES:
            edge = run.mapped_again(start, known, share * self._settings.certainty)
            member = self._member(number, edge, given)
            trial = self._graph([*others.members, member])
            find_meetings(trial)
            if len(trial.meetings) > best:
                best = len(trial.meetings)
                self.edges[number], self._members[number] = edge, member
            robots = len(seen_robots(member))
            if sum(seen[0] == len(others.members) for seen in trial.meetings) >= WHERE * robots:
                break
        self.graph = self._solved([self._members[n] for n in self.placed])
        excess = self._excess(*self.placed)
        self._look()
        if self._excess(*self.placed) < excess:
            return True
        self.graph, self.edges, self._members, self.doubts = before
        for member, poses, scale, turn, labels in kept:
            member.poses, member.scale, member.turn = poses, scale, turn
            for piece, label in zip(member.pieces, labels, strict=True):
                piece.label = label
        for at, member in enumerate(self.graph.members):
            member.renumber(at)
        return False

    def _member(self, number: int, edge: EdgeMap, known: Sequence[int] = ()) -> Member:
        """A run as part of the graph; ``known`` are labels of landmarks that it was given."""
        labels = dict(enumerate(known))
        for landmark in edge.landmark_of.values():
            if landmark not in labels:
                labels[landmark] = next(self._numbers)
        member = self.runs[number].member(edge, number, labels)
        for piece in member.pieces:
            if piece.track.key:
                piece.label = self._named.setdefault(piece.track.key, piece.label)
        return member

    def _graph(self, members: list[Member]) -> JointGraph:
        """Robots in one frame, not solved yet."""
        spacing = self.scale.spacing(sum(len(m.graph) for m in members))
        graph = JointGraph(members, self._settings, spacing)
        for number, member in enumerate(members):
            member.renumber(number)
        graph.parts = [
            (number, seen, label)
            for number, member in enumerate(members)
            for seen, label in member.parts
        ]
        return graph

    def _solved(self, members: list[Member]) -> JointGraph:
        """Robots in one frame, merged round by round until nothing changes or all comes round."""
        settings, scale = self._settings, self.scale
        graph, far = self._graph(members), True
        passed: set[tuple[int, ...]] = set()
        for turn in range(settings.rounds):
            self._progress("merging", turn / settings.rounds)
            if far:
                graph.solve(0, FULL)
            find_meetings(graph)
            graph.solve(settings.kernel)
            if not graph.labels() or _partition(graph) in passed:
                break
            passed.add(_partition(graph))
            graph.marginals()
            association = Association(graph, self.beliefs, scale, self._numbers)
            changed = association.merge_near()
            merged, far = association.constellations()
            if not merged:
                changed += association.move()
            if changed + merged <= turn // 4:
                break
        if graph.labels():
            graph.solve(settings.kernel, FULL)
            graph.marginals()
        return graph


def _partition(graph: JointGraph) -> tuple[int, ...]:
    """Which tracks are of one landmark, whatever its label: the first track of each."""
    first: dict[int, int] = {}
    return tuple(first.setdefault(piece.label, n) for n, piece in enumerate(graph.pieces))


def _known(graph: JointGraph) -> tuple[list[int], list[Known]]:
    """Labels and landmarks that are seen well."""
    pieces: dict[int, list[int]] = {}
    for n, piece in enumerate(graph.pieces):
        pieces.setdefault(piece.label, []).append(n)
    labels, known = [], []
    every = graph.pieces
    for label, numbers in sorted(pieces.items()):
        seen = [every[n] for n in numbers]
        if sum(len(p.track.sightings) for p in seen) < WELL or label not in graph.covariance:
            continue
        evidence = sum((p.track.evidence for p in seen[1:]), seen[0].track.evidence)
        name = next((p.track.key for p in seen if p.track.key), "")
        labels.append(label)
        known.append(Known(graph.xy[label], graph.covariance[label], evidence, name))
    return labels, known
