"""``symboslam cq``: ask an ontology the questions that it must be able to answer."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from symboslam.cli.common import progress_bar, show, table, write_text

if TYPE_CHECKING:
    from symboslam.reasoning.questions.model import Question

app = typer.Typer(
    help="Ask an ontology the questions that it must be able to answer.",
    no_args_is_help=True,
    context_settings={"help_option_names": ["-h", "--help"]},
)

EXAMPLES = """
[bold]Examples[/]

symboslam cq run

symboslam cq run --only 'env-*' --format md

symboslam cq run questions.yml --ontology farm.ttl --data herd.ttl

symboslam cq run manifest.ttl --format junit --out results.xml
"""

ManifestArgument = Annotated[
    Path | None,
    typer.Argument(
        metavar="[MANIFEST]",
        help="Turtle in OWLunit's vocabulary, or the short YAML form; ours if left out.",
        show_default=False,
    ),
]
OnlyOption = Annotated[
    list[str] | None,
    typer.Option(
        "--only",
        metavar="PATTERN",
        help="Only questions whose identifier or group fits; [bold]*[/] stands for anything.",
        show_default=False,
    ),
]


@app.callback()
def _group() -> None:
    """Ask an ontology the questions that it must be able to answer."""


@app.command("run", epilog=EXAMPLES)
def run(
    manifest: ManifestArgument = None,
    ontology: Annotated[
        list[str] | None,
        typer.Option(
            "--ontology",
            metavar="FILE",
            help="Ask this ontology, not the one that the manifest names; may be repeated.",
            show_default=False,
        ),
    ] = None,
    data: Annotated[
        list[Path] | None,
        typer.Option(
            "--data",
            metavar="FILE",
            help="Data besides what the manifest names; may be repeated.",
            show_default=False,
        ),
    ] = None,
    only: OnlyOption = None,
    form: Annotated[
        str, typer.Option("--format", "-f", help="text, json, junit, md or html.")
    ] = "text",
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", metavar="FILE", help="Write to a file.", show_default=False),
    ] = None,
    no_reasoner: Annotated[
        bool, typer.Option("--no-reasoner", help="Skip the questions that need the reasoner.")
    ] = False,
    lenient_imports: Annotated[
        bool,
        typer.Option("--lenient-imports", help="Read on where an import is missing or cyclic."),
    ] = False,
) -> None:
    """Ask the questions of a manifest and compare the answers with the expected ones.

    Exit code 0: none failed; 1: a question failed or is broken; 2: bad input.
    """
    from symboslam.engine.writers.atomic import check_writable
    from symboslam.errors import InputError
    from symboslam.reasoning.questions import run as runner
    from symboslam.reasoning.questions.report import FORMATS, render, summary

    if form not in FORMATS:
        raise InputError(f"--format {form}: known formats are {', '.join(FORMATS)}")
    if out is not None:
        check_writable(out)
    with progress_bar() as progress:
        progress("reading the questions", 0.01)
        questions = _load(manifest, only)
        targets = [name if "://" in name else Path(name) for name in ontology or ()]
        questions = runner.with_files(questions, targets, data or ())
        report = runner.run(
            questions,
            title=_title(manifest),
            reasoning=not no_reasoner,
            strict=not lenient_imports,
            progress=progress,
        )
    write_text(render(report, form), out, summary(report))
    if not report.ok:
        raise typer.Exit(1)


@app.command("list")
def list_questions(manifest: ManifestArgument = None, only: OnlyOption = None) -> None:
    """List the questions of a manifest without asking them."""
    found = table("id", "question", "group", "reasoner")
    for question in _load(manifest, only):
        needed = "yes" if question.needs_reasoner else ""
        found.add_row(question.id, _plain(question.text), _plain(question.group), needed)
    show(found)


def _load(manifest: Path | None, only: list[str] | None) -> list[Question]:
    from symboslam.reasoning.questions.manifest import default_manifest, load_manifest
    from symboslam.reasoning.questions.run import choose

    return choose(load_manifest(manifest or default_manifest()), only or ())


def _title(manifest: Path | None) -> str:
    return f"Competency questions of {manifest if manifest else 'SymboSLAM'}"


def _plain(text: str) -> str:
    """Text whose brackets rich must not read as markup."""
    from rich.markup import escape

    return escape(text)
