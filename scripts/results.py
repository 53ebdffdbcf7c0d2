"""Score the program with a benchmark folder and write docs/results.md.

    results.py --benchmark FOLDER [--set dev] [--out docs/results.md]

The folder holds `score_all.py` and sets of areas with their truth; it is no part of the project.
Both profiles run with both segmentations on every area exactly as a user would run them.
"""

from __future__ import annotations

import argparse
import json
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
METRICS = {"accuracy": "OA", "kappa": "kappa", "macro_f1": "macro-F1", "mean_iou": "mean IoU",
           "map": "mAP"}  # fmt: skip
NOT_FLOWN = "Not flown yet: `make sim-results`."
PROFILES = ("default", "paper")
SEGMENTATIONS = ("grid", "branch")
KINDS = {"osm": "OpenStreetMap areas", "sim": "simulated areas"}
INTRO = """# Results

Made by `make results`; the part about simulated missions, at the end, by `make sim-results`. Do
not edit. {date}, symboslam {version}.

Each area is a file of landmarks; the truth is its real land use (OpenStreetMap areas) or what the
paper's authors say that they placed (simulated areas). All cells with a truth count; unknown is
wrong. `program` rows are this program, with no training on any area, by profile and segmentation;
`branch` calls ground unknown that is far from any landmark. The others are the
benchmark's own baselines: `authors` is the paper's engine on its authors' table, `rf`,
`rf_balanced` and `nb` were trained on other areas, and `rf_cv` has seen other blocks of the same
areas. **These are development figures**: the program was built with these areas in view, so
others may come out worse."""


def main() -> None:
    """Run the benchmark once for each profile and write the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("--benchmark", type=Path, required=True)
    parser.add_argument("--set", default="dev")
    parser.add_argument("--out", type=Path, default=ROOT / "docs" / "results.md")
    chosen = parser.parse_args()
    if not (chosen.benchmark / "score_all.py").is_file():
        sys.exit(f"no benchmark in {chosen.benchmark}: name its folder, make results BENCHMARK=...")
    scores = {p: score(chosen.benchmark.resolve(), chosen.set, p) for p in PROFILES}
    text = report(scores, baselines(chosen.benchmark, chosen.set))
    chosen.out.write_text(f"{text}\n{missions(chosen.out)}\n", encoding="utf-8")
    print(f"wrote {chosen.out}")


def score(benchmark: Path, name: str, profile: str) -> dict[str, Any]:
    """What score_all.py makes of the program with this profile."""
    program = f"{shlex.quote(sys.executable)} -m symboslam"
    wrapped = shlex.join(["sh", "-c", f'{program} "$@" --quiet --profile {profile}', "symboslam"])
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "scores.json"
        subprocess.run(
            [sys.executable, str(benchmark / "score_all.py"), "--program", wrapped, "--set", name,
             *(f"--segmentation={s}" for s in SEGMENTATIONS), "--json", str(out)],
            check=True,
        )  # fmt: skip
        result: dict[str, Any] = json.loads(out.read_text())
    failed = [
        f"{area} ({s})"
        for area, got in result["areas"].items()
        for s in SEGMENTATIONS
        if got[s]["failed"]
    ]
    if failed:
        sys.exit(f"profile {profile} failed on {', '.join(failed)}; nothing written")
    return result


def missions(page: Path) -> str:
    """The part about simulated missions, which `make sim-results` writes: as it is."""
    from symboslam.sim_bridge.table.page import MARKS, around

    if not page.is_file():
        return "\n\n".join([MARKS[0], "## Simulated missions", NOT_FLOWN, MARKS[1]])
    before, after = around(page)
    text = page.read_text(encoding="utf-8")
    return MARKS[0] + text[len(before) : len(text) - len(after)] + MARKS[1]


def baselines(benchmark: Path, name: str) -> dict[str, Any]:
    """The pooled scores of the benchmark's own baselines, if it has any for this set."""
    path = benchmark / name / "baselines.json"
    return dict(json.loads(path.read_text())["pooled"]) if path.is_file() else {}


def report(scores: Mapping[str, Any], others: Mapping[str, Any]) -> str:
    """The whole page."""
    from symboslam import __version__

    parts = [INTRO.format(date=f"{datetime.now(UTC):%Y-%m-%d}", version=__version__)]
    pooled = {
        f"**program, {p}, {s}**": got["pooled"][s]
        for p, got in scores.items()
        for s in SEGMENTATIONS
    } | dict(others)
    for kind, words in KINDS.items():
        rows = {name: got[kind] for name, got in pooled.items() if kind in got}
        if not rows:
            continue
        parts.append(f"## All {words} together")
        parts.append(overall("program or baseline", rows))
        parts.append("F1 of each environment type (number of truth cells in the head):")
        parts.append(by_class(rows))
    areas = scores["default"]["areas"]
    for s in SEGMENTATIONS:
        parts.append(f"## Area by area, `default` profile, {s}")
        parts.append(overall("area", {n: got[s]["score"] for n, got in areas.items()}))
    parts.append("Seconds are whole processes, from landmarks to GeoJSON.")
    seconds = [
        [n, *(f"{got[s]['seconds']:.2f}" for s in SEGMENTATIONS)] for n, got in areas.items()
    ]
    parts.append(table(["area", *SEGMENTATIONS], seconds))
    return "\n\n".join(parts) + "\n"


def overall(title: str, rows: Mapping[str, Any]) -> str:
    """Coverage and the overall metrics, one row each."""
    head = [title, "cells", "coverage", *METRICS.values(), "labelled only: OA", "macro-F1"]
    lines = []
    for name, got in rows.items():
        labelled = got["labelled"] or {}
        values = [got["coverage"], *(got["all"].get(m) for m in METRICS)]
        values += [labelled.get("accuracy"), labelled.get("macro_f1")]
        lines.append([name, str(got["cells"]), *map(number, values)])
    return table(head, lines)


def by_class(rows: Mapping[str, Any]) -> str:
    """F1 of each class, one row each."""
    first = next(iter(rows.values()))["all"]["classes"]
    head = ["", *(f"{name} ({got['cells']})" for name, got in first.items())]
    lines = [
        [name, *(number(got["all"]["classes"].get(c, {}).get("f1")) for c in first)]
        for name, got in rows.items()
    ]
    return table(head, lines)


def number(value: float | None) -> str:
    """Three decimals, or nothing."""
    return "" if value is None else f"{value:.3f}"


def table(head: list[str], rows: list[list[str]]) -> str:
    """A Markdown table, numbers to the right."""
    lines = [head, ["---"] + ["---:"] * (len(head) - 1), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


if __name__ == "__main__":
    main()
