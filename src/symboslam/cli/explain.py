"""``symboslam explain``: why a segment of a written map is what it is."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from symboslam.cli.common import OntologyOption, bbox_of, load_knowledge, progress_bar, show
from symboslam.errors import InputError

if TYPE_CHECKING:
    from symboslam.engine.environment_map import EnvironmentMap
    from symboslam.engine.writers.stored import StoredMap

EXAMPLES = """
[bold]Examples[/]

symboslam explain map.geojson 3-12-7

symboslam explain map.ttl 3-12-7 --against Commercial

symboslam explain map.geojson 3-12-7 --length line

symboslam explain map.geojson 3-12-7 --landmarks town.geojson --length full

symboslam explain map.geojson 3-12-7 --landmarks town.geojson --counterfactual

symboslam explain map.geojson 3-12-7 --format ttl > why.ttl
"""
ALL = 10_000


def explain(
    source: Annotated[
        Path, typer.Argument(metavar="MAP", help="A map that classify wrote: .geojson, .ttl, .nq.")
    ],
    segment: Annotated[str, typer.Argument(metavar="SEGMENT", help="Its segment_id.")],
    against: Annotated[
        str | None,
        typer.Option(help="Environment to compare with.", show_default="the runner-up"),
    ] = None,
    limit: Annotated[
        int | None,
        typer.Option(
            min=1,
            help="Kinds of landmarks to name; with [bold]--landmarks[/] also single landmarks, and "
            "pairs of them, to list in full and in JSON and RDF. The rest is summed up.",
            show_default="6 kinds, all if full; 20 landmarks and pairs",
        ),
    ] = None,
    length: Annotated[
        Literal["line", "paragraph", "full"], typer.Option(help="How much to tell.")
    ] = "paragraph",
    counterfactual: Annotated[
        bool,
        typer.Option(
            "--counterfactual",
            help="Look for small changes of landmarks that would make it something else; needs "
            "[bold]--landmarks[/].",
        ),
    ] = False,
    landmarks: Annotated[
        str | None,
        typer.Option(
            metavar="FILE",
            help="The landmarks that the map was made from, to tell what each of them adds.",
        ),
    ] = None,
    bbox: Annotated[
        str | None,
        typer.Option(metavar="W,S,E,N", help="Area, if the map was made with one."),
    ] = None,
    crs: Annotated[
        str | None, typer.Option(help="Coordinates of the landmarks, if given for the map.")
    ] = None,
    ontology: OntologyOption = None,
    form: Annotated[
        Literal["text", "json", "ttl"],
        typer.Option("--format", help="Words, numbers, or RDF in the terms of the ontology."),
    ] = "text",
    as_json: Annotated[bool, typer.Option("--json", help="The same as --format json.")] = False,
) -> None:
    """Tell why a segment is what it is, and why it is not something else."""
    from symboslam.engine.account_formats import as_json as json_of
    from symboslam.engine.account_rdf import as_turtle
    from symboslam.engine.landmark_parts import LANDMARKS
    from symboslam.engine.wording import text_of
    from symboslam.engine.writers.stored import read_map

    stored = read_map(source)
    found = stored.explain(segment)
    if against is not None:
        against = stored.environment_of(against)
    names = limit or (ALL if length == "full" else 6)
    iris = dict(stored.iris)
    if landmarks is not None:
        from symboslam.engine.account import full_account

        anew = _restored(stored, landmarks, ontology, crs, bbox_of(bbox))
        with progress_bar() as progress:
            progress("looking for changes" if counterfactual else "explaining", 0.5)
            told = full_account(
                anew, segment, against=against, limit=names, listed=limit or LANDMARKS,
                counterfactual=counterfactual,
            )  # fmt: skip
        iris |= {feature.name: feature.iri for feature in anew.knowledge.features}
    elif counterfactual:
        raise InputError(
            f"{source} does not say where each landmark is and what it adds: give the landmarks "
            "that it was made from, --landmarks FILE"
        )
    else:
        from symboslam.engine.account import account_of

        told = account_of(found, stored.find_indication, against=against, limit=names)
    if as_json or form == "json":
        typer.echo(json_of(told, length))
    elif form == "ttl":
        typer.echo(as_turtle(told, iris, length, stored.segment_iris.get(segment)), nl=False)
    else:
        show(text_of(told, length))


def _restored(
    stored: StoredMap,
    landmarks: str,
    ontology: Path | None,
    crs: str | None,
    bbox: tuple[float, float, float, float] | None,
) -> EnvironmentMap:
    """The map with its landmarks."""
    from symboslam.engine.readers import read_landmarks
    from symboslam.engine.writers.restored import restored

    with progress_bar() as progress:
        knowledge = load_knowledge(ontology, progress)
        marks = read_landmarks(landmarks, knowledge, crs=crs, bbox=bbox, progress=progress)
        return restored(stored, marks, knowledge)
