"""``symboslam pitfalls``: look for the 41 pitfalls of the OOPS! catalogue in an ontology."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from symboslam.cli.common import LenientOption, progress_bar, show, table, write_text
from symboslam.reasoning.pitfalls.model import Severity

if TYPE_CHECKING:
    from symboslam.reasoning.pitfalls.model import Report

EXAMPLES = """
[bold]Examples[/]

symboslam pitfalls mine.ttl

symboslam pitfalls mine.owl --fail-on important --format sarif --out pitfalls.sarif

symboslam pitfalls mine.ttl --format json --out baseline.json

symboslam pitfalls mine.ttl --baseline baseline.json

symboslam pitfalls mine.owl --select P04,P06 --ignore P22 --imports ignore

symboslam pitfalls https://w3id.org/symboslam/symboslam

symboslam pitfalls --list
"""

OUTPUT = "What is written"
RULES = "What is looked for"
INPUT = "What is read"


class Imports(StrEnum):
    """What is done with imports."""

    follow = "follow"
    ignore = "ignore"


def pitfalls(
    files: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="FILE...",
            help="The ontology, in one file or several; or the IRI of a module of ours.",
            show_default=False,
        ),
    ] = None,
    form: Annotated[
        str,
        typer.Option(
            "--format",
            "-f",
            help="text, json, md, html, sarif, junit, oops-rdf or oops-xml.",
            rich_help_panel=OUTPUT,
        ),
    ] = "text",
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            "-o",
            metavar="FILE",
            help="Write to a file.",
            show_default=False,
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    fail_on: Annotated[
        Severity,
        typer.Option(
            help="Exit with 1 if there is a pitfall this severe or worse.", rich_help_panel=OUTPUT
        ),
    ] = Severity.MINOR,
    baseline: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="An earlier JSON report: what stands there is known and fails nothing.",
            show_default=False,
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    select: Annotated[
        list[str] | None,
        typer.Option(
            metavar="CODES",
            help="Only these, such as [bold]P04,P06[/]; may be repeated.",
            show_default=False,
            rich_help_panel=RULES,
        ),
    ] = None,
    ignore: Annotated[
        list[str] | None,
        typer.Option(
            metavar="CODES",
            help="Not these; may be repeated.",
            show_default=False,
            rich_help_panel=RULES,
        ),
    ] = None,
    strict_oops: Annotated[
        bool,
        typer.Option(
            "--strict-oops", help="OOPS!'s own rules, its defects included.", rich_help_panel=RULES
        ),
    ] = False,
    inherit: Annotated[
        bool,
        typer.Option(
            "--inherit/--no-inherit",
            help="P11: a sub-property has the domain and range of what is above it.",
            rich_help_panel=RULES,
        ),
    ] = True,
    online: Annotated[
        bool,
        typer.Option(
            "--online",
            help="Ask the network, for P37 and P40; never done without.",
            rich_help_panel=RULES,
        ),
    ] = False,
    questions: Annotated[
        Path | None,
        typer.Option(
            metavar="MANIFEST",
            help="Competency questions, for P09.",
            show_default=False,
            rich_help_panel=RULES,
        ),
    ] = None,
    wordnet: Annotated[
        Path,
        typer.Option(
            metavar="DIR",
            help="WordNet's database files, for P07, P30 and P31.",
            envvar="SYMBOSLAM_WORDNET",
            rich_help_panel=RULES,
        ),
    ] = Path("/usr/share/wordnet"),
    imports: Annotated[
        Imports,
        typer.Option(help="Read what the files import, or not.", rich_help_panel=INPUT),
    ] = Imports.follow,
    lenient: LenientOption = False,
    seconds: Annotated[
        float, typer.Option(min=1, help="Time limit of the whole scan.", rich_help_panel=INPUT)
    ] = 120.0,
    listed: Annotated[
        bool, typer.Option("--list", help="List the pitfalls and end.", rich_help_panel=RULES)
    ] = False,
) -> None:
    """Look for the 41 pitfalls of the OOPS! catalogue, offline, in any OWL ontology.

    Reads Turtle, RDF/XML, OWL/XML, functional syntax, N-Triples and JSON-LD. Several files are one
    ontology. Advisory pitfalls fail nothing unless selected. Exit code 0: nothing as severe as
    --fail-on; 1: pitfalls; 2: bad input, or the time limit was reached; 3: a rule crashed.
    """
    from symboslam.engine.writers.atomic import check_writable
    from symboslam.errors import InputError
    from symboslam.reasoning.pitfalls import baseline as base
    from symboslam.reasoning.pitfalls.model import Settings
    from symboslam.reasoning.pitfalls.registry import choose
    from symboslam.reasoning.pitfalls.report import FORMATS, render, summary
    from symboslam.reasoning.pitfalls.scan import scan_pitfalls

    if listed:
        _list()
        return
    if not files or not all(name.strip() for name in files):
        raise InputError("name the files of the ontology: symboslam pitfalls FILE...")
    if form not in FORMATS:
        raise InputError(f"--format {form}: known formats are {', '.join(FORMATS)}")
    if out is not None:
        check_writable(out)
        if any(Path(file).resolve() == out.resolve() for file in files):
            raise InputError(f"--out {out} would overwrite the ontology")
    codes = choose(select or (), ignore or ())
    known = base.read_baseline(baseline) if baseline else None
    settings = Settings(
        strict_oops=strict_oops,
        online=online,
        inherit=inherit,
        wordnet=wordnet,
        questions=questions,
        seconds=seconds,
    )
    with progress_bar() as progress:
        report = scan_pitfalls(
            files,
            settings,
            codes,
            follow=imports is Imports.follow,
            strict_imports=not lenient,
            progress=progress,
        )
    if known is not None:
        report = base.apply(report, known)
    write_text(render(report, form), out, summary(report))
    raise typer.Exit(_exit_code(report, fail_on, select is not None))


def _exit_code(report: Report, level: Severity, chosen: bool) -> int:
    """3 and 2, a scan that is not whole, come before 1: its answer cannot be relied on."""
    from symboslam.reasoning.pitfalls.model import Status

    if any(result.status is Status.ERRORED for result in report.results):
        return 3
    if report.out_of_time:
        return 2
    return int(any(report.failing(level, advisory=chosen)))


def _list() -> None:
    from symboslam.reasoning.pitfalls.registry import CODES, rule

    found = table("code", "pitfall", "severity", "affects")
    for code in CODES:
        pitfall = rule(code).PITFALL
        advisory = " (advisory)" if pitfall.advisory else ""
        found.add_row(code, pitfall.title, pitfall.severity + advisory, ", ".join(pitfall.affects))
    show(found)
