"""Branch segmentation: how it grows with the map, and against a plain transcription."""

from __future__ import annotations

import json
import math
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from bench import reference
from bench.cases import scatter, side_of
from bench.measure import call, process, table

QUARTERS = ("House", "Factory", "ConvenienceStore", "Tree", "Apartment", "Warehouse")
"""Classes of which a quarter of the made-up map has one, but for a few strangers."""
BLOCKS = 3
"""Quarters along each side."""

_CUT = """
import json, sys, time
import scipy.spatial, scipy.sparse.csgraph, sklearn.svm
from symboslam.engine.classify import classify
from symboslam.engine.readers import read_landmarks
from symboslam.reasoning.knowledge import Knowledge
knowledge = Knowledge.load()
side = float(sys.argv[2])
landmarks = read_landmarks(sys.argv[1], knowledge, crs="m", bbox=(0, 0, side, side))
stages = []
wall, cpu = time.perf_counter(), time.process_time()
found = classify(landmarks, knowledge, segmentation="branch")
wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
print(json.dumps([wall, cpu, len(found), int(found.landmark_count.max())]))
"""


def segmentation(sizes: Sequence[int], plain_sizes: Sequence[int]) -> str:
    """Branch segmentation of more and more landmarks, and growth against the plain loops."""
    return "\n\n".join(
        [
            "## Branch segmentation (`--segmentation branch`, `default` profile)",
            "Landmarks to segments with boundaries, in one process without reading, writing and "
            "loading of libraries. `times n log n` compares the processor time with the line "
            "above: 1 is growth by n log n. Peak memory is that of the whole process.",
            _sizes(sizes),
            "Growth of the fragments alone against its definition, `bench/reference.py`: P from "
            "all pairs and the nearest landmark from all landmarks, anew at every step. Processor "
            "time of both; of each landmark only what it says most strongly (`relevance` 1). On "
            "maps of nine quarters of one class each, where fragments grow as large as quarters; "
            "with 2 % of other classes among them; and on a mixture of all classes, where "
            "fragments close after a few landmarks and the plain loops have little to do.",
            _plain(plain_sizes),
        ]
    )


def _sizes(sizes: Sequence[int]) -> str:
    rows: list[list[object]] = []
    before: tuple[int, float] | None = None
    with tempfile.TemporaryDirectory() as folder:
        for n in sizes:
            side, source = side_of(n), Path(folder) / f"{n}.csv"
            scatter(source, n, side)
            run = process([sys.executable, "-c", _CUT, str(source), str(side)])
            wall, cpu, segments, largest = json.loads(run.output.splitlines()[-1])
            growth = ""
            if before:
                expected = n * math.log(n) / (before[0] * math.log(before[0]))
                growth = f"{cpu / before[1] / expected:.2f}"
            before = (n, cpu)
            rows.append(
                [f"{n:,}", f"{wall:.2f}", f"{cpu:.2f}", f"{segments:,}", f"{largest:,}",
                 f"{run.peak_mb:.0f}", growth]
            )  # fmt: skip
    head = ("landmarks", "seconds", "processor s", "segments", "landmarks of the largest",
            "peak MB", "times n log n")  # fmt: skip
    return table(head, rows)


def _plain(sizes: Sequence[int]) -> str:
    from symboslam.engine.growth import densest, grow
    from symboslam.reasoning.knowledge import Knowledge

    knowledge = Knowledge.load()
    known = np.array([knowledge.index_of(name) for name in QUARTERS])
    weights = knowledge.weights("path", None, "entropy")[known]
    weights[weights < weights.max(1, keepdims=True)] = 0  # the strongest alone: relevance = 1
    rows = []
    for kind, mixed in (("pure quarters", 0.0), ("2 % strangers", 0.02), ("a mixture", 1.0)):
        for n in sizes:
            rng = np.random.default_rng(n)
            xy = rng.uniform(0, 1, (n, 2))
            quarter = (xy * BLOCKS).astype(int) @ (1, BLOCKS)
            feature = np.where(rng.uniform(size=n) < mixed, rng.integers(0, 6, n), quarter % 6)
            xy *= side_of(n)
            weight = weights[feature]
            points, start = [(x, y) for x, y in xy.tolist()], densest(xy)
            ours, got = call(grow, xy, weight, 0.5, start, repeat=3, cpu=True)
            loop, plain = call(reference.grow, points, weight.tolist(), start, cpu=True)
            rows.append(
                [kind, f"{n:,}", f"{loop:.2f}", f"{ours * 1000:.0f}", f"{loop / ours:.0f}",
                 len(got), "equal" if got == plain else "different"]
            )  # fmt: skip
    head = ("map", "landmarks", "plain s", "engine ms", "times faster", "fragments", "they are")
    return table(head, rows)
