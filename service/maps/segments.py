"""What a map holds, over HTTP: landmarks, segments, reasons, overrides, files."""

from __future__ import annotations

import asyncio
import io
import json
from datetime import UTC, datetime
from secrets import token_hex
from typing import Annotated, Any, Literal

from fastapi import APIRouter, Query, Request, Response

from symboslam.engine.live import LiveMap
from symboslam.engine.writers import FORMATS, WriteOptions
from symboslam.engine.writers.geojson import to_geojson
from symboslam.engine.writers.options import reasons_wanted
from symboslam.errors import InputError, UnknownNameError
from symboslam.service.auth import CanQuery, CanUpdate
from symboslam.service.json_body import JSONRoute
from symboslam.service.maps import openapi
from symboslam.service.maps.explaining import explained
from symboslam.service.maps.maps import base_of
from symboslam.service.maps.models import (
    ExplanationInfo,
    Length,
    OverrideInfo,
    OverrideRequest,
)
from symboslam.service.maps.records import Override
from symboslam.service.maps.routes import CurrentMap, CurrentMaps
from symboslam.service.maps.running import RunningMap
from symboslam.service.problems import Problem
from symboslam.service.vocabulary import GEOJSON

router = APIRouter(prefix="/v1/maps/{map_id}", tags=["Maps"], route_class=JSONRoute)
_TYPES = {
    "geojson": GEOJSON,
    "ttl": "text/turtle; charset=utf-8",
    "nq": "application/n-quads",
    "png": "image/png",
    "html": "text/html; charset=utf-8",
}


class GeoJSONResponse(Response):
    """GeoJSON as text."""

    media_type = GEOJSON


@router.get("/landmarks", summary="Landmarks", response_class=GeoJSONResponse, **openapi.COLLECTION)
async def get_landmarks(
    _: CanQuery,
    running: CurrentMap,
    feature: Annotated[str | None, Query(alias="class", max_length=200)] = None,
    limit: Annotated[int, Query(ge=1, le=1_000_000)] = 100_000,
    offset: Annotated[int, Query(ge=0, le=10**9)] = 0,
) -> Response:
    """Landmarks as points, in the form that `symboslam classify` reads."""
    wanted: int | None = None
    if feature is not None and (wanted := running.knowledge.index_of(feature)) is None:
        raise Problem(422, "invalid-parameter", f"class: there is no feature {feature!r}")
    text = await running.read(
        f"landmarks {wanted} {limit} {offset}", lambda live: _landmarks(live, wanted, limit, offset)
    )
    return GeoJSONResponse(text)


def _landmarks(live: LiveMap, feature: int | None, limit: int, offset: int) -> str:
    rows = live.table.rows()
    if feature is not None:
        rows = rows[live.table.feature(rows) == feature]
    chosen = rows[offset : offset + limit]
    found = [live.table[row] for row in chosen.tolist()]
    frame = live.area.frame
    xy = live.table.xy(chosen)
    digits = 8 if frame.geographic else 3
    first, second = (axis.round(digits).tolist() for axis in frame.from_metres(xy[:, 0], xy[:, 1]))
    names = live.knowledge.features
    features = [
        {
            "type": "Feature",
            "id": m.id,
            "geometry": {"type": "Point", "coordinates": [x, y]},
            "properties": {
                "class": names[m.feature].name,
                "confidence": m.confidence,
                "observations": m.count,
                **({"time": m.time} if m.time else {}),
                **({"agent": m.agent} if m.agent else {}),
            },
        }
        for m, x, y in zip(found, first, second, strict=True)
    ]
    head: dict[str, Any] = {"type": "FeatureCollection", "numberMatched": len(rows)}
    if not frame.geographic:
        head["crs_units"] = "m"
    return json.dumps({**head, "features": features}, ensure_ascii=False)


@router.get("/segments", summary="Segments", response_class=GeoJSONResponse, **openapi.COLLECTION)
async def get_segments(
    _: CanQuery,
    running: CurrentMap,
    maps: CurrentMaps,
    reasons: Annotated[int, Query(ge=0, le=100)] = 0,
) -> Response:
    """Segments as polygons with types and probabilities, and the overrides in force."""
    collection = await running.read(
        f"segments {reasons}",
        lambda live: to_geojson(live.environment_map() if reasons else live.segments(), reasons),
    )
    overrides = await _overrides(running, maps)
    features = []
    for found in collection["features"]:
        override = override_of(found["properties"]["segment_id"], overrides)
        if override is not None:
            told = _info(override, running).model_dump(mode="json")
            found = {**found, "properties": {**found["properties"], "override": told}}
        features.append(found)
    return GeoJSONResponse(json.dumps({**collection, "features": features}, ensure_ascii=False))


@router.get("/segments/{segment}/explanation", summary="Why?", responses={
    200: {"content": {"text/plain": {"schema": {"type": "string"}}}},
})  # fmt: skip
async def explain(
    request: Request,
    _: CanQuery,
    running: CurrentMap,
    maps: CurrentMaps,
    segment: str,
    length: Length = "paragraph",
    against: Annotated[str | None, Query(max_length=200)] = None,
    counterfactual: bool = False,
) -> ExplanationInfo:
    """Why a segment is what it is: in one line, a paragraph or in full; its reasons add up to P.

    With `counterfactual` also which small changes of landmarks would make it something else, or
    `against` if that is given. With `Accept: text/plain` the text alone.
    """
    found = await _segment(running, segment)
    names = [e.name for e in found.environments]
    if against is not None and against not in names:
        detail = f"against: no environment {against!r}; there are {', '.join(names)}"
        raise Problem(422, "invalid-parameter", detail)
    override = override_of(segment, await _overrides(running, maps))
    try:
        record = await asyncio.to_thread(explained, found, segment, length, against, counterfactual)
    except InputError as error:
        raise Problem(422, "invalid-parameter", f"against: {error}") from error
    shown = None if override is None else _info(override, running)
    text = record["text"]
    if shown is not None:
        stated = shown.environment or "unknown"
        because = f": {shown.reason}" if shown.reason else ""
        text = f"{shown.operator} says that it is {stated}{because}.\n{text}"
    if request.headers.get("accept", "").startswith("text/plain"):
        return Response(text + "\n", media_type="text/plain; charset=utf-8")  # type: ignore[return-value]
    segment = record.pop("segment_id")
    told = {**record, "segment": segment, "text": text, "override": shown}
    return ExplanationInfo.model_validate(told)


@router.get("/overrides", summary="Overrides")
async def list_overrides(_: CanQuery, running: CurrentMap, maps: CurrentMaps) -> list[OverrideInfo]:
    """All overrides, the oldest first; those taken back included."""
    found = await asyncio.to_thread(maps.records.overrides, running.record.id)
    return [_info(each, running) for each in found]


@router.put("/segments/{segment}/override", summary="Override a segment")
async def put_override(
    who: CanUpdate, running: CurrentMap, segment: str, wanted: OverrideRequest
) -> OverrideInfo:
    """State that a segment is of another type; what was worked out stays beside it.

    An earlier override of the same segment is taken back.
    """
    await _segment(running, segment)
    environments = {e.name: e.iri for e in running.knowledge.environments}
    if wanted.environment is not None and wanted.environment not in environments:
        detail = f"environment: there is no {wanted.environment!r}; there are "
        raise Problem(422, "invalid-override", detail + ", ".join(environments))
    override = Override(
        id=token_hex(6), segment=segment,
        environment=wanted.environment and environments[wanted.environment],
        operator=wanted.operator or who.name, reason=wanted.reason, made=_now(),
    )  # fmt: skip
    return _info((await running.override(segment, override))[-1], running)


@router.delete("/segments/{segment}/override", status_code=204, summary="Take an override back")
async def delete_override(_: CanUpdate, running: CurrentMap, segment: str) -> None:
    """Take the override of a segment back; it stays on record."""
    if not await running.override(segment):
        raise Problem(404, "no-such-override", f"no override of {segment[:80]!r} is in force")


@router.get("/export", summary="The map as a file", response_class=Response, **openapi.EXPORT)
async def export(
    _: CanQuery,
    running: CurrentMap,
    format: Literal["geojson", "ttl", "nq", "png", "html"] = "geojson",
    reasons: Annotated[int | None, Query(ge=0, le=100)] = None,
) -> Response:
    """The whole map in the formats of `symboslam classify`, as worked out; without overrides."""
    ended = datetime.fromisoformat(running.record.changed)
    base = base_of(running.record.id)

    def write(live: LiveMap) -> bytes:
        whole, stream = live.environment_map(), io.BytesIO()
        options = WriteOptions(reasons_wanted(reasons, len(whole)), None, base, ended)
        FORMATS[format].load()(whole, stream, options)
        return stream.getvalue()

    data = await running.read(f"export {format} {reasons}", write)
    name = f'attachment; filename="{running.record.id}.{format}"'
    return Response(data, media_type=_TYPES[format], headers={"Content-Disposition": name})


async def _segment(running: RunningMap, segment: str) -> Any:
    try:
        return await running.segment(segment)
    except UnknownNameError as error:
        raise Problem(404, "no-such-segment", str(error)) from error


async def _overrides(running: RunningMap, maps: CurrentMaps) -> list[Override]:
    """Those in force."""
    found = await asyncio.to_thread(maps.records.overrides, running.record.id)
    return [each for each in found if each.undone is None]


def override_of(segment: str, overrides: list[Override]) -> Override | None:
    """The override in force of a segment, or of a cell that it was split from.

    >>> override_of("1-1-0", [])
    """
    known = {each.segment: each for each in overrides}
    depth, row, column = map(int, segment.split("-"))
    while depth >= 0:
        if found := known.get(f"{depth}-{row}-{column}"):
            return found
        depth, row, column = depth - 1, row // 2, column // 2
    return None


def _info(override: Override, running: RunningMap) -> OverrideInfo:
    names = {e.iri: e.name for e in running.knowledge.environments}
    environment = override.environment
    return OverrideInfo(
        id=override.id,
        segment=override.segment,
        environment=None if environment is None else names.get(environment, environment),
        operator=override.operator,
        reason=override.reason,
        made=datetime.fromisoformat(override.made),
        undone=None if override.undone is None else datetime.fromisoformat(override.undone),
    )


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="milliseconds")
