"""``symboslam feature``, ``environments`` and ``sample``: look things up, get data to try."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated

import typer

from symboslam.cli.common import (
    OntologyOption,
    SchemeOption,
    load_knowledge,
    progress_bar,
    show,
    table,
)

if TYPE_CHECKING:
    from symboslam.reasoning.knowledge import Feature, Knowledge

FEATURE_EXAMPLES = """
[bold]Examples[/]

symboslam feature House

symboslam feature building=barn

symboslam feature chair --ontology rooms.ttl
"""


def feature(
    name: Annotated[
        str,
        typer.Argument(help="A feature's name, label or detector class, or an OSM tag key=value."),
    ],
    ontology: OntologyOption = None,
    scheme: SchemeOption = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON.")] = False,
) -> None:
    """Show what a feature indicates, how strongly, why, and its OSM tags."""
    with progress_bar() as progress:
        knowledge = load_knowledge(ontology, progress)
    known = _found(name, knowledge)
    if "=" in name and name not in known.osm_tags:
        show(f"{name} has no feature of its own; {name.partition('=')[0]}=* applies:", error=True)
    indications = sorted(knowledge.indications_of(known.name), key=lambda i: -i.proximity)
    shown = {e.name for e in knowledge.scheme(scheme)}
    indications = [i for i in indications if i.environment in shown]
    position = knowledge.index_of(known.iri)
    assert position is not None
    importance = float(knowledge.importance("path", scheme)[position])
    if as_json:
        record = {
            **asdict(known),
            "importance": importance,
            "indications": [{**asdict(i), "proximity": i.proximity} for i in indications],
        }
        typer.echo(json.dumps(record, indent=1, ensure_ascii=False))
        return
    lines = [
        f"{known.label} ({known.name}): {known.definition}",
        f"{'static' if known.static else 'dynamic'}; {known.iri}",
    ]
    if known.detector_label:
        lines.append(f"detector class: {known.detector_label}")
    if known.osm_tags:
        lines.append(f"OpenStreetMap: {', '.join(known.osm_tags)}")
    lines.append(f"importance {importance:.2f} (1 = points to one environment, 0 = to all alike)")
    result = table("indicates", "strength", "weight", "because")
    for i in indications:
        way = f" [{' > '.join(i.path)}]" if i.steps else ""
        result.add_row(
            i.environment,
            f"{i.proximity:.2f}",
            f"{i.proximity * importance:.2f}",
            _plain(f"{i.reason}{way} ({i.source})"),
        )
    show("\n".join(lines), result)


def _plain(text: str) -> str:
    """Text whose brackets rich must not read as markup."""
    from rich.markup import escape

    return escape(text)


def _found(name: str, knowledge: Knowledge) -> Feature:
    if "=" in name:
        key, _, value = name.partition("=")
        position = knowledge.match_tags({key: value})
        if position is not None:
            return knowledge.features[position]
    return knowledge.get_feature(name)


def environments(
    ontology: OntologyOption = None,
    scheme: SchemeOption = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print as JSON.")] = False,
) -> None:
    """List the environment types, their plan zones and definitions."""
    with progress_bar() as progress:
        knowledge = load_knowledge(ontology, progress)
    chosen = knowledge.scheme(scheme)
    if as_json:
        typer.echo(json.dumps([asdict(e) for e in chosen], indent=1, ensure_ascii=False))
        return
    result = table("environment", "zones", "definition", title=f"schemes: {_schemes(knowledge)}")
    for e in chosen:
        zones = ", ".join(z.name for z in e.zones)
        result.add_row(f"[{e.colour}]\u25a0[/] {e.name}", _plain(zones), _plain(e.definition))
    show(result)


def _schemes(knowledge: Knowledge) -> str:
    return ", ".join(f"{name} ({len(members)})" for name, members in knowledge.schemes.items())


def sample(
    out: Annotated[str, typer.Option("--out", "-o", metavar="FILE", help="GeoJSON to write.")],
    seed: Annotated[int, typer.Option(help="Another seed, another town.")] = 7,
) -> None:
    """Make a made-up town of a few thousand landmarks to try things on."""
    from symboslam.engine.sample import sample_area
    from symboslam.engine.writers.atomic import atomic_file

    town = sample_area(seed=seed)
    with atomic_file(out) as handle:
        handle.write(json.dumps(town).encode())
    show(f"wrote {len(town['features'])} landmarks to {out}")
