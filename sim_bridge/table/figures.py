"""Figures: over all areas together, and whether what is asked for was reached."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from symboslam.sim_bridge.search.paper_areas import AREAS
from symboslam.sim_bridge.table import paper
from symboslam.sim_bridge.table.area_run import SEGMENTATIONS
from symboslam.sim_bridge.table.finished import Finished
from symboslam.sim_bridge.table.plan import MANY

if TYPE_CHECKING:
    from symboslam.engine.evaluation.metrics import Result
    from symboslam.reasoning.knowledge import Knowledge

CELLS = 24
"""Cells along each side of an area, as in the paper and the benchmark."""


def pooled(
    missions: Sequence[Finished], segmentation: str, knowledge: Knowledge | None = None
) -> Result | None:
    """The metrics over the cells of all areas together, as ``symboslam evaluate`` has them.

    Every cell that has a truth counts; unknown is wrong, and all of it where a map is missing.

    Args:
        missions: whose worlds have zones; others do not count.
        segmentation: ``grid`` or ``branch``.
        knowledge: the environments that there are.
    """
    from symboslam.engine.evaluation import evaluate_pairs

    pairs = [
        (one.folder / "record" / "zones.geojson", one.folder / f"{segmentation}.geojson")
        for one in missions
        if one.plan["mapped"] and one.world.zones
    ]
    if not pairs:
        return None
    return evaluate_pairs(pairs, cells=CELLS, knowledge=knowledge).result


def from_true_landmarks(
    missions: Sequence[Finished], segmentation: str, knowledge: Knowledge
) -> Result | None:
    """As ``pooled``, but of maps from all objects of the worlds at their true places.

    It tells what the classification alone leaves to be wished for: search, sensors and map building
    have no part in it.
    """
    from symboslam.engine.evaluation import evaluate_pairs
    from symboslam.engine.readers import read_landmarks
    from symboslam.sim_bridge.mission.survey import classify_survey

    pairs = []
    for one in missions:
        if one.plan["mapped"] and one.world.zones and one.world.objects:
            objects = read_landmarks(one.folder / "record" / "objects.geojson", knowledge)
            found = classify_survey(objects, knowledge, segmentation)
            pairs.append((one.folder / "record" / "zones.geojson", found))
    return evaluate_pairs(pairs, cells=CELLS, knowledge=knowledge).result if pairs else None


@dataclass(frozen=True)
class Verdict:
    """What is asked for, and what came out.

    Attributes:
        target: in words.
        asked: the figure that is asked for.
        ours: the one that came out; "" if it was not measured.
        met: whether that is enough; None if it was not measured.
    """

    target: str
    asked: str
    ours: str
    met: bool | None

    @property
    def text(self) -> str:
        """One word, or three."""
        return "not measured" if self.met is None else "met" if self.met else "**missed**"


def verdicts(missions: Sequence[Finished], together: dict[str, Result | None]) -> list[Verdict]:
    """What the issue asks for, one line each; what was not measured is said to be so.

    Args:
        missions: all that were flown.
        together: segmentation -> ``pooled`` of all of them.
    """
    by_name = {one.name: one for one in missions}
    complete = all(name in by_name for name in AREAS)
    found = []
    for label, asked, figure in (("AP", paper.AP, "mean_ap"), ("IoU", paper.IOU, "mean_iou")):
        for name in SEGMENTATIONS:
            result = together.get(name)
            value = None if result is None or not complete else getattr(result.all, figure)
            text = f"{label} of all six areas together, {name}"
            found.append(_above(text, value, asked, "above {:.3f}", "{:.3f}", strict=True))
    for name, area in AREAS.items():
        if area.km2 < paper.SMALL_KM2:
            error = _slam(by_name.get(name)).get("landmark_mean_m")
            text = f"mean landmark error, {name}"
            asked_m = f"below {paper.LANDMARK_M:g} m"
            if name in by_name and error is None:
                found.append(Verdict(text, asked_m, "no landmark", False))
            else:
                found.append(_below(text, error, paper.LANDMARK_M, asked_m, "{:.2f} m"))
    for name, area in AREAS.items():
        one = by_name.get(name)
        seen = None if one is None else one.coverage_at(60 * area.minutes)
        text = f"coverage in {area.minutes:g} min, {name}" + ("" if area.known else " \\*")
        found.append(_above(text, seen, area.coverage, "at least {:.1%}", "{:.1%}"))
    city, many = by_name.get("city"), by_name.get(MANY)
    factor = None if city is None else city.metrics["real_time_factor"]
    text = "City, 3 robots: simulated over real time"
    found.append(_above(text, factor, paper.CITY_FACTOR, "at least {:g}", "{:.1f}"))
    factor = None if many is None else many.metrics["real_time_factor"]
    text = "City, 10 robots: simulated over real time"
    found.append(_above(text, factor, 1.0, "above {:g}", "{:.1f}", strict=True))
    wall = wall_minutes([by_name[name] for name in AREAS]) if complete else None
    asked_m = f"at most {paper.WALL_MINUTES:g} min"
    found.append(
        _below("all six areas, wall time", wall, paper.WALL_MINUTES, asked_m, "{:.1f} min")
    )
    peak = max((one.run["peak_mb"] for one in missions), default=None) if complete else None
    asked_m = f"below {paper.MEMORY_MB:g} MB"
    found.append(_below("peak memory of a mission", peak, paper.MEMORY_MB, asked_m, "{:.0f} MB"))
    return found


def wall_minutes(missions: Sequence[Finished]) -> float:
    """Minutes of wall time in which at least one of these missions was under way."""
    total, until = 0.0, 0.0
    for begun, ended in sorted((one.run["begun"], one.run["ended"]) for one in missions):
        total += max(0.0, ended - max(begun, until))
        until = max(until, ended)
    return total / 60


def _slam(one: Finished | None) -> dict[str, float | None]:
    return {} if one is None else one.metrics.get("slam", {})


def _above(
    target: str, value: float | None, asked: float, words: str, form: str, strict: bool = False
) -> Verdict:
    """A figure that has to be at least, or above, another."""
    met = None if value is None else value > asked if strict else value >= asked
    return Verdict(target, words.format(asked), "" if value is None else form.format(value), met)


def _below(target: str, value: float | None, asked: float, words: str, form: str) -> Verdict:
    """A figure that has to be below another."""
    met = None if value is None else value < asked
    return Verdict(target, words, "" if value is None else form.format(value), met)
