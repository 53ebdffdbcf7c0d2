"""Plots: truth beside prediction, coverage, and errors of map building, as small PNGs."""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from symboslam.engine.writers.png_panel import INK, UNKNOWN
from symboslam.sim_bridge.table import paper
from symboslam.sim_bridge.table.finished import Finished

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from symboslam.reasoning.knowledge import Knowledge
    from symboslam.sim_bridge.search.area import Floats

LINES: tuple[tuple[str, Literal["-", "--", ":", "-."]], ...] = (
    ("#1b1b1b", "-"),
    ("#0b3d91", "--"),
    ("#8c1515", ":"),
    ("#0d5c2b", "-."),
)
"""Colour and dashes of robots: dark on the maps, and to be told apart without colours."""
CURVES = (("#0b3d91", "-"), ("#b45309", "--"), ("#444444", ":"))
DPI = 110


def robot_line(number: int) -> tuple[str, Literal["-", "--", ":", "-."]]:
    """Colour and dashes of the robot of that number, from 0."""
    return LINES[number % len(LINES)]


def draw_maps(one: Finished, knowledge: Knowledge, target: Path) -> None:
    """An area: its zones with the true paths and objects, beside both maps with the estimated ones.

    Raises:
        OutputError: it cannot be written.
    """
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    e = one.world.extent
    wide = 4.3
    high = wide * e.height / e.width
    figure = _figure(3 * wide + 0.2, high + 1.3)
    axes = figure.subplots(1, 3)
    colours = {x.name: (x.label, x.colour) for x in knowledge.environments}
    truth = one.folder / "record" / "zones.geojson"
    objects = np.array([(o.x, o.y) for o in one.world.objects], float).reshape(-1, 2)
    panels: list[tuple[str, Path, dict[str, Floats], Floats]] = [
        ("Truth", truth, one.true_paths, objects)
    ]
    maps = one.metrics["map"]
    for name in ("grid", "branch"):
        scores = maps.get(name)
        title = name.capitalize()
        if scores:
            title += f": IoU {scores['all']['mean_iou']:.2f}, AP {scores['all']['mean_ap']:.2f}"
        panels.append((title, one.folder / f"{name}.geojson", one.paths, one.landmark_xy))
    shown: set[str | None] = set()
    for axis, (title, areas, paths, marks) in zip(axes, panels, strict=True):
        shown |= draw_areas(axis, areas, {name: colour for name, (_, colour) in colours.items()})
        width = _width(paths, e.width)
        for n, name in enumerate(sorted(one.true_paths)):
            if name in paths:
                colour, dashes = robot_line(n)
                at = paths[name][:, 1:3].T
                axis.plot(*at, color="white", lw=2 * width, alpha=0.5 * width, zorder=3)
                axis.plot(*at, dashes, color=colour, lw=width, alpha=0.9, zorder=4)
        size = float(np.clip(45 / np.sqrt(len(marks) + 1), 0.8, 3.6))
        edge = 0.25 if size > 1.5 else 0.0
        axis.plot(*marks.T, "o", color=INK, ms=size, mec="white", mew=edge, zorder=5)
        axis.set_title(title, fontsize=11, color=INK)
        frame(axis, one)
    handles: list[Any] = [
        Patch(facecolor=colours[name][1], edgecolor="#5a5a5a", label=colours[name][0])
        for name in colours
        if name in shown
    ]
    if None in shown:
        handles.append(Patch(facecolor=UNKNOWN, edgecolor="#5a5a5a", label="unknown"))
    handles += [
        Line2D([], [], color=robot_line(n)[0], linestyle=robot_line(n)[1], label=name)
        for n, name in enumerate(sorted(one.true_paths))
    ]
    handles.append(Line2D([], [], marker="o", color=INK, linestyle="", ms=4, label="landmarks"))
    figure.legend(handles=handles, loc="outside lower center", ncols=7, frameon=False, fontsize=9)
    m = one.metrics
    figure.suptitle(
        f"{one.world.name}, {m['area_km2']:.2f} km², {m['robots']} robots, "
        f"{m['time_s'] / 60:.1f} min",
        fontsize=13, weight="bold", color=INK,
    )  # fmt: skip
    save(figure, target)


def _width(paths: dict[str, Floats], side: float) -> float:
    """Points that paths are wide: the thinner, the more often they cross the area."""
    ways = sum(float(np.hypot(*np.diff(path[:, 1:3], axis=0).T).sum()) for path in paths.values())
    return float(np.clip(15 * side / max(ways, 1e-9), 0.4, 1.0))


def draw_areas(axes: Axes, source: Path, colours: dict[str, str]) -> set[str | None]:
    """Draw zones or segments in their environments' colours; tells which there are."""
    import json

    import shapely
    from matplotlib.collections import PathCollection

    from symboslam.engine.writers.png import path_of

    features = json.loads(source.read_text(encoding="utf-8"))["features"]
    by_name: dict[str | None, list[Any]] = {}
    for feature in features:
        shape = shapely.from_geojson(_text(feature["geometry"]))
        by_name.setdefault(feature["properties"]["environment"], []).append(shape)
    axes.set_facecolor(UNKNOWN)
    for name, shapes in by_name.items():
        whole = shapely.union_all(shapely.make_valid(shapes))
        parts = [p for p in shapely.get_parts(whole) if p.geom_type == "Polygon"]
        axes.add_collection(
            PathCollection(
                [path_of(part) for part in parts], facecolors=colours.get(name or "", UNKNOWN),
                edgecolors="#5a5a5a", linewidths=0.4, zorder=1,
            ),
            autolim=False,
        )  # fmt: skip
    return set(by_name)


def draw_coverage(missions: Sequence[Finished], target: Path) -> None:
    """Coverage over time, a panel for each area, with what the paper's robots saw.

    Raises:
        OutputError: it cannot be written.
    """

    def panel(axes: Axes, one: Finished) -> None:
        minutes = one.coverage[:, 0] / 60
        found = one.coverage[:, 3] / max(one.metrics["objects"], 1)
        rows = (one.coverage[:, 1], found, one.coverage[:, 2])
        for values, label, (colour, dashes) in zip(
            rows, ("ground seen", "objects found", "A'/A"), CURVES, strict=True
        ):
            axes.plot(minutes, 100 * values, dashes, color=colour, lw=1.6, label=label)
        area = one.paper
        if area is not None and area.known:
            axes.plot(
                area.minutes, 100 * area.coverage, "*", ms=13, color="#d1478f", mec=INK, mew=0.7,
                clip_on=False, zorder=5, linestyle="", label="paper: ground seen",
            )  # fmt: skip
        axes.set_ylim(0, 103)
        axes.set_xlim(0, None)

    _small_multiples(missions, panel, "%", target)


def draw_errors(missions: Sequence[Finished], target: Path) -> None:
    """Errors of map building along the missions, a panel for each area.

    Raises:
        OutputError: it cannot be written.
    """

    def panel(axes: Axes, one: Finished) -> None:
        minutes = one.errors[:, 0] / 60
        labels = ("pose believed by the robot", "pose in the final map", "landmarks in view so far")
        for n, (label, (colour, dashes)) in enumerate(zip(labels, CURVES, strict=True), 1):
            values = np.maximum(one.errors[:, n], 0.01)
            axes.plot(minutes, values, dashes, color=colour, lw=1.6, label=label)
        axes.set_yscale("log")
        axes.set_ylim(0.5, max(axes.get_ylim()[1], 10))
        if one.metrics["area_km2"] < paper.SMALL_KM2:
            text = f"asked of landmarks: {paper.LANDMARK_M:g} m"
            axes.axhline(paper.LANDMARK_M, color="#d1478f", lw=1, label=text)
        axes.set_xlim(0, None)
        axes.yaxis.set_major_formatter(lambda value, _: f"{value:g}")

    _small_multiples(missions, panel, "metres", target)


def _small_multiples(
    missions: Sequence[Finished],
    panel: Callable[[Axes, Finished], None],
    unit: str,
    target: Path,
) -> None:
    """A panel for each mission, three in a row, and one legend for all."""
    columns = min(3, len(missions))
    rows = -(-len(missions) // columns)
    figure = _figure(3.9 * columns + 0.3, 2.7 * rows + 0.6)
    axes = np.atleast_1d(figure.subplots(rows, columns, squeeze=False)).ravel()
    handles: dict[str, Any] = {}
    for axis in axes[len(missions) :]:
        axis.set_axis_off()
    for n, (axis, one) in enumerate(zip(axes, missions, strict=False)):
        panel(axis, one)
        axis.set_title(one.world.name, fontsize=11, color=INK)
        axis.grid(color="#e2e2e2", lw=0.7)
        axis.tick_params(labelsize=8.5)
        for side in ("top", "right"):
            axis.spines[side].set_visible(False)
        if n % columns == 0:
            axis.set_ylabel(unit, fontsize=9)
        axis.set_xlabel("minutes", fontsize=9)
        for handle, label in zip(*axis.get_legend_handles_labels(), strict=True):
            handles.setdefault(label, handle)
    figure.legend(
        handles.values(), handles.keys(), loc="outside lower center", ncols=(1, 2, 4)[columns - 1],
        frameon=False, fontsize=9,
    )  # fmt: skip
    save(figure, target)


def frame(axes: Axes, one: Finished) -> None:
    """The extent of an area, true to scale, without ticks."""
    e = one.world.extent
    axes.set(xlim=(e.min_x, e.max_x), ylim=(e.min_y, e.max_y), aspect="equal", xticks=[], yticks=[])
    for spine in axes.spines.values():
        spine.set_color("#888")


def _figure(wide: float, high: float) -> Figure:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(wide, high), dpi=DPI, facecolor="white", layout="constrained")
    FigureCanvasAgg(figure)
    return figure


def save(figure: Figure, target: Path) -> None:
    """Write a PNG of at most 128 colours.

    Raises:
        OutputError: it cannot be written.
    """
    from PIL import Image

    from symboslam.engine.writers.atomic import atomic_file

    drawn = io.BytesIO()
    figure.savefig(drawn, format="png")
    with atomic_file(target) as stream, Image.open(drawn) as image:
        image.convert("RGB").quantize(128).save(stream, format="png", optimize=True)


def _text(geometry: Any) -> str:
    import json

    return json.dumps(geometry)
