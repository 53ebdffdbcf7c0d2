"""ControlAgent: makes one map of what several robots send, and keeps it in a service.

It keeps nothing itself: the increments are in the service, and so it begins anew at any time.
"""

from __future__ import annotations

import json
import math
import threading
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from secrets import token_hex
from typing import TYPE_CHECKING, Any, Protocol
from urllib.parse import quote

from symboslam.engine.slam.increment import EdgeIncrement
from symboslam.engine.slam.slam_map import SlamMap
from symboslam.errors import InputError
from symboslam.sim_bridge.agents.link import Link, LinkDownError, Patience, Tell
from symboslam.sim_bridge.agents.watch import Run, Watch

if TYPE_CHECKING:
    import httpx

_AT_A_TIME = 1000
_LONGEST_WAIT = 20.0
"""Seconds that the service may let us wait for increments; it allows 25."""
_SURE = 0.02
"""How far the confidence of a landmark may move without being sent."""


class Collective(Protocol):
    """What an agent needs of `symboslam.engine.slam.control.CollectiveMap`."""

    @property
    def notes(self) -> list[str]:
        """What is wrong with what came, one sentence each."""

    def add(self, increment: EdgeIncrement, /) -> None:
        """Take an increment, in any order and any number of times."""

    def solve(self) -> SlamMap:
        """The map of everything so far."""


@dataclass(frozen=True)
class ControlSettings:
    """How a map is kept.

    Attributes:
        name: of the agent; its landmarks have it as ``agent`` and before their ids.
        every: seconds between solutions.
        tolerance: metres that a landmark may move without being sent; at the end all is sent.
        patience: seconds that an increment may be late until it is told.
        silent: seconds without a word after which a robot counts as gone.
        robots: so many there are at least.
    """

    name: str = "control"
    every: float = 5.0
    tolerance: float = 0.1
    patience: float = 30.0
    silent: float = 60.0
    robots: int = 1


@dataclass(frozen=True)
class Placed:
    """A landmark as the service has it."""

    kind: str
    x: float
    y: float
    confidence: float
    sightings: int


class ControlAgent:
    """Keeps one map.

    Args:
        link: to the service.
        identifier: id of the map.
        classes: names of the classes, in the order of the collective map's.
        collective: makes one map of increments; empty.
        settings: how.
        tell: is told what is odd.
    """

    def __init__(
        self, link: Link, identifier: str, classes: Sequence[str], collective: Collective,
        settings: ControlSettings, tell: Tell,
    ) -> None:  # fmt: skip
        self._link, self._classes, self._collective = link, classes, collective
        self._path = f"/v1/maps/{quote(identifier, safe='')}"
        self._settings, self._tell = settings, tell
        self._patience = Patience(tell)
        self._watch = Watch(settings.patience, settings.silent)
        self._told: set[str] = set()
        self._left_out: Any = None
        self._cursor = 0
        self._there: dict[str, Placed | None] = {}
        """What the service has of us; None: we do not know where."""

    def run(self, once: bool = False) -> None:
        """Keep the map; with ``once`` until all robots have ended.

        Raises:
            RefusedError: there is no such map, or the service lets us not.
        """
        self._there = dict.fromkeys(self._ours())
        new, looked = False, -math.inf
        while self.fetch(0.0):  # all there is: half a map would take landmarks back
            new = True
        while True:
            new = self.fetch(min(self._settings.every, _LONGEST_WAIT)) or new
            if time.monotonic() - looked < self._settings.every:
                continue
            looked = time.monotonic()
            if new:
                self.publish()
                new = False
            runs = self.robots()
            for line in self._watch.look(runs, time.monotonic()):
                self._tell(line)
            if once and self._watch.ended(runs, self._settings.robots) and not self.fetch(0.0):
                self.publish(final=True)
                return

    def fetch(self, seconds: float) -> bool:
        """Hand over what has arrived, waiting so long for the first; whether there was anything."""
        found = False
        while True:
            given = {"after": self._cursor, "limit": _AT_A_TIME, "wait": 0.0 if found else seconds}
            answer = self._ask("GET", "/increments", seconds=seconds, params=given)
            lines = answer.text.split("\n")[:-1]
            for line in lines:
                value = json.loads(line)
                try:
                    self._collective.add(EdgeIncrement.from_json(value["increment"]))
                except InputError as error:
                    self._say(f"an increment is left out: {error}")
                self._cursor = value["number"]
            found = found or bool(lines)
            if not lines or seconds == 0.0:
                return found
            seconds = 0.0

    def robots(self) -> list[Run]:
        """What the service knows of robots."""
        found: list[Run] = self._ask("GET", "/robots").json()
        return found

    def publish(self, final: bool = False) -> None:
        """Solve, and send what is different from what the service has.

        Args:
            final: send also what has hardly changed.
        """
        solved = self._collective.solve()
        for line in (*solved.doubts, *solved.notes, *self._collective.notes):
            self._say(line)
        wanted = self._placed(solved)
        changed = {name: each for name, each in wanted.items() if self._is_news(name, each, final)}
        gone = [name for name in self._there if name not in wanted]
        for part, removed in _parts(list(changed), gone):
            self._send({name: changed[name] for name in part}, removed)

    def _placed(self, solved: SlamMap) -> dict[str, Placed]:
        """The landmarks of a solution by their ids in the service."""
        m = solved.landmarks
        return {
            f"{self._settings.name}/{m.id[i]}": Placed(
                self._classes[int(m.feature[i])], round(float(m.xy[i, 0]), 3),
                round(float(m.xy[i, 1]), 3), min(max(round(float(m.confidence[i]), 4), 1e-4), 1.0),
                max(int(m.sightings[i]), 1),
            )
            for i in range(len(m))
            if math.isfinite(m.xy[i, 0]) and math.isfinite(m.xy[i, 1])
        }  # fmt: skip

    def _is_news(self, name: str, now: Placed, final: bool) -> bool:
        was = self._there.get(name)
        if was is None or final:
            return was != now
        moved = math.hypot(was.x - now.x, was.y - now.y)
        unsure = abs(was.confidence - now.confidence)
        return was.kind != now.kind or moved > self._settings.tolerance or unsure > _SURE

    def _send(self, changed: dict[str, Placed], gone: list[str]) -> None:
        wanted = [
            {
                "id": name, "class": each.kind, "xy": [each.x, each.y],
                "confidence": each.confidence, "sightings": each.sightings,
                "agent": self._settings.name,
            }
            for name, each in changed.items()
        ]  # fmt: skip
        headers = {"Idempotency-Key": token_hex(16)}  # the same for each try, for no other batch
        answer = self._ask(
            "PATCH", "/landmarks", json={"set": wanted, "removed": gone}, headers=headers
        ).json()
        for name in gone:
            del self._there[name]
        self._there.update(changed)
        left = answer["left_out"]
        if left != self._left_out and (left["outside"] or left["unknown"]):
            unknown = ", ".join(left["unknown"]) or "none"
            self._tell(
                f"{left['outside']} landmarks are outside the map; classes that the map does not"
                f" know: {unknown}"
            )
            self._left_out = left

    def _ours(self) -> list[str]:
        """Ids of the landmarks in the service that an agent of our name has set."""
        found = self._ask("GET", "/landmarks", params={"limit": 1_000_000}).json()
        return [
            each["id"]
            for each in found["features"]
            if each["properties"].get("agent") == self._settings.name
            and each["id"].startswith(f"{self._settings.name}/")
        ]

    def _ask(self, method: str, path: str, **given: Any) -> httpx.Response:
        """Ask until there is an answer."""
        while True:
            try:
                answer = self._link.ask(method, self._path + path, **given)
            except LinkDownError as error:
                time.sleep(self._patience.failed(error))
            else:
                self._patience.worked()
                return answer

    def _say(self, line: str) -> None:
        """Tell something, but not again and again."""
        if line not in self._told:
            self._told.add(line)
            self._tell(line)


def _parts(changed: list[str], gone: list[str]) -> Iterator[tuple[list[str], list[str]]]:
    """Ids to set and ids to remove, so many at a time."""
    for start in range(0, max(len(changed), len(gone)), _AT_A_TIME):
        part = slice(start, start + _AT_A_TIME)
        yield changed[part], gone[part]


def keep(agents: dict[str, ControlAgent], once: bool, tell: Tell) -> None:
    """Keep several maps at once; one that cannot be kept does not disturb the others.

    Raises:
        SymboSlamError: why the first could not be kept, when all have ended.
    """
    failures: list[Exception] = []

    def run(name: str, agent: ControlAgent) -> None:
        try:
            agent.run(once)
        except Exception as error:  # told to whoever waits for all of them
            failures.append(error)
            tell(f"map {name} is kept no longer: {error}")

    threads = [threading.Thread(target=run, args=each, daemon=True) for each in agents.items()]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if failures:
        raise failures[0]
