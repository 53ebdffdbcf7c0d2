"""Observations as they are sent: NDJSON or GeoJSON -> landmarks in the frame of a map."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from datetime import UTC, datetime
from typing import Any

from symboslam.engine.landmarks import LandmarkMap, ReadReport
from symboslam.engine.readers import geojson
from symboslam.engine.readers.build import place
from symboslam.engine.readers.checks import LONGEST_ID, UNWRITABLE, check_ids
from symboslam.engine.table import Landmark
from symboslam.errors import InputError, LandmarkError
from symboslam.reasoning.knowledge import Knowledge
from symboslam.service.json_body import JSONError, RepeatedMemberError, parse_text, unique
from symboslam.service.vocabulary import NDJSON

_SHOWN = 5
"""Ids that a note names."""
_MEMBERS = ("class", "tags", "confidence", "time", "agent")


@dataclass(frozen=True)
class Observations:
    """A batch, ready to be merged.

    Attributes:
        landmarks: each observation as a landmark, and the id that its agent gave it, if any.
        report: what was taken and what was left out.
        received: how many there were in all.
    """

    landmarks: tuple[tuple[Landmark, str], ...]
    report: ReadReport
    received: int


def read(
    body: bytes,
    media_type: str,
    area: LandmarkMap,
    knowledge: Knowledge,
    *,
    agent: str | None = None,
    crs: str | None = None,
) -> Observations:
    """Read a batch.

    Args:
        body: as it was sent.
        media_type: ``GEOJSON`` or ``NDJSON``; anything else is taken for GeoJSON.
        area: the map that the observations are for.
        knowledge: which features there are.
        agent: who observed, where an observation does not say so.
        crs: coordinate system, where the body names none; the map's by default.

    Raises:
        InputError: it does not parse, or an observation is wrong; names its place.
    """
    try:
        text = body.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        where = f"line {body[: error.start].count(10) + 1}"
        raise LandmarkError("it is not UTF-8 text", source="body", where=where) from error
    document, place_of = _lines(text) if media_type == NDJSON else _document(text)
    columns = geojson.from_object(document, "body", knowledge, place_of)
    _check_features(document, place_of)
    names = [str(name or "") for name in columns.id or [""] * len(columns)]
    check_ids(columns)
    found = place(columns, knowledge, area, crs)
    now = datetime.now(UTC).isoformat(timespec="milliseconds")
    rows = [int(number) for number in found.id]
    times = [None] * len(rows) if found.time is None else list(found.time)
    agents = [None] * len(rows) if found.agent is None else list(found.agent)
    landmarks = tuple(
        (Landmark("", feature, x, y, confidence, time or now, who or agent), names[row])
        for row, feature, x, y, confidence, time, who in zip(
            rows, found.feature.tolist(), found.x.tolist(), found.y.tolist(),
            found.confidence.tolist(), times, agents, strict=True,
        )
    )  # fmt: skip
    return Observations(landmarks, found.report, len(columns))


def _document(text: str) -> tuple[object, geojson.Place]:
    """GeoJSON, and what the place of a feature is called."""
    try:
        return geojson.parse(text, "body", unique), geojson.place_of
    except RepeatedMemberError as error:
        raise LandmarkError(str(error), source="body") from error


def _lines(body: str) -> tuple[object, geojson.Place]:
    """NDJSON -> the GeoJSON that says the same, and what the place of a feature is called."""
    numbers, features = [], []
    for number, line in enumerate(body.split("\n"), 1):
        if line.strip():
            numbers.append(number)
            features.append(_feature(line, number))
    return {"type": "FeatureCollection", "features": features}, lambda row: f"line {numbers[row]}"


def _feature(line: str, number: int) -> dict[str, Any]:
    try:
        value = parse_text(line)
    except RepeatedMemberError as error:
        raise LandmarkError(str(error), source="body", where=f"line {number}") from error
    except JSONError as error:
        where = f"line {number} column {error.column}"
        raise LandmarkError(error.problem, source="body", where=where) from error
    if not isinstance(value, dict):
        problem = "it is no JSON object"
        raise LandmarkError(problem, source="body", where=f"line {number}")
    if value.get("type") == "Feature":
        return value
    unknown = sorted(set(value) - {*_MEMBERS, "id", "coordinates"})
    if unknown:
        known = ", ".join(["coordinates", "id", *_MEMBERS])
        problem = f"it has a member {unknown[0][:40]!r}; there are {known}"
        raise LandmarkError(problem, source="body", where=f"line {number}")
    return {
        "type": "Feature",
        "id": value.get("id"),
        "geometry": {"type": "Point", "coordinates": value.get("coordinates")},
        "properties": {name: value[name] for name in _MEMBERS if name in value},
    }


def _check_features(document: Any, place_of: geojson.Place) -> None:
    """What files may lack, or have as a number, has to be right here; it was read already.

    Raises:
        LandmarkError: a feature is not called one, has no properties (RFC 7946, 3.2), or its agent
            is no text; names the first.
    """
    for row, feature in enumerate(document["features"]):
        agent = (feature.get("properties") or {}).get("agent")
        if feature.get("type") != "Feature":
            problem = f"its type is {str(feature.get('type'))[:60]!r}, not 'Feature'"
        elif feature.get("properties") is None:
            problem = "it has no properties"
        elif agent is not None and not isinstance(agent, str):
            problem = f"its agent is {str(agent)[:60]}, not text"
        else:
            continue
        raise LandmarkError(problem, source="body", where=place_of(row))


def notes_on_ids(landmarks: Iterable[tuple[Landmark, str]], radius: float) -> list[str]:
    """What is odd about the ids of a batch.

    Args:
        landmarks: as in `Observations`.
        radius: in metres; the same id twice is of one place within it.

    >>> notes_on_ids([(Landmark("", 0, 1.0, 2.0, 1.0), "h1")], 5.0)
    ['an id does not say which landmark it is without an agent; name the agent of h1']
    """
    first: dict[tuple[str, str], Landmark] = {}
    unowned: dict[str, None] = {}
    apart: dict[str, None] = {}
    for seen, name in landmarks:
        if not name:
            continue
        if not seen.agent:
            unowned[name] = None
            continue
        earlier = first.setdefault((seen.agent, name), seen)
        distance = math.hypot(seen.x - earlier.x, seen.y - earlier.y)
        if earlier.feature != seen.feature or distance > radius:
            apart[f"{name} of {seen.agent}"] = None
    notes = []
    if unowned:
        problem = "an id does not say which landmark it is without an agent; name the agent of"
        notes.append(f"{problem} {_listed(unowned)}")
    if apart:
        problem = f"different classes, or places farther than {radius:g} m apart"
        notes.append(f"in one batch there are {problem}, under the same id: {_listed(apart)}")
    return notes


def _listed(names: Mapping[str, None]) -> str:
    """The first of many ids, and how many more there are."""
    more = len(names) - _SHOWN
    return ", ".join(list(names)[:_SHOWN]) + (f" and {more} more" if more > 0 else "")


def check_agent(name: str | None) -> str | None:
    """The name of an agent, checked.

    Raises:
        InputError: it is too long or is no text.
    """
    if name and (len(name) > LONGEST_ID or UNWRITABLE.search(name)):
        raise InputError(f"the agent {name[:80]!r} is longer than {LONGEST_ID} or is no text")
    return name or None
