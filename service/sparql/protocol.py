"""The SPARQL 1.1 Protocol at ``/sparql``: queries by GET and POST, updates by POST."""

from __future__ import annotations

import asyncio
from collections.abc import Awaitable, Callable
from typing import Any, TypeVar

from fastapi import APIRouter, Request, Response

from symboslam.service.auth import CanQuery, authorize, declare
from symboslam.service.dependencies import CurrentSettings, CurrentStore
from symboslam.service.limits import turn
from symboslam.service.problems import Problem
from symboslam.service.requests import (
    Parameters,
    absolute_iri,
    address,
    media_type,
    read_body,
    url_parameters,
)
from symboslam.service.responses import (
    etag,
    not_modified,
    problems_of_the_store,
    respond,
    unless_disconnected,
)
from symboslam.service.settings import Settings
from symboslam.service.sparql import negotiation, openapi, tokens
from symboslam.service.sparql.description import describe
from symboslam.service.store._base import Query, QueryError, Store
from symboslam.service.vocabulary import FORM, SPARQL_QUERY, SPARQL_UPDATE

router = APIRouter(tags=["SPARQL"])
T = TypeVar("T")
_LONG = 5_000
PATH = "/sparql"
_POSTED = f"{SPARQL_QUERY}, {SPARQL_UPDATE} or {FORM}"


@router.get(
    PATH, summary="Query, or describe the service", response_class=Response, **openapi.QUERY
)
@router.get(PATH + "/", include_in_schema=False)
@router.head(PATH, include_in_schema=False)
@router.head(PATH + "/", include_in_schema=False)
async def query_by_get(
    request: Request, settings: CurrentSettings, store: CurrentStore, _: CanQuery
) -> Response:
    """A query in the parameter ``query``; without one, the Service Description."""
    parameters = url_parameters(request)
    if "update" in parameters:
        detail = "an update is sent by POST, not in the address"
        raise Problem(400, "update-by-get", detail)
    text = parameters.find("query")
    if text is None:
        for name in ("default-graph-uri", "named-graph-uri"):
            parameters.iris(name)
        return await describe(request, settings, store)
    return await _query(request, settings, store, text, parameters)


@router.post(
    PATH, summary="Query or update", response_class=Response, dependencies=[declare("query")],
    **openapi.QUERY_OR_UPDATE,
)  # fmt: skip
@router.post(PATH + "/", include_in_schema=False)
async def query_or_update_by_post(
    request: Request, settings: CurrentSettings, store: CurrentStore
) -> Response:
    """A query or an update, as the body or as a form; an update needs the scope ``update``."""
    kind, _ = media_type(request.headers.get("content-type"))
    parameters = url_parameters(request)
    if kind == FORM:
        body = await read_body(request, settings.max_body_bytes)
        form = Parameters(body)
        parameters += form
        query, update = parameters.find("query"), parameters.find("update")
        if query is not None and update is not None:
            raise Problem(400, "query-and-update", "send either a query or an update")
        if "query" in form and query is not None:
            authorize(request, "query")
            return await _query(request, settings, store, query, parameters)
        if "update" in form and update is not None:
            authorize(request, "update")
            return await _update(request, settings, store, update, parameters)
        raise Problem(400, "nothing-asked", "the form has neither 'query' nor 'update'")
    if kind not in (SPARQL_QUERY, SPARQL_UPDATE):
        sent = f"the media type {kind}" if kind else "a body without a media type"
        headers = {"Accept-Post": f"{SPARQL_QUERY}, {SPARQL_UPDATE}, {FORM}"}
        detail = f"{sent} is not understood here; send {_POSTED}"
        raise Problem(415, "unsupported-media-type", detail, headers=headers)
    if "query" in parameters or "update" in parameters:
        detail = "there is a query or update both in the address and in the body"
        raise Problem(400, "repeated-parameter", detail)
    authorize(request, "update" if kind == SPARQL_UPDATE else "query")
    limit = settings.max_query_bytes if kind == SPARQL_QUERY else settings.max_body_bytes
    try:
        text = (await read_body(request, limit)).decode()
    except UnicodeDecodeError as error:
        raise Problem(400, "not-utf-8", "the body is not UTF-8 text") from error
    work = _query if kind == SPARQL_QUERY else _update
    return await work(request, settings, store, text, parameters)


async def _query(
    request: Request, settings: Settings, store: Store, text: str, parameters: Parameters
) -> Response:
    if len(text.encode("utf-8", "surrogatepass")) > settings.max_query_bytes:
        detail = f"the query is larger than {settings.max_query_bytes} bytes"
        raise Problem(413, "query-too-large", detail, limit=settings.max_query_bytes)
    for name in ("using-graph-uri", "using-named-graph-uri"):
        if name in parameters:
            raise Problem(400, "wrong-parameter", f"{name} is for updates, not for queries")
    if not settings.allow_service and await _look(tokens.asks_for, text, "SERVICE"):
        detail = (
            "SERVICE is switched off here: queries do not ask other endpoints"
            " (a prefix must not be called 'service' either)"
        )
        raise Problem(403, "service-refused", detail)
    accept = request.headers.get("accept")
    query = Query(
        text=text,
        base=_base(request, settings),
        formats=negotiation.formats(accept),
        default_graphs=parameters.iris("default-graph-uri"),
        named_graphs=parameters.iris("named-graph-uri"),
        has_dataset=await _look(tokens.has_dataset, text),
        gzip=negotiation.takes_gzip(request.headers.get("accept-encoding")),
    )
    tag = None
    if request.method != "POST" and await _look(tokens.is_stable, text):
        tag = etag(store.version, query)
        if same := not_modified(request, tag):
            return same
    with turn(request):
        with problems_of_the_store():
            answer = await unless_disconnected(request, _explained(text, store.query(query)))
    return respond(request, answer, tag)


async def _update(
    request: Request, settings: Settings, store: Store, text: str, parameters: Parameters
) -> Response:
    for name in ("default-graph-uri", "named-graph-uri"):
        if name in parameters:
            raise Problem(400, "wrong-parameter", f"{name} is for queries, not for updates")
    if not settings.allow_service and await _look(tokens.asks_for, text, "SERVICE"):
        raise Problem(403, "service-refused", "SERVICE is switched off here")
    if not settings.allow_load and await _look(tokens.asks_for, text, "LOAD"):
        detail = "LOAD is switched off here; send the document to /graphs?graph=IRI instead"
        raise Problem(403, "load-refused", detail)
    try:
        text = await _look(
            tokens.with_using,
            text,
            parameters.iris("using-graph-uri"),
            parameters.iris("using-named-graph-uri"),
        )
    except tokens.DatasetConflictError as error:
        detail = f"the dataset is given twice: by the request and by {error} in the update"
        raise Problem(400, "dataset-conflict", detail) from error
    base = _base(request, settings)
    with turn(request):
        with problems_of_the_store():
            await _explained(text, store.update(text, base))
    return Response(status_code=204)


async def _look(at: Callable[..., T], text: str, *more: Any) -> T:
    """Look at the words of a text; beside everything else, should it be long."""
    if len(text) < _LONG:
        return at(text, *more)
    return await asyncio.to_thread(at, text, *more)


async def _explained(text: str, work: Awaitable[T]) -> T:
    """Say so where a query does not parse because it forgets a prefix."""
    try:
        return await work
    except QueryError as error:
        if missing := await _look(tokens.undeclared_prefixes, text):
            problem = f"the prefix {missing[0]} is not declared"
            raise QueryError(problem, error.line, error.column) from error
        raise


def _base(request: Request, settings: Settings) -> str:
    """The base IRI, which is the endpoint's address (Protocol, 2.1.5)."""
    return absolute_iri(address(request, settings, PATH), "Host")
