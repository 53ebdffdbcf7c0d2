"""``symboslam why``: the axioms from which something follows."""

from __future__ import annotations

from enum import StrEnum
from typing import Annotated

import typer

from symboslam.cli.common import LenientOption, progress_bar, show

EXAMPLES = """
[bold]Examples[/]

symboslam why "House indicates Residential"

symboslam why "SoccerGoals SubClassOf ParksAndRecreationFeature" --format json

symboslam why "IceCream is unsatisfiable" --ontology pizza.owl --limit 10

symboslam why inconsistent --ontology mine.ttl
"""


class Format(StrEnum):
    """How to print justifications."""

    text = "text"
    json = "json"
    ttl = "ttl"


def why(
    question: Annotated[
        str,
        typer.Argument(
            help="'A indicates B', 'A SubClassOf B', 'A is unsatisfiable' or 'inconsistent'. "
            "A and B are names, labels, prefix:name or <IRI>."
        ),
    ],
    ontology: Annotated[
        list[str] | None,
        typer.Option("--ontology", metavar="FILE", help="Your ontology; ours if left out."),
    ] = None,
    limit: Annotated[
        int, typer.Option(min=1, help="How many minimal sets of axioms to look for.")
    ] = 3,
    seconds: Annotated[float, typer.Option(min=1, help="Time limit of the search.")] = 60.0,
    form: Annotated[Format, typer.Option("--format", help="How to print.")] = Format.text,
    lenient: LenientOption = False,
) -> None:
    """Show the smallest sets of axioms from which something follows, with file and line.

    Exit code 0: it follows; 1: it does not; 2: bad input.
    """
    from symboslam.reasoning import why_formats
    from symboslam.reasoning.why import why as ask

    with progress_bar() as progress:
        progress("looking for the axioms", 0.3)
        found = ask(question, ontology or None, limit=limit, seconds=seconds, strict=not lenient)
    if form is Format.text:
        show(why_formats.as_text(found))
    else:
        typer.echo(
            why_formats.as_json(found) if form is Format.json else why_formats.as_turtle(found)
        )
    if not found.entailed:
        raise typer.Exit(1)
