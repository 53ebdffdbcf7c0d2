"""Finished: a mission of the table as it lies in its folder, read only when it is drawn."""

from __future__ import annotations

import csv
import json
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from symboslam.errors import InputError
from symboslam.sim_bridge.search.area import Floats
from symboslam.sim_bridge.search.paper_areas import AREAS, PaperArea
from symboslam.sim_bridge.table.area_run import FAILURE, metrics_of
from symboslam.sim_bridge.table.plan import MANY

if TYPE_CHECKING:
    from symboslam.sim_bridge.worlds.world import World


@dataclass(frozen=True)
class Finished:
    """A finished mission.

    Attributes:
        folder: where it lies.
        metrics: its figures.
    """

    folder: Path
    metrics: dict[str, Any]

    @property
    def run(self) -> dict[str, Any]:
        """Plan, machine, times, memory."""
        found: dict[str, Any] = self.metrics["run"]
        return found

    @property
    def plan(self) -> dict[str, Any]:
        """How it was flown."""
        found: dict[str, Any] = self.run["plan"]
        return found

    @property
    def name(self) -> str:
        """Of its row."""
        return str(self.plan["name"])

    @property
    def paper(self) -> PaperArea | None:
        """The paper's area of that name, if it is one."""
        return AREAS.get(self.name)

    @property
    def short(self) -> bool:
        """Whether its robots had another time than the paper's."""
        return self.paper is not None and self.plan["minutes"] != self.paper.minutes

    @cached_property
    def world(self) -> World:
        """The world."""
        from symboslam.sim_bridge.worlds.world_file import read_world

        return read_world(self.folder / "record" / "world.json")[0]

    @cached_property
    def coverage(self) -> Floats:
        """(n, 5) time, share that was seen, A'/A, objects found, dispersion."""
        return _numbers(self.folder / "record" / "coverage.csv")

    @cached_property
    def errors(self) -> Floats:
        """(n, 4) time and the errors of ``along``."""
        return _numbers(self.folder / "errors.csv")

    @cached_property
    def true_paths(self) -> dict[str, Floats]:
        """Robot -> (n, 4) time, x, y and heading where it truly was."""
        found = {}
        for path in sorted((self.folder / "record").glob("truth-*.tum")):
            rows = np.loadtxt(path, ndmin=2)
            heading = 2 * np.arctan2(rows[:, 6], rows[:, 7])
            name = path.stem.removeprefix("truth-").replace("_", " ")
            found[name] = np.column_stack([rows[:, :3], heading])
        return found

    @cached_property
    def paths(self) -> dict[str, Floats]:
        """Robot -> (n, 3) time, x and y by the map; robots that it lost are left out."""
        found: dict[str, list[list[float]]] = {}
        with (self.folder / "paths.csv").open(encoding="utf-8", newline="") as stream:
            for row in csv.DictReader(stream):
                at = [float(row[name]) for name in ("time", "x", "y")]
                found.setdefault(row["robot"], []).append(at)
        return {name: np.array(rows) for name, rows in found.items()}

    @cached_property
    def landmarks(self) -> dict[str, Any]:
        """The landmarks of the map, as GeoJSON."""
        text = (self.folder / "record" / "landmarks.geojson").read_text(encoding="utf-8")
        found: dict[str, Any] = json.loads(text)
        return found

    @cached_property
    def landmark_xy(self) -> Floats:
        """(L, 2) where they are."""
        at = [f["geometry"]["coordinates"][:2] for f in self.landmarks["features"]]
        return np.array(at, float).reshape(-1, 2)

    @cached_property
    def landmark_seen(self) -> Floats:
        """(L,) seconds when each was first in view."""
        with (self.folder / "seen.csv").open(encoding="utf-8", newline="") as stream:
            times = {row["landmark"]: float(row["time"]) for row in csv.DictReader(stream)}
        ids = [str(f.get("id", "")) for f in self.landmarks["features"]]
        return np.array([times.get(name, np.inf) for name in ids])

    @cached_property
    def object_seen(self) -> Floats:
        """(n,) seconds when each object of the world was truly ranged first."""
        first: dict[str, float] = {}
        with (self.folder / "record" / "identity.csv").open(encoding="utf-8", newline="") as stream:
            for row in csv.DictReader(stream):
                time = float(row["time"])
                first[row["object"]] = min(first.get(row["object"], np.inf), time)
        return np.array([first.get(o.id, np.inf) for o in self.world.objects], float)

    def coverage_at(self, seconds: float) -> float:
        """Share that was seen by then; of a mission that ended before, at its end."""
        upto = int(np.searchsorted(self.coverage[:, 0], seconds + 1e-9, side="right"))
        return float(self.coverage[max(upto - 1, 0), 1])


def finished_in(folder: Path, names: Sequence[str] = ()) -> list[Finished]:
    """The finished missions of a folder, in the paper's order, others after them.

    Args:
        folder: of the table.
        names: of those that are wanted; none for all.

    Raises:
        InputError: there is none, or one that is named is not there.
    """
    found = {path.parent.name: path.parent for path in folder.glob("*/metrics.json")}
    missing = [name for name in names if name not in found]
    if missing or not found:
        raise InputError(f"{folder}: no finished mission{' of ' + missing[0] if missing else ''}")
    order = {name: n for n, name in enumerate((*AREAS, MANY))}
    wanted = sorted(names or found, key=lambda name: (order.get(name, len(order) - 1.5), name))
    return [Finished(found[name], metrics_of(found[name])) for name in wanted]


def failures_in(folder: Path) -> dict[str, str]:
    """Name -> what went wrong, of the missions of a folder that failed and did not end since."""
    return {
        path.parent.name: path.read_text(encoding="utf-8").partition("\n")[0]
        for path in sorted(folder.glob(f"*/{FAILURE}"))
        if not (path.parent / "metrics.json").exists()
    }


def _numbers(path: Path) -> Floats:
    return np.asarray(np.genfromtxt(path, delimiter=",", skip_header=1, ndmin=2), float)
