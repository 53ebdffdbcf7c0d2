"""``symboslam slam run``: build a map of what robots drove and saw."""

from __future__ import annotations

import json
import sys
import time
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from symboslam.cli.common import OntologyOption, Progress, progress_bar, show
from symboslam.cli.slam_common import (
    ClassesOption,
    FromOption,
    IdentitiesOption,
    JsonOption,
    OriginOption,
    OutOption,
    StartsOption,
    between,
    check_outs,
    estimator,
    knowledge_for,
    origin_of,
    plural,
    robots_lost,
    starts_of,
    tell_doubts,
    write_outs,
)
from symboslam.errors import InputError

if TYPE_CHECKING:
    from symboslam.engine.slam.log import Mission
    from symboslam.engine.slam.slam_map import SlamMap

EXAMPLES = """
[bold]Examples[/]

symboslam slam run mrclam6 --classes 4 --out landmarks.geojson --out paths.tum

symboslam slam run victoria_park.txt.gz --identities hidden --out park.g2o

symboslam slam run odometry.csv detections.csv --out map.ttl --json

symboslam slam run r1.ndjson r2.ndjson --out map.geojson

symboslam slam run mrclam6 --method paper --oracle --out paper.geojson
"""


class Method(StrEnum):
    """Ways to build a map."""

    OURS = "ours"
    PAPER = "paper"
    DEAD_RECKONING = "dead-reckoning"


def run(
    logs: Annotated[
        list[Path],
        typer.Argument(
            metavar="LOG",
            help="A folder (MRCLAM, CSV) or a file (g2o, GTSAM text, CSV, TUM, NDJSON of agents), "
            "gzipped or not; of CSV and NDJSON also several files.",
            show_default=False,
        ),
    ],
    out: OutOption = None,
    method: Annotated[
        Method,
        typer.Option(
            help="[bold]ours[/]; the [bold]paper[/]'s rule; or [bold]dead-reckoning[/]: odometry "
            "alone."
        ),
    ] = Method.OURS,
    oracle: Annotated[
        bool,
        typer.Option("--oracle", help="paper: set robots to their true poses every 60 s."),
    ] = False,
    read_as: FromOption = None,
    classes: ClassesOption = None,
    starts: StartsOption = None,
    identities: IdentitiesOption = None,
    origin: OriginOption = None,
    ontology: OntologyOption = None,
    as_json: JsonOption = False,
) -> None:
    """Build a map: where robots went, and which landmarks they saw.

    The truth, where logs have one, is looked at by the oracle alone. Doubts in the map are printed
    on standard error, and are no failure: the exit code is 0.
    """
    from symboslam.engine.slam import readers

    outs = out or []
    if oracle and method != Method.PAPER:
        raise InputError("--oracle is a part of the paper's rule: give --method paper too")
    check_outs(outs, [*logs, *([ontology] if ontology else [])], origin)
    place = origin_of(origin)
    source = logs[0] if len(logs) == 1 else logs
    options: dict[str, Any] = {"classes": classes, "start": starts, "identities": identities}
    with progress_bar() as progress:
        name = readers.format_of(source, read_as)
        knowledge = knowledge_for(name, outs, ontology, progress)
        progress("reading", 0.05)
        options["knowledge"] = knowledge if "knowledge" in readers.FORMATS[name].options else None
        mission, notes = readers.read_mission(source, name, **options)
        begun = time.perf_counter()
        found = _map(mission, method, oracle, between(progress, 0.1, 0.9))
        seconds = time.perf_counter() - begun
        progress("writing", 0.9)
        files, odd = write_outs(outs, found, mission, place, knowledge)
    told = [*notes, *found.notes, *odd]
    tell_doubts(found.doubts)
    if as_json:
        summary = _summary(found, mission, method, seconds)
        summary |= {"notes": told, "files": [str(file.resolve()) for file in files]}
        sys.stdout.write(json.dumps(summary, indent=2) + "\n")
    else:
        wrote = [f"wrote {file.resolve()}" for file in files]
        show("\n".join([_sentence(found, mission), *told, *wrote]))


def _map(mission: Mission, method: Method, oracle: bool, progress: Progress) -> SlamMap:
    from symboslam.engine.slam.comparison import blind
    from symboslam.engine.slam.dead_reckoning import dead_reckoned
    from symboslam.engine.slam.paper import paper_map

    if method == Method.OURS:
        return estimator()(blind(mission), progress=progress)
    progress("mapping", 0.0)
    if method == Method.PAPER:
        return paper_map(mission, oracle=oracle)
    return dead_reckoned(mission)


def _summary(found: SlamMap, mission: Mission, method: Method, seconds: float) -> dict[str, Any]:
    """What ``--json`` prints."""
    moving = int(found.landmarks.dynamic.sum())
    return {
        "method": str(method),
        "starts": starts_of(mission),
        "robots_lost": robots_lost(found, mission),
        "robots": [
            {
                "name": log.name,
                "placed": log.name in found.trajectories,
                "poses": len(found.trajectories[log.name].time)
                if log.name in found.trajectories
                else 0,
                "sightings": len(log.seen),
                "sightings_of_landmarks": int((found.landmark_of[log.name] >= 0).sum())
                if log.name in found.landmark_of
                else 0,
            }
            for log in mission.robots
        ],
        "landmarks": len(found.landmarks) - moving,
        "moving": moving,
        "seconds": round(seconds, 3),
        "doubts": list(found.doubts),
    }


def _sentence(found: SlamMap, mission: Mission) -> str:
    moving = int(found.landmarks.dynamic.sum())
    parts = [
        f"{len(found.trajectories)} of {plural(len(mission.robots), 'robot')} placed",
        plural(len(found.landmarks) - moving, "landmark"),
        *([f"{moving} that move"] if moving else []),
        plural(len(found.doubts), "doubt"),
    ]
    return ", ".join(parts)
