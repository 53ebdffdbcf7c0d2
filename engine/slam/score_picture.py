"""A picture of a comparison: true and estimated paths and landmarks, with lines for the errors."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from symboslam.engine.slam.log import Floats
from symboslam.engine.slam.planar import place
from symboslam.engine.slam.score import SlamScore
from symboslam.engine.slam.score_files import Side
from symboslam.engine.slam.trajectory_error import associate
from symboslam.engine.writers.atomic import atomic_file

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TRUE, FOUND, ERROR = "#666666", "#0072b2", "#d55e00"
LINES = 200
"""Most error lines of one path."""


def draw(
    target: Path,
    score: SlamScore,
    estimate: Side,
    truth: Side,
    *,
    align: bool,
    max_diff: float,
) -> None:
    """Write a PNG of 1600 x 1200 pixels.

    Args:
        target: the file.
        score: of what is drawn.
        estimate: what is compared.
        truth: with what.
        align: draw each path, and the landmarks, as they are after their alignment.
        max_diff: seconds between poses of one moment.

    Raises:
        OutputError: the file cannot be written; what was there before is kept.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(16, 12), dpi=100, layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot(aspect="equal", xlabel="x in metres", ylabel="y in metres")
    for name, path in estimate.paths.items():
        robot = score.robots.get(name)
        move = robot.alignment if align and robot is not None else None
        xy = path.pose[:, :2] if move is None else place(move, path.pose[:, :2])
        _line(axes, xy, FOUND, "estimated path")
        if name in truth.paths:
            true = truth.paths[name]
            _line(axes, true.pose[:, :2], TRUE, "true path", "--")
            i, j = associate(path.time, true.time, max_diff)
            some = slice(None, None, len(i) // LINES + 1)
            _errors(axes, xy[i][some], true.pose[j][some, :2])
    points, true_points = estimate.points, truth.points
    if points is not None and true_points is not None:
        best = score.aligned if align and score.aligned is not None else score.raw
        move = None if best is None else best.alignment
        xy = points.xy if move is None else place(move, points.xy)
        axes.plot(*true_points.xy.T, "+", color=TRUE, markersize=11, label="true landmark")
        axes.plot(*xy.T, "o", color=FOUND, markersize=5, label="estimated landmark")
        if best is not None:
            _errors(axes, xy[best.pairs[:, 0]], true_points.xy[best.pairs[:, 1]])
    axes.set_title("Estimate and truth" + (", aligned" if align else ""))
    handles = dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))
    axes.legend(handles.values(), handles.keys())
    with atomic_file(target) as stream:
        figure.savefig(stream, format="png")


def _line(axes: Axes, xy: Floats, color: str, label: str, style: str = "-") -> None:
    axes.plot(*xy.T, style, color=color, linewidth=1.5, label=label)


def _errors(axes: Axes, one: Floats, other: Floats) -> None:
    """A line from each point to the other; one line with gaps, which is drawn fast."""
    gap = np.full_like(one, np.nan)
    ends = np.stack([one, other, gap], 1).reshape(-1, 2)
    axes.plot(*ends.T, color=ERROR, linewidth=0.8, label="error", zorder=1)
