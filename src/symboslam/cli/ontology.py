"""``symboslam ontology check``: is an ontology fit for use?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from symboslam.cli.common import progress_bar, show

app = typer.Typer(
    help="Work on ontologies.",
    no_args_is_help=True,
    context_settings={"help_option_names": ["-h", "--help"]},
)


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
