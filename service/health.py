"""Is the service alive, and can it answer? And a page that says where everything is."""

from __future__ import annotations

from fastapi import APIRouter, Response
from fastapi.responses import HTMLResponse, JSONResponse

from symboslam.service.dependencies import CurrentStore
from symboslam.service.lifecycle import CurrentLifecycle
from symboslam.service.problems import Problem

router = APIRouter(tags=["Health"])

_PAGE = """<!doctype html>
<html lang="en"><meta charset="utf-8"><title>SymboSLAM</title>
<meta name="viewport" content="width=device-width"><link rel="stylesheet" href="query/query.css">
<header><h1>SymboSLAM</h1><p>What kind of place each part of a map is, and why</p></header>
<main><ul>
<li><a href="query">query</a>: a page to ask queries on, with examples
<li><a href="sparql">sparql</a>: SPARQL 1.1 queries and updates; without a query, what it can do
<li>graphs?graph=IRI: whole graphs, for example
<a href="graphs?graph=https%3A%2F%2Fw3id.org%2Fsymboslam%2Fgraph%2Fontology">the ontology</a>
<li><a href="v1/maps">v1/maps</a>: maps, their landmarks, segments, reasons and overrides
<li><a href="openapi.json">openapi.json</a>: all of it, for programs
</ul></main>
</html>
"""


@router.get("/", include_in_schema=False)
async def front_page() -> HTMLResponse:
    """Where everything is."""
    return HTMLResponse(_PAGE)


@router.get("/healthz", summary="Alive?")
async def healthz() -> JSONResponse:
    """The process answers."""
    return JSONResponse({"status": "alive"})


@router.get("/readyz", summary="Ready for queries?")
async def readyz(store: CurrentStore, lifecycle: CurrentLifecycle) -> Response:
    """Queries can be answered, and the service does not stop soon."""
    if lifecycle.draining:
        raise Problem(503, "stopping", "the service stops", headers={"Retry-After": "10"})
    if not store.ready:
        detail = store.trouble or "no query can be answered"
        raise Problem(503, "not-ready", detail, headers={"Retry-After": "1"})
    return JSONResponse({"status": "ready"})
