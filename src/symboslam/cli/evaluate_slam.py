"""``symboslam evaluate slam``: how well a map of paths and landmarks agrees with the truth."""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from symboslam.cli.common import show, table
from symboslam.errors import InputError

if TYPE_CHECKING:
    from symboslam.engine.slam.error_statistics import Statistics
    from symboslam.engine.slam.score import SlamScore

EXAMPLES = """
[bold]Examples[/]

symboslam evaluate slam estimate.tum truth.tum

symboslam evaluate slam estimates/ truths/ --delta 10m --picture errors.png

symboslam evaluate slam robot.tum truth.tum --landmarks map.geojson --true-landmarks world.csv

symboslam evaluate slam map.geojson world.csv --radius 5 --json
"""


def evaluate_slam(
    estimate: Annotated[
        Path,
        typer.Argument(
            metavar="ESTIMATE",
            help="A TUM trajectory (time x y z qx qy qz qw); a folder of such files (.tum, .txt), "
            "one for each robot; or landmarks (.geojson, .csv). A file landmarks.geojson or "
            "landmarks.csv in a folder is read too.",
            show_default=False,
        ),
    ],
    truth: Annotated[
        Path,
        typer.Argument(
            metavar="TRUTH",
            help="The same, as it really was. Files in two folders belong together by name.",
            show_default=False,
        ),
    ],
    landmarks: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Landmarks of the estimate: GeoJSON or CSV (id,class,x,y), in metres.",
            show_default=False,
        ),
    ] = None,
    true_landmarks: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="The true landmarks.", show_default=False),
    ] = None,
    radius: Annotated[
        float | None,
        typer.Option(
            metavar="METRES",
            help="How far a landmark may be from the true one that it is matched with.",
            show_default="half the spacing of the true ones by their density, at most 12",
        ),
    ] = None,
    max_diff: Annotated[
        float,
        typer.Option(metavar="SECONDS", help="How far times of one moment may differ."),
    ] = 0.01,
    align: Annotated[
        bool,
        typer.Option(
            "--align/--no-align",
            help="Turn and shift each path for the ATE so that it fits best, as evo -a does. JSON "
            "has both.",
        ),
    ] = True,
    delta: Annotated[
        str,
        typer.Option(
            metavar="LENGTH",
            help="What relative errors (RPE) are over: metres, seconds or frames, such as 1m, 10s "
            "or 5f.",
        ),
    ] = "1m",
    picture: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Draw paths, landmarks and errors: a .png file.",
            show_default=False,
        ),
    ] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print JSON in place of the tables.")
    ] = False,
) -> None:
    """Score paths and landmarks against the truth: ATE, RPE, coverage, accuracy, offsets.

    ATE and RPE are those of evo; docs/slam-evaluation.md defines every figure.
    """
    from symboslam.engine.slam.metrics import Options
    from symboslam.engine.slam.score_files import read_sides, score_sides
    from symboslam.engine.slam.score_picture import draw
    from symboslam.engine.slam.trajectory_error import Delta
    from symboslam.engine.writers.atomic import check_writable

    options = Options(radius=radius, max_diff=max_diff, delta=Delta.parse(delta))
    if picture is not None:
        if picture.suffix != ".png":
            raise InputError(f"{picture}: a picture is a .png file")
        check_writable(picture)
    ours, true = read_sides(estimate, truth, landmarks, true_landmarks)
    score = score_sides(ours, true, options)
    if as_json:
        sys.stdout.write(json.dumps(score.to_json(), indent=2) + "\n")
    else:
        tell(score, align)
    if picture is not None:
        draw(picture, score, ours, true, align=align, max_diff=max_diff)
        show(f"wrote {picture}", error=as_json)


def tell(score: SlamScore, align: bool) -> None:
    """Print the figures as tables, and what was noted."""
    tables = []
    if score.robots:
        delta = next(iter(score.robots.values())).delta
        head = ["path", "poses", "ATE RMSE m", "mean", "median", "max"]
        title = f"Paths, {'aligned' if align else 'not aligned'}; RPE over {delta}"
        paths = table(*head, "RPE m", "RPE deg", title=title)
        for name, robot in score.robots.items():
            way, turn = robot.rpe_translation, robot.rpe_rotation
            paths.add_row(
                name,
                str(robot.poses),
                *_numbers(robot.ate if align else robot.ate_raw),
                _number(None if way is None else way.rmse),
                _number(None if turn is None else math.degrees(turn.rmse)),
            )
        tables.append(paths)
    if score.raw is not None:
        title = f"{score.landmarks_true} true landmarks, {score.landmarks_mapped} in the map"
        head = ["landmarks", "matched", "coverage", "accuracy", "Er m", "RMSE", "median", "max"]
        marks = table(*head, title=f"{title}; matched within {score.radius:.3g} m")
        for name, found in (("as mapped", score.raw), ("aligned", score.aligned)):
            if found is not None:
                rmse, mean, median, most = _numbers(found.offset)
                share = (_number(found.coverage), _number(found.accuracy))
                marks.add_row(name, str(len(found.pairs)), *share, mean, rmse, median, most)
        tables.append(marks)
    for one in tables:
        for column in one.columns[1:]:
            column.justify = "right"
    show(*tables, *(["\n".join(score.notes)] if score.notes else []))


def _numbers(found: Statistics | None) -> list[str]:
    """RMSE, mean, median, largest."""
    if found is None:
        return ["-"] * 4
    return [_number(value) for value in (found.rmse, found.mean, found.median, found.max)]


def _number(value: float | None) -> str:
    return "-" if value is None else f"{value:.3f}"
