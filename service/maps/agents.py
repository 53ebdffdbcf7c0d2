"""What robots send over HTTP, what is known of them, and what is made of it: landmarks to set."""

from __future__ import annotations

import asyncio
from hashlib import sha256
from secrets import token_hex
from typing import Annotated, Any, cast

from fastapi import APIRouter, Depends, Header, Query, Request, Response

from symboslam.engine.slam.increment import EdgeIncrement
from symboslam.errors import InputError
from symboslam.service.auth import CanIngest, CanQuery
from symboslam.service.dependencies import CurrentSettings
from symboslam.service.json_body import (
    JSONError,
    JSONRoute,
    RepeatedMemberError,
    parse_text,
    unsupported,
)
from symboslam.service.lifecycle import CurrentLifecycle
from symboslam.service.maps import openapi_agents
from symboslam.service.maps.mailbox import (
    IncrementAheadError,
    IncrementConflictError,
    Mailbox,
    any_of,
)
from symboslam.service.maps.models_agents import (
    IncrementsResult,
    LandmarksRequest,
    RunInfo,
    SettingResult,
)
from symboslam.service.maps.routes import CurrentMap
from symboslam.service.maps.running import BatchConflictError
from symboslam.service.maps.setting import Setting, read
from symboslam.service.problems import Problem
from symboslam.service.requests import media_type, read_body
from symboslam.service.responses import unless_disconnected
from symboslam.service.store._base import BusyError
from symboslam.service.vocabulary import JSON, NDJSON

router = APIRouter(prefix="/v1/maps/{map_id}", tags=["Robots"], route_class=JSONRoute)
_KINDS = (NDJSON, "application/ndjson", "application/jsonl")
_MALFORMED = {True: (400, "invalid-json"), False: (422, "invalid-increment")}
"""Whether a body is to be JSON -> status and name where it is none; as for observations."""


async def _mailbox(request: Request) -> Mailbox:
    return cast(Mailbox, request.app.state.mailbox)


CurrentMailbox = Annotated[Mailbox, Depends(_mailbox)]


class LinesResponse(Response):
    """NDJSON."""

    media_type = NDJSON


@router.post("/increments", summary="Send increments", **openapi_agents.INCREMENTS)
async def post_increments(
    request: Request,
    _: CanIngest,
    running: CurrentMap,
    mailbox: CurrentMailbox,
    settings: CurrentSettings,
    response: Response,
) -> IncrementsResult:
    """Leave increments of robots' pose graphs for a control agent: all of them or none.

    An increment is known by its robot, run and sequence. The same again is taken once; they may
    come in any order, but not numbered more than 1000 beyond the highest that has come (409). What
    was answered survives the death of the process.
    """
    kind, _message = media_type(request.headers.get("content-type"))
    if kind not in (JSON, *_KINDS):
        raise unsupported(kind, (JSON, NDJSON))
    body = await read_body(request, settings.max_body_bytes)
    found = await asyncio.to_thread(_increments, body, kind)
    try:
        count = await mailbox.post(running.record.id, found)
    except IncrementConflictError as error:
        raise Problem(409, "increment-conflict", str(error)) from error
    except IncrementAheadError as error:
        raise Problem(409, "increment-ahead", str(error)) from error
    response.status_code = 201 if count["new"] else 200
    return IncrementsResult(received=len(found), new=count["new"], known=count["known"])


def _increments(body: bytes, kind: str) -> list[EdgeIncrement]:
    """The increments of a body.

    Raises:
        Problem: one of them is none; names its line.
    """
    try:
        text = body.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = body[: error.start].count(10) + 1
        detail = f"body: line {line}: it is not UTF-8 text"
        raise Problem(*_MALFORMED[kind == JSON], detail, line=line) from error
    lines = enumerate(text.split("\n"), 1) if kind != JSON else [(1, text)]
    return [_increment(each, number, kind) for number, each in lines if each.strip()]


def _increment(text: str, number: int, kind: str) -> EdgeIncrement:
    line = None if kind == JSON else number
    where = "body" if kind == JSON else f"body: line {number}"
    try:
        value = parse_text(text)
        if not isinstance(value, dict):
            raise InputError("it is no JSON object")
        return EdgeIncrement.from_json(value)
    except JSONError as error:
        line = error.line if kind == JSON else number
        detail = f"body: line {line} column {error.column}: {error.problem}"
        raise Problem(*_MALFORMED[kind == JSON], detail, line=line, column=error.column) from error
    except RepeatedMemberError as error:
        raise Problem(422, "repeated-member", f"{where}: {error}; give it once") from error
    except InputError as error:
        raise Problem(422, "invalid-increment", f"{where}: {error}", line=line) from error


@router.get(
    "/increments",
    summary="Fetch increments",
    response_class=LinesResponse,
    **openapi_agents.LINES,
)
async def get_increments(
    request: Request,
    _: CanQuery,
    running: CurrentMap,
    mailbox: CurrentMailbox,
    lifecycle: CurrentLifecycle,
    after: Annotated[int, Query(ge=0, le=2**53)] = 0,
    limit: Annotated[int, Query(ge=1, le=10_000)] = 1000,
    wait: Annotated[float, Query(ge=0, le=25, description="Seconds.")] = 0.0,
) -> Response:
    """Increments in the order in which they came, each with its `number`.

    `after` is the number of the last one that is known. Where there is none after it, the answer
    waits so many seconds for one. There may be fewer than `limit` where they are large.
    """
    task = asyncio.current_task()
    assert task is not None
    lifecycle.streams.add(task)  # a service that stops does not wait for it
    try:
        found = mailbox.fetch(running.record.id, after, limit, wait)
        return LinesResponse("".join(await unless_disconnected(request, found)))
    finally:
        lifecycle.streams.discard(task)


@router.get("/robots", summary="Robots")
async def get_robots(_: CanQuery, running: CurrentMap, mailbox: CurrentMailbox) -> list[RunInfo]:
    """What has come from each run of each robot, what is missing, and since when it is silent."""
    found = await asyncio.to_thread(mailbox.runs, running.record.id)
    return [RunInfo.model_validate(any_of(each)) for each in found]


@router.patch("/landmarks", summary="Set landmarks", **openapi_agents.SETTING)
async def set_landmarks(
    wanted: LandmarksRequest,
    _: CanIngest,
    running: CurrentMap,
    idempotency_key: Annotated[str | None, Header(min_length=1, max_length=200)] = None,
) -> SettingResult:
    """Make landmarks exactly what they are said to be, remove others, and classify anew.

    Nothing is merged. The response comes when SPARQL queries see it. The same batch, by
    `Idempotency-Key`, is taken once; without a key each request is a batch of its own.
    """
    batch = idempotency_key or token_hex(8)
    try:
        found = await asyncio.to_thread(_setting, wanted, running)
    except InputError as error:
        raise Problem(422, "invalid-landmarks", str(error)) from error
    digest = sha256(b"set " + wanted.model_dump_json().encode()).hexdigest()
    try:
        result = await running.take(f"/{batch}", digest, found)
    except BatchConflictError as error:
        detail = f"another batch was taken under {batch!r} before; give each its own key"
        raise Problem(409, "batch-conflict", detail) from error
    except BusyError as error:
        raise Problem(503, "too-busy", str(error), headers={"Retry-After": "1"}) from error
    return SettingResult.model_validate({**result, "batch": batch})


def _setting(wanted: LandmarksRequest, running: Any) -> Setting:
    return read(wanted, running.live.area, running.knowledge)
