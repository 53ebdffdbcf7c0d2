"""How long an explanation takes: full, and with counterfactuals; of cells and of fragments."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

from bench.measure import table

WAYS = (("full", False), ("full, with counterfactuals", True))


def explanations(size_m: float, every: int) -> str:
    """Every n-th segment of a sample town explained in full, the map being at hand.

    Args:
        size_m: side of the town in metres.
        every: which segments are explained: each of so many.
    """
    from symboslam.engine.account import full_account
    from symboslam.engine.account_formats import as_json
    from symboslam.engine.classify import classify
    from symboslam.engine.readers import read_landmarks
    from symboslam.engine.sample import sample_area
    from symboslam.reasoning.knowledge import Knowledge

    knowledge = Knowledge.load()
    landmarks = read_landmarks(sample_area(7, size_m), knowledge)
    rows = []
    for profile, segmentation in (("default", "grid"), ("paper", "grid"), ("default", "branch")):
        found = classify(landmarks, knowledge, profile=profile, segmentation=segmentation)
        names = [str(name) for name in found.segment_id[::every]]
        names.append(str(found.segment_id[found.landmark_count.argmax()]))
        for words, counterfactual in WAYS:

            def one(name: str, wanted: bool = counterfactual) -> None:
                account = full_account(found, name, limit=10_000, counterfactual=wanted)  # noqa: B023
                as_json(account, "full")

            one(names[0])  # the first call loads scipy
            wall, cpu = zip(*(_timed(one, name) for name in names), strict=True)
            rows.append(
                [
                    f"{profile}, {segmentation}, {words}", len(names),
                    *(f"{1000 * t:.1f}" for t in (statistics.median(wall), max(wall), max(cpu))),
                ]
            )  # fmt: skip
    head = ("profile, segmentation, what", "segments", "median ms", "longest ms", "longest, CPU ms")
    return (
        f"## Explanations of a map of {len(landmarks)} landmarks\n\n"
        "Text and JSON of one segment with its landmarks, pairs, differences and axioms, the map "
        "being at hand; the largest segment is among them. Counterfactuals of fragments are proved "
        "on the map cut anew, which takes most of their time.\n\n" + table(head, rows)
    )


def _timed(work: Callable[[str], None], name: str) -> tuple[float, float]:
    """Seconds on the clock and of the processor."""
    wall, cpu = time.perf_counter(), time.process_time()
    work(name)
    return time.perf_counter() - wall, time.process_time() - cpu
