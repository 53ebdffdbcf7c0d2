"""Map building on MRCLAM data, the time of one update, and peak memory."""

from __future__ import annotations

import os
import sys
import time
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from bench.measure import process, table

if TYPE_CHECKING:
    from symboslam.engine.slam.comparison import Result
    from symboslam.engine.slam.log import Mission

ROOT = Path(__file__).resolve().parents[1]
BENCHMARK = os.environ.get("BENCHMARK", "../shared/benchmark")
RMSE_M, NAMED_RMSE_M, ATE_M, MISSION_S = 0.15, 0.10, 0.20, 60.0
P99_MS, MEMORY_MB = 50.0, 1000.0

_MISSION = """
import sys
from symboslam.engine.slam.estimate import estimate
from symboslam.engine.slam.simulate import World, simulate
estimate(simulate(World(poses=int(sys.argv[1]))))
"""


def _verdict(measured: float, target: float) -> str:
    return f"<= {target:g}: {'met' if measured <= target else 'MISSED'}"


def mrclam(tiny: bool = False) -> str:
    """MRCLAM set 6 with identities known, with four classes and with two."""
    from symboslam.engine.slam.readers.mrclam import read

    folder = (ROOT / BENCHMARK).resolve().parent / "data" / "mrclam6"
    head = "### MRCLAM set 6 (five robots, 15 landmarks, 15 minutes)"
    if tiny or not folder.is_dir():
        return f"{head}\n\nSkipped: " + ("toy sizes." if tiny else "the data are not here.")
    rows: list[list[object]] = []
    for classes in (None, 4, 2):
        mission, _ = read(folder, classes)
        print(f"  MRCLAM, classes {classes}", file=sys.stderr, flush=True)
        name = "identities known" if classes is None else f"{classes} classes"
        try:
            every = _ways(mission)
        except Exception as error:  # a crash is a result as well
            rows.append([f"{name}: CRASHED ({type(error).__name__}: {error})", *([""] * 9)])
            rows[-1][-3:] = ["MISSED"] * 3
            continue
        for way, result in every.items():
            f = result.figures
            numbers = (f.landmark_rmse_m, f.ate_mean_m, f.ate_max_m)
            rows.append([
                f"{name}, {way}",
                *("-" if value is None else f"{value:.3f}" for value in numbers),
                f.wrong_merges, len(result.slam_map.doubts), f"{f.seconds:.1f}",
                *(_judged(result, classes) if way == "SymboSLAM" else ("", "", "")),
            ])  # fmt: skip
    columns = ("map", "landmark RMSE m", "ATE mean m", "ATE max m", "wrong merges", "doubts", "s",
               "target RMSE", "target ATE mean", "target s")  # fmt: skip
    return f"{head}\n\nThe figures of `symboslam slam mrclam`, all starts known.\n\n" + table(
        columns, rows
    )


def _ways(mission: Mission) -> dict[str, Result]:
    from symboslam.engine.slam.comparison import blind, measure
    from symboslam.engine.slam.dead_reckoning import dead_reckoned
    from symboslam.engine.slam.estimate import estimate
    from symboslam.engine.slam.paper import paper_map

    unseen = blind(mission)
    return {
        "SymboSLAM": measure(lambda: estimate(unseen), mission),
        "the paper's rule": measure(lambda: paper_map(unseen), mission),
        "dead reckoning": measure(
            lambda: dead_reckoned(mission, by="identity", lost="left out"), mission
        ),
    }


def _judged(result: Result, classes: int | None) -> tuple[str, str, str]:
    figures = result.figures
    nothing = float("inf")
    rmse = figures.landmark_rmse_m if figures.landmark_rmse_m is not None else nothing
    ate = figures.ate_mean_m if figures.ate_mean_m is not None else nothing
    return (
        _verdict(rmse, NAMED_RMSE_M if classes is None else RMSE_M),
        _verdict(ate, ATE_M),
        _verdict(figures.seconds, MISSION_S),
    )


def online(poses: int, tiny: bool = False) -> str:
    """Time of the updates of an edge agent's map, one key pose with its sightings at a time."""
    from symboslam.engine.slam.beliefs import ClassBeliefs
    from symboslam.engine.slam.edge_map import EdgeMap
    from symboslam.engine.slam.key_poses import KeyPoses, replay
    from symboslam.engine.slam.pose_graph import PoseGraph
    from symboslam.engine.slam.settings import SlamSettings
    from symboslam.engine.slam.simulate import World, simulate

    settings = SlamSettings()
    mission = simulate(World(robots=1, poses=poses), 0)
    log, graph = mission.robots[0], PoseGraph("robot 1")
    keys = KeyPoses(graph, log.odometry.noise, settings.interval)
    edge = EdgeMap(
        graph,
        ClassBeliefs(mission.similarity),
        mission.dynamic,
        log.start or (0.0, 0.0, 0.0),
        log.start_sigma,
        settings,
    )
    taken, done = [], 0
    for _ in replay(log, keys):
        if len(graph) > done:
            done = len(graph)
            begun = time.perf_counter()
            edge.follow()
            taken.append(time.perf_counter() - begun)
    every = np.array(taken) * 1000
    solved = every[settings.every - 1 :: settings.every]
    rows = [
        [f"{name} ({len(ms):,})", *(f"{v:.2f}" for v in (*np.percentile(ms, (50, 99)), ms.max())),
         told]
        for name, ms, told in (
            ("all updates", every, _verdict(float(np.percentile(every, 99)), P99_MS)),
            ("those that solve", solved, ""),
            ("those of the last third that solve", solved[len(solved) * 2 // 3 :], ""),
        )
    ]  # fmt: skip
    trouble = f" The map could not be kept up to date: {edge.trouble}." if edge.trouble else ""
    return (
        "### Time of one update of an edge agent's map\n\n"
        f"One robot in the town, 300 landmarks and {poses:,} poses; `EdgeMap.follow` after each "
        f"key pose with its sightings. Every {settings.every}th call solves, the others only take "
        f"over what came.{trouble}\n\n"
        + table(("updates", "p50 ms", "p99 ms", "max ms", "target p99"), rows)
    )


def town_memory(tiny: bool = False) -> str:
    """Peak memory of a process that maps the town."""
    run = process([sys.executable, "-c", _MISSION, "100" if tiny else "1000"])
    return "### Memory\n\n" + table(
        ("whole process", "s", "peak MB", "target MB"),
        [["simulate the town (seed 0) and map it", f"{run.seconds:.1f}", f"{run.peak_mb:.0f}",
          _verdict(run.peak_mb, MEMORY_MB)]],
    )  # fmt: skip
