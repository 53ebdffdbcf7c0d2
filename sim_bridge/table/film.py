"""Film: a mission from above as a GIF: robots, swept ground, landmarks, the map that grows."""

from __future__ import annotations

import io
import json
from collections.abc import Iterator
from copy import deepcopy
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from symboslam.engine.writers.png_panel import INK, UNKNOWN
from symboslam.sim_bridge.table.finished import Finished
from symboslam.sim_bridge.table.plots import LINES, frame, robot_line

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from PIL.Image import Image

    from symboslam.engine.environment_map import EnvironmentMap
    from symboslam.reasoning.knowledge import Knowledge
    from symboslam.sim_bridge.search.area import Floats
    from symboslam.sim_bridge.search.coverage import Coverage

FRAMES = 110
STILL = 12
"""Frames that the last picture stays."""
EVERY = 3
"""Frames after which the map is classified anew."""
DPI = 100
PANEL = 3.9
"""Inches of a panel's width."""
TAIL = 90.0
"""Seconds of way that are drawn behind a robot."""


def draw_film(one: Finished, knowledge: Knowledge, target: Path, frames: int = FRAMES) -> None:
    """Write the GIF: to the left where robots truly are and what they swept, to the right the map.

    Robots and landmarks of the map are where it says at the end, from when they were in view.

    Args:
        one: the mission, with a map.
        knowledge: what landmarks indicate.
        target: the file.
        frames: how many, besides the last that stays.

    Raises:
        OutputError: it cannot be written.
    """
    from PIL.Image import Dither

    from symboslam.engine.writers.atomic import atomic_file

    pictures = list(_pictures(one, knowledge, frames))
    palette = _palette(pictures[-1], [e.colour for e in knowledge.environments])
    small = [picture.quantize(palette=palette, dither=Dither.NONE) for picture in pictures]
    with atomic_file(target) as stream:
        small[0].save(
            stream, format="GIF", save_all=True, append_images=[*small[1:], *STILL * [small[-1]]],
            duration=110, loop=0, optimize=True, disposal=1,
        )  # fmt: skip


def _palette(last: Image, colours: list[str]) -> Image:
    """64 colours for all frames, so that what does not change stays as it is.

    They are those of the last frame, with enough of each colour that a frame may have.
    """
    from PIL import Image as Images
    from PIL import ImageDraw

    swatch = max(1, last.height // 8)
    wanted = [*colours, UNKNOWN, INK, *(colour for colour, _ in LINES)]
    sheet = Images.new("RGB", (last.width, last.height + swatch * len(wanted)))
    sheet.paste(last)
    for n, colour in enumerate(wanted):
        top = last.height + n * swatch
        ImageDraw.Draw(sheet).rectangle((0, top, sheet.width, top + swatch), fill=colour)
    return sheet.quantize(64)


def _pictures(one: Finished, knowledge: Knowledge, frames: int) -> Iterator[Image]:
    """The frames, from the first second to the last."""
    from symboslam.sim_bridge.search.coverage import Coverage

    e, end, reach = one.world.extent, one.metrics["time_s"], one.plan["reach"]
    config = json.loads((one.folder / "record" / "config.json").read_text(encoding="utf-8"))
    swept = Coverage((e.min_x, e.min_y, e.max_x, e.max_y), reach / 12)
    handles = _legend(one, knowledge, _map_at(one, knowledge, end))
    before, grown = 0.0, None
    for number in range(frames):
        time = end * (number + 1) / frames
        _sweep(swept, one.true_paths, before, time, reach, config["bridge"]["camera"]["fov"])
        before = time
        if number % EVERY == 0 or number == frames - 1:
            grown = _map_at(one, knowledge, time)
        yield _picture(one, time, swept, grown, handles)


def _picture(
    one: Finished, time: float, swept: Coverage, grown: EnvironmentMap | None, handles: list[Any]
) -> Image:
    """One frame: the truth to the left, the map to the right."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.colors import ListedColormap
    from matplotlib.figure import Figure
    from PIL import Image as Images

    e = one.world.extent
    wide, high = 2 * PANEL + 0.3, PANEL * e.height / e.width + 1.15
    figure = Figure(figsize=(wide, high), dpi=DPI, facecolor="white")
    FigureCanvasAgg(figure)
    left, right = (figure.add_axes((x, 0.75 / high, 0.48, 1 - 1.1 / high)) for x in (0.013, 0.507))
    left.imshow(
        swept.seen, origin="lower", extent=(e.min_x, e.max_x, e.min_y, e.max_y),
        cmap=ListedColormap(["#cfcbc2", "#fbfaf6"]), vmin=0, vmax=1, interpolation="nearest",
    )  # fmt: skip
    right.set_facecolor(UNKNOWN)
    if grown is not None:
        _draw_map(right, grown)
    found, mapped = one.object_seen <= time, one.landmark_seen <= time
    objects = np.array([(o.x, o.y) for o in one.world.objects], float).reshape(-1, 2)
    left.plot(*objects[found].T, ".", ms=3.2, color=INK, mew=0)
    right.plot(*one.landmark_xy[mapped].T, ".", ms=3.2, color=INK, mew=0)
    for n, name in enumerate(sorted(one.true_paths)):
        _robot(left, one.true_paths[name], time, n, tail=True)
        if name in one.paths:
            _robot(right, one.paths[name], time, n, tail=False)
    seen = f"{time / 60:4.1f} min · truth: {one.coverage_at(time):.0%} of the ground seen"
    left.set_title(seen, fontsize=10, loc="left")
    right.set_title(f"map: {int(mapped.sum())} landmarks, environments", fontsize=10, loc="left")
    for axis in (left, right):
        frame(axis, one)
    figure.legend(
        handles=handles, loc="lower center", ncols=4, frameon=False, fontsize=8.5,
        bbox_to_anchor=(0.5, 0.0), borderaxespad=0.5,
    )  # fmt: skip
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png")
    with Images.open(drawn) as picture:
        return picture.convert("RGB")


def _legend(one: Finished, knowledge: Knowledge, last: EnvironmentMap | None) -> list[Any]:
    """The environments of the truth and of the map at the end."""
    from matplotlib.patches import Patch

    used = {zone.environment for zone in one.world.zones}
    if last is not None:
        used |= {last.environments[k].name for k in set(last.label.tolist()) if k >= 0}
    rows = [(e.label, e.colour) for e in knowledge.environments if e.name in used]
    return [
        Patch(facecolor=colour, edgecolor="#5a5a5a", label=label)
        for label, colour in [*rows, ("unknown", UNKNOWN)]
    ]


def _draw_map(axes: Axes, grown: EnvironmentMap) -> None:
    """Segments in their environments' colours."""
    from matplotlib.collections import PathCollection

    from symboslam.engine.writers.png import path_of

    colours = [*(e.colour for e in grown.environments), UNKNOWN]  # -1 is unknown
    axes.add_collection(
        PathCollection(
            [path_of(g) for g in grown.geometry], facecolors=[colours[k] for k in grown.label],
            edgecolors="face", linewidths=0.3,
        ),
        autolim=False,
    )  # fmt: skip


def _robot(axes: Axes, path: Floats, time: float, number: int, *, tail: bool) -> None:
    """A robot and the way behind it."""
    colour, _ = robot_line(number)
    upto = int(np.searchsorted(path[:, 0], time + 1e-9, side="right"))
    x, y = path[max(upto - 1, 0), 1:3].tolist()
    if tail:
        since = path[:upto][path[:upto, 0] > time - TAIL]
        axes.plot(since[:, 1], since[:, 2], color=colour, lw=1.3)
    axes.plot(x, y, "o", ms=9, color=colour, mec="white", mew=1.0, zorder=6)
    axes.annotate(
        str(number + 1), (x, y), ha="center", va="center", fontsize=6.5, color="white", zorder=7,
        annotation_clip=True,
    )  # fmt: skip


def _sweep(
    grid: Coverage, paths: dict[str, Floats], since: float, until: float, reach: float, fov: float
) -> None:
    """Mark what the robots looked at between two times."""
    for path in paths.values():
        first = max(int(np.searchsorted(path[:, 0], since + 1e-9)) - 1, 0)
        last = int(np.searchsorted(path[:, 0], until + 1e-9, side="right"))
        for k in range(first, last):
            grid.sweep(path[max(k - 1, 0), 1:4], path[k, 1:4], reach, fov)


def _map_at(one: Finished, knowledge: Knowledge, time: float) -> EnvironmentMap | None:
    """The environment map of what was in view by a time; unknown where nobody was."""
    import shapely

    from symboslam.engine.readers import read_landmarks
    from symboslam.sim_bridge.mission.survey import classify_survey

    document = deepcopy(one.landmarks)
    document["features"] = [
        feature
        for feature, seen in zip(document["features"], one.landmark_seen, strict=True)
        if seen <= time
    ]
    if not document["features"]:
        return None
    ways = [path[path[:, 0] <= time][:, 1:3] for path in one.paths.values()]
    lines = [
        shapely.LineString(way[[*range(len(way)), -1]]).simplify(1.0) for way in ways if len(way)
    ]
    around = shapely.union_all([line.buffer(one.plan["reach"], 4) for line in lines])
    around = around.intersection(shapely.box(*document["bbox"]))
    if not around.is_empty:
        document["surveyed"] = json.loads(shapely.to_geojson(shapely.set_precision(around, 0.01)))
    landmarks = read_landmarks(document, knowledge)
    return classify_survey(landmarks, knowledge, "grid")
