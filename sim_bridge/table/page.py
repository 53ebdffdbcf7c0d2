"""Page: the part of docs/results.md about simulated missions, between two marks."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from datetime import UTC, datetime
from importlib.resources import files
from pathlib import Path
from string import Template
from typing import TYPE_CHECKING

from symboslam.errors import OutputError
from symboslam.sim_bridge.table import paper
from symboslam.sim_bridge.table.figures import from_true_landmarks, pooled, verdicts
from symboslam.sim_bridge.table.finished import Finished
from symboslam.sim_bridge.table.tables import (
    mas_table,
    result_table,
    slam_table,
    speed_table,
    verdict_table,
)

if TYPE_CHECKING:
    from symboslam.reasoning.knowledge import Knowledge

MARKS = "<!-- sim table -->", "<!-- end of sim table -->"
FILM = "city"
"""The area that is filmed."""


def write_page(
    missions: Sequence[Finished],
    knowledge: Knowledge,
    out: Path,
    tell: Callable[[str, float], None] | None = None,
    failed: Mapping[str, str] | None = None,
) -> list[Path]:
    """Draw all pictures beside a page, and write the part between its marks.

    Args:
        missions: finished ones, at least one.
        knowledge: the environments, and what landmarks indicate.
        out: the page; it is made if it is not there. Pictures go to ``images`` beside it.
        tell: is told what is done.
        failed: name -> what went wrong, of missions that have no figures.

    Returns:
        The files that were written, the page first.

    Raises:
        OutputError: the page has no marks, or a file cannot be written.
    """
    from symboslam.engine.writers.atomic import atomic_file
    from symboslam.sim_bridge.table import film, plots

    tell = tell or (lambda stage, share: None)
    before, after = around(out)
    images = out.parent / "images"
    try:
        images.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{images}: {error.strerror or error}") from error
    mapped = [one for one in missions if one.plan["mapped"]]
    written, shown = [out], []
    for n, one in enumerate(mapped):
        tell(f"drawing {one.name}", 0.5 * n / len(mapped))
        written.append(images / f"sim-{one.name}.png")
        plots.draw_maps(one, knowledge, written[-1])
        shown.append(_picture(f"{one.world.name}: truth beside both maps", written[-1]))
        if one.name == FILM:
            tell(f"filming {one.name}", 0.5 * (n + 0.3) / len(mapped))
            written.append(images / f"sim-{one.name}.gif")
            film.draw_film(one, knowledge, written[-1])
            text = "City from above: to the left the ground that was swept, to the right the map"
            shown.append(_picture(text, written[-1]))
    curves = {}
    for name, draw, text in (
        ("coverage", plots.draw_coverage, "Ground seen, objects found and A'/A over time"),
        ("errors", plots.draw_errors, "Errors of poses and landmarks over time"),
    ):
        curves[name] = ""
        if mapped:
            tell("drawing curves", 0.6)
            written.append(images / f"sim-{name}.png")
            draw(mapped, written[-1])
            curves[name] = _picture(text, written[-1])
    tell("scoring all areas together", 0.7)
    together = {name: pooled(mapped, name, knowledge) for name in ("grid", "branch")}
    tell("classifying the true landmarks", 0.8)
    true = {name: from_true_landmarks(mapped, name, knowledge) for name in ("grid", "branch")}
    part = (
        _text(missions, mapped)
        | curves
        | {
            "failed": "".join(
                f"**Failed, and in no figure: {name} ({text}).**\n\n"
                for name, text in (failed or {}).items()
            ),
            "verdicts": verdict_table(verdicts(missions, together)),
            "mas": mas_table(missions),
            "slam": slam_table(missions),
            "results": result_table(missions, together, true),
            "maps": "\n\n".join(shown),
            "speed": speed_table(missions),
        }
    )
    text = (files("symboslam.sim_bridge.table") / "page.md").read_text(encoding="utf-8")
    template = Template(text)
    with atomic_file(out) as stream:
        stream.write(f"{before}\n\n{template.substitute(part)}\n{after}".encode())
    return written


def around(page: Path) -> tuple[str, str]:
    """What a page says up to the first mark, and from the second on; both marks if there is none.

    Raises:
        OutputError: the page is there without the marks, or cannot be read.
    """
    if not page.exists():
        return f"# Results\n\n{MARKS[0]}", f"{MARKS[1]}\n"
    try:
        before, mark, rest = page.read_text(encoding="utf-8").partition(MARKS[0])
    except (OSError, ValueError) as error:
        raise OutputError(f"{page} cannot be read: {error}") from error
    _, end, after = rest.partition(MARKS[1])
    if not mark or not end:
        raise OutputError(f"{page}: the marks {MARKS[0]} and {MARKS[1]} are missing")
    return before + mark, end + after


def _text(missions: Sequence[Finished], mapped: Sequence[Finished]) -> dict[str, str]:
    """When, on what and how the missions were flown."""
    from symboslam import __version__

    days = sorted({f"{datetime.fromtimestamp(o.run['begun'], UTC):%Y-%m-%d}" for o in missions})
    machines = sorted({f"{o.run['processors']} processors ({o.run['machine']})" for o in missions})
    load = max(one.run["load"] for one in missions)
    short = [one.name for one in missions if one.short]
    return {
        "date": " and ".join(days) if len(days) < 3 else f"{days[0]} to {days[-1]}",
        "machine": " and ".join(machines),
        "version": __version__,
        "how": _how(mapped or missions),
        "drift": f"{paper.DRIFT_M / 1000:g}",
        "iou": f"{paper.IOU:g}",
        "iou_in_text": f"{paper.IOU_IN_TEXT:g}",
        "short": (
            f"**Not the paper's time: {', '.join(short)}. These figures say nothing but that it "
            "runs.**\n\n"
            if short
            else ""
        ),
        "jobs": (
            "Missions are flown in processes of their own, some at once, so they slow each other "
            f"down; the load of the machine when one began was {load:.1f} at most."
        ),
    }


def _how(missions: Sequence[Finished]) -> str:
    """The settings, which are the same for all missions or said to differ."""
    parts = []
    for name, words in (
        ("robots", "{} robots"),
        ("speed", "{:g} m/s"),
        ("reach", "ground in view within {:g} m"),
        ("search", "search {}"),
        ("slam", "map building {}"),
        ("seed", "seed {}"),
        ("world_seed", "seed of the worlds {}"),
    ):
        values = {one.plan[name] for one in missions}
        if len(values) == 1:
            parts.append(words.format(values.pop()))
        else:
            parts.append(
                f"{name} differs: " + ", ".join(f"{o.name} {o.plan[name]}" for o in missions)
            )
    return (
        "All areas under one setting: " + ", ".join(parts)
        + "; a turning camera of 90 degrees, no GPS"
        + (", no oracle" if all(one.plan["slam"] != "oracle" for one in missions) else "") + "."
    )  # fmt: skip


def _picture(text: str, path: Path) -> str:
    return f"![{text}](images/{path.name})"
