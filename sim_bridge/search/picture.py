"""Picture: paths of robots on what they have seen, one panel for each strategy."""

from __future__ import annotations

import io
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path

import numpy as np

from symboslam.engine.writers.atomic import atomic_file
from symboslam.sim_bridge.search.area import Area, Circle, Floats
from symboslam.sim_bridge.search.coverage import Coverage
from symboslam.sim_bridge.search.trial import Trial

_COLOURS = ("#1b6ca8", "#c8553d", "#3a7d44", "#8e5aa8", "#b8860b", "#444444", "#d1478f", "#2aa198")


def draw_paths(
    panels: Sequence[tuple[str, Area, Floats, Trial]], seconds: float, target: Path
) -> None:
    """Write a PNG of what each trial had done by a time.

    Args:
        panels: a title, the ground with its features, and the trial.
        seconds: the time.
        target: the file.

    Raises:
        OutputError: the file cannot be written.
    """
    from matplotlib.colors import ListedColormap
    from matplotlib.figure import Figure
    from matplotlib.patches import Circle as Disc
    from matplotlib.patches import Rectangle
    from PIL import Image  # comes with matplotlib

    columns = min(len(panels), 2 if len(panels) == 4 else 3)
    rows = -(-len(panels) // columns)
    figure = Figure(figsize=(3.6 * columns, 3.9 * rows), dpi=100, layout="constrained")
    axes = np.atleast_1d(figure.subplots(rows, columns, squeeze=False)).ravel()
    for axis in axes[len(panels) :]:
        axis.set_axis_off()
    for axis, (title, area, features, trial) in zip(axes, panels, strict=False):
        upto = int(np.searchsorted(trial.metrics.time, seconds, side="right"))
        paths = trial.paths[:upto]
        grid = _seen(area, paths)
        low_x, low_y, high_x, high_y = area.extent
        axis.imshow(
            grid.seen, origin="lower", extent=(low_x, high_x, low_y, high_y), vmin=0, vmax=1,
            cmap=ListedColormap(["#d9d5cc", "#ffffff"]), interpolation="nearest",
        )  # fmt: skip
        for shape in area.obstacles:
            if isinstance(shape, Circle):
                axis.add_patch(Disc((shape.x, shape.y), shape.radius, color="#777777"))
            else:
                size = shape.max_x - shape.min_x, shape.max_y - shape.min_y
                axis.add_patch(Rectangle((shape.min_x, shape.min_y), *size, color="#777777"))
        found = trial.metrics.found <= seconds
        axis.plot(*features[found].T, ".", ms=2, color="#999999")
        axis.plot(*features[~found].T, "x", ms=4, color="black")
        for robot in range(area.robots):
            colour = _COLOURS[robot % len(_COLOURS)]
            axis.plot(paths[:, robot, 0], paths[:, robot, 1], lw=0.9, color=colour)
            axis.plot(*paths[0, robot, :2], "o", ms=5, color=colour)
        share = trial.metrics.coverage_at(seconds)
        at = min(seconds, float(trial.metrics.time[-1]))
        axis.set_title(f"{title}: {share:.1%} in {at / 60:.1f} min", fontsize=10)
        axis.set(xlim=(low_x, high_x), ylim=(low_y, high_y), aspect="equal", xticks=[], yticks=[])
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png")
    with atomic_file(target) as handle, Image.open(drawn) as image:
        image.convert("RGB").quantize(48).save(handle, format="png", optimize=True)


def _seen(area: Area, paths: Floats) -> Coverage:
    """What was seen along paths."""
    grid = Coverage.of(area)
    for before, after in pairwise(paths):
        for robot in range(area.robots):
            grid.sweep(before[robot], after[robot], area.reach, area.fov)
    return grid
