"""Write tests/engine/slam/evo_numbers.json: evo's ATE and RPE of made-up paths.

evo is GPL-3 and so no dependency; its numbers are only compared with. To make them anew:
pip install evo==1.38.1; python scripts/evo_numbers.py
"""

from __future__ import annotations

import json
from importlib import import_module
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

OUT = Path(__file__).parents[1] / "tests" / "engine" / "slam" / "evo_numbers.json"


def noise(count: int, seed: float) -> Any:
    """(count,) numbers in [-1, 1) that look random and are the same with every numpy."""
    return (np.sin((np.arange(count) + 1) * 12.9898 + seed) * 43758.5453) % 2 - 1


def paths(seed: int) -> tuple[Any, Any]:
    """(n, 4) estimate and (m, 4) truth: time, x, y, heading; the clocks tick differently."""
    time = np.arange(0, 60, 0.1)
    heading = 0.8 * np.sin(time / 7) + time / 20
    x, y = np.cumsum(np.cos(heading)) * 0.12, np.cumsum(np.sin(heading)) * 0.12
    truth = np.column_stack([time, x, y, heading])
    found = truth[noise(len(time), seed) < -0.25].copy()
    n = len(found)
    found[:, 0] += 0.015 * noise(n, seed + 0.1)  # some are beyond 0.01 s
    for column, size in ((1, 0.05), (2, 0.05), (3, 0.02)):
        found[:, column] += np.cumsum(size * noise(n, seed + column / 5))
    turn = 0.7
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    found[:, 1:3] = found[:, 1:3] @ rotation.T + (5, -3)
    found[:, 3] += turn
    return (found, truth) if seed % 2 else (truth[::2], found)  # either may have fewer poses


def numbers() -> dict[str, Any]:
    """The statistics that evo has of each pair of paths."""
    metrics, sync, paths_of_evo = (
        import_module(f"evo.core.{name}") for name in ("metrics", "sync", "trajectory")
    )
    relation, unit_of = metrics.PoseRelation, metrics.Unit

    def trajectory(rows: Any) -> Any:
        n, half = len(rows), rows[:, 3] / 2
        xyz = np.column_stack([rows[:, 1:3], np.zeros(n)])
        wxyz = np.column_stack([np.cos(half), np.zeros((n, 2)), np.sin(half)])
        return paths_of_evo.PoseTrajectory3D(xyz, wxyz, rows[:, 0].copy())

    def statistics(metric: Any, data: Any) -> dict[str, float]:
        metric.process_data(data)
        found = metric.get_all_statistics()
        return {name: float(found[name]) for name in ("rmse", "mean", "median", "max")}

    made: dict[str, Any] = {"evo": version("evo")}
    for seed in (1, 2, 3):
        found, truth = paths(seed)
        ref, est = sync.associate_trajectories(trajectory(truth), trajectory(found), max_diff=0.01)
        made[str(seed)] = one = {"poses": est.num_poses}
        one["ate_raw"] = statistics(metrics.APE(), (ref, est))
        for value, unit in ((1, "f"), (7, "f"), (1.0, "m"), (5.5, "m")):
            kind = unit_of.frames if unit == "f" else unit_of.meters
            for name, part in (
                ("rpe_m", relation.translation_part),
                ("rpe_rad", relation.rotation_angle_rad),
            ):
                metric = metrics.RPE(part, value, kind)
                one[f"{name} {value:g}{unit}"] = statistics(metric, (ref, est))
        est.align(ref, correct_scale=False)
        one["ate"] = statistics(metrics.APE(), (ref, est))
    return made


if __name__ == "__main__":
    OUT.write_text(json.dumps(numbers(), indent=1) + "\n", encoding="utf-8")
    print(f"wrote {OUT}")
