"""Setting: landmarks as somebody who keeps their map wants them, set exactly and not merged."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from typing import Any

from symboslam.engine.frame import Frame
from symboslam.engine.landmarks import LandmarkMap, ReadReport
from symboslam.engine.readers import geojson
from symboslam.engine.readers.build import place
from symboslam.engine.readers.checks import check_ids
from symboslam.engine.table import Landmark
from symboslam.errors import InputError
from symboslam.reasoning.knowledge import Knowledge
from symboslam.service.maps.models_agents import LandmarksRequest


@dataclass(frozen=True)
class Setting:
    """Landmarks to be set and to be removed.

    Attributes:
        landmarks: each as it is to be.
        removed: ids; those that are not there are gone already.
        report: what was left out; such a landmark is removed if it was there.
        received: how many there were to be set.
    """

    landmarks: tuple[Landmark, ...]
    removed: tuple[str, ...]
    report: ReadReport
    received: int


def read(wanted: LandmarksRequest, area: LandmarkMap, knowledge: Knowledge) -> Setting:
    """Landmarks in the frame of a map.

    Args:
        wanted: as it was sent.
        area: the map.
        knowledge: which features there are.

    Raises:
        InputError: a landmark is wrong, or an id is there twice; names its place.
    """
    names = [each.id for each in wanted.set]
    twice = [name for name, n in Counter([*names, *set(wanted.removed)]).items() if n > 1]
    if twice:
        raise InputError(f"the id {twice[0][:80]!r} is there twice; say once what it is to be")
    columns = geojson.from_object(
        {"type": "FeatureCollection", "crs_units": "m",
         "features": [_feature(each.model_dump(exclude_none=True)) for each in wanted.set]},
        "body", knowledge, lambda row: f"set.{row}",
    )  # fmt: skip
    check_ids(columns)
    found = place(columns, knowledge, replace(area, frame=Frame.metric()))
    times = [None] * len(found) if found.time is None else list(found.time)
    agents = [None] * len(found) if found.agent is None else list(found.agent)
    landmarks = []
    for i, row in enumerate(map(int, found.id)):
        confidence, count = float(found.confidence[i]), wanted.set[row].sightings
        landmarks.append(
            Landmark(
                names[row], int(found.feature[i]), float(found.x[i]), float(found.y[i]),
                confidence, times[i], agents[i], count, confidence * count,
            )
        )  # fmt: skip
    taken = {each.id for each in landmarks}
    gone = (*wanted.removed, *(name for name in names if name not in taken))
    return Setting(tuple(landmarks), gone, found.report, len(names))


def _feature(said: dict[str, Any]) -> dict[str, Any]:
    """A landmark as GeoJSON."""
    properties = {("class" if k == "class_" else k): v for k, v in said.items()}
    xy = properties.pop("xy")
    return {
        "type": "Feature", "id": properties.pop("id"),
        "geometry": {"type": "Point", "coordinates": xy}, "properties": properties,
    }  # fmt: skip
