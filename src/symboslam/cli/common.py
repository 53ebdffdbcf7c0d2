"""What the commands share: options, progress on a terminal, tables."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from symboslam.errors import GeometryError

if TYPE_CHECKING:
    from rich.table import Table

    from symboslam.reasoning.knowledge import Knowledge

Progress = Callable[[str, float], None]

OntologyOption = Annotated[
    Path | None,
    typer.Option(
        "--ontology",
        metavar="FILE",
        help="Your own ontology in place of ours (Turtle, RDF/XML, ...).",
        show_default=False,
    ),
]
SchemeOption = Annotated[
    str | None,
    typer.Option(
        help="Set of environment types: [bold]all[/] or [bold]territory-plan[/] in our ontology.",
        show_default="the ontology's own",
    ),
]
LenientOption = Annotated[
    bool,
    typer.Option(
        "--lenient-imports",
        help="Read on where an import is missing or goes in a circle, or a file is empty or "
        "begins with a byte-order mark.",
    ),
]


@contextmanager
def progress_bar(quiet: bool = False) -> Iterator[Progress]:
    """A progress bar on standard error, where that is a terminal; else nothing."""
    if quiet or not sys.stderr.isatty():
        yield lambda stage, share: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = (TextColumn("{task.description:24}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("starting", total=1.0)
        yield lambda stage, share: bar.update(task, description=stage, completed=share)


def load_knowledge(ontology: Path | None, progress: Progress) -> Knowledge:
    """The bundled knowledge, or that of the user's ontology."""
    from symboslam.reasoning.knowledge import Knowledge

    progress("reading the ontology" if ontology is None else "reasoning over the ontology", 0.02)
    return Knowledge.load(ontology)


def bbox_of(text: str | None) -> tuple[float, float, float, float] | None:
    """The four numbers of ``W,S,E,N``.

    Raises:
        GeometryError: not four numbers.
    """
    if text is None:
        return None
    try:
        west, south, east, north = (float(v) for v in text.replace(" ", "").split(","))
    except ValueError:
        raise GeometryError(
            f"--bbox {text!r}: give four numbers W,S,E,N, such as 7.40,43.72,7.44,43.75"
        ) from None
    return west, south, east, north


def position_of(text: str | None) -> tuple[float, float] | None:
    """The two numbers of ``X,Y``.

    Raises:
        GeometryError: not two numbers.
    """
    if text is None:
        return None
    try:
        x, y = (float(v) for v in text.replace(" ", "").split(","))
    except ValueError:
        raise GeometryError(
            f"--seed-position {text!r}: give two numbers X,Y, such as 7.42,43.74"
        ) from None
    return x, y


def table(*columns: str, title: str | None = None) -> Table:
    """An empty table in the house's look."""
    from rich import box
    from rich.table import Table

    found = Table(title=title, box=box.SIMPLE_HEAD, title_justify="left")
    for name in columns:
        number = name in ("share", "segments", "strength", "weight", "P")
        found.add_column(name, justify="right" if number else "left")
    return found


def show(*what: object, error: bool = False) -> None:
    """Print tables and text; on standard error if standard output carries data."""
    from rich.console import Console

    stream = sys.stderr if error else sys.stdout
    width = None if stream.isatty() else 110
    console = Console(stderr=error, width=width, highlight=False)
    for thing in what:
        text = isinstance(thing, str)
        console.print(thing, markup=not text, soft_wrap=text)


def write_text(text: str, out: Path | None, summary: str) -> None:
    """Write a report to a file and say so with its summary; without a file to standard output."""
    from symboslam.engine.writers.atomic import atomic_file

    if out is None:
        sys.stdout.write(text)
        return
    with atomic_file(out) as handle:
        handle.write(text.encode())
    show(f"{summary}; wrote {out}", error=True)
