"""The maps that the service is measured on: sample towns in a data folder, made once and kept."""

from __future__ import annotations

import asyncio
import contextlib
import os
import random
import shutil
from collections.abc import Iterator
from datetime import UTC, datetime, timedelta
from hashlib import sha256
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
AGENTS = ("robot-1", "robot-2", "robot-3")
START = datetime(2026, 3, 2, 10, tzinfo=UTC)
_MADE_BY = (
    "engine", "ontology", "reasoning/bundled", "service/maps/maps.py",
    "service/maps/statements.py", "bench/maps.py",
)  # fmt: skip


def cache() -> Path:
    """The folder for what is made or fetched once."""
    base = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(base) / "symboslam" / "bench"


def maps(towns: int, size_m: float) -> Path:
    """A folder with ``data``, as ``symboslam serve`` keeps it, and ``maps.nq``, the same as a file.

    Args:
        towns: how many maps besides ``town`` and ``town-paper``, of which the examples speak.
        size_m: side of each of them in metres.
    """
    folder = cache() / f"maps-{towns}-{size_m:g}-{_version()}"
    if not folder.is_dir():
        for other in folder.parent.glob(f"maps-{towns}-{size_m:g}-*"):
            shutil.rmtree(other)  # of another version
        part = folder.with_name(f".{folder.name}-{os.getpid()}")
        try:
            asyncio.run(_make(part, towns, size_m))
            with contextlib.suppress(OSError):  # another process was faster
                part.rename(folder)
        finally:
            shutil.rmtree(part, ignore_errors=True)
    return folder


def sample(seed: int, size_m: float) -> dict[str, Any]:
    """A sample town as three robots saw it; its east was not looked at."""
    from symboslam.engine.sample import sample_area

    town = sample_area(seed, size_m)
    chance = random.Random(seed)
    for number, feature in enumerate(town["features"]):
        feature["properties"] |= {
            "agent": AGENTS[number % len(AGENTS)],
            "time": (START + timedelta(seconds=number)).isoformat(),
            "confidence": round(chance.uniform(0.5, 1.0), 3),
        }
    unknown = {"type": "Point", "coordinates": [149.1, -35.2]}
    saucer = {"type": "Feature", "geometry": unknown, "properties": {"class": "FlyingSaucer"}}
    town["features"] += [saucer, saucer]
    west, south, east, north = town["bbox"]
    middle = west + (east - west) * 0.875
    ring = [[west, south], [middle, south], [middle, north], [west, north], [west, south]]
    town["surveyed"] = {"type": "Polygon", "coordinates": [ring]}
    return town


async def _make(folder: Path, towns: int, size_m: float) -> None:
    """Make the maps as the service does, and write down what it states."""
    import pyoxigraph

    from symboslam.engine.readers import read_landmarks
    from symboslam.service.database import open_database
    from symboslam.service.maps.maps import Maps
    from symboslam.service.maps.records import Override, Records
    from symboslam.service.metrics import Metrics
    from symboslam.service.settings import Settings
    from symboslam.service.store.oxigraph import OxigraphStore
    from symboslam.service.store.seed import seed

    data = folder / "data"
    data.mkdir(parents=True)
    settings: dict[str, Any] = {"data": data, "workers": 1}
    store = OxigraphStore(Settings(**settings))
    await store.start()
    await seed(store)
    found = Maps(Records(open_database(data)), store, data / "ontologies", Metrics())
    knowledge = await found.knowledge("bundled")
    for name, profile, number, size in _wanted(towns, size_m):
        area = read_landmarks(sample(number, size), knowledge)
        options: dict[str, Any] = {
            "ontology": "bundled", "profile": profile, "scheme": None, "settings": {},
            "merge_radius": 5.0, "reasons": 8, "source": "sample", "attribution": "",
        }  # fmt: skip
        running = await found.create(name, area, options, identifier=name)
        for place, given in (("3-11-11", "Industrial"), ("3-11-10", "CommunityFacility")):
            if name == "town":
                kind = f"https://w3id.org/symboslam#{given}"
                made = Override(given, place, kind, "Alice", "I was there.", "2026-03-02T12:05:00Z")
                await running.override(made.segment, made)
    await found.stop()
    await store.stop()
    with (folder / "maps.nq").open("wb") as file:
        pyoxigraph.Store.read_only(str(data / "store")).dump(file, pyoxigraph.RdfFormat.N_QUADS)


def _wanted(towns: int, size_m: float) -> Iterator[tuple[str, str, int, float]]:
    """Name, profile, seed and side of each map."""
    yield "town", "default", 7, 3000.0
    yield "town-paper", "paper", 7, 3000.0
    for number in range(towns):
        yield f"area-{number + 1}", "default", 100 + number, size_m


def _version() -> str:
    """Changes with whatever may change what is made."""
    files = sorted(
        path
        for name in _MADE_BY
        for path in ([ROOT / name] if (ROOT / name).is_file() else (ROOT / name).rglob("*"))
        if path.suffix in (".py", ".ttl", ".json")
    )
    return sha256(b"".join(path.read_bytes() for path in files)).hexdigest()[:12]
