"""The SPARQL 1.1 Graph Store HTTP Protocol at ``/graphs``.

A graph is named by ``?graph=IRI``, the default graph by ``?default``; an address below ``/graphs/``
is the name of a graph itself. The default graph is the one without a name, never the union.
"""

from __future__ import annotations

import asyncio
from email.message import Message
from email.parser import BytesParser
from email.policy import HTTP
from uuid import uuid4

from fastapi import APIRouter, Request, Response

from symboslam.engine.writers.vocabulary import MAPS
from symboslam.service.auth import CanQuery, CanUpdate
from symboslam.service.dependencies import CurrentSettings, CurrentStore
from symboslam.service.limits import turn
from symboslam.service.problems import Problem
from symboslam.service.requests import (
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
from symboslam.service.sparql import openapi
from symboslam.service.sparql.negotiation import choose, takes_gzip
from symboslam.service.store._base import Document
from symboslam.service.vocabulary import MULTIPART, TRIPLES, UPLOADS

router = APIRouter(tags=["Graphs"])
PATH = "/graphs"
_BELOW = PATH + "/{path:path}"
_CONFLICT = {"graph", "default"}


@router.get(PATH, summary="A graph", response_class=Response, **openapi.GET_GRAPH)
@router.get(_BELOW, include_in_schema=False)
@router.head(PATH, include_in_schema=False)
@router.head(_BELOW, include_in_schema=False)
async def get_graph(
    request: Request, settings: CurrentSettings, store: CurrentStore, _: CanQuery
) -> Response:
    """A whole graph."""
    graph = _target(request, settings)
    kind = choose(request.headers.get("accept"), TRIPLES)
    if kind is None:
        detail = f"graphs are written as {', '.join(TRIPLES)}"
        raise Problem(406, "not-acceptable", detail)
    gzip = takes_gzip(request.headers.get("accept-encoding"))
    tag = etag(store.version, graph, kind, gzip)
    with problems_of_the_store():
        if await store.has_graph(graph) and (same := not_modified(request, tag)):
            return same
        with turn(request):
            answer = await unless_disconnected(request, store.read_graph(graph, kind, gzip))
    return respond(request, answer, tag)


@router.put(
    PATH, summary="Replace or create a graph", status_code=204, response_class=Response,
    **openapi.PUT_GRAPH,
)  # fmt: skip
@router.put(_BELOW, include_in_schema=False)
async def put_graph(
    request: Request, settings: CurrentSettings, store: CurrentStore, _: CanUpdate
) -> Response:
    """Make a graph hold what is sent, and nothing else."""
    graph = await _to_write(request, settings)
    documents = await _documents(request, settings, graph)
    with problems_of_the_store():
        new = await store.replace_graph(graph, documents)
    return Response(status_code=201 if new else 204)


@router.post(
    PATH, summary="Add to a graph, or create one", status_code=204, response_class=Response,
    **openapi.POST_GRAPH,
)  # fmt: skip
@router.post(_BELOW, include_in_schema=False)
async def post_graph(
    request: Request, settings: CurrentSettings, store: CurrentStore, _: CanUpdate
) -> Response:
    """Add what is sent to a graph; to a new one, whose name the response says, if none is named."""
    headers = {}
    if _is_store(request) and not _CONFLICT & set(_names(request)):
        graph: str | None = address(request, settings, f"{PATH}/{uuid4()}")
        headers["Location"] = str(graph)
    else:
        graph = await _to_write(request, settings)
    documents = await _documents(request, settings, graph)
    with problems_of_the_store():
        new = await store.add_to_graph(graph, documents)
    return Response(status_code=201 if new else 204, headers=headers)


@router.delete(
    PATH, summary="Delete a graph", status_code=204, response_class=Response,
    **openapi.DELETE_GRAPH,
)  # fmt: skip
@router.delete(_BELOW, include_in_schema=False)
async def delete_graph(
    request: Request, settings: CurrentSettings, store: CurrentStore, _: CanUpdate
) -> Response:
    """Remove a graph, or empty the default graph."""
    graph = await _to_write(request, settings)
    with problems_of_the_store():
        await store.drop_graph(graph)
    return Response(status_code=204)


def _is_store(request: Request) -> bool:
    return str(request.scope["path"]).rstrip("/").endswith(PATH)


def _names(request: Request) -> list[str]:
    parameters = url_parameters(request)
    return [name for name in ("graph", "default") if name in parameters]


def _target(request: Request, settings: Settings) -> str | None:
    """The graph that a request is about; None is the default graph.

    Raises:
        Problem: none is named, or more than one.
    """
    parameters = url_parameters(request)
    names = _names(request)
    if not _is_store(request):
        if names:
            detail = "the graph is named both by the path and by a parameter"
            raise Problem(400, "graph-named-twice", detail)
        path = bytes(request.scope["raw_path"]).partition(b"?")[0].decode("ascii", "replace")
        return absolute_iri(address(request, settings, path), "path")
    if names == ["default"]:
        if parameters.find("default"):
            raise Problem(400, "wrong-parameter", "'default' takes no value", parameter="default")
        return None
    if names == ["graph"]:
        return absolute_iri(parameters.find("graph") or "", "graph")
    detail = "name one graph, by ?graph=IRI, by ?default or by the path"
    raise Problem(400, "graph-named-twice" if names else "no-graph-named", detail)


async def _to_write(request: Request, settings: Settings) -> str | None:
    """The graph that a request wants to change.

    Raises:
        Problem: it says what a map is, which the service itself keeps true.
    """
    graph = _target(request, settings)
    if graph is not None and graph.startswith(MAPS):
        identifier = graph.removeprefix(MAPS).partition("/")[0]
        if await asyncio.to_thread(request.app.state.maps.records.map, identifier):
            detail = f"<{graph}> says what map {identifier} is; change the map at /v1/maps"
            raise Problem(409, "graph-of-a-map", detail)
    return graph


async def _documents(request: Request, settings: Settings, graph: str | None) -> list[Document]:
    """The graph or graphs in the body of a request.

    Raises:
        Problem: of a media type that is not understood, or too large.
    """
    kind, message = media_type(request.headers.get("content-type"))
    _check_kind(kind, allow_parts=request.method == "POST")
    data = await read_body(request, settings.max_body_bytes)
    base = graph or absolute_iri(address(request, settings, PATH), "Host")
    if kind != MULTIPART:
        return [Document(kind, data, base)]
    documents = []
    for part in _parts(message, data):
        kind, _ = media_type(part.get("content-type"))
        _check_kind(kind, allow_parts=False)
        content = part.get_payload(decode=True)
        documents.append(Document(kind, content if isinstance(content, bytes) else b"", base))
    return documents


def _check_kind(kind: str, allow_parts: bool) -> None:
    if kind in UPLOADS or (allow_parts and kind == MULTIPART):
        return
    sent = f"the media type {kind}" if kind else "a body without a media type"
    detail = f"{sent} is not understood here; send {', '.join(UPLOADS)}"
    raise Problem(415, "unsupported-media-type", detail)


def _parts(header: Message, data: bytes) -> list[Message]:
    """The parts of a multipart body.

    Raises:
        Problem: it has none.
    """
    head = f"Content-Type: {header['Content-Type']}\r\n\r\n".encode("latin-1", "replace")
    whole = BytesParser(policy=HTTP).parsebytes(head + data)
    parts: list[Message] = list(whole.iter_parts()) if whole.is_multipart() else []
    if not parts or whole.defects:
        raise Problem(400, "malformed-multipart", "the body is not what its boundary promises")
    return parts
