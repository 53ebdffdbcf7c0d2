"""CollectiveMap: the control agent's map, made of what edge agents send (design 7).

Each run keeps its own edge map, which follows what comes, in whatever order. To solve, all are
joined in one graph.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.increment import AHEAD, EdgeIncrement
from symboslam.engine.slam.interleaving import OFTEN, jumps
from symboslam.engine.slam.joining import Joining, Progress, silent
from symboslam.engine.slam.key_poses import KeyPoses, replay
from symboslam.engine.slam.log import Floats, RobotLog
from symboslam.engine.slam.outcome import outcome
from symboslam.engine.slam.run import Run
from symboslam.engine.slam.settings import SlamSettings
from symboslam.engine.slam.slam_map import SlamMap
from symboslam.engine.slam.starts import doubtful_starts


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
        self._doubts: list[str] = []

    def add(self, increment: EdgeIncrement) -> None:
        """Take over an increment, in any order.

        One that came before is ignored; one that is numbered too far ahead is left out, and noted.
        """
        run = self._run(increment.robot, increment.run)
        if run.is_too_far(increment.sequence):
            self._problems[
                f"increments of {run.name} numbered more than {AHEAD} beyond the highest that had "
                f"come, left out"
            ] += 1
        elif not run.add(increment):
            self._problems[f"increments of {run.name} that had come before, left out"] += 1

    def add_log(self, log: RobotLog, progress: Progress = silent) -> None:
        """Take over the whole log of one robot."""
        run = self._run(log.name, f"log {len(self._runs)}")
        run.start, run.start_sigma, run.closures = log.start, log.start_sigma, log.closures
        keys = KeyPoses(run.graph, log.odometry.noise, self._settings.interval)
        total = len(log.odometry) + 1
        for n, _ in enumerate(replay(log, keys)):
            if n % 1000 == 0:
                progress(f"reading {log.name}", n / total)
        if log.fixes is not None:
            columns = log.fixes.time.tolist(), log.fixes.xy.tolist(), log.fixes.sigma.tolist()
            for time, (x, y), sigma in zip(*columns, strict=True):
                keys.fix(time, x, y, sigma)
        run.rows, run.finished = len(log.seen), True
        times = jumps(log.odometry.pose[:, :2])
        if times >= OFTEN:
            self._doubts.append(
                f"{run.name}: its odometry jumps there and back {times} times, as where the clock "
                f"was set back and two drives lie between each other in time"
            )
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
            if run.misplaced:
                said.append(
                    f"{run.name}: increments that do not begin where the one before ended, left "
                    f"out: {run.misplaced}"
                )
            for label, times in sorted(run.unknown.items()):
                said.append(f"{run.name}: class {label} is not known; left out {times} sightings")
        return said

    def solve(self, progress: Progress = silent) -> SlamMap:
        """The map of all that has come."""
        runs = [run for run in self._runs.values() if len(run.graph)]
        edges = []
        for n, run in enumerate(runs):
            progress(f"mapping {run.name}", n / max(len(runs), 1))
            edge = run.edge_map(last=run.finished)
            if edge is not None:
                edges.append(edge)
        joining = Joining(runs, edges, self._similarity, self._settings, progress)
        joining.join()
        progress("done", 1.0)
        said = self._doubts + joining.said() + self._of_starts(joining)
        for n in joining.lost:
            said.append(f"{runs[n].name} could not be placed: it does not know where it began")
        notes = self.notes
        for run, edge in zip(runs, joining.edges, strict=True):
            if edge.outliers:
                notes.append(
                    f"{run.name}: things seen only once, where others are seen often, left out: "
                    f"{edge.outliers}"
                )
        return outcome(joining, self._dynamic, self._similarity, said, notes)

    def _of_starts(self, joining: Joining) -> list[str]:
        """Which starts, as given, do not fit the map."""
        excess = {n: sum(doubt.excess for doubt in each) for n, each in joining.doubts.items()}
        doubted = [joining.placed.index(n) for n in sorted(excess, key=lambda n: -excess[n])]
        return doubtful_starts(joining.graph, doubted, joining.beliefs, joining.scale)

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
