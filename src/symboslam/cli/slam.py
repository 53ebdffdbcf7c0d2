"""``symboslam slam``: logs of robots, and the maps that are made of them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from symboslam.cli import slam_mrclam, slam_run
from symboslam.cli.common import OntologyOption, load_knowledge, progress_bar, show
from symboslam.cli.slam_common import (
    ClassesOption,
    FromOption,
    IdentitiesOption,
    OriginOption,
    StartsOption,
    origin_of,
    plural,
)

if TYPE_CHECKING:
    from symboslam.engine.slam.log import Mission

app = typer.Typer(
    no_args_is_help=True, help="Map building: logs of robots and what is made of them."
)

CONVERT_EXAMPLES = """
[bold]Examples[/]

symboslam slam convert mrclam6 odometry.tum

symboslam slam convert mrclam6 landmarks.geojson --paths paths.geojson

symboslam slam convert victoria_park.txt.gz park.g2o

symboslam slam convert logs park.geojson --origin 149.13,-35.28

symboslam slam convert result.g2o result.ttl
"""


@app.command("convert", epilog=CONVERT_EXAMPLES)
def convert(
    source: Annotated[
        Path,
        typer.Argument(
            metavar="IN",
            help="Logs: a folder (MRCLAM, CSV) or a file (g2o, GTSAM text, CSV, TUM, NDJSON), "
            "gzipped or not.",
        ),
    ],
    target: Annotated[
        Path,
        typer.Argument(metavar="OUT", help="Map: .tum, .g2o, .geojson, .ttl or .dsg.json."),
    ],
    read_as: FromOption = None,
    write_as: Annotated[
        str | None,
        typer.Option(
            "--to", help="tum, g2o, geojson, turtle or spark_dsg.", show_default="by OUT's ending"
        ),
    ] = None,
    classes: ClassesOption = None,
    starts: StartsOption = None,
    identities: IdentitiesOption = None,
    every: Annotated[
        float, typer.Option(min=0, help="Seconds between poses at least; 0 keeps all.")
    ] = 0.0,
    origin: OriginOption = None,
    paths: Annotated[
        Path | None, typer.Option(metavar="FILE", help="geojson: also the paths, to this file.")
    ] = None,
    ontology: OntologyOption = None,
) -> None:
    """Convert logs, without estimating anything.

    Robots are where their odometry puts them; where a g2o or GTSAM file holds estimates, those
    count. What was mended in the input, or has no place in the output, is printed.
    """
    from symboslam.engine.slam import readers, writers
    from symboslam.engine.slam.dead_reckoning import dead_reckoned
    from symboslam.engine.writers import check_targets

    inputs = [source, *([ontology] if ontology else [])]
    wanted = writers.format_of(target, write_as)
    outputs = [target, *([paths] if paths else [])]
    check_targets(outputs, inputs, lambda _: wanted)
    options: dict[str, Any] = {"classes": classes, "start": starts, "identities": identities}
    with progress_bar() as progress:
        name = readers.format_of(source, read_as)
        looks_up = "knowledge" in readers.FORMATS[name].options
        asked = looks_up or wanted == "turtle"
        knowledge = load_knowledge(ontology, progress) if asked else None
        progress("reading", 0.2)
        options["knowledge"] = knowledge if looks_up else None
        mission, notes = readers.read_mission(source, name, **options)
        found = readers.read_estimate(source, mission, name) or dead_reckoned(mission, every)
        progress("writing", 0.7)
        written = writers.write_slam_map(
            target,
            found,
            mission,
            wanted,
            origin=origin_of(origin),
            paths=paths,
            knowledge=knowledge if wanted == "turtle" else None,
        )
    told = [*notes, *found.notes, *written.notes]
    files = [f"wrote {file.resolve()}" for file in written.files]
    show("\n".join([_summary(mission), *told, *files]))


def _summary(mission: Mission) -> str:
    poses = sum(len(log.odometry) for log in mission.robots)
    seen = sum(len(log.seen) for log in mission.robots)
    return (
        f"{plural(len(mission.robots), 'robot')}, {poses} poses, {seen} sightings of "
        f"{plural(len(mission.classes), 'class', 'classes')}"
    )


app.command("run", epilog=slam_run.EXAMPLES)(slam_run.run)
app.command("mrclam", epilog=slam_mrclam.EXAMPLES)(slam_mrclam.mrclam)
