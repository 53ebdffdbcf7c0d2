"""``symboslam classify``: landmarks in, environment maps out."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from symboslam.cli.common import (
    OntologyOption,
    SchemeOption,
    bbox_of,
    load_knowledge,
    position_of,
    progress_bar,
    show,
    table,
)
from symboslam.engine.registry import segmentations

if TYPE_CHECKING:
    from symboslam.engine.environment_map import EnvironmentMap

EXAMPLES = """
[bold]Examples[/]

symboslam classify town.geojson --out town.html --out map.geojson

symboslam classify monaco.osm.pbf --bbox 7.40,43.72,7.44,43.75 --out monaco.png

symboslam classify town.geojson --segmentation branch --out fragments.html

symboslam classify flat.csv --ontology rooms.ttl --cells 12 --out flat.html

cat town.geojson | symboslam classify - --out - > map.geojson
"""


def classify(
    source: Annotated[
        str,
        typer.Argument(
            metavar="INPUT",
            help="Landmarks: GeoJSON, CSV or OpenStreetMap (.osm.pbf, .osm, .bz2, .gz); - reads "
            "standard input.",
        ),
    ],
    out: Annotated[
        list[str] | None,
        typer.Option(
            "--out",
            "-o",
            metavar="FILE",
            help="Where to write: .geojson, .ttl, .nq, .png or .html; - is GeoJSON on standard "
            "output. Can be given several times.",
        ),
    ] = None,
    segmentation: Annotated[
        str, typer.Option(help=f"How the map is cut: {', '.join(segmentations())}.")
    ] = "grid",
    profile: Annotated[
        str,
        typer.Option(
            envvar="SYMBOSLAM_PROFILE",
            help="[bold]default[/], or [bold]paper[/] for the equations as the paper has them.",
        ),
    ] = "default",
    scheme: SchemeOption = None,
    ontology: OntologyOption = None,
    crs: Annotated[
        str | None,
        typer.Option(help="Coordinates of the input: EPSG:..., OGC:CRS84, or m for metres."),
    ] = None,
    bbox: Annotated[
        str | None,
        typer.Option(metavar="W,S,E,N", help="Area to classify, in the input's coordinates."),
    ] = None,
    cells: Annotated[
        int | None, typer.Option(help="Finest cells along each side.", show_default="24")
    ] = None,
    input_format: Annotated[
        str | None,
        typer.Option("--format", help="Format of the input, where its name does not tell."),
    ] = None,
    measure: Annotated[
        str | None,
        typer.Option(
            help="Semantic proximity: path, wu_palmer or lin.", show_default="the profile's"
        ),
    ] = None,
    importance: Annotated[
        str | None,
        typer.Option(help="Feature importance: entropy or none.", show_default="the profile's"),
    ] = None,
    threshold: Annotated[
        float | None,
        typer.Option(help="Split a cell while max P is below this.", show_default="the profile's"),
    ] = None,
    bandwidth: Annotated[
        float | None,
        typer.Option(help="Reach of a landmark in metres.", show_default="the ontology's"),
    ] = None,
    absence: Annotated[
        float | None,
        typer.Option(help="Evidence of unmarked ground per hectare.", show_default="estimated"),
    ] = None,
    empty: Annotated[
        str | None,
        typer.Option(
            help="A cell without evidence: inherit its parent's, or unknown.",
            show_default="the profile's",
        ),
    ] = None,
    seed_position: Annotated[
        str | None,
        typer.Option(
            metavar="X,Y",
            help="branch: where the first fragment begins, in the input's coordinates.",
            show_default="the densest spot",
        ),
    ] = None,
    momentum: Annotated[
        int | None,
        typer.Option(help="branch: landmarks passed over between fragments.", show_default="0"),
    ] = None,
    reach: Annotated[
        float | None,
        typer.Option(
            help="branch: metres around a landmark that it stands for.",
            show_default="by the map's density",
        ),
    ] = None,
    reasons: Annotated[
        int | None,
        typer.Option(
            help="Reasons written for each segment; 0 for none.",
            show_default="8; none above 20,000 segments",
        ),
    ] = None,
    quiet: Annotated[bool, typer.Option("--quiet", "-q", help="Print no summary.")] = False,
) -> None:
    """Tell what kind of place each part of a map is."""
    from symboslam.engine.classify import classify as run
    from symboslam.engine.readers import read_landmarks
    from symboslam.engine.writers import check_targets, write_map

    targets = out or []
    check_targets(targets, [source, *([ontology] if ontology else [])])
    with progress_bar(quiet) as progress:
        knowledge = load_knowledge(ontology, progress)
        landmarks = read_landmarks(
            source, knowledge, format=input_format, crs=crs, bbox=bbox_of(bbox), progress=progress
        )
        found = run(
            landmarks,
            knowledge,
            profile=profile,
            scheme=scheme,
            segmentation=segmentation,
            progress=progress,
            cells=cells,
            measure=measure,
            importance=importance,
            threshold=threshold,
            bandwidth=bandwidth,
            absence=absence,
            empty=empty,
            seed_position=position_of(seed_position),
            momentum=momentum,
            reach=reach,
        )
        for target in targets:
            write_map(found, target, reasons=reasons, progress=progress)
    if not quiet:
        summarise(found, targets)


def summarise(found: EnvironmentMap, targets: list[str]) -> None:
    """Print what was found, what was not understood, and where the results are."""
    result = table("environment", "share", "segments")
    for position, (name, share) in enumerate(found.shares().items()):
        count = int((found.label == (-1 if name is None else position)).sum())
        if count:
            result.add_row(name or "unknown", f"{share:.1%}", str(count))
    report = found.landmarks.report
    lines = [f"{len(found.landmarks)} landmarks in {len(found)} segments"]
    if report.unknown:
        most = ", ".join(f"{name} ({n})" for name, n in report.unknown.most_common(8))
        lines.append(
            f"not in the ontology and left out: {sum(report.unknown.values())}, of kind {most}"
            + (", ..." if len(report.unknown) > 8 else "")
        )
    if report.outside:
        lines.append(f"outside the bounding box and left out: {report.outside}")
    if report.duplicates:
        lines.append(f"exact duplicates left out: {report.duplicates}")
    lines += [*report.notes, *found.knowledge.notes]
    lines += [f"wrote {Path(t).resolve()}" for t in targets if t != "-"]
    show(result, "\n".join(lines), error="-" in targets)
