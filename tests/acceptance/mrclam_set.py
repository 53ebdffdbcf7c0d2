"""A small MRCLAM set: two robots drive circles among eight landmarks, with odometry that drifts."""

from __future__ import annotations

from pathlib import Path

import numpy as np

LANDMARKS = 8
STEP = 0.5
"""Seconds between rows."""


def write_set(folder: Path, *, drift: float = 0.0, robots: int = 2) -> Path:
    """Write a set.

    Args:
        folder: is made.
        drift: radians a second by which odometry turns too far.
        robots: how many.
    """
    folder.mkdir()
    subjects = np.arange(6, 6 + LANDMARKS)
    angle = subjects * 2 * np.pi / LANDMARKS
    marks = np.column_stack([4 * np.cos(angle), 3 * np.sin(angle)])
    codes = [f"{s} {s + 100}" for s in (1, 2, 3, 4, 5, *subjects)]
    _write(folder, "Barcodes.dat", codes)
    places = zip(subjects, marks, strict=True)
    _write(folder, "Landmark_Groundtruth.dat", [f"{s} {x} {y} 0 0" for s, (x, y) in places])
    time = np.arange(0, 60, STEP)
    for n in range(1, robots + 1):
        turn = 2 * np.pi / 60
        heading = n + turn * time
        radius = 0.2 / turn
        path = np.column_stack([radius * np.sin(heading), -radius * np.cos(heading)])
        rows = [f"{t} 0.2 {turn + drift}" for t in time]
        _write(folder, f"Robot{n}_Odometry.dat", rows)
        poses = zip(time, path, heading, strict=True)
        _write(folder, f"Robot{n}_Groundtruth.dat", [f"{t} {x} {y} {h}" for t, (x, y), h in poses])
        seen = []
        for t, at, h in zip(time[::4], path[::4], heading[::4], strict=True):
            for subject, way in zip(subjects, marks - at, strict=True):
                bearing = (np.arctan2(way[1], way[0]) - h + np.pi) % (2 * np.pi) - np.pi
                if abs(bearing) < 1:
                    seen.append(f"{t} {subject + 100} {np.hypot(*way)} {bearing}")
        _write(folder, f"Robot{n}_Measurement.dat", seen)
    return folder


def _write(folder: Path, name: str, rows: list[str]) -> None:
    (folder / name).write_text("\n".join(rows) + "\n")
