"""``symboslam validate``: does a map in RDF state what a map must state?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from symboslam.cli.common import progress_bar, show

EXAMPLES = """
[bold]Examples[/]

symboslam validate map.ttl

symboslam validate map.nq --shapes my-shapes.ttl
"""


def validate(
    source: Annotated[Path, typer.Argument(metavar="MAP", help="A map in RDF: .ttl, .nt, .nq.")],
    shapes: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Other SHACL shapes.", show_default="ours"),
    ] = None,
) -> None:
    """Check a map in RDF against SHACL shapes.

    Each violation names the node, the property and the value. Exit code 0: the map conforms;
    1: violations; 2: a file cannot be read.
    """
    from symboslam.engine.validate import validate_map

    with progress_bar() as progress:
        progress("checking the map", 0.3)
        report = validate_map(source, shapes)
    show(str(report))
    if not report.conforms:
        raise typer.Exit(1)
