"""EdgeAgent: maps what one robot drives and sees, and sends what is new to a map of a service."""

from __future__ import annotations

import hashlib
import json
import threading
import time
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Protocol
from urllib.parse import quote

from symboslam.engine.slam.increment import EdgeIncrement
from symboslam.engine.slam.log import ROBOT, Pose
from symboslam.errors import InputError
from symboslam.sim_bridge.agents.link import Link, LinkDownError, Patience, RefusedError, Tell
from symboslam.sim_bridge.agents.records import (
    ROBOT_CLASS,
    FixRecord,
    OdometryRecord,
    Record,
    SightingRecord,
)
from symboslam.sim_bridge.agents.spool import Letter, Spool, SpoolFullError

NDJSON = {"Content-Type": "application/x-ndjson"}
_NEVER = (400, 409, 413, 422)
"""What an increment gets that will never be taken; anything else may be mended."""
_AT_A_TIME = 100
_BYTES = 1024 * 1024
_TICK = 0.5


class Mapper(Protocol):
    """What an agent needs of `symboslam.engine.slam.edge.EdgeMapper`."""

    notes: list[str]

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
        /,
    ) -> None:
        """What it saw."""

    def fix(self, time: float, x: float, y: float, sigma: float, /) -> None:
        """Where it was told to be."""

    def increment(self, last: bool = False) -> EdgeIncrement | None:
        """What is new since the last call."""


def run_of(log: Path, *options: object) -> str:
    """Name of the run in which a log is replayed: the same again has the same.

    Args:
        log: a file, or a folder of files.
        options: all else that its increments depend on.

    Raises:
        InputError: a file cannot be read.
    """
    digest = hashlib.sha256(json.dumps([str(each) for each in options]).encode())
    files = sorted(each for each in log.rglob("*") if each.is_file()) if log.is_dir() else [log]
    try:
        for file in files:
            with file.open("rb") as opened:
                digest.update(hashlib.file_digest(opened, "sha256").digest())
    except OSError as error:
        raise InputError(f"{file} cannot be read: {error.strerror or error}") from error
    return f"replay-{digest.hexdigest()[:24]}"


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
            seen.time, seen.range, seen.bearing, feature, seen.confidence, seen.key
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


class Sender(threading.Thread):
    """Sends what is in a spool, whenever the service takes it, until it is stopped.

    Args:
        spool: what is to be sent.
        link: to the service.
        identifier: id of the map.
        tell: is told what is odd.

    Attributes:
        refusal: why the service refuses everything for now, such as a token that is wrong.
        refused: increments that it will never take.
        failure: what has ended it, if anything did.
    """

    def __init__(self, spool: Spool, link: Link, identifier: str, tell: Tell) -> None:
        super().__init__(daemon=True)
        self._spool, self._link, self._tell = spool, link, tell
        self._path = f"/v1/maps/{quote(identifier, safe='')}/increments"
        self._patience = Patience(tell)
        self._stopped = threading.Event()
        self.refusal: RefusedError | None = None
        self.refused = 0
        self.failure: Exception | None = None

    def run(self) -> None:
        """Send until stopped."""
        try:
            while not self._stopped.is_set():
                if letters := self._spool.next(_AT_A_TIME, _BYTES):
                    self._try(letters)
                else:
                    self._spool.wait(_TICK)
        except Exception as error:  # whoever feeds the spool has to hear of it
            self.failure = error

    def stop(self) -> None:
        """End; what was not delivered stays in the spool."""
        self._stopped.set()
        self.join(1.0)

    def empty(self, seconds: float | None, tell: Callable[[int], None] = lambda left: None) -> bool:
        """Wait until everything is delivered; whether it is.

        Args:
            seconds: how long; None: as long as it takes.
            tell: is told how many increments are left.

        Raises:
            RefusedError: the service refuses everything.
            Exception: what has ended the thread.
        """
        deadline = None if seconds is None else time.monotonic() + seconds
        while self._spool.waiting:
            self.check()
            if self.refusal is not None:
                raise self.refusal
            if deadline is not None and time.monotonic() > deadline:
                return False
            tell(self._spool.waiting)
            self._spool.wait(_TICK)
        return True

    def check(self) -> None:
        """Raise what has ended the thread, if anything did."""
        if self.failure is not None:
            raise self.failure

    def _try(self, letters: list[Letter]) -> None:
        try:
            self._send(letters)
        except LinkDownError as error:
            self._stopped.wait(self._patience.failed(error))
        except RefusedError as error:
            self.refusal = error
            self._stopped.wait(self._patience.failed(error))
        else:
            self.refusal = None
            self._patience.worked()

    def _send(self, letters: list[Letter]) -> None:
        """Send increments, and one by one where one of them is refused for good."""
        content = "".join(f"{letter.content}\n" for letter in letters).encode()
        try:
            self._link.ask("POST", self._path, content=content, headers=NDJSON)
        except RefusedError as error:
            if error.status not in _NEVER:
                raise
            if len(letters) > 1:
                for letter in letters:
                    self._send([letter])
                return
            self.refused += 1
            self._spool.refuse(letters[0], str(error))
            self._tell(f"{letters[0].name} is refused and put aside: {error}")
            return
        self._spool.delivered(letters)


def check_map(link: Link, identifier: str, tell: Tell) -> Mapping[str, object] | None:
    """What a service says of a map; None if it cannot be reached now.

    Raises:
        RefusedError: there is no such map, or it may not be read.
    """
    try:
        answer = link.ask("GET", f"/v1/maps/{quote(identifier, safe='')}")
    except LinkDownError as error:
        tell(f"{error}; what is mapped is kept until it can")
        return None
    try:
        found = answer.json()
    except ValueError as error:
        raise InputError(f"{link.url} is no SymboSLAM service: it sends no JSON") from error
    if not isinstance(found, dict):
        raise InputError(f"{link.url} is no SymboSLAM service")
    return found


def paced(records: Iterable[Record], speed: float | None) -> Iterable[Record]:
    """Records at the times at which they were made, so many times faster; None: at once."""
    start = None
    for record in records:
        if speed is not None:
            start = start or (time.monotonic(), record.time)
            left = start[0] + (record.time - start[1]) / speed - time.monotonic()
            time.sleep(min(max(left, 0.0), 3600.0))
        yield record
