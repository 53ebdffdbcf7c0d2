"""AreaRun: one mission of the table from its world to a folder with all that the page needs.

The folder holds ``record`` (docs/simulation.md), and, written at the end, ``grid.geojson`` and
``branch.geojson`` (the environment maps), ``paths.csv`` (where robots went, by the map),
``seen.csv`` (when each landmark was first in view), ``errors.csv`` (errors along the mission) and
last ``metrics.json``: the figures, and under ``run`` the plan, the machine, times and memory. So
a folder with ``metrics.json`` is finished.
"""

from __future__ import annotations

import json
import os
import platform
import resource
import shutil
import sys
import time as clock
from collections.abc import Callable, Iterable
from dataclasses import asdict, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from symboslam.errors import InputError, OutputError
from symboslam.sim_bridge.table.plan import Plan

if TYPE_CHECKING:
    from symboslam.engine.slam.log import Mission
    from symboslam.engine.slam.slam_map import SlamMap
    from symboslam.reasoning.knowledge import Knowledge
    from symboslam.sim_bridge.mission.outcome import Result
    from symboslam.sim_bridge.table.along import BeliefRecorder

Tell = Callable[[str, float], None]
FAILURE = "error.txt"
"""Where a mission that failed says why: a line, and where in the program it was."""
SEGMENTATIONS = ("grid", "branch")


def is_finished(plan: Plan, folder: Path) -> bool:
    """Whether a mission was flown already and lies in its folder.

    Raises:
        OutputError: the folder holds one that was flown by another plan.
        InputError: it cannot be read.
    """
    path = folder / plan.name / "metrics.json"
    if not path.is_file():
        return False
    try:
        flown = json.loads(path.read_text(encoding="utf-8"))["run"]["plan"]
    except (ValueError, KeyError, TypeError, OSError) as error:
        raise InputError(f"{path}: not written by symboslam sim table ({error})") from None
    wanted = json.loads(json.dumps(asdict(plan)))
    other = [f"{k} {flown.get(k)}, not {v}" for k, v in wanted.items() if flown.get(k) != v]
    if other:
        raise OutputError(
            f"{folder / plan.name} was run with other settings ({', '.join(other)}): give a new "
            "folder, or remove it"
        )
    return True


def run_area(plan: Plan, folder: Path, tell: Tell) -> None:
    """Fly a mission and write its folder, which is replaced if it is not finished.

    Args:
        plan: the mission.
        folder: of the table; the mission's is one below.
        tell: is told what is done.

    Raises:
        InputError: there is no such world or search, or too few starts.
        OutputError: the folder cannot be written.
    """
    from symboslam.reasoning.knowledge import Knowledge
    from symboslam.sim_bridge.bridge.settings import BridgeSettings
    from symboslam.sim_bridge.mission.mission import fly
    from symboslam.sim_bridge.mission.outcome import conclude, mission_figures
    from symboslam.sim_bridge.mission.team import MissionSettings, assemble
    from symboslam.sim_bridge.search.registry import search_of
    from symboslam.sim_bridge.table.along import BeliefRecorder
    from symboslam.sim_bridge.worlds.generator import get_world

    begun, load = clock.time(), os.getloadavg()[0]
    here = folder / plan.name
    shutil.rmtree(here, ignore_errors=True)
    world, odd = get_world(plan.world, plan.world_seed)
    settings = MissionSettings(
        robots=plan.robots, time_limit=60 * plan.minutes, seed=plan.seed, reach=plan.reach,
        bridge=replace(BridgeSettings(), speed=plan.speed),
    )  # fmt: skip
    knowledge = Knowledge.load()
    recorder = BeliefRecorder(here / "record", asdict(plan))
    flying = 0.6 if plan.mapped else 1.0
    team = assemble(world, settings, knowledge)
    try:
        ended = fly(
            team,
            search_of(plan.search, team.area(), plan.seed),
            recorder,
            lambda tick: tell(
                f"{tick.coverage:4.0%} seen, {tick.found}/{tick.objects} found, {tick.factor:.0f}x",
                flying * min(tick.time / settings.time_limit, 1.0),
            ),
        )
        if plan.mapped:
            result = conclude(
                team, ended, knowledge, slam=plan.slam, folder=recorder.folder,
                progress=lambda stage, share: tell(stage, flying + (1 - flying) * share),
            )  # fmt: skip
            metrics = result.metrics
            _write_maps(result, here, knowledge)
            _write_tables(result.slam_map, team.slam_mission(), recorder, here)
        else:
            metrics = mission_figures(team, ended)
    finally:
        team.close()
        recorder.close()
    metrics["notes"] = [*odd, *metrics["notes"]]
    recorder.write_json("metrics.json", metrics)
    peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    metrics["run"] = {
        "plan": asdict(plan),
        "begun": begun,
        "ended": clock.time(),
        "peak_mb": peak / (1e6 if sys.platform == "darwin" else 1024),
        "load": load,
        "processors": os.cpu_count(),
        "machine": f"{platform.system()} {platform.machine()}, Python {platform.python_version()}",
    }
    _write(here / "metrics.json", json.dumps(metrics, indent=2) + "\n")


def _write_maps(result: Result, here: Path, knowledge: Knowledge) -> None:
    """Both environment maps; empty ones, unknown everywhere, where nothing was seen."""
    from symboslam.engine.readers import read_landmarks
    from symboslam.engine.writers import write_map
    from symboslam.sim_bridge.mission.survey import classify_survey

    document = json.loads((here / "record" / "landmarks.geojson").read_text(encoding="utf-8"))
    for name in SEGMENTATIONS:
        target, found = here / f"{name}.geojson", result.environment_map
        if found is None:
            _write(target, json.dumps(document | {"features": []}) + "\n")
            continue
        if name != "grid":
            landmarks = read_landmarks(document, knowledge)
            found = classify_survey(landmarks, knowledge, name)
        write_map(found, target)


def _write_tables(
    slam_map: SlamMap, mission: Mission, recorder: BeliefRecorder, here: Path
) -> None:
    """Paths, times of landmarks, and errors along the mission."""
    from symboslam.sim_bridge.table.along import COLUMNS, errors_along, first_seen

    paths = (
        f"{name},{time:g},{pose[0]:.2f},{pose[1]:.2f}"
        for name, path in slam_map.trajectories.items()
        for time, pose in zip(path.time.tolist(), path.pose.tolist(), strict=True)
    )
    _write_rows(here / "paths.csv", "robot,time,x,y", paths)
    times = zip(slam_map.landmarks.id, first_seen(slam_map, mission), strict=True)
    _write_rows(here / "seen.csv", "landmark,time", (f"{name},{time:g}" for name, time in times))
    rows = errors_along(slam_map, mission, recorder.beliefs).tolist()
    lines = (f"{row[0]:g}," + ",".join(f"{value:.4f}" for value in row[1:]) for row in rows)
    _write_rows(here / "errors.csv", ",".join(COLUMNS), lines)


def _write_rows(target: Path, head: str, rows: Iterable[str]) -> None:
    _write(target, "\n".join([head, *rows]) + "\n")


def _write(target: Path, text: str) -> None:
    from symboslam.engine.writers.atomic import atomic_file

    with atomic_file(target) as stream:
        stream.write(text.encode())


def note_failure(here: Path, text: str) -> None:
    """Leave word of a failure in a mission's folder, as far as it can be written."""
    try:
        here.mkdir(parents=True, exist_ok=True)
        (here / FAILURE).write_text(text, encoding="utf-8")
    except OSError:
        return


def metrics_of(folder: Path) -> dict[str, Any]:
    """What a finished mission's ``metrics.json`` holds.

    Raises:
        InputError: it cannot be read.
    """
    path = folder / "metrics.json"
    try:
        found: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
        found["run"]["plan"]["name"]
    except (ValueError, KeyError, TypeError, OSError) as error:
        raise InputError(f"{path}: not written by symboslam sim table ({error})") from None
    return found
