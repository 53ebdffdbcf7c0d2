"""``symboslam sim run``: robots search a world, map it and tell what kind of place each part is."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Sequence
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from symboslam.cli.common import load_knowledge, progress_bar, show
from symboslam.errors import InputError

if TYPE_CHECKING:
    from symboslam.cli.common import Progress
    from symboslam.reasoning.knowledge import Knowledge
    from symboslam.sim_bridge.mission.mission import Tick
    from symboslam.sim_bridge.mission.outcome import Result
    from symboslam.sim_bridge.worlds.world import World

EXAMPLES = """
[bold]Examples[/]

symboslam sim run demo --time-limit 3 --out map.html

symboslam sim run city --robots 3 --seed 1 --record city-run --out map.geojson

symboslam sim run city --slam oracle --segmentation branch --json

symboslam sim run my-yard.json --robot husky --robots 1 --time-limit 5
"""
INTERRUPTED = 130
OTHERS = 10.0
"""Minutes in worlds that the paper does not have."""


class RobotKind(StrEnum):
    """Kinds of robots."""

    KINEMATIC = "kinematic"
    HUSKY = "husky"


class Slam(StrEnum):
    """Ways to build a map."""

    OURS = "ours"
    PAPER = "paper"
    ORACLE = "oracle"


class DetectorName(StrEnum):
    """Detectors."""

    SEG = "seg"
    ONNX = "onnx"


class Segmentation(StrEnum):
    """Ways to cut the map."""

    GRID = "grid"
    BRANCH = "branch"


def run(
    world: Annotated[
        str,
        typer.Argument(
            metavar="WORLD",
            help="gungahlin, airport, fyshwick, kingston, train-depot, city or demo; or a file as "
            "symboslam sim world reads it.",
            show_default=False,
        ),
    ],
    robots: Annotated[int, typer.Option(min=1, help="How many.")] = 3,
    robot: Annotated[
        RobotKind,
        typer.Option(
            help="[bold]kinematic[/]: a light car for kilometres; [bold]husky[/]: with physics, "
            "for small areas."
        ),
    ] = RobotKind.KINEMATIC,
    search: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="Search strategy: random-walk (the paper's), correlated-walk, ballistic, "
            "random-waypoint, frontier or boustrophedon.",
        ),
    ] = "boustrophedon",
    slam: Annotated[
        Slam,
        typer.Option(
            help="[bold]ours[/]; the [bold]paper[/]'s rule; or the [bold]oracle[/]: the paper's "
            "rule with true poses every 60 s."
        ),
    ] = Slam.OURS,
    detector: Annotated[
        DetectorName,
        typer.Option(
            help="[bold]seg[/]: the segmentation, with errors; [bold]onnx[/]: a trained model."
        ),
    ] = DetectorName.SEG,
    segmentation: Annotated[
        Segmentation, typer.Option(help="How the map is cut.")
    ] = Segmentation.GRID,
    time_limit: Annotated[
        float | None,
        typer.Option(
            metavar="MIN", help="Simulated minutes.", show_default="the paper's of its areas, or 10"
        ),
    ] = None,
    speed: Annotated[float, typer.Option(metavar="M/S", help="Of the robots, at most.")] = 10.0,
    reach: Annotated[
        float,
        typer.Option("--range", metavar="M", help="Within which ground counts as looked at."),
    ] = 60.0,
    gps: Annotated[bool, typer.Option("--gps", help="Robots have GPS, good to 3 m.")] = False,
    seed: Annotated[int, typer.Option(min=0, help="The same seed gives the same run.")] = 0,
    world_seed: Annotated[int, typer.Option(min=0, help="Of a named world.")] = 7,
    record: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR",
            help="Write logs, truth, coverage, events, landmarks, map and metrics, as it goes.",
            show_default=False,
        ),
    ] = None,
    outs: Annotated[
        list[Path] | None,
        typer.Option(
            "--out",
            metavar="FILE",
            help="Write the map: .geojson, .html, .png, .ttl or .nq. May be given several times.",
            show_default=False,
        ),
    ] = None,
    gui: Annotated[bool, typer.Option("--gui", help="Show it in pybullet's window.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print one JSON object.")] = False,
) -> None:
    """Let robots search a world, map it, and tell what kind of place each part of it is.

    Ctrl-C ends the mission; what was recorded by then is valid. The exit code is then 130.
    """
    targets = list(outs or [])
    minutes = _minutes(world) if time_limit is None else time_limit
    _check(targets, world, minutes, speed, reach, gui)
    from dataclasses import replace

    from symboslam.sim_bridge.bridge.detections import get_detector
    from symboslam.sim_bridge.bridge.settings import BridgeSettings, DetectorSpec, GpsSpec
    from symboslam.sim_bridge.objects.bullet import import_pybullet
    from symboslam.sim_bridge.search.registry import get_search, search_of
    from symboslam.sim_bridge.worlds.generator import get_world

    if detector == DetectorName.ONNX:
        import numpy as np

        get_detector("onnx", DetectorSpec(), (), np.random.default_rng(0))
    import_pybullet()
    made, odd = get_world(world, world_seed)
    get_search(search)
    from symboslam.sim_bridge.mission.mission import fly
    from symboslam.sim_bridge.mission.outcome import conclude, mission_figures
    from symboslam.sim_bridge.mission.record import Recorder
    from symboslam.sim_bridge.mission.team import MissionSettings, assemble

    settings = MissionSettings(
        robots, str(robot), str(detector), 60 * minutes, seed, reach=reach, window=gui,
        bridge=replace(BridgeSettings(), speed=speed, gps=GpsSpec() if gps else None),
    )  # fmt: skip
    config = {"world": world, "world_seed": world_seed, "search": search, "slam": str(slam),
              "segmentation": str(segmentation)}  # fmt: skip
    recorder = Recorder(record, config) if record is not None else None
    written: list[Path] = []
    with progress_bar() as progress:
        knowledge = load_knowledge(None, progress)
        _check_zones(made, knowledge)
        team = assemble(made, settings, knowledge)
        try:
            ended = fly(
                team,
                search_of(search, team.area(), seed),
                recorder,
                lambda tick: _told(progress, settings.time_limit, tick),
            )
            if ended.ended == "interrupted":
                metrics = mission_figures(team, ended)
            else:
                result = conclude(
                    team, ended, knowledge, slam=str(slam), segmentation=str(segmentation),
                    progress=lambda stage, share: progress(stage, 0.8 + 0.2 * share),
                    folder=record,
                )  # fmt: skip
                metrics = result.metrics
                if _write(result, [*targets, *([record / "map.geojson"] if record else [])]):
                    written = targets
        finally:
            team.close()
            if recorder is not None:
                recorder.close()
    metrics["notes"] = [*odd, *metrics["notes"]]
    if recorder is not None:
        recorder.write_json("metrics.json", metrics)
    if as_json:
        sys.stdout.write(json.dumps(metrics, indent=2) + "\n")
    else:
        wrote = [f"wrote {target.resolve()}" for target in written]
        wrote += [f"recorded in {record.resolve()}"] if record else []
        show("\n".join([*_sentences(metrics), *metrics["notes"], *wrote]))
    if ended.ended == "interrupted":
        raise typer.Exit(INTERRUPTED)


def _minutes(world: str) -> float:
    """The time that the paper's robots had in an area of that name."""
    from symboslam.sim_bridge.search.paper_areas import AREAS

    area = AREAS.get(world.casefold())
    return OTHERS if area is None else area.minutes


def _check(
    targets: Sequence[Path], world: str, time_limit: float, speed: float, reach: float, gui: bool
) -> None:
    from symboslam.engine.writers import check_targets, format_of

    if not 0 < time_limit < 1e5:
        raise InputError(f"--time-limit {time_limit:g}: give minutes above 0")
    if not 0 < speed <= 50:
        raise InputError(f"--speed {speed:g}: give metres a second above 0, at most 50")
    if not 1 <= reach <= 1000:
        raise InputError(f"--range {reach:g}: give metres from 1 to 1000")
    if gui and sys.platform == "linux" and not os.environ.get("DISPLAY"):
        raise InputError("--gui: there is no display (DISPLAY is not set)")
    source = Path(world)
    check_targets(targets, [source] if source.is_file() else [], format_of)


def _check_zones(world: World, knowledge: Knowledge) -> None:
    """Refuse environments that no map can have, before hours are flown."""
    known = {environment.name for environment in knowledge.environments}
    for zone in world.zones:
        if zone.environment not in known:
            raise InputError(
                f"{world.name}: a zone has the environment {zone.environment!r}, which the "
                f"ontology does not: {', '.join(sorted(known))}"
            )


def _write(result: Result, targets: Sequence[Path]) -> bool:
    """Write the map, if there is one; whether there is."""
    from symboslam.engine.writers import write_map

    if result.environment_map is None:
        if targets:
            result.metrics["notes"].append("nothing was seen: there is no map to write")
        return False
    for target in targets:
        write_map(result.environment_map, target)
    return True


def _sentences(m: dict[str, Any]) -> list[str]:
    """The figures as lines of text."""
    lines = [
        f"{m['world']}: {m['time_s'] / 60:.1f} min ({m['ended']}), "
        f"{m['real_time_factor']:.1f} times real time",
        f"coverage {m['coverage']:.1%} (formula {m['coverage_formula']:.1%}), "
        f"{m['objects_found']} of {m['objects']} objects found",
    ]
    if "slam" in m:
        s = m["slam"]
        error = "" if s["landmark_mean_m"] is None else f", mean error {s['landmark_mean_m']:.2f} m"
        lines.append(f"{s['landmarks_mapped']} landmarks mapped ({s['method']}){error}")
        for name in ("grid", "branch"):
            if name in m["map"]:
                f = m["map"][name]["all"]
                lines.append(
                    f"{name}: IoU {f['mean_iou']:.3f}, AP {f['mean_ap']:.3f}, accuracy "
                    f"{f['accuracy']:.3f} on {m['map'][name]['cells']} cells"
                )
        lines += [f"doubt: {doubt}" for doubt in s["doubts"]]
    return lines


def _told(progress: Progress, limit: float, tick: Tick) -> None:
    """The progress bar's line."""
    progress(
        f"{tick.coverage:4.0%} seen, {tick.found}/{tick.objects} found, {tick.factor:.0f}x",
        0.8 * min(tick.time / limit, 1.0),
    )
