"""CollectiveMap: the control agent's map, made of what edge agents send (design 7).

Each run keeps its own edge map. To solve, all are put into one joint graph; landmarks of different
visits and of different robots are merged by what lies within covariances and by constellations,
round after round, until nothing changes. Robots that do not know where they began are placed by
what they saw.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.association import Association
from symboslam.engine.slam.beliefs import ClassBeliefs
from symboslam.engine.slam.consistency import doubts
from symboslam.engine.slam.edge_map import EdgeMap
from symboslam.engine.slam.increment import EdgeIncrement
from symboslam.engine.slam.joint import JointGraph, Member
from symboslam.engine.slam.key_poses import KeyPoses, replay
from symboslam.engine.slam.log import Floats, RobotLog
from symboslam.engine.slam.meetings import find_meetings
from symboslam.engine.slam.outcome import outcome
from symboslam.engine.slam.placing import place_lost
from symboslam.engine.slam.run import Run
from symboslam.engine.slam.scale import Scale
from symboslam.engine.slam.settings import SlamSettings
from symboslam.engine.slam.slam_map import SlamMap

Progress = Callable[[str, float], None]
"""Is told what is done, and which share of it."""


def _silent(what: str, share: float) -> None:
    pass


class CollectiveMap:
    """The map of several robots.

    Args:
        classes: names of the classes.
        dynamic: (C,) which of them move.
        similarity: (C, C) how alike they are.
        settings: of map building.
    """

    def __init__(
        self,
        classes: Sequence[str],
        dynamic: NDArray[np.bool_],
        similarity: Floats,
        settings: SlamSettings | None = None,
    ) -> None:
        self._classes = tuple(classes)
        self._dynamic, self._similarity = dynamic, similarity
        self._settings = settings or SlamSettings()
        self._runs: dict[tuple[str, str], Run] = {}
        self._problems: Counter[str] = Counter()

    def add(self, increment: EdgeIncrement) -> None:
        """Take over an increment, in any order; one that came before is ignored."""
        run = self._run(increment.robot, increment.run)
        if not run.add(increment):
            self._problems[f"increments of {run.name} that had come before, left out"] += 1

    def add_log(self, log: RobotLog, progress: Progress = _silent) -> None:
        """Take over the whole log of one robot."""
        run = self._run(log.name, f"log {len(self._runs)}")
        run.start, run.start_sigma, run.closures = log.start, log.start_sigma, log.closures
        keys = KeyPoses(
            run.graph,
            log.odometry.noise,
            log.seen.sigma_range,
            log.seen.sigma_bearing,
            self._settings.interval,
        )
        total = len(log.odometry) + 1
        for n, _ in enumerate(replay(log, keys)):
            if n % 1000 == 0:
                progress(f"reading {log.name}", n / total)
        run.rows, run.finished = len(log.seen), True
        for problem, times in keys.problems.items():
            self._problems[f"{run.name}: {problem}"] += times

    @property
    def notes(self) -> list[str]:
        """What is wrong with what came, one sentence each."""
        said = [f"{problem}: {times}" for problem, times in sorted(self._problems.items())]
        for run in self._runs.values():
            if run.missing:
                numbers = ", ".join(str(n) for n in run.missing[:5])
                said.append(f"{run.name}: increments {numbers} are missing; later ones wait")
            for label, times in sorted(run.unknown.items()):
                said.append(f"{run.name}: class {label} is not known; left out {times} sightings")
        return said

    def solve(self, progress: Progress = _silent) -> SlamMap:
        """The map of all that has come."""
        runs = [run for run in self._runs.values() if len(run.graph)]
        edges = []
        for n, run in enumerate(runs):
            progress(f"mapping {run.name}", n / max(len(runs), 1))
            edge = run.edge_map(last=run.finished)
            if edge is not None:
                edges.append(edge)
        graph, placed, lost, scale = self._joined(runs, edges, progress)
        progress("done", 1.0)
        said = doubts(graph, [edges[n] for n in placed]) if graph.members else []
        for n in lost:
            said.append(f"{runs[n].name} could not be placed: it does not know where it began")
        notes = self.notes
        for run, edge in zip(runs, edges, strict=True):
            if edge.outliers:
                notes.append(
                    f"{run.name}: things seen only once, where others are seen often, left out: "
                    f"{edge.outliers}"
                )
        return outcome(graph, runs, edges, placed, self._dynamic, self._similarity, said, notes)

    def _run(self, robot: str, run: str) -> Run:
        found = self._runs.get((robot, run))
        if found is None:
            same = sum(name == robot for name, _ in self._runs)
            name = f"{robot} ({same + 1})" if same else robot
            if same:
                self._problems[f"another run calls itself {robot}; it is kept apart as {name}"] += 1
            found = Run(name, self._classes, self._dynamic, self._similarity, self._settings)
            self._runs[robot, run] = found
        return found

    def _joined(
        self, runs: list[Run], edges: list[EdgeMap], progress: Progress
    ) -> tuple[JointGraph, list[int], list[int], Scale]:
        """One graph of all robots that can be placed, solved; who is in it and who is not."""
        labels: dict[tuple[int, int], int] = {}
        members = [
            run.member(edge, n, labels) for n, (run, edge) in enumerate(zip(runs, edges, strict=True))
        ]
        named: dict[str, int] = {}
        for member in members:
            for piece in member.pieces:
                if piece.track.key:
                    piece.label = named.setdefault(piece.track.key, piece.label)
        known = [n for n, run in enumerate(runs) if run.start is not None or run.graph.fixes]
        if not known and members:
            known = [0]
            members[0].start_sigma = (0.01, 0.01, 0.001)
        placed = list(known)
        scale = _scale_of(edges)
        beliefs = ClassBeliefs(self._similarity)
        graph = self._solved([members[n] for n in placed], scale, beliefs, progress)
        waiting = [n for n in range(len(runs)) if n not in known]
        while waiting:
            found = place_lost(graph, [members[n] for n in waiting], beliefs, scale)
            if found is None:
                break
            index, poses = found
            number = waiting.pop(index)
            members[number].put(poses)
            placed.append(number)
            graph = self._solved([members[n] for n in placed], scale, beliefs, progress)
        return graph, placed, waiting, scale

    def _solved(
        self, members: list[Member], scale: Scale, beliefs: ClassBeliefs, progress: Progress
    ) -> JointGraph:
        """Robots in one frame, merged round by round."""
        settings = self._settings
        graph = JointGraph(members, settings, scale.spacing(sum(len(m.graph) for m in members)))
        for number, member in enumerate(members):
            for piece in member.pieces:
                piece.member = number
                piece.times = {(number, time) for _, time in piece.times}
        if not members:
            return graph
        far = True
        for turn in range(settings.rounds):
            progress("merging", turn / settings.rounds)
            if far:
                graph.solve(0)
            find_meetings(graph)
            graph.solve(settings.kernel)
            if not graph.labels():
                break
            graph.marginals()
            association = Association(graph, beliefs, scale)
            changed = association.merge_near()
            merged, far = association.constellations()
            if not merged:
                changed += association.move()
            if changed + merged <= turn // 4:
                break
        return graph


def _scale_of(edges: list[EdgeMap]) -> Scale:
    """The scale of what all robots saw."""
    scale = Scale()
    for edge in edges:
        scale.include(edge.scale)
    return scale
