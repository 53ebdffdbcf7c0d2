"""EdgeAgent: maps what one robot drives and sees, and puts what is new into a spool."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from typing import Protocol

from symboslam.engine.slam.increment import EdgeIncrement
from symboslam.engine.slam.log import ROBOT, Pose
from symboslam.engine.slam.readers.records import (
    ROBOT_CLASS,
    FixRecord,
    OdometryRecord,
    Record,
    SightingRecord,
)
from symboslam.sim_bridge.agents.link import Tell
from symboslam.sim_bridge.agents.spool import Spool, SpoolFullError

_TICK = 0.5


class Mapper(Protocol):
    """What an agent needs of `symboslam.engine.slam.edge.EdgeMapper`."""

    @property
    def notes(self) -> list[str]:
        """What is wrong with what came, one sentence each."""

    def odometry(self, time: float, pose: Pose, /) -> None:
        """Where the robot believes to be."""

    def sighting(
        self,
        time: float,
        range: float,
        bearing: float,
        feature: int,
        confidence: float,
        key: str,
        sigma: tuple[float, float] | None,
        /,
    ) -> None:
        """What it saw."""

    def fix(self, time: float, x: float, y: float, sigma: float, /) -> None:
        """Where it was told to be."""

    def increment(self, last: bool = False) -> EdgeIncrement | None:
        """What is new since the last call."""


class EdgeAgent:
    """Feeds a mapper, and puts what is new into a spool at intervals of the log's own time.

    The same log gives the same increments, so that a replay that was killed goes on where it was.

    Args:
        mapper: makes the pose graph.
        spool: where increments go; its run has begun.
        index_of: position of a class by name; None for one that is not known.
        every: seconds of the log between increments.
        tell: is told what is odd.
        give_up: whether not to wait any longer for room in the spool.

    Raises:
        SpoolFullError: (`feed`, `end`) there is no room, and `give_up` says so.
    """

    def __init__(
        self, mapper: Mapper, spool: Spool, index_of: Callable[[str], int | None], every: float,
        tell: Tell, give_up: Callable[[], bool] = lambda: False,
    ) -> None:  # fmt: skip
        self._mapper, self._spool, self._index_of = mapper, spool, index_of
        self._every, self._tell, self._give_up = every, tell, give_up
        self._due: float | None = None
        self._noted = 0
        self._features: dict[str, int | None] = {}
        self.unknown: Counter[str] = Counter()
        """Class that is not known -> how many sightings were left out."""

    def feed(self, record: Record) -> None:
        """Take a record, and put away what is new if it is time."""
        if isinstance(record, OdometryRecord):
            self._mapper.odometry(record.time, record.pose)
            if self._due is None:
                self._due = record.time + self._every
            elif record.time >= self._due:
                self._due = record.time + self._every
                self._put(self._mapper.increment())
        elif isinstance(record, FixRecord):
            self._mapper.fix(record.time, record.x, record.y, record.sigma)
        else:
            self._see(record)
        self._tell_notes()

    def end(self) -> None:
        """Put away what is left, and that it was the last."""
        self._put(self._mapper.increment(last=True))
        self._tell_notes()
        if self.unknown:
            kinds = ", ".join(f"{n} x {name}" for name, n in self.unknown.most_common(5))
            self._tell(f"{self.unknown.total()} sightings of classes that nobody knows: {kinds}")

    def _see(self, seen: SightingRecord) -> None:
        name = seen.feature.casefold()
        if name not in self._features:
            found = self._index_of(seen.feature)
            is_robot = found is None and name == ROBOT_CLASS.casefold()
            self._features[name] = ROBOT if is_robot else found
        feature = self._features[name]
        if feature is None:
            self.unknown[seen.feature[:80]] += 1
            return
        self._mapper.sighting(
            seen.time, seen.range, seen.bearing, feature, seen.confidence, seen.key, seen.sigma
        )

    def _put(self, increment: EdgeIncrement | None) -> None:
        if increment is None:
            return
        full = False
        while True:
            try:
                self._spool.put(increment)
            except SpoolFullError as error:
                if self._give_up():
                    raise
                if not full:
                    self._tell(f"{error}; nothing is read until the service has taken some")
                full = True
                self._spool.wait(_TICK)
            else:
                return

    def _tell_notes(self) -> None:
        for note in self._mapper.notes[self._noted :]:
            self._tell(note)
        self._noted = len(self._mapper.notes)
