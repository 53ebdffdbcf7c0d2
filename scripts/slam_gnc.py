"""Measure GNC beside the robust losses of map building: slam_gnc.py [MRCLAM_DIR [CLASSES]].

Without a folder: the town of which 40 % of the sightings are outliers, seed 0. A mission is
mapped as ever; then its joint graph, with all that was merged, is solved anew from the robots' own
maps: by Huber's and then Cauchy's loss, as `JointGraph.solve` is used; by Cauchy's alone; and by
GNC with truncated least squares (Yang et al. 2020), for which all but sightings are inliers.
"""

from __future__ import annotations

import sys
import time
from dataclasses import replace
from pathlib import Path
from typing import Any

import gtsam
import numpy as np

from symboslam.engine.slam import control, joint
from symboslam.engine.slam.comparison import Result, blind, measure
from symboslam.engine.slam.estimate import estimate
from symboslam.engine.slam.identity_error import holders
from symboslam.engine.slam.joining import Joining
from symboslam.engine.slam.log import Mission
from symboslam.engine.slam.outcome import outcome
from symboslam.engine.slam.readers.mrclam import read
from symboslam.engine.slam.simulate import TOWN, simulate

ITERATIONS = 50


class Gnc:
    """`gtsam.GncLMOptimizer`, with the interface of `gtsam.LevenbergMarquardtOptimizer`."""

    def __init__(self, graph: Any, values: Any, _: Any) -> None:
        params = gtsam.GncLMParams()
        params.setLossType(gtsam.GncLossType.TLS)
        robust = gtsam.noiseModel.Robust
        params.setKnownInliers(
            [n for n in range(graph.size()) if not isinstance(graph.at(n).noiseModel(), robust)]
        )
        self._graph, self._gnc = graph, gtsam.GncLMOptimizer(graph, values, params)
        self._gnc.setInlierCostThresholdsAtProbability(0.99)

    def optimize(self) -> Any:
        """The values."""
        self._found = self._gnc.optimize()
        return self._found

    def error(self) -> float:
        """What is left."""
        return float(self._graph.error(self._found))


class WithGnc:
    """gtsam, with GNC in the place of Levenberg-Marquardt."""

    LevenbergMarquardtOptimizer = Gnc

    def __getattr__(self, name: str) -> Any:
        return getattr(gtsam, name)


def compare(name: str, mission: Mission) -> None:
    """Map a mission, solve its joint graph in three ways, and print a row for each."""
    caught: list[tuple[Any, ...]] = []

    def catch(*given: Any) -> Any:
        caught.append(given)
        return outcome(*given)

    vars(control)["outcome"] = catch
    whole = measure(lambda: estimate(blind(mission)), mission)
    vars(control)["outcome"] = outcome
    ((joined, *rest),) = caught
    print(f"| {name} | (the whole run) | {row(whole, mission)} |", flush=True)
    kernel = joined.graph.settings.kernel
    for way, widths in (
        ("Huber, then Cauchy", (0.0, kernel)),
        ("Cauchy", (kernel,)),
        ("GNC", (kernel,)),
    ):
        begin(joined)
        vars(joint)["gtsam"] = WithGnc() if way == "GNC" else gtsam
        begun = time.perf_counter()
        for width in widths:
            joined.graph.solve(width, ITERATIONS)
        seconds = time.perf_counter() - begun
        vars(joint)["gtsam"] = gtsam
        found = measure(lambda: outcome(joined, *rest), mission)
        found = replace(found, figures=replace(found.figures, seconds=seconds))
        print(f"| {name} | {way} | {row(found, mission)} |", flush=True)


def begin(joined: Joining) -> None:
    """Put all poses where the robots' own maps have them, and all landmarks by these."""
    for number, member in zip(joined.placed, joined.graph.members, strict=True):
        member.poses, member.scale, member.turn = joined.edges[number].poses(), 1.0, 0.0
    joined.graph.xy.clear()


def row(found: Result, mission: Mission) -> str:
    """Landmarks (median and RMSE), paths, seconds."""
    assert mission.truth is not None
    places, figures = mission.truth.landmarks, found.figures
    away = [
        np.hypot(*(found.slam_map.landmarks.xy[at] - places[name]))
        for name, at in holders(found.slam_map, mission).items()
        if name in places
    ]
    values = (float(np.median(away)), figures.landmark_rmse_raw_m, figures.ate_mean_m)
    return " | ".join([*(f"{value:.3f}" for value in values), f"{figures.seconds:.2f}"])


def main() -> None:
    """Print a table."""
    print("| mission | solved by | landmarks, median m | RMSE m | ATE, m | s |")
    print("|---|---|---:|---:|---:|---:|")
    if len(sys.argv) > 1:
        classes = int(sys.argv[2]) if len(sys.argv) > 2 else 2
        compare(f"MRCLAM, {classes} classes", read(Path(sys.argv[1]), classes, "all")[0])
        return
    compare("town, 40 % outliers", simulate(replace(TOWN, outliers=0.4), 0))


if __name__ == "__main__":
    main()
