"""Record: a mission in a folder, written as it goes, so that it can end at any moment.

What is there after each tick: the robots' logs as ``symboslam slam run`` reads them, their true
paths (TUM), coverage and events. docs/simulation.md lists the files.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any, TextIO

from symboslam.engine.writers.atomic import atomic_file
from symboslam.errors import OutputError
from symboslam.sim_bridge.mission.journal import Journal, Seen
from symboslam.sim_bridge.mission.mission import Listener, Tick
from symboslam.sim_bridge.mission.team import Team
from symboslam.sim_bridge.worlds.truth import landmarks_geojson, write_geojson, zones_geojson
from symboslam.sim_bridge.worlds.world_file import write_world

HEADS = {
    "odometry.csv": "time,x,y,heading,robot",
    "detections.csv": "time,range,bearing,class,confidence,sigma_range,sigma_bearing,robot",
    "identity.csv": "time,robot,object",
    "starts.csv": "robot,x,y,heading",
    "coverage.csv": "time,coverage,formula,found,dispersion",
}
OURS = {
    *HEADS, "fixes.csv", "events.ndjson", "world.json", "config.json", "metrics.json",
    "map.geojson", "landmarks.geojson", "zones.geojson", "objects.geojson",
}  # fmt: skip
"""Names of the files that a record may hold, besides ``truth-*.tum``."""


def check_folder(folder: Path) -> None:
    """Make a folder for a record, or take an empty one or an old record.

    Raises:
        OutputError: it holds other files, or cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        strange = [
            f.name
            for f in sorted(folder.iterdir())
            if f.name not in OURS and not (f.name.startswith("truth-") and f.suffix == ".tum")
        ]
    except OSError as error:
        raise OutputError(f"{folder}: {error.strerror or error}") from error
    if strange:
        raise OutputError(f"{folder} holds other files, such as {strange[0]}: give a new folder")


class Recorder(Listener):
    """Writes a mission into a folder, row by row.

    Args:
        folder: new, empty or an old record, which is replaced.
        config: what the mission was started with.

    Raises:
        OutputError: the folder holds other files, or cannot be written.
    """

    def __init__(self, folder: Path, config: Mapping[str, Any]) -> None:
        check_folder(folder)
        self.folder, self._config = folder, dict(config)
        self._files: dict[str, TextIO] = {}
        self._last = -1.0

    def begin(self, team: Team) -> None:
        """The world, the settings, the starts, and heads of all tables."""
        for old in self.folder.iterdir():
            old.unlink()
        write_world(team.world, self.folder / "world.json")
        write_geojson(zones_geojson(team.world), self.folder / "zones.geojson")
        write_geojson(landmarks_geojson(team.world), self.folder / "objects.geojson")
        self.write_json("config.json", self._config | asdict(team.settings))
        for name, head in HEADS.items():
            self._line(name, head)
        if team.settings.bridge.gps is not None:
            self._line("fixes.csv", "time,x,y,sigma,robot")
            self._sigma = team.settings.bridge.gps.sigma
        for agent in team.agents:
            x, y, heading = agent.journal.start
            self._line("starts.csv", f"{agent.name},{x:.4f},{y:.4f},{heading:.6f}")
        self._flush()

    def rows(self, journal: Journal, seen: list[Seen]) -> None:
        """A row of odometry, and what was seen."""
        time, (x, y, heading) = journal.odometry[-1]
        self._line("odometry.csv", f"{time:g},{x:.4f},{y:.4f},{heading:.6f},{journal.name}")
        _, (x, y, heading) = journal.truth[-1]
        half = heading / 2
        self._line(
            f"truth-{journal.name.replace(' ', '_')}.tum",
            f"{time:g} {x:.4f} {y:.4f} 0 0 0 {math.sin(half):.7f} {math.cos(half):.7f}",
        )
        for one in seen:
            self._line(
                "detections.csv",
                f"{one.time:g},{one.range:.3f},{one.bearing:.5f},{one.kind},"
                f"{one.confidence:.3f},{one.sigma[0]:.3f},{one.sigma[1]:.5f},{journal.name}",
            )
            self._line("identity.csv", f"{one.time:g},{journal.name},{one.thing}")
        if journal.fixes and journal.fixes[-1][0] == time:
            _, x, y = journal.fixes[-1]
            self._line("fixes.csv", f"{time:g},{x:.3f},{y:.3f},{self._sigma:g},{journal.name}")

    def tick(self, tick: Tick) -> None:
        """A row of coverage each second."""
        if tick.time - self._last >= 1 - 1e-9 or self._last < 0:
            self._last = tick.time
            self._line(
                "coverage.csv",
                f"{tick.time:g},{tick.coverage:.5f},{tick.formula:.5f},{tick.found},"
                f"{tick.dispersion:.2f}",
            )
        self._flush()

    def event(self, time: float, robot: str, kind: str, text: str) -> None:
        """A line of JSON."""
        line = {"time": time, "robot": robot or None, "event": kind, "text": text}
        self._line("events.ndjson", json.dumps(line, ensure_ascii=False))
        self._flush()

    def write_json(self, name: str, document: Mapping[str, Any]) -> None:
        """A file of its own, whole or not at all."""
        with atomic_file(self.folder / name) as stream:
            stream.write((json.dumps(document, indent=2, ensure_ascii=False) + "\n").encode())

    def close(self) -> None:
        """Close all tables."""
        for file in self._files.values():
            file.close()
        self._files.clear()

    def _line(self, name: str, text: str) -> None:
        try:
            if name not in self._files:
                self._files[name] = (self.folder / name).open("a", encoding="utf-8")
            self._files[name].write(text + "\n")
        except OSError as error:
            raise OutputError(f"{self.folder / name}: {error.strerror or error}") from error

    def _flush(self) -> None:
        try:
            for file in self._files.values():
                file.flush()
        except OSError as error:
            raise OutputError(f"{self.folder}: {error.strerror or error}") from error
