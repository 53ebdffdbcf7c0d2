"""Map building: errors in simulated worlds and on MRCLAM data, time of an update, memory."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from bench.measure import table
from bench.slam_logs import mrclam, online, town_memory

if TYPE_CHECKING:
    from symboslam.engine.slam.comparison import Result
    from symboslam.engine.slam.log import Floats, Mission
    from symboslam.engine.slam.simulate import World
    from symboslam.engine.slam.slam_map import SlamMap

WORST_TOWN_M = 5.0
MEAN_M = {"town": 2.5, "confused": 3.0, "Fyshwick": 10.0, "Fyshwick, 30 min": 10.0}
"""Targets of the mean landmark error, in the frame of the map, over all seeds."""
WRONG_MERGES = 0.01
"""Target of the town: wrong merges for each landmark mapped."""


def worlds() -> dict[str, World]:
    """The simulated worlds by name."""
    from symboslam.engine.slam.simulate import AIRPORT, CONFUSED, FYSHWICK, TOWN

    return {
        "town": TOWN,
        "confused": CONFUSED,
        "Fyshwick": FYSHWICK,
        "Fyshwick, 30 min": replace(FYSHWICK, poses=1800),
        "Fyshwick, named": replace(FYSHWICK, named=True),
        "airport": AIRPORT,
        "airport, meetings": replace(AIRPORT, meetings=True),
        "town, one start": replace(TOWN, known_starts=1),
        "town, 40 % outliers": replace(TOWN, outliers=0.4),
        "town, wandering": replace(TOWN, wander=True),
    }


def slam(seeds: int, poses: int, tiny: bool = False) -> str:
    """All of map building.

    Args:
        seeds: missions in each world.
        poses: of the mission whose updates are timed.
        tiny: short missions in the town alone.

    ``SLAM_PARTS`` in the environment chooses parts: names of worlds, ``mrclam``, ``online``,
    ``memory``, with commas between.
    """
    chosen = {"town": replace(worlds()["town"], poses=150, robots=2)} if tiny else worlds()
    parts = os.environ.get("SLAM_PARTS", "").split(",")
    if parts != [""]:
        chosen = {name: world for name, world in chosen.items() if name in parts}
    failed: list[str] = []
    results = {name: _all_ways(name, world, seeds, failed) for name, world in chosen.items()}
    return "\n\n".join(
        [
            "## Map building",
            f"Simulated missions, seeds 0 to {seeds - 1} of each world "
            "(`symboslam.engine.slam.simulate`): three robots with 1,000 poses each, one a second; "
            "5 % of the sightings misclassified, in `confused` 30 %. The paper's Fyshwick mission "
            "took 30 minutes, so that world is there with 1,800 poses as well; in `Fyshwick, "
            "named` we can read which landmark is which: nothing is mistaken. Errors are metres "
            "between landmarks and the true ones that they stand for, by identity "
            "(`docs/slam-evaluation.md`): the mean in each mission, raw and after the best "
            "rigid alignment, then mean and worst over the seeds; `max` is the worst landmark of "
            "all. ATE is the mean of the robots, in `worst` the worst robot of all. `mapped` and "
            "`seen`, duplicates, wrong merges and doubts are sums over the seeds; `seen` are true "
            "landmarks. Neither we nor the paper's rule see the truth; dead reckoning "
            "has the identities, and so no wrong merges.",
            *(_table(name, ways) for name, ways in (
                ("SymboSLAM", {n: each["ours"] for n, each in results.items()}),
                ("The paper's rule", {n: each["paper"] for n, each in results.items()}),
                ("Dead reckoning", {n: each["odometry"] for n, each in results.items()}),
            )),
            "" if tiny else _targets({name: each["ours"] for name, each in results.items()}, seeds),
            "**Crashed, and in no table: " + "; ".join(failed) + "**" if failed else "",
            mrclam(tiny) if parts == [""] or "mrclam" in parts else "",
            online(poses, tiny) if parts == [""] or "online" in parts else "",
            town_memory(tiny) if parts == [""] or "memory" in parts else "",
        ]
    )  # fmt: skip


def _all_ways(name: str, world: World, seeds: int, failed: list[str]) -> dict[str, list[Result]]:
    """Way to map -> its results, one a seed."""
    from symboslam.engine.slam.comparison import blind, measure
    from symboslam.engine.slam.dead_reckoning import dead_reckoned
    from symboslam.engine.slam.estimate import estimate
    from symboslam.engine.slam.paper import paper_map
    from symboslam.engine.slam.simulate import simulate

    ways: dict[str, Callable[[Mission], SlamMap]] = {
        "ours": lambda mission: estimate(blind(mission)),
        "paper": lambda mission: paper_map(blind(mission)),
        "odometry": lambda mission: dead_reckoned(mission, by="identity", lost="left out"),
    }
    found: dict[str, list[Result]] = {way: [] for way in ways}
    for seed in range(seeds):
        mission = simulate(world, seed)
        try:
            every = {way: _measured(measure, make, mission) for way, make in ways.items()}
        except Exception as broken:  # a crash is a result as well
            failed.append(f"{name}, seed {seed}: {type(broken).__name__}: {broken}")
            print(f"  {failed[-1]}", file=sys.stderr, flush=True)
            continue
        for way, result in every.items():
            found[way].append(result)
        ours = found["ours"][-1]
        error = ours.score.error.mean if ours.score.error else float("nan")
        print(
            f"  {name}, seed {seed}: {error:.2f} m, {ours.figures.seconds:.1f} s, "
            f"missing {ours.figures.robots_missing}, {ours.slam_map.doubts}",
            file=sys.stderr,
            flush=True,
        )
    return found


def _measured(
    measure: Callable[[Callable[[], SlamMap], Mission], Result],
    make: Callable[[Mission], SlamMap],
    mission: Mission,
) -> Result:
    return measure(lambda: make(mission), mission)


def _table(name: str, ways: Mapping[str, Sequence[Result]]) -> str:
    head = ("world", "mean m", "worst", "aligned m", "worst", "max m", "ATE m", "worst", "mapped",
            "seen", "duplicates", "wrong merges", "robots missing", "doubts", "s",
            "longest")  # fmt: skip
    rows = []
    for world, results in ways.items():
        if not results:
            continue
        raw, aligned = errors(results), errors(results, aligned=True)
        ate = _numbers(r.figures.ate_mean_m for r in results)
        seconds = _numbers(r.figures.seconds for r in results)
        rows.append([
            world, f"{raw.mean():.2f}", f"{raw.max():.2f}", f"{aligned.mean():.2f}",
            f"{aligned.max():.2f}",
            f"{max(r.score.error.max for r in results if r.score.error):.1f}",
            f"{ate.mean():.2f}", f"{_numbers(r.figures.ate_max_m for r in results).max():.2f}",
            sum(r.figures.landmarks_mapped for r in results), sum(map(seen, results)),
            sum(r.figures.duplicates or 0 for r in results),
            sum(r.figures.wrong_merges or 0 for r in results),
            sum(len(r.figures.robots_missing) for r in results),
            sum(len(r.slam_map.doubts) for r in results),
            f"{seconds.mean():.1f}", f"{seconds.max():.1f}",
        ])  # fmt: skip
        if name == "Dead reckoning":
            rows[-1][-3] = ""  # its doubt is always the same
    return f"### {name}, in simulated worlds\n\n" + table(head, rows)


def _numbers(values: Iterable[float | None]) -> Floats:
    return np.array([v for v in values if v is not None], np.float64)


def errors(results: Sequence[Result], aligned: bool = False) -> Floats:
    """Mean landmark error of each mission."""
    found = [r.score.error_aligned if aligned else r.score.error for r in results]
    return np.array([each.mean for each in found if each is not None])


def seen(result: Result) -> int:
    """True landmarks that were seen in a mission."""
    known = result.score.identities
    return 0 if known is None else len(known.stands) + len(known.missed)


def _targets(results: Mapping[str, Sequence[Result]], seeds: int) -> str:
    rows = []
    for name, target in MEAN_M.items():
        if name in results:
            rows.append(verdict(f"{name}: mean error m", errors(results[name]).mean(), target))
            if len(results[name]) < seeds:
                rows[-1][-1] = "MISSED (crashed)"
    if "town" in results:
        town = results["town"]
        mapped = sum(r.figures.landmarks_mapped for r in town)
        wrong = sum(r.figures.wrong_merges or 0 for r in town)
        rows.append(verdict("town: worst seed m", errors(town).max(), WORST_TOWN_M))
        rows.append(verdict("town: wrong merges a landmark", wrong / mapped, WRONG_MERGES))
    return "### Targets of the simulated worlds\n\n" + table(
        ("figure", "measured", "target", ""), rows
    )


def verdict(what: str, measured: float, target: float, digits: int = 3) -> list[object]:
    """A row of a table of targets."""
    met = "met" if measured <= target else "MISSED"
    return [what, f"{measured:.{digits}f}", f"<= {target:g}", met]
