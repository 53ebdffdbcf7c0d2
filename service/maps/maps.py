"""Maps: made, opened when they are first needed, removed."""

from __future__ import annotations

import asyncio
import contextlib
import hashlib
from collections import OrderedDict
from dataclasses import asdict, replace
from datetime import UTC, datetime
from pathlib import Path
from secrets import token_hex
from typing import Any
from weakref import WeakValueDictionary

import numpy as np
import shapely
from shapely.geometry.base import BaseGeometry

from symboslam.engine.frame import Frame
from symboslam.engine.landmarks import Box, LandmarkMap
from symboslam.engine.live import LiveMap
from symboslam.engine.sightings import Sightings
from symboslam.engine.table import Landmark
from symboslam.engine.writers.atomic import atomic_file
from symboslam.engine.writers.vocabulary import MAPS
from symboslam.errors import (
    InputError,
    MissingExtraError,
    OntologyError,
    OutputError,
    ReasonerError,
    StoreError,
    UnknownNameError,
)
from symboslam.reasoning.knowledge import Knowledge
from symboslam.service.maps.records import MapRecord, Records
from symboslam.service.maps.running import RunningMap, add_left_out, report_of
from symboslam.service.maps.statements import Statements
from symboslam.service.metrics import Metrics
from symboslam.service.store._base import MissingGraphError, Store
from symboslam.service.vocabulary import N_TRIPLES

BUNDLED = "bundled"
MOST_CELLS = 192
"""Finest cells along each side that a kept map may have: 8 times the paper's."""
MOST_OPEN = 32
"""Maps that stay in memory though nobody uses them."""


class Maps:
    """All maps of a service.

    Args:
        records: where they are kept.
        store: where they are stated.
        ontologies: folder for the ontologies that maps use, taken from the store.
        metrics: where batches are counted.
    """

    def __init__(self, records: Records, store: Store, ontologies: Path, metrics: Metrics) -> None:
        self.records, self._store, self._ontologies = records, store, ontologies
        self._metrics = metrics
        self._running: WeakValueDictionary[str, RunningMap] = WeakValueDictionary()
        self._recent: OrderedDict[str, RunningMap] = OrderedDict()
        self._knowledge: dict[str, Knowledge] = {}
        self._opening: dict[str, asyncio.Lock] = {}
        self._catching_up: asyncio.Task[None] | None = None
        self.coming_and_going = asyncio.Lock()
        """Held while a map comes or goes, so that a backup finds all of it or nothing."""

    async def start(self) -> None:
        """State what the store was not told before the service stopped, in the background.

        Of maps that were being made there may be a part in the store: those are made up for first.
        """
        behind = []
        for identifier in await asyncio.to_thread(self.records.maps):
            record = await asyncio.to_thread(self.records.map, identifier)
            if record is not None and record.stated < 0:
                await (await self.open(identifier)).state()
            elif record is not None and not await self._is_stated(record):
                behind.append(identifier)

        async def catch_up() -> None:
            for identifier in behind:
                with contextlib.suppress(StoreError, UnknownNameError):
                    await (await self.open(identifier)).state()

        self._catching_up = asyncio.create_task(catch_up())

    async def stop(self) -> None:
        """Let running batches end."""
        if self._catching_up is not None:
            self._catching_up.cancel()
            await asyncio.wait([self._catching_up])
        for running in list(self._running.values()):
            await running.stop()

    async def knowledge(self, ontology: str) -> Knowledge:
        """The knowledge of an ontology: the bundled one, or that of a graph in the store.

        Raises:
            InputError: there is no such graph.
            OntologyError: it cannot be used.
        """
        if ontology not in self._knowledge:
            path = None if ontology == BUNDLED else self._ontologies / ontology
            self._knowledge[ontology] = await asyncio.to_thread(Knowledge.load, path)
        return self._knowledge[ontology]

    async def keep_ontology(self, ontology: str | None) -> str:
        """The name by which `knowledge` knows an ontology; a graph is copied as it is now.

        Raises:
            InputError: there is no such graph, or it cannot be used as an ontology.
        """
        if ontology is None or ontology == BUNDLED:
            return BUNDLED
        check_iri(ontology, "ontology")
        try:
            answer = await self._store.read_graph(ontology, N_TRIPLES, gzip=False)
        except MissingGraphError as error:
            problem = f"ontology: {error}; upload it to /graphs?graph=IRI, or say {BUNDLED!r}"
            raise InputError(problem) from error
        if isinstance(answer.body, bytes):
            data = answer.body
        else:
            with answer.body as file:
                data = await asyncio.to_thread(file.read)
        name = f"{hashlib.sha256(data).hexdigest()[:32]}.nt"

        path = self._ontologies / name

        def keep() -> bool:
            self._ontologies.mkdir(parents=True, exist_ok=True)
            new = not path.exists()
            with atomic_file(path) as file:
                file.write(data)
            return new

        try:
            new = await asyncio.to_thread(keep)
        except (OSError, OutputError) as error:
            raise StoreError(f"the ontology cannot be kept: {error}") from error
        try:
            await self.knowledge(name)
        except (OntologyError, ReasonerError, MissingExtraError) as error:
            if new:
                path.unlink()
            problem = str(error).replace(str(path), f"<{ontology}>")
            raise InputError(f"ontology <{ontology}>: {problem}") from error
        return name

    async def _is_stated(self, record: MapRecord) -> bool:
        """Whether the store is at a map's revision, as far as can be seen without reading it."""
        if record.stated != record.revision:
            return False
        return await self._store.has_graph(f"{base_of(record.id)}provenance")

    async def create(
        self, name: str, area: LandmarkMap, options: dict[str, Any], identifier: str | None = None
    ) -> RunningMap:
        """Make a map of an area; landmarks of the area become its first ones, each as it is.

        Args:
            name: what people call it.
            area: frame, box, surveyed area and report.
            options: ``ontology``, ``profile``, ``scheme``, ``settings``, ``merge_radius``,
                ``reasons``; and, if there are any, ``bbox`` (as it was sent), ``source``,
                ``attribution``.
            identifier: its id; a new one by default.

        Raises:
            InputError: an option is wrong.
            StoreError: it cannot be kept.
        """
        now = datetime.now(UTC).isoformat(timespec="milliseconds")
        record = MapRecord(
            id=identifier or token_hex(6), name=name, created=now, changed=now,
            area=_plain(area), options=options,
        )  # fmt: skip
        add_left_out(record.left_out, area.report)
        knowledge = await self.knowledge(options["ontology"])
        landmarks = _landmarks(area)
        running = await asyncio.to_thread(self._make, record, knowledge, landmarks, {})
        features = knowledge.features
        rows = [(n, features[each.feature].iri, each) for n, each in enumerate(landmarks)]
        async with self.coming_and_going:
            await asyncio.to_thread(self.records.add, record, rows)
            self._keep(running)
            await running.state()
        return running

    async def open(self, identifier: str) -> RunningMap:
        """A map, in memory from now on.

        Raises:
            UnknownNameError: there is no such map.
        """
        running = self._running.get(identifier)
        if running is not None and not running.broken:
            return self._keep(running)
        async with self._opening.setdefault(identifier, asyncio.Lock()):
            running = self._running.get(identifier)
            if running is not None and not running.broken:
                return running
            record = await asyncio.to_thread(self.records.map, identifier)
            if record is None:
                self._opening.pop(identifier, None)
                raise UnknownNameError(f"there is no map {identifier[:80]!r}")
            knowledge = await self.knowledge(record.options["ontology"])
            landmarks = [
                Landmark(feature=index, **rest)
                for iri, rest in await asyncio.to_thread(
                    lambda: list(self.records.landmarks(identifier))
                )
                if (index := knowledge.index_of(iri)) is not None
            ]
            names = await asyncio.to_thread(self.records.names, identifier)
            running = await asyncio.to_thread(self._make, record, knowledge, landmarks, names)
            await running.remember()
            return self._keep(running)

    def _keep(self, running: RunningMap) -> RunningMap:
        """Keep a map in memory, and of the others those that were used last or are in use."""
        identifier = running.record.id
        self._running[identifier] = running
        self._recent[identifier] = running
        self._recent.move_to_end(identifier)
        while len(self._recent) > MOST_OPEN:
            self._recent.popitem(last=False)
        return running

    async def remove(self, identifier: str) -> None:
        """Remove a map and what is stated of it.

        Raises:
            UnknownNameError: there is no such map.
        """
        running = await self.open(identifier)
        async with self.coming_and_going:
            await running.remove()
            self._running.pop(identifier, None)
            self._recent.pop(identifier, None)

    def _make(
        self,
        record: MapRecord,
        knowledge: Knowledge,
        landmarks: list[Landmark],
        names: dict[tuple[str, str], str],
    ) -> RunningMap:
        options = record.options
        area = replace(_area(record.area), report=report_of(record))
        live = LiveMap(
            area, knowledge, profile=options["profile"], scheme=options["scheme"],
            **options["settings"],
        )  # fmt: skip
        if live.config["cells"] > MOST_CELLS:
            cells = live.config["cells"]
            raise InputError(f"cells is {cells}; a map that is kept has at most {MOST_CELLS}")
        for landmark in landmarks:
            live.table.put(landmark)
        live.catch_up()
        if record.absence is not None:
            live.resume(record.absence)
        return RunningMap(
            record, live, knowledge,
            Statements(live, base_of(record.id), options["reasons"], record.name),
            Sightings(live.table, options["merge_radius"], names), self.records, self._store,
            self._metrics,
        )  # fmt: skip


def check_iri(text: str, what: str) -> None:
    """Check that a text is an absolute IRI.

    Raises:
        InputError: it is not.
    """
    import pyoxigraph

    try:
        pyoxigraph.NamedNode(text)
    except ValueError as error:
        raise InputError(f"{what}: {text[:80]!r} is not an absolute IRI: {error}") from error


def base_of(identifier: str) -> str:
    """IRI below which a map's own IRIs and graphs lie."""
    return f"{MAPS}{identifier}/"


def _landmarks(area: LandmarkMap) -> list[Landmark]:
    """The landmarks of a map, each seen once."""
    times = [None] * len(area) if area.time is None else area.time.tolist()
    agents = [None] * len(area) if area.agent is None else area.agent.tolist()
    return [
        Landmark(name, feature, x, y, confidence, time, agent, 1, confidence)
        for name, feature, x, y, confidence, time, agent in zip(
            area.id.tolist(), area.feature.tolist(), area.x.tolist(), area.y.tolist(),
            area.confidence.tolist(), times, agents, strict=True,
        )
    ]  # fmt: skip


def _plain(area: LandmarkMap) -> dict[str, Any]:
    """Where a map lies, as plain values."""
    surveyed = None if area.surveyed is None else area.surveyed.wkt
    return {"frame": asdict(area.frame), "bbox": list(area.bbox), "surveyed": surveyed}


def _area(values: dict[str, Any]) -> LandmarkMap:
    """A map without landmarks where `_plain` says."""
    west, south, east, north = values["bbox"]
    surveyed = values["surveyed"]
    return empty_map(
        Frame(values["frame"]["geographic"], tuple(values["frame"]["origin"])),
        (west, south, east, north),
        None if surveyed is None else shapely.from_wkt(surveyed),
    )


def empty_map(frame: Frame, bbox: Box, surveyed: BaseGeometry | None) -> LandmarkMap:
    """A map without landmarks."""
    none = np.zeros(0)
    return LandmarkMap(
        feature=none.astype(np.int32), x=none, y=none, confidence=none,
        static=none.astype(np.bool_), id=none.astype(np.str_), frame=frame, bbox=bbox,
        surveyed=surveyed,
    )  # fmt: skip
