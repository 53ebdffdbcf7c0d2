"""RunningMap: one map in memory; takes batches and overrides, and keeps the store up to date.

Batches that arrive while others are worked on are taken together. Each is recorded first, in one
transaction with the landmarks that it changed; then the segments are classified, the store is
changed in one piece, and whoever sent the batches gets an answer. Should the process die before
that, the store is made from the records when the map is next opened.
"""

from __future__ import annotations

import asyncio
import contextlib
from collections import Counter, OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from time import perf_counter
from typing import Any, TypeVar

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.landmarks import ReadReport
from symboslam.engine.live import Change, LiveMap
from symboslam.engine.sightings import Name, Sightings
from symboslam.reasoning.knowledge import Knowledge
from symboslam.service.maps.events import Events
from symboslam.service.maps.observations import Observations, notes_on_ids
from symboslam.service.maps.records import MapRecord, Override, Records
from symboslam.service.maps.setting import Setting
from symboslam.service.maps.statements import GRAPHS, Statements
from symboslam.service.metrics import Metrics
from symboslam.service.store._base import BusyError, Document, MissingGraphError, Store
from symboslam.service.vocabulary import N_TRIPLES

T = TypeVar("T")
MOST_WAITING = 256
"""Batches that may wait for a map."""
_MOST_KEPT = 4
_TOGETHER = 64
"""Batches that are taken at a time."""


class BatchConflictError(Exception):
    """Another batch with the same id was taken before."""


@dataclass
class Waiting:
    """A batch that waits.

    Attributes:
        id: its identifier; the same is taken once.
        digest: of its content.
        observations: what is in it: observations to be merged, or landmarks to be set.
        done: its result, when it can be seen by SPARQL.
    """

    id: str
    digest: str
    observations: Observations | Setting
    done: asyncio.Future[dict[str, Any]] = field(repr=False)


class RunningMap:
    """A map that is kept up to date.

    Args:
        record: the map.
        live: its landmarks and segments.
        knowledge: what it is classified with.
        statements: what the store says of it.
        sightings: merges observations into its landmarks.
        records: where everything is kept.
        store: where it is stated.
        metrics: where batches are counted.
    """

    def __init__(
        self, record: MapRecord, live: LiveMap, knowledge: Knowledge, statements: Statements,
        sightings: Sightings, records: Records, store: Store, metrics: Metrics,
    ) -> None:  # fmt: skip
        self.record, self.live, self.knowledge = record, live, knowledge
        self.events = Events(record.revision)
        self.broken = False
        self._statements, self._sightings = statements, sightings
        self._records, self._store, self._metrics = records, store, metrics
        self._lock = asyncio.Lock()
        self._waiting: list[Waiting] = []
        self._worker: asyncio.Task[None] | None = None
        self._cache: OrderedDict[str, tuple[int, Any]] = OrderedDict()

    async def read(self, key: str, make: Callable[[LiveMap], T]) -> T:
        """Something made of the map as it is now; the last few are kept until it changes."""
        async with self._lock:
            revision, found = self._cache.pop(key, (-1, None))
            if revision != self.record.revision:
                found = await asyncio.to_thread(make, self.live)
            self._cache[key] = self.record.revision, found
            while len(self._cache) > _MOST_KEPT:
                self._cache.popitem(last=False)
            return found  # type: ignore[no-any-return]

    async def segment(self, name: str) -> EnvironmentMap:
        """One segment with the landmarks that have a say.

        Raises:
            UnknownNameError: no such segment.
        """
        async with self._lock:
            return await asyncio.to_thread(self.live.segment, name)

    async def state(self) -> None:
        """Make the store say what the records say, whatever it said before."""
        async with self._lock:
            await self._state()

    async def remember(self) -> None:
        """Know what the store says of a map that was opened."""
        async with self._lock:
            if self.record.stated == self.record.revision:
                overrides = await asyncio.to_thread(self._records.overrides, self.record.id)
                ended = datetime.fromisoformat(self.record.changed)
                await asyncio.to_thread(self._statements.everything, ended, overrides)

    async def take(
        self, batch: str, digest: str, observations: Observations | Setting
    ) -> dict[str, Any]:
        """Take a batch; it can be seen by SPARQL when this returns.

        Raises:
            BatchConflictError: another one with this id was taken.
            BusyError: too many wait.
            StoreError: it cannot be kept, or not be stated yet.
        """
        if len(self._waiting) >= MOST_WAITING:
            raise BusyError(f"{len(self._waiting)} batches of this map are waiting already")
        done: asyncio.Future[dict[str, Any]] = asyncio.get_running_loop().create_future()
        self._waiting.append(Waiting(batch, digest, observations, done))
        if self._worker is None or self._worker.done():
            self._worker = asyncio.create_task(self._work())
        return await asyncio.shield(done)

    async def override(self, segment: str, made: Override | None = None) -> list[Override]:
        """Take back what operators say of a segment, and state something else if it is given.

        Returns:
            What was changed, the new statement last; nothing where nothing was in force.
        """
        async with self._lock:
            await self._ready()
            record = self._next()
            known = await asyncio.to_thread(self._records.overrides, record.id)
            changed = [
                replace(each, undone=record.changed)
                for each in known
                if each.segment == segment and each.undone is None
            ]
            if made is not None:
                changed.append(replace(made, snapshot=self._statements.of_segment(segment)))
            if not changed:
                return []
            await asyncio.to_thread(self._records.keep_overrides, record, changed)
            self.record = record
            ended = datetime.fromisoformat(record.changed)
            await self._patch(*await asyncio.to_thread(self._statements.override, changed, ended))
            last = changed[-1]
            told = {"id": last.id, "environment": last.environment,
                    "operator": last.operator, "undone": last.undone is not None}  # fmt: skip
            self.events.publish(record.revision, {"segment": segment, "override": told})
            return changed

    async def remove(self) -> None:
        """Take the map out of the store and the records; what waits for it is refused.

        Were that cut short, the map would be there still, and be stated anew.
        """
        async with self._lock:
            await asyncio.to_thread(self._records.stated, self.record.id, -1)
            for name in reversed(GRAPHS):
                with contextlib.suppress(MissingGraphError):
                    await self._store.drop_graph(f"{self._statements.base}{name}")
            await asyncio.to_thread(self._records.remove, self.record.id)
        await self.stop()

    async def said(self) -> dict[str, str]:
        """What the store has to say, as N-Triples by the name of the graph; to compare with it."""
        async with self._lock:
            return await self._everything()

    async def stop(self) -> None:
        """Wait for what is being worked on, and end event streams."""
        if self._worker is not None:
            await asyncio.wait([self._worker])
        self.events.close()

    async def _work(self) -> None:
        while self._waiting:
            group, self._waiting = self._waiting[:_TOGETHER], self._waiting[_TOGETHER:]
            try:
                async with self._lock:
                    await self._take(group)
            except Exception as error:  # every sender is told; the map is opened anew
                for each in group:
                    if not each.done.done():
                        each.done.set_exception(error)

    async def _take(self, group: list[Waiting]) -> None:
        await self._ready()
        start = perf_counter()
        try:
            results, change = await asyncio.to_thread(self._merge, group)
        except BaseException:
            self.broken = True  # memory may be ahead of the records
            raise
        if change is not None:
            ended = datetime.fromisoformat(self.record.changed)
            await self._patch(*await asyncio.to_thread(self._statements.change, change, ended))
            self.events.publish(self.record.revision, told(change))
            observations = sum(each.observations.received for each in group)
            self._metrics.taken(len(group), observations, perf_counter() - start)
        for each in group:
            result = results[each.id, each.digest]
            if isinstance(result, BatchConflictError):
                each.done.set_exception(result)
            else:
                each.done.set_result(result)

    def _merge(
        self, group: list[Waiting]
    ) -> tuple[dict[tuple[str, str], dict[str, Any] | BatchConflictError], Change | None]:
        """Merge batches and record them; the result of each, and what changed."""
        record = self._next()
        results: dict[tuple[str, str], dict[str, Any] | BatchConflictError] = {}
        taken: dict[str, tuple[str, dict[str, Any]]] = {}
        names: dict[Name, str] = {}
        for each in group:
            known = taken.get(each.id) or self._records.batch(record.id, each.id)
            if known is None:
                found = each.observations
                if isinstance(found, Setting):
                    result = self._set(each.id, found, record)
                else:
                    result = self._observe(each.id, found, record, names)
                known = taken[each.id] = each.digest, result
            results[each.id, each.digest] = (
                known[1] if known[0] == each.digest else BatchConflictError(each.id)
            )
        if not taken:
            return results, None
        self.live.report = report_of(record)
        change = self.live.catch_up() or Change({})
        features = self.knowledge.features
        self._records.take(
            record,
            (
                (self.live.table.number(m.id), features[m.feature].iri, m)
                for _, m in change.landmarks.values()
                if m is not None
            ),
            names.items(),
            ((batch, digest, result) for batch, (digest, result) in taken.items()),
            (name for name, (_, after) in change.landmarks.items() if after is None),
        )
        self.record = record
        return results, change

    def _observe(
        self, batch: str, found: Observations, record: MapRecord, names: dict[Name, str]
    ) -> dict[str, Any]:
        """Merge one batch; its result."""
        new = 0
        for seen, name in found.landmarks:
            landmark = self._sightings.observe(seen, name)
            new += landmark.count == 1
            if name and seen.agent:
                names[seen.agent, name] = landmark.id
        add_left_out(record.left_out, found.report)
        return {
            "batch": batch,
            "received": found.received,
            "new": new,
            "merged": len(found.landmarks) - new,
            "left_out": _left_out(found.report),
            "notes": [
                *found.report.notes,
                *notes_on_ids(found.landmarks, record.options["merge_radius"]),
            ],
            "revision": record.revision,
        }

    def _set(self, batch: str, found: Setting, record: MapRecord) -> dict[str, Any]:
        """Set the landmarks of one batch; its result."""
        removed = sum(map(self._sightings.remove, found.removed))
        new = sum(each.id not in self.live.table for each in found.landmarks)
        for landmark in found.landmarks:
            self._sightings.put(landmark)
        add_left_out(record.left_out, found.report)
        return {
            "batch": batch,
            "received": found.received,
            "new": new,
            "changed": len(found.landmarks) - new,
            "removed": removed,
            "left_out": _left_out(found.report),
            "notes": list(found.report.notes),
            "revision": record.revision,
        }

    def _next(self) -> MapRecord:
        """The record at the revision that comes next."""
        now = datetime.now(UTC).isoformat(timespec="milliseconds")
        left = Counter(self.record.left_out)
        return replace(self.record, revision=self.record.revision + 1, changed=now, left_out=left)

    async def _ready(self) -> None:
        """Make up for what the store was not told."""
        if self.record.stated != self.record.revision:
            await self._state()

    async def _everything(self) -> dict[str, str]:
        ended = datetime.fromisoformat(self.record.changed)
        overrides = await asyncio.to_thread(self._records.overrides, self.record.id)
        return await asyncio.to_thread(self._statements.everything, ended, overrides)

    async def _state(self) -> None:
        found = await self._everything()
        base = self._statements.base
        if self.record.stated < 0:  # nobody knows of it yet
            for name in GRAPHS:
                await self._store.fill_graph(f"{base}{name}", found[name])
        else:
            await self._store.replace_graphs(
                {
                    f"{base}{name}": Document(N_TRIPLES, found[name].encode(), base)
                    for name in GRAPHS
                }
            )
        await self._stated()

    async def _patch(self, removed: str, added: str) -> None:
        await self._store.patch(removed, added)
        await self._stated()

    async def _stated(self) -> None:
        revision, absence = self.record.revision, self.live.config["absence"]
        await asyncio.to_thread(self._records.stated, self.record.id, revision, absence)
        self.record = replace(self.record, stated=revision, absence=absence)


UNKNOWN, OUTSIDE, OTHERS = "unknown ", "outside", "(others)"
_MOST_NAMES = 1000
_MOST_UNKNOWN = 20


def add_left_out(counts: Counter[str], report: ReadReport) -> None:
    """Count what a reader left out; of very many unknown names the later ones together."""
    for name, number in report.unknown.items():
        key = f"{UNKNOWN}{name}"
        full = len(counts) >= _MOST_NAMES and key not in counts
        counts[f"{UNKNOWN}{OTHERS}" if full else key] += number
    if report.outside:
        counts[OUTSIDE] += report.outside


def _left_out(report: ReadReport) -> dict[str, Any]:
    return {
        "outside": report.outside,
        "unknown": dict(report.unknown.most_common(_MOST_UNKNOWN)),
    }


def report_of(record: MapRecord) -> ReadReport:
    """What was left out of a map so far."""
    unknown = {k.removeprefix(UNKNOWN): n for k, n in record.left_out.items() if k != OUTSIDE}
    source = str(record.options.get("source", ""))
    attribution = str(record.options.get("attribution", ""))
    return ReadReport(
        source=source, unknown=Counter(unknown), outside=record.left_out[OUTSIDE],
        attribution=attribution,
    )  # fmt: skip


def told(change: Change) -> dict[str, Any]:
    """A change as plain values, for events."""
    m = change.changed
    segments = [] if m is None else [
        {
            "id": str(name),
            "environment": m.name_of(i),
            "probability": round(float(m.probability[i].max()), 6),
        }
        for i, name in enumerate(m.segment_id)
    ]  # fmt: skip
    return {
        "segments": segments,
        "gone": list(change.gone),
        "landmarks": len(change.landmarks),
        "everything": change.everything,
    }
