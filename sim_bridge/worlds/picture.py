"""Picture: a world as a PNG: zones in their environments' colours, streets, objects, a legend."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from symboslam.sim_bridge.worlds.world import World

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_INCHES = 8.0
_DPI = 110
_OTHER = ("#4a4a4a", ".")


def draw_world(world: World, target: str | Path) -> None:
    """Write a picture of a world.

    Raises:
        OutputError: it cannot be written; what was there before is kept.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    from symboslam.engine.writers.atomic import atomic_file
    from symboslam.engine.writers.png_panel import INK

    e = world.extent
    longer = max(e.width, e.height)
    wide, high = _INCHES * e.width / longer, _INCHES * e.height / longer
    high_panel = max(high, 5.6)
    figure = Figure(figsize=(wide + 3.1, high_panel + 0.95), dpi=_DPI, facecolor="white")
    FigureCanvasAgg(figure)
    total_w, total_h = figure.get_size_inches()
    axes = figure.add_axes(
        (0.15 / total_w, (total_h - 0.6 - high) / total_h, wide / total_w, high / total_h)
    )
    axes.set_xlim(e.min_x, e.max_x)
    axes.set_ylim(e.min_y, e.max_y)
    axes.set_aspect("equal")
    axes.set_xticks([])
    axes.set_yticks([])
    axes.set_facecolor("#f4f4f2")
    for spine in axes.spines.values():
        spine.set_color("#888")
    zones = _draw_zones(axes, world)
    _draw_lines(axes, world, wide * 72 / e.width)
    marks = _draw_objects(axes, world)
    _draw_scale(axes, world)
    panel = figure.add_axes(
        ((wide + 0.3) / total_w, 0.1 / total_h, 2.7 / total_w, (total_h - 0.7) / total_h)
    )
    panel.set_axis_off()
    first = panel.legend(
        handles=zones, title="Zones, share of the area", loc="upper left", frameon=False,
        alignment="left", fontsize=9, title_fontproperties={"weight": "bold", "size": 10},
        borderaxespad=0, handlelength=1.4,
    )  # fmt: skip
    panel.add_artist(first)
    panel.legend(
        handles=marks, title="Objects", loc="lower left", frameon=False, alignment="left",
        fontsize=9, title_fontproperties={"weight": "bold", "size": 10}, borderaxespad=0,
    )  # fmt: skip
    title = f"{world.name}: {e.area_km2:.4g} km², {len(world.objects):,} objects"
    figure.text(
        0.15 / total_w, 1 - 0.38 / total_h, title, size=14, weight="bold", color=INK,
        parse_math=False,
    )  # fmt: skip
    with atomic_file(target) as stream:
        figure.savefig(stream, format="png")


def _draw_zones(axes: Axes, world: World) -> list[Any]:
    """Zones in their colours; handles for the legend, the largest first."""
    from matplotlib.collections import PathCollection
    from matplotlib.patches import Patch

    from symboslam.engine.writers.png import path_of
    from symboslam.reasoning.knowledge import Knowledge

    known = {e.name: (e.label, e.colour) for e in Knowledge.load().environments}
    colours = [known.get(zone.environment, ("", "#bbbbbb"))[1] for zone in world.zones]
    if world.zones:
        axes.add_collection(
            PathCollection(
                [path_of(zone.polygon) for zone in world.zones], facecolors=colours,
                edgecolors="#5a5a5a", linewidths=0.6, alpha=0.75, zorder=1,
            ),
            autolim=False,
        )  # fmt: skip
    handles = []
    for name, area in world.zone_areas_km2().items():
        label, colour = known.get(name, (name, "#bbbbbb"))
        share = area / world.extent.area_km2
        text = f"{label}  {share:.0%}" if share >= 0.01 else f"{label}  {share:.1%}"
        handles.append(Patch(facecolor=colour, edgecolor="#5a5a5a", alpha=0.75, label=text))
    return handles


def _draw_lines(axes: Axes, world: World, points_per_metre: float) -> None:
    """Streets, as wide as they are but to be seen; walls; robot starts."""
    from matplotlib.collections import LineCollection

    if world.roads:
        axes.add_collection(
            LineCollection(
                [road.points for road in world.roads], colors="#ffffff",
                linewidths=[max(1.1, road.width * points_per_metre) for road in world.roads],
                capstyle="butt", zorder=2,
            ),
            autolim=False,
        )  # fmt: skip
    if world.walls:
        walls = LineCollection([w.points for w in world.walls], colors="#222", linewidths=1.6)
        axes.add_collection(walls, autolim=False)
    for number, start in enumerate(world.starts[:3], 1):
        axes.plot(
            start.x, start.y, marker="o", markersize=9, color="white", markeredgecolor="#111",
            zorder=5, scalex=False, scaley=False,
        )  # fmt: skip
        axes.annotate(str(number), (start.x, start.y), ha="center", va="center", size=6.5, zorder=6)


def _draw_objects(axes: Axes, world: World) -> list[Any]:
    """Marks for the most frequent classes, one for all others; handles for the legend."""
    from matplotlib.lines import Line2D

    from symboslam.engine.writers.png_panel import DOTS

    counts = world.class_counts
    shown = list(counts)[: len(DOTS)]
    size = float(np.clip(150 / np.sqrt(len(world.objects) + 1), 1.7, 6.0))
    handles = []
    others = [o for o in world.objects if o.kind not in shown]
    rows = [(kind, *dot) for kind, dot in zip(shown, DOTS, strict=False)]
    if others:
        rows.append(("", *_OTHER))
    for kind, colour, marker in rows:
        here = [o for o in world.objects if o.kind == kind] if kind else others
        axes.plot(
            [o.x for o in here], [o.y for o in here], marker, color=colour,
            markersize=size * (0.8 if marker == "." else 1), markeredgecolor="white",
            markeredgewidth=0.3 if size > 3 else 0, zorder=3, scalex=False, scaley=False,
        )  # fmt: skip
        text = f"{kind}  {len(here):,}" if kind else f"other classes  {len(here):,}"
        handles.append(
            Line2D([], [], marker=marker, color=colour, linestyle="", markersize=6, label=text)
        )
    if world.starts:
        label = "starts of the first three robots" if len(world.starts) > 2 else "robot starts"
        handles.append(
            Line2D([], [], marker="o", color="white", markeredgecolor="#111", linestyle="",
                   markersize=8, label=label)
        )  # fmt: skip
    return handles


def _draw_scale(axes: Axes, world: World) -> None:
    """A bar of a round length below the map."""
    from matplotlib.patches import Rectangle

    from symboslam.engine.writers.png import round_length
    from symboslam.engine.writers.png_panel import INK

    e = world.extent
    unit = max(e.width, e.height) / 100
    length = round_length(min(0.25 * e.width, 25 * unit))
    x, y = e.min_x, e.min_y - 2.4 * unit
    axes.add_patch(Rectangle((x, y), length, 0.9 * unit, facecolor=INK, clip_on=False))
    text = f"{length / 1000:g} km" if length >= 1000 else f"{length:g} m"
    axes.text(x + length + unit, y + 0.4 * unit, text, va="center", size=10, color=INK)
