"""Environment maps as a picture to print or to put into a report."""

from __future__ import annotations

import math
import warnings
from pathlib import PurePath
from textwrap import wrap
from typing import TYPE_CHECKING, Any, BinaryIO

import numpy as np
import shapely
from numpy.typing import NDArray

from symboslam import __version__
from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.writers.options import WriteOptions
from symboslam.engine.writers.png_panel import INK, PALEST, UNKNOWN, dot_classes, draw_panel

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.path import Path

PIXELS = (1600, 1200)
DPI = 100
_LINE = 200
"""Characters that fit below the map."""
OUTLINED = 50_000
"""Up to this many segments the borders between environments are drawn."""


def write(environment_map: EnvironmentMap, stream: BinaryIO, options: WriteOptions) -> None:
    """Draw a map of 1600 x 1200 pixels.

    Segments have the colour of their environment, the fuller the more certain it is; landmarks are
    dots by class. Beside the map: the environments with their share of the area, the classes, a
    scale bar, and north where the map is geographic.

    Args:
        environment_map: the map.
        stream: where to write the PNG.
        options: ``progress`` is used.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    options.tell("drawing the picture", 0.0)
    figure = Figure(figsize=(PIXELS[0] / DPI, PIXELS[1] / DPI), dpi=DPI, facecolor="white")
    FigureCanvasAgg(figure)
    axes = figure.add_axes((0.03, 0.065, 0.7, 0.835))
    _frame(axes, environment_map)
    _draw_segments(axes, environment_map)
    options.tell("drawing the picture", 0.4)
    _draw_landmarks(axes, environment_map)
    _draw_scale_bar(axes, environment_map)
    if environment_map.landmarks.frame.geographic:
        _draw_north(axes)
    draw_panel(figure, environment_map)
    title = title_of(environment_map)
    figure.text(0.03, 0.945, title, size=21, weight="bold", color=INK, parse_math=False)
    figure.text(0.03, 0.915, _subtitle(environment_map), size=12, color="#555", parse_math=False)
    footer = _footer(environment_map)
    figure.text(0.03, 0.043, footer, size=10, color="#777", va="top", parse_math=False)
    with warnings.catch_warnings():  # a name in a script that the font lacks shows as boxes
        warnings.filterwarnings("ignore", "Glyph .* missing from font")
        metadata = {"Title": title, "Software": f"SymboSLAM {__version__}"}
        figure.savefig(stream, format="png", metadata=metadata)
    options.tell("drawing the picture", 1.0)


def title_of(m: EnvironmentMap) -> str:
    """What the picture shows, by the name of its source."""
    source = PurePath(m.landmarks.report.source.replace("\\", "/"))
    name = source.name if source.name not in ("", "-") else "landmarks"
    if name.split(".")[0] == "landmarks" and source.parent.name:
        name = source.parent.name
    return f"Environment types: {name}".encode("utf-8", "replace").decode()


def _subtitle(m: EnvironmentMap) -> str:
    scheme = f" · scheme {m.config['scheme']}" if "scheme" in m.config else ""
    return (
        f"profile {m.config.get('profile', '?')}{scheme} · {len(m.landmarks):,} landmarks · "
        f"{len(m):,} segments"
    )


def _footer(m: EnvironmentMap) -> str:
    """The area, and below it whose data are shown, in at most two lines."""
    report = m.landmarks.report
    west, south, east, north = m.landmarks.bbox
    x, y = m.landmarks.frame.from_metres([west, east], [south, north])
    if m.landmarks.frame.geographic:
        ends = [f"{abs(v):.4f}° {'EW'[int(v < 0)]}" for v in x]
        ends += [f"{abs(v):.4f}° {'NS'[int(v < 0)]}" for v in y]
        area = f"{ends[0]} to {ends[1]}, {ends[2]} to {ends[3]} (WGS 84)"
    else:
        area = f"x {x[0]:,.0f} to {x[1]:,.0f} m, y {y[0]:,.0f} to {y[1]:,.0f} m (local metres)"
    return "\n".join([f"{area} · SymboSLAM {__version__}", *wrap(report.attribution, _LINE)])


def _frame(axes: Axes, m: EnvironmentMap) -> None:
    """The map's area, true to scale."""
    west, south, east, north = m.landmarks.bbox
    axes.set_xlim(west, east if east > west else west + 1)
    axes.set_ylim(south, north if north > south else south + 1)
    axes.set_aspect("equal", anchor="NW")
    axes.set_xticks([])
    axes.set_yticks([])
    for spine in axes.spines.values():
        spine.set_color("#999")


def _draw_segments(axes: Axes, m: EnvironmentMap) -> None:
    """Segments in the colour of their environment, then the borders between environments."""
    from matplotlib.collections import LineCollection, PathCollection

    axes.add_collection(
        PathCollection(
            [path_of(g) for g in m.geometry],
            facecolors=fills(m),
            edgecolors="white" if len(m) <= OUTLINED else "face",
            linewidths=0.35,
            zorder=1,
        ),
        autolim=False,
    )
    if len(m) > OUTLINED:
        return
    for label in np.unique(m.label):
        whole = shapely.union_all(m.geometry[m.label == label])
        rings = [shapely.get_coordinates(r) for r in shapely.get_rings(shapely.get_parts(whole))]
        border = LineCollection(rings, colors="#5a5a5a", linewidths=0.7, zorder=2)
        axes.add_collection(border, autolim=False)


def fills(m: EnvironmentMap) -> NDArray[np.float64]:
    """(s, 3) red, green and blue of each segment in [0, 1]: paler where it is less certain."""
    from matplotlib.colors import to_rgb

    k = max(len(m.environments), 2)
    colours = np.array([to_rgb(e.colour) for e in m.environments] + [to_rgb(UNKNOWN)])
    certainty = np.clip((m.probability.max(1, initial=0.0) - 1 / k) / (1 - 1 / k), 0, 1)
    opacity = np.where(m.label < 0, 1.0, PALEST + (1 - PALEST) * certainty)[:, None]
    return np.asarray(colours[m.label] * opacity + (1 - opacity))


def path_of(geometry: Any) -> Path:
    """A polygon, with its holes, or several, as one path."""
    from matplotlib.path import Path

    parts = []
    for ring in shapely.get_rings(shapely.get_parts(shapely.orient_polygons(geometry))):
        corners = shapely.get_coordinates(ring)
        codes = np.full(len(corners), Path.LINETO, np.uint8)
        codes[0], codes[-1] = Path.MOVETO, Path.CLOSEPOLY
        parts.append(Path(corners, codes))
    return Path.make_compound_path(*parts)


def _draw_landmarks(axes: Axes, m: EnvironmentMap) -> None:
    """A dot for each landmark, the most frequent classes in colours of their own, on top."""
    size = min(max(130 / math.sqrt(len(m.landmarks) + 1), 0.9), 5.0)
    for dots in reversed(dot_classes(m)):
        here = np.isin(m.landmarks.feature, dots.features)
        axes.plot(
            m.landmarks.x[here],
            m.landmarks.y[here],
            dots.marker,
            color=dots.colour,
            markersize=size * dots.size,
            markeredgecolor="white",
            markeredgewidth=0.3 if size > 3 else 0.0,
            zorder=3,
            scalex=False,
            scaley=False,
        )


def _draw_scale_bar(axes: Axes, m: EnvironmentMap) -> None:
    """A bar of a round length, about a fifth of the map's width, on a light ground."""
    from matplotlib.patches import Rectangle

    low, high = axes.get_xlim()
    bottom, top = axes.get_ylim()
    unit = max(high - low, top - bottom) / 100
    length = round_length(min(0.22 * (high - low), 25 * unit))
    x, y = low + 2.5 * unit, bottom + 2.2 * unit
    ground = Rectangle(
        (x - unit, y - unit), length + 4 * unit, 4.4 * unit, facecolor="white", alpha=0.85, zorder=5
    )
    axes.add_patch(ground)
    for i, colour in enumerate((INK, "white")):
        half = Rectangle(
            (x + i * length / 2, y),
            length / 2,
            0.8 * unit,
            facecolor=colour,
            edgecolor=INK,
            linewidth=1,
            zorder=6,
        )
        axes.add_patch(half)
    text = f"{length / 1000:g} km" if length >= 1000 else f"{length:g} m"
    axes.text(x, y + 1.4 * unit, "0", size=11, ha="center", color=INK, zorder=6)
    axes.text(x + length, y + 1.4 * unit, text, size=11, ha="center", color=INK, zorder=6)


def round_length(longest: float) -> float:
    """The largest of 1, 2, 5, 10, 20, ... and their fractions that is not above ``longest``."""
    if longest <= 0:
        return 1.0
    power = 10.0 ** math.floor(math.log10(longest))
    return max(step * power for step in (1, 2, 5) if step * power <= longest)


def _draw_north(axes: Axes) -> None:
    """An arrow to the north, in the upper right corner."""
    axes.annotate(
        "N",
        xy=(0.965, 0.975),
        xytext=(0.965, 0.905),
        xycoords="axes fraction",
        ha="center",
        va="center",
        size=15,
        weight="bold",
        color=INK,
        bbox={"boxstyle": "circle,pad=0.25", "facecolor": "white", "alpha": 0.85, "linewidth": 0},
        arrowprops={"arrowstyle": "-|>,head_width=0.45,head_length=0.8", "color": INK, "lw": 2},
        zorder=7,
    )
