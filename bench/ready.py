"""How long ``symboslam serve`` takes until it answers, with maps in its folder."""

from __future__ import annotations

import statistics
import tempfile
from collections.abc import Sequence
from pathlib import Path

from bench.maps import maps
from bench.measure import table
from bench.queries import copied
from bench.servers import symboslam


def ready(towns: Sequence[int], size_m: float, repeat: int) -> str:
    """From the start of the process to the first 200 of ``/readyz``.

    Args:
        towns: how many maps, besides two, in each row.
        size_m: their size.
        repeat: how often the service is started.
    """
    rows = []
    for number in towns:
        kept = maps(number, size_m)
        with (kept / "maps.nq").open("rb") as lines:
            size = sum(1 for _ in lines)
        seconds = []
        with tempfile.TemporaryDirectory() as folder:
            data = copied(kept / "data", Path(folder))
            for _ in range(repeat):
                with symboslam(data) as server:
                    seconds.append(server.seconds)
        rows.append(
            [number + 2, f"{size:,}", f"{statistics.median(seconds):.2f}",
             f"{min(seconds):.2f}", f"{max(seconds):.2f}"]
        )  # fmt: skip
    head = ("maps", "triples", "median s", "fastest s", "slowest s")
    return f"## `symboslam serve` until `/readyz` says ready ({repeat} starts each)\n\n" + table(
        head, rows
    )
