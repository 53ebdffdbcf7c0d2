"""What is measured; every case returns one section of the report as Markdown."""

from __future__ import annotations

import json
import math
import statistics
import sys
import tempfile
import tracemalloc
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from bench import reference
from bench.measure import Run, call, process, table

ROOT = Path(__file__).resolve().parents[1]
SYMBOSLAM = [sys.executable, "-m", "symboslam"]
CELL_M = 125.0
LANDMARKS_PER_KM2 = 100.0
START_UP_LANDMARKS = 3694  # as many as the largest map in the paper

# Detector classes of the growth case and how often each occurs.
CLASSES = {
    "House": 40, "Tree": 25, "Car": 8, "Building": 6, "Apartment": 4, "BusStop": 3, "Bench": 3,
    "TrafficLight": 2, "Factory": 2, "Warehouse": 2, "ConvenienceStore": 2, "Cattle": 2, "Slide": 1,
}  # fmt: skip


def evidence(sizes: Sequence[int]) -> str:
    """One dense segment: the engine against the pair loop, on the sample town's landmarks."""
    from symboslam.engine.evidence import pair_evidence
    from symboslam.engine.readers import read_landmarks
    from symboslam.reasoning.knowledge import Knowledge

    knowledge = Knowledge.load()
    with tempfile.TemporaryDirectory() as folder:
        landmarks = read_landmarks(str(_town(Path(folder), 4000.0)), knowledge)
    direct = knowledge.direct()[landmarks.feature] * landmarks.confidence[:, None]
    shuffled = np.random.default_rng(1).permutation(len(landmarks))
    west, south, east, north = landmarks.bbox
    diagonal = float(np.hypot(east - west, north - south))
    rows = []
    for z in sizes:
        if z > len(shuffled):
            raise ValueError(f"{z} landmarks asked for, the sample has {len(shuffled)}")
        xy, weight = landmarks.xy[shuffled[:z]], direct[shuffled[:z]]
        points, lists = [(x, y) for x, y in xy.tolist()], weight.tolist()
        pair_evidence(xy, weight, diagonal)  # the first call loads scipy
        ours, got = call(pair_evidence, xy, weight, diagonal, repeat=9)
        loop, plain = call(reference.pair_loop, points, lists, diagonal)
        tracemalloc.start()
        pair_evidence(xy, weight, diagonal)
        peak = tracemalloc.get_traced_memory()[1] / 1e6
        tracemalloc.stop()
        error = max(np.abs(a - np.array(b)).max() for a, b in zip(got, plain, strict=True))
        rows.append(
            [z, f"{(weight > 0).sum() / z:.1f}", f"{loop:.3f}", f"{ours * 1000:.2f}",
             f"{loop / ours:.0f}", f"{peak:.1f}", f"{error:.0e}"]
        )  # fmt: skip
    head = (
        "landmarks", "environments each", "pair loop s", "engine ms", "times faster",
        "engine peak MB", "largest difference",
    )  # fmt: skip
    return (
        "## Evidence of one dense segment (`profile=paper`)\n\n"
        "The pair loop is `bench/reference.py`, run in full, in the same process; the engine's "
        "time is the median of 9 calls.\n\n" + table(head, rows)
    )


def classification(sizes_m: Sequence[float]) -> str:
    """The sample town as a whole: the engine against the plain transcription."""
    from symboslam.engine.classify import classify
    from symboslam.engine.readers import read_landmarks
    from symboslam.reasoning.knowledge import Knowledge

    knowledge = Knowledge.load()
    rows = []
    for size in sizes_m:
        with tempfile.TemporaryDirectory() as folder:
            landmarks = read_landmarks(str(_town(Path(folder), size)), knowledge)
        weight = (knowledge.direct()[landmarks.feature] * landmarks.confidence[:, None]).tolist()
        points = [(x, y) for x, y in landmarks.xy.tolist()]
        classify(landmarks, knowledge, profile="paper")
        ours, found = call(classify, landmarks, knowledge, profile="paper", repeat=5)
        best, _ = call(classify, landmarks, knowledge, repeat=5)
        loop, plain = call(reference.classify, points, weight, landmarks.bbox)
        same = set(plain) == set(found.segment_id.tolist())
        error = (
            max(
                float(np.abs(p - plain[name]).max())
                for name, p in zip(found.segment_id.tolist(), found.probability, strict=True)
            )
            if same
            else float("nan")
        )
        rows.append(
            [len(landmarks), len(found), f"{loop:.3f}", f"{ours * 1000:.0f}", f"{loop / ours:.0f}",
             f"{error:.0e}" if same else "other segments", f"{best * 1000:.0f}"]
        )  # fmt: skip
    head = (
        "landmarks", "segments", "plain loops s", "engine ms", "times faster",
        "largest difference", "`default` profile ms",
    )  # fmt: skip
    return (
        "## Classification of sample towns (24 x 24 cells, `profile=paper`)\n\n"
        "In one process, without reading and writing; the engine's times are medians of 5.\n\n"
        + table(head, rows)
    )


def growth(sizes: Sequence[int]) -> str:
    """Whole processes on more and more landmarks at equal density: CSV in, GeoJSON out."""
    rows: list[list[object]] = []
    before: tuple[int, float] | None = None
    with tempfile.TemporaryDirectory() as folder:
        for n in sizes:
            side = side_of(n)
            source, out = Path(folder) / f"{n}.csv", Path(folder) / f"{n}.geojson"
            scatter(source, n, side)
            options = ["--crs", "m", "--bbox", f"0,0,{side},{side}"]
            options += ["--cells", str(round(side / CELL_M))]
            runs = [_classify(source, out, *options) for _ in range(3)]
            run = sorted(runs, key=lambda one: one.seconds)[1]
            times = run.seconds / before[1] / (n / before[0]) if before else None
            rows.append(
                [f"{n:,}", f"{side / 1000:g} km", f"{run.seconds:.2f}", f"{run.peak_mb:.0f}",
                 f"{out.stat().st_size / 1e6:.1f}", "" if times is None else f"{times:.2f}"]
            )  # fmt: skip
            before = (n, run.seconds)
            source.unlink()
            out.unlink()
    head = (
        "landmarks", "side", "seconds", "peak MB", "GeoJSON MB", "times linear from the line above",
    )  # fmt: skip
    return (
        "## Growth (whole process `symboslam classify`, CSV to GeoJSON, `default` profile)\n\n"
        f"{LANDMARKS_PER_KM2:.0f} landmarks per km2, cells of {CELL_M:.0f} m, medians of 3.\n\n"
        + table(head, rows)
    )


def start_up(repeat: int) -> str:
    """Whole processes that a person waits for."""
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        source, out = Path(folder) / "in.geojson", Path(folder) / "out.geojson"
        town = json.loads(_town(Path(folder), 3000.0).read_text())
        chosen = np.random.default_rng(2).permutation(len(town["features"]))[:START_UP_LANDMARKS]
        town["features"] = [town["features"][i] for i in sorted(chosen.tolist())]
        source.write_text(json.dumps(town))
        commands = {
            "`symboslam --help`": [*SYMBOSLAM, "--help"],
            f"`symboslam classify`, {len(chosen):,} landmarks to GeoJSON": [
                *SYMBOSLAM, "classify", str(source), "--out", str(out),
            ],
        }  # fmt: skip
        for name, command in commands.items():
            process(command)  # warms the file cache
            runs = [process(command) for _ in range(repeat)]
            seconds = sorted(run.seconds for run in runs)
            rows.append(
                [name, f"{statistics.median(seconds):.3f}", f"{seconds[0]:.3f}",
                 f"{seconds[-1]:.3f}", f"{max(run.peak_mb for run in runs):.0f}"]
            )  # fmt: skip
    return f"## Start-up (whole process, {repeat} runs each)\n\n" + table(
        ("command", "median s", "fastest s", "slowest s", "peak MB"), rows
    )


def knowledge() -> str:
    """Loading knowledge: reasoned anew, from the cache, and the bundled table."""
    ontology = sorted(map(str, (ROOT / "ontology").glob("*.ttl")))
    timed = (
        "import sys, time\n"
        "from symboslam.reasoning.knowledge import Knowledge\n"
        "start = time.perf_counter()\n"
        "Knowledge.load(sys.argv[1:] or None)\n"
        "print(time.perf_counter() - start)\n"
    )
    with tempfile.TemporaryDirectory() as cache:
        places = {"XDG_CACHE_HOME": cache, "SYMBOSLAM_CACHE": cache}
        runs = {
            "cold build: parse, HermiT, extract": process(
                [sys.executable, "-c", timed, *ontology], places
            ),
            "the same ontology from the cache": process(
                [sys.executable, "-c", timed, *ontology], places
            ),
            "the bundled table": process([sys.executable, "-c", timed], places),
        }
    rows = [
        [name, f"{float(run.output.split()[-1]):.3f}", f"{run.peak_mb:.0f}"]
        for name, run in runs.items()
    ]
    return "## Knowledge (`Knowledge.load()` in a fresh process)\n\n" + table(
        ("what", "seconds", "peak MB of the largest process"), rows
    )


def _classify(source: Path, out: Path, *options: str) -> Run:
    return process([*SYMBOSLAM, "classify", str(source), "--out", str(out), *options])


def _town(folder: Path, size_m: float) -> Path:
    """A sample town as a file."""
    from symboslam.engine.sample import sample_area

    path = folder / "town.geojson"
    path.write_text(json.dumps(sample_area(7, size_m)))
    return path


def side_of(n: int) -> float:
    """Side in metres of a map of ``n`` landmarks, in whole coarsest cells."""
    return CELL_M * max(round(math.sqrt(n / LANDMARKS_PER_KM2) * 1000 / CELL_M / 8), 1) * 8


def scatter(path: Path, n: int, side: float) -> None:
    """Landmarks in metres as CSV: half of them in towns of 400 m, half anywhere."""
    rng = np.random.default_rng(n)
    xy = rng.uniform(0, side, (n, 2))
    towns = rng.uniform(0, side, (max(n // 2000, 1), 2))
    crowd = towns[rng.integers(0, len(towns), n // 2)] + rng.normal(0, 400, (n // 2, 2))
    xy[: n // 2] = np.clip(crowd, 0, side)
    share = np.array(list(CLASSES.values())) / sum(CLASSES.values())
    names = rng.choice(list(CLASSES), n, p=share)
    confidence = rng.uniform(0.5, 1.0, n)
    with path.open("w") as file:
        file.write("class,x,y,confidence\n")
        file.writelines(
            f"{name},{x:.2f},{y:.2f},{f:.3f}\n"
            for name, (x, y), f in zip(
                names.tolist(), xy.tolist(), confidence.tolist(), strict=True
            )
        )
