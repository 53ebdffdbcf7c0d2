"""``symboslam slam mrclam``: map an MRCLAM data set, and measure the map against its truth."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from symboslam.cli.common import OntologyOption, Progress, progress_bar, show, table
from symboslam.cli.slam_common import (
    JsonOption,
    OriginOption,
    OutOption,
    between,
    check_outs,
    estimator,
    knowledge_for,
    origin_of,
    robots_lost,
    starts_of,
    tell_doubts,
    write_outs,
)
from symboslam.errors import InputError

if TYPE_CHECKING:
    from rich.table import Table

    from symboslam.engine.slam.comparison import Result
    from symboslam.engine.slam.log import Mission

EXAMPLES = """
[bold]Examples[/]

symboslam slam mrclam mrclam6

symboslam slam mrclam mrclam6 --classes 4 --json

symboslam slam mrclam mrclam6 --classes 4 --starts first --picture errors.png

symboslam slam mrclam mrclam6 --out landmarks.geojson --out paths.tum
"""
NAMES = {"ours": "SymboSLAM", "dead_reckoning": "dead reckoning", "paper_rule": "the paper's rule"}


def mrclam(
    folder: Annotated[
        Path,
        typer.Argument(
            metavar="DIR",
            help="Folder of a set: Barcodes.dat, Robot1_Odometry.dat and so on, gzipped or not.",
            show_default=False,
        ),
    ],
    classes: Annotated[
        int | None,
        typer.Option(
            help="Hide which landmark is which, but for so many classes: landmark number N gets "
            "class N modulo this.",
            show_default="identities are known",
        ),
    ] = None,
    starts: Annotated[
        str, typer.Option(help="Robots whose start is known: all, first or none.")
    ] = "all",
    out: OutOption = None,
    picture: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Draw our map and its errors, aligned: a .png file.",
            show_default=False,
        ),
    ] = None,
    origin: OriginOption = None,
    ontology: OntologyOption = None,
    as_json: JsonOption = False,
) -> None:
    """Map an MRCLAM data set, and compare with the truth, dead reckoning and the paper's rule.

    Our map and the paper's are made without a look at the truth. Dead reckoning is by the true
    identities: its error is the odometry's alone. docs/map-building.md defines the figures. Doubts
    are printed on standard error, and are no failure: the exit code is 0.
    """
    from symboslam.engine.slam.readers.mrclam import read

    outs = out or []
    _check_picture(picture)
    check_outs(outs, [folder, *([ontology] if ontology else [])], origin)
    place = origin_of(origin)
    with progress_bar() as progress:
        progress("reading", 0.02)
        mission, notes = read(folder, classes, starts)
        knowledge = knowledge_for("mrclam", outs, ontology, progress)
        results = _results(mission, between(progress, 0.1, 0.9))
        ours = results["ours"]
        progress("writing", 0.9)
        files, odd = write_outs(outs, ours.slam_map, mission, place, knowledge)
        if picture is not None:
            _draw(picture, ours, mission)
            files.append(picture)
    doubts = ours.slam_map.doubts
    notes = [*notes, *ours.slam_map.notes, *ours.score.notes, *odd]
    tell_doubts(doubts)
    wrote = [f"wrote {file.resolve()}" for file in files]
    if as_json:
        figures = {name: result.figures.to_json() for name, result in results.items()}
        values = figures.pop("ours") | figures
        values |= {"starts": starts_of(mission), "robots_lost": robots_lost(ours.slam_map, mission)}
        values |= {"doubts": list(doubts), "notes": notes}
        sys.stdout.write(json.dumps(values, indent=2) + "\n")
        show(*wrote, error=True)
    else:
        show(_table(results), *_lost(results), *notes, *wrote)


def _check_picture(picture: Path | None) -> None:
    """Refuse a picture that cannot be written.

    Raises:
        InputError: it is no .png file.
        OutputError: it cannot be written.
    """
    from symboslam.engine.writers.atomic import check_writable

    if picture is not None:
        if picture.suffix.lower() != ".png":
            raise InputError(f"{picture}: a picture is a .png file")
        check_writable(picture)


def _results(mission: Mission, progress: Progress) -> dict[str, Result]:
    """All ways to map, ours first."""
    from symboslam.engine.slam.comparison import blind, measure
    from symboslam.engine.slam.dead_reckoning import dead_reckoned
    from symboslam.engine.slam.paper import paper_map

    estimate, unseen = estimator(), blind(mission)
    found = {"ours": measure(lambda: estimate(unseen, progress=between(progress, 0, 0.9)), mission)}
    progress("dead reckoning", 0.9)
    found["dead_reckoning"] = measure(
        lambda: dead_reckoned(mission, by="identity", lost="left out"), mission
    )
    progress("the paper's rule", 0.95)
    found["paper_rule"] = measure(lambda: paper_map(unseen), mission)
    return found


def _table(results: dict[str, Result]) -> Table:
    head = (
        "landmark RMSE m",
        "not aligned",
        "ATE mean m",
        "max",
        "matched",
        "duplicates",
        "wrong merges",
        "lost",
        "s",
    )
    shown = table("map", *head, title="Errors against the truth")
    for column in shown.columns[1:]:
        column.justify = "right"
    for name, result in results.items():
        figures = result.figures
        metres = (
            figures.landmark_rmse_m,
            figures.landmark_rmse_raw_m,
            figures.ate_mean_m,
            figures.ate_max_m,
        )
        matched = (
            "-"
            if figures.landmarks_matched is None
            else f"{figures.landmarks_matched} of {figures.landmarks_true}"
        )
        counts = (figures.duplicates, figures.wrong_merges)
        mistakes = ["-" if value is None else str(value) for value in counts]
        numbers = ["-" if value is None else f"{value:.3f}" for value in metres]
        lost = str(len(figures.robots_missing))
        shown.add_row(NAMES[name], *numbers, matched, *mistakes, lost, f"{figures.seconds:.1f}")
    return shown


def _lost(results: dict[str, Result]) -> list[str]:
    """Who is lost, and so in no mean; a line for each map."""
    return [
        f"{NAMES[name]}: lost and in none of the errors of paths: "
        f"{', '.join(result.figures.robots_missing)}"
        for name, result in results.items()
        if result.figures.robots_missing
    ]


def _draw(picture: Path, result: Result, mission: Mission) -> None:
    from symboslam.engine.slam.comparison import sides
    from symboslam.engine.slam.score_picture import draw
    from symboslam.engine.slam.trajectory_error import MAX_DIFF

    draw(picture, result.score, *sides(result.slam_map, mission), align=True, max_diff=MAX_DIFF)
