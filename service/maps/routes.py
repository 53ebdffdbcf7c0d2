"""Maps over HTTP at ``/v1/maps``: make, list, remove, feed and watch them."""

from __future__ import annotations

import asyncio
import re
from collections.abc import AsyncIterator
from datetime import datetime
from hashlib import sha256
from secrets import token_hex
from typing import Annotated, Any, cast

from fastapi import APIRouter, Depends, Header, Query, Request, Response
from fastapi.sse import EventSourceResponse, ServerSentEvent

from symboslam.engine.landmarks import LandmarkMap
from symboslam.engine.readers.area import area_of, parse_box, parse_surveyed
from symboslam.engine.readers.crs import DEGREES, METRES, canonical, coordinate_system
from symboslam.engine.writers.content import Content
from symboslam.errors import InputError, UnknownNameError
from symboslam.service.auth import AdminOnly, CanIngest, CanQuery
from symboslam.service.dependencies import CurrentSettings
from symboslam.service.json_body import JSONRoute, unsupported
from symboslam.service.maps import openapi
from symboslam.service.maps.maps import Maps, base_of, empty_map
from symboslam.service.maps.models import BatchResult, MapInfo, MapRequest, Options
from symboslam.service.maps.observations import Observations, check_agent, read
from symboslam.service.maps.running import BatchConflictError, RunningMap
from symboslam.service.openapi import made
from symboslam.service.problems import Problem
from symboslam.service.requests import media_type, read_body
from symboslam.service.store._base import BusyError
from symboslam.service.vocabulary import GEOJSON, JSON, NDJSON

router = APIRouter(prefix="/v1/maps", tags=["Maps"], route_class=JSONRoute)
_KINDS = (NDJSON, GEOJSON, JSON, "application/ndjson", "application/jsonl")
_WHERE = re.compile(r"line (?P<line>\d+)(?: column (?P<column>\d+))?")


async def _maps(request: Request) -> Maps:
    return cast(Maps, request.app.state.maps)


CurrentMaps = Annotated[Maps, Depends(_maps)]


async def find_map(maps: CurrentMaps, map_id: str) -> RunningMap:
    """The map in the address.

    Raises:
        Problem: there is none.
    """
    try:
        return await maps.open(map_id)
    except UnknownNameError as error:
        raise Problem(404, "no-such-map", str(error)) from error


CurrentMap = Annotated[RunningMap, Depends(find_map)]


@router.post("", status_code=201, summary="Make a map", responses=made("The map."))
async def create_map(
    wanted: MapRequest, maps: CurrentMaps, response: Response, _: CanIngest
) -> MapInfo:
    """Make an empty map of an area, to be fed with observations."""
    try:
        area = await asyncio.to_thread(_area, wanted)
        options = await options_of(wanted, maps) | {"bbox": _box(wanted)}
        running = await maps.create(wanted.name, area, options)
    except InputError as error:
        raise Problem(422, "invalid-map", str(error)) from error
    response.headers["Location"] = f"/v1/maps/{running.record.id}"
    return await info(running, maps)


async def options_of(wanted: Options, maps: Maps) -> dict[str, Any]:
    """The options of a map as plain values.

    Raises:
        InputError: one of them is wrong.
    """
    cut = wanted.segmentation.model_dump(exclude={"method"}, exclude_none=True)
    return {
        "ontology": await maps.keep_ontology(wanted.ontology),
        "profile": wanted.profile,
        "scheme": wanted.scheme,
        "settings": wanted.settings.model_dump(exclude_none=True) | cut,
        "merge_radius": wanted.merge_radius,
        "reasons": wanted.reasons,
    }


def _area(wanted: MapRequest) -> LandmarkMap:
    system = coordinate_system(canonical(wanted.crs or DEGREES), "crs")
    box = parse_box(wanted.bbox, "bbox", system)
    surveyed = parse_surveyed(wanted.surveyed, system, "surveyed")
    found = area_of(box, system, given=True, surveyed=surveyed, source="bbox")
    return empty_map(found.frame, found.bbox, found.surveyed)


def _box(wanted: MapRequest) -> list[float] | None:
    """The box as it was sent, where that is in the coordinates of the map."""
    plain = canonical(wanted.crs or DEGREES) in (DEGREES, METRES)
    return wanted.bbox if plain else None


@router.get("", summary="All maps")
async def list_maps(
    maps: CurrentMaps,
    _: CanQuery,
    limit: Annotated[int, Query(ge=1, le=1000)] = 100,
    offset: Annotated[int, Query(ge=0, le=10**9)] = 0,
) -> list[MapInfo]:
    """All maps, the oldest first."""
    found = (await asyncio.to_thread(maps.records.maps))[offset : offset + limit]
    return [await info(await maps.open(identifier), maps) for identifier in found]


@router.get("/{map_id}", summary="A map")
async def get_map(_: CanQuery, running: CurrentMap, maps: CurrentMaps) -> MapInfo:
    """What is known of a map."""
    return await info(running, maps)


@router.delete("/{map_id}", status_code=204, summary="Remove a map")
async def delete_map(_: AdminOnly, map_id: str, running: CurrentMap, maps: CurrentMaps) -> None:
    """Remove a map, its landmarks and all that the store says of it."""
    await maps.remove(map_id)


@router.post("/{map_id}/observations", summary="Send observations", **openapi.OBSERVATIONS)
async def post_observations(
    request: Request,
    _: CanIngest,
    running: CurrentMap,
    settings: CurrentSettings,
    idempotency_key: Annotated[str | None, Header(min_length=1, max_length=200)] = None,
    agent: Annotated[str | None, Query(max_length=256)] = None,
    crs: Annotated[str | None, Query(max_length=200)] = None,
) -> BatchResult:
    """Merge a batch into the landmarks, and classify anew what it touches.

    The response comes when SPARQL queries see it. The same batch, by `Idempotency-Key` and agent,
    is taken once, however often it is sent; without a key each request is a batch of its own.
    """
    kind, _message = media_type(request.headers.get("content-type"))
    if kind not in _KINDS:
        raise unsupported(kind, (GEOJSON, NDJSON))
    kind = NDJSON if "nd" in kind or "lines" in kind or kind.endswith("jsonl") else GEOJSON
    body = await read_body(request, settings.max_body_bytes)
    batch = idempotency_key or token_hex(8)
    try:
        who = check_agent(agent)
        found = await asyncio.to_thread(_read, body, kind, running, who, crs)
    except InputError as error:
        raise Problem(422, "invalid-observations", str(error), **_place(error)) from error
    digest = sha256(f"{kind} {crs} ".encode() + body).hexdigest()
    try:
        result = await running.take(f"{who or ''}/{batch}", digest, found)
    except BatchConflictError as error:
        detail = f"another batch was taken under {batch!r} before; give each its own key"
        raise Problem(409, "batch-conflict", detail) from error
    except BusyError as error:
        raise Problem(503, "too-busy", str(error), headers={"Retry-After": "1"}) from error
    return BatchResult.model_validate({**result, "batch": batch})


def _place(error: InputError) -> dict[str, Any]:
    """Line and column of what is wrong, as far as they are known."""
    found = _WHERE.match(getattr(error, "where", ""))
    return {} if found is None else {name: int(n) for name, n in found.groupdict("").items() if n}


def _read(
    body: bytes, kind: str, running: RunningMap, agent: str | None, crs: str | None
) -> Observations:
    return read(body, kind, running.live.area, running.knowledge, agent=agent, crs=crs)


@router.get("/{map_id}/events", summary="Watch a map", response_class=EventSourceResponse)
async def watch(
    _: CanQuery,
    running: CurrentMap,
    last_event_id: Annotated[int | None, Header(ge=0)] = None,
) -> AsyncIterator[ServerSentEvent]:
    """Server-sent events: `change` with the segments that changed; `reset`: read the map anew.

    The id of an event is the map's revision; who comes back with `Last-Event-ID` misses nothing.
    """
    async for event in running.events.watch(last_event_id):
        yield ServerSentEvent(data=event.data, event=event.kind, id=str(event.revision))


async def info(running: RunningMap, maps: Maps) -> MapInfo:
    """A map, described."""
    record = running.record
    batches = await asyncio.to_thread(maps.records.batches, record.id)
    here = f"/v1/maps/{record.id}"
    names = (
        "landmarks", "segments", "observations", "increments", "robots", "overrides", "events",
        "export",
    )  # fmt: skip
    content = Content(running.live.described([]))
    frame = running.live.area.frame
    return MapInfo(
        id=record.id,
        name=record.name,
        iri=f"{base_of(record.id)}map",
        bbox=record.options.get("bbox") or list(content.bbox),
        crs=running.live.area.frame.name,
        origin=list(frame.origin) if frame.geographic else None,
        created=datetime.fromisoformat(record.created),
        changed=datetime.fromisoformat(record.changed),
        revision=record.revision,
        landmarks=len(running.live.table),
        batches=batches,
        left_out=dict(record.left_out),
        environments=content.environment_names,
        settings=running.live.config,
        links={name: f"{here}/{name}" for name in names},
    )
