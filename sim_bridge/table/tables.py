"""Tables: the figures of all areas in Markdown, the paper's beside ours."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from symboslam.sim_bridge.table import paper
from symboslam.sim_bridge.table.area_run import SEGMENTATIONS
from symboslam.sim_bridge.table.figures import Verdict, wall_minutes
from symboslam.sim_bridge.table.finished import Finished

if TYPE_CHECKING:
    from symboslam.engine.evaluation.metrics import Result

DASH = "–"


def verdict_table(verdicts: Sequence[Verdict]) -> str:
    """What is asked for, one row each."""
    rows = [[v.target, v.asked, v.ours or DASH, v.text] for v in verdicts]
    return markdown(["what is asked for", "figure", "ours", ""], rows)


def mas_table(missions: Sequence[Finished]) -> str:
    """The multi-agent system: time, coverage, dispersion, what was found."""
    head = [
        "area", "km²", "robots", "min", "A'/A", "seen", "paper: min", "paper: seen", "apart m",
        "of diag.", "found", "all found, min", "ended",
    ]  # fmt: skip
    rows = []
    for one in missions:
        m, area = one.metrics, one.paper
        minutes = one.plan["minutes"] if area is None else area.minutes
        known = area is not None and area.known
        everything = m["time_all_found_s"]
        rows.append([
            one.name, number(m["area_km2"], 2), str(m["robots"]), number(m["time_s"] / 60, 1),
            percent(m["coverage_formula"]), percent(one.coverage_at(60 * minutes)),
            number(area.minutes, 1) if area and known else DASH,
            percent(area.coverage) if area and known else DASH,
            number(m["dispersion_m"], 0), number(m["dispersion_normalised"], 2),
            f"{m['objects_found']} of {m['objects']}",
            f"> {m['time_s'] / 60:.1f}" if everything is None else f"{everything / 60:.1f}",
            m["ended"],
        ])  # fmt: skip
    return markdown(head, rows)


def slam_table(missions: Sequence[Finished]) -> str:
    """Map building: errors of landmarks and paths."""
    head = [
        "area", "landmarks", "mean m", "median m", "max m", "ATE mean m", "ATE max m",
        "duplicates", "wrong merges", "robots missing", "doubts",
    ]  # fmt: skip
    rows = []
    for one in missions:
        s = one.metrics.get("slam")
        if s is None:
            continue
        figures = [s.get(k) for k in (
            "landmark_mean_m", "landmark_median_m", "landmark_max_m", "ate_mean_m", "ate_max_m"
        )]  # fmt: skip
        counts = [text(s.get(k)) for k in ("duplicates", "wrong_merges")]
        rows.append([
            one.name, f"{s.get('landmarks_matched', 0)} of {s.get('landmarks_true', 0)}",
            *(number(f, 2) for f in figures), *counts, str(len(s["robots_missing"])),
            str(len(s["doubts"])),
        ])  # fmt: skip
    return markdown(head, rows)


def result_table(
    missions: Sequence[Finished],
    together: dict[str, Result | None],
    true: dict[str, Result | None],
) -> str:
    """Environment maps: IoU, AP, accuracy and macro-F1 of both segmentations.

    Args:
        missions: one row each.
        together: segmentation -> figures of all together.
        true: segmentation -> the same from the true landmarks.
    """
    head = ["area", "cells"]
    for name in SEGMENTATIONS:
        head += [f"{name}: IoU", "AP", "accuracy", "macro-F1"]
    head += ["paper: IoU", "AP"]
    rows = []
    for one in missions:
        maps = one.metrics.get("map")
        if maps is None:
            continue
        found = [maps.get(name) for name in SEGMENTATIONS]
        cells = next((str(f["cells"]) for f in found if f), DASH)
        rows.append([one.name, cells, *_scores([f and f["all"] for f in found]), DASH, DASH])
    for label, pool, theirs in (
        ("**pooled**", together, [f"{paper.IOU:.2f}", f"{paper.AP:.3f}"]),
        ("pooled, true landmarks", true, [DASH, DASH]),
    ):
        results = [pool.get(name) for name in SEGMENTATIONS]
        if any(results):
            scores: list[dict[str, Any] | None] = [vars(r.all) if r else None for r in results]
            cells = next(str(r.cells) for r in results if r)
            rows.append([label, cells, *_scores(scores), *theirs])
    return markdown(head, rows)


def speed_table(missions: Sequence[Finished]) -> str:
    """How fast, how large."""
    head = [
        "mission", "robots", "simulated min", "mission s", "times real time", "by processor",
        "map building s", "all of it s", "peak MB", "load before",
    ]  # fmt: skip
    rows = []
    for one in missions:
        m, run = one.metrics, one.run
        slam = m.get("slam")
        rows.append([
            one.name, str(m["robots"]), number(m["time_s"] / 60, 1), number(m["wall_s"], 0),
            number(m["real_time_factor"], 1),
            number(m["time_s"] / max(m["processor_s"], 1e-9), 1),
            number(slam["seconds"] if slam else None, 0), number(run["ended"] - run["begun"], 0),
            number(run["peak_mb"], 0), number(run["load"], 1),
        ])  # fmt: skip
    rows.append([
        "**together**", "", number(sum(o.metrics["time_s"] for o in missions) / 60, 1), "", "", "",
        "", number(60 * wall_minutes(missions), 0),
        number(max(one.run["peak_mb"] for one in missions), 0), "",
    ])  # fmt: skip
    return markdown(head, rows)


def _scores(found: Sequence[dict[str, Any] | None]) -> list[str]:
    """IoU, AP, accuracy and macro-F1 of each segmentation."""
    names = ("mean_iou", "mean_ap", "accuracy", "macro_f1")
    return [number(f[name] if f else None, 3) for f in found for name in names]


def number(value: float | None, digits: int) -> str:
    """A number, or a dash."""
    return DASH if value is None else f"{value:.{digits}f}"


def percent(value: float) -> str:
    """A share."""
    return f"{value:.1%}"


def text(value: object) -> str:
    """A value, or a dash."""
    return DASH if value is None else str(value)


def markdown(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table, numbers to the right."""
    lines = [head, ["---", *(["---:"] * (len(head) - 1))], *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)
