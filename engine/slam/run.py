"""Run: what the control agent knows of one run of one robot, and that run's own map."""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.slam.beliefs import ClassBeliefs
from symboslam.engine.slam.edge_landmarks import Known
from symboslam.engine.slam.edge_map import EdgeMap
from symboslam.engine.slam.increment import AHEAD, EdgeIncrement
from symboslam.engine.slam.joint import Member, Piece
from symboslam.engine.slam.log import ROBOT, Closures, Floats, Pose
from symboslam.engine.slam.pose_graph import Fix, PoseGraph, Sighting
from symboslam.engine.slam.settings import SlamSettings

OWN: Pose = (0.01, 0.01, 0.001)
"""Standard deviations of a start that a robot's own frame is laid through."""
GAPS = 100
"""So many missing increments are listed."""
LOOSE: Pose = (1.0, 1.0, 0.1)
"""Standard deviations of a start that was worked out."""


class Run:
    """One run of one robot.

    Args:
        name: of the robot, made different if two have the same.
        classes: names of the classes.
        dynamic: (C,) which of them move.
        similarity: (C, C) how alike they are.
        settings: of map building.

    Attributes:
        graph: its pose graph, as far as it has come without a gap.
        start: where it began; None if not known.
        finished: nothing more comes.
        unknown: names of classes that are not known -> sightings left out.
        closures: relative poses from outside, if any.
        misplaced: increments left out, as their first key pose is not the next.
    """

    def __init__(
        self,
        name: str,
        classes: tuple[str, ...],
        dynamic: NDArray[np.bool_],
        similarity: Floats,
        settings: SlamSettings,
    ) -> None:
        self.name, self.settings = name, settings
        self.graph = PoseGraph(name)
        self.start: Pose | None = None
        self.start_sigma: Pose = (0.01, 0.01, 0.01)
        self.finished = False
        self.unknown: Counter[str] = Counter()
        self.closures: Closures | None = None
        self.rows = self.misplaced = 0
        self._classes = {label: n for n, label in enumerate(classes)}
        self._dynamic, self._similarity = dynamic, similarity
        self._waiting: dict[int, EdgeIncrement] = {}
        self._next = 0
        self._map: EdgeMap | None = None

    @property
    def missing(self) -> list[int]:
        """Numbers of the first increments that have not come, though later ones have."""
        gaps = (n for n in range(self._next, self.latest) if n not in self._waiting)
        return list(itertools.islice(gaps, GAPS))

    @property
    def latest(self) -> int:
        """The highest number that has come; -1 for none."""
        return max(self._waiting, default=self._next - 1)

    def is_too_far(self, sequence: int) -> bool:
        """Whether a number lies so far ahead that it is a mistake."""
        return sequence > self.latest + AHEAD

    def add(self, increment: EdgeIncrement) -> bool:
        """Take over an increment that is not too far ahead, in any order; False if not new."""
        if increment.sequence < self._next or increment.sequence in self._waiting:
            return False
        self._waiting[increment.sequence] = increment
        while self._next in self._waiting:
            self._append(self._waiting.pop(self._next))
            self._next += 1
        return True

    def _append(self, increment: EdgeIncrement) -> None:
        self.finished = self.finished or increment.last
        if increment.first != len(self.graph):
            self.misplaced += 1
            return
        if increment.sequence == 0:
            self.start, self.start_sigma = increment.start, increment.start_sigma
        for time, step, sigma in zip(
            increment.time.tolist(), increment.step, increment.sigma, strict=True
        ):
            self.graph.add(time, np.asarray(step), np.asarray(sigma))
        for n in range(len(increment.row)):
            seen = self._sighting(increment, n)
            if seen is not None:
                self.graph.sightings.append(seen)
        for pose, (x, y, sigma) in zip(
            increment.fix_pose.tolist(), increment.fix.tolist(), strict=True
        ):
            self.graph.fixes.append(Fix(pose, x, y, sigma))

    def _sighting(self, increment: EdgeIncrement, n: int) -> Sighting | None:
        label = str(increment.feature[n])
        if label and label not in self._classes:
            self.unknown[label] += 1
            return None
        pose = int(increment.pose[n])
        self.rows = max(self.rows, int(increment.row[n]) + 1)
        return Sighting(
            int(increment.row[n]),
            float(increment.seen[n]),
            pose,
            float(increment.range[n]),
            float(increment.bearing[n]),
            float(increment.sigma_range[n]),
            float(increment.sigma_bearing[n]),
            self._classes[label] if label else ROBOT,
            float(increment.confidence[n]),
            str(increment.key[n]),
        )

    def edge_map(self, last: bool = False) -> EdgeMap | None:
        """The run's own map, up to date; None as long as there are no poses."""
        if not len(self.graph):
            return None
        if self._map is None:
            self._map = EdgeMap(
                self.graph,
                ClassBeliefs(self._similarity),
                self._dynamic,
                self.start or (0.0, 0.0, 0.0),
                self.start_sigma if self.start else OWN,
                self.settings,
            )
        self._map.follow(last)
        return self._map

    def mapped_again(self, start: Pose, known: Sequence[Known], certainty: float) -> EdgeMap:
        """The run's map made anew, with landmarks of others and a certainty to go by."""
        edge = EdgeMap(
            self.graph,
            ClassBeliefs(self._similarity),
            self._dynamic,
            start,
            self.start_sigma if self.start else LOOSE,
            replace(self.settings, certainty=certainty),
            known,
        )
        edge.follow(last=True)
        return edge

    def member(self, edge: EdgeMap, number: int, labels: Mapping[int, int]) -> Member:
        """The run as part of a joint graph.

        Args:
            edge: its map.
            number: of the run.
            labels: landmark of its map -> label.
        """
        pieces = [
            Piece(number, track, labels[edge.landmark_of[track.number]])
            for track in edge.tracker.tracks
            if track.number in edge.landmark_of
        ]
        parts = [(seen, labels[n]) for seen, n in edge.partial if n in labels]
        sigma = self.start_sigma if self.start else None
        return Member(self.name, self.graph, edge.poses(), sigma, pieces, self.closures, parts)
