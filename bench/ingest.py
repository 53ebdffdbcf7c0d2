"""Robots that send what they see to a map of a town, and when SPARQL shows it."""

from __future__ import annotations

import json
import math
import os
import statistics
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from datetime import UTC, datetime
from http.client import HTTPException
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from bench.measure import table
from bench.servers import ADMIN, SELECT, Server, symboslam

ROBOTS = 20
BATCH = 50  # observations; each robot sends a batch a second
SPEED = 1.5  # metres in a second
NOISE = 1.0  # metres
_PATIENCE = 30.0  # seconds
_TICKS = os.sysconf("SC_CLK_TCK")
_PAGE = os.sysconf("SC_PAGE_SIZE")
_VISIBLE = """
PREFIX sosa: <http://www.w3.org/ns/sosa/>
PREFIX prov: <http://www.w3.org/ns/prov#>
PREFIX xsd: <http://www.w3.org/2001/XMLSchema#>
ASK {{
  GRAPH <{base}landmarks> {{ ?seen sosa:resultTime "{time}"^^xsd:dateTime }}
  GRAPH <{base}provenance> {{
    ?run prov:endedAtTime ?ended FILTER (?ended >= "{time}"^^xsd:dateTime)
  }}
}}"""


@dataclass
class Town:
    """A map to send to.

    Attributes:
        id: of the map.
        xy: metres of its landmarks, seen from the middle.
        tags: of each.
        metre: degrees in a metre, east and north.
        middle: longitude and latitude.
    """

    id: str
    xy: NDArray[np.float64]
    tags: list[dict[str, str]]
    metre: tuple[float, float]
    middle: tuple[float, float]


@dataclass
class Told:
    """What was measured.

    Attributes:
        visible: seconds from before the POST to the answer that shows it, of each batch.
        posted: seconds of the POST alone.
        late: the most that a batch was sent after its time, in seconds.
        again: how often it had to be asked again, because it was not visible yet.
        failed: batches that were not taken.
    """

    visible: list[float] = field(default_factory=list)
    posted: list[float] = field(default_factory=list)
    late: float = 0.0
    again: int = 0
    failed: list[str] = field(default_factory=list)


def ingest(size_m: float, seconds: int) -> str:
    """Robots on their ways, then observations from all over the map.

    Args:
        size_m: side of the town.
        seconds: how long each.
    """
    rows = []
    for name, choose in (("along 20 ways", along_ways), ("all over the map", anywhere)):
        with (
            tempfile.TemporaryDirectory() as folder,
            symboslam(Path(folder) / "data") as server,
        ):
            town = _town(server, size_m)
            told, rates, memory, processor = _drive(server, town, choose(town), seconds)
        for problem in told.failed:
            print(problem, file=sys.stderr)
        cuts = statistics.quantiles(told.visible, n=20)
        rows.append(
            [name, f"{len(town.xy):,}", f"{rates:.0f}", _ms(statistics.median(told.visible)),
             _ms(cuts[-1]), _ms(max(told.visible)), _ms(statistics.median(told.posted)),
             _ms(told.late), told.again, len(told.failed), *(f"{mb:.0f}" for mb in memory),
             f"{processor:.2f}"]
        )  # fmt: skip
    head = (
        "observations", "landmarks", "a second", "p50 ms", "p95 ms", "max ms", "of it POST, p50 ms",
        "sent late by up to ms", "asked again", "failed", "MB at half", "MB at the end",
        "processors busy",
    )  # fmt: skip
    return (
        f"## Live observations ({seconds} s)\n\n"
        f"{ROBOTS} robots send a batch of {BATCH} observations a second each, with {NOISE:g} m of "
        "noise, one robot after the other. Along their ways they drive "
        f"{SPEED:g} m/s and see the landmarks that are nearest. The time is from before the POST "
        "to the answer of a SPARQL query that shows the batch and the classification after it. "
        "Memory is the resident memory of the server and its workers, added up, pages that they "
        "share counted more than once; processors are theirs, too.\n\n" + table(head, rows)
    )


def along_ways(town: Town) -> Callable[[int, int], NDArray[np.int64]]:
    """The landmarks nearest to a robot at a second; it drives straight, back at the border."""
    from scipy.spatial import cKDTree

    tree = cKDTree(town.xy)
    chance = np.random.default_rng(3)
    start = town.xy[chance.choice(len(town.xy), ROBOTS)]
    heading = chance.uniform(0, 2 * math.pi, ROBOTS)
    low, high = town.xy.min(axis=0), town.xy.max(axis=0)

    def nearest(robot: int, second: int) -> NDArray[np.int64]:
        way = SPEED * second * np.array([math.cos(heading[robot]), math.sin(heading[robot])])
        span = high - low
        folded = np.mod(start[robot] + way - low, 2 * span)
        here = low + np.where(folded > span, 2 * span - folded, folded)
        found: NDArray[np.int64] = tree.query(here, k=min(BATCH, len(town.xy)))[1]
        return found

    return nearest


def anywhere(town: Town) -> Callable[[int, int], NDArray[np.int64]]:
    """Landmarks from all over the map, whatever robot and second."""
    chance = np.random.default_rng(4)
    rows = [chance.choice(len(town.xy), BATCH) for _ in range(997)]
    return lambda robot, second: rows[(second * ROBOTS + robot) % len(rows)]


def _town(server: Server, size_m: float) -> Town:
    """Put a sample town into the service."""
    from symboslam.engine.sample import sample_area

    found = sample_area(7, size_m)
    status, body = server.send(
        "POST", "/v1/jobs?name=town&format=geojson", json.dumps(found).encode(), ADMIN, 600
    )
    if status != 202:
        raise RuntimeError(f"the job was refused: {status} {body[:300]!r}")
    job = json.loads(body)
    while job["state"] == "running":
        time.sleep(0.05)
        job = json.loads(server.send("GET", f"/v1/jobs/{job['id']}")[1])
    if job["state"] != "done":
        raise RuntimeError(f"the job failed: {job['problem']}")
    west, south, east, north = found["bbox"]
    middle = (west + east) / 2, (south + north) / 2
    metre = (east - west) / size_m, (north - south) / size_m
    lonlat = np.array([each["geometry"]["coordinates"] for each in found["features"]])
    tags = [each["properties"]["tags"] for each in found["features"]]
    return Town(job["map"], (lonlat - middle) / metre, tags, metre, middle)


def _drive(
    server: Server, town: Town, choose: Callable[[int, int], NDArray[np.int64]], seconds: int
) -> tuple[Told, float, tuple[float, float], float]:
    """Let all robots send; what was told, observations a second, megabytes, processors."""
    told, lock = Told(), threading.Lock()
    base = f"https://w3id.org/symboslam/map/{town.id}/"
    begin = time.perf_counter() + 0.5

    def run(robot: int) -> None:
        try:
            send(robot)
        except (OSError, RuntimeError, HTTPException) as error:
            with lock:
                told.failed.append(str(error))

    def send(robot: int) -> None:
        own = Server(server.name, server.port, server.path, server.process)
        noise = np.random.default_rng(robot)
        for second in range(seconds):
            due = begin + second + robot / ROBOTS
            body = _batch(town, choose(robot, second), noise)
            time.sleep(max(due - time.perf_counter(), 0))
            seen = _moment()
            body = body.replace(b"MOMENT", seen.encode())
            start = time.perf_counter()
            key = {"Content-Type": "application/x-ndjson", "Idempotency-Key": f"{robot}-{second}"}
            path = f"/v1/maps/{town.id}/observations?agent=robot-{robot}"
            status, answer = own.send("POST", path, body, {**ADMIN, **key})
            posted = time.perf_counter() - start
            if status != 200:
                with lock:
                    told.failed.append(f"{status} {answer[:200]!r}")
                continue
            asked, question = 0, _VISIBLE.format(base=base, time=seen)
            while not json.loads(own.ask(question, SELECT))["boolean"]:
                asked += 1
                if time.perf_counter() > start + _PATIENCE:
                    raise RuntimeError(f"a batch that was taken is not there: {question}")
            visible = time.perf_counter() - start
            with lock:
                told.visible.append(visible)
                told.posted.append(posted)
                told.late = max(told.late, start - due)
                told.again += asked
        own.close()

    threads = [threading.Thread(target=run, args=(robot,)) for robot in range(ROBOTS)]
    for thread in threads:
        thread.start()
    time.sleep(max(begin - time.perf_counter(), 0))
    start, used = time.perf_counter(), _processor(server)
    time.sleep(seconds / 2)
    half = _megabytes(server)
    time.sleep(max(begin + seconds - time.perf_counter(), 0))
    end = _megabytes(server)
    for thread in threads:
        thread.join()
    took = time.perf_counter() - start
    busy = (_processor(server) - used) / took
    return told, len(told.visible) * BATCH / took, (half, end), busy


def _batch(town: Town, rows: NDArray[np.int64], noise: np.random.Generator) -> bytes:
    """A batch, with MOMENT in the place of its time."""
    xy = town.xy[rows] + noise.normal(0, NOISE, (len(rows), 2))
    lonlat = (xy * town.metre + town.middle).round(7).tolist()
    lines: list[dict[str, Any]] = [
        {"tags": town.tags[row], "coordinates": place, "confidence": 0.9, "time": "MOMENT"}
        for row, place in zip(rows.tolist(), lonlat, strict=True)
    ]
    return "\n".join(json.dumps(line) for line in lines).encode()


def _moment() -> str:
    """The time, as the store writes it: without a zero at the end."""
    now = datetime.now(UTC)
    thousandths = now.microsecond // 1000
    return f"{now:%Y-%m-%dT%H:%M:%S}.{thousandths + (thousandths % 10 == 0):03d}Z"


def _tree(server: Server) -> list[int]:
    """The server's process and those that it started."""
    found, parents = [server.process.pid], {}
    for folder in Path("/proc").iterdir():
        if folder.name.isdigit():
            try:
                fields = (folder / "stat").read_text().rpartition(")")[2].split()
            except OSError:  # it has just ended
                continue
            parents[int(folder.name)] = int(fields[1])
    for parent in found:
        found += [pid for pid, above in parents.items() if above == parent]
    return found


def _megabytes(server: Server) -> float:
    pages = 0
    for pid in _tree(server):
        pages += int(Path(f"/proc/{pid}/statm").read_text().split()[1])
    return pages * _PAGE / 1e6


def _processor(server: Server) -> float:
    """Seconds of processor time that the server's processes have used."""
    ticks = 0
    for pid in _tree(server):
        fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
        ticks += int(fields[11]) + int(fields[12])
    return ticks / _TICKS


def _ms(seconds: float) -> str:
    return f"{seconds * 1000:.0f}"
