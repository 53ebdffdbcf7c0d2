"""``symboslam explain``: why a segment of a written map is what it is."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from symboslam.cli.common import show

EXAMPLES = """
[bold]Examples[/]

symboslam explain map.geojson 3-12-7

symboslam explain map.ttl 3-12-7 --against Commercial
"""


def explain(
    source: Annotated[
        Path, typer.Argument(metavar="MAP", help="A map that classify wrote: .geojson, .ttl, .nq.")
    ],
    segment: Annotated[str, typer.Argument(metavar="SEGMENT", help="Its segment_id.")],
    against: Annotated[
        str | None,
        typer.Option(help="Environment to compare with.", show_default="the runner-up"),
    ] = None,
    limit: Annotated[int, typer.Option(min=1, help="Kinds of landmarks to name.")] = 6,
    as_json: Annotated[bool, typer.Option("--json", help="Print the numbers as JSON.")] = False,
) -> None:
    """Tell why a segment is what it is, and why it is not something else."""
    from symboslam.engine.wording import tell
    from symboslam.engine.writers.stored import read_map

    stored = read_map(source)
    found = stored.explain(segment)
    if against is not None:
        against = stored.environment_of(against)
    if as_json:
        from dataclasses import asdict

        typer.echo(json.dumps(asdict(found), indent=1, ensure_ascii=False))
    else:
        show(tell(found, stored.find_indication, against=against, limit=limit))
