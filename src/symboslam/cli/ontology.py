"""``symboslam ontology``: check an ontology, compare it with upstream, write pages about it."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

from symboslam.cli.common import LenientOption, progress_bar, show

app = typer.Typer(
    help="Work on ontologies.",
    no_args_is_help=True,
    context_settings={"help_option_names": ["-h", "--help"]},
)


class CompareFormat(StrEnum):
    """How a comparison is printed."""

    text = "text"
    json = "json"
    md = "md"


@app.callback()
def _group() -> None:
    """Work on ontologies."""


@app.command("check")
def check(
    files: Annotated[
        list[Path] | None,
        typer.Argument(metavar="[FILE]...", help="Your ontology; ours if left out."),
    ] = None,
) -> None:
    """Reason over an ontology and list what would keep it from working.

    Exit code 0: nothing found; 1: findings, a contradiction among them; 2: it cannot be read.
    """
    from symboslam.reasoning.check import check_ontology

    with progress_bar() as progress:
        progress("reasoning over the ontology", 0.3)
        report = check_ontology(files or None)
    show(str(report))
    if report.findings:
        raise typer.Exit(1)


@app.command("compare")
def compare(
    upstream: Annotated[
        Path,
        typer.Option(
            metavar="DIR", help="Folder with upstream ontology files, searched to the bottom."
        ),
    ],
    form: Annotated[
        CompareFormat, typer.Option("--format", help="How to print.")
    ] = CompareFormat.text,
) -> None:
    """List which terms that our modules reuse still exist upstream, changed or vanished.

    For the Onto4MAT, OntoSLAM and SymboSLAM (2022) files that you have; all files count as one
    upstream. Exit code 0: all exist; 1: something vanished or changed its label or kind; 2: no
    such folder, no ontology in it, or one that cannot be read.
    """
    from symboslam.reasoning import fidelity, fidelity_report

    with progress_bar() as progress:
        progress("reading upstream files", 0.3)
        found = fidelity.compare(upstream)
    if form is CompareFormat.text:
        show(fidelity_report.as_text(found))
    elif form is CompareFormat.json:
        typer.echo(fidelity_report.as_json(found))
    else:
        typer.echo(fidelity_report.as_markdown(found))
    if not found.ok:
        raise typer.Exit(1)


@app.command("docs")
def docs(
    files: Annotated[
        list[Path] | None,
        typer.Argument(metavar="[FILE]...", help="Your ontology; ours if left out."),
    ] = None,
    out: Annotated[
        Path,
        typer.Option(
            "--out",
            "-o",
            metavar="DIR",
            help="Folder for the pages: a new or empty one, or an earlier build's.",
        ),
    ] = Path("ontology-docs"),
    questions: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="A report of [bold]symboslam cq run --format html[/] to go along.",
            show_default=False,
        ),
    ] = None,
    lenient: LenientOption = False,
) -> None:
    """Write pages about an ontology: reference, diagrams, the features of each environment type.

    The pages need no network and no server: open index.html in a browser.
    """
    from symboslam.errors import InputError
    from symboslam.reasoning.documentation.site import build_site

    report = None
    if questions is not None:
        try:
            report = questions.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise InputError(f"{questions} cannot be read: {error}") from error
    with progress_bar() as progress:
        site = build_site(files or None, questions=report, strict=not lenient, progress=progress)
        first = site.write(out)
    show(f"{len(site.files)} files; open in a browser: {first}")
