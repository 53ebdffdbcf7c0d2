"""The report as one offline HTML page: figures, and truth and map side by side, errors marked."""

from __future__ import annotations

import math
import re
from functools import cache
from html import escape
from importlib.resources import files

import numpy as np
from numpy.typing import NDArray

from symboslam.engine.evaluation import reports
from symboslam.engine.evaluation.evaluation import Evaluation
from symboslam.engine.evaluation.metrics import Ints, Scores
from symboslam.engine.evaluation.pairs import Pair
from symboslam.engine.writers.html import csp_hash, printable

_NONE = "."
_SHADES = 5


def html_report(evaluation: Evaluation) -> str:
    """The page; it asks nothing of any network, and equal evaluations give equal pages."""
    style, script = _file("page.css"), _file("page.js")
    policy = (
        f"default-src 'none'; style-src '{csp_hash(style)}'; script-src '{csp_hash(script)}'; "
        "img-src data:; base-uri 'none'; form-action 'none'"
    )
    body = [
        "<h1>How well the map agrees with the truth</h1>",
        f'<p class="soft">{escape(reports.summary(evaluation))}</p>',
        _tiles(evaluation),
        "<h2>Truth and map side by side</h2>",
        '<p class="help">A cross marks a cell where the map is wrong; cells without a truth are '
        "striped in the truth and pale in the map. Choose an environment to see it alone. In the "
        "maps the arrow keys go from cell to cell, <kbd>n</kbd> and <kbd>p</kbd> to the next and "
        "the previous error.</p>",
        _legend(evaluation),
    ]
    body += [_maps(pair, evaluation, i) for i, pair in enumerate(evaluation.pairs)]
    body += [
        "<h2>Overall</h2>",
        _table(["", "all truth cells", "labelled cells"], reports.overall_rows(evaluation.result)),
    ]
    for title, scores in reports.sections(evaluation.result):
        head = ["environment", *reports.CLASS_WORDS]
        body += [
            f"<h2>{title}</h2>",
            _table(head, reports.class_rows(scores)),
            f"<h3>Confusion matrix, {title[0].lower()}{title[1:]}</h3>",
            _matrix(scores, evaluation.names),
        ]
    if len(evaluation.pairs) > 1:
        body += ["<h2>Pairs, all truth cells</h2>", _table(*reports.pair_rows(evaluation))]
    if evaluation.notes:
        notes = "".join(f"<li>{escape(note)}</li>" for note in evaluation.notes)
        body += ["<h2>Notes</h2>", f"<ul>{notes}</ul>"]
    lines = [
        "<!doctype html>",
        '<html lang="en"><head><meta charset="utf-8">',
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">',
        '<meta name="viewport" content="width=device-width, initial-scale=1">',
        '<title>Evaluation</title><link rel="icon" href="data:,">',
        f"<style>{style}</style></head><body><main>",
        *body,
        f"</main><script>{script}</script></body></html>",
    ]
    return printable("\n".join(lines) + "\n")


@cache
def _file(name: str) -> str:
    return (files("symboslam.engine.evaluation") / name).read_text("utf-8")


def _tiles(evaluation: Evaluation) -> str:
    values = reports.overall(evaluation.result.all)
    shown = {words: values[metric] for metric, words in reports.OVERALL.items()}
    shown["coverage"] = evaluation.result.coverage
    items = "".join(
        f"<li><b>{reports.number(value)}</b><span>{escape(words)}</span></li>"
        for words, value in shown.items()
    )
    return f'<ul class="tiles">{items}</ul>'


def _code(k: int) -> str:
    """The letter that stands for an environment in the page's data; a dot for none."""
    return _NONE if k < 0 else chr(ord("a") + k)


def _legend(evaluation: Evaluation) -> str:
    """A button for each environment that occurs, and what the patterns mean."""
    present = [
        k for k, name in enumerate(evaluation.names) if name in evaluation.result.all.classes
    ] or [0]
    parts = [
        f'<li><button type="button" aria-pressed="false" data-code="{escape(_code(k))}">'
        f"{_swatch(escape(e.colour))}{escape(e.label)}</button></li>"
        for k, e in enumerate(evaluation.environments)
        if k in present or any((pair.label == k).any() for pair in evaluation.pairs)
    ]
    for pattern, words in (("unknown", "unknown"), ("none", "no truth")):
        parts.append(f'<li><span class="key">{_swatch(f"url(#{pattern})")}{words}</span></li>')
    wrong = _swatch("url(#wrong)")
    parts.append(
        f'<li><button type="button" id="marks" aria-pressed="true">{wrong}mark errors</button></li>'
    )
    return f'{_PATTERNS}<ul class="legend" aria-label="Legend">{"".join(parts)}</ul>'


def _swatch(fill: str) -> str:
    return (
        '<svg viewBox="0 0 1 1" aria-hidden="true"><rect width="1" height="1" '
        f'fill="{fill}"/></svg>'
    )


# One tile of a pattern is one cell, so every wrong cell gets a cross of its own.
_PATTERNS = (
    '<svg class="patterns" width="0" height="0" aria-hidden="true"><defs>'
    '<pattern id="wrong" width="1" height="1" patternUnits="userSpaceOnUse">'
    '<path d="M.22 .22L.78 .78M.78 .22L.22 .78" stroke="#fff" stroke-width=".26"/>'
    '<path d="M.22 .22L.78 .78M.78 .22L.22 .78" stroke="#000" stroke-width=".12"/></pattern>'
    '<pattern id="unknown" width=".5" height=".5" patternUnits="userSpaceOnUse">'
    '<rect width=".5" height=".5" fill="#fff"/><circle cx=".25" cy=".25" r=".1" fill="#777"/>'
    '</pattern><pattern id="none" width="1" height="1" patternUnits="userSpaceOnUse">'
    '<rect width="1" height="1" fill="#fff"/>'
    '<path d="M0 1L1 0" stroke="#aab2ba" stroke-width=".06"/></pattern></defs></svg>'
)


def _maps(pair: Pair, evaluation: Evaluation, number: int) -> str:
    """Truth and map of a pair, which one cursor goes through together."""
    title = f"{pair.truth_source} and {pair.map_source}"
    result = pair.result
    told = (
        f"{result.cells} cells of {pair.cells} x {pair.cells} have a truth; overall accuracy "
        f"{result.all.accuracy:.3f}, macro-F1 {result.all.macro_f1:.3f}, coverage "
        f"{result.coverage:.3f}"
    )
    truth, label = ("".join(map(_code, values.tolist())) for values in (pair.truth, pair.label))
    wrong = (pair.truth >= 0) & (pair.truth != pair.label)
    has = pair.truth >= 0
    colours = [e.colour for e in evaluation.environments]
    nothing = f'<path fill="url(#none)" d="{_runs(~has, pair.cells)}"/>'
    left = _drawing("Truth", pair, _areas(pair.truth, colours, pair.cells) + nothing)
    unknown = f'<path fill="url(#unknown)" d="{_runs(pair.label < 0, pair.cells)}"/>'
    pale = f'<path fill="#fff" fill-opacity=".55" d="{_runs(~has, pair.cells)}"/>'
    crosses = f'<path class="wrong" fill="url(#wrong)" d="{_runs(wrong, pair.cells)}"/>'
    areas = _areas(pair.label, colours, pair.cells)
    right = _drawing("Map", pair, areas + unknown + pale + crosses)
    return (
        f'<section><h3>{escape(title)}</h3><p class="soft">{escape(told)}.</p>'
        f'<div class="maps" tabindex="0" role="application" data-cells="{pair.cells}" '
        f'data-truth="{escape(truth)}" data-label="{escape(label)}" data-output="cell-{number}" '
        f'aria-label="{escape(f"Truth and map, {told}. Arrow keys go from cell to cell.")}">'
        f'{left}{right}</div><output id="cell-{number}" aria-live="polite"></output></section>'
    )


def _drawing(title: str, pair: Pair, shapes: str) -> str:
    n, stretch = pair.cells, _stretch(pair)
    cursor = '<rect class="cursor{}" width="1" height="1" display="none"/>'
    return (
        f"<figure><figcaption>{title}</figcaption>"
        f'<svg viewBox="0 0 {n * stretch:.4f} {n}" aria-hidden="true">'
        f'<g transform="scale({stretch:.6f} 1)" shape-rendering="crispEdges">'
        f'<rect class="frame" width="{n}" height="{n}" fill="none"/>{shapes}'
        f"{cursor.format('')}{cursor.format(' inner')}</g></svg></figure>"
    )


def _stretch(pair: Pair) -> float:
    """Width over height of the area on the ground."""
    west, south, east, north = pair.bbox
    shrink = 1.0
    if abs(south) <= 90 and abs(north) <= 90 and pair.system != "m":
        shrink = max(math.cos(math.radians((south + north) / 2)), 0.01)
    return min(max((east - west) / (north - south) * shrink, 0.05), 20.0)


def _areas(values: Ints, colours: list[str], cells: int) -> str:
    """A path for each environment that occurs."""
    return "".join(
        f'<path data-code="{escape(_code(k))}" fill="{escape(colours[k])}" '
        f'd="{_runs(values == k, cells)}"/>'
        for k in np.unique(values[values >= 0]).tolist()
    )


def _runs(mask: NDArray[np.bool_], cells: int) -> str:
    """Cells as the data of an SVG path, the runs of each row as one rectangle, north at the top."""
    rows = np.pad(mask.reshape(cells, cells)[::-1].astype(np.int8), ((0, 0), (1, 1)))
    step = np.diff(rows, axis=1)
    row, start = np.nonzero(step == 1)
    end = np.nonzero(step == -1)[1]
    runs = zip(start.tolist(), row.tolist(), (end - start).tolist(), strict=True)
    return "".join(f"M{x} {y}h{w}v1h-{w}z" for x, y, w in runs)


def _table(head: list[str], rows: list[list[str]]) -> str:
    columns = "".join(f'<th scope="col">{escape(name)}</th>' for name in head)
    body = "".join(
        f'<tr><th scope="row">{escape(row[0])}</th>'
        + "".join(f"<td>{escape(cell)}</td>" for cell in row[1:])
        + "</tr>"
        for row in rows
    )
    return (
        f'<div class="scroll" tabindex="0"><table><thead><tr>{columns}</tr></thead>'
        f"<tbody>{body}</tbody></table></div>"
    )


def _matrix(scores: Scores, names: tuple[str, ...]) -> str:
    """The confusion matrix; the darker, the larger the share of the row."""
    head, rows = reports.confusion_rows(scores, names)
    columns = "".join(f'<th scope="col">{_breakable(name)}</th>' for name in head)
    body = ""
    for i, (name, *cells) in enumerate(rows):
        total = max(sum(map(int, cells)), 1)
        body += f'<tr><th scope="row">{escape(name)}</th>'
        for j, cell in enumerate(cells):
            shade = math.ceil(_SHADES * int(cell) / total)
            right = " right" if i == j else ""
            body += f'<td class="s{shade}{right}">{cell}</td>'
        body += "</tr>"
    return (
        '<div class="scroll" tabindex="0"><table class="matrix"><caption>Cells; truth in rows, '
        "map in columns. Framed: right. The darker, the larger the share of the row.</caption>"
        f"<thead><tr>{columns}</tr></thead><tbody>{body}</tbody></table></div>"
    )


def _breakable(name: str) -> str:
    """A name that may be broken before its capitals, so that a column can be narrow."""
    return "<wbr>".join(map(escape, re.split(r"(?<=[a-z])(?=[A-Z])", name)))
