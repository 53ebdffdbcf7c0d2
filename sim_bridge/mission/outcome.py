"""Outcome: from the logs of a mission to landmarks, the environment map and all figures."""

from __future__ import annotations

import json
import tempfile
import time as clock
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from symboslam.engine.environment_map import EnvironmentMap
from symboslam.engine.evaluation import Evaluation, evaluate
from symboslam.engine.readers import read_landmarks
from symboslam.engine.slam.comparison import blind
from symboslam.engine.slam.log import Mission as SlamMission
from symboslam.engine.slam.metrics import evaluate_slam
from symboslam.engine.slam.slam_map import SlamMap
from symboslam.engine.slam.writers import write_slam_map
from symboslam.errors import InputError
from symboslam.reasoning.knowledge import Knowledge
from symboslam.sim_bridge.mission.mission import Outcome
from symboslam.sim_bridge.mission.survey import classify_survey
from symboslam.sim_bridge.mission.team import MAPPING, Team
from symboslam.sim_bridge.worlds.truth import zones_geojson
from symboslam.sim_bridge.worlds.world import World

Progress = Callable[[str, float], None]

SLAMS = ("ours", "paper", "oracle")
CELLS = 24
"""Cells along each side, on which the map is compared with the zones."""


@dataclass(frozen=True)
class Result:
    """All that came of a mission.

    Attributes:
        slam_map: where robots went and what they saw.
        environment_map: what kind of place each part is; None if nothing was seen.
        metrics: all figures; docs/simulation.md says what each is.
    """

    slam_map: SlamMap
    environment_map: EnvironmentMap | None
    metrics: dict[str, Any]


def build_map(mission: SlamMission, method: str, progress: Progress) -> SlamMap:
    """Landmarks and paths of a mission.

    Args:
        mission: the logs; only ``oracle`` looks at the truth.
        method: ``ours``, ``paper`` (the paper's rule without its oracle) or ``oracle`` (with it).
        progress: is told what is done.

    Raises:
        InputError: there is no such method.
        MissingExtraError: the extra ``slam`` is not installed.
    """
    from symboslam.engine.slam.paper import paper_map

    if method == "ours":
        from symboslam.engine.slam.estimate import estimate

        return estimate(blind(mission), MAPPING, progress)
    if method not in SLAMS:
        raise InputError(f"no way of map building {method!r}; there are: {', '.join(SLAMS)}")
    return paper_map(mission, oracle=method == "oracle")


def conclude(
    team: Team,
    outcome: Outcome,
    knowledge: Knowledge,
    *,
    slam: str = "ours",
    segmentation: str = "grid",
    progress: Progress | None = None,
    folder: Path | None = None,
) -> Result:
    """Map, classify and measure a mission.

    Args:
        team: its robots.
        outcome: how it ended.
        knowledge: what landmarks indicate.
        slam: see ``build_map``.
        segmentation: ``grid`` or ``branch``, of the map that is kept; both are measured.
        progress: is told what is done.
        folder: where landmarks.geojson goes; None for nowhere.
    """
    tell = progress or (lambda stage, share: None)
    mission = team.slam_mission()
    begun = clock.perf_counter()
    slam_map = build_map(mission, slam, lambda stage, share: tell(stage, 0.6 * share))
    slam_seconds = clock.perf_counter() - begun
    tell("classifying", 0.6)
    begun = clock.perf_counter()
    document = landmarks_of(slam_map, mission, team.world, team.settings.reach, folder)
    kept: EnvironmentMap | None = None
    scores: dict[str, Any] = {}
    for name in ("grid", "branch"):
        if not document["features"]:
            break
        landmarks = read_landmarks(document, knowledge)
        found = classify_survey(landmarks, knowledge, name)
        kept = found if name == segmentation else kept
        if team.world.zones:
            scores[name] = figures(
                evaluate(zones_geojson(team.world), found, cells=CELLS, knowledge=knowledge)
            )
    metrics = mission_figures(team, outcome)
    metrics["slam"] = {
        "method": slam,
        "seconds": round(slam_seconds, 3),
        "doubts": list(slam_map.doubts),
        **evaluate_slam(slam_map, mission).to_json(),
    }
    metrics["map"] = {
        "segmentation": segmentation,
        "cells": CELLS,
        "seconds": round(clock.perf_counter() - begun, 3),
        **scores,
    }
    return Result(slam_map, kept, metrics)


def landmarks_of(
    slam_map: SlamMap, mission: SlamMission, world: World, reach: float, folder: Path | None
) -> dict[str, Any]:
    """The landmarks as GeoJSON; the area is the world's, surveyed is what lies within reach."""
    import shapely

    e = world.extent
    with tempfile.TemporaryDirectory() as temporary:
        path = Path(temporary) / "landmarks.geojson"
        write_slam_map(path, slam_map, mission)
        document: dict[str, Any] = json.loads(path.read_text())
    document["name"] = world.name
    document["bbox"] = [e.min_x, e.min_y, e.max_x, e.max_y]
    lines = [
        shapely.LineString(path.pose[[*range(len(path.pose)), -1], :2]).simplify(1.0)
        for path in slam_map.trajectories.values()
        if len(path.pose)
    ]
    swept = shapely.union_all([line.buffer(reach, 4) for line in lines])
    swept = swept.intersection(shapely.box(*document["bbox"]))
    if not swept.is_empty:
        document["surveyed"] = json.loads(shapely.to_geojson(shapely.set_precision(swept, 0.01)))
    if folder is not None:
        from symboslam.engine.writers.atomic import atomic_file

        with atomic_file(folder / "landmarks.geojson") as stream:
            stream.write((json.dumps(document) + "\n").encode())
    return document


def figures(evaluation: Evaluation) -> dict[str, Any]:
    """How well the map agrees with the zones, over all cells and over those that it labels."""
    result = evaluation.result
    found: dict[str, Any] = {"cells": result.cells, "coverage": result.coverage}
    for name, scores in (("all", result.all), ("labelled", result.labelled)):
        found[name] = scores and {
            "accuracy": scores.accuracy,
            "kappa": scores.kappa,
            "macro_f1": scores.macro_f1,
            "mean_iou": scores.mean_iou,
            "mean_ap": scores.mean_ap,
        }
    return found


def mission_figures(team: Team, outcome: Outcome) -> dict[str, Any]:
    """What can be said without any map: coverage, dispersion, times, trouble."""
    last, extent = outcome.last, team.world.extent
    diagonal = float(np.hypot(extent.width, extent.height))
    spread = float(np.mean([t.dispersion for t in outcome.ticks])) if outcome.ticks else 0.0
    everything = last.found == last.objects
    return {
        "world": team.world.name,
        "area_km2": extent.area_km2,
        "robots": team.settings.robots,
        "ended": outcome.ended,
        "time_s": last.time,
        "wall_s": round(outcome.seconds, 3),
        "processor_s": round(outcome.processor, 3),
        "real_time_factor": last.time / max(outcome.seconds, 1e-9),
        "coverage": last.coverage,
        "coverage_formula": last.formula,
        "dispersion_m": spread,
        "dispersion_normalised": spread / diagonal,
        "objects": last.objects,
        "objects_found": last.found,
        "time_all_found_s": max(outcome.found.values(), default=0.0) if everything else None,
        "pictures": sum(agent.camera.drawn for agent in team.agents),
        "pictures_skipped": sum(agent.camera.skipped for agent in team.agents),
        "bumps": sum(agent.bumps for agent in team.agents),
        "given_up": [agent.name for agent in team.agents if agent.lost],
        "notes": team.notes,
    }
