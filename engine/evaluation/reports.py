"""Reports of an evaluation: JSON and Markdown, and the choice of a format by a file's ending."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from symboslam.engine.evaluation.metrics import Result, Scores
from symboslam.engine.writers.atomic import atomic_file
from symboslam.errors import OutputError

if TYPE_CHECKING:
    from symboslam.engine.evaluation.evaluation import Evaluation

Document = dict[str, Any]
Render = Callable[["Evaluation"], str]
UNKNOWN = "unknown"
OVERALL = {
    "accuracy": "overall accuracy",
    "kappa": "Cohen's kappa",
    "macro_f1": "macro-F1",
    "mean_iou": "mean IoU",
    "map": "mAP",
}
"""Name of each overall metric in JSON -> words for people."""
SHORT = ("OA", "kappa", "macro-F1", "mean IoU", "mAP")
OF_CLASS = ("precision", "recall", "f1", "iou", "ap", "support", "predicted")
CLASS_WORDS = ("precision", "recall", "F1", "IoU", "AP", "truth cells", "map cells")


def as_dict(evaluation: Evaluation) -> Document:
    """All figures as plain values.

    ``pairs`` has them for each truth and map, the members beside it for all cells together. What
    is not defined, such as the recall of a class that the truth lacks, is None.
    """
    names = evaluation.names
    pairs = [
        {
            "truth": pair.truth_source,
            "map": pair.map_source,
            "crs": pair.system,
            "bbox": list(pair.bbox),
            "grid": pair.cells,
            **_result(pair.result, names),
        }
        for pair in evaluation.pairs
    ]
    pooled = _result(evaluation.result, names)
    return {**pooled, "notes": list(evaluation.notes), "pairs": pairs}


def _result(result: Result, names: tuple[str, ...]) -> Document:
    labelled = None if result.labelled is None else _scores(result.labelled, names)
    return {
        "cells": result.cells,
        "coverage": result.coverage,
        "all": _scores(result.all, names),
        "labelled": labelled,
    }


def _scores(scores: Scores, names: tuple[str, ...]) -> Document:
    present = [k for k, name in enumerate(names) if name in scores.classes]
    matrix = scores.confusion[present][:, [*present, len(names)]]
    return {
        "cells": scores.cells,
        **overall(scores),
        "classes": {name: asdict(c) for name, c in scores.classes.items()},
        "confusion": {
            "truth": [names[k] for k in present],
            "map": [*(names[k] for k in present), UNKNOWN],
            "cells": matrix.tolist(),
        },
    }


def overall(scores: Scores) -> dict[str, float | None]:
    """The overall metrics by their names in ``OVERALL``."""
    values = (scores.accuracy, scores.kappa, scores.macro_f1, scores.mean_iou, scores.mean_ap)
    return dict(zip(OVERALL, values, strict=True))


def json_report(evaluation: Evaluation) -> str:
    """The report as JSON."""
    return json.dumps(as_dict(evaluation), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def markdown_report(evaluation: Evaluation) -> str:
    """The report as Markdown: overall metrics, classes, confusion matrices, then every pair."""
    result = evaluation.result
    parts = ["# Evaluation", summary(evaluation)]
    parts.append(_table(["", "all truth cells", "labelled cells"], overall_rows(result)))
    for title, scores in sections(result):
        parts += [f"## {title}", _table(["environment", *CLASS_WORDS], class_rows(scores))]
        head, rows = confusion_rows(scores, evaluation.names)
        parts.append("Confusion matrix: truth in rows, map in columns.")
        parts.append(_table(head, rows))
    parts += ["## Pairs", _table(*pair_rows(evaluation))]
    if evaluation.notes:
        parts += ["## Notes", "\n".join(f"- {_inline(note)}" for note in evaluation.notes)]
    return "\n\n".join(parts) + "\n"


def summary(evaluation: Evaluation) -> str:
    """One sentence on what was compared."""
    result, pairs = evaluation.result, len(evaluation.pairs)
    what = "1 map" if pairs == 1 else f"{pairs} maps, their cells taken together"
    return (
        f"{what}: {result.cells} cells with a truth, of which {result.coverage:.1%} have a label "
        "in the map. Among all truth cells unknown is a wrong answer."
    )


def sections(result: Result) -> list[tuple[str, Scores]]:
    """Title and metrics: all truth cells, then the labelled ones if there are any."""
    found = [("All truth cells", result.all)]
    if result.labelled is not None:
        found.append(("Labelled cells only", result.labelled))
    return found


def overall_rows(result: Result) -> list[list[str]]:
    """Name of each overall metric, its value over all truth cells and over the labelled ones."""
    labelled = result.labelled
    everything = overall(result.all)
    known = overall(labelled) if labelled is not None else dict.fromkeys(OVERALL)
    rows = [["cells", str(result.cells), str(labelled.cells if labelled is not None else 0)]]
    rows.append(["coverage", number(result.coverage), number(None)])
    rows += [[words, number(everything[m]), number(known[m])] for m, words in OVERALL.items()]
    return rows


def class_rows(scores: Scores) -> list[list[str]]:
    """Name and scores of each environment, as ``OF_CLASS`` has them."""
    return [
        [name, *(number(getattr(found, metric)) for metric in OF_CLASS)]
        for name, found in scores.classes.items()
    ]


def confusion_rows(scores: Scores, names: tuple[str, ...]) -> tuple[list[str], list[list[str]]]:
    """Head and rows of the confusion matrix, for the environments that truth or map have."""
    table = _scores(scores, names)["confusion"]
    rows = [
        [name, *map(str, row)] for name, row in zip(table["truth"], table["cells"], strict=True)
    ]
    return ["truth \\ map", *table["map"]], rows


def pair_rows(evaluation: Evaluation) -> tuple[list[str], list[list[str]]]:
    """Head and rows of a table with one row a pair."""
    rows = [
        [
            pair.truth_source,
            pair.map_source,
            f"{pair.cells} x {pair.cells}",
            str(pair.result.cells),
            number(pair.result.coverage),
            *map(number, overall(pair.result.all).values()),
        ]
        for pair in evaluation.pairs
    ]
    return ["truth", "map", "grid", "cells", "coverage", *SHORT], rows


def number(value: float | None) -> str:
    """Whole numbers as they are, others with three decimals, a dash for none."""
    if value is None:
        return "–"
    return str(value) if isinstance(value, int) else f"{value:.3f}"


def _table(head: list[str], rows: list[list[str]]) -> str:
    """A Markdown table, all but the first column to the right."""
    line = ["---", *["---:"] * (len(head) - 1)]
    body = [[_inline(cell) for cell in row] for row in (head, *rows)]
    return "\n".join(f"| {' | '.join(row)} |" for row in (body[0], line, *body[1:]))


def _inline(text: str) -> str:
    from symboslam.reasoning.questions.report_md import inline

    return inline(text)


def _html_report(evaluation: Evaluation) -> str:
    from symboslam.engine.evaluation.page import html_report

    return html_report(evaluation)


REPORTS: dict[str, Render] = {
    ".json": json_report,
    ".md": markdown_report,
    ".html": _html_report,
    ".htm": _html_report,
}
"""Ending of a file -> what makes the report."""


def format_of(target: str | Path) -> str:
    """The ending that tells a report's format; ``-``, the standard output, is JSON.

    Raises:
        OutputError: no report has this ending.
    """
    ending = ".json" if str(target) == "-" else Path(target).suffix.lower()
    if ending not in REPORTS:
        known = ", ".join(REPORTS)
        raise OutputError(f"{target}: no report has the ending {ending!r}; use one of {known}")
    return ending


def write_report(evaluation: Evaluation, target: str | Path) -> None:
    """Write a report, whole or not at all.

    Raises:
        OutputError: another ending than those of ``REPORTS``, or the file cannot be written; an
            old file is then kept.
    """
    text = REPORTS[format_of(target)](evaluation)
    with atomic_file(target) as stream:
        stream.write(text.encode("utf-8", "replace"))
