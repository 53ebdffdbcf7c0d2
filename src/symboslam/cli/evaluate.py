"""``symboslam evaluate``: how well maps agree with a truth."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated

import typer

from symboslam.cli.common import (
    OntologyOption,
    bbox_of,
    load_knowledge,
    progress_bar,
    show,
    table,
)
from symboslam.errors import InputError

if TYPE_CHECKING:
    from symboslam.engine.evaluation import Evaluation

EXAMPLES = """
[bold]Examples[/]

symboslam evaluate zones.geojson map.geojson

symboslam evaluate zones.geojson map.ttl --cells 24 --out report.html --out report.json

symboslam evaluate north-zones.geojson north.geojson south-zones.geojson south.geojson
"""


def evaluate(
    files: Annotated[
        list[str],
        typer.Argument(
            metavar="TRUTH MAP [TRUTH MAP]...",
            help="TRUTH: GeoJSON polygons or points with `environment`. MAP: what classify wrote "
            "(.geojson, .ttl, .nq), or any GeoJSON polygons with `environment` and maybe "
            "`probabilities`. The cells of several pairs are taken together.",
            show_default=False,
        ),
    ],
    cells: Annotated[
        int | None,
        typer.Option(help="Cells along each side.", show_default="the map's own, else 24"),
    ] = None,
    bbox: Annotated[
        str | None,
        typer.Option(
            metavar="W,S,E,N",
            help="Area to compare, in the files' coordinates.",
            show_default="that of the truth, else of the map",
        ),
    ] = None,
    out: Annotated[
        list[str] | None,
        typer.Option(
            "--out",
            "-o",
            metavar="FILE",
            help="Where to write: .json, .md or .html; - is JSON on standard output. Can be given "
            "several times.",
        ),
    ] = None,
    ontology: OntologyOption = None,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print no tables.")] = False,
) -> None:
    """Score maps against a truth: F1, IoU, average precision, kappa, confusion matrix.

    Truth and map are compared cell by cell on one grid; docs/evaluate.md defines every figure.
    Paths and landmarks of robots are scored by [bold]symboslam evaluate slam[/].
    """
    from symboslam.engine.evaluation import evaluate_pairs, write_report
    from symboslam.engine.evaluation.reports import format_of, json_report
    from symboslam.engine.writers import check_targets

    if len(files) % 2:
        raise InputError(f"{files[-1]}: each TRUTH needs a MAP after it")
    if bbox is not None and len(files) > 2:
        raise InputError("--bbox is for one pair: several areas cannot have the same")
    targets = out or []
    check_targets(targets, [*files, *([ontology] if ontology else [])], format_of)
    with progress_bar(quiet) as progress:
        knowledge = load_knowledge(ontology, progress)
        progress("comparing", 0.1)
        pairs = list(zip(files[::2], files[1::2], strict=True))
        found = evaluate_pairs(pairs, cells=cells, bbox=bbox_of(bbox), knowledge=knowledge)
        for target in targets:
            progress("writing", 0.9)
            if target == "-":
                sys.stdout.write(json_report(found))
            else:
                write_report(found, target)
    if not quiet:
        tell(found, targets)


def tell(found: Evaluation, targets: list[str]) -> None:
    """Print the figures as tables, what was noted, and where the reports are."""
    from symboslam.engine.evaluation import reports

    result = found.result
    tables = [_numbers(["", "all truth cells", "labelled cells"], reports.overall_rows(result))]
    if len(found.pairs) > 1:
        tables.append(_numbers(*reports.pair_rows(found)))
    classes = reports.class_rows(result.all)
    tables.append(_numbers(["environment", *reports.CLASS_WORDS], classes, "All truth cells"))
    (corner, *_, last), rows = reports.confusion_rows(result.all, found.names)
    numbers = [str(i) for i in range(1, len(rows) + 1)]
    rows = [[f"{i} {name}", *cells] for i, (name, *cells) in zip(numbers, rows, strict=True)]
    title = "Confusion matrix: truth in rows, map in columns"
    tables.append(_numbers([corner, *numbers, last], rows, title))
    lines = [*found.notes, *(f"wrote {target}" for target in targets if target != "-")]
    show(*tables, *(["\n".join(lines)] if lines else []), error="-" in targets)


def _numbers(head: list[str], rows: list[list[str]], title: str | None = None) -> object:
    """A table with numbers in all columns but the first."""
    found = table(*head, title=title)
    for column in found.columns:
        column.overflow = "fold"
        column.justify = "left" if column.header in ("truth", "map", head[0]) else "right"
    for row in rows:
        found.add_row(*row)
    return found
